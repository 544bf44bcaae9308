//! `--set`: values of inputs and of stage parameters from the command line.

use super::codes;
use super::document::{Document, Reader, StageEntry};
use super::inputs::refuse_unknown_set;
use super::schema_walk::SchemaTree;
use crate::codes::SET_FORM;
use std::collections::BTreeSet;
use std::ops::Range;
use toile_garment::Diagnostic;
use toile_stage_api::{Knob, Registry};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Deepest key path of an override.
const MAX_DEPTH: usize = 32;

/// One override of a stage's parameter.
pub(super) struct ParamSet<'t> {
    /// Id of the stage.
    pub stage: String,
    /// Keys below `with`.
    pub path: Vec<&'t str>,
    /// Value as typed.
    pub raw: &'t str,
    /// Index of the override.
    pub index: usize,
}

/// Overrides sorted by what they set.
#[derive(Default)]
pub(super) struct Overrides<'t> {
    /// Name, value, index.
    pub inputs: Vec<(String, String, usize)>,
    /// Overrides of parameters of stages.
    pub params: Vec<ParamSet<'t>>,
}

/// Sorts the overrides and refuses those that name nothing.
pub(super) fn sort<'t>(cx: &mut Reader<'_>, document: &Document<'t>, registry: &Registry) -> Overrides<'t> {
    let mut sorted = Overrides::default();
    let mut seen = BTreeSet::new();
    for (index, set) in document.source.sets().iter().enumerate() {
        let Some((key, raw)) = set.split_once('=') else {
            let span = document.source.span_of_set(index);
            cx.push(
                SET_FORM,
                &span,
                format!("`{set}` has no `=`"),
                "write --set name=value or --set stage-id.key=value",
            );
            continue;
        };
        let key = key.trim();
        if !seen.insert(key) {
            let message = format!("`{key}` is set twice; the last --set counts");
            let place = cx.source.place(&document.source.span_of_set(index));
            cx.report.push(Diagnostic::warning(codes::SET_TWICE, message).at(place).hint("leave the other one out"));
        }
        if document.inputs.contains_key(key) {
            sorted.inputs.push((key.to_owned(), raw.to_owned(), index));
        } else if let Some((stage, path)) = stage_key(document, key) {
            sorted.params.push(ParamSet { stage, path, raw, index });
        } else {
            let last = key.split('.').next_back().unwrap_or(key);
            let parameters: Vec<String> = document.stages.iter().flat_map(|s| parameters(s, registry)).collect();
            let is_own = |p: &&String| p.rsplit_once('.').is_some_and(|(_, name)| name == last);
            let owners: Vec<String> = parameters.iter().filter(is_own).cloned().collect();
            let known = document.inputs.keys().cloned().chain(parameters).collect();
            refuse_unknown_set(cx, index, set, &owners, known);
        }
    }
    sorted
}

/// All parameters of a stage, as `id.key`.
fn parameters(entry: &StageEntry<'_>, registry: &Registry) -> Vec<String> {
    let schema = registry.get(entry.name.get_ref()).map(SchemaTree::of);
    schema.iter().flat_map(|s| s.keys().map(|key| format!("{}.{key}", entry.id)).collect::<Vec<_>>()).collect()
}

/// The longest id that the key begins with, and the keys after it.
fn stage_key<'t>(document: &Document<'_>, key: &'t str) -> Option<(String, Vec<&'t str>)> {
    document
        .stages
        .iter()
        .filter_map(|s| Some((s.id.clone(), key.strip_prefix(s.id.as_str())?.strip_prefix('.')?)))
        .max_by_key(|(id, _)| id.len())
        .map(|(id, rest)| (id, rest.split('.').collect::<Vec<_>>()))
        .filter(|(_, path)| path.len() <= MAX_DEPTH && path.iter().all(|k| !k.is_empty()))
}

