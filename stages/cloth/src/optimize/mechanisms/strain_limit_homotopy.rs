//! Homotopy of the strain limits: their barrier is off while the cloth falls. Where the cloth is slow to settle, the barrier
//! acts from a smaller strain on, with a softer wall (wide). At rest it is the barrier of the law.
//!
//! The width is a share of the limits: 0 is the law's own barrier, infinite is off (`Objective::widen_strain_limit`).

use crate::ClothError;
use crate::optimize::descent::{Change, Descent};
use crate::optimize::mechanism::{Mechanism, Verdict};
use crate::optimize::strain_limit_phase::StrainLimitPhase;
use crate::optimize::tuning::{
    STRAIN_LIMIT_NARROW_DECREMENT, STRAIN_LIMIT_NARROWING, STRAIN_LIMIT_OFF_DECREMENT, STRAIN_LIMIT_ON_DECREMENT,
    STRAIN_LIMIT_SLOW_STEPS, STRAIN_LIMIT_WIDE_SHARE, STRAIN_LIMIT_WIDE_SHARE_LEAST,
};
use crate::report::watch::Watch;

/// Switches the barrier of the strain limits off and on, and narrows it. What is stretched on the way down says little of how
/// the cloth will hang, and a limit that does not act costs nothing.
pub(crate) struct StrainLimitHomotopy {
    /// Does the barrier act again before rest? Coarser cloth only finds the way: between the places where it is held, its
    /// coarseness alone may stretch it.
    pub ends_on: bool,
}

impl Mechanism for StrainLimitHomotopy {
    /// Large cloth at its strain limits that surely falls needs no factorisation to know it.
    fn begin(&mut self, d: &mut Descent<'_>) {
        d.strain_limits = StrainLimitPhase::Undecided;
        if !(d.is_large() && d.objective().strain_limit_acts(&d.x)) {
            return;
        }
        d.refresh_lagged_forces();
        if d.surely_gains(STRAIN_LIMIT_OFF_DECREMENT.get()) && widen(d, f64::INFINITY) {
            d.strain_limits = StrainLimitPhase::Off;
        }
    }

    fn before_block(&mut self, d: &mut Descent<'_>, _: &mut dyn Watch) -> Result<Verdict, ClothError> {
        let changed = self.adapt(d);
        Ok(if changed { Verdict::Again } else { Verdict::Go })
    }
}

impl StrainLimitHomotopy {
    /// Goes to the next phase where it is time; says whether that changes a force.
    fn adapt(&self, d: &mut Descent<'_>) -> bool {
        match d.strain_limits {
            StrainLimitPhase::Undecided if d.newton.decrement > STRAIN_LIMIT_OFF_DECREMENT.get() => {
                d.strain_limits = StrainLimitPhase::Off;
                widen(d, f64::INFINITY)
            }
            StrainLimitPhase::Undecided => {
                first_phase(d);
                false
            }
            StrainLimitPhase::Off
                if self.ends_on && (d.newton.decrement < STRAIN_LIMIT_ON_DECREMENT.get() || d.rests()) =>
            {
                let changed = widen(d, 0.0);
                first_phase(d);
                changed
            }
            StrainLimitPhase::Wide(share) if d.newton.decrement < STRAIN_LIMIT_NARROW_DECREMENT.get() || d.rests() => {
                narrow_barrier(d, share)
            }
            _ => false,
        }
    }
}

/// Widens the barrier of cloth that has been slow with the law's own. Single triangles that hang at a corner turn in steps of
/// micrometres beside a stiffness a thousand times that of all others.
pub(crate) struct SlowStrainLimits;

impl Mechanism for SlowStrainLimits {
    fn before_block(&mut self, d: &mut Descent<'_>, _: &mut dyn Watch) -> Result<Verdict, ClothError> {
        let StrainLimitPhase::Own(since) = d.strain_limits else { return Ok(Verdict::Go) };
        // Steps that were taken back make the count smaller than it was.
        if d.steps.saturating_sub(since) >= STRAIN_LIMIT_SLOW_STEPS.get() && d.objective().strain_limit_acts(&d.x) {
            widen_partly(d);
        }
        Ok(Verdict::Go)
    }
}

/// The first phase in which the barrier acts. On a body it is the law's own: what slides under friction would stay where softer
/// cloth brought it.
fn first_phase(d: &mut Descent<'_>) {
    if d.objective().body().is_some() || !d.objective().strain_limit_acts(&d.x) {
        d.strain_limits = StrainLimitPhase::Own(d.steps);
    } else {
        widen_partly(d);
    }
}

/// Widens the barrier to its widest share.
pub(crate) fn widen_partly(d: &mut Descent<'_>) {
    let share = STRAIN_LIMIT_WIDE_SHARE.get();
    widen(d, share);
    d.strain_limits = StrainLimitPhase::Wide(share);
}

/// Narrows the barrier from this share of the limits until that changes a force; says whether it did.
pub(crate) fn narrow_barrier(d: &mut Descent<'_>, mut share: f64) -> bool {
    let mut changed = false;
    while share > 0.0 && !changed {
        share = if share > STRAIN_LIMIT_WIDE_SHARE_LEAST.get() { STRAIN_LIMIT_NARROWING.get() * share } else { 0.0 };
        changed = widen(d, share);
    }
    d.strain_limits = if share > 0.0 { StrainLimitPhase::Wide(share) } else { StrainLimitPhase::OwnAgain };
    changed
}

fn widen(d: &mut Descent<'_>, share: f64) -> bool {
    d.change(|objective, x| if objective.widen_strain_limit(share, x) { Change::Stiffness } else { Change::Nothing })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::optimize::task::Task;
    use crate::optimize::test_sheets;
    use crate::{Material, Scene, Settings, Vec3};

    /// A square metre of cloth with this many squares along a side, held by one edge and drawn away from it by 0.9 %, with a
    /// limit of 1 %. Its strain limits act a little, and it falls.
    fn drawn(squares: u32) -> Scene {
        let limited =
            Material { strain_limit: [0.01, 0.01, f64::INFINITY], ..Material::isotropic(0.15, 500.0, 0.0, 1e-5) };
        let mut scene = Scene { materials: vec![limited], gravity: Vec3::new(0.0, -9.81, 0.0), ..Scene::default() };
        test_sheets::add(&mut scene, squares, 1.0, 0.0, |_, j| j == 0);
        scene.positions.iter_mut().for_each(|p| p.z += 0.009 * (p.z + 0.5));
        scene
    }

    #[test]
    fn the_limits_of_large_cloth_that_surely_falls_are_off_without_a_factorisation() {
        let settings = Settings::default();
        let homotopy = || StrainLimitHomotopy { ends_on: true };
        for (squares, first) in [(68, StrainLimitPhase::Off), (20, StrainLimitPhase::Undecided)] {
            let mut d = Descent::begin(&drawn(squares), &settings, Task::Settle).unwrap();
            assert!(d.objective().strain_limit_acts(&d.x));
            homotopy().begin(&mut d);
            assert_eq!(d.strain_limits, first);
            assert_eq!(d.factorisations(), 0);
            assert_eq!(d.objective().strain_limit_acts(&d.x), first == StrainLimitPhase::Undecided);
            // Small cloth learns the same from its factor.
            if first == StrainLimitPhase::Undecided {
                d.refresh_contacts();
                d.precondition().unwrap();
                d.measure_newton_step();
                assert!(homotopy().adapt(&mut d));
                assert_eq!(d.strain_limits, StrainLimitPhase::Off);
            }
        }
    }
}
