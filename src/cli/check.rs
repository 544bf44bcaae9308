//! `toile check`

use super::args::{CheckArgs, Format};
use super::console::Console;
use crate::engine::{Exit, Stop, foresee};
use crate::load;
use crate::render::findings_json;
use std::sync::Arc;
use toile_garment::{Diagnostic, Severity};
use toile_stage_api::Registry;
use toile_stages::codes::SEAM_PROPOSED;

pub(super) fn run(args: &CheckArgs, registry: &mut Registry, stop: &Arc<Stop>, console: &mut Console<'_>) -> Exit {
    let loaded = load::load(&args.accuracy.request(&args.pipeline), stop, registry);
    let mut exit = loaded.exit();
    let mut findings = loaded.report.findings.clone();
    // Input files are read as far as that is cheap, also where something else is wrong.
    if let (Some(pipeline), Some(gate)) = (&loaded.pipeline, &loaded.gate) {
        let seen = foresee(pipeline, gate, stop);
        let is_new = |f: &Diagnostic| !loaded.report.findings.iter().any(|known| same(known, f));
        findings.extend(seen.findings.into_iter().filter(is_new));
        // As text, what the stages note about the files belongs to a run.
        // What nobody has confirmed yet is told always.
        let is_open = |f: &Diagnostic| f.code == SEAM_PROPOSED;
        let is_told = |f: &Diagnostic| args.format == Format::Json || f.severity != Severity::Info || is_open(f);
        findings.extend(seen.notes.into_iter().filter(is_told));
        exit = if exit == Exit::Good { seen.exit } else { exit };
    }
    if args.format == Format::Json {
        console.json(&findings_json(&findings));
        return exit;
    }
    console.findings(&findings, loaded.text());
    if exit == Exit::Good {
        let stages = loaded.pipeline.map_or(0, |p| p.steps.len());
        console.result(&format!("nothing wrong was found: {stages} stages\n"));
    }
    exit
}

/// The same mistake, found once by the path and once by the stage that reads it.
fn same(a: &Diagnostic, b: &Diagnostic) -> bool {
    a.code == b.code && a.message == b.message
}
