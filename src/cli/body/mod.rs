//! `toile body`: a body from measures, as OBJ with its side file, and the measures of a mesh.

mod measure;
mod picture;

use super::args::{BodyArgs, BodyVerb};
use super::codes;
use super::console::Console;
use super::results::Results;
use crate::codes::{SET_FORM, WRONG_VALUE};
use crate::engine::Exit;
use crate::pipeline::remedy;
use std::fmt::Write as _;
use std::path::Path;
use toile_formats::body::write;
use toile_garment::units::Length;
use toile_garment::{Code, Diagnostic};
use toile_stages::body::{BodyMeasures, SIZE_TABLES, SizeTable, parametric};

pub(super) fn run(args: &BodyArgs, console: &mut Console<'_>) -> Exit {
    if let Some(BodyVerb::Measure(args)) = &args.verb {
        return measure::run(args, console);
    }
    let Some(out) = &args.out else {
        let tables: Vec<String> = SIZE_TABLES.iter().map(table).collect();
        let names = BodyMeasures::default().entries().map(|(name, _)| name).join(", ");
        console.result(&format!("{}\nmeasures for --set: {names}\n", tables.join("\n")));
        return Exit::Good;
    };
    let side = out.with_extension("toml");
    let results = Results::new(args.force, &[]);
    let findings = match measures(args, out) {
        Ok(_) if !results.are_free(&[out, &side], console) => return Exit::Usage,
        Ok(measures) => match parametric(&measures) {
            Ok(body) => {
                let (mesh, text) = write(&body);
                return results.write_all(&[(out, mesh.as_bytes()), (&side, text.as_bytes())], console);
            }
            Err(findings) => findings,
        },
        Err(findings) => findings,
    };
    console.findings(&findings, None);
    Exit::Usage
}

/// The measures asked for; all mistakes at once.
fn measures(args: &BodyArgs, out: &Path) -> Result<BodyMeasures, Vec<Diagnostic>> {
    let mut wrong = Vec::new();
    if !out.extension().is_some_and(|e| e.eq_ignore_ascii_case("obj")) {
        let message = format!("`{}` is no name for a mesh", crate::engine::clean(out));
        wrong.push(Diagnostic::error(WRONG_VALUE, message).hint("name it FILE.obj; the side file is FILE.toml"));
    }
    let label = args.size.as_deref().unwrap_or("38");
    let mut measures = BodyMeasures::size(label).unwrap_or_else(|| {
        wrong.push(crate::new::no_size(label));
        BodyMeasures::default()
    });
    // Heights go with the stature; what is set besides has the last word.
    let (stature, others): (Vec<&String>, Vec<&String>) =
        args.set.iter().partition(|s| s.trim().starts_with("stature"));
    for set in stature.into_iter().chain(others) {
        if let Err(finding) = apply(&mut measures, set) {
            wrong.push(*finding);
        }
    }
    if let (false, Some(stem)) = (args.set.is_empty(), out.file_stem()) {
        measures.name = stem.to_string_lossy().into_owned();
    }
    if wrong.is_empty() { Ok(measures) } else { Err(wrong) }
}

fn apply(measures: &mut BodyMeasures, set: &str) -> Result<(), Box<Diagnostic>> {
    let error = |code: Code, message: String, hint: String| Box::new(Diagnostic::error(code, message).hint(hint));
    let Some((name, text)) = set.split_once('=') else {
        let message = format!("`--set {set}` is not MEASURE=LENGTH");
        return Err(error(SET_FORM, message, "e.g. --set waist_girth=\"700 mm\"".to_owned()));
    };
    let (name, text) = (name.trim(), text.trim().trim_matches('"'));
    let length: Length = text
        .parse()
        .map_err(|e| error(WRONG_VALUE, format!("{name}: {e}"), "write a number and a unit, e.g. 700 mm".to_owned()))?;
    if name == "stature" && length.0 > 0.0 {
        *measures = measures.grown(length.0);
        return Ok(());
    }
    if measures.set(name, length.0) {
        return Ok(());
    }
    let known = measures.entries();
    let hint = remedy(name, known.iter().map(|(known, _)| *known));
    Err(error(codes::UNKNOWN_MEASURE, format!("a body has no measure `{name}`"), hint))
}

/// A table of sizes, one size a line: lengths, then girths.
fn table(table: &SizeTable) -> String {
    let bodies: Vec<(String, BodyMeasures)> = table.sizes.iter().map(|s| (table.name(s), table.measures(s))).collect();
    let names = BodyMeasures::default().entries().map(|(name, _)| name);
    let mut text = format!("{}, {}; measures in mm\n", table.word, table.about);
    for part in names.chunk_by(|a, b| a.ends_with("girth") == b.ends_with("girth")) {
        let halves: Vec<(&str, &str)> = part.iter().map(|name| name.rsplit_once('_').unwrap_or(("", name))).collect();
        let width = |k: usize| 1 + halves[k].0.len().max(halves[k].1.len()).max(5);
        let mut row = |first: &str, cell: &dyn Fn(usize) -> String| {
            let _ = write!(text, "{first:<10}");
            (0..part.len()).for_each(|k| {
                let _ = write!(text, "{:>1$}", cell(k), width(k));
            });
            text.push('\n');
        };
        row("", &|k| halves[k].0.to_owned());
        row("", &|k| halves[k].1.to_owned());
        for (size, body) in &bodies {
            let entries = body.entries();
            let value = |k: usize| entries.iter().find(|e| e.0 == part[k]).map_or(0.0, |e| 1000.0 * e.1);
            row(size, &|k| format!("{:.0}", value(k)));
        }
    }
    text
}
