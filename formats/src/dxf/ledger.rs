//! The ledger: what became of every entity.

use std::collections::BTreeMap;

/// The use that was made of an entity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// Taken as the standard says.
    Accepted,
    /// Taken by a rule of ours.
    Interpreted,
    /// Not used, for a reason.
    Refused,
}

/// A verdict that overrules the one of the layer: entity, verdict, rule.
pub(crate) type Overruled = (u32, Verdict, &'static str);

/// The word on a line whose layer has no meaning for lines.
pub(crate) const NO_ROLE: &str = "line on a layer without meaning for lines";

/// One line per entity; every entity ends up with exactly one verdict.
#[derive(Clone, Debug, Default)]
pub struct Ledger {
    lines: Vec<Option<(Verdict, &'static str)>>,
}

impl Ledger {
    pub(crate) fn new(entities: u32) -> Self {
        Self { lines: vec![None; entities as usize] }
    }

    /// Notes a verdict; the first one stands.
    pub(crate) fn note(&mut self, id: u32, verdict: Verdict, rule: &'static str) {
        if let Some(line) = self.lines.get_mut(id as usize)
            && line.is_none()
        {
            *line = Some((verdict, rule));
        }
    }

    /// Has the entity been used?
    pub(crate) fn used(&self, id: u32) -> bool {
        self.lines.get(id as usize).is_some_and(|l| l.is_some_and(|l| l.0 != Verdict::Refused))
    }

    /// Is there no role for the entity: no verdict yet, or a refusal for its layer alone?
    pub(crate) fn is_without_role(&self, id: u32) -> bool {
        let line = self.lines.get(id as usize).copied().flatten();
        line.is_none_or(|(verdict, rule)| verdict == Verdict::Refused && rule == NO_ROLE)
    }

    /// Replaces a verdict that a later, better informed step overrules.
    pub(crate) fn overrule(&mut self, id: u32, verdict: Verdict, rule: &'static str) {
        if let Some(line) = self.lines.get_mut(id as usize) {
            *line = Some((verdict, rule));
        }
    }

    /// Whatever has no verdict yet was not understood.
    pub(crate) fn close(&mut self) {
        for line in &mut self.lines {
            line.get_or_insert((Verdict::Refused, "no meaning on this layer"));
        }
    }

    /// Number of entities.
    #[must_use]
    pub fn entities(&self) -> usize {
        self.lines.len()
    }

    /// Number of entities with this verdict.
    #[must_use]
    pub fn count(&self, verdict: Verdict) -> usize {
        self.lines.iter().flatten().filter(|l| l.0 == verdict).count()
    }

    /// Counts by verdict and rule.
    #[must_use]
    pub fn by_rule(&self) -> BTreeMap<(Verdict, &'static str), usize> {
        let mut counts = BTreeMap::new();
        for line in self.lines.iter().flatten() {
            *counts.entry(*line).or_insert(0) += 1;
        }
        counts
    }
}
