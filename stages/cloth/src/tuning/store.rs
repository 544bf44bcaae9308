//! The experiment of this process: numbers that are scaled, and mechanisms that are off.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::OnceLock;

/// An experiment.
#[derive(Clone, Debug, Default)]
pub(crate) struct Experiment {
    /// Names of mechanisms.
    pub off: BTreeSet<String>,
    /// Factors by the names of numbers.
    pub scale: BTreeMap<String, f64>,
}

static EXPERIMENT: OnceLock<Experiment> = OnceLock::new();

/// Begins an experiment; `false` where one has begun before.
pub(crate) fn begin(experiment: Experiment) -> bool {
    EXPERIMENT.set(experiment).is_ok()
}

/// The factor of a number, if the experiment has one.
pub(crate) fn factor(name: &str) -> Option<f64> {
    EXPERIMENT.get().and_then(|e| e.scale.get(name).copied())
}

/// Is a mechanism switched off?
pub(crate) fn is_off(name: &str) -> bool {
    EXPERIMENT.get().is_some_and(|e| e.off.contains(name))
}
