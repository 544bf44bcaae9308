//! `toile inspect FILE`: the table of file forms that can be looked into.

mod darts;
mod edges;
mod fabric;
mod garment;
mod meshes;
mod others;
mod pattern;

use super::args::InspectArgs;
use super::codes;
use super::console::Console;
use super::results::Results;
use crate::engine::{Exit, MAX_INPUT, of_file_error, read_limited};
use serde_json::Value;
use std::path::Path;
use toile_garment::Diagnostic;

/// The contents that were found in a file.
pub(super) struct Inspected {
    /// For programs.
    pub json: Value,
    /// For people.
    pub text: String,
    /// Drawing, where one is asked for and the form has one: pieces, or curves of a fabric.
    pub svg: Option<String>,
    /// Findings.
    pub findings: Vec<Diagnostic>,
    /// Can anything of the file be used?
    pub is_usable: bool,
}

/// The file to look into.
pub(super) struct Source<'a> {
    /// Where it lies.
    pub path: &'a Path,
    /// Its name for messages.
    pub name: &'a str,
    /// All of it.
    pub bytes: &'a [u8],
    /// Is a drawing asked for?
    pub draw: bool,
}

type Inspect = fn(&Source<'_>) -> Result<Inspected, Vec<Diagnostic>>;

/// One form: endings of its file names, how its content begins, and what looks into it.
struct Form {
    endings: &'static [&'static str],
    begins: fn(&[u8]) -> bool,
    inspect: Inspect,
}

/// One line per form. The ending decides; an unknown ending is settled by the content.
const FORMS: &[Form] = &[
    Form { endings: &["dxf"], begins: pattern::is_dxf, inspect: pattern::dxf },
    Form { endings: &["rul"], begins: pattern::is_rul, inspect: pattern::rul },
    Form { endings: &["glb"], begins: meshes::is_glb, inspect: meshes::glb },
    Form { endings: &["json"], begins: garment::is_json, inspect: garment::document },
    Form { endings: &["toml"], begins: |_| false, inspect: fabric::inspect },
    Form { endings: &["obj"], begins: meshes::is_obj, inspect: meshes::obj },
];

pub(super) fn run(args: &InspectArgs, console: &mut Console<'_>) -> Exit {
    let name = args.file.to_string_lossy().into_owned();
    if args.file.is_dir() {
        console.findings(&[others::folder(&args.file)], None);
        return Exit::Input;
    }
    let bytes = match read_limited(&args.file, &args.file, MAX_INPUT) {
        Ok(bytes) => bytes,
        Err(error) => {
            let (findings, exit) = of_file_error(&error);
            console.findings(&findings, None);
            return exit;
        }
    };
    let source = Source { path: &args.file, name: &name, bytes: &bytes, draw: args.svg.is_some() };
    let inspected = match (others::told(&args.file, &bytes), find(&args.file, &bytes)) {
        (Some(other), _) => Err(vec![other]),
        (None, Some(form)) => (form.inspect)(&source),
        (None, None) => Err(vec![no_reader(&name)]),
    };
    match inspected {
        Ok(inspected) => show(args, &inspected, console),
        Err(findings) => {
            console.findings(&findings, None);
            Exit::Input
        }
    }
}

fn find(file: &Path, bytes: &[u8]) -> Option<&'static Form> {
    let ending = file.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
    let named = FORMS.iter().find(|f| f.endings.contains(&ending.as_str()));
    named.or_else(|| FORMS.iter().find(|f| (f.begins)(bytes)))
}

fn no_reader(name: &str) -> Diagnostic {
    let endings: Vec<&str> = FORMS.iter().flat_map(|f| f.endings).copied().collect();
    Diagnostic::error(codes::NO_READER, format!("`{name}` is of no form that can be inspected"))
        .hint(format!("known endings are {}", endings.join(", ")))
}

fn show(args: &InspectArgs, inspected: &Inspected, console: &mut Console<'_>) -> Exit {
    console.findings(&inspected.findings, None);
    if args.json {
        console.json(&inspected.json)
    } else {
        console.result(&crate::render::safe(&inspected.text))
    }
    let exit = if inspected.is_usable { Exit::Good } else { Exit::Input };
    let Some(path) = &args.svg else { return exit };
    let Some(svg) = &inspected.svg else {
        let finding = Diagnostic::error(codes::NO_READER, "this form of file has no pieces to draw");
        console.findings(&[finding], None);
        return Exit::Usage;
    };
    match Results::new(args.force, &[&args.file]).write(path, svg.as_bytes(), console) {
        Exit::Good => exit,
        worse => worse,
    }
}
