//! Runs of outline edges: `"front.side-left"`, `"front.3"`, a part of an edge, two points, or a list of those. A line
//! inside the piece is a run as well.

use super::codes;
use super::keys;
use super::walk::{Table, Value, Walk};
use std::ops::Range;
use toile_garment::Vec2;
use toile_garment::sewing::{EdgeNameSpec, EdgePlace, EdgeWay, RunSpec, RunWay};
use toile_garment::units::{Length, Share, parse};
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

/// The run part of a table: `edge`, `edge` with places on it, two points, or a `line`.
fn body(t: &mut Table<'_>, piece: Option<String>, walk: &mut Walk<'_>) -> Option<RunSpec> {
    if let Some(value) = t.take("line") {
        let line = walk.points(value, "line");
        return Some(RunSpec::Line { piece: piece?, line: line? });
    }
    if let Some(value) = t.take("edge").or_else(|| t.take("number")) {
        let edge = walk.label(value, "edge");
        let ends = [t.take("from"), t.take("to")];
        if ends.iter().all(Option::is_none) {
            return Some(RunSpec::Edge { piece: piece?, edge: edge? });
        }
        let [from, to] = [("from", START, ends[0]), ("to", END, ends[1])]
            .map(|(key, default, value)| value.map_or(Some(default), |v| place(v, key, walk)));
        return Some(RunSpec::Part { piece: piece?, edge: edge?, from: from?, to: to? });
    }
    let from = t.need("from", walk).and_then(|v| point(v, "from", walk));
    let to = t.need("to", walk).and_then(|v| point(v, "to", walk));
    let way = match t.take("way") {
        Some(value) => walk.word(value, "way", WAYS),
        None => Some(RunWay::Short),
    };
    Some(RunSpec::Points { piece: piece?, from: from?, to: to?, way: way? })
}

/// A point. A place on an edge needs the edge beside it.
fn point(value: Value<'_>, key: &str, walk: &mut Walk<'_>) -> Option<Vec2> {
    let Some(text) = value.get_ref().as_str() else { return walk.point(value, key) };
    let message = format!("`{key} = \"{text}\"` is a place on an edge, and no edge is named");
    walk.error(codes::SEWING_BAD_RUN, value.span().start, message, |d| d.hint("add edge = 3, the number of the edge"));
    None
}

const START: EdgePlace = EdgePlace { way: EdgeWay::Share(0.0), from_end: false };
const END: EdgePlace = EdgePlace { way: EdgeWay::Share(0.0), from_end: true };
const MIDDLE: EdgePlace = EdgePlace { way: EdgeWay::Share(0.5), from_end: false };

/// A place on an edge: `start`, `middle`, `end`, `notch 2`, `40 %` or `120 mm`, the last three also `from end`.
fn place(value: Value<'_>, key: &str, walk: &mut Walk<'_>) -> Option<EdgePlace> {
    let text = value.get_ref().as_str().unwrap_or_default();
    let found = edge_place(text);
    if found.is_none() {
        let written = if text.is_empty() { "this".to_owned() } else { format!("`{text}`") };
        let message = format!("`{key}`: {written} is no place on an edge");
        walk.error(codes::SEWING_BAD_RUN, value.span().start, message, |d| {
            d.hint(
                "write \"start\", \"middle\", \"end\", \"notch 1\", \"40 %\" or \"120 mm\"; \"120 mm from end\" counts \
                 from the other end; two points stand beside `piece` without `edge`",
            )
        });
    }
    found
}

/// A place on an edge, as `40 mm from end`, `30 %`, `notch 1`, `start`; `None` for any other text.
#[must_use]
pub fn edge_place(text: &str) -> Option<EdgePlace> {
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ").to_lowercase();
    match words.as_str() {
        "start" => return Some(START),
        "middle" => return Some(MIDDLE),
        "end" => return Some(END),
        _ => {}
    }
    let (way, from_end) = words.strip_suffix(" from end").map_or((words.as_str(), false), |way| (way, true));
    let way = match way.strip_prefix("notch ") {
        Some(number) => EdgeWay::Notch(number.parse().ok().filter(|n| *n > 0)?),
        None => match parse::<Length>(way) {
            Ok(length) => EdgeWay::Length(Some(length).filter(|l| *l >= 0.0)?),
            Err(_) => EdgeWay::Share(parse::<Share>(way).ok().filter(|s| (0.0..=1.0).contains(s))?),
        },
    };
    Some(EdgePlace { way, from_end })
}

/// A place on an edge as the file has it.
pub fn place_text(place: EdgePlace) -> String {
    let end = if place.from_end { " from end" } else { "" };
    match place.way {
        _ if place == START => "start".to_owned(),
        _ if place == END => "end".to_owned(),
        _ if place == MIDDLE => "middle".to_owned(),
        EdgeWay::Share(share) => format!("{} %{end}", four_digits(share * 100.0)),
        EdgeWay::Length(length) => format!("{} mm{end}", four_digits(length * 1e3)),
        EdgeWay::Notch(number) => format!("notch {number}{end}"),
    }
}

/// A number with at most four digits after the point.
fn four_digits(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}

/// A `[[edge]]`: a name for a run.
pub fn edge_name(table: &DeTable<'_>, span: Range<usize>, walk: &mut Walk<'_>) -> Option<EdgeNameSpec> {
    let at = span.start;
    let mut t = Table::new(table, span, &keys::EDGE);
    let piece = t.need("piece", walk).and_then(|v| walk.text(v, "piece"));
    let name = t.need("name", walk).and_then(|v| word(v, walk));
    let run = body(&mut t, piece, walk);
    t.finish(walk);
    Some(EdgeNameSpec { run: run?, name: name?, source: Some(walk.source(at, Some("edge"))) })
}

/// A name that is no whole number: those are the numbers of edges.
fn word(value: Value<'_>, walk: &mut Walk<'_>) -> Option<String> {
    let name = walk.text(value, "name")?;
    if name.parse::<i64>().is_err() {
        return Some(name);
    }
    let message = format!("an edge cannot be called `{name}`: whole numbers are the numbers of edges");
    walk.error(codes::SEWING_EDGE_NAME, value.span().start, message, |d| {
        d.hint(format!("write a name with a letter in it, e.g. \"edge-{name}\""))
    });
    None
}
