//! The JSON schema of a sewing file, built from the tables of keys that the reader uses.

use super::keys::{Form, Key, Keys, PLACE_AROUND, PLACE_EXPLICIT, PLACE_MOVED, RUN, TOP};
use crate::schema::{document, list, quantity, table, text, with_about};
use serde_json::{Map, Value, json};
use toile_garment::units::{Angle, ArealMass, Bending, Force, Length, Share};

/// JSON schema (draft 7) of a sewing file.
#[must_use]
pub fn schema() -> Value {
    let mut schema = document("toile sewing file", TOP.about, &[], properties(&TOP));
    schema["definitions"] = json!({ "run": run() });
    schema
}

fn properties(keys: &Keys) -> Map<String, Value> {
    keys.keys.iter().map(|key| (key.name.to_owned(), value(key))).collect()
}

fn of_table(keys: &Keys) -> Value {
    let required: Vec<&str> = keys.keys.iter().filter(|k| k.required).map(|k| k.name).collect();
    table(keys.about, &required, properties(keys))
}

/// A place has one of three forms; all other tables have one.
fn rows(keys: &'static Keys) -> Value {
    match keys.name {
        "place" => {
            let forms = [&PLACE_MOVED, &PLACE_AROUND, &PLACE_EXPLICIT].map(of_table);
            json!({ "description": keys.about, "oneOf": forms })
        }
        _ => of_table(keys),
    }
}

fn run() -> Value {
    let named =
        json!({ "description": "`piece.edge`, by name or number.", "type": "string", "pattern": "\\S\\.\\s*\\S" });
    json!({ "description": RUN.about, "anyOf": [named, of_table(&RUN)] })
}

fn value(key: &Key) -> Value {
    let number = || json!({ "type": "number" });
    let point = || list("Two lengths: x and y in the piece.", quantity::<Length>(), 2);
    let run = || json!({ "$ref": "#/definitions/run" });
    let form = match key.form {
        Form::Text => text(""),
        Form::Texts => json!({ "type": "array", "items": { "type": "string" } }),
        Form::Label => json!({ "type": ["string", "integer"] }),
        Form::Length => quantity::<Length>(),
        Form::Angle => quantity::<Angle>(),
        Form::Number(min, max) => json!({ "type": "number", "minimum": min, "maximum": max }),
        Form::Integer => json!({ "type": "integer" }),
        Form::Flag => json!({ "type": "boolean" }),
        Form::Word(words) => json!({ "enum": words() }),
        Form::Point => point(),
        Form::RunEnd => json!({ "anyOf": [text("A place on the edge."), point()] }),
        Form::Points => json!({ "type": "array", "items": point() }),
        Form::TwoPoints => list("", point(), 2),
        Form::Vector => list("", quantity::<Length>(), 3),
        Form::Matrix => list("", list("One row.", number(), 3), 3),
        Form::Side => json!({ "anyOf": [run(), { "type": "array", "minItems": 1, "items": run() }] }),
        Form::BandLength => json!({ "anyOf": [quantity::<Length>(), quantity::<Share>()] }),
        Form::Force => quantity::<Force>(),
        Form::ArealMass => quantity::<ArealMass>(),
        Form::Bending => quantity::<Bending>(),
        Form::Strength => {
            json!({ "type": "string", "pattern": "^\\s*(hold\\s*|while-sewing\\s*|elastic\\s+\\S+\\s*)$" })
        }
        Form::Tables(keys) => json!({ "type": "array", "items": rows(keys) }),
    };
    let mut form = with_about(form, key.about);
    if !matches!(key.form, Form::Tables(_)) {
        form["examples"] = json!([example(key)]);
    }
    form
}

/// The example as the value it is in the file.
fn example(key: &Key) -> Value {
    let text = format!("x = {}", key.example);
    toml::from_str::<toml::Table>(&text).ok().and_then(|t| serde_json::to_value(&t["x"]).ok()).unwrap_or_default()
}
