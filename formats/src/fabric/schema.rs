//! The JSON schema of a fabric file, built from the table of keys that the reader uses.

use super::curve::{KINDS, Kind};
use super::fields::{FIELDS, Field, TABLES, TEXTS, Unit, units};
use crate::schema;
use serde_json::{Map, Value, json};

/// JSON schema (draft 7) of a fabric file.
///
/// Every key, table and unit comes from the reader's own table. What a schema cannot say stays with the reader: a
/// property may be given once in all tables together, and some properties must be given somewhere.
#[must_use]
pub fn schema() -> Value {
    let mut top = keys("");
    for table in TABLES {
        top.insert((*table).to_owned(), schema::table(about_table(table), &[], keys(table)));
    }
    let about = "What was measured on a cloth. Quantities are texts with a unit; plain ratios are numbers.";
    schema::document("toile fabric file", about, &["name"], top)
}

fn about_table(table: &str) -> &'static str {
    match table {
        "linear" => "Constant stiffnesses, as strip tests with free sides show them.",
        "isotropic" => "One stiffness in all directions.",
        "kes" => "Figures of the Kawabata system, KES-F.",
        "fast" => "Figures of the SiroFAST system.",
        "curve" => "Measured curves: of strips with free sides, of shear and of bending.",
        "look" => "Weave, yarns, colour and sheen: what bitmaps of the cloth are drawn from.",
        _ => "Constants of the bare springs of `model = \"springs\"`, beside one of the other tables.",
    }
}

fn keys(table: &str) -> Map<String, Value> {
    let mut keys: Map<String, Value> =
        TEXTS.iter().map(|key| ((*key).to_owned(), schema::text(about_text(key)))).collect();
    keys.extend(FIELDS.iter().filter(|f| f.tables.contains(&table)).map(|f| (f.key.to_owned(), value(f))));
    if table == "look" {
        keys.extend(super::look::schema());
    }
    if table == "curve" {
        keys.extend(KINDS.iter().map(|kind| (kind.key.to_owned(), curve(kind))));
    }
    keys
}

fn about_text(key: &str) -> &'static str {
    match key {
        "name" => "Name of the fabric.",
        "method" => "How the values here were measured, where a value does not say it itself.",
        "source" => "Where the values here come from, where a value does not say it itself.",
        _ => "A remark; the program does not use it.",
    }
}

/// A plain value, or a table that says where the value comes from.
fn value(field: &Field) -> Value {
    let plain = plain(field);
    let mut origin = Map::new();
    origin.insert("value".to_owned(), plain.clone());
    origin.insert("method".to_owned(), schema::text("How it was measured."));
    origin.insert("source".to_owned(), schema::text("Where it comes from."));
    json!({
        "description": format!("{} Range: {}.", field.about, field.allowed),
        "anyOf": [plain, schema::table("A value with its origin.", &["value"], origin)]
    })
}

fn plain(field: &Field) -> Value {
    match units(field.unit) {
        None => json!({ "type": ["number", "string"], "minimum": field.min, "maximum": field.max }),
        Some(names) => json!({ "type": "string", "description": format!("Units: {}.", schema::units(names)) }),
    }
}

fn about_curve(kind: &Kind) -> String {
    let [first, second] = kind.columns;
    let what = match kind.key {
        "warp" => " along the warp",
        "weft" => " along the weft",
        "shear_force" => " of shear, in place of `shear`",
        "bending_moment_warp" => " of bending per width, in place of `bending_warp`",
        _ => " of bending per width, in place of `bending_weft`",
    };
    format!("Rows of {first} and {second}{what}; both columns rise.")
}

fn curve(kind: &Kind) -> Value {
    let cell = |unit: Unit| {
        let names = units(unit).unwrap_or_default();
        json!({ "type": "string", "description": format!("Units: {}.", schema::units(names)) })
    };
    let row = json!({
        "type": "array",
        "minItems": 2,
        "maxItems": 2,
        "items": kind.units.map(cell)
    });
    json!({
        "description": about_curve(kind),
        "type": "array",
        "minItems": 1,
        "items": row
    })
}
