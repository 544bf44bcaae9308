//! `toile flatten GARMENT`: 3D → 2D from the garment's file alone, by the same stages a pipeline uses.

use super::args::FlattenArgs;
use super::console::Console;
use super::results::Results;
use crate::engine::{Exit, MAX_INPUT, Memory, Stop, clean, of_file_error, of_stage_error, read_limited, run_alone};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toile_formats::codes::UNKNOWN_KEY;
use toile_formats::garment_file;
use toile_garment::flat::Flat;
use toile_garment::seam::SeamKind;
use toile_garment::{Diagnostic, Garment, Report, SourceRef};
use toile_stage_api::{Registry, StageError};
use toile_stages::flatten::json as flatten_json;

/// The stage that flattens, and the tap that writes its result to the parameter `file`.
const FLATTEN: &str = "flatten";
const DXF_TAP: &str = "export-dxf";

pub(super) fn run(args: &FlattenArgs, registry: &Registry, stop: &Arc<Stop>, console: &mut Console<'_>) -> Exit {
    let mut report = Report::default();
    let inputs = std::iter::once(&args.garment).chain(&args.document).chain(&args.tolerance).chain(&args.grade_from);
    let inputs: Vec<&Path> = inputs.map(PathBuf::as_path).collect();
    let results = Results::new(args.force, &inputs);
    let rules = rule_table(args);
    let wanted: Vec<&Path> =
        args.dxf.iter().chain(&args.sewing).chain(&rules).chain(&args.json).map(PathBuf::as_path).collect();
    if !results.are_free(&wanted, console) {
        return Exit::Usage;
    }
    let garment = match read(args, &mut report) {
        Ok(garment) => garment,
        Err((findings, exit)) => {
            console.findings(&findings, None);
            return exit;
        }
    };
    let written = flatten(args, registry, stop, garment, &mut report);
    match written {
        Ok(Flattened { summary, files, over_tolerance }) => {
            console.findings(&report.findings, None);
            console.result(&crate::render::safe(&summary));
            let files: Vec<(&Path, &[u8])> = files.iter().map(|(path, bytes)| (path.as_path(), &bytes[..])).collect();
            match results.write_all(&files, console) {
                Exit::Good if over_tolerance => Exit::Gate,
                exit => exit,
            }
        }
        Err(error) => {
            let (findings, exit) = of_stage_error(error);
            report.findings.extend(findings);
            console.findings(&report.findings, None);
            exit
        }
    }
}

fn read(args: &FlattenArgs, report: &mut Report) -> Result<Garment, (Vec<Diagnostic>, Exit)> {
    let bytes = |path: &Path| read_limited(path, path, MAX_INPUT).map_err(|e| of_file_error(&e));
    let (garment, name) = (bytes(&args.garment)?, clean(&args.garment));
    match &args.document {
        None => garment_file::read(&garment, &name, report),
        Some(path) => garment_file::read_by_document((&garment, &name), (&bytes(path)?, &clean(path)), report),
    }
    .map_err(|finding| (vec![finding], Exit::Input))
}

/// Where the rule table of the sizes is written.
fn rule_table(args: &FlattenArgs) -> Option<PathBuf> {
    args.grade_from.as_ref().and(args.dxf.as_ref()).map(|dxf| dxf.with_extension("rul"))
}

/// Gives the pattern whose sizes are carried to a stage, and the rule table beside it. The name that it is called by.
fn give_sizes(pattern: &Path, files: &mut Memory) -> Result<String, StageError> {
    let name = Path::new(pattern.file_name().unwrap_or_default());
    let mut give = |from: &Path, name: &Path| -> Result<(), StageError> {
        files.give(&name.to_string_lossy(), read_limited(from, from, MAX_INPUT).map_err(StageError::File)?);
        Ok(())
    };
    give(pattern, name)?;
    let table = pattern.with_extension("rul");
    if table.is_file() {
        give(&table, &name.with_extension("rul"))?;
    }
    Ok(name.to_string_lossy().into_owned())
}

/// The parameters of the stage, as a pipeline writes them.
fn parameters(args: &FlattenArgs) -> Result<String, StageError> {
    let text = |t: &String| toml::Value::String(t.clone()).to_string();
    let mut parts = Vec::new();
    for (key, value) in [("metric", &args.metric), ("smooth", &args.smooth), ("symmetry", &args.symmetry)] {
        parts.extend(value.as_ref().map(|v| format!("{key} = {}", text(v))));
    }
    if !args.lock.is_empty() {
        let kinds: Vec<String> = args.lock.iter().filter(|k| *k != "none").map(text).collect();
        parts.push(format!("lock = [{}]", kinds.join(", ")));
    }
    if let Some(path) = &args.tolerance {
        let bytes = read_limited(path, path, MAX_INPUT).map_err(StageError::File)?;
        let wrong =
            |e: String| StageError::parameter(Diagnostic::error(UNKNOWN_KEY, e).at(SourceRef::file(clean(path))));
        let text = toile_stages::text::text(&clean(path), &bytes).map_err(StageError::input)?;
        let table: toml::Table = toml::from_str(&text).map_err(|e| wrong(e.message().to_owned()))?;
        parts.push(format!("tolerance = {}", toml::Value::Table(table)));
    }
    Ok(format!("{{ {} }}", parts.join(", ")))
}

