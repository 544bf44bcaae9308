//! Parameters seen through their schema: which keys exist, which of them hold text.

use super::nearest::{nearest, remedy};
use schemars::generate::SchemaSettings;
use serde_json::{Map, Value};
use std::ops::Range;
use toile_stage_api::AnyStage;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The schema of one stage's parameters with its definitions.
pub struct SchemaTree {
    root: Value,
    definitions: Map<String, Value>,
}

/// The use that a stage makes of a file that a parameter names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileRole {
    /// It reads it: `"format": "input-file"` in the schema.
    Input,
    /// It writes it: `"format": "output-file"` in the schema.
    Output,
}

/// A parameter that is a file.
pub struct FileParam {
    /// Keys from `with` down to it; a number for an item of a list.
    pub keys: Vec<String>,
    /// Its path.
    pub text: String,
    /// Read or written.
    pub role: FileRole,
}

/// A key that the schema does not know.
pub struct UnknownKey {
    /// Keys from `with` down to it.
    pub path: Vec<String>,
    /// Where it stands.
    pub span: Range<usize>,
    /// The known key that was probably meant.
    pub hint: String,
}

impl SchemaTree {
    /// Schema of a stage.
    #[must_use]
    pub fn of(stage: &dyn AnyStage) -> Self {
        let mut generator = SchemaSettings::draft07().into_generator();
        let root = stage.schema(&mut generator).to_value();
        Self { root, definitions: generator.take_definitions(true) }
    }

    /// The root, resolved.
    #[must_use]
    pub fn root(&self) -> &Value {
        self.resolve(&self.root)
    }

    /// Follows references and "this or nothing" to the schema that says something. Bounded, as a schema may come from
    /// another program.
    #[must_use]
    pub fn resolve<'a>(&'a self, schema: &'a Value) -> &'a Value {
        let mut at = schema;
        for _ in 0..16 {
            let target = at.get("$ref").and_then(Value::as_str).and_then(|r| r.rsplit('/').next());
            if let Some(next) = target.and_then(|name| self.definitions.get(name)) {
                at = next;
            } else if let Some(only) = only_branch(at) {
                at = only;
            } else {
                break;
            }
        }
        at
    }

    /// Can the parameter at this path hold a text, and no value of the JSON type `kind`?
    #[must_use]
    pub fn takes_text_for(&self, path: &[&str], kind: &str) -> bool {
        let kinds = self.at(path).map(|schema| self.kinds(schema)).unwrap_or_default();
        let holds = |wanted: &str| kinds.iter().any(|k| *k == wanted || *k == "number" && wanted == "integer");
        holds("string") && (kind == "string" || !holds(kind))
    }

