//! Pendulums: a rod from any angle, and a limp sheet or chain in its first small swing.

use super::{G, root};
use std::f64::consts::{PI, TAU};

/// Period of a thin rod of length `l` (m) held at one end and let go at `angle` (rad) from the vertical, s:
/// `4 √(2l/3g) K(sin²(angle/2))`.
pub fn rod(l: f64, angle: f64) -> f64 {
    4.0 * (2.0 * l / (3.0 * G)).sqrt() * elliptic(libm::sin(0.5 * angle))
}

/// Complete elliptic integral of the first kind of the modulus k, by Gauss's mean of 1 and √(1 − k²).
fn elliptic(k: f64) -> f64 {
    let (mut a, mut b) = (1.0, (1.0 - k * k).sqrt());
    for _ in 0..8 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    PI / (2.0 * a)
}

/// Bessel's J₀ by its series, for small x.
fn j0(x: f64) -> f64 {
    let term = |(sum, t): (f64, f64), k: i32| (sum + t, -t * 0.25 * x * x / f64::from(k * k));
    (1..30).fold((0.0, 1.0), term).0
}

fn first_zero() -> f64 {
    root(2.0, 3.0, j0)
}

/// Period of the first swing of a limp sheet of length `l` (m), s: ω = j₀₁/2 √(g/l).
pub fn limp(l: f64) -> f64 {
    TAU / (0.5 * first_zero() * (G / l).sqrt())
}

/// Shape of that swing, 1 at the free end; `z`: height over it in lengths.
pub fn limp_shape(z: f64) -> f64 {
    j0(first_zero() * z.sqrt())
}
