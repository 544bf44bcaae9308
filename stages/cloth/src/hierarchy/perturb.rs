//! How far the cloth of a coarser level is shaken before it comes to rest.
//!
//! Even cloth (a cone, a disc, a square) begins on a saddle between all the ways in which it may fold. What leaves it by rounding alone
//! leaves it late: with 40,000 triangles it took twice the steps on both levels. A little noise in all directions leaves it at once.
//! Which of the folds it then finds is another matter: they lie within half a percent of what falling wins (docs/book/src/solver.md).

use crate::Scene;
use crate::scene::measures::mean_edge;

/// Farthest along each axis, over the mean edge: about 0.06 mm. With 0.005 it takes as many steps, with 0.001, 0.01 and more from some
/// starts a third more.
const FAR: f64 = 3e-3;

/// Moves every vertex that is not held, the same way in every run. Cloth without weight, as in most tests of fabrics, lies on no such
/// saddle: a strip drawn in the bias would only be brought out of its plane.
pub(crate) fn shake(level: &mut Scene) {
    if level.gravity.norm() == 0.0 {
        return;
    }
    let far = FAR * mean_edge(level);
    let mut held = vec![false; level.positions.len()];
    level.pins.iter().for_each(|p| held[p.vertex as usize] = true);
    for (v, (x, held)) in (0u32..).zip(level.positions.iter_mut().zip(held)) {
        if !held {
            (0..3).for_each(|k| x[k as usize] += far * noise(3 * v + k));
        }
    }
}

/// From −1 to 1, without order: numbers next to each other tell nothing of each other (a rounded multiple of the golden ratio would
/// shake in waves, and left the saddle as late as rounding).
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
    fn noise_has_no_mean_and_its_neighbours_nothing_in_common() {
        let n = 30_000u32;
        let mean = |of: &dyn Fn(u32) -> f64| (0..n).map(of).sum::<f64>() / f64::from(n);
        assert!(mean(&noise).abs() < 0.02);
        assert!((mean(&|i| noise(i) * noise(i)) - 1.0 / 3.0).abs() < 0.01);
        for apart in [1, 2, 3, 6, 90] {
            assert!(mean(&|i| noise(i) * noise(i + apart)).abs() < 0.01, "{apart}");
        }
    }
}
