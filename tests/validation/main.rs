//! Physics cases with a known answer, run the way a user runs them. A cloth mesh, pins, loads and a fabric file are
//! written to a folder. `import-mesh` → `drape` → `export-obj` runs, with `animate` where time matters. The result is
//! measured against a closed form computed here.
//!
//! ```text
//! cargo test --release -p toile --test validation                       # the quick cases; they must be good
//! cargo test --release -p toile --test validation -- --all              # every case, as a table
//!
//! cargo test --release -p toile --test validation -- --all hang sleeve  # cases whose name holds one of these words
//! cargo test --release -p toile --test validation -- --list
//! ```
//!
//! More switches: `--accuracy`, `--model`, `--integrator` (keys of the drape, as in a pipeline), `--cap SECONDS` (CPU
//! time of one case, 60), `--json FILE`, `--keep FOLDER` (leaves the files of every run there). Verdicts: `good` within
//! the tolerance a converged solver reaches, `poor` within the one past which the model is wrong for the case, `bad`
//! beyond it or without a result. The exit code is 1 when any is bad, or a quick one not good.
#![allow(clippy::print_stdout, clippy::expect_used, clippy::unwrap_used, missing_docs)]

mod case;
mod cases;
mod closed;
mod lab;
mod motion;
mod options;
#[path = "../support/mod.rs"]
mod support;
mod table;

use std::process::ExitCode;

fn main() -> ExitCode {
    let options = match options::read(std::env::args().skip(1)) {
        Ok(options) => options,
        Err(why) => {
            println!("{why}");
            return ExitCode::from(2);
        }
    };
    let chosen: Vec<_> = cases::all().into_iter().filter(|c| options.takes(c)).collect();
    if options.common.list {
        chosen.iter().for_each(|c| println!("{}: test", c.name));
        return ExitCode::SUCCESS;
    }
    println!("{}", table::head());
    let mut rows = Vec::new();
    for case in &chosen {
        let result = case::run(case, &options);
        result.iter().for_each(|row| println!("{}", table::line(row)));
        rows.extend(result);
    }
    println!("{}", table::summary(&rows));
    if let Some(file) = &options.common.json {
        std::fs::write(file, table::json(&rows)).expect("the table is written");
    }
    let wrong =
        |r: &case::Row| r.verdict == case::Verdict::Bad || (!options.common.all && r.verdict != case::Verdict::Good);
    ExitCode::from(u8::from(rows.iter().any(wrong)))
}
