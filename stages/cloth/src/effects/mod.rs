//! The table of effects: what a scene may call for beside stretch, bending and weight. One small file each, a `mod` line and a line in
//! [`EFFECTS`]. The build check, the plan and the reports of both solvers read it.

mod bending_hysteresis;
mod body_contact;
mod effect;
mod facts;
mod friction;
mod measured_curves;
mod pressure;
mod rest_curvature;
mod self_contact;
mod strain_limit;
#[cfg(test)]
mod tests;

pub use effect::Effect;
pub use facts::Facts;

use crate::report::cost::Work;
use crate::{ClothError, EffectReport, Scene, Settings};

/// Every effect, in the order of plans and reports.
pub const EFFECTS: &[&Effect] = &[
    &self_contact::EFFECT,
    &body_contact::EFFECT,
    &friction::EFFECT,
    &strain_limit::EFFECT,
    &bending_hysteresis::EFFECT,
    &rest_curvature::EFFECT,
    &measured_curves::EFFECT,
    &pressure::EFFECT,
];

// What the solver asks by name; an effect that nobody asks for has no line here.
pub(crate) use bending_hysteresis::EFFECT as BENDING_HYSTERESIS;
pub(crate) use body_contact::EFFECT as BODY_CONTACT;
pub(crate) use friction::EFFECT as FRICTION;
pub(crate) use pressure::EFFECT as PRESSURE;
pub(crate) use self_contact::EFFECT as SELF_CONTACT;
pub(crate) use strain_limit::EFFECT as STRAIN_LIMIT;

/// Refuses what is called for and is not in this build.
pub(crate) fn check(scene: &Scene, settings: &Settings) -> Result<(), ClothError> {
    let facts = Facts::of_scene(scene, settings);
    match EFFECTS.iter().find(|e| !e.is_built && e.is_wanted(&facts, settings)) {
        Some(effect) => Err(ClothError::NotBuilt { effect: effect.name }),
        None => Ok(()),
    }
}

/// What a run tells of the whole table, each with the kind of work that it costs. `shown` gives, for an effect, whether the
/// run had it and what it showed; the facts of the scene are told of an effect for which it has no words.
pub(crate) fn reports(
    scene: &Scene,
    settings: &Settings,
    shown: impl Fn(&Effect) -> Option<(bool, String)>,
) -> Vec<(EffectReport, Option<Work>)> {
    let facts = Facts::of_scene(scene, settings);
    let report = |e: &&Effect| {
        let (on, evidence) = shown(e).unwrap_or_else(|| (e.is_on(&facts, settings), e.evidence(&facts, settings)));
        let report = effect(e.name, on, e.decided_by(settings).into(), evidence);
        e.is_told(on).then_some((report, e.work))
    };
    EFFECTS.iter().filter_map(report).collect()
}

/// The report of one effect, before its cost is known.
pub(crate) fn effect(name: &'static str, on: bool, rule: String, evidence: String) -> EffectReport {
    EffectReport { name, on, rule, evidence, cpu_seconds: 0.0 }
}
