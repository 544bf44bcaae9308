//! Pieces that start in the body or in one another are moved, whole, until they are free.
//!
//! A collar is often placed so close to the neck that it cuts it, and a sleeve so close to the trunk that it cuts the
//! front. A person would lay it a little farther off.

use crate::collision::body::Body;
use crate::collision::broad_phase::aabb::Aabb;
use crate::collision::crossings::count;
use crate::effects::{Facts, SELF_CONTACT};
use crate::prepare::start::Start;
use crate::prepare::tuning::{PIECE_MOVE_FIRST, PIECE_MOVE_GROWTH, PIECE_MOVE_MOST};
use crate::scene::topology::Topology;
use crate::{ClothError, Scene, Settings, Vec3};
use nalgebra::Matrix3;
use std::collections::BTreeMap;

/// A piece that was moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PieceMove {
    /// The first of its vertices.
    pub vertex: u32,
    /// Its move, m.
    pub by: Vec3,
}

/// Moves pieces that cross the body or another piece along one of their principal axes until they are free, and not
/// farther than `PIECE_MOVE_MOST`.
///
/// Pieces that cross nothing stay. Of the others the largest is freed first, and the next ones make way for it. Pieces
/// with pins stay, and so do those that would not be free anywhere. Nothing is moved where the usual repair of a start
/// is enough.
///
/// # Errors
/// An unusable scene or setting.
pub fn free_pieces(scene: &mut Scene, settings: &Settings) -> Result<Vec<PieceMove>, ClothError> {
    match Start::new(scene, settings) {
        Ok(_) => return Ok(Vec::new()),
        Err(ClothError::StartCrosses { .. }) => {}
        Err(other) => return Err(other),
    }
    let body = Body::of_scene(scene);
    let meets_cloth = SELF_CONTACT.is_on(&Facts::of_scene(scene, settings), settings);
    let pieces = pieces_of(scene);
    let others = if meets_cloth { pieces.iter().collect() } else { Vec::new() };
    let mut placed = Placed { x: scene.positions.clone(), body: body.as_ref(), others };
    let (free, mut crossing): (Vec<&Piece>, Vec<&Piece>) =
        pieces.iter().partition(|p| placed.is_free(p, Vec3::zeros()));
    placed.others.retain(|p| free.iter().any(|f| std::ptr::eq(*f, *p)));
    crossing.sort_by(|a, b| b.area.total_cmp(&a.area));
    let mut moves = Vec::new();
    for piece in crossing {
        if !piece.is_held
            && let Some(by) = placed.shortest_move(piece)
        {
            piece.vertices.iter().for_each(|v| placed.x[*v as usize] += by);
            moves.push(PieceMove { vertex: piece.vertices[0], by });
        }
        if meets_cloth {
            placed.others.push(piece);
        }
    }
    scene.positions = placed.x;
    moves.sort_by_key(|m| m.vertex);
    Ok(moves)
}

/// A connected piece of cloth.
struct Piece {
    vertices: Vec<u32>,
    faces: Vec<[u32; 3]>,
    /// Area, m².
    area: f64,
    /// A pin holds it.
    is_held: bool,
}

fn pieces_of(scene: &Scene) -> Vec<Piece> {
    let topology = Topology::of_elements(scene.positions.len(), &scene.triangles);
    let part = topology.components(scene.positions.len());
    let mut pieces: BTreeMap<u32, Piece> = BTreeMap::new();
    for t in &topology.faces {
        let empty = Piece { vertices: Vec::new(), faces: Vec::new(), area: 0.0, is_held: false };
        let piece = pieces.entry(part[t[0] as usize]).or_insert(empty);
        piece.faces.push(*t);
        piece.area += 0.5 * across(&scene.positions, t).norm();
    }
    for (v, p) in (0u32..).zip(&part) {
        pieces.entry(*p).and_modify(|piece| piece.vertices.push(v));
    }
    for pin in &scene.pins {
        pieces.entry(part[pin.vertex as usize]).and_modify(|piece| piece.is_held = true);
    }
    pieces.into_values().collect()
}

/// Twice the area of a triangle, along its normal.
fn across(x: &[Vec3], t: &[u32; 3]) -> Vec3 {
    let [a, b, c] = crate::pick3(x, t);
    (b - a).cross(&(c - a))
}

impl Piece {
    /// The moves that are tried, m, the shortest first. Of equal ones that along the normal comes first.
    fn moves(&self, x: &[Vec3]) -> Vec<Vec3> {
        let axes = self.axes(x);
        let lengths = std::iter::successors(Some(PIECE_MOVE_FIRST.get()), |l| Some(l * PIECE_MOVE_GROWTH.get()));
        lengths
            .take_while(|length| *length <= PIECE_MOVE_MOST.get())
            .flat_map(|length| axes.iter().flat_map(move |axis| [axis * length, -axis * length]))
            .collect()
    }

