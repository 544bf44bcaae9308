//! The keys that the generated schemas know.

use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;

/// Keys of all stages, as `drape.effects.friction`; an element of a list is `[]`.
pub fn of_stages() -> BTreeSet<String> {
    let schema = read("toile");
    let mut out = BTreeSet::new();
    for stage in schema["properties"]["stage"]["items"]["oneOf"].as_array().expect("stages") {
        let name = stage["title"].as_str().unwrap_or_default();
        if stage["properties"]["use"]["const"].is_string() {
            walk(&stage["properties"]["with"], &schema, name, &mut out);
        }
    }
    out
}

/// Keys of a file format.
pub fn of_file(name: &str) -> BTreeSet<String> {
    let schema = read(name);
    let mut out = BTreeSet::new();
    walk(&schema, &schema, "", &mut out);
    out
}

/// A key of a row without the numbers of list elements: `seam[0].ease` is `seam[].ease`.
pub fn plain(key: &str) -> String {
    let mut out = String::new();
    let mut rest = key;
    while let Some((before, after)) = rest.split_once('[') {
        out += before;
        out += "[]";
        rest = after.split_once(']').map_or("", |(_, rest)| rest);
    }
    out + rest
}

fn read(name: &str) -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("pipelines/{name}.schema.json"));
    serde_json::from_str(&std::fs::read_to_string(path).expect("schema")).expect("JSON")
}

/// A leaf is a key without keys of its own. A measured quantity may be a text or a table; the key itself stands for it.
fn walk(node: &Value, root: &Value, path: &str, out: &mut BTreeSet<String>) {
    let tables = tables(node, root);
    if tables.is_empty() {
        out.insert(path.to_owned());
    }
    for (is_element, table) in tables {
        let place = if is_element { format!("{path}[]") } else { path.to_owned() };
        for (key, inner) in table {
            let below = if place.is_empty() { key.clone() } else { format!("{place}.{key}") };
            walk(inner, root, &below, out);
        }
    }
}

type Table<'a> = &'a serde_json::Map<String, Value>;

/// The tables that a value may be, each with whether it is an element of a list; none where it may be a plain value.
fn tables<'a>(node: &'a Value, root: &'a Value) -> Vec<(bool, Table<'a>)> {
    if let Some(name) = node["$ref"].as_str() {
        return tables(&root["definitions"][name.rsplit('/').next().unwrap_or_default()], root);
    }
    if let Some(keys) = node["properties"].as_object() {
        return vec![(false, keys)];
    }
    let forms = ["allOf", "anyOf", "oneOf"].iter().filter_map(|k| node[k].as_array()).flatten();
    let forms: Vec<Vec<_>> = forms.filter(|f| f["type"] != "null").map(|f| tables(f, root)).collect();
    if forms.iter().any(Vec::is_empty) {
        return Vec::new();
    }
    let elements = if node["items"].is_object() { tables(&node["items"], root) } else { Vec::new() };
    forms.concat().into_iter().chain(elements.into_iter().map(|(_, table)| (true, table))).collect()
}
