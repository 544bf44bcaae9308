//! The grammar of a file of golden cases: TOML text → cases as written, with their places.

use super::codes;
use crate::codes::{PATH_REFUSED, WRONG_VALUE};
use crate::diff::Tolerance;
use crate::engine::{Exit, output_below};
use crate::figures::Bounds;
use crate::line::{Set, sets};
use crate::pipeline::{MISSING_KEY, Reader, SourceText, parse_toml};
use std::collections::BTreeSet;
use std::ops::Range;
use std::path::{Path, PathBuf};
use toile_garment::Report;
use toml::Spanned;
use toml::de::{DeTable, DeValue, ValueDeserializer};

/// A golden case as written.
#[derive(Clone, Debug)]
pub struct GoldenCase {
    /// Name.
    pub name: String,
    /// Pipeline file, from the folder of the file of cases.
    pub pipeline: PathBuf,
    /// Overrides.
    pub sets: Vec<Set>,
    /// Exit code that the run must have.
    pub exit: u8,
    /// Codes of findings that it must tell.
    pub findings: Vec<String>,
    /// A garment that its garment must be like.
    pub like: Option<Like>,
    /// Figures that it must have.
    pub figures: Vec<GoldenFigure>,
    /// Outputs that must have the same bytes.
    pub hashes: Vec<GoldenHash>,
    /// Its place.
    pub span: Range<usize>,
}

impl GoldenCase {
    /// Does the case look at anything but that its run ends well?
    #[must_use]
    pub fn judges(&self) -> bool {
        let is_empty = self.figures.is_empty() && self.hashes.is_empty() && self.findings.is_empty();
        !is_empty || self.like.is_some() || self.exit != 0
    }
}

/// A golden garment.
#[derive(Clone, Debug)]
pub struct Like {
    /// GLB file below the folder of the file of cases.
    pub path: PathBuf,
    /// Differences that are allowed, as those of `toile diff`.
    pub tolerance: Tolerance,
    /// Its place.
    pub span: Range<usize>,
}

/// A golden figure, and bounds that nobody blesses.
#[derive(Clone, Debug)]
pub struct GoldenFigure {
    /// Keys that lead to it in the file.
    pub keys: Vec<String>,
    /// Its name and bounds.
    pub bounds: Bounds,
    /// The golden value; `None` before it is blessed, or where bounds alone are asked.
    pub value: Option<f64>,
    /// How far it may be off.
    pub within: Option<f64>,
    /// True if it is written with a unit.
    pub is_length: bool,
    /// Its place.
    pub span: Range<usize>,
}

/// A golden output.
#[derive(Clone, Debug)]
pub struct GoldenHash {
    /// Its path below the output folder.
    pub path: String,
    /// blake3 of its bytes, hex; `None` before it is blessed.
    pub blake3: Option<String>,
    /// Its place.
    pub span: Range<usize>,
}

/// Reads the grammar. `None` only if the text is no TOML at all.
pub(super) fn parse(source: &SourceText, folder: &Path, report: &mut Report) -> Option<Vec<GoldenCase>> {
    let root = parse_toml(source, report)?;
    let root = root.get_ref();
    let mut cx = Reader { source, report };
    cx.refuse_unknown(root, &["toile", "about", "case", "history"], "a file of golden cases");
    cx.check_grammar(root);
    cx.require(root, "case", &(0..0), "at least one [[case]]");
    cx.text(root, "about");
    for (entry, _) in cx.tables(root, "history") {
        cx.refuse_unknown(entry, &["reason", "toile", "changed"], "[[history]]");
    }
    let mut taken = BTreeSet::new();
    let tables = cx.tables(root, "case");
    Some(tables.into_iter().filter_map(|(table, span)| read_case(&mut cx, table, span, folder, &mut taken)).collect())
}

const CASE_KEYS: [&str; 9] = ["name", "pipeline", "set", "exit", "findings", "like", "tolerance", "figures", "hashes"];