/// Takes out what the file says in another word than an override. Edge length and number of triangles, for example, say
/// the same, and the one of the command line counts.
pub(super) fn make_way(entry: &StageEntry<'_>, sets: &[ParamSet<'_>], knobs: &[Knob], table: &mut DeTable<'_>) {
    let is_set = |key: &str| sets.iter().any(|s| s.stage == entry.id && s.path == [key]);
    for (key, other) in knobs.iter().filter_map(|k| Some((k.key.as_ref(), k.instead_of.as_deref()?))) {
        match [is_set(key), is_set(other)] {
            [true, false] => drop(table.remove(other)),
            [false, true] => drop(table.remove(key)),
            _ => {}
        }
    }
}

/// Puts the overrides of one stage into its parameters.
pub(super) fn apply<'t>(
    cx: &mut Reader<'_>,
    entry: &StageEntry<'t>,
    sets: &[ParamSet<'t>],
    schema: &SchemaTree,
    table: &mut DeTable<'t>,
) {
    for set in sets.iter().filter(|s| s.stage == entry.id) {
        let span = cx.source.span_of_set(set.index);
        let value = typed(set.raw, &set.path, schema, &span);
        if !insert(table, &set.path, value, &span) {
            let message = format!("`{}` lies below a value that is no table", set.path.join("."));
            cx.push(SET_FORM, &span, message, "name the key of a value");
        }
    }
}

/// A TOML value where it reads as one that the parameter can hold; the text itself otherwise.
fn typed<'t>(raw: &'t str, path: &[&str], schema: &SchemaTree, span: &Range<usize>) -> Spanned<DeValue<'t>> {
    let is_meant = |value: &DeValue<'_>| value.is_str() || !schema.takes_text_for(path, kind(value));
    let value = DeValue::parse(raw).ok().map(Spanned::into_inner).filter(is_meant);
    Spanned::new(span.clone(), respan(value.unwrap_or_else(|| DeValue::String(raw.into())), span))
}

/// The JSON type of a TOML value.
fn kind(value: &DeValue<'_>) -> &'static str {
    match value {
        DeValue::Integer(_) => "integer",
        DeValue::Float(_) => "number",
        DeValue::Boolean(_) => "boolean",
        DeValue::Array(_) => "array",
        DeValue::Table(_) => "object",
        DeValue::String(_) | DeValue::Datetime(_) => "string",
    }
}

/// Spans within the override mean nothing in the file: all of it stands at the override.
fn respan<'t>(value: DeValue<'t>, span: &Range<usize>) -> DeValue<'t> {
    match value {
        DeValue::Array(items) => DeValue::Array(
            items.into_iter().map(|v| Spanned::new(span.clone(), respan(v.into_inner(), span))).collect(),
        ),
        DeValue::Table(table) => DeValue::Table(
            table
                .into_iter()
                .map(|(k, v)| {
                    (
                        Spanned::new(span.clone(), k.into_inner()),
                        Spanned::new(span.clone(), respan(v.into_inner(), span)),
                    )
                })
                .collect(),
        ),
        other => other,
    }
}

fn insert<'t>(table: &mut DeTable<'t>, path: &[&'t str], value: Spanned<DeValue<'t>>, span: &Range<usize>) -> bool {
    let Some((key, rest)) = path.split_first() else { return false };
    let name = || Spanned::new(span.clone(), std::borrow::Cow::Borrowed(*key));
    if rest.is_empty() {
        // Removed first: an insert would keep the old key with the old place.
        table.remove(*key);
        table.insert(name(), value);
        return true;
    }
    if !table.contains_key(*key) {
        table.insert(name(), Spanned::new(span.clone(), DeValue::Table(DeTable::new())));
    }
    match table.get_mut(*key).map(Spanned::get_mut) {
        Some(DeValue::Table(inner)) => insert(inner, rest, value, span),
        Some(DeValue::Array(items)) => insert_item(items, rest, value, span),
        _ => false,
    }
}

fn insert_item<'t>(
    items: &mut toml::de::DeArray<'t>,
    path: &[&'t str],
    value: Spanned<DeValue<'t>>,
    span: &Range<usize>,
) -> bool {
    let Some((index, rest)) = path.split_first() else { return false };
    let Some(item) = index.parse::<usize>().ok().and_then(|i| items.get_mut(i)) else { return false };
    if rest.is_empty() {
        *item = value;
        return true;
    }
    match item.get_mut() {
        DeValue::Table(inner) => insert(inner, rest, value, span),
        _ => false,
    }
}
