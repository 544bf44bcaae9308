//! Friction of the yarns in bending.

use super::Effect;
use crate::report::cost::Work;
use crate::{Integrator, Switch};

/// Coercive curvature HB/B times bending length from which the drape coefficient of a cloth changes by a point.
const FELT: f64 = 0.05;

pub(crate) const EFFECT: Effect = Effect {
    name: "bending-hysteresis",
    feature: Some("bending-hysteresis"),
    is_built: cfg!(feature = "bending-hysteresis"),
    rule: "HB/B times bending length is 0.05 or more",
    page: "hysteresis.md",
    switch: Some(|s| s.effects.bending_hysteresis),
    called_for: |facts, s| {
        let least = if s.effects.bending_hysteresis == Switch::On { f64::MIN_POSITIVE } else { FELT };
        s.integrator != Integrator::CentralDifference && facts.bend_friction >= least
    },
    evidence: |facts, s| {
        if s.integrator == Integrator::CentralDifference {
            "central differences do not simulate it".to_owned()
        } else {
            format!("largest of the fabrics {:.2}", facts.bend_friction)
        }
    },
    work: Some(Work::Hysteresis),
};
