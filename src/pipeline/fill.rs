//! `{name}` in the texts of a stage's parameters. Spans survive: a filled text stands where the template stood.

use super::document::Reader;
use super::inputs::{InputKind, Values};
use super::nearest::remedy;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

/// Fills every text below a table.
pub(super) fn fill_table<'v>(cx: &mut Reader<'_>, values: &'v Values, table: &mut DeTable<'v>) {
    for (_, value) in table.iter_mut() {
        fill_value(cx, values, value);
    }
}

fn fill_value<'v>(cx: &mut Reader<'_>, values: &'v Values, value: &mut Spanned<DeValue<'v>>) {
    let span = value.span();
    match value.get_mut() {
        DeValue::String(text) if text.contains(['{', '}']) => {
            if let Some(filled) = fill_text(cx, values, text, &span) {
                *value.get_mut() = filled;
            }
        }
        DeValue::Table(table) => fill_table(cx, values, table),
        DeValue::Array(items) => fill_items(cx, values, items),
        _ => {}
    }
}

fn fill_items<'v>(cx: &mut Reader<'_>, values: &'v Values, items: &mut DeArray<'v>) {
    for item in items.iter_mut() {
        fill_value(cx, values, item);
    }
}

fn fill_text<'v>(cx: &mut Reader<'_>, values: &'v Values, text: &str, span: &Range<usize>) -> Option<DeValue<'v>> {
    if let Some((InputKind::Number, number)) = whole_name(text).and_then(|n| values.by_name.get(n)) {
        return DeValue::parse(number).ok().map(Spanned::into_inner);
    }
    let mut filled = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find(['{', '}']) {
        filled.push_str(&rest[..at]);
        let tail = &rest[at..];
        if tail.starts_with("{{") || tail.starts_with("}}") {
            filled.push_str(&tail[..1]);
            rest = &tail[2..];
        } else if tail.starts_with('}') {
            filled.push('}');
            rest = &tail[1..];
        } else {
            let Some(end) = tail.find('}') else {
                let hint = "close it with `}`, or write `{{` for a brace";
                cx.push("open-brace", span, format!("`{tail}` opens a name and does not close it"), hint);
                return None;
            };
            filled.push_str(&value_of(cx, values, &tail[1..end], filled.is_empty(), &tail[end + 1..], span)?);
            rest = &tail[end + 1..];
        }
    }
    filled.push_str(rest);
    Some(DeValue::String(filled.into()))
}

/// The name, if the text is exactly `{name}`.
fn whole_name(text: &str) -> Option<&str> {
    text.strip_prefix('{')?.strip_suffix('}')
}

fn value_of(
    cx: &mut Reader<'_>,
    values: &Values,
    name: &str,
    first: bool,
    after: &str,
    span: &Range<usize>,
) -> Option<String> {
    let is_folder = name == "out" || values.mounts.contains_key(name);
    if is_folder && !(first && (after.is_empty() || after.starts_with('/') || name != "out")) {
        let hint = "write \"{out}/name.glb\"";
        cx.push("out-not-first", span, format!("`{{{name}}}` names a folder and must stand first"), hint);
        return None;
    }
    if name == "out" {
        // Kept as a name: the real folder must not get into the document, or bytes would differ between machines.
        return Some("{out}".to_owned());
    }
    if let Some((_, value)) = values.by_name.get(name) {
        return Some(value.clone());
    }
    let known: Vec<&str> = values.by_name.keys().map(String::as_str).chain(["out"]).collect();
    let hint = format!("{}; a plain brace is written `{{{{`", remedy(name, known.iter().copied()));
    cx.push("unknown-input", span, format!("`{{{name}}}` is not an input"), hint);
    None
}
