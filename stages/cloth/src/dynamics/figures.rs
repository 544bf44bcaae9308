//! Energies of a moment, and what a motion tells.

use crate::dynamics::motion::{Dynamics, Motion, Trip};
use crate::dynamics::step::Stepper;
use crate::effects::effect;
use crate::{EffectReport, Scene, Vec3};

/// J.
pub(crate) fn kinetic(mass: &[f64], v: &[Vec3]) -> f64 {
    0.5 * mass.iter().zip(v).map(|(m, v)| m * v.norm_squared()).sum::<f64>()
}

/// Stored in the cloth, weight and contact, J.
pub(crate) fn potential(stepper: &mut Stepper<'_>) -> f64 {
    let d = &mut stepper.descent;
    let (x, mut scratch) = (d.x.clone(), vec![Vec3::zeros(); d.x.len()]);
    let contact = d.detection().map_or(0.0, |b| b.evaluate(&x, &mut scratch));
    contact + d.objective().terms.cloth.iter().map(|e| e.energy(&x)).sum::<f64>()
}

/// The effects of a descent, and those of motion.
pub(crate) fn effects(stepper: &Stepper<'_>, scene: &Scene, dynamics: &Dynamics, motion: &Motion, trip: &mut Trip) {
    trip.effects = crate::optimize::effects(&stepper.descent, scene);
    trip.effects.push(effect(
        "inertia",
        true,
        "the cloth moves in time".into(),
        format!("{} steps, {} descent steps, {} stages unfinished", trip.steps, trip.descents, trip.unfinished),
    ));
    trip.effects.push(air(dynamics));
    trip.effects.push(effect(
        "moving-body",
        !motion.body.is_empty(),
        "the body has frames".into(),
        format!("{} frames; it came in parts {} times because cloth was in its way", motion.body.len(), trip.parted),
    ));
}

pub(crate) fn air(dynamics: &Dynamics) -> EffectReport {
    let evidence = format!("{} kg/m³ against the square of the speed across the cloth", dynamics.drag);
    effect("air", dynamics.drag > 0.0, "a drag above 0".into(), evidence)
}
