//! The strokes and texts of one piece, millimetres in its own coordinates.

use super::{Label, Layer, Stroke};
use toile_garment::dart::DartKind;
use toile_garment::notch::{Notch, NotchKind};
use toile_garment::outline::PieceLine;
use toile_garment::{Piece, Vec2};

const MM: f64 = 1e3;
/// Arms of a cross at a drill hole, mm.
const CROSS: f64 = 3.0;
/// Depth of a notch that has none, mm.
const NOTCH: f64 = 4.0;
/// Length of the arrow heads of a grain line, mm.
const ARROW: f64 = 8.0;

/// All strokes of a piece.
pub fn strokes(piece: &Piece) -> Vec<Stroke> {
    let mut out = Vec::new();
    let cut = piece.cut_line.as_ref().unwrap_or(&piece.outline);
    out.push(line(Layer::Cut, cut));
    out.extend(piece.cutouts.iter().map(|l| line(Layer::Cut, l)));
    if piece.cut_line.is_some() {
        out.push(line(Layer::Sew, &piece.outline));
    }
    out.extend(piece.internal_lines.iter().map(|l| line(Layer::Internal, l)));
    out.extend(piece.match_lines.iter().filter(|l| l.points.len() > 1).map(|l| line(Layer::Grain, l)));
    for dart in piece.darts.iter().filter(|d| d.kind != DartKind::Wedge) {
        out.extend(dart.legs.iter().map(|leg| open(Layer::Dart, leg.iter().map(|p| p * MM))));
    }
    out.extend(piece.notches.iter().flat_map(|n| notch(n, cut)));
    for hole in &piece.drill_holes {
        let (p, a) = (hole.at * MM, hole.diameter.map_or(CROSS, |d| (d * MM * 0.5).max(1.0)));
        out.push(open(Layer::Drill, [p - Vec2::new(a, 0.0), p + Vec2::new(a, 0.0)]));
        out.push(open(Layer::Drill, [p - Vec2::new(0.0, a), p + Vec2::new(0.0, a)]));
    }
    out.extend(piece.grain.iter().flat_map(|g| arrow(g.map(|p| p * MM))));
    out.extend(piece.fold.iter().map(|f| open(Layer::Grain, f.map(|p| p * MM))));
    out.retain(|s| s.points.len() > 1 && s.points.iter().all(|p| p.x.is_finite() && p.y.is_finite()));
    out
}

/// Name, size and quantity in the middle of a piece.
pub fn label(piece: &Piece, middle: Vec2, room: f64) -> Label {
    let mut text = piece.name.clone();
    if let Some(size) = piece.size.as_deref().filter(|s| !piece.name.ends_with(&format!("@{s}"))) {
        text.push_str(&format!("  {size}"));
    }
    let (plain, mirrored) = (piece.quantity.plain, piece.quantity.mirrored);
    text.push_str(&if mirrored > 0 { format!("  {plain} + {mirrored}×") } else { format!("  {plain}×") });
    let height = (room / (text.chars().count().max(1) as f64)).clamp(2.0, 8.0);
    Label { at: middle, height, text }
}

fn line(layer: Layer, line: &PieceLine) -> Stroke {
    Stroke { layer, points: line.points.iter().map(|p| p.at * MM).collect(), closed: line.closed }
}

fn open(layer: Layer, points: impl IntoIterator<Item = Vec2>) -> Stroke {
    Stroke { layer, points: points.into_iter().collect(), closed: false }
}

/// A notch as it is cut: a slit, or the two sides of a V; other kinds as the V that covers them.
fn notch(notch: &Notch, cut: &PieceLine) -> Vec<Stroke> {
    let at = notch.at * MM;
    let depth = if notch.depth.abs() > 1e-4 { notch.depth.abs() * MM } else { NOTCH };
    let inward = notch.angle.map_or_else(
        || {
            let middle = cut.points.iter().map(|p| p.at).sum::<Vec2>() / cut.points.len().max(1) as f64;
            let d = middle * MM - at;
            d / d.norm().max(1e-9)
        },
        |a| {
            let (s, c) = libm::sincos(a);
            Vec2::new(c, s)
        },
    );
    let across = Vec2::new(-inward.y, inward.x) * (0.5 * notch.width.abs() * MM);
    let tip = at + inward * depth;
    if notch.kind == NotchKind::Slit || across.norm() < 0.1 {
        return vec![open(Layer::Notch, [at, tip])];
    }
    vec![open(Layer::Notch, [at - across, tip, at + across])]
}

fn arrow([a, b]: [Vec2; 2]) -> Vec<Stroke> {
    let along = (b - a) / (b - a).norm().max(1e-9) * ARROW;
    let across = Vec2::new(-along.y, along.x) * 0.35;
    vec![
        open(Layer::Grain, [a, b]),
        open(Layer::Grain, [b - along + across, b, b - along - across]),
        open(Layer::Grain, [a + along + across, a, a + along - across]),
    ]
}
