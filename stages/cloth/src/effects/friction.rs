//! Friction at contacts, of cloth with itself and with the body.

use super::body_contact::EFFECT as BODY_CONTACT;
use super::self_contact::EFFECT as SELF_CONTACT;
use super::{Effect, Facts};
use crate::Settings;
use crate::report::cost::Work;

pub(crate) const EFFECT: Effect = Effect {
    name: "friction",
    feature: None,
    is_built: true,
    rule: "contact and a coefficient above 0",
    page: "contact.md",
    switch: Some(|s| s.effects.friction),
    called_for: |facts, s| touches(facts, s) && facts.friction > 0.0,
    evidence: |facts, s| {
        if touches(facts, s) {
            format!("largest coefficient of the fabrics {}", facts.friction)
        } else {
            "no contact is simulated".to_owned()
        }
    },
    work: Some(Work::Friction),
};

fn touches(facts: &Facts, settings: &Settings) -> bool {
    SELF_CONTACT.is_on(facts, settings) || BODY_CONTACT.is_on(facts, settings)
}
