//! Regularisation of the preconditioner: a Levenberg–Marquardt shift by the mass, and a share of the stretch stiffness that
//! acts in all directions. `optimize/mechanisms/regularization_schedule.rs` says when it grows and shrinks.

use crate::optimize::tuning::{
    ISOTROPIC_SHARE_FACTOR, ISOTROPIC_SHARE_FIRST, ISOTROPIC_SHARE_MOST, SHORT_BLOCK_PART, TAU_FIRST, TAU_FREE,
    WHOLE_BLOCK_PART,
};

/// State of the regularisation. The shift is mass / (τ · `unit`): a small τ keeps steps short, a large one leaves the Hessian
/// as it is.
#[derive(Debug)]
pub(crate) struct Regularization {
    /// Dimensionless.
    pub tau: f64,
    /// Share of the stretch stiffness that acts in all directions.
    pub isotropic: f64,
    /// Unit of τ, s². It scales with length and weight as the period of a pendulum does, so that similar cloth takes similar
    /// steps.
    pub unit: f64,
    /// τ from which the shift is no more than the rounding of the factor. It is lower for cloth that nothing holds, which has
    /// motions without stiffness.
    pub free_tau: f64,
}

impl Regularization {
    pub fn new(unit: f64) -> Self {
        Self { tau: TAU_FIRST.get(), isotropic: 0.0, unit, free_tau: TAU_FREE.get() }
    }

    /// Does the preconditioner follow the cloth's own Hessian?
    pub fn is_free(&self) -> bool {
        self.tau >= self.free_tau && self.isotropic == 0.0
    }

    /// Leaves the Hessian as it is.
    pub fn release(&mut self) {
        (self.tau, self.isotropic) = (TAU_FREE.get(), 0.0);
    }

    /// Raises the isotropic share where the steps of a block took a small part in the mean, and lowers it where they took nearly
    /// all. Returns whether it was raised.
    pub fn adapt_isotropic(&mut self, mean_part: f64) -> bool {
        let last = self.isotropic;
        if mean_part < SHORT_BLOCK_PART.get() {
            self.isotropic =
                (ISOTROPIC_SHARE_FACTOR.get() * last).clamp(ISOTROPIC_SHARE_FIRST.get(), ISOTROPIC_SHARE_MOST.get());
        } else if mean_part > WHOLE_BLOCK_PART.get() {
            self.isotropic = if last > ISOTROPIC_SHARE_FIRST.get() { last / ISOTROPIC_SHARE_FACTOR.get() } else { 0.0 };
        }
        self.isotropic > last
    }
}
