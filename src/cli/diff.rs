//! `toile diff`: what differs between two results.

use super::args::{DiffArgs, DiffFormat};
use super::console::Console;
use crate::codes::WRONG_VALUE;
use crate::diff::{self, Tolerance, read_tolerance};
use crate::engine::{Exit, clean, of_file_error, read_limited};
use std::path::Path;
use toile_garment::{Diagnostic, SourceRef};

/// Largest file of tolerances, bytes.
const MAX_TOLERANCE: u64 = 1 << 20;

pub(super) fn run(args: &DiffArgs, console: &mut Console<'_>) -> Exit {
    let (a, b) = match (diff::open(&args.a), diff::open(&args.b)) {
        (Ok(a), Ok(b)) => (a, b),
        (a, b) => {
            let findings: Vec<Diagnostic> = [a.err(), b.err()].into_iter().flatten().collect();
            console.findings(&findings, None);
            return Exit::Input;
        }
    };
    let tolerance = match args.tolerance.as_deref().map_or(Ok(Tolerance::default()), tolerance) {
        Ok(tolerance) => tolerance,
        Err(findings) => {
            console.findings(&findings, None);
            return Exit::Usage;
        }
    };
    let changes = diff::diff(&a, &b);
    match args.format {
        DiffFormat::Text => console.result(&crate::render::safe(&diff::text(&a, &b, &changes, &tolerance))),
        DiffFormat::Json => console.json(&diff::to_json(&a, &b, &changes, &tolerance)),
        DiffFormat::Html => console.result(&diff::html(&a, &b, &changes, &tolerance)),
    }
    if changes.iter().any(|c| tolerance.is_over(c)) { Exit::Gate } else { Exit::Good }
}

fn tolerance(path: &Path) -> Result<Tolerance, Vec<Diagnostic>> {
    let bytes = read_limited(path, path, MAX_TOLERANCE).map_err(|e| of_file_error(&e).0)?;
    read_tolerance(&String::from_utf8_lossy(&bytes)).map_err(|why| {
        let finding = Diagnostic::error(WRONG_VALUE, why.trim_end().to_owned()).at(SourceRef::file(clean(path)));
        vec![finding.hint("write e.g. darts = \"2 mm\", strain = 0.01 or inputs = \"same\"")]
    })
}
