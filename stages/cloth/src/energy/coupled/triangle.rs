//! One triangle spring: strain, stress, energy and tangent from the lengths of its edges (docs/coupled.md).

use crate::energy::law::Fabric;
use crate::energy::strain_limit::Bias;
use crate::{Element, Vec3};
use nalgebra::Matrix3;

/// Least stretch at which the shear law is evaluated, so that it stays finite near collapse.
pub(crate) const SHEAR_STRETCH_MIN: f64 = 0.25;
/// Sine of the shear angle up to which a series gives the angle.
pub(crate) const SHEAR_SERIES_SINE_MAX: f64 = 0.3;
/// Sine of the shear angle from which the angle is continued in a straight line.
pub(crate) const SHEAR_SINE_MAX: f64 = 0.8;

/// A triangle in its rest state.
pub(crate) struct Triangle {
    pub vertices: [u32; 3],
    pub fabric: u32,
    pub area: f64,
    /// Half the squared rest length of each edge.
    pub half: [f64; 3],
    /// Green strain (E_weft, E_warp, 2 E_12) = inverse · q.
    pub inverse: [[f64; 3]; 3],
}

/// Strain state of a triangle.
pub(crate) struct Strain {
    /// Stretch (1 = rest) along weft and warp.
    pub stretch: [f64; 2],
    /// Sine of the shear angle.
    pub sine: f64,
    /// Green strain of the bias direction that is stretched more.
    pub bias: f64,
}

impl Triangle {
    pub fn new(e: &Element) -> Self {
        let edge = |k: usize| {
            let (a, b) = (e.rest[k], e.rest[(k + 1) % 3]);
            [b[0] - a[0], b[1] - a[1]]
        };
        let rows = [0, 1, 2].map(|k| {
            let [x, y] = edge(k);
            [x * x, y * y, x * y]
        });
        let half = [0, 1, 2].map(|k| {
            let [x, y] = edge(k);
            0.5 * (x * x + y * y)
        });
        Self { vertices: e.vertices, fabric: e.material, area: e.area().abs(), half, inverse: inverse(&rows) }
    }

    #[inline]
    pub fn edges(&self, x: &[Vec3]) -> [Vec3; 3] {
        let [a, b, c] = crate::pick3(x, &self.vertices);
        [b - a, c - b, a - c]
    }

    #[inline]
    pub fn green(&self, e: &[Vec3; 3]) -> [f64; 3] {
        let q0 = 0.5 * e[0].norm_squared() - self.half[0];
        let q1 = 0.5 * e[1].norm_squared() - self.half[1];
        let q2 = 0.5 * e[2].norm_squared() - self.half[2];
        let row = |m: &[f64; 3]| m[0] * q0 + m[1] * q1 + m[2] * q2;
        [row(&self.inverse[0]), row(&self.inverse[1]), row(&self.inverse[2])]
    }
}

fn inverse(m: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let a = Matrix3::from_fn(|r, c| m[r][c]);
    // A triangle with area has independent edge directions, so the inverse exists.
    let i = a.try_inverse().unwrap_or_else(Matrix3::zeros);
    [0, 1, 2].map(|r| [i[(r, 0)], i[(r, 1)], i[(r, 2)]])
}

pub(crate) fn strain(green: &[f64; 3]) -> Strain {
    let a = (1.0 + 2.0 * green[0]).max(0.0).sqrt();
    let b = (1.0 + 2.0 * green[1]).max(0.0).sqrt();
    let sine = green[2] / (a.max(SHEAR_STRETCH_MIN) * b.max(SHEAR_STRETCH_MIN));
    Strain { stretch: [a, b], sine, bias: Bias::largest(*green) }
}

/// Shear angle of a small sine and its derivative.
#[inline(always)]
pub(crate) fn series_angle(sine: f64) -> (f64, f64) {
    let q = sine * sine;
    let g = 1.0 + q * (1.0 / 6.0 + q * (3.0 / 40.0 + q * (15.0 / 336.0 + q * (105.0 / 3456.0 + q * 945.0 / 42240.0))));
    (sine * g, 1.0 / (1.0 - q).sqrt())
}

/// Shear angle of a sine and its derivative; an even continuation where the cloth would lock.
#[inline]
pub(crate) fn angle(sine: f64) -> (f64, f64) {
    let s = sine.abs();
    if s < SHEAR_SERIES_SINE_MAX {
        return series_angle(sine);
    }
    if s < SHEAR_SINE_MAX {
        return (libm::asin(sine), 1.0 / (1.0 - sine * sine).sqrt());
    }
    let slope = 1.0 / (1.0 - SHEAR_SINE_MAX * SHEAR_SINE_MAX).sqrt();
    ((libm::asin(SHEAR_SINE_MAX) + slope * (s - SHEAR_SINE_MAX)).copysign(sine), slope)
}

/// Stress conjugate to (E_weft, E_warp, 2 E_12), N/m.
#[inline]
fn stress(green: &[f64; 3], fabric: &Fabric) -> [f64; 3] {
    stress_and_energy(green, fabric).0
}

/// Stress conjugate to (E_weft, E_warp, 2 E_12), N/m, and energy per area, J/m².
#[inline]
pub(crate) fn stress_and_energy(green: &[f64; 3], fabric: &Fabric) -> ([f64; 3], f64) {
    let (mut stress, mut energy) = unlocked(green, fabric);
    for p in fabric.bias.pulls(green) {
        (0..3).for_each(|k| stress[k] += p.stress * p.by[k]);
        energy += p.energy;
    }
    (stress, energy)
}

