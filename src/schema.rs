//! The schema of a pipeline file and the manual of the stages, both from the parameter types.

pub(crate) mod parts;

use crate::pipeline::SchemaTree;
use schemars::generate::SchemaSettings;
use serde_json::{Map, Value, json};
use toile_stage_api::{AnyStage, Registry};

/// JSON schema (draft 7) of a pipeline with these stages.
#[must_use]
pub fn pipeline_schema(registry: &Registry) -> Value {
    let mut generator = SchemaSettings::draft07().into_generator();
    let mut uses: Vec<Value> = registry
        .iter()
        .map(|stage| {
            let params = stage.schema(&mut generator).to_value();
            stage_schema(&stage.info(), params)
        })
        .collect();
    uses.push(foreign_stage());
    let mut definitions = generator.take_definitions(true);
    for definition in definitions.values_mut() {
        allow_names(definition);
    }
    definitions.insert("pipeline-input".to_owned(), input_schema());
    json!({
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "toile pipeline",
        "type": "object",
        "required": ["toile", "pipeline", "stage"],
        "additionalProperties": false,
        "properties": {
            "toile": { "description": "Version of this grammar.", "const": crate::pipeline::GRAMMAR },
            "pipeline": head_schema(),
            "input": {
                "description": "What the caller may set with --set name=value; used as {name} in texts.",
                "type": "object",
                "additionalProperties": { "$ref": "#/definitions/pipeline-input" }
            },
            "plugin": plugin_schema(),
            "stage": { "description": "The chain, in order.", "type": "array", "minItems": 1, "items": { "oneOf": uses } }
        },
        "definitions": definitions
    })
}

fn stage_schema(info: &toile_stage_api::StageInfo, mut params: Value) -> Value {
    allow_names(&mut params);
    json!({
        "title": info.name,
        "description": info.summary,
        "type": "object",
        "required": ["use"],
        "additionalProperties": false,
        "properties": { "use": { "const": info.name }, "id": id_schema(), "with": params }
    })
}

/// A stage of a plugin: its parameters are known only to the program.
fn foreign_stage() -> Value {
    json!({
        "title": "stage of a plugin",
        "type": "object",
        "required": ["use"],
        "additionalProperties": false,
        "properties": {
            "use": { "type": "string", "pattern": "^[a-z][a-z0-9-]*\\.[a-z0-9-]+$" },
            "id": id_schema(),
            "with": { "type": "object" }
        }
    })
}

fn id_schema() -> Value {
    json!({ "description": "Name for --set id.key=value; the stage's name by default.", "type": "string" })
}

fn head_schema() -> Value {
    json!({
        "type": "object",
        "required": ["line", "version"],
        "additionalProperties": false,
        "properties": {
            "line": { "description": "Product line.", "type": "string", "pattern": "^[a-z][a-z0-9-]{0,63}$" },
            "version": { "description": "Version; a released file is never edited.", "type": "integer", "minimum": 0 },
            "seed": { "description": "Seed for anything random; 0 by default.", "type": "integer", "minimum": 0 },
            "accuracy": {
                "description": "Hem heights and girths within this length, e.g. 10 mm, or a preset: draft, normal, fine, reference. Less than 6 mm needs a study. Sets edge_length of triangulate and accuracy of drape.",
                "type": "string"
            },
            "about": { "description": "What it makes.", "type": "string" }
        }
    })
}

fn plugin_schema() -> Value {
    json!({
        "description": "Programs that hold stages; run only with --allow-run NAME, and only with the stated content.",
        "type": "object",
        "additionalProperties": {
            "type": "object",
            "required": ["command"],
            "additionalProperties": false,
            "properties": {
                "command": { "type": "array", "minItems": 1, "items": { "type": "string" } },
                "timeout": { "description": "Longest time for one stage, e.g. 10 min.", "type": "string" },
                "content": {
                    "description": "Digest of the command and of the files it names, or its first digits. Another content is refused.",
                    "type": "string",
                    "pattern": "^[0-9a-f]{16,64}$"
                }
            }
        }
    })
}

