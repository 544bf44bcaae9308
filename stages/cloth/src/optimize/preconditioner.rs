//! The metric of a descent: of what its factor is, and when a new one is made.

use crate::linear::hessian::Pattern;
use crate::optimize::descent::{Descent, TAU_FREE, TAU_LEAST};
use crate::report::cost::{Lap, Work};
use crate::{ClothError, Vec3};
use nalgebra::Matrix3;

/// What a Newton step would win over the elastic energy, below which the second derivatives are used as they are …
const NEAR_REST: f64 = 0.05;
/// … and blocks until they are tried again where they were not convex, at most.
const MOST_PATIENCE: u32 = 8;
/// How far cloth moves from where it was made, over the longest move at rest, before a new one is needed.
const STILL: f64 = 3.0;

/// Where and for what a factor was made.
#[derive(Debug, Default)]
pub(crate) struct Made {
    at: Vec<Vec3>,
    tau: f64,
    firm: f64,
    rough: bool,
    /// Did it lead well so far?
    pub good: bool,
}

impl Descent<'_> {
    /// A new metric for what is here.
    pub fn metric(&mut self) -> Result<(), ClothError> {
        match self.measured() {
            // Where cloth has gone through itself, no way may lead on.
            Err(_) if !self.is_proved() => self.measured(),
            told => told,
        }
    }

    fn measured(&mut self) -> Result<(), ClothError> {
        if !self.energy.is_finite() {
            return Err(ClothError::Unstable { step: self.steps, what: "the energy is beyond numbers".into() });
        }
        if !self.refresh() {
            let what = "no descent direction: the stiffness matrix cannot be factorised".into();
            return Err(ClothError::Unstable { step: self.steps, what });
        }
        Ok(())
    }

    /// Refreshes friction and metric. `false` if no metric can be had.
    fn refresh(&mut self) -> bool {
        self.take_up();
        if self.factor_holds() {
            return true;
        }
        self.made.at.clear();
        let made = self.refactor();
        if made {
            self.made = Made {
                at: self.x.clone(),
                tau: self.tau,
                firm: self.firm,
                rough: self.goal.is_rough(),
                good: self.exact,
            };
        }
        made
    }

    /// Near rest cloth hardly moves in a block: is the last factor still as good as a new one?
    fn factor_holds(&self) -> bool {
        let m = &self.made;
        let same = |a: f64, b: f64| a == b || a.min(b) >= TAU_FREE;
        self.goal.inert.is_none()
            && m.good
            && m.at.len() == self.x.len()
            && same(m.tau, self.tau)
            && m.firm == self.firm
            && m.rough == self.goal.is_rough()
            && crate::farthest(&m.at, &self.x) <= STILL * self.settings.move_tolerance
    }

    /// Was the factor made for where the cloth is?
    pub(crate) fn is_fresh(&self) -> bool {
        self.made.at == self.x
    }

    /// The next block takes a new factor.
    pub(crate) fn renew(&mut self) {
        self.made.good = false;
    }

    fn refactor(&mut self) -> bool {
        self.free = TAU_FREE;
        self.exact = self.true_metric();
        if self.exact {
            return true;
        }
        loop {
            let system = self.assemble(true);
            if self.factorise(system) {
                return true;
            }
            self.tau *= 0.1;
            self.free = TAU_FREE.min(self.tau);
            if self.tau < TAU_LEAST {
                return false;
            }
        }
    }

    /// Near rest the second derivatives as they are lead faster than their convex part; `false` where they are not convex.
    fn true_metric(&mut self) -> bool {
        if self.goal.inert.is_some() || self.decrement > NEAR_REST {
            return false;
        }
        if self.wait > 0 {
            self.wait -= 1;
            return false;
        }
        let system = self.assemble(false);
        let convex = self.factorise(system);
        self.patience = if convex { 0 } else { (2 * self.patience).clamp(1, MOST_PATIENCE) };
        self.wait = self.patience;
        convex
    }

    pub fn assemble(&mut self, convex: bool) -> (Pattern, Vec<Matrix3<f64>>) {
        let mut lap = Lap::start();
        let system = self.goal.assemble(&self.x, self.firm, convex);
        self.spend(&mut lap);
        system
    }

    /// Of the metric, N/m, per unknown.
    pub fn shift(&self) -> impl Iterator<Item = f64> {
        self.goal.inertia.iter().map(|m| m / (self.tau * self.unit))
    }

    /// Factorises a system, which goes before that begins.
    pub fn factorise(&mut self, (pattern, values): (Pattern, Vec<Matrix3<f64>>)) -> bool {
        let mut lap = Lap::start();
        let shift: Vec<f64> = self.shift().collect();
        let fits = self.factor.take_in(&pattern, &values, &shift);
        drop(values);
        let done = fits && self.factor.eliminate();
        self.spend(&mut lap);
        done
    }

    /// Counts the time since the last look, and that of the factor's other thread.
    pub(crate) fn spend(&mut self, lap: &mut Lap) {
        self.goal.costs.spend(Work::Descent, lap);
        self.goal.costs.add(Work::Descent, self.factor.beside());
    }
}
