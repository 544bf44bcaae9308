//! The grammar of a line: TOML text → styles, matrix, rules, limits and gates as written, with their places.

use super::value::{Set, label, raw, sets};
use crate::codes::{UNKNOWN_VALUE, WRONG_VALUE};
use crate::engine::Limits;
use crate::figures::{Bounds, Kind, certificate_keys, kind};
use crate::pipeline::{Reader, SourceText, parse_toml, remedy};
use std::ops::Range;
use std::path::PathBuf;
use std::str::FromStr;
use toile_garment::Report;
use toile_garment::units::{Duration, Memory, UnitError};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A line as written.
#[derive(Clone, Debug, Default)]
pub struct LineFile {
    /// Name of the line.
    pub name: String,
    /// Limits of every job.
    pub limits: Limits,
    /// Styles.
    pub styles: Vec<Style>,
    /// Axes of the matrix.
    pub axes: Vec<Axis>,
    /// Jobs that are left out.
    pub excludes: Vec<Rule>,
    /// Single jobs.
    pub includes: Vec<Include>,
    /// Figures that every job must keep to.
    pub gates: Vec<Bounds>,
}

/// A style: a pipeline with what is set for all its jobs.
#[derive(Clone, Debug)]
pub struct Style {
    /// Name.
    pub name: String,
    /// Pipeline file, from the folder of the line.
    pub pipeline: PathBuf,
    /// Overrides of all its jobs.
    pub sets: Vec<Set>,
    /// Axes that replace those of the matrix, or come to them.
    pub axes: Vec<Axis>,
    /// Its place.
    pub span: Range<usize>,
}

/// An axis of the matrix.
#[derive(Clone, Debug)]
pub struct Axis {
    /// Name: the input that a plain value sets.
    pub name: String,
    /// Choices.
    pub choices: Vec<Choice>,
}

/// One value of an axis.
#[derive(Clone, Debug)]
pub struct Choice {
    /// Name, which stands in the names of jobs.
    pub label: String,
    /// Overrides that it means.
    pub sets: Vec<Set>,
    /// Its place.
    pub span: Range<usize>,
}

/// An exclude: jobs that agree with all its cells are left out.
#[derive(Clone, Debug)]
pub struct Rule {
    /// Axis or `style`, and the choices that are meant.
    pub cells: Vec<(String, Vec<Choice>)>,
    /// Its place.
    pub span: Range<usize>,
}

/// A single job.
#[derive(Clone, Debug)]
pub struct Include {
    /// Axis and choice.
    pub cells: Vec<(String, Choice)>,
    /// Style.
    pub style: Spanned<String>,
    /// Further overrides.
    pub sets: Vec<Set>,
    /// A word that is added to its name.
    pub name: Option<String>,
    /// Its place.
    pub span: Range<usize>,
}

/// Reads the grammar. `None` only if the text is no TOML at all.
pub(super) fn parse(source: &SourceText, report: &mut Report) -> Option<LineFile> {
    let root = parse_toml(source, report)?;
    let root = root.get_ref();
    let mut cx = Reader { source, report };
    cx.refuse_unknown(root, &["toile", "line", "limits", "style", "matrix", "exclude", "include", "gate"], "a line");
    cx.check_grammar(root);
    let matrix = cx.table(root, "matrix", &(0..0)).map(|(table, _)| table);
    Some(LineFile {
        name: read_name(&mut cx, root),
        limits: read_limits(&mut cx, root),
        styles: cx.tables(root, "style").into_iter().filter_map(|(t, span)| read_style(&mut cx, t, span)).collect(),
        axes: matrix.map(|table| read_axes(&mut cx, table)).unwrap_or_default(),
        excludes: cx.tables(root, "exclude").into_iter().map(|(t, span)| read_rule(&mut cx, t, span)).collect(),
        includes: cx
            .tables(root, "include")
            .into_iter()
            .filter_map(|(t, span)| read_include(&mut cx, t, span))
            .collect(),
        gates: cx.tables(root, "gate").into_iter().filter_map(|(t, span)| read_gate(&mut cx, t, &span)).collect(),
    })
}

