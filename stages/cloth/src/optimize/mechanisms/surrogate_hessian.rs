//! Surrogate bending Hessian: springs between neighbours take the place of the whole bending stencil (`energy/bending.rs`).
//!
//! It couples fewer vertices, so its factor is cheaper. Far from rest the stretch stiffness decides where a step leads, and
//! the surrogate leads as well as the whole Hessian.

use crate::optimize::descent::Descent;
use crate::optimize::mechanism::{Mechanism, Verdict};

/// Uses the surrogate until the cloth seems to be at rest, and the whole Hessian to make sure of it.
pub(crate) struct SurrogateHessian;

impl Mechanism for SurrogateHessian {
    fn begin(&mut self, d: &mut Descent<'_>) {
        d.use_surrogate(true);
    }

    fn at_rest(&mut self, d: &mut Descent<'_>) -> Verdict {
        if !d.objective().uses_surrogate() {
            return Verdict::Go;
        }
        d.use_surrogate(false);
        Verdict::Again
    }
}
