//! Where the building of a piece writes what it finds.

use super::findings::Findings;
use super::ledger::{Overruled, Verdict};
use super::tolerances::Tolerances;
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use toile_garment::{Diagnostic, SourceRef};

/// The findings and verdicts that building a piece adds to, and its rules.
pub(crate) struct Desk<'a> {
    pub findings: &'a mut Findings,
    pub overruled: &'a mut Vec<Overruled>,
    pub rules: &'a Rules,
}

/// How this file is to be understood.
#[derive(Clone, Debug)]
pub(crate) struct Rules {
    pub tolerances: Tolerances,
    /// Depths and widths of notches times this.
    pub notch_scale: f64,
}

impl Desk<'_> {
    /// Adds a finding with its place in a block.
    pub(crate) fn say(&mut self, finding: Diagnostic, block: &str, layer: &str, line: u64) {
        let place: SourceRef = self.findings.place_in(block, Some(layer), line);
        self.findings.push(finding.at(place));
    }

    /// A better informed verdict on an entity than that of its layer.
    pub(crate) fn overrule(&mut self, id: u32, verdict: Verdict, rule: &'static str) {
        self.overruled.push((id, verdict, rule));
    }

    /// Does the work on each item, on all cores. Each has a desk of its own; they are put together in the order of the
    /// items.
    pub(crate) fn each<T: Send, R: Send>(
        &mut self,
        items: impl IntoParallelIterator<Item = T, Iter: rayon::iter::IndexedParallelIterator>,
        work: impl Fn(T, &mut Desk<'_>) -> R + Sync,
    ) -> Vec<R> {
        let (blank, rules) = (self.findings.blank(), self.rules);
        let alone = |item| {
            let (mut findings, mut overruled) = (blank.clone(), Vec::new());
            let result = work(item, &mut Desk { findings: &mut findings, overruled: &mut overruled, rules });
            (result, findings, overruled)
        };
        let done: Vec<_> = items.into_par_iter().map(alone).collect();
        let put = |(result, findings, overruled)| {
            self.findings.append(findings);
            self.overruled.extend::<Vec<Overruled>>(overruled);
            result
        };
        done.into_iter().map(put).collect()
    }
}
