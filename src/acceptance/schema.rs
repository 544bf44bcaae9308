//! JSON schema (draft 7) of a file of golden cases.

use crate::schema::parts::{bound, list, name, sets, table, text};
use serde_json::{Value, json};

/// The schema.
#[must_use]
pub fn schema() -> Value {
    json!({
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "toile test",
        "description": "Golden cases: pipelines with the figures, outputs and findings that they must give.",
        "type": "object",
        "required": ["toile", "case"],
        "additionalProperties": false,
        "properties": {
            "toile": { "description": "Version of this grammar.", "const": crate::pipeline::GRAMMAR },
            "about": text("Anything worth knowing."),
            "case": list(case()),
            "history": list(table("Golden values that were written; `toile test --bless` adds to it.", &[], json!({
                "reason": text("Why."),
                "toile": text("Version of the program."),
                "changed": list(json!({ "type": "string" }))
            })))
        }
    })
}

fn case() -> Value {
    table(
        "A golden case.",
        &["name", "pipeline"],
        json!({
            "name": name("Name of the case, and of the folder of its results."),
            "pipeline": text("Pipeline file, from the folder of this file."),
            "set": sets(),
            "exit": {
                "description": "Exit code that the run must have; 0 by default.",
                "type": "integer", "minimum": 0, "maximum": 5
            },
            "findings": list(json!({ "description": "Code of a finding that must be told.", "type": "string" })),
            "like": text("A golden GLB below the folder of this file; the garment must be like it."),
            "tolerance": {
                "description": "What may differ from it, as in the file of tolerances of `toile diff`.",
                "type": "object"
            },
            "figures": {
                "description": "Figures by name: a key of the certificate, garment.COUNT, or a measure as NAME.on.method.",
                "type": "object",
                "additionalProperties": figure()
            },
            "hashes": {
                "description": "blake3 of outputs by their paths; \"\" before it is blessed.",
                "type": "object",
                "additionalProperties": { "type": "string", "pattern": "^([0-9a-f]{64})?$" }
            }
        }),
    )
}

/// The keys of a figure. A name with dots stands in quotes here; the reader takes tables in tables, too.
fn figure() -> Value {
    table(
        "A figure.",
        &[],
        json!({
            "value": bound("The golden value, which --bless writes."),
            "within": bound("How far it may be off; a length such as 2 mm for a measure."),
            "min": bound("Least value, whatever was blessed."),
            "max": bound("Largest value, whatever was blessed.")
        }),
    )
}
