//! A clamped strip pressed on a rough floor.

use super::{rk4, root};

/// Compression δ/L at which the tip slips: the force on it then leans by atan μ. From the tip, with unit force and
/// rigidity: `θ'' = −sin(θ − ψ)`, θ to the vertical; the clamp is where θ is 0 for the second time, straight above the
/// tip.
pub fn compression(mu: f64) -> f64 {
    let bow = bow(libm::atan(mu));
    let end = bow[bow.len() - 1];
    1.0 - end[2] / end[0]
}

/// The bow of length 1 at a compression: sideways place and height over the tip, by the arc from the clamp.
pub fn shape(delta: f64) -> impl Fn(f64) -> [f64; 2] {
    let lean = root(1e-3, 0.6, |mu| compression(mu) - delta);
    let bow = bow(libm::atan(lean));
    let [length, side, height] = bow[bow.len() - 1];
    move |s: f64| {
        let from_tip = (1.0 - s.max(0.0)).max(0.0) * length;
        let i = bow.partition_point(|p| p[0] < from_tip).clamp(1, bow.len() - 1);
        let (a, b) = (bow[i - 1], bow[i]);
        let t = (from_tip - a[0]) / (b[0] - a[0]);
        let at = |k: usize| (a[k] + t * (b[k] - a[k])) / length;
        // What lies behind the clamp stands straight.
        [at(1) - if s < 0.0 { at(1) - side / length } else { 0.0 }, if s < 0.0 { height / length - s } else { at(2) }]
    }
}

/// Arc, sideways place and height from the tip to the clamp when the force leans by ψ.
fn bow(psi: f64) -> Vec<[f64; 3]> {
    let tip = root(0.02, 2.2, |tip| to_clamp(tip, psi).last().map_or(f64::NAN, |p| p[1]));
    to_clamp(tip, psi)
}

fn to_clamp(tip: f64, psi: f64) -> Vec<[f64; 3]> {
    let h = 2e-3;
    let f = |_: f64, y: [f64; 4]| [y[1], -libm::sin(y[0] - psi), libm::sin(y[0]), libm::cos(y[0])];
    let mut y = [tip + psi, 0.0, 0.0, 0.0];
    let (mut s, mut zeros) = (0.0, 0);
    let mut points = vec![[0.0; 3]];
    while s < 60.0 {
        let next = rk4(y, s, h, &f);
        if next[0] * y[0] < 0.0 {
            zeros += 1;
            if zeros == 2 {
                let part = root(0.0, h, |d| rk4(y, s, d, &f)[0] * next[0].signum());
                let end = rk4(y, s, part, &f);
                points.push([s + part, end[2], end[3]]);
                return points;
            }
        }
        (y, s) = (next, s + h);
        points.push([s, y[2], y[3]]);
    }
    points
}
