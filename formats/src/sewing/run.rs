//! Runs of outline edges: `"front.side-left"`, `"front.3"`, two points, or a list of those.

use super::codes;
use super::keys;
use super::walk::{Table, Value, Walk};
use std::ops::Range;
use toile_garment::sewing::{EdgeNameSpec, RunSpec, RunWay};
use toml::de::{DeTable, DeValue};

const WAYS: &[(&str, RunWay)] =
    &[("short", RunWay::Short), ("long", RunWay::Long), ("left", RunWay::Left), ("right", RunWay::Right)];

/// The words of `way`.
pub fn ways() -> Vec<&'static str> {
    WAYS.iter().map(|(word, _)| *word).collect()
}

/// One side of a seam.
pub fn side(value: Value<'_>, key: &str, walk: &mut Walk<'_>) -> Option<Vec<RunSpec>> {
    let DeValue::Array(items) = value.get_ref() else { return Some(vec![run(value, key, walk)?]) };
    if items.is_empty() {
        walk.error(codes::SEWING_EMPTY_LIST, value.span().start, format!("`{key}` names no edge"), |d| {
            d.hint("write at least one run, e.g. \"front.side-left\"")
        });
        return None;
    }
    let runs: Vec<_> = items.iter().map(|item| run(item, key, walk)).collect();
    runs.into_iter().collect()
}

fn run(value: Value<'_>, key: &str, walk: &mut Walk<'_>) -> Option<RunSpec> {
    match value.get_ref() {
        DeValue::Table(table) => run_table(table, value.span(), walk),
        _ => named(value, key, walk),
    }
}

fn named(value: Value<'_>, key: &str, walk: &mut Walk<'_>) -> Option<RunSpec> {
    let text = walk.text(value, key)?;
    let parts = text.rsplit_once('.').filter(|(p, e)| !p.trim().is_empty() && !e.trim().is_empty());
    let Some((piece, edge)) = parts else {
        let message = format!("`{key}`: `{text}` names no edge of a piece");
        walk.error(codes::SEWING_BAD_RUN, value.span().start, message, |d| {
            d.hint("write \"piece.edge\", e.g. \"front.side-left\" or \"front.3\"")
        });
        return None;
    };
    Some(RunSpec::Edge { piece: piece.trim().to_owned(), edge: edge.trim().to_owned() })
}

fn run_table(table: &DeTable<'_>, span: Range<usize>, walk: &mut Walk<'_>) -> Option<RunSpec> {
    let mut t = Table::new(table, span, &keys::RUN);
    let piece = t.need("piece", walk).and_then(|v| walk.text(v, "piece"));
    let run = body(&mut t, piece, walk);
    t.finish(walk);
    run
}

/// The run part of a table: `edge`, or `from` and `to`.
fn body(t: &mut Table<'_>, piece: Option<String>, walk: &mut Walk<'_>) -> Option<RunSpec> {
    if let Some(value) = t.take("edge").or_else(|| t.take("number")) {
        let edge = walk.label(value, "edge");
        return Some(RunSpec::Edge { piece: piece?, edge: edge? });
    }
    let from = t.need("from", walk).and_then(|v| walk.point(v, "from"));
    let to = t.need("to", walk).and_then(|v| walk.point(v, "to"));
    let way = match t.take("way") {
        Some(value) => walk.word(value, "way", WAYS),
        None => Some(RunWay::Short),
    };
    Some(RunSpec::Points { piece: piece?, from: from?, to: to?, way: way? })
}

/// A `[[edge]]`: a name for a run.
pub fn edge_name(table: &DeTable<'_>, span: Range<usize>, walk: &mut Walk<'_>) -> Option<EdgeNameSpec> {
    let mut t = Table::new(table, span, &keys::EDGE);
    let piece = t.need("piece", walk).and_then(|v| walk.text(v, "piece"));
    let name = t.need("name", walk).and_then(|v| walk.text(v, "name"));
    let run = body(&mut t, piece, walk);
    t.finish(walk);
    Some(EdgeNameSpec { run: run?, name: name? })
}
