//! `toile validate drape`: measured drapes of real cloth, predicted.

mod args;

pub use args::ValidateArgs;

use super::bench::{check_folder, is_new, tell, write_files};
use super::console::Console;
use crate::engine::{Exit, MAX_INPUT, Stop, clean, of_file_error, of_stage_error, read_limited};
use crate::halt::Halt;
use crate::validate::rows::{Order, VERSION};
use crate::validate::{Captured, Validation, captured, chart, table, validate};
use args::{ValidateVerb, ValidatedDrapeArgs};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toile_garment::Diagnostic;
use toile_stages::text::text;

/// Names of the results.
const FILES: [&str; 3] = ["validate.json", "validate.svg", "validate.md"];

pub(super) fn run(args: &ValidateArgs, stop: &Arc<Stop>, console: &mut Console<'_>) -> Exit {
    let ValidateVerb::Drape(args) = &args.verb;
    match work(args, stop, console) {
        Ok(exit) => exit,
        Err(halt) => console.halted(&halt),
    }
}

fn work(args: &ValidatedDrapeArgs, stop: &Arc<Stop>, console: &mut Console<'_>) -> Result<Exit, Halt> {
    let (captures, warnings) = read(&args.captures)?;
    console.findings(&warnings, None);
    let name = args.captures.file_name().map_or_else(String::new, |n| n.to_string_lossy().into_owned());
    let stem = args.captures.file_stem().map_or_else(String::new, |n| n.to_string_lossy().into_owned());
    let out = args.out.clone().unwrap_or_else(|| PathBuf::from("out").join(format!("{stem}-validate")));
    check_folder(&out, (FILES[0], "toile_validate", "captures"), &name).map_err(Halt::usage)?;
    if !args.force {
        is_new(&out, FILES[0], "validation").map_err(Halt::usage)?;
    }
    super::run::pool(args.threads);
    let order = Order { edge: args.edge.0, falls: args.falls, cancel: stop.flag() };
    let mut say = |what: &str| {
        if !args.quiet {
            console.say(&format!("validate {what}\n"));
        }
    };
    let (rows, costs) = validate(&captures, &order, &mut say).map_err(|error| {
        let (findings, exit) = of_stage_error(error);
        Halt::new(findings, exit)
    })?;
    let validation = Validation {
        toile_validate: VERSION,
        toile: env!("CARGO_PKG_VERSION").to_owned(),
        captures: name,
        edge_mm: 1e3 * args.edge.0,
        falls: args.falls,
        rows,
        costs,
    };
    let json = toile_garment::text::json(&serde_json::to_string_pretty(&validation).unwrap_or_default()) + "\n";
    let said = if args.json { json.clone() } else { table::text(&validation) };
    write_files(&out, &FILES, &[json, chart::svg(&validation), table::markdown(&validation)])?;
    tell(&said, &out, &FILES, console);
    Ok(if validation.judges() { Exit::Good } else { Exit::Gate })
}

/// The captures, and warnings.
fn read(path: &Path) -> Result<(Vec<Captured>, Vec<Diagnostic>), Halt> {
    let name = clean(path);
    let bytes = read_limited(path, path, MAX_INPUT).map_err(|e| {
        let (findings, exit) = of_file_error(&e);
        Halt::new(findings, exit)
    })?;
    let table = text(&name, &bytes).map_err(|finding| Halt::new(vec![finding], Exit::Input))?;
    captured(&table, &name).map_err(|findings| Halt::new(findings, Exit::Input))
}
