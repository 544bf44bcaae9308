//! Drill holes, internal lines and notches that lie or reach where none can.

use super::codes;
use crate::dxf::desk::Desk;
use crate::dxf::geom;
use crate::dxf::piece::{DrawnPiece, mm};
use toile_garment::{Diagnostic, Vec2};

/// A drill hole this far outside the piece is no mark of it, mm.
const DRILL: f64 = 3.0;
/// Internal lines may run this far out of the piece, mm: some writers lengthen them by 20.
const LINE: f64 = 50.0;
/// No notch is deeper or wider, mm.
const NOTCH: f64 = 50.0;
/// Most pairs of a drill hole and an edge that are looked at.
const TESTS: usize = 50_000_000;

pub(super) fn check(piece: &DrawnPiece, desk: &mut Desk<'_>) {
    let line = piece.boundary.positions();
    let Some(bounds) = geom::bounds(line.iter().copied()) else { return };
    drills(piece, &line, bounds, desk);
    internals(piece, bounds, desk);
    notches(piece, desk);
}

/// Distance from a box; 0 inside.
fn beyond(p: Vec2, (lo, hi): (Vec2, Vec2)) -> f64 {
    Vec2::new((lo.x - p.x).max(p.x - hi.x).max(0.0), (lo.y - p.y).max(p.y - hi.y).max(0.0)).norm()
}

fn say_far(piece: &DrawnPiece, what: &str, far: &[(Vec2, f64, u64)], layer: &str, desk: &mut Desk<'_>) {
    let Some((at, off, line)) = far.iter().copied().max_by(|a, b| a.1.total_cmp(&b.1)) else { return };
    let text = format!(
        "{} {what}(s) of `{}` lie outside the piece, the farthest {off:.1} mm at {}; kept as drawn",
        far.len(),
        piece.label(),
        mm(at)
    );
    let hint = "take them out of the block if they belong to another piece";
    desk.say(Diagnostic::warning(codes::MARK_OUTSIDE, text).hint(hint), &piece.block, layer, line);
}

fn drills(piece: &DrawnPiece, line: &[Vec2], bounds: (Vec2, Vec2), desk: &mut Desk<'_>) {
    let exact = piece.inside.drills.len().saturating_mul(line.len()) <= TESTS;
    let off = |p: Vec2| {
        let out = beyond(p, bounds);
        if out > DRILL || !exact || geom::inside(p, line) { out } else { geom::distance(p, line, true) }
    };
    let far: Vec<_> =
        piece.inside.drills.iter().map(|d| (d.at, off(d.at), d.line)).filter(|(_, off, _)| *off > DRILL).collect();
    say_far(piece, "drill hole", &far, "13", desk);
}

fn internals(piece: &DrawnPiece, bounds: (Vec2, Vec2), desk: &mut Desk<'_>) {
    let farthest = |path: &crate::dxf::chain::Path| {
        let far = path.points.iter().map(|p| (p.0, beyond(p.0, bounds), path.line));
        far.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|f| f.1 > LINE)
    };
    let far: Vec<_> = piece.inside.internal.iter().filter_map(farthest).collect();
    say_far(piece, "internal line", &far, "8", desk);
}

fn notches(piece: &DrawnPiece, desk: &mut Desk<'_>) {
    let large = |n: &&crate::dxf::notches::DrawnNotch| n.depth.abs() > NOTCH || n.width.abs() > NOTCH;
    let Some(first) = piece.notches.iter().find(large) else { return };
    let text = format!(
        "{} notch(es) of `{}` are larger than any notch, as {:.1} mm deep and {:.1} mm wide at {}; kept as drawn",
        piece.notches.iter().filter(large).count(),
        piece.label(),
        first.depth,
        first.width,
        mm(first.at)
    );
    let hint = "correct the notches in the pattern program, or check the unit of the file";
    desk.say(Diagnostic::warning(codes::NOTCH_TOO_LARGE, text).hint(hint), &piece.block, "4", first.line);
}
