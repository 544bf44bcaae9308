//! How the ease of a garment follows what is added to it.
//!
//! What is added at one height changes the ease there by as much, unless something holds it: a straight side seam
//! shares it with the other heights. So the response is learned from round to round (Broyden 1965), and the next
//! step is the one that should bring the missing ease. It is damped, because the ease scatters from drape to drape
//! by a millimetre or two, and because two heights that are held to each other cannot both be served.

/// Damping of a step, as a share of what a free height answers. Larger steps shorter, smaller follows the scatter.
const DAMPING: f64 = 0.1;
/// Changes that are smaller than this say more of the scatter than of the response, metres.
const SCATTER: f64 = 4e-3;
/// Largest step at one height in a round, metres.
const LARGEST_STEP: f64 = 0.1;

/// The response of the ease at all heights to what is added at each.
pub struct Response {
    /// `slope[i][k]`: the ease at height `i` for each metre added at height `k`.
    slope: Vec<Vec<f64>>,
    /// What was added in the round before, and the ease then.
    last: Option<[Vec<f64>; 2]>,
}

impl Response {
    /// At first every height is taken to be free.
    pub fn new(levels: usize) -> Self {
        let unit = |i: usize| (0..levels).map(|k| f64::from(u8::from(i == k))).collect();
        Self { slope: (0..levels).map(unit).collect(), last: None }
    }

    /// Learns from a round: what was added, and the ease that was measured, metres; no number where it was not.
    pub fn learn(&mut self, added: &[f64], ease: &[f64]) {
        let Some([before, was]) = self.last.replace([added.to_vec(), ease.to_vec()]) else { return };
        let change = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<f64>>();
        let (step, answer) = (change(added, &before), change(ease, &was));
        let square = product(&step, &step);
        if square <= SCATTER * SCATTER {
            return;
        }
        for (row, answer) in self.slope.iter_mut().zip(answer).filter(|(_, answer)| answer.is_finite()) {
            let off = (answer - product(row, &step)) / square;
            row.iter_mut().zip(&step).for_each(|(slope, step)| *slope += off * step);
        }
    }

    /// What to add next, so that the missing ease comes, metres: least squares with damping.
    pub fn step(&self, missing: &[f64]) -> Vec<f64> {
        let n = missing.len();
        let column = |k: usize| self.slope.iter().map(|row| row[k]).collect::<Vec<f64>>();
        let columns: Vec<Vec<f64>> = (0..n).map(column).collect();
        let mut square: Vec<Vec<f64>> =
            columns.iter().map(|a| columns.iter().map(|b| product(a, b)).collect()).collect();
        (0..n).for_each(|k| square[k][k] += DAMPING * DAMPING);
        let wanted = columns.iter().map(|c| product(c, missing)).collect();
        solved(square, wanted).into_iter().map(|s| s.clamp(-LARGEST_STEP, LARGEST_STEP)).collect()
    }
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Solves a small system with a positive symmetric matrix.
fn solved(mut matrix: Vec<Vec<f64>>, mut wanted: Vec<f64>) -> Vec<f64> {
    let n = wanted.len();
    for k in 0..n {
        for i in k + 1..n {
            let share = matrix[i][k] / matrix[k][k];
            let row = matrix[k].clone();
            matrix[i].iter_mut().zip(row).for_each(|(a, b)| *a -= share * b);
            wanted[i] -= share * wanted[k];
        }
    }
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| matrix[k][j] * wanted[j]).sum();
        wanted[k] = (wanted[k] - known) / matrix[k][k];
    }
    wanted
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