fn read_case(
    cx: &mut Reader<'_>,
    table: &DeTable<'_>,
    span: Range<usize>,
    folder: &Path,
    taken: &mut BTreeSet<String>,
) -> Option<GoldenCase> {
    cx.refuse_unknown(table, &CASE_KEYS, "[[case]]");
    cx.require(table, "name", &span, "the name of the case");
    cx.require(table, "pipeline", &span, "the pipeline file, from the folder of this file");
    let name = cx.text(table, "name").map(|name| (name.span(), cx.name(name, "name of a case")));
    if let Some((span, name)) = name.as_ref().filter(|(_, name)| !taken.insert(name.clone())) {
        cx.push(codes::TEST_CASE_TWICE, span, format!("two cases are called `{name}`"), "give each its own name");
    }
    let pipeline = cx.text(table, "pipeline");
    if let Some(path) = pipeline.as_ref().filter(|p| !folder.join(p.get_ref()).is_file()) {
        let message = format!("there is no pipeline file `{}`", path.get_ref());
        cx.push(crate::codes::FILE_MISSING, &path.span(), message, "paths start at the folder of this file");
    }
    let sets = cx.table(table, "set", &span).map(|(inner, _)| sets(inner)).unwrap_or_default();
    let figures = cx.table(table, "figures", &span).map(|(inner, _)| inner);
    let hashes = cx.table(table, "hashes", &span).map(|(inner, _)| inner);
    let mut case = GoldenCase {
        name: String::new(),
        pipeline: PathBuf::new(),
        sets,
        exit: read_exit(cx, table),
        findings: read_findings(cx, table),
        like: read_like(cx, table, &span),
        figures: Vec::new(),
        hashes: hashes.map(|inner| read_hashes(cx, inner)).unwrap_or_default(),
        span,
    };
    if let Some(inner) = figures {
        read_figures(cx, inner, &[], &mut case.figures);
    }
    Some(GoldenCase { name: name?.1, pipeline: PathBuf::from(pipeline?.into_inner()), ..case })
}

fn read_exit(cx: &mut Reader<'_>, table: &DeTable<'_>) -> u8 {
    let Some(code) = cx.count(table, "exit") else { return 0 };
    let known = u8::try_from(code).ok().filter(|c| *c <= Exit::System.code());
    if let (None, Some(value)) = (known, table.get("exit")) {
        cx.push(WRONG_VALUE, &value.span(), format!("{code} is no exit code of a run"), "write one of 0 to 5");
    }
    known.unwrap_or(0)
}

fn read_findings(cx: &mut Reader<'_>, table: &DeTable<'_>) -> Vec<String> {
    let Some(list) = table.get("findings") else { return Vec::new() };
    let DeValue::Array(items) = list.get_ref() else {
        cx.wrong_type(list, "findings", "a list of codes in quotes");
        return Vec::new();
    };
    let mut found = Vec::new();
    for item in items {
        match item.get_ref() {
            DeValue::String(code) => found.push(code.to_string()),
            _ => cx.wrong_type(item, "findings", "a list of codes in quotes"),
        }
    }
    found
}

fn read_like(cx: &mut Reader<'_>, table: &DeTable<'_>, span: &Range<usize>) -> Option<Like> {
    if table.contains_key("tolerance") {
        cx.require(table, "like", span, "the golden garment that the tolerance is for, e.g. like = \"skirt.glb\"");
    }
    let path = cx.text(table, "like")?;
    cx.require(table, "tolerance", span, "what may differ, e.g. tolerance = { shape = \"2 mm\" }");
    let (_, place) = cx.table(table, "tolerance", span)?;
    let tolerance = read_tolerance(cx, table.get("tolerance")?, &place)?;
    let below = output_below(Path::new(path.get_ref())).ok();
    let is_glb = |p: &PathBuf| p.extension().is_some_and(|e| e.eq_ignore_ascii_case("glb"));
    let Some(below) = below.filter(is_glb) else {
        let message = format!("`{}` is no place for a golden garment", path.get_ref());
        cx.push(PATH_REFUSED, &path.span(), message, "name a GLB below the folder of this file");
        return None;
    };
    Some(Like { path: below, tolerance, span: path.span() })
}

