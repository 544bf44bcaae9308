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

pub use protocol::{Description, Line, OLDEST_PROTOCOL, PROTOCOL, Request, StageDescription};
pub use stage::ExternalStage;

use crate::engine::Stop;
use crate::pipeline::{Document, Plugin};
use process::Program;
use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;
use toile_garment::Report;
use toile_stage_api::Registry;

/// Fewest digits of a digest that name a content.
const LEAST_DIGITS: usize = 16;

/// Message and remedy where a program may not be run. Consent is given to a name, or to a name and a content.
fn refuse(plugin: &Plugin, digest: &str, allowed: &BTreeSet<String>) -> Option<(String, String)> {
    let name = &plugin.name;
    let content = |word: &String| word.strip_prefix(name.as_str())?.strip_prefix('=').map(str::to_owned);
    let agrees = |wanted: &String| wanted.len() >= LEAST_DIGITS && digest.starts_with(wanted.as_str());
    let contents: Vec<String> = allowed.iter().filter_map(content).collect();
    if contents.iter().any(agrees) || (contents.is_empty() && allowed.contains(name)) {
        return None;
    }
    let message = if contents.is_empty() {
        format!("the pipeline wants to run the program `{}` as plugin `{name}`", plugin.command.join(" "))
    } else {
        format!("the program of plugin `{name}` is not the one that was allowed: its content is {digest}")
    };
    let hint = format!(
        "if you trust it, pass --allow-run {name}, or --allow-run {name}={} for this content alone",
        &digest[..LEAST_DIGITS]
    );
    Some((message, hint))
}

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
        let program = Program::new(plugin, folder, Arc::clone(stop));
        if let Some(refusal) = refuse(plugin, program.digest(), allowed) {
            let (message, hint) = refusal;
            report.push(document.source.error(codes::PLUGIN_NEEDS_CONSENT, &plugin.span, message).hint(hint));
            continue;
        }
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
