//! Contact of cloth with cloth.

use super::Effect;
use crate::report::cost::Work;

pub(crate) const EFFECT: Effect = Effect {
    name: "self-contact",
    feature: Some("self-contact"),
    is_built: cfg!(feature = "self-contact"),
    rule: "cloth that moves freely can meet itself",
    page: "contact.md",
    switch: Some(|s| s.effects.self_contact),
    called_for: |_, _| true,
    evidence: |facts, _| facts.cloth.clone(),
    work: Some(Work::SelfContact),
};
