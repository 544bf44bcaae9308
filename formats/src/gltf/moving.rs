//! A mesh that moves: the animation of a GLB (node transforms, a skin, morph targets) as places of vertices, frame by
//! frame.

use super::ReadError;
use super::geometry::{Sound, guarded, open};
use super::track::Track;
use nalgebra::{Matrix4, Quaternion, UnitQuaternion, Vector3};
use toile_garment::Vec3;

/// Most frames, and most numbers of all frames together.
const MOST_FRAMES: f64 = 100_000.0;
const MOST_PLACES: f64 = 1e8;

/// A moving mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Moving {
    /// World positions without animation, metres, all meshes of the scene one after the other.
    pub rest: Vec<Vec3>,
    /// World positions in every frame, metres.
    pub frames: Vec<Vec<Vec3>>,
}

/// Reads the first animation of a GLB at `fps` frames a second.
///
/// # Errors
/// See [`ReadError`]; a file without animation is one.
pub fn read_moving(bytes: &[u8], fps: f64) -> Result<Moving, ReadError> {
    let sound = open(bytes)?;
    guarded(|| moving(&sound, fps))
}

fn moving(sound: &Sound<'_>, fps: f64) -> Result<Moving, ReadError> {
    let damaged = |what: &str| ReadError::Damaged(what.to_owned());
    let animation = sound.document.animations().next().ok_or_else(|| damaged("it holds no animation"))?;
    let tracks: Vec<Track> = animation
        .channels()
        .map(|c| Track::read(&c, sound.bin))
        .collect::<Option<_>>()
        .ok_or_else(|| damaged("a channel of its animation has no times or values"))?;
    let seconds = tracks.iter().map(Track::end).fold(0.0, f64::max);
    let parts = parts(sound)?;
    let rest = pose(sound, &parts, &[], 0.0)?;
    let count = (seconds * fps + 1e-6).floor() + 1.0;
    if !(count <= MOST_FRAMES && count * rest.len() as f64 <= MOST_PLACES) {
        return Err(ReadError::Damaged(format!("its animation of {seconds} s is too long")));
    }
    let frames = (0..count as usize).map(|k| pose(sound, &parts, &tracks, k as f64 / fps)).collect::<Result<_, _>>()?;
    Ok(Moving { rest, frames })
}

/// One mesh with what moves it.
struct Part {
    node: usize,
    positions: Vec<Vec3>,
    /// Displacements by morph target.
    targets: Vec<Vec<Vec3>>,
    weights: Vec<f64>,
    skin: Option<Skin>,
}

struct Skin {
    joints: Vec<usize>,
    inverse: Vec<Matrix4<f64>>,
    /// Per vertex: joint of the skin, weight.
    holds: Vec<Vec<(usize, f64)>>,
}

fn vector(p: [f32; 3]) -> Vec3 {
    Vec3::from(p.map(f64::from))
}

fn parts(sound: &Sound<'_>) -> Result<Vec<Part>, ReadError> {
    let mut parts = Vec::new();
    for node in sound.document.nodes() {
        let Some(mesh) = node.mesh() else { continue };
        let mut weights: Vec<f64> =
            node.weights().or(mesh.weights()).unwrap_or(&[]).iter().copied().map(f64::from).collect();
        for primitive in mesh.primitives() {
            let reader = primitive.reader(|b| (b.index() == 0).then_some(sound.bin));
            let Some(read) = reader.read_positions() else { continue };
            let positions: Vec<Vec3> = read.map(vector).collect();
            let target = |by: Option<gltf::mesh::util::ReadPositions<'_>>| -> Vec<Vec3> {
                by.map_or_else(|| vec![Vec3::zeros(); positions.len()], |r| r.map(vector).collect())
            };
            let targets: Vec<Vec<Vec3>> = reader.read_morph_targets().map(|(by, _, _)| target(by)).collect();
            weights.resize(targets.len().max(weights.len()), 0.0);
            let whole = targets.iter().all(|t| t.len() == positions.len());
            let skin = node.skin().map(|s| skin(&s, &reader, positions.len(), sound.bin)).transpose()?;
            if !whole {
                return Err(ReadError::Damaged("a morph target belongs to another mesh".to_owned()));
            }
            parts.push(Part { node: node.index(), positions, targets, weights: weights.clone(), skin });
        }
    }
    Ok(parts)
}

