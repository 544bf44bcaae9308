//! The strain at which a fabric locks.

use super::Effect;

pub(crate) const EFFECT: Effect = Effect {
    name: "strain-limit",
    feature: None,
    is_built: true,
    rule: "a fabric has a limit",
    page: "coupled.md",
    switch: Some(|s| s.effects.strain_limit),
    called_for: |facts, _| facts.strain_limit.is_finite(),
    evidence: |facts, _| {
        if facts.strain_limit.is_finite() {
            format!("smallest limit of the fabrics {:.1} %", facts.strain_limit * 100.0)
        } else {
            "no fabric has a limit".to_owned()
        }
    },
    work: None,
};
