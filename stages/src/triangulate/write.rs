//! The mesh and the darts' vertex ids, written into the piece.

use super::curve::{Curve, CurveKind};
use super::layout::Layout;
use super::regular::Filled;
use crate::sewing::ring::SAME;
use crate::sewing::shapes::PieceShape;
use toile_garment::Piece;
use toile_garment::dart::{DartKind, DartMesh};
use toile_garment::mesh::{ChainKind, MeshChain, PieceMesh};

/// Fills `piece.mesh` and the `mesh` of its darts.
pub fn write(piece: &mut Piece, shape: &PieceShape, curves: &[Curve], layout: &Layout, filled: Filled) {
    for dart in &mut piece.darts {
        dart.mesh = None;
    }
    wedge_legs(piece, shape, curves, layout);
    closed_legs(piece, curves, layout);
    pleat_legs(piece, curves, layout);
    let (rest, triangles) = filled;
    let outline_vertex = outline_vertices(piece, shape, curves, layout);
    piece.mesh =
        Some(PieceMesh { rest, triangles, chains: chains(piece, layout), outline_vertex, ..PieceMesh::default() });
}

/// Vertex at an arc position that is a break.
fn vertex(curves: &[Curve], layout: &Layout, curve: usize, s: f64) -> Option<u32> {
    let c = &curves[curve];
    let s = c.wrap(s);
    let near = |b: f64| {
        let d = (b - s).abs();
        d < SAME || (c.closed && c.total() - d < SAME)
    };
    let k = c.breaks.iter().position(|b| near(*b))?;
    layout.at_break[curve].get(k).copied()
}

/// Vertices of a closed chain from one to another.
fn walk(chain: &[u32], from: u32, to: u32, forward: bool) -> Vec<u32> {
    let n = chain.len();
    let Some(start) = chain.iter().position(|v| *v == from) else { return Vec::new() };
    let mut out = vec![from];
    let mut at = start;
    while chain[at] != to && out.len() <= n {
        at = if forward { (at + 1) % n } else { (at + n - 1) % n };
        out.push(chain[at]);
    }
    out
}

fn wedge_legs(piece: &mut Piece, shape: &PieceShape, curves: &[Curve], layout: &Layout) {
    let Some(ring) = shape.rings.first() else { return };
    for g in &ring.gaps {
        let Some(apex) = g.apex else { continue };
        let at = |i: usize| vertex(curves, layout, 0, ring.arc[i]);
        let (Some(from), Some(apex), Some(to)) = (at(g.from), at(apex), at(g.to)) else { continue };
        let down = walk(&layout.chains[0], from, apex, true);
        let up = walk(&layout.chains[0], to, apex, false);
        let legs = if g.swapped { [up, down] } else { [down, up] };
        piece.darts[g.dart].mesh = Some(DartMesh { legs });
    }
}

fn closed_legs(piece: &mut Piece, curves: &[Curve], layout: &Layout) {
    for (k, c) in curves.iter().enumerate() {
        let CurveKind::FishEye(d) = c.kind else { continue };
        let dart = &mut piece.darts[d];
        let end = |i: usize| dart.apexes.get(i).and_then(|a| vertex(curves, layout, k, c.project(*a).0));
        let (Some(a), Some(b)) = (end(0), end(1)) else { continue };
        dart.mesh =
            Some(DartMesh { legs: [walk(&layout.chains[k], a, b, true), walk(&layout.chains[k], a, b, false)] });
    }
}

fn pleat_legs(piece: &mut Piece, curves: &[Curve], layout: &Layout) {
    let pleats = piece.darts.iter_mut().enumerate().filter(|(_, d)| d.kind == DartKind::Pleat);
    for (d, dart) in pleats {
        let leg = |side: usize| {
            let k = curves.iter().position(|c| c.kind == CurveKind::PleatLeg(d, side));
            match k {
                Some(k) => Some(layout.chains[k].clone()),
                // Held at the mouth only.
                None => vertex(curves, layout, 0, curves[0].project(dart.mouth[side]).0).map(|v| vec![v]),
            }
        };
        if let (Some(a), Some(b)) = (leg(0), leg(1)) {
            dart.mesh = Some(DartMesh { legs: [a, b] });
        }
    }
}

fn chains(piece: &Piece, layout: &Layout) -> Vec<MeshChain> {
    let mut out = Vec::new();
    for (k, (kind, closed)) in layout.kinds.iter().enumerate() {
        let (kind, index) = match *kind {
            CurveKind::Outline => (ChainKind::Outline, 0),
            CurveKind::Cutout(c) => (ChainKind::Cutout, c),
            CurveKind::Line(l) => (ChainKind::InternalLine, l),
            CurveKind::SeamLine(l) => (ChainKind::SeamLine, l),
            // Legs follow from the darts.
            CurveKind::FishEye(_) | CurveKind::PleatLeg(..) => continue,
        };
        let vertices = layout.chains[k].clone();
        out.push(MeshChain { kind, index: index as u32, vertices, closed: *closed });
    }
    for (d, dart) in piece.darts.iter().enumerate() {
        for leg in dart.mesh.iter().flat_map(|m| &m.legs) {
            out.push(MeshChain { kind: ChainKind::DartLeg, index: d as u32, vertices: leg.clone(), closed: false });
        }
    }
    out
}

fn outline_vertices(piece: &Piece, shape: &PieceShape, curves: &[Curve], layout: &Layout) -> Vec<Option<u32>> {
    let Some(ring) = shape.rings.first() else { return vec![None; piece.outline.points.len()] };
    ring.of_line.iter().map(|i| i.and_then(|i| vertex(curves, layout, 0, ring.arc[i]))).collect()
}
