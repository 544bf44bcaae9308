//! The parts that the JSON schemas of the fabric, sewing and body files share (draft 7).

use serde_json::{Map, Value, json};
use toile_garment::units::Dimension;

/// A whole schema: a title, what the file is, and the keys at its top.
pub fn document(title: &str, about: &str, required: &[&str], properties: Map<String, Value>) -> Value {
    let mut schema = table(about, required, properties);
    schema["$schema"] = json!("http://json-schema.org/draft-07/schema#");
    schema["title"] = json!(title);
    schema
}

/// A table that refuses keys it does not know.
pub fn table(about: &str, required: &[&str], properties: Map<String, Value>) -> Value {
    json!({
        "description": about,
        "type": "object",
        "required": required,
        "additionalProperties": false,
        "properties": properties
    })
}

/// A text in quotes.
pub fn text(about: &str) -> Value {
    json!({ "description": about, "type": "string" })
}

/// A quantity with its unit, as text.
pub fn quantity<D: Dimension>() -> Value {
    json!({
        "description": format!("A {} with its unit: {}.", D::NAME, units(D::UNITS)),
        "type": "string",
        "examples": [D::EXAMPLE]
    })
}

/// A list of a fixed number of items of one kind.
pub fn list(about: &str, items: Value, count: usize) -> Value {
    json!({ "description": about, "type": "array", "items": items, "minItems": count, "maxItems": count })
}

/// The names of units, for a sentence.
pub fn units(units: &[(&str, f64)]) -> String {
    units.iter().map(|(name, _)| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

/// The same schema with another description.
pub fn with_about(mut schema: Value, about: &str) -> Value {
    schema["description"] = json!(about);
    schema
}
