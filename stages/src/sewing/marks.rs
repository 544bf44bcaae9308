//! Notches on the outline as it is sewn.

use super::ring::SAME;
use super::shapes::PieceShape;
use toile_garment::Piece;

/// A notch this far off the sewn line still marks it when the piece has no seam allowance.
const OFF_LINE: f64 = 3e-3;
/// The widest seam allowance a notch on the cut line is carried over.
const ALLOWANCE: f64 = 30e-3;
/// Notches this near to an end of the seam or to a dart's mouth mark that, and not the run.
pub const AT_END: f64 = 1.5e-3;

/// Ring positions of the notches of a piece: (ring, arc position).
pub fn on_rings(piece: &Piece, shapes: &PieceShape) -> Vec<(usize, f64)> {
    on_outline(piece, shapes).into_iter().map(|(_, s)| (0, s)).collect()
}

/// The notches of a piece on its outer ring: index in its list, and arc position.
pub fn on_outline(piece: &Piece, shapes: &PieceShape) -> Vec<(usize, f64)> {
    let reach = if piece.cut_line.is_some() { ALLOWANCE } else { OFF_LINE };
    let Some(ring) = shapes.rings.first() else { return Vec::new() };
    let mut out = Vec::new();
    for (k, notch) in piece.notches.iter().enumerate().filter(|(_, n)| n.is_on_edge()) {
        let reach = if notch.on == "sew" { OFF_LINE } else { reach };
        let (s, distance) = ring.project(notch.at);
        let at_mouth = || {
            let p = ring.at(s);
            ring.gaps.iter().any(|g| [g.from, g.to].iter().any(|i| (ring.points[*i] - p).norm() < AT_END))
                || ring.gap_around(s).is_some()
        };
        if distance <= reach && !at_mouth() {
            out.push((k, s));
        }
    }
    out
}

/// Sewn ways of the notches between two positions on the outer ring, from the first, m. Notches at the ends are left out.
pub fn notches_on(piece: &Piece, shape: &PieceShape, ends: [f64; 2]) -> Vec<f64> {
    listed_on(piece, shape, ends).into_iter().map(|(_, way)| way).collect()
}

/// The same with the index of every notch in the list of its piece.
pub fn listed_on(piece: &Piece, shape: &PieceShape, ends: [f64; 2]) -> Vec<(usize, f64)> {
    let Some(ring) = shape.rings.first() else { return Vec::new() };
    let walk = ring.ahead(ends[0], ends[1]);
    let walk = if walk < SAME { ring.total() } else { walk };
    let is_inside = |(_, s): &(usize, f64)| (AT_END..=walk - AT_END).contains(&ring.ahead(ends[0], *s));
    let on_edge = on_outline(piece, shape).into_iter().filter(is_inside);
    let mut ways: Vec<(usize, f64)> = on_edge.map(|(k, s)| (k, ring.sewn_ahead(ends[0], s))).collect();
    ways.sort_by(|a, b| a.1.total_cmp(&b.1));
    ways.dedup_by(|a, b| (a.1 - b.1).abs() < AT_END);
    ways
}
