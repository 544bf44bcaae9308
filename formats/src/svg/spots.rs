//! Places that findings name, marked in the drawing: lines in red, and pins with numbers beside the points.

use super::canvas::{Bounds, Canvas};
use super::labels::Labels;
use toile_garment::Vec2;

/// Marked places can be picked. Those without a number are seen only when they are picked.
pub(super) const SPOT_STYLE: &str = "\
.found path{stroke:#c0261c;stroke-width:4px;stroke-opacity:.75;stroke-linecap:round}.found .lead{stroke-width:1.5px}\
.found circle{fill:#c0261c;stroke:#fff;stroke-width:1.5px;vector-effect:non-scaling-stroke}\
.found text{fill:#fff;stroke:none;font-weight:bold}.found.picked path{stroke-width:7px;stroke-opacity:1}\
.found.picked circle{fill:#7a0f08}.found.quiet{display:none}.found.quiet.picked{display:inline}";

/// A place in the drawing.
#[derive(Clone, Copy, Debug)]
pub struct Spot<'a> {
    /// The name that picks it.
    pub pick: &'a str,
    /// Its number; empty where it is seen only when it is picked.
    pub label: &'a str,
    /// Points on pieces, in their coordinates, metres.
    pub points: &'a [(usize, Vec2)],
    /// Lines on pieces, in their coordinates, metres.
    pub lines: &'a [(usize, Vec<Vec2>)],
}

/// Directions in which a pin may stand beside its place, and its distance in heights of text.
const WAYS: [[f64; 2]; 8] =
    [[0.7, 0.7], [-0.7, 0.7], [0.7, -0.7], [-0.7, -0.7], [1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]];
const AWAY: [f64; 3] = [2.2, 4.0, 6.0];

/// Draws all places. `at` tells where a point of a piece lies in the drawing, millimetres.
pub(super) fn draw(canvas: &mut Canvas, spots: &[Spot<'_>], size: f64, at: impl Fn(usize, Vec2) -> Option<Vec2>) {
    let mut labels = Labels::default();
    let all = spots.iter().flat_map(|s| s.points).filter_map(|(p, q)| at(*p, *q));
    all.for_each(|q| labels.take(q, size, "0"));
    for spot in spots {
        canvas.open_as(spot.pick, if spot.label.is_empty() { "found quiet" } else { "found" });
        for (piece, line) in spot.lines {
            let points: Vec<Vec2> = line.iter().filter_map(|q| at(*piece, *q)).collect();
            canvas.line("line", &points, false);
        }
        for place in spot.points.iter().filter_map(|(p, q)| at(*p, *q)) {
            pin(canvas, &mut labels, place, size, spot.label);
        }
        canvas.close();
    }
}

/// A dot on the place, and beside it the number; without a number a ring around the place.
fn pin(canvas: &mut Canvas, labels: &mut Labels, place: Vec2, size: f64, label: &str) {
    canvas.dot("dot", place, 0.45 * size);
    if label.is_empty() {
        return;
    }
    let beside = AWAY.iter().flat_map(|far| WAYS.map(|[x, y]| place + Vec2::new(x, y) * (far * size)));
    let ways: Vec<Vec2> = beside.collect();
    let Some(at) = labels.place(&ways, &[(0.0, 1.8 * size, "00")]) else { return };
    canvas.line("lead", &[place, at], false);
    canvas.dot("pin", at, 1.15 * size);
    canvas.text("number", at, 1.3 * size, label);
}

/// The rectangle that all pins lie in, around a sheet.
pub(super) fn room(sheet: Bounds, spots: &[Spot<'_>], size: f64) -> Bounds {
    if spots.iter().all(|s| s.label.is_empty()) { sheet } else { sheet.grown(3.0 * size) }
}
