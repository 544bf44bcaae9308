//! The schedule of the regularisation: more after blocks whose steps fell short, less after blocks of whole steps.
//!
//! The shift of the diagonal is mass / (τ · unit), so a small τ is a strong regularisation (`optimize/regularization.rs`).
//! Levenberg's λ is the inverse of τ.

use crate::ClothError;
use crate::optimize::descent::Descent;
use crate::optimize::mechanism::{Block, Mechanism, Verdict};
use crate::optimize::tuning::{
    REGULARISATION, SHORT_BLOCK_PART, TAU_AFTER_ONE_SHORT_STEP, TAU_AFTER_SHORT_STEPS, TAU_AFTER_STUCK_BLOCK,
    TAU_FACTOR, TAU_FACTOR_AT_REST, TAU_LEAST, TAU_MOST, WHOLE_BLOCK_PART,
};
use crate::report::watch::Watch;

/// Adapts the regularisation to how far the steps of a block went.
pub(crate) struct RegularizationSchedule {
    /// Largest τ after a block: the regularisation never becomes weaker than this.
    pub most: f64,
}

impl RegularizationSchedule {
    /// Without a limit of its own.
    pub fn unlimited() -> Self {
        Self { most: f64::INFINITY }
    }

    fn adapt(d: &mut Descent<'_>, b: &Block) {
        if d.regularization.adapt_isotropic(b.mean) {
            return;
        }
        let at_rest = d.newton.decrement <= d.settings.equilibrium.decrement_tolerance;
        let large_at_rest = d.is_large() && at_rest;
        let r = &mut d.regularization;
        if b.stuck && b.steps == 0 {
            d.history.forget();
            r.tau = (r.tau * TAU_AFTER_STUCK_BLOCK.get()).max(TAU_LEAST.get());
        } else if b.mean > WHOLE_BLOCK_PART.get() {
            // Near rest the shift of large cloth has lost its use, and every new τ takes a factorisation.
            let factor = if large_at_rest { TAU_FACTOR_AT_REST.get() } else { TAU_FACTOR.get() };
            r.tau = (r.tau * factor).min(TAU_MOST.get());
        } else if b.mean < SHORT_BLOCK_PART.get() {
            let factor = if b.steps == 1 { TAU_AFTER_ONE_SHORT_STEP.get() } else { TAU_AFTER_SHORT_STEPS.get() };
            r.tau = (r.tau * factor).max(TAU_LEAST.get());
        }
    }
}

impl Mechanism for RegularizationSchedule {
    /// Where cloth seems to be nearly at rest under regularisation: is it so without? That is not tried where it has just led
    /// nowhere.
    fn before_block(&mut self, d: &mut Descent<'_>, _: &mut dyn Watch) -> Result<Verdict, ClothError> {
        if d.stuck_blocks == 0 && !d.regularization.is_free() && d.nearly_rests() {
            d.regularization.release();
            return Ok(Verdict::Again);
        }
        Ok(Verdict::Go)
    }

    fn after_block(&mut self, d: &mut Descent<'_>, b: &Block) -> Verdict {
        if REGULARISATION.is_on() {
            Self::adapt(d, b);
        } else {
            d.regularization.release();
        }
        d.regularization.tau = d.regularization.tau.min(self.most);
        Verdict::Go
    }
}
