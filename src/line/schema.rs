//! JSON schema (draft 7) of the file of a line.

use crate::schema::parts::{bound, list, name, sets, table, text};
use serde_json::{Value, json};

/// The schema.
#[must_use]
pub fn schema() -> Value {
    json!({
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "toile line",
        "description": "A product line: styles in a matrix of sizes, fabrics and other choices.",
        "type": "object",
        "required": ["toile", "line"],
        "additionalProperties": false,
        "properties": {
            "toile": { "description": "Version of this grammar.", "const": crate::pipeline::GRAMMAR },
            "line": table("The line.", &["name"], json!({
                "name": name("Name of the line."),
                "about": text("Anything worth knowing.")
            })),
            "limits": table("Limits of every job.", &[], json!({
                "time": text("Longest time of a job, e.g. 60 s."),
                "memory": text("Most memory of a job, e.g. 800 MB.")
            })),
            "style": list(style()),
            "matrix": { "$ref": "#/definitions/matrix" },
            "exclude": list(json!({
                "description": "Jobs with all these choices are left out. Keys are axes and `style`.",
                "type": "object",
                "additionalProperties": value_or_values()
            })),
            "include": list(single_job()),
            "gate": list(gate())
        },
        "definitions": {
            "value": { "type": ["string", "number", "boolean"] },
            "matrix": matrix()
        }
    })
}

fn style() -> Value {
    table(
        "A style.",
        &["name", "pipeline"],
        json!({
            "name": name("Name of the style."),
            "pipeline": text("Pipeline file, from the folder of the line."),
            "pattern": text("Value of the input `pattern`."),
            "set": sets(),
            "matrix": { "$ref": "#/definitions/matrix" }
        }),
    )
}

fn single_job() -> Value {
    json!({
        "description": "A single job: its style, a choice for each axis, and further values.",
        "type": "object",
        "required": ["style"],
        "properties": {
            "style": text("Style of the job."),
            "name": name("A word that is added to its name."),
            "set": sets()
        },
        "additionalProperties": { "$ref": "#/definitions/value" }
    })
}

fn gate() -> Value {
    table(
        "Bounds of a figure; a job outside them fails.",
        &["figure"],
        json!({
            "figure": text("A key of the certificate, or a measure as NAME.on.method."),
            "min": bound("Least value; a length such as 20 mm for a measure."),
            "max": bound("Largest value; a length such as 20 mm for a measure.")
        }),
    )
}

fn matrix() -> Value {
    json!({
        "description": "Axes. A list sets the input of its name; a table names choices that set more.",
        "type": "object",
        "additionalProperties": {
            "anyOf": [values(), { "type": "object", "additionalProperties": sets() }]
        }
    })
}

fn value_or_values() -> Value {
    json!({ "anyOf": [{ "$ref": "#/definitions/value" }, values()] })
}

fn values() -> Value {
    json!({ "type": "array", "items": { "$ref": "#/definitions/value" } })
}
