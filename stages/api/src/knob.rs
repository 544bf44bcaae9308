//! Accuracy knobs: the parameters of a stage that an asked accuracy, or a study, may set.

use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// The meaning of a knob, and with it the words that may be written into the parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Meaning {
    /// Length of a mesh edge, as a text with a unit: `16 mm`.
    EdgeLength,
    /// How near to rest the cloth is led: `draft`, `normal`, `fine` or `reference`.
    Tolerance,
    /// In-plane model of the cloth: `coupled` or `springs`.
    Model,
    /// Way to the rest: `static`, `implicit` or `central-difference`.
    Integrator,
    /// Correction of over-elongation after a step of `central-difference`: `kang` or `provot`.
    Correction,
    /// Force of a contact by its distance, in `central-difference`: `linear` or `exponential`.
    Penalty,
    /// Contact of cloth with cloth: `auto`, `on` or `off`.
    SelfContact,
    /// How often the rest is sought again from shaken starts: a whole number.
    Repeats,
    /// The study of the pipeline, which a report shows: the path of its file.
    Study,
}

/// A parameter of a stage that may be set from outside to trade accuracy for time.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Knob {
    /// Meaning of the parameter.
    pub meaning: Meaning,
    /// Key of the parameter in the table `with`; a dot leads into an inner table, as in `effects.self-contact`.
    pub key: Cow<'static, str>,
    /// Key of another parameter that is taken out when this one is set, because both say the same.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub instead_of: Option<Cow<'static, str>>,
}

impl Knob {
    /// A knob of a built-in stage.
    #[must_use]
    pub const fn new(meaning: Meaning, key: &'static str) -> Self {
        Self { meaning, key: Cow::Borrowed(key), instead_of: None }
    }

    /// A knob that takes the place of another parameter, too.
    #[must_use]
    pub const fn in_place_of(other: &'static str, meaning: Meaning, key: &'static str) -> Self {
        Self { meaning, key: Cow::Borrowed(key), instead_of: Some(Cow::Borrowed(other)) }
    }
}
