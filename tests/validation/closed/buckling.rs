//! Strips near their buckling load: how far a small side load moves them, and where that grows without bound.

use super::{rk4, root};

const STEPS: usize = 2000;

/// An upright strip, Γ = w L³/B: tip displacement over L per `f = F L²/B`: `θ'' = −Γ (1 − s) θ − f`, θ(0) = 0, θ'(1) =
/// 0.
pub fn upright(gamma: f64) -> f64 {
    let (a, b) = upright_ends(gamma);
    // θ'(0) = k makes the slope of the bend at the tip vanish.
    let k = -b[1] / a[1];
    k * a[2] + b[2]
}

/// Solutions with θ'(0) = 1, f = 0 and θ'(0) = 0, f = 1: θ, θ', ∫θ at the tip.
fn upright_ends(gamma: f64) -> ([f64; 3], [f64; 3]) {
    let h = 1.0 / STEPS as f64;
    let run = |slope: f64, load: f64| {
        let f = |s: f64, y: [f64; 3]| [y[1], -gamma * (1.0 - s) * y[0] - load, y[0]];
        (0..STEPS).fold([0.0, slope, 0.0], |y, i| rk4(y, i as f64 * h, h, &f))
    };
    (run(1.0, 0.0), run(0.0, 1.0))
}

/// Γ at which an upright strip buckles.
pub fn upright_critical() -> f64 {
    root(4.0, 12.0, |g| upright_ends(g).0[1])
}

/// A strip on edge, held at one end; `x = q L³/√(EI GJ)`.
///
/// The tip displacement to the side over L belongs to `f = P L²/EI`.
/// `β'' = −m (m β − p)`, `v'' = −√… m β + p` with m = x (1 − s)²/2, p = f (1 − s), β scaled by √(GJ/EI).
pub fn on_edge(x: f64) -> f64 {
    let (a, b) = on_edge_ends(x);
    let k = -b[1] / a[1];
    k * a[3] + b[3]
}

fn on_edge_ends(x: f64) -> ([f64; 4], [f64; 4]) {
    let h = 1.0 / STEPS as f64;
    let run = |slope: f64, load: f64| {
        let f = |s: f64, y: [f64; 4]| {
            let (m, p) = (0.5 * x * (1.0 - s) * (1.0 - s), load * (1.0 - s));
            [y[1], m * (p - m * y[0]), p - m * y[0], y[2]]
        };
        (0..STEPS).fold([0.0, slope, 0.0, 0.0], |y, i| rk4(y, i as f64 * h, h, &f))
    };
    (run(1.0, 0.0), run(0.0, 1.0))
}

/// `q L³/√(EI GJ)` at which a strip on edge buckles to the side.
pub fn on_edge_critical() -> f64 {
    root(8.0, 18.0, |x| on_edge_ends(x).0[1])
}
