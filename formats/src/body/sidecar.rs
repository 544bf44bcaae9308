//! The TOML file beside a body: name, measures, landmarks, segments.

use super::codes;
use crate::codes::UNKNOWN_KEY;
use crate::schema::{document, list, quantity, table, text, with_about};
use crate::toml_text::{TomlText, describe, did_you_mean};
use serde_json::{Map, Value, json};
use serde_spanned::Spanned;
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::ops::RangeInclusive;
use toile_garment::body::{Body, BodySegment};
use toile_garment::units::Length;
use toile_garment::{Diagnostic, Vec3};
use toml::de::{DeTable, DeValue};

/// Segments a piece can be placed around.
const SEGMENTS: [&str; 6] = ["torso", "arm-left", "arm-right", "leg-left", "leg-right", "neck"];
const SEGMENT_KEYS: [&str; 4] = ["from", "to", "half_width", "half_depth"];
/// Keys at the top of the file.
const TOP: [&str; 6] = ["name", "measures", "landmarks", "segments", "note", "source"];
/// Largest coordinate in a body file, metres.
const MAX: f64 = 10.0;
/// Largest measure of a body, metres: higher than a giant, and wider than the widest.
const MEASURE: f64 = 3.0;

/// The names in a side file whose values cannot be read: nothing is known of them, not even that they are missing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Unread {
    /// Nothing can be read.
    pub all: bool,
    /// Measures, landmarks and segments.
    pub names: BTreeSet<String>,
}

impl Unread {
    /// Can the value of one of these names not be read?
    #[must_use]
    pub fn has(&self, names: &[&str]) -> bool {
        self.all || names.iter().any(|name| self.names.contains(*name))
    }
}

/// The contents of the file.
#[derive(Default)]
pub struct Sidecar {
    pub name: String,
    pub measures: BTreeMap<String, f64>,
    pub landmarks: BTreeMap<String, Vec3>,
    pub segments: BTreeMap<String, BodySegment>,
}

struct Reader<'a> {
    toml: TomlText<'a>,
    findings: Vec<Diagnostic>,
    unread: Unread,
}

/// Reads what can be read of the file; the mistakes of the rest come with it.
pub fn read(text: &str, file: &str) -> (Sidecar, Unread, Vec<Diagnostic>) {
    let mut r = Reader { toml: TomlText::new(text, file), findings: Vec::new(), unread: Unread::default() };
    let mut out = Sidecar::default();
    let root = match r.toml.parse(codes::BODY_SYNTAX) {
        Ok(root) => root,
        Err(findings) => return (out, Unread { all: true, ..Unread::default() }, findings),
    };
    for (key, value) in root.get_ref() {
        match key.get_ref().as_ref() {
            "name" => out.name = r.text(key, value),
            "measures" => {
                for (name, value) in r.entries(key, value) {
                    let read = r.length(name.get_ref(), value, 0.0..=MEASURE);
                    r.give(name.get_ref(), read, &mut out.measures);
                }
            }
            "landmarks" => {
                for (name, value) in r.entries(key, value) {
                    let read = r.point(name.get_ref(), value);
                    r.give(name.get_ref(), read, &mut out.landmarks);
                }
            }
            "segments" => {
                for (name, value) in r.entries(key, value) {
                    let read = r.segment(name, value);
                    r.give(name.get_ref(), read, &mut out.segments);
                }
            }
            "note" | "source" => {
                r.text(key, value);
            }
            _ => r.unknown(key, &TOP),
        }
    }
    (out, r.unread, r.findings)
}

impl<'a> Reader<'a> {
    /// Puts a value under its name, or remembers that it could not be read.
    fn give<T>(&mut self, name: &str, value: Option<T>, to: &mut BTreeMap<String, T>) {
        match value {
            Some(value) => {
                to.insert(name.to_owned(), value);
            }
            None => {
                self.unread.names.insert(name.to_owned());
            }
        }
    }

    fn wrong<T>(&mut self, at: &Spanned<T>, message: String) {
        self.findings.push(Diagnostic::error(codes::BODY_VALUE, message).at(self.toml.place(at)));
    }