fn input_schema() -> Value {
    let kind = json!({ "enum": ["text", "path", "number", "length"] });
    json!({
        "anyOf": [
            kind,
            {
                "type": "object",
                "required": ["kind"],
                "additionalProperties": false,
                "properties": {
                    "kind": kind,
                    "default": { "type": ["string", "number"] },
                    "about": { "type": "string" }
                }
            }
        ]
    })
}

/// Where a number stands, `"{name}"` may stand too.
fn allow_names(schema: &mut Value) {
    match schema {
        Value::Object(map) => {
            let number = matches!(map.get("type").and_then(Value::as_str), Some("number" | "integer"));
            if number {
                let mut inner = std::mem::take(map);
                let outer: Map<String, Value> = ["description", "default"]
                    .iter()
                    .filter_map(|k| Some(((*k).to_owned(), inner.remove(*k)?)))
                    .collect();
                *map = outer;
                let name = json!({ "type": "string", "pattern": "^\\{[a-z_][a-z0-9_-]*\\}$" });
                map.insert("anyOf".to_owned(), json!([inner, name]));
            } else {
                map.values_mut().for_each(allow_names);
            }
        }
        Value::Array(items) => items.iter_mut().for_each(allow_names),
        _ => {}
    }
}

/// The manual of one stage as text.
#[must_use]
pub fn manual(stage: &dyn AnyStage) -> String {
    let info = stage.info();
    let words = |aspects: &[toile_garment::Aspect]| {
        if aspects.is_empty() {
            return "nothing".to_owned();
        }
        aspects.iter().map(|a| crate::pipeline::word(*a)).collect::<Vec<_>>().join(", ")
    };
    let mut text = format!("{} (revision {}): {}\n", info.name, info.revision, info.summary);
    text.push_str(&format!("  needs {}; gives {}\n", words(&info.needs), words(&info.gives)));
    let tree = SchemaTree::of(stage);
    let Some(properties) = tree.root().get("properties").and_then(Value::as_object) else {
        text.push_str("  no parameters\n");
        return text;
    };
    let required: Vec<&str> =
        tree.root().get("required").and_then(Value::as_array).into_iter().flatten().filter_map(Value::as_str).collect();
    for (name, schema) in properties {
        text.push_str(&parameter(&tree, name, schema, required.contains(&name.as_str())));
    }
    text
}

fn parameter(tree: &SchemaTree, name: &str, schema: &Value, required: bool) -> String {
    let resolved = tree.resolve(schema);
    let kind = kind_of(tree, resolved);
    let default = schema.get("default").filter(|d| !d.is_null()).map(|d| format!(", default {d}")).unwrap_or_default();
    let must = if required { ", required" } else { "" };
    let about = schema.get("description").or_else(|| resolved.get("description")).and_then(Value::as_str).unwrap_or("");
    let mut text = format!("  with.{name}: {kind}{default}{must}\n");
    for line in about.lines() {
        text.push_str(&format!("      {line}\n"));
    }
    text
}

fn kind_of(tree: &SchemaTree, schema: &Value) -> String {
    if let Some(choices) = schema.get("enum").and_then(Value::as_array) {
        return choices.iter().map(Value::to_string).collect::<Vec<_>>().join(" | ");
    }
    if let Some(constant) = schema.get("const") {
        return constant.to_string();
    }
    if let Some(branches) = ["oneOf", "anyOf"].iter().find_map(|k| schema.get(*k)?.as_array()) {
        let kinds: Vec<String> =
            branches.iter().map(|b| kind_of(tree, tree.resolve(b))).filter(|k| k != "null").collect();
        return kinds.join(" | ");
    }
    match schema.get("type") {
        Some(Value::String(kind)) => kind.clone(),
        Some(Value::Array(kinds)) => {
            kinds.iter().filter_map(Value::as_str).filter(|k| *k != "null").collect::<Vec<_>>().join(" | ")
        }
        _ => "any".to_owned(),
    }
}
