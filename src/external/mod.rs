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
use crate::pipeline::{Document, Plugin, ProgramContent};
use process::Program;
use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;
use toile_garment::{Diagnostic, Report};
use toile_stage_api::Registry;

/// Fewest digits of a digest that name a content.
const LEAST_DIGITS: usize = 16;

/// Why a program may not be run. Consent is given to a name, or to a name and a content. A content that the pipeline
/// states must be there, too.
fn refuse(document: &Document<'_>, plugin: &Plugin, digest: &str, allowed: &BTreeSet<String>) -> Option<Diagnostic> {
    let (name, short) = (&plugin.name, &digest[..LEAST_DIGITS]);
    let agrees = |wanted: &str| wanted.len() >= LEAST_DIGITS && digest.starts_with(wanted);
    if let Some(stated) = plugin.content.as_ref().filter(|c| !agrees(c.get_ref())) {
        let message = format!("the program of plugin `{name}` is not the one that is stated: its content is {digest}");
        let finding = document.source.error(codes::PLUGIN_CHANGED, &stated.span(), message);
        return Some(finding.hint(format!("see what changed in it; if you trust it, write content = \"{short}\"")));
    }
    let content = |word: &'_ String| word.strip_prefix(name.as_str())?.strip_prefix('=').map(str::to_owned);
    let contents: Vec<String> = allowed.iter().filter_map(content).collect();
    if contents.iter().any(|c| agrees(c)) || (contents.is_empty() && allowed.contains(name)) {
        return None;
    }
    let (code, message) = if contents.is_empty() {
        let command = plugin.command.join(" ");
        (codes::PLUGIN_NEEDS_CONSENT, format!("the pipeline wants to run the program `{command}` as plugin `{name}`"))
    } else {
        let message = "is not the one that was allowed: its content is";
        (codes::PLUGIN_CHANGED, format!("the program of plugin `{name}` {message} {digest}"))
    };
    let hint =
        format!("if you trust it, pass --allow-run {name}, or --allow-run {name}={short} for this content alone");
    Some(document.source.error(code, &plugin.span, message).hint(hint))
}

/// The plugins that the chain uses.
fn used<'d>(document: &'d Document<'_>) -> impl Iterator<Item = &'d Plugin> {
    let is_used = |plugin: &&Plugin| {
        let prefix = format!("{}.", plugin.name);
        document.stages.iter().any(|s| s.name.get_ref().starts_with(&prefix))
    };
    document.plugins.iter().filter(is_used)
}

/// Digests of the programs that the chain uses. Nothing is started.
pub fn contents(document: &Document<'_>, folder: &Path, allowed: &BTreeSet<String>) -> Vec<ProgramContent> {
    let content = |plugin: &Plugin| ProgramContent {
        plugin: plugin.name.clone(),
        content: Program::new(plugin, folder, Stop::new()).digest().to_owned(),
        is_stated: plugin.content.is_some() || allowed.iter().any(|a| a.starts_with(&format!("{}=", plugin.name))),
    };
    used(document).map(content).collect()
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
    for plugin in used(document) {
        let prefix = format!("{}.", plugin.name);
        // A study opens one pipeline many times; its programs are asked once.
        if registry.iter().any(|s| s.info().name.starts_with(&prefix)) {
            continue;
        }
        let program = Program::new(plugin, folder, Arc::clone(stop));
        if let Some(refusal) = refuse(document, plugin, program.digest(), allowed) {
            report.push(refusal);
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
