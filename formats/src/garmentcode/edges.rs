//! One edge as points: straight, Bézier or an arc of a circle.
//!
//! lyon flattens the Béziers, in `f64`. Arcs are turned here: lyon would ask the platform for sines and cosines.

use super::spec::Curve;
use crate::dxf::geom::rotate;
use lyon::geom::{CubicBezierSegment, LineSegment, Point, QuadraticBezierSegment};
use toile_garment::Vec2;

/// Most chords of an edge.
const CHORDS: usize = 2_000;

/// Points of an edge from `a` up to but without `b`. Lengths in one unit throughout.
///
/// # Errors
/// Why the curve is none.
pub fn points(a: Vec2, b: Vec2, curve: &Curve, relative: bool, flatness: f64) -> Result<Vec<Vec2>, String> {
    let control = |p: &Vec2| if relative { a + (b - a) * p.x + Vec2::new(a.y - b.y, b.x - a.x) * p.y } else { *p };
    match curve {
        Curve::Straight => Ok(vec![a]),
        Curve::Quadratic(p) => {
            let [from, ctrl, to] = [a, control(p), b].map(point);
            let curve = QuadraticBezierSegment { from, ctrl, to };
            Ok(chords(|chord| curve.for_each_flattened(tolerance(&[from, ctrl, to], flatness), &mut |c: &_| chord(c))))
        }
        Curve::Cubic(p, q) => {
            let [from, ctrl1, ctrl2, to] = [a, control(p), control(q), b].map(point);
            let curve = CubicBezierSegment { from, ctrl1, ctrl2, to };
            Ok(chords(|chord| {
                curve.for_each_flattened(tolerance(&[from, ctrl1, ctrl2, to], flatness), &mut |c: &_| chord(c))
            }))
        }
        Curve::Arc { radius, large, right } => arc(a, b, *radius, *large, *right, flatness),
    }
}

fn point(p: Vec2) -> Point<f64> {
    Point::new(p.x, p.y)
}

/// The flatness; for a curve of many metres so much more that its chords stay under [`CHORDS`].
fn tolerance(hull: &[Point<f64>], flatness: f64) -> f64 {
    let length: f64 = hull.windows(2).map(|w| (w[1] - w[0]).length()).sum();
    flatness.max(1e-6 * length).max(1e-9)
}

/// Where the chords of a flattened curve start.
fn chords(flatten: impl FnOnce(&mut dyn FnMut(&LineSegment<f64>))) -> Vec<Vec2> {
    let mut out = Vec::new();
    flatten(&mut |chord| out.push(Vec2::new(chord.from.x, chord.from.y)));
    out
}

/// An arc from `a` to `b`; `right`: counter-clockwise, so that it bulges to the right of the way.
fn arc(a: Vec2, b: Vec2, radius: f64, large: bool, right: bool, flatness: f64) -> Result<Vec<Vec2>, String> {
    let chord = b - a;
    let half = 0.5 * chord.norm();
    if radius < half * (1.0 - 1e-6) {
        return Err(format!("an arc of radius {radius} cannot span {}", 2.0 * half));
    }
    let height = libm::sqrt((radius * radius - half * half).max(0.0));
    let left = Vec2::new(-chord.y, chord.x) / chord.norm().max(1e-12);
    // The small arc that bulges to the right has its centre on the left.
    let side = if large == right { -1.0 } else { 1.0 };
    let center = (a + b) * 0.5 + left * (height * side);
    let small = 2.0 * libm::asin((half / radius).min(1.0));
    let sweep = if large { std::f64::consts::TAU - small } else { small } * if right { 1.0 } else { -1.0 };
    let step = 2.0 * libm::acos((1.0 - flatness / radius).clamp(-1.0, 1.0));
    let n = (libm::ceil(sweep.abs() / step.clamp(1e-4, 0.3)) as usize).clamp(2, CHORDS);
    let start = a - center;
    Ok((0..n).map(|k| center + rotate(start, sweep * k as f64 / n as f64)).collect())
}
