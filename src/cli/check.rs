//! `toile check`

use super::args::{CheckArgs, Format};
use super::console::Console;
use crate::engine::{Exit, Stop};
use crate::load;
use crate::render::findings_json;
use std::sync::Arc;
use toile_stage_api::Registry;

pub(super) fn run(args: &CheckArgs, registry: &mut Registry, stop: &Arc<Stop>, console: &mut Console<'_>) -> Exit {
    let request = args.pipeline.request();
    let (findings, text, stages) = match load::open(&request) {
        Ok(source) => {
            let loaded = load::check(&source, &request, stop, registry);
            let stages = loaded.pipeline.map_or(0, |p| p.steps.len());
            (loaded.report.findings, Some((source.file().to_owned(), source.text().to_owned())), stages)
        }
        Err(findings) => (findings, None, 0),
    };
    let exit = if text.is_none() { Exit::Usage } else { Exit::of_findings(&findings) };
    if args.format == Format::Json {
        console.json(&findings_json(&findings));
        return exit;
    }
    console.findings(&findings, text.as_ref().map(|(f, t)| (f.as_str(), t.as_str())));
    if exit == Exit::Good {
        console.result(&format!("the chain is sound: {stages} stages\n"));
    }
    exit
}
