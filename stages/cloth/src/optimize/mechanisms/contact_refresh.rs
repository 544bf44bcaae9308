//! Between two blocks of steps, contacts that are pressed nearly shut are stiffened, and lagged forces are renewed.

use crate::optimize::descent::{Change, Descent};
use crate::optimize::mechanism::Mechanism;
use crate::optimize::tuning::{ADAPTIVE_STIFFNESS, LOADED_DECREMENT};

/// Stiffens contacts that are pressed nearly shut under a load.
pub(crate) struct AdaptiveStiffness;

impl Mechanism for AdaptiveStiffness {
    fn refresh(&mut self, d: &mut Descent<'_>) {
        // Contacts of cloth that falls may be nearly shut because the cloth began there, so these are not stiffened. An
        // unmeasured decrement is infinite and says nothing: then contacts are stiffened. Sewing never measures it, and
        // neither does the first round of a drape.
        let falls = d.newton.decrement.is_finite() && d.newton.decrement >= LOADED_DECREMENT.get();
        if !falls {
            d.stiffen_tight_contacts();
        }
    }
}

/// Refreshes friction in contacts and in bending, and pressure.
pub(crate) struct LaggedForces;

impl Mechanism for LaggedForces {
    fn refresh(&mut self, d: &mut Descent<'_>) {
        d.refresh_lagged_forces();
    }
}

impl Descent<'_> {
    /// Stiffens contacts that are pressed nearly shut, if that mechanism is on.
    pub fn stiffen_tight_contacts(&mut self) {
        if !ADAPTIVE_STIFFNESS.is_on() {
            return;
        }
        self.change(|o, _| {
            let index = &o.unknowns.index;
            Change::energy_if(o.terms.barrier.as_mut().is_some_and(|b| b.stiffen_contacts(index)))
        });
    }

    /// Adaptive stiffness and lagged forces at once, as before a block.
    pub fn refresh_contacts(&mut self) {
        AdaptiveStiffness.refresh(self);
        LaggedForces.refresh(self);
    }
}
