//! Perturbations of a start: of a coarser level, to break its symmetry, and of a scene, to see how far its rests lie apart.
//!
//! Even cloth (a cone, a disc, a square) begins on a saddle between all the ways in which it may fold. By rounding
//! alone it leaves the saddle late: 40,000 triangles took twice the steps on both levels. With a little noise in all
//! directions it leaves at once. The folds that it then finds differ by less than half a percent in energy
//! (docs/book/src/solver.md).

use crate::Scene;
use crate::hierarchy::tuning::{PERTURBATION, PERTURBATION_AMPLITUDE};
use crate::scene::measures::mean_edge;

/// Moves every vertex that is not held, the same way in every run.
///
/// Cloth without weight is left alone, because it lies on no such saddle. A strip drawn in the bias would only leave
/// its plane.
pub(crate) fn perturb(level: &mut Scene) {
    if level.gravity.norm() == 0.0 || !PERTURBATION.is_on() {
        return;
    }
    let far = PERTURBATION_AMPLITUDE.get() * mean_edge(level);
    move_freely(level, far, 0);
}

/// The scene with every vertex that nothing holds moved by up to `far` metres along each axis. Each `draw` moves them
/// otherwise, and the same one moves them the same way on every machine.
#[must_use]
pub fn shaken(scene: &Scene, far: f64, draw: u32) -> Scene {
    let mut out = scene.clone();
    move_freely(&mut out, far, draw);
    out
}

fn move_freely(scene: &mut Scene, far: f64, draw: u32) {
    let mut held = vec![false; scene.positions.len()];
    scene.pins.iter().for_each(|p| held[p.vertex as usize] = true);
    let first = draw.wrapping_mul(0x0100_0193);
    for (v, (x, held)) in (0u32..).zip(scene.positions.iter_mut().zip(held)) {
        if !held {
            (0..3).for_each(|k| x[k as usize] += far * noise(first.wrapping_add(3 * v + k)));
        }
    }
}

/// Noise from −1 to 1, by a hash of the number; neighbouring numbers are uncorrelated.
///
/// A rounded multiple of the golden ratio would move the cloth in waves, and left the saddle as late as rounding.
fn noise(i: u32) -> f64 {
    let mut bits = i.wrapping_add(1).wrapping_mul(0x9E37_79B9);
    for factor in [0x7FEB_352D, 0x846C_A68B] {
        bits = (bits ^ bits >> 16).wrapping_mul(factor);
        bits ^= bits >> 15;
    }
    f64::from(bits ^ bits >> 16) / f64::from(u32::MAX) * 2.0 - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_has_no_mean_and_its_neighbours_are_uncorrelated() {
        let n = 30_000u32;
        let mean = |of: &dyn Fn(u32) -> f64| (0..n).map(of).sum::<f64>() / f64::from(n);
        assert!(mean(&noise).abs() < 0.02);
        assert!((mean(&|i| noise(i) * noise(i)) - 1.0 / 3.0).abs() < 0.01);
        for apart in [1, 2, 3, 6, 90] {
            assert!(mean(&|i| noise(i) * noise(i + apart)).abs() < 0.01, "{apart}");
        }
    }
}
