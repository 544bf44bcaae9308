//! `toile check`

use super::args::{CheckArgs, Format};
use super::console::Console;
use crate::engine::{Exit, Stop};
use crate::load;
use crate::render::findings_json;
use std::sync::Arc;
use toile_stage_api::Registry;

pub(super) fn run(args: &CheckArgs, registry: &mut Registry, stop: &Arc<Stop>, console: &mut Console<'_>) -> Exit {
    let loaded = load::load(&args.accuracy.request(&args.pipeline), stop, registry);
    let exit = loaded.exit();
    if args.format == Format::Json {
        console.json(&findings_json(&loaded.report.findings));
        return exit;
    }
    console.findings(&loaded.report.findings, loaded.text());
    if exit == Exit::Good {
        let stages = loaded.pipeline.map_or(0, |p| p.steps.len());
        console.result(&format!("the chain is sound: {stages} stages\n"));
    }
    exit
}