    /// The names of the parameters.
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.root().get("properties").and_then(Value::as_object).into_iter().flat_map(Map::keys).map(String::as_str)
    }

    /// The schema of the parameter at a path.
    fn at(&self, path: &[&str]) -> Option<&Value> {
        path.iter().try_fold(self.root(), |at, key| {
            let step = if key.bytes().all(|b| b.is_ascii_digit()) { at.get("items") } else { None };
            let next = step.or_else(|| at.get("properties")?.get(*key)).or_else(|| at.get("additionalProperties"))?;
            Some(self.resolve(next))
        })
    }

    /// The JSON types that a schema lets through; none where it does not say.
    fn kinds<'a>(&'a self, schema: &'a Value) -> Vec<&'a str> {
        let branches = ["oneOf", "anyOf"].iter().find_map(|k| schema.get(*k)?.as_array());
        if let Some(branches) = branches {
            return branches.iter().flat_map(|b| self.kinds(self.resolve(b))).collect();
        }
        match schema.get("type") {
            Some(Value::String(kind)) => vec![kind],
            Some(Value::Array(kinds)) => kinds.iter().filter_map(Value::as_str).collect(),
            _ if schema.get("const").is_some_and(Value::is_string) => vec!["string"],
            _ => Vec::new(),
        }
    }

    /// All parameters that are files.
    #[must_use]
    pub fn files(&self, params: &Value) -> Vec<FileParam> {
        let mut found = Vec::new();
        self.walk_files(self.root(), params, &mut Vec::new(), &mut found);
        found
    }

    fn walk_files(&self, schema: &Value, value: &Value, keys: &mut Vec<String>, found: &mut Vec<FileParam>) {
        let role = match schema.get("format").and_then(Value::as_str) {
            Some("input-file") => Some(FileRole::Input),
            Some("output-file") => Some(FileRole::Output),
            _ => None,
        };
        match value {
            Value::String(text) => {
                found.extend(role.map(|role| FileParam { keys: keys.clone(), text: text.clone(), role }));
            }
            Value::Object(map) => {
                let properties = schema.get("properties").and_then(Value::as_object);
                for (key, inner) in map {
                    let next = properties.and_then(|p| p.get(key)).or_else(|| schema.get("additionalProperties"));
                    self.walk_inner(next, key, inner, keys, found);
                }
            }
            Value::Array(items) => {
                for (i, inner) in items.iter().enumerate() {
                    self.walk_inner(schema.get("items"), &i.to_string(), inner, keys, found);
                }
            }
            _ => {}
        }
    }

    fn walk_inner(
        &self,
        schema: Option<&Value>,
        key: &str,
        value: &Value,
        keys: &mut Vec<String>,
        found: &mut Vec<FileParam>,
    ) {
        // Followed link by link: the mark may stand beside the reference.
        let Some(schema) = schema else { return };
        keys.push(key.to_owned());
        let marked = if schema.get("format").is_some() { schema } else { self.resolve(schema) };
        self.walk_files(marked, value, keys, found);
        keys.pop();
    }

    /// Is a parameter of this name, or the one that is likely meant by it, a file that is read?
    #[must_use]
    pub fn means_file(&self, key: &str) -> bool {
        let Some(properties) = self.root().get("properties").and_then(Value::as_object) else { return false };
        let is_input = |schema: &Value| schema.get("format").and_then(Value::as_str) == Some("input-file");
        let known =
            properties.get(key).or_else(|| properties.get(nearest(key, properties.keys().map(String::as_str))?));
        known.is_some_and(|s| is_input(s) || s.get("additionalProperties").is_some_and(is_input))
    }

    /// Must a parameter of this name be there?
    #[must_use]
    pub fn requires(&self, key: &str) -> bool {
        let required = self.root().get("required").and_then(Value::as_array);
        required.into_iter().flatten().any(|name| name.as_str() == Some(key))
    }

    /// All keys of a table that the schema does not know.
    #[must_use]
    pub fn unknown_keys(&self, table: &DeTable<'_>) -> Vec<UnknownKey> {
        let mut found = Vec::new();
        self.walk_table(self.root(), table, &mut Vec::new(), &mut found);
        found
    }

    fn walk_table(&self, schema: &Value, table: &DeTable<'_>, path: &mut Vec<String>, found: &mut Vec<UnknownKey>) {
        let open = ["anyOf", "oneOf", "allOf", "if", "patternProperties"].iter().any(|k| schema.get(*k).is_some());
        let rest = schema.get("additionalProperties").filter(|a| a.is_object() || a.as_bool() == Some(true));
        let properties = schema.get("properties").and_then(Value::as_object);
        if properties.is_none() && rest.is_none() && schema.get("additionalProperties").is_none() {
            return;
        }
        for (key, value) in table {
            let name = key.get_ref().as_ref();
            path.push(name.to_owned());
            match properties.and_then(|p| p.get(name)).or(rest) {
                Some(next) => self.walk(self.resolve(next), value, path, found),
                None if open => {}
                None => {
                    let known = properties.into_iter().flat_map(Map::keys).map(String::as_str);
                    found.push(UnknownKey { path: path.clone(), span: key.span(), hint: remedy(name, known) });
                }
            }
            path.pop();
        }
    }

    fn walk(&self, schema: &Value, value: &Spanned<DeValue<'_>>, path: &mut Vec<String>, found: &mut Vec<UnknownKey>) {
        match value.get_ref() {
            DeValue::Table(table) => self.walk_table(schema, table, path, found),
            DeValue::Array(items) => {
                let Some(next) = schema.get("items").filter(|i| i.is_object()) else { return };
                for (i, item) in items.iter().enumerate() {
                    path.push(i.to_string());
                    self.walk(self.resolve(next), item, path, found);
                    path.pop();
                }
            }
            _ => {}
        }
    }
}

/// The one branch beside `null` of "this or nothing", or the only member of `allOf`.
fn only_branch(schema: &Value) -> Option<&Value> {
    if let Some(all) = schema.get("allOf").and_then(Value::as_array).filter(|a| a.len() == 1) {
        return all.first();
    }
    let any = schema.get("anyOf").and_then(Value::as_array)?;
    let mut said = any.iter().filter(|s| !is_null(s));
    let first = said.next()?;
    (any.len() > 1 && said.next().is_none()).then_some(first)
}

fn is_null(schema: &Value) -> bool {
    schema.get("type").is_some_and(|t| t == "null")
}
