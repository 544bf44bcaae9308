//! Parts of the schemas of files that a person writes.

use serde_json::{Value, json};

/// Overrides.
pub fn sets() -> Value {
    json!({
        "description": "Inputs of the pipeline, and parameters as stage-id.key; as `--set` takes them.",
        "type": "object"
    })
}

/// A name that may stand in names of files.
pub fn name(about: &str) -> Value {
    json!({ "description": about, "type": "string", "pattern": "^[a-z][a-z0-9-]{0,63}$" })
}

/// A text.
pub fn text(about: &str) -> Value {
    json!({ "description": about, "type": "string" })
}

/// A number, or a length with its unit.
pub fn bound(about: &str) -> Value {
    json!({ "description": about, "type": ["number", "string"] })
}

/// A table with these keys and no others.
pub fn table(about: &str, required: &[&str], properties: Value) -> Value {
    json!({
        "description": about,
        "type": "object",
        "required": required,
        "additionalProperties": false,
        "properties": properties
    })
}

/// A list.
pub fn list(items: Value) -> Value {
    json!({ "type": "array", "items": items })
}