    /// Principal axes: across the piece, the way that its right side looks, and those within it.
    fn axes(&self, x: &[Vec3]) -> [Vec3; 3] {
        let own = || self.vertices.iter().map(|v| x[*v as usize]);
        let middle = own().sum::<Vec3>() / self.vertices.len() as f64;
        let spread: Matrix3<f64> = own().map(|p| (p - middle) * (p - middle).transpose()).sum();
        let eigen = spread.symmetric_eigen();
        let mut order = [0, 1, 2];
        order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
        let normal: Vec3 = self.faces.iter().map(|t| across(x, t)).sum();
        order.map(|k| {
            let axis = eigen.eigenvectors.column(k).into_owned();
            axis * axis.dot(&normal).signum()
        })
    }
}

/// Places of all cloth, m, with the body and the pieces that must not be crossed.
struct Placed<'a> {
    x: Vec<Vec3>,
    body: Option<&'a Body>,
    others: Vec<&'a Piece>,
}

impl Placed<'_> {
    /// The shortest of the moves tried that frees a piece, m, and a little more where there is room. `None` where the
    /// piece is free, or no move frees it.
    fn shortest_move(&self, piece: &Piece) -> Option<Vec3> {
        if self.is_free(piece, Vec3::zeros()) {
            return None;
        }
        let by = piece.moves(&self.x).into_iter().find(|by| self.is_free(piece, *by))?;
        let farther = by + by.normalize() * PIECE_MOVE_FIRST.get();
        Some(if self.is_free(piece, farther) { farther } else { by })
    }

    /// Returns `true` if a piece is free of the body and of the other pieces after a move, m.
    fn is_free(&self, piece: &Piece, by: Vec3) -> bool {
        let mut moved = self.x.clone();
        piece.vertices.iter().for_each(|v| moved[*v as usize] += by);
        self.body.is_none_or(|body| is_off_body(piece, &moved, body))
            && !self.others.iter().any(|other| !std::ptr::eq(*other, piece) && do_cross(&moved, piece, other))
    }
}

fn is_off_body(piece: &Piece, x: &[Vec3], body: &Body) -> bool {
    let first = piece.vertices[0] as usize;
    count::body_crossings(x, &piece.faces, body).count == 0
        && !body.contains(&x[first], body.met.ignored_by_piece(first))
}

fn do_cross(x: &[Vec3], piece: &Piece, other: &Piece) -> bool {
    let bounds = |p: &Piece| p.vertices.iter().fold(Aabb::EMPTY, |b, v| b.join(&Aabb::of_one(&x[*v as usize])));
    if !bounds(piece).meets(&bounds(other)) {
        return false;
    }
    let faces: Vec<[u32; 3]> = piece.faces.iter().chain(&other.faces).copied().collect();
    let is_own = |f: u32| (f as usize) < piece.faces.len();
    count::self_crossings(x, &faces).pairs.iter().any(|[a, b]| is_own(*a) != is_own(*b))
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
        let moves = free_pieces(&mut scene, &Settings { repair_share: 0.0, ..Settings::sewing() }).unwrap();
        // The ball reaches from 20 mm behind the sheet to 80 mm in front of it.
        assert_eq!(moves.len(), 1);
        let along = -moves[0].by.dot(&normal);
        assert!((moves[0].by + normal * along).norm() < 1e-9 && (0.02..0.03).contains(&along), "{:?}", moves[0]);
        assert!(scene.positions.iter().zip(&start).all(|(p, q)| (p - q - moves[0].by).norm() < 1e-12));
    }

    /// A small sheet that cuts a large one across comes to lie beside it; the large one stays.
    #[test]
    fn of_two_sheets_that_cut_each_other_the_small_one_is_moved() {
        let mut scene = Scene { materials: vec![Material::isotropic(0.15, 500.0, 0.0, 1e-5)], ..Scene::default() };
        test_sheets::add(&mut scene, 20, 1.0, 0.0, |_, _| false);
        let large = scene.positions.len();
        test_sheets::add(&mut scene, 12, 0.6, 0.0, |_, _| false);
        scene.positions[large..].iter_mut().for_each(|p| *p = Vec3::new(0.003, p.x + 0.01, p.z));
        let start = scene.positions.clone();
        let moves = free_pieces(&mut scene, &Settings::sewing()).unwrap();
        assert_eq!(moves.len(), 1);
        assert_eq!(moves[0].vertex as usize, large);
        assert_eq!(scene.positions[..large], start[..large]);
        // It reached 290 mm below the large sheet and goes up until it is above it.
        let lowest = scene.positions[large..].iter().map(|p| p.y).fold(f64::INFINITY, f64::min);
        assert!(lowest > 0.0 && lowest < 0.1, "{lowest}");
        let topology = Topology::of_elements(scene.positions.len(), &scene.triangles);
        assert_eq!(count::self_crossings(&scene.positions, &topology.faces).count, 0);
    }
}
