//! The pages of reference: stages, files and findings, from schemas, the table of codes and doc comments.

use crate::{current, root};
use serde_json::Value;
use std::fmt::Write as _;

const HEAD: &str =
    "<!-- Generated: `TOILE_BLESS=1 cargo test --release --test book`. What is edited here is lost. -->\n\n";

fn page(name: &str, text: &str) {
    let text = format!("{}\n", text.trim_end_matches('\n'));
    current(&root().join("docs/book/src/reference").join(name), &text);
}

#[test]
fn the_page_of_the_pipeline_is_current() {
    let registry = toile_stages::builtin();
    let schema = toile::schema::pipeline_schema(&registry);
    let mut text = format!("# Pipeline file\n\n{HEAD}");
    text.push_str("A pipeline is a chain of stages. Its JSON schema is `pipelines/toile.schema.json`.\n\n");
    keys(&mut text, &schema["properties"]["pipeline"], "## `[pipeline]`");
    let input = &schema["definitions"]["pipeline-input"]["anyOf"][1];
    keys(&mut text, input, "## `[input]`, one table for each name");
    keys(&mut text, &schema["properties"]["plugin"]["additionalProperties"], "## `[plugin.NAME]`");
    text.push_str("## Stages\n\nEach stage is one `[[stage]]` table with `use`, `id` and `with`.\n\n");
    for stage in registry.iter() {
        let manual = toile::schema::manual(stage);
        let name = stage.info().name.into_owned();
        let _ = write!(text, "### `{name}`\n\n```text\n{}```\n\n", without_name(&manual, &name));
    }
    page("pipeline.md", &text);
}

/// The manual of a stage without its name, in lines that fit a page.
fn without_name(manual: &str, name: &str) -> String {
    let manual = manual.strip_prefix(name).unwrap_or(manual).trim_start();
    manual.lines().map(|line| folded(line) + "\n").collect()
}

/// A line cut at blanks where it is longer than a page is wide; what follows keeps the indent.
fn folded(line: &str) -> String {
    const WIDTH: usize = 110;
    let indent = " ".repeat(line.len() - line.trim_start().len());
    let mut lines = vec![String::new()];
    for word in line.split_whitespace() {
        let last = lines.last_mut().expect("a line");
        if !last.is_empty() && indent.len() + last.chars().count() + 1 + word.chars().count() > WIDTH {
            lines.push(word.to_owned());
        } else {
            *last = if last.is_empty() { word.to_owned() } else { format!("{last} {word}") };
        }
    }
    lines.iter().map(|text| format!("{indent}{text}")).collect::<Vec<_>>().join("\n")
}

#[test]
fn the_pages_of_the_three_files_are_current() {
    let fabric = doc_of("formats/src/fabric/mod.rs");
    let body = doc_of("formats/src/body/mod.rs");
    let sewing = doc_of("formats/src/sewing/mod.rs");
    for (name, title, doc, schema) in [
        ("sewing", "Sewing file", sewing, toile_formats::sewing::schema()),
        ("fabric", "Fabric file", fabric, toile_formats::fabric::schema()),
        ("body", "Body side file", body, toile_formats::body::schema()),
    ] {
        let mut text = format!("# {title}\n\n{HEAD}{}\n\n", doc.replace("\n# ", "\n## ").trim());
        let _ = write!(
            text,
            "## Keys\n\nThe JSON schema is `pipelines/{name}.schema.json`; `toile schema {name}` prints it.\n\n"
        );
        tables(&mut text, &schema);
        page(&format!("{name}.md"), &text);
    }
}

#[test]
fn the_page_of_findings_is_current() {
    let mut text = format!("# Findings\n\n{HEAD}");
    text.push_str("Every finding has a fixed code. `toile explain CODE` prints the same text.\n\n");
    text.push_str("| code | meaning |\n|---|---|\n");
    for code in toile::codes::all() {
        let _ = writeln!(text, "| `{}` | {} |", code.name(), cell(code.text()));
    }
    page("findings.md", &text);
}

/// The module documentation of a source file.
fn doc_of(file: &str) -> String {
    let source = std::fs::read_to_string(root().join(file)).expect("source");
    let lines = source.lines().map_while(|line| line.strip_prefix("//!"));
    lines.map(|line| format!("{}\n", line.strip_prefix(' ').unwrap_or(line))).collect()
}

/// The keys at the top of a file, and those of its tables.
fn tables(text: &mut String, schema: &Value) {
    keys(text, schema, "### Top of the file");
    if let Some(run) = schema["definitions"]["run"]["anyOf"][1].as_object() {
        keys(text, &Value::Object(run.clone()), "### A run of outline edges");
    }
    for (name, table) in schema["properties"].as_object().expect("properties") {
        match &table["items"] {
            Value::Null if table["properties"].is_object() && name != "segments" => {
                keys(text, table, &format!("### `[{name}]`"));
            }
            Value::Null if name == "segments" => {
                let one = table["properties"].as_object().and_then(|p| p.values().next()).expect("a segment");
                keys(text, one, "### `[segments.NAME]`");
            }
            items if items["oneOf"].is_array() => {
                for form in items["oneOf"].as_array().expect("forms") {
                    keys(text, form, &format!("### `[[{name}]]`"));
                }
            }
            items if items["properties"].is_object() => keys(text, items, &format!("### `[[{name}]]`")),
            _ => {}
        }
    }
}

/// A table of keys.
fn keys(text: &mut String, schema: &Value, heading: &str) {
    let Some(properties) = schema["properties"].as_object() else { return };
    let _ = write!(text, "{heading}\n\n");
    if let Some(about) = schema["description"].as_str() {
        let _ = write!(text, "{about}\n\n");
    }
    text.push_str("| key | value | meaning |\n|---|---|---|\n");
    let required: Vec<&str> = schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str).collect();
    for (name, property) in properties {
        let must = if required.contains(&name.as_str()) { " (required)" } else { "" };
        let about = property["description"].as_str().unwrap_or("");
        let _ = writeln!(text, "| `{name}`{must} | {} | {} |", kind(property), cell(about));
    }
    text.push('\n');
}

/// The kind of a value in words.
fn kind(schema: &Value) -> String {
    if let Some(name) = schema["$ref"].as_str() {
        return name.rsplit('/').next().unwrap_or("").to_owned();
    }
    if let Some(words) = schema["enum"].as_array() {
        return words.iter().filter_map(Value::as_str).map(|w| format!("`{w}`")).collect::<Vec<_>>().join(", ");
    }
    let examples = schema["examples"].as_array().map(Vec::as_slice).unwrap_or_default();
    if let [example] = examples {
        return format!("e.g. `{}`", cell(&example.to_string()));
    }
    if let Some(branches) = schema["anyOf"].as_array().or_else(|| schema["oneOf"].as_array()) {
        return branches.first().map_or_else(String::new, kind);
    }
    match &schema["type"] {
        Value::String(kind) if kind == "object" => "table".to_owned(),
        Value::String(kind) if kind == "array" => "list".to_owned(),
        Value::String(kind) if kind == "string" => match schema["description"].as_str() {
            Some(units) if units.starts_with("Units:") => {
                format!("quantity; {}", units.to_lowercase().trim_end_matches('.'))
            }
            _ => "text".to_owned(),
        },
        Value::String(kind) => kind.clone(),
        Value::Array(kinds) if kinds.iter().any(|k| k == "number") => "number".to_owned(),
        Value::Array(_) => "text or number".to_owned(),
        _ => "text".to_owned(),
    }
}

fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace('\n', " ")
}
