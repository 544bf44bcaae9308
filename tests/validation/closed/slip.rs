//! A clamped strip pressed on a rough floor.

use super::{rk4, root};

/// Compression δ/L at which the tip slips: the force on it then leans by atan μ. From the tip, with unit force and
/// rigidity: `θ'' = −sin(θ − ψ)`, θ to the vertical; the clamp is where θ is 0 for the second time, straight above the tip.
pub fn compression(mu: f64) -> f64 {
    let psi = libm::atan(mu);
    let tip = root(0.02, 2.2, |tip| to_clamp(tip, psi).0);
    let (_, height, length) = to_clamp(tip, psi);
    1.0 - height / length
}

/// Sideways place, height and length at the clamp.
fn to_clamp(tip: f64, psi: f64) -> (f64, f64, f64) {
    let h = 1e-3;
    let f = |_: f64, y: [f64; 4]| [y[1], -libm::sin(y[0] - psi), libm::sin(y[0]), libm::cos(y[0])];
    let mut y = [tip + psi, 0.0, 0.0, 0.0];
    let (mut s, mut zeros) = (0.0, 0);
    while s < 60.0 {
        let next = rk4(y, s, h, &f);
        if next[0] * y[0] < 0.0 {
            zeros += 1;
            if zeros == 2 {
                let part = root(0.0, h, |d| rk4(y, s, d, &f)[0] * next[0].signum());
                let end = rk4(y, s, part, &f);
                return (end[2], end[3], s + part);
            }
        }
        (y, s) = (next, s + h);
    }
    (f64::NAN, f64::NAN, f64::NAN)
}
