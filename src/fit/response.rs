//! How the ease of a garment follows what is added to it.
//!
//! What is added at one height changes the ease there by as much, unless something holds it: a straight side seam
//! shares it with the other heights. So the response is learned from round to round (Broyden 1965), and the next
//! step is the one that should bring the missing ease. It is damped, because the ease scatters from drape to drape
//! by a millimetre or two, and because two heights that are held to each other cannot both be served.

use nalgebra::{DMatrix, DVector};

/// Damping of a step, as a share of what a free height answers. Larger steps shorter, smaller follows the scatter.
const DAMPING: f64 = 0.1;
/// Changes that are smaller than this say more of the scatter than of the response, metres.
const SCATTER: f64 = 4e-3;
/// Largest step at one height in a round, metres.
const LARGEST_STEP: f64 = 0.1;

/// The response of the ease at all heights to what is added at each.
pub struct Response {
    /// Entry `(i, k)`: the ease at height `i` for each metre added at height `k`.
    slope: DMatrix<f64>,
    /// The girths that were added in the round before, and the ease then.
    last: Option<[DVector<f64>; 2]>,
}

impl Response {
    /// At first every height is taken to be free.
    pub fn new(levels: usize) -> Self {
        Self { slope: DMatrix::identity(levels, levels), last: None }
    }

    /// Learns from a round: what was added, and the ease that was measured, metres; no number where it was not.
    pub fn learn(&mut self, added: &[f64], ease: &[f64]) {
        let now = [added, ease].map(DVector::from_column_slice);
        let Some([before, was]) = self.last.replace(now.clone()) else { return };
        let [added, ease] = now;
        let (step, answer) = (added - before, ease - was);
        let square = step.norm_squared();
        if square <= SCATTER * SCATTER {
            return;
        }
        let mut off = (answer - &self.slope * &step) / square;
        off.iter_mut().filter(|o| !o.is_finite()).for_each(|o| *o = 0.0);
        self.slope += off * step.transpose();
    }

    /// The girths to add next, so that the missing ease comes, metres: least squares with damping.
    pub fn step(&self, missing: &[f64]) -> Vec<f64> {
        let n = missing.len();
        let back = self.slope.transpose();
        let square = &back * &self.slope + DMatrix::identity(n, n) * (DAMPING * DAMPING);
        let wanted = back * DVector::from_column_slice(missing);
        // The damping makes the matrix positive.
        let step = square.cholesky().map_or_else(|| DVector::zeros(n), |c| c.solve(&wanted));
        step.iter().map(|s| s.clamp(-LARGEST_STEP, LARGEST_STEP)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rounds until all ease is within 5 mm of what was asked, and the ease then.
    fn rounds(slope: [[f64; 2]; 2], start: [f64; 2], rounds: usize) -> ([f64; 2], usize) {
        let (mut response, mut added) = (Response::new(2), [0.0; 2]);
        for round in 1..=rounds {
            let ease = [0, 1].map(|i| start[i] + slope[i][0] * added[0] + slope[i][1] * added[1]);
            if ease.iter().all(|e| e.abs() <= 5e-3) {
                return (ease, round);
            }
            response.learn(&added, &ease);
            let step = response.step(&ease.map(|e| -e));
            added = [added[0] + step[0], added[1] + step[1]];
        }
        ([0, 1].map(|i| start[i] + slope[i][0] * added[0] + slope[i][1] * added[1]), rounds + 1)
    }

    #[test]
    fn a_free_height_is_served_at_once() {
        assert_eq!(rounds([[1.0, 0.0], [0.0, 1.0]], [0.03, -0.02], 6).1, 2);
    }

    #[test]
    fn heights_that_share_what_is_added_are_served_in_few_rounds() {
        let (ease, count) = rounds([[0.6, 0.3], [0.3, 0.4]], [-0.024, 0.03], 6);
        assert!(count <= 5, "{ease:?} after {count}");
    }

    #[test]
    fn heights_that_are_one_get_what_serves_both_best() {
        // A straight seam: both heights get the mean of what is added.
        let (ease, _) = rounds([[0.5, 0.5], [0.5, 0.5]], [-0.02, 0.02], 6);
        assert!((ease[0] + 0.02).abs() < 2e-3 && (ease[1] - 0.02).abs() < 2e-3, "{ease:?}");
    }
}
