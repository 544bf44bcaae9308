//! When the preconditioner is made anew, of which Hessian, and with which regularisation.

use crate::ClothError;
use crate::linear::system::System;
use crate::optimize::descent::Descent;
use crate::optimize::preconditioner::FactorPlace;
use crate::optimize::tuning::{
    FACTOR_REUSE, FULL_HESSIAN, FULL_HESSIAN_DECREMENT, FULL_HESSIAN_WAIT_MOST, REUSE_DRIFT, TAU_AFTER_FAILED_FACTOR,
    TAU_FREE, TAU_LEAST,
};
use crate::report::cost::CpuTimer;

impl Descent<'_> {
    /// # Errors
    /// An energy beyond numbers.
    pub fn check_energy(&self) -> Result<(), ClothError> {
        if self.energy.is_finite() {
            return Ok(());
        }
        Err(ClothError::Unstable { step: self.steps, what: "the energy is beyond numbers".into() })
    }

    /// Makes a preconditioner for these positions, or keeps the last one where it still serves.
    ///
    /// # Errors
    /// A Hessian that no regularisation makes positive definite.
    pub fn precondition(&mut self) -> Result<(), ClothError> {
        if self.factor_serves() {
            return Ok(());
        }
        self.preconditioner.made.at.clear();
        if !self.refactor() {
            let what = "no descent direction: the stiffness matrix cannot be factorised".into();
            return Err(ClothError::Unstable { step: self.steps, what });
        }
        self.preconditioner.made = FactorPlace {
            at: self.x.clone(),
            tau: self.regularization.tau,
            isotropic: self.regularization.isotropic,
            surrogate: self.objective().uses_surrogate(),
            good: self.preconditioner.is_full,
        };
        Ok(())
    }

    /// Near rest cloth hardly moves in a block: is the last factor still as good as a new one?
    fn factor_serves(&self) -> bool {
        let m = &self.preconditioner.made;
        let free = TAU_FREE.get();
        let same = |a: f64, b: f64| a == b || a.min(b) >= free;
        FACTOR_REUSE.is_on()
            && !self.preconditioner.always_convex
            && m.good
            && m.at.len() == self.x.len()
            && same(m.tau, self.regularization.tau)
            && m.isotropic == self.regularization.isotropic
            && m.surrogate == self.objective().uses_surrogate()
            && crate::farthest(&m.at, &self.x) <= REUSE_DRIFT.get() * self.settings.equilibrium.move_tolerance
    }

    fn refactor(&mut self) -> bool {
        self.regularization.free_tau = TAU_FREE.get();
        self.preconditioner.is_full = self.factorise_full();
        if self.preconditioner.is_full {
            return true;
        }
        loop {
            let system = self.assemble(true);
            if self.factorise(system) {
                return true;
            }
            let r = &mut self.regularization;
            r.tau *= TAU_AFTER_FAILED_FACTOR.get();
            r.free_tau = TAU_FREE.get().min(r.tau);
            if r.tau < TAU_LEAST.get() {
                return false;
            }
        }
    }

    /// Near rest the full Hessian leads faster than its convex projection; `false` where it is not positive definite.
    fn factorise_full(&mut self) -> bool {
        let far = self.newton.decrement > FULL_HESSIAN_DECREMENT.get();
        if self.preconditioner.always_convex || far || !FULL_HESSIAN.is_on() {
            return false;
        }
        if self.preconditioner.wait > 0 {
            self.preconditioner.wait -= 1;
            return false;
        }
        let system = self.assemble(false);
        let definite = self.factorise(system);
        let p = &mut self.preconditioner;
        p.next_wait = if definite { 0 } else { (2 * p.next_wait).clamp(1, FULL_HESSIAN_WAIT_MOST.get()) };
        p.wait = p.next_wait;
        definite
    }

    /// The regularisation's shift of every unknown, N/m.
    pub fn shift(&self) -> impl Iterator<Item = f64> {
        let r = &self.regularization;
        self.objective().unknowns.unknown_mass.iter().map(|m| m / (r.tau * r.unit))
    }

    /// Factorises a system, which is dropped before the elimination begins.
    pub fn factorise(&mut self, system: System) -> bool {
        let mut lap = CpuTimer::start();
        let shift: Vec<f64> = self.shift().collect();
        let fits = self.preconditioner.factor.take_in(&system, &shift);
        drop(system);
        let done = fits && self.preconditioner.factor.eliminate();
        self.spend(&mut lap);
        done
    }

    /// Number of factorisations so far.
    pub fn factorisations(&self) -> u32 {
        self.preconditioner.factor.factors
    }
}
