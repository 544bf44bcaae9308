//! Which effects this build has. Each of these is a feature of the crate; what is left out is refused by name where a scene
//! calls for it, and never passed over.

use crate::energy::hysteresis;
use crate::{ClothError, EffectReport, Scene, Settings, Switch};

/// An effect, is it in the build, and does a scene call for it?
type Part = (&'static str, bool, fn(&Scene, &Settings) -> bool);

const PARTS: [Part; 3] = [
    ("self-contact", cfg!(feature = "self-contact"), |_, s| s.effects.self_contact != Switch::Off),
    ("bending-hysteresis", cfg!(feature = "bending-hysteresis"), hysteresis::called_for),
    ("pressure", cfg!(feature = "pressure"), |_, s| s.pressure != 0.0),
];

/// Is an effect of this name in the build? Those that no build leaves out are.
#[must_use]
pub fn is_built(effect: &str) -> bool {
    PARTS.iter().all(|(name, there, _)| *there || *name != effect)
}

/// Refuses what is called for and is not there.
pub(crate) fn check(scene: &Scene, settings: &Settings) -> Result<(), ClothError> {
    match PARTS.iter().find(|(_, there, called_for)| !there && called_for(scene, settings)) {
        Some((effect, ..)) => Err(ClothError::NotBuilt { effect }),
        None => Ok(()),
    }
}

/// The rule by which an effect is on or off, in words: its own, or the switch.
pub(crate) fn switched(switch: Switch, rule: &str) -> String {
    match switch {
        Switch::Auto => rule.into(),
        Switch::On => "asked for".into(),
        Switch::Off => "switched off".into(),
    }
}

/// The report of one effect, before its cost is known.
pub(crate) fn effect(name: &'static str, on: bool, rule: String, evidence: String) -> EffectReport {
    EffectReport { name, on, rule, evidence, cpu_seconds: 0.0 }
}
