//! Outlines with points enough for what became of them.
//!
//! A straight edge is drawn by its two ends. Where the flattening let it become a curve, the mesh knows the curve
//! and the ends do not. So the vertices of the mesh become points of the stored outline first, and all that follows
//! has both.

use super::carry::Ride;
use crate::flatten::held_lines::STRAIGHT_BOW;
use std::borrow::Cow;
use toile_garment::outline::{LinePoint, PointKind};
use toile_garment::{Garment, Piece, Vec2};

/// The garment with points on every segment of an outline that became a curve.
pub fn finer(garment: &Garment) -> Cow<'_, Garment> {
    let Some(flat) = &garment.flat else { return Cow::Borrowed(garment) };
    let mut out = Cow::Borrowed(garment);
    for flat in &flat.pieces {
        let at = flat.piece.index();
        let Some(piece) = garment.pieces.get(at) else { continue };
        let added: Vec<(usize, Vec<u32>)> = curves(piece, &flat.positions).unwrap_or_default();
        if let (false, Some(piece)) = (added.is_empty(), out.to_mut().pieces.get_mut(at)) {
            added.iter().rev().for_each(|(point, vertices)| insert(piece, *point, vertices));
        }
    }
    out
}

/// The segments of the outline whose mesh vertices no longer lie on them: point at the start, and those vertices.
fn curves(piece: &Piece, flat: &[Vec2]) -> Option<Vec<(usize, Vec<u32>)>> {
    let mesh = piece.mesh.as_ref()?;
    let chain = &mesh.outline()?.vertices;
    let (n, m) = (piece.outline.points.len(), chain.len());
    let place = |point: usize| {
        let vertex = mesh.outline_vertex.get(point).copied().flatten()?;
        chain.iter().position(|v| *v == vertex)
    };
    let mut out = Vec::new();
    for point in 0..n {
        let (Some(from), Some(to)) = (place(point), place((point + 1) % n)) else { continue };
        let between: Vec<u32> = (1..(to + m - from) % m).map(|k| chain[(from + k) % m]).collect();
        let on = |line: &[Vec2], v: u32| Some(*line.get(v as usize)?);
        let ends = |line: &[Vec2]| Some([on(line, chain[from])?, on(line, chain[to])?]);
        let ride = Ride::new(ends(&mesh.rest)?, ends(flat)?);
        let bows = |v: &u32| {
            let carried = ride.zip(on(&mesh.rest, *v)).map(|(ride, at)| ride.apply(at));
            carried.zip(on(flat, *v)).is_some_and(|(straight, at)| off_line(ends(flat), straight, at) > STRAIGHT_BOW)
        };
        let is_straight = between.iter().all(|v| on(&mesh.rest, *v).is_some_and(|at| lies_on(ends(&mesh.rest), at)));
        if is_straight && between.iter().any(bows) {
            out.push((point, between));
        }
    }
    Some(out)
}

/// Does a point lie on the line between two others? The mesh of a marked dart goes round its intake.
fn lies_on(ends: Option<[Vec2; 2]>, p: Vec2) -> bool {
    ends.is_some_and(|[a, b]| (b - a).perp(&(p - a)).abs() <= STRAIGHT_BOW * (b - a).norm())
}

/// How far two points differ across a line.
fn off_line(ends: Option<[Vec2; 2]>, p: Vec2, q: Vec2) -> f64 {
    ends.map_or(0.0, |[a, b]| ((b - a).perp(&(q - p)) / (b - a).norm().max(1e-12)).abs())
}

/// Puts mesh vertices behind a point of the outline.
fn insert(piece: &mut Piece, point: usize, vertices: &[u32]) {
    let Some(mesh) = &mut piece.mesh else { return };
    let on_curve = |v: &u32| LinePoint { at: mesh.rest[*v as usize], kind: PointKind::Curve };
    let points: Vec<LinePoint> = vertices.iter().map(on_curve).collect();
    let behind = point + 1;
    piece.outline.points.splice(behind..behind, points);
    mesh.outline_vertex.splice(behind..behind, vertices.iter().map(|v| Some(*v)));
    let count = vertices.len() as u32;
    for edge in &mut piece.edges {
        for end in [&mut edge.from, &mut edge.to] {
            *end += if *end as usize > point { count } else { 0 };
        }
    }
}
