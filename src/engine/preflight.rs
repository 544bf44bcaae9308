//! Checks of files before any work: inputs are there and allowed, outputs differ from each other.

use super::codes;
use super::gate::{Gate, output_below};
use super::outputs::RECORD_NAME;
use crate::codes::{FILE_MISSING, PATH_REFUSED};
use crate::pipeline::{PathText, Step, nearest};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use toile_garment::{Diagnostic, Report, SourceRef};
use toile_stage_api::FileError;

/// Outputs that the parameters name, as paths below the output folder.
#[must_use]
pub fn planned_outputs(steps: &[Step<'_>]) -> Vec<PathBuf> {
    let outputs = steps.iter().flat_map(|s| &s.paths).filter(|p| p.is_output());
    outputs.map(|p| PathBuf::from(&p.text)).collect()
}

/// Inputs that the parameters name.
pub fn planned_inputs<'a>(steps: &'a [Step<'_>]) -> impl Iterator<Item = &'a PathText> {
    steps.iter().flat_map(|s| &s.paths).filter(|p| !p.is_output())
}

/// Most names of files that a remedy lists.
const NAMES: usize = 8;

/// Looks at every path of the chain.
pub fn check_paths(steps: &[Step<'_>], gate: &Gate, report: &mut Report) {
    let mut folders: Folders = BTreeMap::new();
    for input in planned_inputs(steps) {
        if let Err(error) = gate.input(Path::new(&input.text)) {
            report.push(input_finding(gate, input, &error, &mut folders));
        }
    }
    check_outputs(steps, report);
}

/// Looks at the paths of outputs. Absolute ones are those of --allow-write: the run looks at them.
fn check_outputs(steps: &[Step<'_>], report: &mut Report) {
    let mut seen: BTreeMap<PathBuf, SourceRef> = BTreeMap::new();
    let below = |p: &&PathText| p.is_output() && !Path::new(&p.text).is_absolute();
    for output in steps.iter().flat_map(|s| &s.paths).filter(below) {
        let collide = |message: String| {
            let finding = Diagnostic::error(codes::OUTPUTS_COLLIDE, message).at(output.place.clone());
            finding.hint("give each output its own name")
        };
        let below = match output_below(Path::new(&output.text)) {
            Ok(below) => PathBuf::from(below.to_string_lossy().to_lowercase()),
            Err(error) => {
                report.push(Diagnostic::error(PATH_REFUSED, error.to_string()).at(output.place.clone()));
                continue;
            }
        };
        if below == Path::new(RECORD_NAME) {
            report.push(collide(format!("`{}` is the name of the run's own record", output.text)));
        }
        let within = |other: &Path| other != below && (other.starts_with(&below) || below.starts_with(other));
        if let Some((_, other)) = seen.iter().find(|(path, _)| within(path)) {
            report.push(collide(format!("`{}` and the output at {other} are one within the other", output.text)));
        }
        if let Some(first) = seen.insert(below, output.place.clone()) {
            report.push(collide(format!("two outputs are called `{}`; the other stands at {first}", output.text)));
        }
    }
}

/// The remedy for a missing file: the files beside it whose names differ in their numbers alone, else the nearest name.
fn missing_hint(name: &str, neighbours: &[String]) -> String {
    let without_numbers =
        |name: &str| name.split(|c: char| c.is_ascii_digit()).filter(|w| !w.is_empty()).collect::<Vec<_>>().join("0");
    let numbered = name.contains(|c: char| c.is_ascii_digit());
    let other_numbers = |n: &&String| numbered && without_numbers(n) == without_numbers(name);
    let mut alike: Vec<String> =
        neighbours.iter().filter(other_numbers).take(NAMES).map(|n| format!("`{n}`")).collect();
    alike.sort();
    if alike.len() > 1 {
        return format!("there are {}; paths are relative to the pipeline file", alike.join(", "));
    }
    nearest(name, neighbours.iter().map(String::as_str)).map_or_else(
        || "paths are relative to the pipeline file".to_owned(),
        |near| format!("did you mean `{near}`? Paths are relative to the pipeline file"),
    )
}

/// Names beside missing files: a folder is looked into once.
type Folders = BTreeMap<PathBuf, Vec<String>>;

fn input_finding(gate: &Gate, input: &PathText, error: &FileError, folders: &mut Folders) -> Diagnostic {
    let path = Path::new(&input.text);
    match error {
        FileError::Missing { .. } => {
            let name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
            let folder = path.parent().map(Path::to_path_buf).unwrap_or_default();
            let neighbours = folders.entry(folder).or_insert_with(|| gate.neighbours(path));
            let hint = missing_hint(&name, neighbours);
            Diagnostic::error(FILE_MISSING, error.to_string()).at(input.place.clone()).hint(hint)
        }
        _ => Diagnostic::error(PATH_REFUSED, error.to_string())
            .at(input.place.clone())
            .hint("paths are relative to the pipeline file and stay in its project; see --allow-read DIR"),
    }
}

#[cfg(test)]
mod tests {
    use super::missing_hint;

    #[test]
    fn files_that_differ_in_their_numbers_are_all_named() {
        let there = ["size-38.obj", "size-36.obj", "size-38.toml", "notes.txt"].map(str::to_owned);
        let hint = missing_hint("size-39.obj", &there);
        assert_eq!(hint, "there are `size-36.obj`, `size-38.obj`; paths are relative to the pipeline file");
        assert!(missing_hint("note.txt", &there).contains("did you mean `notes.txt`?"));
        assert!(!missing_hint("fabric.toml", &there).contains("did you mean"));
    }
}
