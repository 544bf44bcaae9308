//! Contact of cloth with the body.

use super::Effect;
use crate::report::cost::Work;

pub(crate) const EFFECT: Effect = Effect {
    name: "body-contact",
    feature: None,
    is_built: true,
    rule: "the scene has a body",
    page: "contact.md",
    switch: Some(|s| s.effects.body_contact),
    called_for: |facts, _| facts.body.is_some(),
    evidence: |facts, _| facts.body.clone().unwrap_or_else(|| "no stage gives a body".to_owned()),
    work: Some(Work::BodyContact),
};
