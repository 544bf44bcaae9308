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
    let reach = if piece.cut_line.is_some() { ALLOWANCE } else { OFF_LINE };
    let Some(ring) = shapes.rings.first() else { return Vec::new() };
    let mut out = Vec::new();
    for notch in piece.notches.iter().filter(|n| n.is_on_edge()) {
        let reach = if notch.on == "sew" { OFF_LINE } else { reach };
        let (s, distance) = ring.project(notch.at);
        let at_mouth = || {
            let p = ring.at(s);
            ring.gaps.iter().any(|g| [g.from, g.to].iter().any(|i| (ring.points[*i] - p).norm() < AT_END))
                || ring.gap_around(s).is_some()
        };
        if distance <= reach && !at_mouth() {
            out.push((0, s));
        }
    }
    out
}

/// Sewn ways of the notches between two positions on the outer ring, from the first, m. Notches at the ends are left out.
pub fn notches_on(piece: &Piece, shape: &PieceShape, ends: [f64; 2]) -> Vec<f64> {
    let Some(ring) = shape.rings.first() else { return Vec::new() };
    let walk = ring.ahead(ends[0], ends[1]);
    let walk = if walk < SAME { ring.total() } else { walk };
    let is_inside = |s: &f64| (AT_END..=walk - AT_END).contains(&ring.ahead(ends[0], *s));
    let on_edge = on_rings(piece, shape).into_iter().filter(|(r, _)| *r == 0).map(|(_, s)| s);
    let mut ways: Vec<f64> = on_edge.filter(is_inside).map(|s| ring.sewn_ahead(ends[0], s)).collect();
    ways.sort_by(f64::total_cmp);
    ways.dedup_by(|a, b| (*a - *b).abs() < AT_END);
    ways
}
