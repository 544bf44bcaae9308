//! A stage that is another program. Declared in the pipeline, run only with consent, its answers read as hostile.
//!
//! `PROGRAM describe` prints its stages as JSON. `PROGRAM run` reads one JSON request from stdin; the garment goes in and
//! comes back as a bundle folder, progress and findings come as JSON lines on stdout. `PROGRAM forecast`, since protocol 2,
//! reads the same request and tells what the work will need. Exit code 0: done, 1: failed, 2: garment rejected.

pub(crate) mod codes;
mod forecast;
mod process;
mod protocol;
mod stage;

pub use process::kill_group;
pub use protocol::{Description, Line, OLDEST_PROTOCOL, PROTOCOL, Request, StageDescription};
pub use stage::ExternalStage;

use crate::engine::Stop;
use crate::pipeline::Document;
use process::Program;
use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;
use toile_garment::Report;
use toile_stage_api::Registry;

/// Asks the programs that the chain uses for their stages and adds these to the registry. Nothing is started unless
/// its name is in `allowed`.
pub fn connect(
    document: &Document<'_>,
    folder: &Path,
    allowed: &BTreeSet<String>,
    stop: &Arc<Stop>,
    registry: &mut Registry,
    report: &mut Report,
) {
    for plugin in &document.plugins {
        let prefix = format!("{}.", plugin.name);
        if !document.stages.iter().any(|s| s.name.get_ref().starts_with(&prefix)) {
            continue;
        }
        // A study opens one pipeline many times; its programs are asked once.
        if registry.iter().any(|s| s.info().name.starts_with(&prefix)) {
            continue;
        }
        if !allowed.contains(&plugin.name) {
            let command = plugin.command.join(" ");
            let message = format!("the pipeline wants to run the program `{command}` as plugin `{}`", plugin.name);
            let hint = format!("if you trust it, pass --allow-run {}", plugin.name);
            report.push(document.source.error(codes::PLUGIN_NEEDS_CONSENT, &plugin.span, message).hint(hint));
            continue;
        }
        let program = Program::new(plugin, folder, Arc::clone(stop));
        match stage::describe(&program, &plugin.name) {
            Ok(stages) => {
                for stage in stages {
                    if let Err(error) = registry.add(Box::new(stage)) {
                        report.push(document.source.error(codes::PLUGIN_PROTOCOL, &plugin.span, error.to_string()));
                    }
                }
            }
            Err(error) => {
                let message = format!("plugin `{}`: {error}", plugin.name);
                let finding = document.source.error(codes::PLUGIN_PROTOCOL, &plugin.span, message);
                report.push(finding.hint("run the program by hand with the argument `describe`"));
            }
        }
    }
}