fn skin<'a, 's, F>(
    skin: &gltf::Skin<'a>,
    reader: &gltf::mesh::Reader<'a, 's, F>,
    vertices: usize,
    bin: &'s [u8],
) -> Result<Skin, ReadError>
where
    F: Clone + Fn(gltf::Buffer<'a>) -> Option<&'s [u8]>,
{
    let damaged = |what: &str| ReadError::Damaged(what.to_owned());
    let joints: Vec<usize> = skin.joints().map(|j| j.index()).collect();
    let read = skin.reader(|b| (b.index() == 0).then_some(bin)).read_inverse_bind_matrices();
    let inverse: Vec<Matrix4<f64>> = read.map_or_else(
        || vec![Matrix4::identity(); joints.len()],
        |m| m.map(|m| Matrix4::from_fn(|r, c| f64::from(m[c][r]))).collect(),
    );
    let mut holds: Vec<Vec<(usize, f64)>> = vec![Vec::new(); vertices];
    for set in 0.. {
        let (Some(j), Some(w)) = (reader.read_joints(set), reader.read_weights(set)) else { break };
        for ((hold, j), w) in holds.iter_mut().zip(j.into_u16()).zip(w.into_f32()) {
            let both = j.into_iter().zip(w).filter(|(_, w)| *w > 0.0);
            hold.extend(both.map(|(j, w)| (usize::from(j), f64::from(w))));
        }
    }
    let sound = inverse.len() >= joints.len() && holds.iter().flatten().all(|(j, _)| *j < joints.len());
    if sound { Ok(Skin { joints, inverse, holds }) } else { Err(damaged("a skin names a joint that is not there")) }
}

/// World positions at a time.
fn pose(sound: &Sound<'_>, parts: &[Part], tracks: &[Track], seconds: f64) -> Result<Vec<Vec3>, ReadError> {
    let world = worlds(sound, tracks, seconds);
    let mut out = Vec::new();
    for part in parts {
        let track = tracks.iter().find(|t| t.is_weights(part.node));
        let weights = track.map_or_else(|| part.weights.clone(), |t| t.at(seconds));
        for (i, p) in part.positions.iter().enumerate() {
            let moved = part.targets.iter().zip(&weights).fold(*p, |p, (t, w)| p + t[i] * *w);
            let matrix = match part.skin.as_ref().filter(|s| !s.holds[i].is_empty()) {
                None => world[part.node],
                Some(s) => {
                    let sum: f64 = s.holds[i].iter().map(|h| h.1).sum();
                    s.holds[i].iter().map(|(j, w)| world[s.joints[*j]] * s.inverse[*j] * (w / sum)).sum()
                }
            };
            out.push(matrix.transform_point(&moved.into()).coords);
        }
    }
    if out.iter().all(|p| p.iter().all(|c| c.is_finite())) {
        Ok(out)
    } else {
        Err(ReadError::Damaged(format!("a position is not finite at {seconds} s")))
    }
}

/// World matrices of all nodes (which form no loop: that was checked).
fn worlds(sound: &Sound<'_>, tracks: &[Track], seconds: f64) -> Vec<Matrix4<f64>> {
    let nodes: Vec<gltf::Node<'_>> = sound.document.nodes().collect();
    let local: Vec<Matrix4<f64>> = nodes.iter().map(|n| local(n, tracks, seconds)).collect();
    let mut world = local.clone();
    let mut child = vec![false; nodes.len()];
    nodes.iter().flat_map(gltf::Node::children).for_each(|c| child[c.index()] = true);
    let mut stack: Vec<usize> = (0..nodes.len()).filter(|i| !child[*i]).collect();
    while let Some(i) = stack.pop() {
        for c in nodes[i].children() {
            world[c.index()] = world[i] * local[c.index()];
            stack.push(c.index());
        }
    }
    world
}

fn local(node: &gltf::Node<'_>, tracks: &[Track], seconds: f64) -> Matrix4<f64> {
    let mine: Vec<&Track> = tracks.iter().filter(|t| t.moves(node.index())).collect();
    if mine.is_empty() {
        let m = node.transform().matrix();
        return Matrix4::from_fn(|r, c| f64::from(m[c][r]));
    }
    let (t, r, s) = node.transform().decomposed();
    let (mut t, mut r, mut s) = (t.map(f64::from), r.map(f64::from), s.map(f64::from));
    mine.iter().for_each(|track| track.apply(seconds, &mut t, &mut r, &mut s));
    let turn = UnitQuaternion::from_quaternion(Quaternion::new(r[3], r[0], r[1], r[2]));
    Matrix4::new_translation(&Vector3::from(t))
        * turn.to_homogeneous()
        * Matrix4::new_nonuniform_scaling(&Vector3::from(s))
}
