//! One step of a descent: where it goes, how far it may, and how far it is worth going.

use crate::Vec3;
use crate::linear::hessian::{gather, scattered};
use crate::optimize::descent::Descent;
use crate::optimize::lbfgs::dot;
use crate::report::cost::Lap;

/// Least part of what the slope promises that a step must win (Armijo). So much that one which ends far up the other side
/// is taken back: with 1e-4 most drapes took more steps, up to a third.
const DECREASE: f64 = 0.25;
/// Rounding of an energy over its size.
const ROUNDING: f64 = 1e-14;
const MOST_TRIALS: usize = 8;
/// Least and largest part of a step that fell short which the next trial takes.
const NEARER: [f64; 2] = [0.1, 0.7];
/// Rounds in which single vertices are held back before the whole step is shortened.
const HOLD_ROUNDS: usize = 3;
/// Part of a step below which single vertices are held back instead of all.
const HOLD_UNDER: f64 = 0.1;

/// Where on a way of length 1 the cubic through its ends is least: `rise` from one to the other, with these slopes (Nocedal
/// and Wright, eq. 3.59). The slope at the far end tells that cloth which turns grows stiff only late: the parabola without it
/// stops short.
fn least(rise: f64, [first, last]: [f64; 2]) -> f64 {
    let bow = first + last - 3.0 * rise;
    let root = (bow * bow - first * last).max(0.0).sqrt();
    1.0 - (last + root - bow) / (last - first + 2.0 * root)
}

impl Descent<'_> {
    /// Shortens a step so that nothing crosses.
    pub(crate) fn limit(&mut self, step: &mut [Vec3]) {
        for round in 0..=HOLD_ROUNDS {
            if self.goal.barrier.as_mut().is_some_and(|b| b.cover(&self.x, step)) {
                self.evaluate_again();
            }
            let Some(barrier) = &mut self.goal.barrier else { return };
            // A shorter step along the same direction is still a good one; only where a few vertices would stop all
            // others are they held back alone.
            let part = barrier.free_part(&self.x, step);
            if part >= HOLD_UNDER || round == HOLD_ROUNDS {
                if part < 1.0 {
                    barrier.tally.limited += 1;
                    step.iter_mut().for_each(|d| *d *= part);
                }
                return;
            }
            barrier.hold_back(&self.x, step);
        }
    }

    /// The quasi-Newton direction, no longer than the stride.
    fn direction(&mut self) -> Vec<Vec3> {
        let mut lap = Lap::start();
        let mut d = self.memory.direction(&self.f, |q| self.factor.solve(q));
        if dot(&d, &self.f) <= 0.0 || d.iter().any(|v| !v.iter().all(|c| c.is_finite())) {
            self.memory.clear();
            d = self.f.clone();
            self.factor.solve(&mut d);
        }
        self.spend(&mut lap);
        self.longest = crate::longest(&d);
        let most = self.stride * self.goal.edge;
        let cap = if self.longest > most { most / self.longest } else { 1.0 };
        scattered(&self.goal.unknown, &d, cap)
    }

    /// One step along the quasi-Newton direction, of which this part is tried first; the part of it that was taken, `None` if nothing was won.
    pub fn step(&mut self, mut part: f64) -> Option<f64> {
        let mut step = self.direction();
        self.limit(&mut step);
        let mut moved = vec![Vec3::zeros(); self.f.len()];
        gather(&self.goal.unknown, &step, &mut moved);
        let slope = dot(&moved, &self.f);
        if slope <= 0.0 {
            return None;
        }
        let (from, energy, force) = (self.x.clone(), self.energy, self.f.clone());
        for _ in 0..MOST_TRIALS {
            for ((x, p), d) in self.x.iter_mut().zip(&from).zip(&step) {
                *x = p + d * part;
            }
            self.evaluate();
            let (rise, on) = (self.energy - energy, dot(&moved, &self.f));
            let wins = rise <= -DECREASE * part * slope;
            // What is lost in the digits of the energy, the slopes still tell (Hager and Zhang 2005, eq. 4.1).
            let unseen = rise <= ROUNDING * energy.abs() + self.goal.noise && on >= (2.0 * DECREASE - 1.0) * slope;
            if self.energy.is_finite() && (wins || unseen) {
                self.took(&force, moved, part);
                return Some(part);
            }
            let nearer = least(rise, [-part * slope, -part * on]);
            part *= if nearer.is_finite() { nearer.clamp(NEARER[0], NEARER[1]) } else { NEARER[0] };
        }
        self.x = from;
        self.evaluate();
        None
    }

    /// Remembers a step from where the forces were `force`.
    fn took(&mut self, force: &[Vec3], mut moved: Vec<Vec3>, part: f64) {
        moved.iter_mut().for_each(|d| *d *= part);
        let y: Vec<Vec3> = force.iter().zip(&self.f).map(|(p, q)| p - q).collect();
        self.memory.push(moved, y);
        self.steps += 1;
        if let Some(b) = &mut self.goal.barrier {
            b.took(&self.x);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::least;

    #[test]
    fn the_least_of_a_parabola_and_of_a_cubic_are_found() {
        // x² − x, and x³ − ¾ x.
        assert!((least(0.0, [-1.0, 1.0]) - 0.5).abs() < 1e-15);
        assert!((least(0.25, [-0.75, 2.25]) - 0.5).abs() < 1e-15);
    }
}