fn read_name(cx: &mut Reader<'_>, root: &DeTable<'_>) -> String {
    cx.require(root, "line", &(0..0), "[line] with `name`");
    let Some((table, span)) = cx.table(root, "line", &(0..0)) else { return "unnamed".to_owned() };
    cx.refuse_unknown(table, &["name", "about"], "[line]");
    cx.require(table, "name", &span, "the name of the line, e.g. name = \"spring\"");
    cx.text(table, "about");
    cx.text(table, "name").map_or_else(|| "unnamed".to_owned(), |name| cx.name(name, "name of a line"))
}

fn read_limits(cx: &mut Reader<'_>, root: &DeTable<'_>) -> Limits {
    let Some((table, _)) = cx.table(root, "limits", &(0..0)) else { return Limits::default() };
    cx.refuse_unknown(table, &["time", "memory"], "[limits]");
    Limits {
        seconds: quantity(cx, table, "time", |t: Duration| t.0),
        mb: quantity(cx, table, "memory", |m: Memory| m.0),
    }
}

/// A quantity above zero.
fn quantity<Q: FromStr<Err = UnitError>>(
    cx: &mut Reader<'_>,
    table: &DeTable<'_>,
    key: &str,
    inside: impl Fn(Q) -> f64,
) -> Option<f64> {
    let text = cx.text(table, key)?;
    match text.get_ref().parse().map(inside) {
        Ok(number) if number > 0.0 => return Some(number),
        Ok(_) => cx.push(WRONG_VALUE, &text.span(), format!("`{key}` must be above 0"), "write a larger value"),
        Err(error) => cx.push(WRONG_VALUE, &text.span(), error.message, "write a number and a unit"),
    }
    None
}

fn read_style(cx: &mut Reader<'_>, table: &DeTable<'_>, span: Range<usize>) -> Option<Style> {
    cx.refuse_unknown(table, &["name", "pipeline", "pattern", "set", "matrix"], "[[style]]");
    cx.require(table, "name", &span, "the name of the style");
    cx.require(table, "pipeline", &span, "the pipeline file, from the folder of the line");
    let name = cx.text(table, "name").map(|name| cx.name(name, "name of a style"));
    let pipeline = cx.text(table, "pipeline");
    let pattern = cx.text(table, "pattern").map(|p| Set::new("pattern", p.get_ref(), p.span()));
    let own = cx.table(table, "set", &span).map(|(inner, _)| sets(inner)).unwrap_or_default();
    let axes = cx.table(table, "matrix", &span).map(|(inner, _)| read_axes(cx, inner)).unwrap_or_default();
    let sets = pattern.into_iter().chain(own).collect();
    Some(Style { name: name?, pipeline: PathBuf::from(pipeline?.into_inner()), sets, axes, span })
}

fn read_axes(cx: &mut Reader<'_>, table: &DeTable<'_>) -> Vec<Axis> {
    let mut axes = Vec::new();
    for (key, value) in table {
        let name = key.get_ref().as_ref();
        if ["style", "set", "name"].contains(&name) {
            let message = format!("`{name}` has a meaning of its own and cannot be an axis");
            cx.push(crate::pipeline::BAD_NAME, &key.span(), message, "give the axis another name");
            continue;
        }
        let choices = match value.get_ref() {
            DeValue::Array(items) => items.iter().filter_map(|item| plain(cx, name, item)).collect(),
            DeValue::Table(inner) => inner.iter().filter_map(|(k, v)| named(cx, k.get_ref(), k.span(), v)).collect(),
            _ => {
                cx.wrong_type(value, name, "a list of values, or a table of named choices");
                continue;
            }
        };
        axes.push(Axis { name: name.to_owned(), choices });
    }
    axes
}

/// A plain value: it sets the input with the name of its axis.
fn plain(cx: &mut Reader<'_>, axis: &str, item: &Spanned<DeValue<'_>>) -> Option<Choice> {
    let scalar = !matches!(item.get_ref(), DeValue::Array(_) | DeValue::Table(_));
    let Some(text) = raw(item).filter(|_| scalar) else {
        cx.wrong_type(item, axis, "a text or a number");
        return None;
    };
    let label = label(&text);
    if label.is_empty() {
        let message = format!("`{text}` gives no name for a folder");
        cx.push(crate::pipeline::BAD_NAME, &item.span(), message, "name the choice: [matrix.AXIS] with NAME = { … }");
        return None;
    }
    Some(Choice { label, sets: vec![Set::new(axis, &text, item.span())], span: item.span() })
}

