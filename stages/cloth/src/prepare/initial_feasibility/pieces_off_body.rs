//! Pieces that start in the body are moved off it, whole, along their normals.
//!
//! A collar is often placed so close to the neck that it cuts it. A person would lay it a little in front.

use crate::collision::body::Body;
use crate::collision::crossings::count;
use crate::prepare::initial_feasibility::repair::free_of_body;
use crate::prepare::tuning::{PIECE_OFF_BODY_MOST, PIECE_OFF_BODY_STEP};
use crate::scene::topology::Topology;
use crate::scene::validate;
use crate::{ClothError, Scene, Settings, Vec3};

/// A piece that was moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PieceMove {
    /// The first of its vertices.
    pub vertex: u32,
    /// Its move, m.
    pub by: Vec3,
}

/// Moves every piece of the scene that crosses the body along its mean normal until it is free, and not farther than
/// `PIECE_OFF_BODY_MOST`. Pieces that would not be free there stay. Nothing is moved where it is enough to push single
/// vertices out of the body.
///
/// # Errors
/// An unusable scene or setting.
pub fn pieces_off_body(scene: &mut Scene, settings: &Settings) -> Result<Vec<PieceMove>, ClothError> {
    validate::scene(scene)?;
    validate::settings(settings)?;
    let Some(body) = Body::of_scene(scene) else { return Ok(Vec::new()) };
    let topology = Topology::of_elements(scene.positions.len(), &scene.triangles);
    let (gap, share) = (settings.body_gap, settings.repair_share);
    if free_of_body(&mut scene.positions.clone(), &topology, &body, gap, share).is_ok() {
        return Ok(Vec::new());
    }
    let part = topology.components(scene.positions.len());
    let found = count::body_crossings(&scene.positions, &topology.faces, &body);
    let mut crossing: Vec<u32> = found.pairs.iter().map(|p| part[topology.faces[p[0] as usize][0] as usize]).collect();
    crossing.sort_unstable();
    crossing.dedup();
    let mut moves = Vec::new();
    for piece in crossing {
        let faces: Vec<[u32; 3]> = topology.faces.iter().filter(|t| part[t[0] as usize] == piece).copied().collect();
        let Some(by) = free_move(&scene.positions, &faces, &body) else { continue };
        for (p, _) in scene.positions.iter_mut().zip(&part).filter(|(_, of)| **of == piece) {
            *p += by;
        }
        moves.push(PieceMove { vertex: piece, by });
    }
    Ok(moves)
}

/// The shortest of the moves tried that frees a piece of the body, m.
fn free_move(x: &[Vec3], faces: &[[u32; 3]], body: &Body) -> Option<Vec3> {
    let area = |t: &[u32; 3]| {
        let [a, b, c] = crate::pick3(x, t);
        (b - a).cross(&(c - a))
    };
    let normal = faces.iter().map(area).sum::<Vec3>().try_normalize(0.0)?;
    let mut moved = x.to_vec();
    let mut is_free = |by: Vec3| {
        faces.iter().flatten().for_each(|v| moved[*v as usize] = x[*v as usize] + by);
        let outside = |v: u32| !body.contains(&moved[v as usize], body.met.ignored_by_piece(v as usize));
        count::body_crossings(&moved, faces, body).count == 0 && outside(faces[0][0])
    };
    let steps = (PIECE_OFF_BODY_MOST.get() / PIECE_OFF_BODY_STEP.get()) as u32;
    let moves = (1..=steps).flat_map(|k| [1.0, -1.0].map(|side| side * f64::from(k) * PIECE_OFF_BODY_STEP.get()));
    moves.map(|length| normal * length).find(|by| is_free(*by))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::optimize::test_sheets;
    use crate::{BodyMesh, Material};

    /// A sheet that cuts a ball comes to lie just beside it, and is as flat as before.
    #[test]
    fn a_sheet_that_cuts_a_ball_is_moved_off() {
        let mut scene = Scene { materials: vec![Material::isotropic(0.15, 500.0, 0.0, 1e-5)], ..Scene::default() };
        test_sheets::add(&mut scene, 8, 0.4, 0.0, |_, _| false);
        let middle = scene.positions.iter().sum::<Vec3>() / scene.positions.len() as f64;
        let normal = Vec3::y();
        let tip = |d: Vec3| middle + normal * 0.03 + d * 0.05;
        let positions: Vec<Vec3> =
            [1.0, -1.0].into_iter().flat_map(|s| [0, 1, 2].map(|k| Vec3::ith(k, s))).map(tip).collect();
        let triangles = (0..8u32)
            .map(|k| {
                let (x, y, z) = (3 * (k & 1), 1 + 3 * (k >> 1 & 1), 2 + 3 * (k >> 2));
                if k.count_ones() % 2 == 0 { [x, y, z] } else { [y, x, z] }
            })
            .collect();
        scene.body = Some(BodyMesh { positions, triangles }.into());
        let start = scene.positions.clone();
        let moves = pieces_off_body(&mut scene, &Settings { repair_share: 0.0, ..Settings::sewing() }).unwrap();
        // The ball reaches from 20 mm behind the sheet to 80 mm in front of it.
        assert_eq!(moves.len(), 1);
        assert!((moves[0].by + normal * 0.025).norm() < 1e-9, "{:?}", moves[0]);
        assert!(scene.positions.iter().zip(&start).all(|(p, q)| (p - q - moves[0].by).norm() < 1e-12));
    }
}
