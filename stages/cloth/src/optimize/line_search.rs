//! The line search: the quasi-Newton direction, the largest step along it that crosses nothing, and backtracking by cubic
//! interpolation until the step gains enough (Armijo).

use crate::Vec3;
use crate::linear::hessian::{gather, scattered};
use crate::optimize::descent::Descent;
use crate::optimize::lbfgs::dot;
use crate::optimize::tuning::{
    ARMIJO_SHARE, BACKTRACKING_LEAST, BACKTRACKING_MOST, HOLD_BACK_ROUNDS, HOLD_BACK_UNDER, LINE_SEARCH_TRIALS,
};
use crate::report::cost::CpuTimer;

/// Rounding of an energy over its size.
const ENERGY_ROUNDING: f64 = 1e-14;

/// The minimum of the cubic through both ends of an interval of length 1: `rise` from one to the other, and the slopes at both
/// (Nocedal and Wright, Numerical Optimization, equation 3.59). The slope at the far end shows that turning cloth grows stiff
/// only late; the parabola without it stops short.
fn cubic_minimum(rise: f64, [first, last]: [f64; 2]) -> f64 {
    let bow = first + last - 3.0 * rise;
    let root = (bow * bow - first * last).max(0.0).sqrt();
    1.0 - (last + root - bow) / (last - first + 2.0 * root)
}

impl Descent<'_> {
    /// Shortens a step so that nothing crosses.
    pub fn limit(&mut self, step: &mut [Vec3]) {
        let (most_rounds, hold_back_under) = (HOLD_BACK_ROUNDS.get(), HOLD_BACK_UNDER.get());
        for round in 0..=most_rounds {
            let x = std::mem::take(&mut self.x);
            let listed = self.detection().is_some_and(|b| b.update_lists(&x, step));
            self.x = x;
            if listed {
                self.evaluate_again();
            }
            let x = std::mem::take(&mut self.x);
            let done = self.detection().is_none_or(|barrier| {
                // A shorter step along the same direction is still a good one. Single vertices are held back alone only
                // where a few of them would stop all others.
                let part = barrier.max_step_fraction(&x, step);
                if part < hold_back_under && round < most_rounds {
                    barrier.truncate_vertices(&x, step);
                    return false;
                }
                if part < 1.0 {
                    barrier.statistics.shortened_steps += 1;
                    step.iter_mut().for_each(|d| *d *= part);
                }
                true
            });
            self.x = x;
            if done {
                return;
            }
        }
    }

    /// The quasi-Newton direction, no longer than the step cap.
    fn direction(&mut self) -> Vec<Vec3> {
        let mut lap = CpuTimer::start();
        let factor = &mut self.preconditioner.factor;
        let mut d = self.history.direction(&self.f, |q| factor.solve(q));
        if dot(&d, &self.f) <= 0.0 || d.iter().any(|v| !v.iter().all(|c| c.is_finite())) {
            self.history.forget();
            d = self.f.clone();
            factor.solve(&mut d);
        }
        self.spend(&mut lap);
        self.newton.longest = crate::longest(&d);
        let most = self.step_cap.edges * self.objective().edge;
        let cap = if self.newton.longest > most { most / self.newton.longest } else { 1.0 };
        scattered(&self.objective().unknowns.index, &d, cap)
    }

    /// Takes one step along the quasi-Newton direction and tries this part of it first. Returns the part that was taken, or
    /// `None` if nothing was gained.
    pub fn step(&mut self, mut part: f64) -> Option<f64> {
        let mut step = self.direction();
        self.limit(&mut step);
        let mut moved = vec![Vec3::zeros(); self.f.len()];
        gather(&self.objective().unknowns.index, &step, &mut moved);
        let slope = dot(&moved, &self.f);
        if slope <= 0.0 {
            return None;
        }
        let (from, energy, force) = (self.x.clone(), self.energy, self.f.clone());
        let armijo = ARMIJO_SHARE.get();
        for _ in 0..LINE_SEARCH_TRIALS.get() {
            for ((x, p), d) in self.x.iter_mut().zip(&from).zip(&step) {
                *x = p + d * part;
            }
            self.evaluate();
            let (rise, on) = (self.energy - energy, dot(&moved, &self.f));
            let gains = rise <= -armijo * part * slope;
            // Where the gain is lost in the digits of the energy, the slopes still show it (Hager and Zhang 2005, eq. 4.1).
            let rounding = ENERGY_ROUNDING * energy.abs() + self.objective().noise;
            let lost_in_rounding = rise <= rounding && on >= (2.0 * armijo - 1.0) * slope;
            if self.energy.is_finite() && (gains || lost_in_rounding) {
                self.accept(&force, moved, part);
                return Some(part);
            }
            let nearer = cubic_minimum(rise, [-part * slope, -part * on]);
            let (least, most) = (BACKTRACKING_LEAST.get(), BACKTRACKING_MOST.get());
            part *= if nearer.is_finite() { nearer.clamp(least, most) } else { least };
        }
        self.x = from;
        self.evaluate();
        None
    }

    /// Keeps a step in the history; the forces were `force` before it.
    fn accept(&mut self, force: &[Vec3], mut moved: Vec<Vec3>, part: f64) {
        moved.iter_mut().for_each(|d| *d *= part);
        let y: Vec<Vec3> = force.iter().zip(&self.f).map(|(p, q)| p - q).collect();
        self.history.push(moved, y);
        self.steps += 1;
        let x = std::mem::take(&mut self.x);
        self.detection().into_iter().for_each(|b| b.step_taken(&x));
        self.x = x;
    }
}

#[cfg(test)]
mod tests {
    use super::cubic_minimum;

    #[test]
    fn the_minima_of_a_parabola_and_of_a_cubic_are_found() {
        // x² − x, and x³ − ¾ x.
        assert!((cubic_minimum(0.0, [-1.0, 1.0]) - 0.5).abs() < 1e-15);
        assert!((cubic_minimum(0.25, [-0.75, 2.25]) - 0.5).abs() < 1e-15);
    }
}
