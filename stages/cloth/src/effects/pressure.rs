//! Pressure behind the cloth.

use super::Effect;
use crate::report::cost::Work;

pub(crate) const EFFECT: Effect = Effect {
    name: "pressure",
    feature: Some("pressure"),
    is_built: cfg!(feature = "pressure"),
    rule: "a pressure is given",
    page: "pressure.md",
    switch: None,
    called_for: |facts, _| facts.pressure != 0.0,
    evidence: |facts, _| format!("{} Pa", facts.pressure),
    work: Some(Work::Pressure),
};
