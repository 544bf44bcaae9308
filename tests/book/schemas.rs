//! The committed schemas of files that a person writes, and what they say of the samples.

use crate::{current, root};
use serde_json::Value;

fn schemas() -> [(&'static str, Value); 5] {
    [
        ("sewing", toile_formats::sewing::schema()),
        ("fabric", toile_formats::fabric::schema()),
        ("body", toile_formats::body::schema()),
        ("line", toile::line::schema()),
        ("test", toile::acceptance::schema()),
    ]
}

#[test]
fn the_committed_schemas_are_not_stale() {
    for (name, schema) in schemas() {
        let text = serde_json::to_string_pretty(&schema).expect("JSON") + "\n";
        current(&root().join(format!("pipelines/{name}.schema.json")), &text);
    }
}

#[test]
fn every_sample_fits_the_schema_of_its_kind() {
    let kinds = [
        ("samples/patterns", ".sewing.toml", toile_formats::sewing::schema()),
        ("samples/fabrics", ".toml", toile_formats::fabric::schema()),
        ("samples/bodies", ".toml", toile_formats::body::schema()),
        ("samples/lines", ".toml", toile::line::schema()),
        ("samples/tests", ".toml", toile::acceptance::schema()),
    ];
    for (folder, ending, schema) in kinds {
        let mut count = 0;
        for entry in std::fs::read_dir(root().join(folder)).expect("samples") {
            let path = entry.expect("entry").path();
            if !path.to_string_lossy().ends_with(ending) {
                continue;
            }
            let table: toml::Table = toml::from_str(&std::fs::read_to_string(&path).expect("sample")).expect("TOML");
            let value = serde_json::to_value(table).expect("value");
            assert_eq!(mistake(&schema, &schema, &value), None, "{}", path.display());
            count += 1;
        }
        assert!(count > 0, "no samples in {folder}");
    }
}

/// Every key of the sewing file is read in the form that its example has: the tables of keys and the reader agree.
#[test]
fn every_example_of_a_sewing_file_is_read() {
    let schema = toile_formats::sewing::schema();
    for (table, body) in schema["properties"].as_object().expect("tables") {
        let forms: Vec<&Value> = match body["items"]["oneOf"].as_array() {
            Some(forms) => forms.iter().collect(),
            None => vec![&body["items"]],
        };
        for form in forms {
            let Some(properties) = form["properties"].as_object() else { continue };
            for (key, property) in properties {
                let text = row(table, form, key, property);
                let errors = toile_formats::sewing::read(&text, "sewing.toml").err().unwrap_or_default();
                let codes: Vec<&str> = errors.iter().map(|e| e.code.as_ref()).collect();
                // A key may ask for others beside it; its own form and name are right.
                let wrong = ["sewing-unknown-key", "sewing-wrong-type", "sewing-bad-quantity", "sewing-unknown-word"];
                assert!(!codes.iter().any(|c| wrong.contains(c)), "{table}.{key}: {codes:?}\n{text}");
            }
        }
    }
}

/// A row of a table with what it must have, and one key more.
fn row(table: &str, form: &Value, key: &str, property: &Value) -> String {
    let mut row = toml::Table::new();
    let required = form["required"].as_array().expect("required");
    for name in required.iter().filter_map(Value::as_str) {
        row.insert(name.to_owned(), example(&form["properties"][name]));
    }
    row.insert(key.to_owned(), example(property));
    let mut file = toml::Table::new();
    file.insert(table.to_owned(), toml::Value::Array(vec![toml::Value::Table(row)]));
    toml::to_string(&file).expect("TOML")
}

fn example(property: &Value) -> toml::Value {
    toml::Value::try_from(&property["examples"][0]).expect("an example")
}

#[test]
fn what_a_reader_refuses_by_name_its_schema_refuses() {
    let fabric = toile_formats::fabric::schema();
    let sewing = toile_formats::sewing::schema();
    let refused = |schema: &Value, text: &str| {
        let table: toml::Table = toml::from_str(text).expect("TOML");
        mistake(schema, schema, &serde_json::to_value(table).expect("value"))
    };
    assert!(refused(&fabric, "name = \"a\"\nthicknes = \"1 mm\"").is_some());
    assert!(refused(&fabric, "name = \"a\"\nthickness = 1").is_some());
    assert!(refused(&fabric, "name = \"a\"\nfriction = 11").is_some());
    assert!(refused(&sewing, "[[seam]]\na = \"front.1\"").is_some());
    assert!(refused(&sewing, "[[dart]]\npiece = \"front\"\nmouth = [[\"1 mm\", \"2 mm\"]]").is_some());
    assert!(refused(&sewing, "[[place]]\npiece = \"front\"\naround = \"tail\"\nside = \"front\"").is_some());
}

/// The first mistake of a value by the keywords of draft 7 that the schemas use.
fn mistake(root: &Value, schema: &Value, value: &Value) -> Option<String> {
    if let Some(name) = schema["$ref"].as_str() {
        return mistake(root, root.pointer(name.trim_start_matches('#'))?, value);
    }
    if let Some(choices) = schema["enum"].as_array() {
        return (!choices.contains(value)).then(|| format!("{value} is none of {choices:?}"));
    }
    for (word, most) in [("anyOf", usize::MAX), ("oneOf", 1)] {
        if let Some(branches) = schema[word].as_array() {
            let fits = branches.iter().filter(|b| mistake(root, b, value).is_none()).count();
            return (fits == 0 || fits > most).then(|| format!("{value} fits {fits} branches"));
        }
    }
    let kinds: Vec<&str> = match &schema["type"] {
        Value::String(kind) => vec![kind],
        Value::Array(kinds) => kinds.iter().filter_map(Value::as_str).collect(),
        _ => Vec::new(),
    };
    if !kinds.is_empty() && !kinds.iter().any(|kind| is_a(value, kind)) {
        return Some(format!("{value} is not {kinds:?}"));
    }
    if let Some(number) = value.as_f64() {
        let (least, most) = (schema["minimum"].as_f64(), schema["maximum"].as_f64());
        if least.is_some_and(|m| number < m) || most.is_some_and(|m| number > m) {
            return Some(format!("{number} is out of range"));
        }
    }
    if let Some(items) = value.as_array() {
        return mistake_of_list(root, schema, items);
    }
    mistake_of_table(root, schema, value.as_object()?)
}

fn is_a(value: &Value, kind: &str) -> bool {
    match kind {
        "string" => value.is_string(),
        "number" => value.is_number(),
        "integer" => value.is_i64() || value.is_u64(),
        "boolean" => value.is_boolean(),
        "array" => value.is_array(),
        _ => value.is_object(),
    }
}

fn mistake_of_list(root: &Value, schema: &Value, items: &[Value]) -> Option<String> {
    let count = items.len() as u64;
    if schema["minItems"].as_u64().is_some_and(|m| count < m) || schema["maxItems"].as_u64().is_some_and(|m| count > m)
    {
        return Some(format!("{count} items"));
    }
    items.iter().enumerate().find_map(|(i, item)| match &schema["items"] {
        Value::Array(each) => mistake(root, each.get(i)?, item),
        Value::Null => None,
        all => mistake(root, all, item),
    })
}

fn mistake_of_table(root: &Value, schema: &Value, table: &serde_json::Map<String, Value>) -> Option<String> {
    let missing = schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str);
    if let Some(key) = missing.into_iter().find(|key| !table.contains_key(*key)) {
        return Some(format!("`{key}` is missing"));
    }
    table.iter().find_map(|(key, value)| match (&schema["properties"][key], &schema["additionalProperties"]) {
        (Value::Null, Value::Bool(false)) => Some(format!("`{key}` is not known")),
        (Value::Null, Value::Object(_)) => mistake(root, &schema["additionalProperties"], value),
        (Value::Null, _) => None,
        (known, _) => mistake(root, known, value).map(|why| format!("{key}: {why}")),
    })
}