    fn unknown(&mut self, key: &Spanned<Cow<'_, str>>, known: &[&str]) {
        let finding = Diagnostic::error(UNKNOWN_KEY, format!("unknown key `{}` in a body file", key.get_ref()));
        let hint = did_you_mean(key.get_ref(), known.iter().copied());
        self.findings.push(finding.at(self.toml.place(key)).hint(hint));
    }

    fn text(&mut self, key: &Spanned<Cow<'_, str>>, value: &Spanned<DeValue<'_>>) -> String {
        match value.get_ref().as_str() {
            Some(text) => text.to_owned(),
            None => {
                self.wrong(value, format!("`{}` must be a text, not {}", key.get_ref(), describe(value.get_ref())));
                String::new()
            }
        }
    }

    fn entries<'t>(
        &mut self,
        key: &Spanned<Cow<'_, str>>,
        value: &'t Spanned<DeValue<'a>>,
    ) -> Vec<(&'t Spanned<Cow<'a, str>>, &'t Spanned<DeValue<'a>>)> {
        match value.get_ref().as_table() {
            Some(table) => table.iter().collect(),
            None => {
                self.wrong(value, format!("`{}` must be a table, not {}", key.get_ref(), describe(value.get_ref())));
                self.unread.all = true;
                Vec::new()
            }
        }
    }

    fn length(&mut self, name: &str, value: &Spanned<DeValue<'_>>, range: RangeInclusive<f64>) -> Option<f64> {
        let parsed = match value.get_ref() {
            DeValue::String(text) => text.parse::<Length>().map_err(|e| e.message),
            other => Err(format!("a length needs a unit, e.g. \"720 mm\", not {}", describe(other))),
        };
        match parsed {
            Ok(x) if range.contains(&x.0) => Some(x.0),
            Ok(x) => {
                let (low, high) = range.into_inner();
                self.wrong(value, format!("`{name} = {x}` is out of range; allowed is {low} m to {high} m"));
                None
            }
            Err(why) => {
                self.wrong(value, format!("`{name}`: {why}"));
                None
            }
        }
    }

    fn point(&mut self, name: &str, value: &Spanned<DeValue<'_>>) -> Option<Vec3> {
        let Some(cells) = value.get_ref().as_array().filter(|a| a.len() == 3) else {
            self.wrong(value, format!("`{name}` must be three lengths, e.g. [\"0 mm\", \"1040 mm\", \"0 mm\"]"));
            return None;
        };
        let cells: Vec<Option<f64>> = cells.iter().map(|c| self.length(name, c, -MAX..=MAX)).collect();
        match cells.as_slice() {
            [Some(x), Some(y), Some(z)] => Some(Vec3::new(*x, *y, *z)),
            _ => None,
        }
    }

    fn segment(&mut self, name: &Spanned<Cow<'a, str>>, value: &Spanned<DeValue<'a>>) -> Option<BodySegment> {
        if !SEGMENTS.contains(&name.get_ref().as_ref()) {
            self.unknown(name, &SEGMENTS);
            return None;
        }
        let Some(table) = value.get_ref().as_table() else {
            self.wrong(value, format!("`{}` must be a table", name.get_ref()));
            return None;
        };
        for (key, _) in table.iter().filter(|(k, _)| !SEGMENT_KEYS.contains(&k.get_ref().as_ref())) {
            self.unknown(key, &SEGMENT_KEYS);
        }
        let from = self.part(name, table, "from").and_then(|v| self.point("from", v));
        let to = self.part(name, table, "to").and_then(|v| self.point("to", v));
        let half_width = self.part(name, table, "half_width").and_then(|v| self.length("half_width", v, 1e-3..=MAX));
        let half_depth = self.part(name, table, "half_depth").and_then(|v| self.length("half_depth", v, 1e-3..=MAX));
        let segment = BodySegment { from: from?, to: to?, half_width: half_width?, half_depth: half_depth? };
        if (segment.to - segment.from).norm() < 1e-6 {
            self.wrong(value, format!("the segment `{}` has no length", name.get_ref()));
            return None;
        }
        Some(segment)
    }

    fn part<'t>(
        &mut self,
        name: &Spanned<Cow<'_, str>>,
        table: &'t DeTable<'a>,
        key: &str,
    ) -> Option<&'t Spanned<DeValue<'a>>> {
        let found = table.iter().find(|(k, _)| k.get_ref() == key).map(|(_, v)| v);
        if found.is_none() {
            self.wrong(name, format!("the segment `{}` has no `{key}`", name.get_ref()));
        }
        found
    }
}

