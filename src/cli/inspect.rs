//! `toile inspect FILE`: the table of file forms that can be looked into.

use super::args::InspectArgs;
use super::console::Console;
use crate::engine::{Exit, GarmentCounts, MAX_INPUT, clean, of_file_error, read_limited};
use serde_json::{Value, json};
use std::path::Path;
use toile_garment::{Diagnostic, SourceRef};

/// What was found in a file.
pub(super) struct Inspected {
    /// For programs.
    pub json: Value,
    /// For people.
    pub text: String,
    /// Drawing of the pieces, where the form has pieces.
    pub svg: Option<String>,
    /// Findings.
    pub findings: Vec<Diagnostic>,
}

type Inspect = fn(&[u8], &str) -> Result<Inspected, Vec<Diagnostic>>;

/// One form: endings of its file names, how its content begins, and what looks into it.
struct Form {
    endings: &'static [&'static str],
    begins: fn(&[u8]) -> bool,
    inspect: Inspect,
}

/// One line per form. The ending decides; an unknown ending is settled by the content.
const FORMS: &[Form] = &[Form { endings: &["json"], begins: is_json, inspect: inspect_garment }];

pub(super) fn run(args: &InspectArgs, console: &mut Console<'_>) -> Exit {
    let name = args.file.to_string_lossy().into_owned();
    let bytes = match read_limited(&args.file, &args.file, MAX_INPUT) {
        Ok(bytes) => bytes,
        Err(error) => {
            console.findings(&of_file_error(&error).0, None);
            return Exit::Input;
        }
    };
    let inspected = match find(&args.file, &bytes) {
        Some(form) => (form.inspect)(&bytes, &name),
        None => Err(vec![no_reader(&name)]),
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
    Diagnostic::error("no-reader", format!("`{name}` is of no form that can be inspected"))
        .hint(format!("known endings are {}", endings.join(", ")))
}

fn show(args: &InspectArgs, inspected: &Inspected, console: &mut Console<'_>) -> Exit {
    console.findings(&inspected.findings, None);
    if args.json {
        console.json(&inspected.json)
    } else {
        console.result(&crate::render::safe(&inspected.text))
    }
    let Some(path) = &args.svg else { return Exit::Good };
    let Some(svg) = &inspected.svg else {
        console.say("error[no-reader] this form of file has no pieces to draw\n");
        return Exit::Usage;
    };
    super::flatten::write_result(path, svg.as_bytes(), args.force, console)
}

fn is_json(bytes: &[u8]) -> bool {
    bytes.trim_ascii_start().starts_with(b"{")
}

/// A garment document on disk.
fn inspect_garment(bytes: &[u8], name: &str) -> Result<Inspected, Vec<Diagnostic>> {
    let garment = super::flatten::garment_from_bundle(bytes).map_err(|message| {
        vec![Diagnostic::error("garment-file", message).at(SourceRef::file(clean(Path::new(name))))]
    })?;
    let counts = GarmentCounts::of(&garment);
    let pieces: Vec<Value> = garment
        .pieces
        .iter()
        .map(|p| {
            let mesh = p.mesh.as_ref();
            json!({
                "name": p.name,
                "darts": p.darts.len(),
                "vertices": mesh.map_or(0, |m| m.rest.len()),
                "triangles": mesh.map_or(0, |m| m.triangles.len()),
            })
        })
        .collect();
    let mut text = format!(
        "garment `{}`: {} pieces, {} seams, {} darts, {} triangles\n",
        garment.style, counts.pieces, counts.seams, counts.darts, counts.triangles
    );
    for piece in &garment.pieces {
        let triangles = piece.mesh.as_ref().map_or(0, |m| m.triangles.len());
        text.push_str(&format!("  {:<20} {} darts, {triangles} triangles\n", piece.name, piece.darts.len()));
    }
    let json =
        json!({ "style": garment.style, "counts": counts, "pieces": pieces, "certificate": garment.certificate });
    Ok(Inspected { json, text, svg: None, findings: Vec::new() })
}
