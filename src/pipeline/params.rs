//! One stage's parameters: every mistake in them, not only the first.

use super::codes;
use super::document::Reader;
use super::nearest::nearest;
use super::schema_walk::SchemaTree;
use crate::codes::{UNKNOWN_VALUE, WRONG_VALUE};
use std::ops::Range;
use toile_formats::codes::UNKNOWN_KEY;
use toile_garment::{Code, Diagnostic};
use toile_stage_api::{AnyStage, ReadyStage};
use toml::Spanned;
use toml::de::{DeTable, DeValue, ValueDeserializer};

/// Parses the parameters; all mistakes are in the report. Wrong ones are left out, so that what the others say is
/// looked at, too. `None` when that is not possible: a parameter is missing, or one that is a file is wrong.
pub(super) fn configure<'r>(
    cx: &mut Reader<'_>,
    stage: &'r dyn AnyStage,
    schema: &SchemaTree,
    mut table: DeTable<'_>,
    span: &Range<usize>,
    owner: &str,
) -> Option<Box<dyn ReadyStage + 'r>> {
    let mut lacks_file = false;
    for key in &schema.unknown_keys(&table) {
        let message = format!("unknown key `{}` of `{owner}`", key.path.join("."));
        cx.push(UNKNOWN_KEY, &key.span, message, key.hint.clone());
        remove(&mut table, &key.path);
        lacks_file |= schema.means_file(&key.path[0]);
    }
    let missing = report_missing(cx, schema, &table, span, owner);
    let mut removed: Vec<String> = Vec::new();
    // Each round either succeeds, or takes out one top-level key, or ends.
    for _ in 0..=table.len() {
        let value = Spanned::new(span.clone(), DeValue::Table(table.clone()));
        match stage.configure(ValueDeserializer::from(value)) {
            Ok(ready) => return (!lacks_file).then_some(ready),
            Err(error) => {
                let at = error.span().unwrap_or_else(|| span.clone());
                if !is_echo(error.message(), &removed, &missing) && !cx.has_said(&at) {
                    report_error(cx, error.message(), &at, schema, owner);
                }
                let Some(key) = key_around(&table, &at) else { break };
                table.remove(key.as_str());
                lacks_file |= schema.means_file(&key);
                removed.push(key);
            }
        }
    }
    None
}

/// "missing field" of a key that was taken out because it was wrong, or was reported already.
fn is_echo(message: &str, removed: &[String], missing: &[String]) -> bool {
    removed.iter().chain(missing).any(|key| message.contains(&format!("missing field `{key}`")))
}

/// All keys that must be there and are not; the parser would name the first only.
fn report_missing(
    cx: &mut Reader<'_>,
    schema: &SchemaTree,
    table: &DeTable<'_>,
    span: &Range<usize>,
    owner: &str,
) -> Vec<String> {
    let required = schema.root().get("required").and_then(serde_json::Value::as_array);
    let names = required.into_iter().flatten().filter_map(serde_json::Value::as_str);
    let missing: Vec<String> = names.filter(|name| !table.contains_key(*name)).map(str::to_owned).collect();
    for key in &missing {
        report_error(cx, &format!("missing field `{key}`"), span, schema, owner);
    }
    missing
}

fn report_error(cx: &mut Reader<'_>, message: &str, span: &Range<usize>, schema: &SchemaTree, owner: &str) {
    if let Some(key) = message.strip_prefix("missing field `").and_then(|m| m.strip_suffix('`')) {
        let about = schema.root().get("properties").and_then(|p| p.get(key)?.get("description")?.as_str());
        let hint = format!("add `with.{key} = …`{}", about.map(|a| format!(": {a}")).unwrap_or_default());
        cx.push(codes::MISSING_KEY, span, format!("`{owner}` needs `{key}`"), hint);
        return;
    }
    let message = &in_plain_words(message);
    let hint = expected_hint(message).unwrap_or_else(|| format!("see `toile stages {owner}` for its parameters"));
    cx.push(code_of(message), span, format!("`{owner}`: {message}"), hint);
}

/// The parser's message, with the names of Rust's types put into plain words.
fn in_plain_words(message: &str) -> String {
    const WHOLE_NUMBERS: [&str; 5] = ["u8", "u16", "u32", "u64", "usize"];
    let whole = WHOLE_NUMBERS
        .iter()
        .fold(message.to_owned(), |said, kind| said.replace(&format!("expected {kind}"), "expected a whole number"));
    whole
        .replace("expected f64", "expected a number")
        .replace("expected a boolean", "expected true or false")
        .replace("invalid type: string", "invalid type: the text")
}

/// The finding of a value that a parser refused in these words, outside a pipeline.
pub fn refused_value(message: &str) -> Diagnostic {
    let finding = Diagnostic::error(code_of(message), message.to_owned());
    match expected_hint(message) {
        Some(hint) => finding.hint(hint),
        None => finding,
    }
}

fn code_of(message: &str) -> Code {
    if message.starts_with("unknown field") {
        UNKNOWN_KEY
    } else if message.starts_with("unknown variant") {
        UNKNOWN_VALUE
    } else {
        WRONG_VALUE
    }
}

/// The nearest of the names that the parser says it expected.
fn expected_hint(message: &str) -> Option<String> {
    let (wrong, expected) = message.split_once(", expected ")?;
    let wrong = wrong.split('`').nth(1)?;
    nearest(wrong, expected.split('`').skip(1).step_by(2)).map(|near| format!("did you mean `{near}`?"))
}

/// The top-level key whose value or name holds the place.
fn key_around(table: &DeTable<'_>, at: &Range<usize>) -> Option<String> {
    let holds = |span: Range<usize>| span.start <= at.start && at.end <= span.end;
    table.iter().find(|(k, v)| holds(v.span()) || holds(k.span())).map(|(k, _)| k.get_ref().to_string())
}

fn remove(table: &mut DeTable<'_>, path: &[String]) {
    let Some((key, rest)) = path.split_first() else { return };
    if rest.is_empty() {
        table.remove(key.as_str());
        return;
    }
    match table.get_mut(key.as_str()).map(Spanned::get_mut) {
        Some(DeValue::Table(inner)) => remove(inner, rest),
        Some(DeValue::Array(items)) => {
            let item = rest[0].parse::<usize>().ok().and_then(|i| items.get_mut(i));
            if let Some(DeValue::Table(inner)) = item.map(Spanned::get_mut) {
                remove(inner, &rest[1..]);
            }
        }
        _ => {}
    }
}
