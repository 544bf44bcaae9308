//! Nearest points and distances of primitives.

use crate::Vec3;

/// Barycentric weights of the point of triangle `abc` nearest to `p` (Ericson, Real-Time Collision Detection, section
/// 5.1.5).
#[inline]
pub(crate) fn point_triangle(p: &Vec3, a: &Vec3, b: &Vec3, c: &Vec3) -> [f64; 3] {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(&ap), ac.dot(&ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(&bp), ac.dot(&bp));
    if d3 >= 0.0 && d4 <= d3 {
        return [0.0, 1.0, 0.0];
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let t = ratio(d1, d1 - d3);
        return [1.0 - t, t, 0.0];
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(&cp), ac.dot(&cp));
    if d6 >= 0.0 && d5 <= d6 {
        return [0.0, 0.0, 1.0];
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let t = ratio(d2, d2 - d6);
        return [1.0 - t, 0.0, t];
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        let t = ratio(d4 - d3, (d4 - d3) + (d5 - d6));
        return [0.0, 1.0 - t, t];
    }
    let sum = va + vb + vc;
    if sum <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let (v, w) = (vb / sum, vc / sum);
    [1.0 - v - w, v, w]
}

#[inline]
fn ratio(a: f64, b: f64) -> f64 {
    if b > 0.0 { (a / b).clamp(0.0, 1.0) } else { 0.0 }
}

/// Parameters (0 to 1) of the nearest points of segments `p0p1` and `q0q1`. Parallel segments start from the middle
/// of the first.
#[inline]
pub(crate) fn segments(p0: &Vec3, p1: &Vec3, q0: &Vec3, q1: &Vec3) -> [f64; 2] {
    let (d1, d2, r) = (p1 - p0, q1 - q0, p0 - q0);
    let (a, e, f) = (d1.norm_squared(), d2.norm_squared(), d2.dot(&r));
    let (b, c) = (d1.dot(&d2), d1.dot(&r));
    let den = a * e - b * b;
    let mut s = if den > 1e-12 * a * e { ((b * f - c * e) / den).clamp(0.0, 1.0) } else { 0.5 };
    let mut t = if e > 0.0 { (b * s + f) / e } else { 0.0 };
    if !(0.0..=1.0).contains(&t) {
        t = t.clamp(0.0, 1.0);
        s = if a > 0.0 { ((b * t - c) / a).clamp(0.0, 1.0) } else { 0.0 };
    }
    [s, t]
}

/// Distance of a point from a triangle, m.
#[inline]
pub(crate) fn point_triangle_gap(p: &Vec3, [a, b, c]: [&Vec3; 3]) -> f64 {
    let w = point_triangle(p, a, b, c);
    (p - (a * w[0] + b * w[1] + c * w[2])).norm()
}

/// Distance of two segments, m.
#[inline]
pub(crate) fn segment_gap([p, q]: [&Vec3; 2], [r, s]: [&Vec3; 2]) -> f64 {
    let [t, u] = segments(p, q, r, s);
    (p + (q - p) * t - (r + (s - r) * u)).norm()
}

/// A lower bound of the distance of a triangle from a plane through `at` with a unit normal, m; 0 where they meet.
#[inline]
pub(crate) fn plane_gap(at: &Vec3, normal: &Vec3, t: &[Vec3; 3]) -> f64 {
    let height = t.map(|p| normal.dot(&(p - at)));
    let (low, high) = (height[0].min(height[1]).min(height[2]), height[0].max(height[1]).max(height[2]));
    low.max(-high).max(0.0)
}
