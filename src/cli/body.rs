//! `toile body`: a body from measures, as OBJ with its side file.

use super::args::BodyArgs;
use super::codes;
use super::console::Console;
use super::results::Results;
use crate::codes::{SET_FORM, WRONG_VALUE};
use crate::engine::Exit;
use crate::pipeline::remedy;
use std::fmt::Write as _;
use std::path::Path;
use toile_formats::body::write;
use toile_formats::codes::SIZE_NOT_FOUND;
use toile_garment::units::Length;
use toile_garment::{Code, Diagnostic};
use toile_stages::body::{BodyMeasures, SIZES, parametric};

pub(super) fn run(args: &BodyArgs, console: &mut Console<'_>) -> Exit {
    let Some(out) = &args.out else {
        console.result(&sizes());
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
        let labels: Vec<&str> = SIZES.iter().map(|(l, _)| *l).collect();
        let message = format!("there is no body of size `{label}`");
        let hint = format!("sizes are {}; others are made with --set", labels.join(", "));
        wrong.push(Diagnostic::error(SIZE_NOT_FOUND, message).hint(hint));
        BodyMeasures::default()
    });
    for set in &args.set {
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
    if measures.set(name, length.0) {
        return Ok(());
    }
    let known = measures.entries();
    let hint = remedy(name, known.iter().map(|(known, _)| *known));
    Err(error(codes::UNKNOWN_MEASURE, format!("a body has no measure `{name}`"), hint))
}

/// Sizes side by side, one measure a line.
fn sizes() -> String {
    let bodies: Vec<BodyMeasures> = SIZES.iter().filter_map(|(label, _)| BodyMeasures::size(label)).collect();
    let mut text = format!("{:<18}", "measure in mm");
    for (label, _) in SIZES {
        let _ = write!(text, "{label:>8}");
    }
    text.push('\n');
    let names = BodyMeasures::default().entries().map(|(name, _)| name);
    for (row, name) in names.iter().enumerate() {
        let _ = write!(text, "{name:<18}");
        for body in &bodies {
            let value = body.entries().get(row).map_or(0.0, |e| e.1);
            let _ = write!(text, "{:>8.1}", 1000.0 * value);
        }
        text.push('\n');
    }
    text
}
