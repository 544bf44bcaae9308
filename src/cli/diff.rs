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
    let tolerance = match args.tolerance.as_deref().map_or(Ok(Tolerance::default()), tolerance) {
        Ok(tolerance) => tolerance,
        Err(findings) => {
            console.findings(&findings, None);
            return Exit::Usage;
        }
    };
    if tolerance.is_empty() {
        let message = "the file states no tolerance, so nothing is judged";
        let finding = Diagnostic::warning(diff::codes::TOLERANCE_EMPTY, message);
        console.findings(&[finding.hint("write e.g. darts = \"2 mm\", or leave out --tolerance")], None);
    }
    let ended = if [&args.a, &args.b].iter().all(|path| diff::is_line(path)) {
        lines(args, &tolerance, console)
    } else {
        results(args, &tolerance, console)
    };
    match ended {
        Ok(is_over) => {
            if is_over {
                Exit::Gate
            } else {
                Exit::Good
            }
        }
        Err(findings) => {
            console.findings(&findings, None);
            Exit::Input
        }
    }
}

/// Both sides, or all that is wrong with them.
fn both<T>(a: Result<T, Diagnostic>, b: Result<T, Diagnostic>) -> Result<[T; 2], Vec<Diagnostic>> {
    match (a, b) {
        (Ok(a), Ok(b)) => Ok([a, b]),
        (a, b) => Err([a.err(), b.err()].into_iter().flatten().collect()),
    }
}

/// Two versions of a line. Gives whether a difference is over its tolerance.
fn lines(args: &DiffArgs, tolerance: &Tolerance, console: &mut Console<'_>) -> Result<bool, Vec<Diagnostic>> {
    let [a, b] = both(diff::open_line(&args.a), diff::open_line(&args.b))?;
    let (sides, jobs) = ([&a, &b], diff::diff_lines(&a, &b));
    match args.format {
        DiffFormat::Text => console.result(&crate::render::safe(&diff::lines_text(sides, &jobs, tolerance))),
        DiffFormat::Json => console.json(&diff::lines_json(sides, &jobs, tolerance)),
        DiffFormat::Html => console.result(&diff::lines_html(sides, &jobs, tolerance, args.language.language())),
    }
    Ok(jobs.iter().any(|j| j.is_over(tolerance)))
}

/// Two results. Gives whether a difference is over its tolerance.
fn results(args: &DiffArgs, tolerance: &Tolerance, console: &mut Console<'_>) -> Result<bool, Vec<Diagnostic>> {
    let [a, b] = both(diff::open(&args.a), diff::open(&args.b))?;
    let changes = diff::diff(&a, &b);
    match args.format {
        DiffFormat::Text => console.result(&crate::render::safe(&diff::text(&a, &b, &changes, tolerance))),
        DiffFormat::Json => console.json(&diff::to_json(&a, &b, &changes, tolerance)),
        DiffFormat::Html => console.result(&diff::html([&a, &b], &changes, tolerance, args.language.language())),
    }
    Ok(changes.iter().any(|c| tolerance.is_over(c)))
}

fn tolerance(path: &Path) -> Result<Tolerance, Vec<Diagnostic>> {
    let bytes = read_limited(path, path, MAX_TOLERANCE).map_err(|e| of_file_error(&e).0)?;
    let text = toile_stages::text::text(&clean(path), &bytes).map_err(|finding| vec![finding])?;
    read_tolerance(&text).map_err(|why| {
        let finding = Diagnostic::error(WRONG_VALUE, why.trim_end().to_owned()).at(SourceRef::file(clean(path)));
        vec![finding.hint("write e.g. darts = \"2 mm\", strain = 0.01 or inputs = \"same\"")]
    })
}
