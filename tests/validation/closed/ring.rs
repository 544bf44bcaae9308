//! Strips held at one end that ring along themselves and across, without gravity.

use super::root;
use std::f64::consts::PI;

/// ω of the first mode along a strip, 1/s: `(π/2) √(K/σ)/l`; its shape is `sin(π s/2l)`.
pub fn along(l: f64, k: f64, sigma: f64) -> f64 {
    0.5 * PI * (k / sigma).sqrt() / l
}

/// The same of `n` springs with lumped masses, half a mass at the end: `(2/h) √(K/σ) sin(π/4n)`, h = l/n.
pub fn along_springs(l: f64, k: f64, sigma: f64, n: usize) -> f64 {
    let n = n as f64;
    2.0 * n / l * (k / sigma).sqrt() * libm::sin(PI / (4.0 * n))
}

/// β l of the first mode of a clamped beam: `cos x cosh x = −1`.
fn clamped() -> f64 {
    root(1.0, 3.0, |x| libm::cos(x) * libm::cosh(x) + 1.0)
}

/// ω of the first mode across a strip of rigidity `b` (N·m), 1/s: `(β l)² √(B/σ)/l²` (Euler, Bernoulli).
pub fn across(l: f64, b: f64, sigma: f64) -> f64 {
    clamped() * clamped() * (b / sigma).sqrt() / (l * l)
}

/// Shape of that mode; `s`: distance from the clamp in lengths.
pub fn across_shape(s: f64) -> f64 {
    let x = clamped();
    let r = (libm::cosh(x) + libm::cos(x)) / (libm::sinh(x) + libm::sin(x));
    let u = x * s;
    libm::cosh(u) - libm::cos(u) - r * (libm::sinh(u) - libm::sin(u))
}