/// The result that is told and written.
struct Flattened {
    /// For a person.
    summary: String,
    files: Vec<(PathBuf, Vec<u8>)>,
    /// Does a piece fail what was asked for?
    over_tolerance: bool,
}

fn flatten(
    args: &FlattenArgs,
    registry: &Registry,
    stop: &Arc<Stop>,
    garment: Garment,
    report: &mut Report,
) -> Result<Flattened, StageError> {
    let mut files = Memory::default();
    let garment = run_alone(registry, (FLATTEN, &parameters(args)?), garment, stop, report, &mut files)?;
    let internal = |what: &str| StageError::Internal(what.to_owned());
    let flat = garment.flat.as_ref().ok_or_else(|| internal("`flatten` gave no flat pieces"))?;
    let (summary, over_tolerance) = (summary(&garment, flat), flat.over_tolerance.is_some_and(|count| count > 0));
    let mut results = Vec::new();
    if let Some(path) = &args.json {
        let value = flatten_json(&garment, flat);
        let text = serde_json::to_string(&value).map_err(|e| StageError::Internal(format!("flat as JSON: {e}")))?;
        results.push((path.clone(), (toile_garment::text::json(&text) + "\n").into_bytes()));
    }
    if let Some(dxf) = &args.dxf {
        let given = [("file", Some(dxf)), ("sewing", args.sewing.as_ref())];
        let named: Vec<(&str, &PathBuf)> = given.iter().filter_map(|(key, path)| Some((*key, (*path)?))).collect();
        let mut parts: Vec<String> = named.iter().map(|(key, _)| format!("{key} = \"{{out}}/{key}\"")).collect();
        if let Some(pattern) = &args.grade_from {
            let name = give_sizes(pattern, &mut files)?;
            parts.push(format!("grade_from = {}", toml::Value::String(name)));
        }
        let params = format!("{{ {} }}", parts.join(", "));
        run_alone(registry, (DXF_TAP, &params), garment, stop, report, &mut files)?;
        for (key, path) in named {
            results.push((path.clone(), files.take(key)?));
        }
        if let Some(path) = rule_table(args) {
            results.push((path, files.take("file.rul")?));
        }
    }
    Ok(Flattened { summary, files: results, over_tolerance })
}

/// The figures that matter, one line a piece, dart and sewn pair.
fn summary(garment: &Garment, flat: &Flat) -> String {
    let mut text = String::new();
    let changes = crate::fit::changes(garment);
    for f in &flat.pieces {
        let name = garment.pieces.get(f.piece.index()).map_or("?", |p| p.name.as_str());
        let [original, new, _] = f.area.map(|a| 1e4 * a);
        let change = if original > 0.0 { unsigned_zero(100.0 * (new / original - 1.0), 1e-3) } else { 0.0 };
        let edges = f.edges.iter().map(|e| (e.flat - e.original).abs()).fold(0.0, f64::max);
        let _ = writeln!(
            text,
            "{name:<20} {new:>9.2} cm2 ({change:+.3} %), edges within {:.3} mm, piece turned {:.3}° against its grain",
            1e3 * edges,
            unsigned_zero(f.grain_shift.to_degrees(), 1e-3)
        );
        if let Some(verdict) = flat.verdicts.iter().find(|v| v.piece == f.piece) {
            let fails = verdict.fails();
            let words = if fails.is_empty() { "passes".to_owned() } else { format!("fails: {}", fails.join("; ")) };
            let _ = writeln!(text, "  {words}");
        }
        for change in changes.iter().filter(|c| c.piece == name && c.angle.is_none()) {
            let _ = writeln!(text, "  {:<18} {}", change.what, change.words());
        }
        for d in &f.darts {
            let [before, after] = [0, 1].map(|k| format!("{:.1} mm {:.2}°", 1e3 * d.width[k], d.angle[k].to_degrees()));
            let legs = [d.legs[2], d.legs[3]].map(|l| 1e3 * l);
            let intake =
                if before == after { format!("intake {after}") } else { format!("intake {before} → {after}") };
            let _ = writeln!(text, "  {:<18} {intake}, legs {:.1} and {:.1} mm", d.name, legs[0], legs[1]);
        }
    }
    // The legs of darts stand beside their darts.
    let is_seam = |k: usize| garment.seams.get(k).is_none_or(|s| s.kind == SeamKind::Seam);
    for (_, p) in flat.pairs.iter().enumerate().filter(|(k, _)| is_seam(*k)) {
        let error = unsigned_zero(1e3 * ((p.a[1] - p.b[1]) - (p.a[0] - p.b[0])), 1e-4);
        let _ = writeln!(
            text,
            "seam {:<15} {:.2} mm on {:.2} mm, ease changed {error:+.4} mm",
            p.name,
            1e3 * p.a[1],
            1e3 * p.b[1]
        );
    }
    text
}

/// A number that is shown in these steps: what rounds to nothing has no sign.
fn unsigned_zero(x: f64, step: f64) -> f64 {
    if x.abs() < 0.5 * step { 0.0 } else { x }
}
