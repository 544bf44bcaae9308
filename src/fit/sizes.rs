//! The change carried to all sizes of the pattern that the garment was made of.

use super::folder::put;
use super::pipeline::{IMPORT, input_of};
use super::{ALL_SIZES_NAME, ALL_SIZES_RULES_NAME, Order};
use crate::engine::{Exit, Memory, Stop, of_stage_error, run_alone};
use crate::halt::Halt;
use crate::load;
use serde_json::Value;
use std::path::Path;
use std::sync::Arc;
use toile_formats::codes::{SIZES_CARRIED, SIZES_NOT_CARRIED};
use toile_garment::{Diagnostic, Garment, Report, Severity};
use toile_stage_api::{Registry, StageError};

/// The pattern of the pipeline, and its rule table.
struct Original {
    pattern: Vec<u8>,
    rules: Option<Vec<u8>>,
}

/// Names of the original for the stage that writes all sizes.
const PATTERN: &str = "original.dxf";
const RULES: &str = "original.rul";

/// Writes the new pattern in all sizes of the old one, and says which they are or why there are none. `own` is the
/// garment in its own size, `flat` the same garment laid flat for the new body.
///
/// # Errors
/// When the pattern of the pipeline cannot be read again, or the disk refuses.
pub fn carry(
    order: &Order,
    own: &Garment,
    flat: &Garment,
    registry: &Registry,
    stop: &Arc<Stop>,
) -> Result<Vec<Diagnostic>, Halt> {
    let Some(original) = original(order, registry)? else {
        let message = "the pattern comes from no DXF, so it has no other sizes";
        return Ok(vec![Diagnostic::info(SIZES_NOT_CARRIED, message)]);
    };
    let mut files = Memory::default();
    files.give(PATTERN, original.pattern);
    if let Some(rules) = original.rules {
        files.give(RULES, rules);
    }
    let mut report = Report::default();
    let params = format!("{{ file = \"{{out}}/{ALL_SIZES_NAME}\", grade_from = \"{PATTERN}\" }}");
    let garment = in_own_size(flat.clone(), own);
    if let Err(error) = run_alone(registry, ("export-dxf", &params), garment, stop, &mut report, &mut files) {
        let (findings, exit) = of_stage_error(error);
        return if exit == Exit::Input { Ok(not_carried(findings)) } else { Err(Halt::new(findings, exit)) };
    }
    for name in [ALL_SIZES_NAME, ALL_SIZES_RULES_NAME] {
        let bytes = files.take(name).map_err(halted)?;
        put(&order.out.join(name), &bytes)?;
    }
    let is_told = |f: &Diagnostic| f.code == SIZES_CARRIED || f.severity != Severity::Info;
    Ok(report.findings.into_iter().filter(is_told).collect())
}

/// The pattern file that the first `import-dxf` of the pipeline reads.
fn original(order: &Order, registry: &Registry) -> Result<Option<Original>, Halt> {
    let loaded = load::reload(&order.request, registry);
    let (Some(pipeline), Some(gate)) = (&loaded.pipeline, &loaded.gate) else { return Err(Halt::of(loaded)) };
    let Some(step) = pipeline.steps.iter().find(|s| s.ready.info().name == IMPORT) else { return Ok(None) };
    let params = step.ready.params();
    let named = |key: &str| params.get(key).and_then(Value::as_str).map(Path::new);
    let Some(file) = named("file") else { return Ok(None) };
    let (_, pattern) = input_of(file, gate)?;
    let rules = match named("rules") {
        Some(path) => Some(input_of(path, gate)?),
        None => input_of(&file.with_extension("rul"), gate).ok(),
    };
    Ok(Some(Original { pattern, rules: rules.map(|(_, bytes)| bytes) }))
}

/// The garment with the size labels and block names that it has in the pattern.
fn in_own_size(mut garment: Garment, own: &Garment) -> Garment {
    garment.size.clone_from(&own.size);
    for (piece, own) in garment.pieces.iter_mut().zip(&own.pieces) {
        piece.size.clone_from(&own.size);
        piece.block.clone_from(&own.block);
    }
    garment
}

/// A pattern of one size is no fault; all else that keeps sizes from being written is a warning.
fn not_carried(mut findings: Vec<Diagnostic>) -> Vec<Diagnostic> {
    let has_one_size = findings.iter().all(|f| f.code == SIZES_NOT_CARRIED);
    let severity = if has_one_size { Severity::Info } else { Severity::Warning };
    findings.iter_mut().for_each(|f| f.severity = severity);
    findings
}

fn halted(error: StageError) -> Halt {
    let (findings, exit) = of_stage_error(error);
    Halt::new(findings, exit)
}
