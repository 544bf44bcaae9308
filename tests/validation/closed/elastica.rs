//! The heavy elastica: `θ'' = −Γ (1 − s) cos θ`, `θ(0) = 0`, `θ'(1) = 0`, lengths over L, Γ = w L³/B.

use super::{rk4, root};
use std::f64::consts::FRAC_PI_2;

const STEPS: usize = 4000;

/// A cantilever under its own weight, in lengths.
#[derive(Clone, Copy, Debug)]
pub struct Cantilever {
    /// Drop of the tip.
    pub drop: f64,
    /// Reach of the tip.
    pub reach: f64,
}

impl Cantilever {
    pub fn ratio(&self) -> f64 {
        self.drop / self.reach
    }
}

/// From the free end, φ = π/2 − θ: `φ'' = Γ u sin φ`. Starting from a small φ it grows like a whip, so the start is
/// sought on its logarithm.
pub fn cantilever(gamma: f64) -> Cantilever {
    let shoot = |log: f64| {
        let h = 1.0 / STEPS as f64;
        let f = |u: f64, y: [f64; 4]| [y[1], gamma * u * libm::sin(y[0]), libm::cos(y[0]), libm::sin(y[0])];
        let mut y = [libm::exp(log), 0.0, 0.0, 0.0];
        for i in 0..STEPS {
            y = rk4(y, i as f64 * h, h, &f);
            if y[0] > 4.0 {
                break;
            }
        }
        y
    };
    let log = root(-200.0, libm::log(FRAC_PI_2), |log| shoot(log)[0] - FRAC_PI_2);
    let y = shoot(log);
    Cantilever { drop: y[2], reach: y[3] }
}

/// The same with a frictional couple that has built up at the curvature `rise`/L: the moment is `B κ + HB min(1, κ
/// L/rise)`; `couple` is HB L/B (Grosberg 1966, rise 0). Sought by the slope of the free end.
pub fn rubbing(gamma: f64, couple: f64, rise: f64) -> Cantilever {
    let curvature = |m: f64| if m < rise + couple { m * rise / (rise + couple) } else { m - couple };
    let shoot = |slope: f64| {
        let h = 1.0 / STEPS as f64;
        let f = |u: f64, y: [f64; 4]| [-curvature(y[1]), gamma * u * libm::cos(y[0]), libm::cos(y[0]), libm::sin(y[0])];
        (0..STEPS).fold([slope, 0.0, 0.0, 0.0], |y, i| rk4(y, i as f64 * h, h, &f))
    };
    let y = shoot(root(0.0, FRAC_PI_2, |slope| shoot(slope)[0]));
    Cantilever { drop: y[3], reach: y[2] }
}

/// A cantilever that bends down by `curl`/L without load: the moment is `B (κ − curl/L)`. Sought by the slope of the free
/// end.
pub fn curled(gamma: f64, curl: f64) -> Cantilever {
    let shoot = |slope: f64| {
        let h = 1.0 / STEPS as f64;
        let f = |u: f64, y: [f64; 4]| [-y[1] - curl, gamma * u * libm::cos(y[0]), libm::cos(y[0]), libm::sin(y[0])];
        (0..STEPS).fold([slope, 0.0, 0.0, 0.0], |y, i| rk4(y, i as f64 * h, h, &f))
    };
    let y = shoot(root(-FRAC_PI_2, FRAC_PI_2 + curl.max(0.0), |slope| shoot(slope)[0]));
    Cantilever { drop: y[3], reach: y[2] }
}

/// Γ at which the chord from the clamp to the tip slopes by this angle.
pub fn gamma_at_chord(angle: f64) -> f64 {
    root(0.01, 1000.0, |g| cantilever(g).ratio() - libm::tan(angle))
}