/// Stress and energy without the locks of the bias.
#[inline]
fn unlocked(green: &[f64; 3], fabric: &Fabric) -> ([f64; 3], f64) {
    let s = strain(green);
    let [a, b] = s.stretch;
    let (am, bm) = (a.max(SHEAR_STRETCH_MIN), b.max(SHEAR_STRETCH_MIN));
    let ((weft, e), (warp, g)) = (fabric.weft.tension_and_energy(a - 1.0), fabric.warp.tension_and_energy(b - 1.0));
    let (gamma, slope) = angle(s.sine);
    let energy = e + g + fabric.cross * (a - 1.0) * (b - 1.0) + 0.5 * fabric.shear * gamma * gamma;
    let tau = fabric.shear * gamma * slope;
    let weft = (weft + fabric.cross * (b - 1.0)) / a.max(1e-3);
    let warp = (warp + fabric.cross * (a - 1.0)) / b.max(1e-3);
    let lean = tau * s.sine;
    let stress = [
        if a > SHEAR_STRETCH_MIN { weft - lean / (am * am) } else { weft },
        if b > SHEAR_STRETCH_MIN { warp - lean / (bm * bm) } else { warp },
        tau / (am * bm),
    ];
    (stress, energy)
}

/// Stress and its derivative by (E_weft, E_warp, 2 E_12); where `convex`, without the terms that can be negative.
pub(crate) fn tangent(green: &[f64; 3], fabric: &Fabric, convex: bool) -> ([f64; 3], Matrix3<f64>) {
    let s = strain(green);
    let [a, b] = s.stretch;
    let (am, bm) = (a.max(SHEAR_STRETCH_MIN), b.max(SHEAR_STRETCH_MIN));
    let (gamma, slope) = angle(s.sine);
    // Second derivative of the angle by its sine.
    let bow = if s.sine.abs() < SHEAR_SINE_MAX { s.sine * slope * slope * slope } else { 0.0 };
    let tau = fabric.shear * gamma * slope;
    let rate = fabric.shear * (slope * slope + if convex { 0.0 } else { gamma * bow });
    let (ka, kb) = (fabric.weft.slope(a - 1.0), fabric.warp.slope(b - 1.0));
    let (ai, bi) = (1.0 / a.max(1e-3), 1.0 / b.max(1e-3));
    let (da, db) = (
        if a > SHEAR_STRETCH_MIN { s.sine / (am * am) } else { 0.0 },
        if b > SHEAR_STRETCH_MIN { s.sine / (bm * bm) } else { 0.0 },
    );
    let v = nalgebra::Vector3::new(-da, -db, 1.0 / (am * bm));
    let mut d = v * v.transpose() * rate;
    d[(0, 0)] += ka * ai * ai;
    d[(1, 1)] += kb * bi * bi;
    d[(0, 1)] += fabric.cross * ai * bi;
    d[(1, 0)] += fabric.cross * ai * bi;
    if !convex {
        let (pull_a, pull_b) = (
            fabric.weft.tension(a - 1.0) + fabric.cross * (b - 1.0),
            fabric.warp.tension(b - 1.0) + fabric.cross * (a - 1.0),
        );
        d[(0, 0)] += 3.0 * tau * da * ai * ai - pull_a * ai * ai * ai;
        d[(1, 1)] += 3.0 * tau * db * bi * bi - pull_b * bi * bi * bi;
        let mixed = [
            (0, 1, tau * s.sine * ai * ai * bi * bi),
            (0, 2, -tau * ai * ai * ai * bi),
            (1, 2, -tau * ai * bi * bi * bi),
        ];
        for (i, j, m) in mixed {
            d[(i, j)] += m;
            d[(j, i)] += m;
        }
    }
    for p in fabric.bias.pulls(green) {
        d += p.by * p.by.transpose() * if convex { p.slope } else { p.slope + p.turning };
    }
    (stress(green, fabric), d)
}

/// The tensile part of a plane stress: negative principal values are set to 0.
pub(crate) fn tensile_part(s: &[f64; 3]) -> [f64; 3] {
    let (mean, half, shear) = (0.5 * (s[0] + s[1]), 0.5 * (s[0] - s[1]), s[2]);
    let r = (half * half + shear * shear).sqrt();
    let (high, low) = ((mean + r).max(0.0), (mean - r).max(0.0));
    if r <= 0.0 {
        return [high, high, 0.0];
    }
    let (m, q) = (0.5 * (high + low), 0.5 * (high - low) / r);
    [m + q * half, m - q * half, q * shear]
}

impl Triangle {
    /// Largest eigenvalue of the triangle's stiffness over a third of its area, N/m³.
    pub fn rate(w: &[[f64; 2]; 3], weft: f64, warp: f64, cross: f64, shear: f64) -> f64 {
        let sum = |f: &dyn Fn([f64; 2]) -> f64| w.iter().map(|v| f(*v)).sum::<f64>();
        let (uu, vv, uv) = (sum(&|g| g[0] * g[0]), sum(&|g| g[1] * g[1]), sum(&|g| g[0] * g[1]));
        let law = Matrix3::new(weft, cross, 0.0, cross, warp, 0.0, 0.0, 0.0, shear);
        let geometry = Matrix3::new(uu, 0.0, uv, 0.0, vv, uv, uv, uv, uu + vv);
        largest(&(law * geometry)) * 3.0
    }
}

/// Largest eigenvalue of a 3 × 3 product of two positive semi-definite matrices, by power iteration from above.
fn largest(m: &Matrix3<f64>) -> f64 {
    let mut v = nalgebra::Vector3::new(1.0, 0.9, 0.4);
    let mut value = 0.0;
    for _ in 0..12 {
        let w = m * v;
        value = w.norm();
        if value <= 0.0 {
            return 0.0;
        }
        v = w / value;
    }
    value * 1.02
}
