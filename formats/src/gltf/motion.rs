//! Frames of a motion as morph targets: each mesh gets one target for each frame. One animation lets the weight of each
//! rise to 1 at its time and fall again. So a viewer goes straight from frame to frame.

use super::write::{Buffer, Mesh, WriteError, floats};
use crate::normals;
use gltf_json as json;
use json::accessor::Type;
use json::animation::{Channel, Interpolation, Property, Sampler, Target};
use json::validation::Checked::Valid;
use toile_garment::animation::Animation;
use toile_garment::{Garment, Vec3};

/// Adds the targets to the meshes that stand in `root`, in the order of the pieces, and the animation.
pub fn push(
    root: &mut json::Root,
    buffer: &mut Buffer,
    garment: &Garment,
    meshes: &[Mesh<'_>],
    normals: &[Vec<Vec3>],
) -> Result<(), WriteError> {
    let Some(animation) = garment.animation.as_ref().filter(|a| !a.frames.is_empty()) else { return Ok(()) };
    for (k, frame) in animation.frames.iter().enumerate() {
        let fits = frame.len() == meshes.len() && frame.iter().zip(meshes).all(|(f, m)| f.len() == m.0.len());
        if !fits {
            return Err(WriteError::Damaged(format!("frame {k} of the motion belongs to another mesh")));
        }
        let moved: Vec<Mesh<'_>> = frame.iter().zip(meshes).map(|(f, m)| (f.as_slice(), m.1)).collect();
        let turned = normals::smooth(&moved);
        for (i, piece) in garment.pieces.iter().enumerate() {
            let by = delta(piece, "the position", &frame[i], meshes[i].0)?;
            let turn = delta(piece, "the normal", &turned[i], &normals[i])?;
            let target = json::mesh::MorphTarget {
                positions: Some(buffer.floats(root, &by, Type::Vec3, true)),
                normals: Some(buffer.floats(root, &turn, Type::Vec3, false)),
                tangents: None,
            };
            let mesh = &mut root.meshes[i];
            mesh.weights.get_or_insert_default().push(0.0);
            mesh.primitives.iter_mut().for_each(|p| p.targets.get_or_insert_default().push(target.clone()));
        }
    }
    play(root, buffer, animation, garment.pieces.len());
    Ok(())
}

/// The difference that is added to the base in single precision, as a viewer adds it.
fn delta(
    piece: &toile_garment::Piece,
    what: &'static str,
    to: &[Vec3],
    base: &[Vec3],
) -> Result<Vec<[f32; 3]>, WriteError> {
    let single = |v: &Vec3| [v.x as f32, v.y as f32, v.z as f32];
    let away = to.iter().zip(base).map(|(t, b)| {
        let (t, b) = (single(t), single(b));
        std::array::from_fn(|k| f64::from(t[k] - b[k]))
    });
    floats(piece, what, away)
}

/// One sampler for all pieces.
fn play(root: &mut json::Root, buffer: &mut Buffer, animation: &Animation, pieces: usize) {
    let count = animation.frames.len();
    let times: Vec<[f32; 1]> = (0..count).map(|k| [(k as f64 / animation.fps) as f32]).collect();
    let weights: Vec<[f32; 1]> = (0..count * count).map(|i| [f32::from(u8::from(i / count == i % count))]).collect();
    let input = buffer.plain(root, &times, true);
    let output = buffer.plain(root, &weights, false);
    let sampler =
        Sampler { extensions: None, extras: None, input, interpolation: Valid(Interpolation::Linear), output };
    let channels = (0..pieces as u32).map(|i| Channel {
        sampler: json::Index::new(0),
        target: Target {
            extensions: None,
            extras: None,
            node: json::Index::new(i),
            path: Valid(Property::MorphTargetWeights),
        },
        extensions: None,
        extras: None,
    });
    root.animations.push(json::Animation {
        extensions: None,
        extras: None,
        channels: channels.collect(),
        name: Some("motion".to_owned()),
        samplers: vec![sampler],
    });
}
