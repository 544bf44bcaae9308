//! Values of a fabric and parameters that this drape has no use for: each is told.

use super::{DrapeParams, HYSTERESIS_UNUSED, IntegratorName, ModelName, SETTING_UNUSED, SPRINGS_UNUSED};
use toile_garment::{Diagnostic, Garment};

/// A warning for each parameter that is set and acts in the scheme of the paper only.
pub(super) fn settings(params: &DrapeParams) -> Vec<Diagnostic> {
    if params.integrator == IntegratorName::CentralDifference {
        return Vec::new();
    }
    let default = DrapeParams::default();
    let set = [
        ("correction", params.correction != default.correction),
        ("penalty", params.penalty != default.penalty),
        ("max_time", params.max_time != default.max_time),
    ];
    act_elsewhere(&set, &["central-difference"])
}

/// A warning for each parameter that is set and acts with other integrators only.
pub(crate) fn act_elsewhere(set: &[(&str, bool)], integrators: &[&str]) -> Vec<Diagnostic> {
    let names: Vec<String> = integrators.iter().map(|name| format!("`{name}`")).collect();
    let names = names.join(" or ");
    let first = integrators.first().copied().unwrap_or_default();
    let told = |name: &str| {
        let message = format!("with.{name} does nothing: it acts with the integrator {names} only");
        let hint = format!("leave with.{name} out, or set with.integrator = \"{first}\"");
        Diagnostic::warning(SETTING_UNUSED, message).hint(hint)
    };
    set.iter().filter(|(_, is_set)| *is_set).map(|(name, _)| told(name)).collect()
}

/// One note for each kind of value that was not used.
pub(super) fn findings(garment: &Garment, params: &DrapeParams) -> Vec<Diagnostic> {
    let springs = garment.fabrics.values().find(|f| f.springs.is_some() && params.model != ModelName::Springs);
    let springs = springs.map(|fabric| {
        let message = format!("`{}` gives spring constants ([springs]); the drape went by its laws", fabric.name);
        Diagnostic::info(SPRINGS_UNUSED, message).hint("with.model = \"springs\" takes them")
    });
    let friction = garment.fabrics.values().find(|f| f.bend_holds_friction && f.bend_hysteresis.is_some());
    let friction = friction.map(|fabric| {
        let message = format!(
            "`{}` gives bending_hysteresis and bending lengths, which hold this friction already; it was not used again",
            fabric.name
        );
        Diagnostic::info(HYSTERESIS_UNUSED, message).hint("give bending stiffnesses instead of bending lengths, or leave it out")
    });
    springs.into_iter().chain(friction).collect()
}
