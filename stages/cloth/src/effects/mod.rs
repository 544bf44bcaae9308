//! The table of effects: what a scene may call for beside stretch, bending and weight. One small file each, and one line in
//! [`EFFECTS`]. The build check, the plan and the reports of both solvers read it.

mod bending_hysteresis;
mod body_contact;
mod facts;
mod friction;
mod pressure;
mod self_contact;
mod strain_limit;
#[cfg(test)]
mod tests;

pub use facts::Facts;

use crate::report::cost::Work;
use crate::{ClothError, EffectReport, Scene, Settings, Switch};

/// Every effect, in the order of plans and reports.
pub const EFFECTS: [&Effect; 6] =
    [&SELF_CONTACT, &BODY_CONTACT, &FRICTION, &STRAIN_LIMIT, &BENDING_HYSTERESIS, &PRESSURE];

pub(crate) use bending_hysteresis::EFFECT as BENDING_HYSTERESIS;
pub(crate) use body_contact::EFFECT as BODY_CONTACT;
pub(crate) use friction::EFFECT as FRICTION;
pub(crate) use pressure::EFFECT as PRESSURE;
pub(crate) use self_contact::EFFECT as SELF_CONTACT;
pub(crate) use strain_limit::EFFECT as STRAIN_LIMIT;

/// A row of the table.
pub struct Effect {
    /// Name in plans, reports and findings; the key in the table `effects` of a stage, where there is a switch.
    pub name: &'static str,
    /// Feature of the build without which it is left out; `None` for an effect that every build has.
    pub feature: Option<&'static str>,
    /// The effect is part of this build.
    pub is_built: bool,
    /// The rule by which it is simulated, in words.
    pub rule: &'static str,
    /// Page in `docs/` that explains it.
    pub page: &'static str,
    /// Its switch. An effect without one is told only where it is on.
    switch: Option<fn(&Settings) -> Switch>,
    /// The rule itself.
    called_for: fn(&Facts, &Settings) -> bool,
    /// The facts on which the rule decides, in words.
    evidence: fn(&Facts, &Settings) -> String,
    /// Kind of work under which its CPU time is counted; `None` for an effect that costs nothing of its own.
    work: Option<Work>,
}

impl Effect {
    /// The switch of the effect; `auto` where it has none.
    #[must_use]
    pub fn switch(&self, settings: &Settings) -> Switch {
        self.switch.map_or(Switch::Auto, |switch| switch(settings))
    }

    /// The effect is simulated: the scene calls for it, and it is not switched off.
    #[must_use]
    pub fn is_on(&self, facts: &Facts, settings: &Settings) -> bool {
        self.switch(settings) != Switch::Off && (self.called_for)(facts, settings)
    }

    /// The facts on which the rule decides, in words.
    #[must_use]
    pub fn evidence(&self, facts: &Facts, settings: &Settings) -> String {
        (self.evidence)(facts, settings)
    }

    /// Plans and reports have a line for it.
    #[must_use]
    pub fn is_told(&self, on: bool) -> bool {
        on || self.switch.is_some()
    }

    /// It is asked for by name, or the scene calls for it.
    pub(crate) fn is_wanted(&self, facts: &Facts, settings: &Settings) -> bool {
        self.switch(settings) == Switch::On || self.is_on(facts, settings)
    }

    /// The rule that decided, in words: its own, or the switch.
    fn decided_by(&self, settings: &Settings) -> &'static str {
        match self.switch(settings) {
            Switch::Auto => self.rule,
            Switch::On => "asked for",
            Switch::Off => "switched off",
        }
    }
}

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
