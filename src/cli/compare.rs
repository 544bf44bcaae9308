//! `toile compare`: one garment by the paper's method, by its neighbours and by the program's own.

use super::args::CompareArgs;
use super::bench::{Chain, check_folder, is_new, tell, write_files};
use super::console::Console;
use crate::codes::UNKNOWN_VALUE;
use crate::compare::rows::VERSION;
use crate::compare::{Comparison, Listener, METHODS, Method, Shown, compare, page, table};
use crate::engine::{Exit, Stop};
use crate::halt::Halt;
use crate::progress::Voice;
use crate::study::Bench;
use std::path::PathBuf;
use std::sync::Arc;
use toile_garment::Diagnostic;
use toile_stage_api::Registry;

/// Names of the results.
const FILES: [&str; 3] = ["compare.json", "compare.html", "compare.md"];

pub(super) fn run(args: &CompareArgs, registry: &mut Registry, stop: &Arc<Stop>, console: &mut Console<'_>) -> Exit {
    match work(args, registry, stop, console) {
        Ok(exit) => exit,
        Err(halt) => console.halted(&halt),
    }
}

fn work(
    args: &CompareArgs,
    registry: &mut Registry,
    stop: &Arc<Stop>,
    console: &mut Console<'_>,
) -> Result<Exit, Halt> {
    let methods = methods(&args.methods).map_err(Halt::usage)?;
    let chain = Chain::look(&args.pipeline, registry, stop)?;
    let threads = super::run::pool(args.threads);
    let out = args.out.clone().unwrap_or_else(|| PathBuf::from("out").join(format!("{}-compare", chain.file_name)));
    check_folder(&out, (FILES[0], "toile_compare", "pipeline"), &chain.name).map_err(Halt::usage)?;
    if !args.force {
        is_new(&out, FILES[0], "comparison").map_err(Halt::usage)?;
    }
    // Times are to be those of this machine, and pictures need the body, which a kept garment has not: all is run anew.
    // A method that fails its certificate is a result here, and the table tells it.
    let (request, voice) = (args.pipeline.request(), Voice::Silent);
    let bench = Bench { request, out: out.clone(), threads, force: true, voice, stop };
    let (quiet, language) = (args.quiet, args.language.language());
    let mut say = |what: &str| {
        if !quiet {
            console.say(&format!("compare {what}\n"));
        }
    };
    let mut said = String::new();
    // Rows that are through stay when the rest is stopped.
    let mut keep = |shown: &[Shown], triangles: usize| {
        let comparison = Comparison {
            toile_compare: VERSION,
            toile: env!("CARGO_PKG_VERSION").to_owned(),
            pipeline: chain.name.clone(),
            threads,
            triangles,
            rows: shown.iter().map(|s| s.row.clone()).collect(),
        };
        let json = toile_garment::text::json(&serde_json::to_string_pretty(&comparison).unwrap_or_default()) + "\n";
        said = if args.json { json.clone() } else { table::text(&comparison) };
        write_files(&out, &FILES, &[json, page::html(&comparison, shown, language), table::markdown(&comparison)])
    };
    compare(&bench, &methods, registry, Listener { say: &mut say, keep: &mut keep })?;
    tell(&said, &out, &FILES, console);
    Ok(Exit::Good)
}

/// The methods of these names, in the order of the table; without any name those that run by default.
fn methods(names: &[String]) -> Result<Vec<&'static Method>, Diagnostic> {
    if let Some(unknown) = names.iter().find(|n| METHODS.iter().all(|m| m.name != n.as_str())) {
        let known = METHODS.map(|m| m.name).join(", ");
        let message = format!("--methods: there is no method `{}`", crate::render::safe(unknown));
        return Err(Diagnostic::error(UNKNOWN_VALUE, message).hint(format!("the methods are {known}")));
    }
    let is_asked = |m: &&Method| {
        if names.is_empty() { m.runs_by_default() } else { names.iter().any(|n| n == m.name) }
    };
    Ok(METHODS.iter().filter(is_asked).collect())
}
