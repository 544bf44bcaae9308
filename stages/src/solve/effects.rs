//! The solver's effects in the garment's words.

use toile_cloth::EffectReport;
use toile_garment::garment::EffectRecord;

/// The solver's report of its effects.
#[must_use]
pub fn effects(told: &[EffectReport]) -> Vec<EffectRecord> {
    let record = |e: &EffectReport| EffectRecord {
        name: e.name.to_owned(),
        on: e.on,
        rule: e.rule.clone(),
        evidence: e.evidence.clone(),
        cpu_seconds: e.cpu_seconds,
    };
    told.iter().map(record).collect()
}