/// JSON schema (draft 7) of the file, built from the same lists of keys as the reader.
#[must_use]
pub fn schema() -> Value {
    let length = quantity::<Length>;
    let point = || list("Three lengths: x to the wearer's left, y up, z to the front.", length(), 3);
    let named =
        |about: &str, value: Value| json!({ "description": about, "type": "object", "additionalProperties": value });
    let segment_key = |key: &str| match key {
        "from" => with_about(point(), "Upper end of the axis."),
        "to" => with_about(point(), "Lower end of the axis."),
        "half_width" => with_about(length(), "Half of the width across the axis, from the wearer's left to right."),
        _ => with_about(length(), "Half of the depth across the axis, from front to back."),
    };
    let segment = table(
        "An elliptic cylinder around a part of the body, for wrapping pieces around it.",
        &SEGMENT_KEYS,
        SEGMENT_KEYS.map(|key| (key.to_owned(), segment_key(key))).into_iter().collect(),
    );
    let segments: Map<String, Value> = SEGMENTS.map(|name| (name.to_owned(), segment.clone())).into_iter().collect();
    let top = |key: &str| match key {
        "name" => text("Name of the body. Default: the name of the mesh file."),
        "measures" => named("Lengths of the body by their ISO 8559-1 names, such as `waist_girth`.", length()),
        "landmarks" => named("Points of the body, such as `waist-front`.", point()),
        "segments" => table("Parts of the body that pieces are wrapped around.", &[], segments.clone()),
        "note" => text("A remark; the program does not use it."),
        _ => text("Where the body comes from."),
    };
    let about = "What the mesh of a body cannot say. The file has the name of the mesh, with the ending `.toml`.";
    document("toile body side file", about, &[], TOP.map(|key| (key.to_owned(), top(key))).into_iter().collect())
}

/// The file of a body.
pub fn write(body: &Body) -> String {
    let mut out = String::new();
    let point = |p: &Vec3| format!("[\"{}\", \"{}\", \"{}\"]", length(p.x), length(p.y), length(p.z));
    // Writing to a String cannot fail.
    let _ = writeln!(out, "name = {}", toml::Value::String(body.name.clone()));
    if !body.measures.is_empty() {
        out.push_str("\n[measures]\n");
    }
    for (name, x) in &body.measures {
        let _ = writeln!(out, "{} = \"{}\"", quoted(name), length(*x));
    }
    if !body.landmarks.is_empty() {
        out.push_str("\n[landmarks]\n");
    }
    for (name, p) in &body.landmarks {
        let _ = writeln!(out, "{} = {}", quoted(name), point(p));
    }
    for (name, s) in &body.segments {
        let _ = writeln!(out, "\n[segments.{}]", quoted(name));
        let _ = writeln!(out, "from = {}\nto = {}", point(&s.from), point(&s.to));
        let _ = writeln!(out, "half_width = \"{}\"\nhalf_depth = \"{}\"", length(s.half_width), length(s.half_depth));
    }
    out
}

/// A length in millimetres, 12 digits: reads back within a rounding error, and is written the same again.
fn length(x: f64) -> String {
    // −0 becomes 0: equal numbers give equal bytes.
    Length(x + 0.0).to_string()
}

/// A TOML key: bare where it can be.
fn quoted(text: &str) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    if !text.is_empty() && text.chars().all(bare) {
        return text.to_owned();
    }
    toile_garment::text::quoted(text)
}
