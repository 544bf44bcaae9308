//! Draping by implicit steps in time until nothing moves, after Baraff and Witkin, *Large Steps in Cloth Simulation*, 1998.
//!
//! Their step is one linear solve of implicit Euler, with constraints for contact. Here a step is of second order, it is
//! solved to its end, and contact is the barrier of the drape.

use crate::dynamics::motion::{Dynamics, Motion};
use crate::dynamics::run::Walk;
use crate::dynamics::tuning::{SETTLING_STEP, SETTLING_TOLERANCE_SHARE};
use crate::optimize::descent::Change;
use crate::optimize::report;
use crate::{ClothError, Outcome, Scene, Settings, StopReason, Watch};

/// Settles the cloth from the scene's positions.
///
/// # Errors
/// An unusable scene or setting, a start that crosses, instability, or a stop on request.
pub(crate) fn settle(scene: &Scene, settings: &Settings, watch: &mut dyn Watch) -> Result<Outcome, ClothError> {
    let (step, e) = (SETTLING_STEP.get(), &settings.explicit);
    let dynamics = Dynamics {
        step,
        damping: e.damping,
        drag: 0.0,
        tolerance: SETTLING_TOLERANCE_SHARE.get() * e.speed_tolerance,
        rest_speed: e.speed_tolerance,
        ..Dynamics::default()
    };
    let frames = (e.max_seconds / step).ceil() as usize + 1;
    let motion = Motion { fps: 1.0 / step, frames, until_settled: true, ..Motion::default() };
    let mut walk = Walk::new(scene, settings, &dynamics, &motion)?;
    walk.go(watch, &mut |_| {})?;
    let descent = &mut walk.stepper.descent;
    descent.change(|objective, _| {
        objective.terms.inertia = None;
        Change::Energy
    });
    descent.newton.residual = descent.net_force();
    let reason = if walk.trip.settled { StopReason::Settled } else { StopReason::MaxSeconds };
    let outcome = report::outcome(descent, walk.scene, reason);
    let seconds = walk.trip.steps as f64 * step;
    Ok(Outcome { steps: walk.trip.steps, seconds, speed_max: walk.trip.speed, ..outcome })
}
