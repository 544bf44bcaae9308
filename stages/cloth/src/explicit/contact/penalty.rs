//! Laws of the penalty: the force of a contact by the distance of its two sides.

use crate::ContactPenalty;

/// Largest inverse distance, in gaps, in the exponential: closer, the force grows no more. exp(20) is 5 · 10⁸.
const INVERSE_DISTANCE_MOST: f64 = 20.0;
/// Panels of Simpson's rule for the energy of the exponential.
const PANELS: u32 = 16;

impl ContactPenalty {
    /// Force at a distance (m) below the gap (m), N. `stiffness` is the slope at the gap, N/m.
    ///
    /// The exponential is c_p exp(1/d) of equation 6, with d in gaps and c_p e the stiffness times the gap. It does not end
    /// at the gap: cloth that comes near is pushed with that force at once.
    #[inline]
    pub(crate) fn force(self, stiffness: f64, gap: f64, distance: f64) -> f64 {
        match self {
            Self::Linear => stiffness * (gap - distance),
            Self::Exponential => stiffness * gap * libm::exp(inverse_distance(gap, distance) - 1.0),
        }
    }

    /// Energy at a distance (m), J; 0 from the gap on.
    pub(crate) fn energy(self, stiffness: f64, gap: f64, distance: f64) -> f64 {
        let depth = (gap - distance).max(0.0);
        match self {
            Self::Linear => 0.5 * stiffness * depth * depth,
            Self::Exponential => {
                let panel = depth / f64::from(PANELS);
                let force = |k: f64| self.force(stiffness, gap, distance + k * panel);
                let sum: f64 =
                    (0..PANELS).map(f64::from).map(|k| force(k) + 4.0 * force(k + 0.5) + force(k + 1.0)).sum();
                sum * panel / 6.0
            }
        }
    }
}

/// One over the distance in gaps, bounded.
fn inverse_distance(gap: f64, distance: f64) -> f64 {
    if distance * INVERSE_DISTANCE_MOST > gap { gap / distance } else { INVERSE_DISTANCE_MOST }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_exponential_is_that_of_the_paper_and_stays_finite() {
        let (stiffness, gap) = (500.0, 1e-3);
        let force = |d: f64| ContactPenalty::Exponential.force(stiffness, gap, d);
        // c_p exp(1/d): the logarithms of two forces differ by 1/d.
        let ratio = libm::log(force(0.25e-3) / force(0.5e-3));
        assert!((ratio - 2.0).abs() < 1e-12, "{ratio}");
        assert!((force(gap) - stiffness * gap).abs() < 1e-15);
        assert!(force(0.0).is_finite() && force(-1e-4) == force(0.0));
    }

    #[test]
    fn the_force_is_minus_the_slope_of_the_energy() {
        for law in [ContactPenalty::Linear, ContactPenalty::Exponential] {
            let at = |d: f64| law.energy(500.0, 1e-3, d);
            for d in [0.3e-3, 0.6e-3, 0.9e-3] {
                let slope = (at(d + 1e-8) - at(d - 1e-8)) / 2e-8;
                assert!((slope / law.force(500.0, 1e-3, d) + 1.0).abs() < 1e-3, "{law:?} at {d}: {slope}");
            }
            assert_eq!(at(2e-3), 0.0);
        }
    }
}