/// A named choice with its overrides.
fn named(cx: &mut Reader<'_>, name: &str, span: Range<usize>, value: &Spanned<DeValue<'_>>) -> Option<Choice> {
    if label(name) != name || name.is_empty() {
        let hint = "use letters, digits, dots and hyphens";
        cx.push(crate::pipeline::BAD_NAME, &span, format!("`{name}` is no good name of a choice"), hint);
        return None;
    }
    let DeValue::Table(table) = value.get_ref() else {
        cx.wrong_type(value, name, "a table of inputs and parameters");
        return None;
    };
    Some(Choice { label: name.to_owned(), sets: sets(table), span })
}

fn read_rule(cx: &mut Reader<'_>, table: &DeTable<'_>, span: Range<usize>) -> Rule {
    let mut cells = Vec::new();
    for (key, value) in table {
        let axis = key.get_ref().to_string();
        let one = std::slice::from_ref(value);
        let items = match value.get_ref() {
            DeValue::Array(items) => &items[..],
            _ => one,
        };
        let choices = items.iter().filter_map(|item| plain(cx, &axis, item)).collect();
        cells.push((axis, choices));
    }
    Rule { cells, span }
}

fn read_include(cx: &mut Reader<'_>, table: &DeTable<'_>, span: Range<usize>) -> Option<Include> {
    cx.require(table, "style", &span, "the style of the job");
    let mut cells = Vec::new();
    for (key, value) in table.iter().filter(|(k, _)| !["style", "set", "name"].contains(&k.get_ref().as_ref())) {
        let axis = key.get_ref().to_string();
        let choice = plain(cx, &axis, value)?;
        cells.push((axis, choice));
    }
    let style = cx.text(table, "style");
    let name = cx.text(table, "name").map(|name| cx.name(name, "name of a job"));
    let sets = cx.table(table, "set", &span).map(|(inner, _)| sets(inner)).unwrap_or_default();
    Some(Include { cells, style: style?, sets, name, span })
}

fn read_gate(cx: &mut Reader<'_>, table: &DeTable<'_>, span: &Range<usize>) -> Option<Bounds> {
    cx.refuse_unknown(table, &["figure", "min", "max"], "[[gate]]");
    cx.require(table, "figure", span, "the figure, e.g. figure = \"strain_max\"");
    let [min, max] = ["min", "max"].map(|key| cx.bound(table, key));
    let figure = cx.text(table, "figure")?;
    if !table.contains_key("min") && !table.contains_key("max") {
        cx.require(table, "max", span, "a bound: min or max");
    }
    check_figure(cx, table, &figure);
    let bounds = Bounds { figure: figure.into_inner(), min, max };
    if let Some(why) = bounds.impossible() {
        cx.push(WRONG_VALUE, span, why, "correct `min` and `max`");
    }
    Some(bounds)
}

/// A gate must name a figure that runs have, and its bounds must be of the kind of the figure.
fn check_figure(cx: &mut Reader<'_>, table: &DeTable<'_>, figure: &Spanned<String>) {
    let name = figure.get_ref();
    let Some(kind) = kind(name) else {
        let keys = certificate_keys();
        let hint = format!("{}; a measure is NAME.on.method", remedy(name, keys.iter().map(String::as_str)));
        cx.push(UNKNOWN_VALUE, &figure.span(), format!("no run has a figure `{name}`"), hint);
        return;
    };
    for value in ["min", "max"].iter().filter_map(|key| table.get(*key)) {
        let has_unit = matches!(value.get_ref(), DeValue::String(_));
        if kind == Kind::Measure && !has_unit {
            let message = format!("`{name}` is a length, and its bound has no unit");
            cx.push(WRONG_VALUE, &value.span(), message, "write a length such as \"980 mm\"");
        } else if kind == Kind::Number && has_unit {
            cx.push(WRONG_VALUE, &value.span(), format!("`{name}` is no length"), "write a plain number");
        }
    }
}
