//! Shear and bending by measured curves.

use super::Effect;

pub(crate) const EFFECT: Effect = Effect {
    name: "measured-curves",
    feature: None,
    is_built: true,
    rule: "a fabric gives measured curves of shear or bending",
    page: "curves.md",
    switch: None,
    called_for: |facts, _| facts.curves > 0,
    evidence: |facts, _| match facts.curves {
        1 => "one curve".to_owned(),
        n => format!("{n} curves"),
    },
    // Its time is part of the cloth's.
    work: None,
};
