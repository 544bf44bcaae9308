//! Cloth that curls without load.

use super::Effect;

pub(crate) const EFFECT: Effect = Effect {
    name: "rest-curvature",
    feature: None,
    is_built: true,
    rule: "a fabric curls without load",
    page: "rest-curvature.md",
    switch: None,
    called_for: |facts, _| facts.rest_curvature != 0.0,
    evidence: |facts, _| format!("largest of the fabrics {} per m", facts.rest_curvature),
    // Its time is part of the cloth's.
    work: None,
};
