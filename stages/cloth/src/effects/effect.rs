//! A row of the table of effects.

use super::Facts;
use crate::report::cost::Work;
use crate::{Settings, Switch};

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
    pub(super) switch: Option<fn(&Settings) -> Switch>,
    /// The rule itself.
    pub(super) called_for: fn(&Facts, &Settings) -> bool,
    /// The facts on which the rule decides, in words.
    pub(super) evidence: fn(&Facts, &Settings) -> String,
    /// Kind of work under which its CPU time is counted; `None` for an effect that costs nothing of its own.
    pub(super) work: Option<Work>,
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
    pub(super) fn decided_by(&self, settings: &Settings) -> &'static str {
        match self.switch(settings) {
            Switch::Auto => self.rule,
            Switch::On => "asked for",
            Switch::Off => "switched off",
        }
    }
}
