//! Reuse of a factor: near rest one factor may serve several blocks.

use crate::optimize::descent::Descent;
use crate::optimize::mechanism::{Block, Mechanism, Verdict};
use crate::optimize::tuning::{REUSE_FORCE_SHARE, REUSE_MEAN_PART};

/// Watches whether a factor leads well enough to be used for another block.
///
/// `Descent::precondition` marks the factor of a full Hessian as good. This rule withdraws the mark when steps become
/// short or forces stop falling. `Descent::factor_serves` reads it, in `optimize/factorization.rs`.
pub(crate) struct FactorReuse;

impl Mechanism for FactorReuse {
    /// The cloth counts as at rest only by a factor that was made for where it is.
    fn at_rest(&mut self, d: &mut Descent<'_>) -> Verdict {
        if d.preconditioner.is_fresh(&d.x) {
            return Verdict::Go;
        }
        d.preconditioner.renew();
        Verdict::Again
    }

    fn after_block(&mut self, d: &mut Descent<'_>, b: &Block) -> Verdict {
        let calmed = d.net_force() < REUSE_FORCE_SHARE.get() * d.newton.residual;
        d.preconditioner.made.good &= b.mean > REUSE_MEAN_PART.get() && calmed;
        Verdict::Go
    }
}