fn read_tolerance(cx: &mut Reader<'_>, value: &Spanned<DeValue<'_>>, place: &Range<usize>) -> Option<Tolerance> {
    match serde::Deserialize::deserialize(ValueDeserializer::from(value.clone())) {
        Ok(tolerance) => {
            let tolerance: Tolerance = tolerance;
            if tolerance.is_empty() {
                let message = "the tolerance states nothing, so the golden garment judges nothing".to_owned();
                cx.push(WRONG_VALUE, place, message, "write e.g. tolerance = { shape = \"2 mm\" }");
            }
            Some(tolerance)
        }
        Err(error) => {
            let at = error.span().unwrap_or_else(|| place.clone());
            let hint = "write e.g. shape = \"2 mm\", strain = 0.01 or inputs = \"same\"";
            cx.push(WRONG_VALUE, &at, error.message().to_owned(), hint);
            None
        }
    }
}

fn read_hashes(cx: &mut Reader<'_>, table: &DeTable<'_>) -> Vec<GoldenHash> {
    let mut found = Vec::new();
    for (key, value) in table {
        let hash = cx.text(table, key.get_ref()).map(Spanned::into_inner);
        let is_hash = |h: &String| h.is_empty() || (h.len() == 64 && h.bytes().all(|c| c.is_ascii_hexdigit()));
        if hash.as_ref().is_some_and(|h| !is_hash(h)) {
            let message = format!("the hash of `{}` is none: it has 64 digits, 0 to 9 and a to f", key.get_ref());
            cx.push(WRONG_VALUE, &value.span(), message, "write \"\" and let --bless fill it in");
        }
        let blake3 = hash.filter(|h| !h.is_empty());
        found.push(GoldenHash { path: key.get_ref().to_string(), blake3, span: key.span() });
    }
    found
}

const FIGURE_KEYS: [&str; 4] = ["value", "within", "min", "max"];

/// Figures by their names; a name with dots may be written as tables in tables.
fn read_figures(cx: &mut Reader<'_>, table: &DeTable<'_>, before: &[String], found: &mut Vec<GoldenFigure>) {
    for (key, value) in table {
        let mut keys = before.to_vec();
        keys.push(key.get_ref().to_string());
        let DeValue::Table(inner) = value.get_ref() else {
            cx.wrong_type(value, &keys.join("."), "a table: { value = 0.1, within = 0.02 }");
            continue;
        };
        let is_name = !inner.is_empty() && inner.values().all(|v| matches!(v.get_ref(), DeValue::Table(_)));
        if is_name {
            read_figures(cx, inner, &keys, found);
        } else {
            found.extend(read_figure(cx, inner, keys, key.span()));
        }
    }
}

fn read_figure(
    cx: &mut Reader<'_>,
    table: &DeTable<'_>,
    keys: Vec<String>,
    span: Range<usize>,
) -> Option<GoldenFigure> {
    let figure = keys.join(".");
    cx.refuse_unknown(table, &FIGURE_KEYS, &format!("the figure `{figure}`"));
    let has = |key: &str| table.contains_key(key);
    if !has("within") && (has("value") || !(has("min") || has("max"))) {
        let message = format!("`within` of the figure `{figure}` is missing");
        cx.push(MISSING_KEY, &span, message, "add how far it may be off, e.g. within = \"2 mm\" or within = 0.01");
        return None;
    }
    let [value, within, min, max] = FIGURE_KEYS.map(|key| cx.bound(table, key));
    if let Some(place) = table.get("within").filter(|_| within.is_some_and(|w| w < 0.0)) {
        cx.push(WRONG_VALUE, &place.span(), "`within` must be 0 or more".to_owned(), "write how far it may be off");
    }
    let is_length = table.values().any(|v| matches!(v.get_ref(), DeValue::String(_)));
    let bounds = Bounds { figure, min, max };
    if let Some(why) = bounds.impossible() {
        cx.push(WRONG_VALUE, &span, why, "correct `min` and `max`");
    }
    Some(GoldenFigure { keys, bounds, value, within, is_length, span })
}
