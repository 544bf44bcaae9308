//! One edge as points: straight, Bézier or an arc of a circle.

use super::spec::Curve;
use crate::dxf::geom::rotate;
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
        Curve::Bezier(list) => {
            let mut hull = vec![a];
            hull.extend(list.iter().map(control));
            hull.push(b);
            let n = chords(&hull, flatness);
            Ok((0..n).map(|k| bezier(&hull, k as f64 / n as f64)).collect())
        }
        Curve::Arc { radius, large, right } => arc(a, b, *radius, *large, *right, flatness),
    }
}

/// De Casteljau.
fn bezier(hull: &[Vec2], t: f64) -> Vec2 {
    let mut d = hull.to_vec();
    for r in 1..d.len() {
        for i in 0..d.len() - r {
            d[i] = d[i] * (1.0 - t) + d[i + 1] * t;
        }
    }
    d[0]
}

/// Equal steps so that every chord keeps within `flatness`: the second difference of the hull bounds the bend.
fn chords(hull: &[Vec2], flatness: f64) -> usize {
    let degree = (hull.len() - 1) as f64;
    let bend = hull.windows(3).map(|w| (w[0] - w[1] * 2.0 + w[2]).norm()).fold(0.0, f64::max);
    let n = libm::ceil(libm::sqrt(degree * (degree - 1.0) * bend / (8.0 * flatness.max(1e-9))));
    if n.is_finite() { (n as usize).clamp(4, CHORDS) } else { CHORDS }
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
