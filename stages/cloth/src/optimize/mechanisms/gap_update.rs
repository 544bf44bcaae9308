//! Gap update at rest: a contact that gave way under its load is moved out to the distance it should have, as the multiplier
//! update of an augmented Lagrangian does. The rule stands here, the formula in `contact/barrier/gap_update.rs`.

use crate::ClothError;
use crate::optimize::descent::{Change, Descent};
use crate::optimize::mechanism::{Mechanism, Verdict};
use crate::optimize::strain_limit_phase::StrainLimitPhase;
use crate::optimize::tuning::{GAP_UPDATE_EARLY_RESIDUAL, GAP_UPDATE_ROUNDS};
use crate::report::watch::Watch;

/// Moves out contacts that gave way.
#[derive(Default)]
pub(crate) struct GapUpdate {
    /// Updates so far.
    rounds: u32,
}

impl GapUpdate {
    /// Is large cloth so near rest that its first update pays? An update sets the cloth in motion again. Made early, that
    /// motion dies out together with what is left of the motion before it.
    fn is_early(&self, d: &Descent<'_>) -> bool {
        let s = d.settings;
        d.is_large()
            && self.rounds == 0
            && d.strain_limits != StrainLimitPhase::Off
            && d.newton.decrement <= s.equilibrium.decrement_tolerance
            && d.newton.longest <= s.equilibrium.move_tolerance
            && d.newton.residual <= GAP_UPDATE_EARLY_RESIDUAL.get() * s.equilibrium.residual_tolerance
    }

    fn update(d: &mut Descent<'_>) -> bool {
        d.change(|o, x| {
            let index = &o.unknowns.index;
            Change::energy_if(o.terms.barrier.as_mut().is_some_and(|b| b.update_gaps(x, index)))
        })
    }
}

impl Mechanism for GapUpdate {
    fn before_block(&mut self, d: &mut Descent<'_>, _: &mut dyn Watch) -> Result<Verdict, ClothError> {
        if !self.is_early(d) {
            return Ok(Verdict::Go);
        }
        if !d.check_or_roll_back() {
            return Ok(Verdict::Again);
        }
        self.rounds = 1;
        Ok(if Self::update(d) { Verdict::Again } else { Verdict::Go })
    }

    fn at_rest(&mut self, d: &mut Descent<'_>) -> Verdict {
        if self.rounds >= GAP_UPDATE_ROUNDS.get() {
            return Verdict::Go;
        }
        // An update stays, so it must not follow steps that are taken back.
        if !d.check_or_roll_back() {
            d.use_surrogate(true);
            return Verdict::Again;
        }
        if !Self::update(d) {
            return Verdict::Go;
        }
        self.rounds += 1;
        // The cloth moves again, so the cheaper Hessian leads until it is nearly at rest.
        d.use_surrogate(true);
        Verdict::Again
    }
}
