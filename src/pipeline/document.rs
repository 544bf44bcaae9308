//! The grammar of the pipeline file: TOML text → stages, inputs and plugins as written, with their places.

use super::codes;
use super::inputs::{Input, read_inputs};
use super::nearest::remedy;
use super::plugins::{Plugin, read_plugins};
use super::text::{MAX_BYTES, SourceText};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use toile_formats::codes::{FILE_TOO_LARGE, UNKNOWN_KEY};
use toile_garment::units::Length;
use toile_garment::{Code, Report};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Version of the grammar this program reads.
pub const GRAMMAR: i64 = 1;
/// More errors than this are not listed.
pub const MAX_ERRORS: usize = 50;

/// A pipeline file as written, before its stages are looked up.
pub struct Document<'t> {
    /// The text it came from.
    pub source: &'t SourceText,
    /// Product line.
    pub line: String,
    /// Version of the product line's pipeline.
    pub version: u64,
    /// Seed for anything random.
    pub seed: u64,
    /// The wanted accuracy: the name of a preset or a length.
    pub accuracy: Option<Spanned<String>>,
    /// The inputs that the caller may set.
    pub inputs: BTreeMap<String, Input>,
    /// Stages in other processes.
    pub plugins: Vec<Plugin>,
    /// The chain.
    pub stages: Vec<StageEntry<'t>>,
}

/// One `[[stage]]`.
pub struct StageEntry<'t> {
    /// Name of the stage.
    pub name: Spanned<String>,
    /// Id, given or made from the name.
    pub id: String,
    /// Parameters, not yet looked at.
    pub with: Spanned<DeTable<'t>>,
}

/// Reads the grammar. Mistakes go to the report; `None` only if the text is no TOML at all.
pub fn parse<'t>(source: &'t SourceText, report: &mut Report) -> Option<Document<'t>> {
    if source.text().len() as u64 > MAX_BYTES {
        let message = format!("the pipeline has {} bytes, over the limit of {MAX_BYTES}", source.text().len());
        report.push(source.error(FILE_TOO_LARGE, &(0..0), message));
        return None;
    }
    let root = parse_toml(source, report)?;
    Some(read_root(source, root.get_ref(), report))
}

/// The table of a TOML text; its mistakes go to the report.
pub(crate) fn parse_toml<'t>(source: &'t SourceText, report: &mut Report) -> Option<Spanned<DeTable<'t>>> {
    let (root, errors) = DeTable::parse_recoverable(source.text());
    for error in errors.iter().take(MAX_ERRORS) {
        let message = error.message().replace("recursion limit", "tables or lists are nested beyond the limit of 80");
        report.push(source.error(codes::TOML_SYNTAX, &error.span().unwrap_or(0..0), message));
    }
    errors.is_empty().then_some(root)
}

fn read_root<'t>(source: &'t SourceText, root: &DeTable<'t>, report: &mut Report) -> Document<'t> {
    let mut cx = Reader { source, report };
    cx.refuse_unknown(root, &["toile", "pipeline", "input", "plugin", "stage"], "a pipeline file");
    cx.check_grammar(root);
    let (line, version, seed) = read_head(&mut cx, root);
    let accuracy = read_accuracy(&mut cx, root);
    let inputs = read_inputs(&mut cx, root);
    let plugins = read_plugins(&mut cx, root);
    let stages = read_stages(&mut cx, root);
    Document { source, line, version, seed, accuracy, inputs, plugins, stages }
}

fn read_head(cx: &mut Reader<'_>, root: &DeTable<'_>) -> (String, u64, u64) {
    let fallback = ("unnamed".to_owned(), 0, 0);
    let Some(head) = cx.table(root, "pipeline", &(0..0)) else {
        cx.require(root, "pipeline", &(0..0), "[pipeline] with `line` and `version`");
        return fallback;
    };
    let (table, span) = head;
    cx.refuse_unknown(table, &["line", "version", "seed", "accuracy", "about"], "[pipeline]");
    cx.require(table, "line", &span, "the product line, e.g. line = \"a-line-skirt\"");
    cx.require(table, "version", &span, "the version, e.g. version = 1");
    cx.text(table, "about");
    let line = cx.text(table, "line").map(|line| cx.name(line, "product line"));
    let version = cx.count(table, "version");
    let seed = cx.count(table, "seed");
    (line.unwrap_or(fallback.0), version.unwrap_or(0), seed.unwrap_or(0))
}

fn read_accuracy(cx: &mut Reader<'_>, root: &DeTable<'_>) -> Option<Spanned<String>> {
    match root.get("pipeline")?.get_ref() {
        DeValue::Table(head) => cx.text(head, "accuracy"),
        _ => None,
    }
}

fn read_stages<'t>(cx: &mut Reader<'_>, root: &DeTable<'t>) -> Vec<StageEntry<'t>> {
    let Some(list) = root.get("stage") else {
        cx.require(root, "stage", &(0..0), "at least one [[stage]]");
        return Vec::new();
    };
    let DeValue::Array(items) = list.get_ref() else {
        cx.wrong_type(list, "stage", "a list: write [[stage]], with two brackets");
        return Vec::new();
    };
    let mut taken = Ids::default();
    items.iter().filter_map(|item| read_stage(cx, item, &mut taken)).collect()
}

fn read_stage<'t>(cx: &mut Reader<'_>, item: &Spanned<DeValue<'t>>, taken: &mut Ids) -> Option<StageEntry<'t>> {
    let DeValue::Table(table) = item.get_ref() else {
        cx.wrong_type(item, "stage", "a table: write [[stage]]");
        return None;
    };
    cx.refuse_stage_keys(table);
    cx.require(table, "use", &item.span(), "the stage's name, e.g. use = \"triangulate\"");
    let name = cx.text(table, "use")?;
    let id = match cx.text(table, "id") {
        Some(id) => {
            let span = id.span();
            let id = cx.name(id, "id");
            if !taken.all.insert(id.clone()) {
                cx.push(codes::DUPLICATE_ID, &span, format!("two stages have the id `{id}`"), "give each its own id");
            }
            id
        }
        None => taken.free(name.get_ref()),
    };
    let with = match table.get("with") {
        None => Spanned::new(item.span(), DeTable::new()),
        Some(value) => match value.get_ref() {
            DeValue::Table(with) => Spanned::new(value.span(), with.clone()),
            _ => {
                cx.wrong_type(value, "with", "a table of parameters");
                return None;
            }
        },
    };
    Some(StageEntry { name, id, with })
}

/// Ids that are taken.
#[derive(Default)]
struct Ids {
    all: BTreeSet<String>,
    /// The first number not tried yet for a name that stands more than once.
    next: BTreeMap<String, u32>,
}

impl Ids {
    /// The stage's name; for a second use of it `name-2` and so on.
    fn free(&mut self, name: &str) -> String {
        if self.all.insert(name.to_owned()) {
            return name.to_owned();
        }
        let next = self.next.entry(name.to_owned()).or_insert(2);
        loop {
            let id = format!("{name}-{next}");
            *next = next.saturating_add(1);
            if self.all.insert(id.clone()) {
                return id;
            }
        }
    }
}

/// Reads tables and collects what is wrong with them.
pub(crate) struct Reader<'a> {
    /// The text, for places.
    pub source: &'a SourceText,
    /// Where mistakes go.
    pub report: &'a mut Report,
}

impl Reader<'_> {
    pub fn push(&mut self, code: Code, span: &Range<usize>, message: String, hint: impl Into<String>) {
        let finding = self.source.error(code, span, message).hint(hint);
        self.report.push(finding);
    }

    /// Was something reported at this very place?
    pub fn has_said(&self, span: &Range<usize>) -> bool {
        let place = self.source.place(span);
        self.report.findings.iter().any(|f| f.source.as_ref() == Some(&place))
    }

    pub fn wrong_type(&mut self, value: &Spanned<DeValue<'_>>, key: &str, wanted: &str) {
        let message = format!("`{key}` is {}, but must be {wanted}", value.get_ref().type_str());
        self.push(codes::WRONG_TYPE, &value.span(), message, format!("write {wanted}"));
    }

    pub fn refuse_unknown(&mut self, table: &DeTable<'_>, known: &[&str], owner: &str) {
        for (key, _) in table {
            if !known.contains(&key.get_ref().as_ref()) {
                let message = format!("unknown key `{}` in {owner}", key.get_ref());
                self.push(UNKNOWN_KEY, &key.span(), message, remedy(key.get_ref(), known.iter().copied()));
            }
        }
    }

    /// Engine keys and stage keys never share a table; whoever mixes them is told where they go.
    fn refuse_stage_keys(&mut self, table: &DeTable<'_>) {
        const KNOWN: [&str; 3] = ["use", "id", "with"];
        for (key, _) in table {
            let name = key.get_ref().as_ref();
            if KNOWN.contains(&name) {
                continue;
            }
            let near = super::nearest::nearest(name, KNOWN);
            let hint = near.map_or_else(
                || format!("a parameter of the stage is written `with.{name}`"),
                |near| format!("did you mean `{near}`? A parameter of the stage is written `with.{name}`"),
            );
            self.push(UNKNOWN_KEY, &key.span(), format!("unknown key `{name}` in [[stage]]"), hint);
        }
    }

    pub fn require(&mut self, table: &DeTable<'_>, key: &str, span: &Range<usize>, what: &str) {
        if !table.contains_key(key) {
            self.push(codes::MISSING_KEY, span, format!("`{key}` is missing"), format!("add {what}"));
        }
    }

    pub fn table<'a, 'i>(
        &mut self,
        table: &'a DeTable<'i>,
        key: &str,
        _: &Range<usize>,
    ) -> Option<(&'a DeTable<'i>, Range<usize>)> {
        let value = table.get(key)?;
        if let DeValue::Table(inner) = value.get_ref() {
            return Some((inner, value.span()));
        }
        self.wrong_type(value, key, &format!("a table: [{key}]"));
        None
    }

    /// A list of tables: `[[key]]`.
    pub fn tables<'a, 'i>(&mut self, table: &'a DeTable<'i>, key: &str) -> Vec<(&'a DeTable<'i>, Range<usize>)> {
        let Some(list) = table.get(key) else { return Vec::new() };
        let DeValue::Array(items) = list.get_ref() else {
            self.wrong_type(list, key, &format!("a list: write [[{key}]], with two brackets"));
            return Vec::new();
        };
        let mut found = Vec::new();
        for item in items {
            match item.get_ref() {
                DeValue::Table(table) => found.push((table, item.span())),
                _ => self.wrong_type(item, key, &format!("a table: write [[{key}]]")),
            }
        }
        found
    }

    /// A bound: a number, or a length, which becomes mm.
    pub fn bound(&mut self, table: &DeTable<'_>, key: &str) -> Option<f64> {
        let value = table.get(key)?;
        let number = match value.get_ref() {
            DeValue::Integer(n) => n.to_string().parse().ok(),
            DeValue::Float(n) => n.as_str().parse().ok().filter(|n: &f64| n.is_finite()),
            DeValue::String(text) => text.parse::<Length>().ok().map(|l| 1e3 * l.0),
            _ => None,
        };
        if number.is_none() {
            self.wrong_type(value, key, "a finite number, or a length such as \"20 mm\"");
        }
        number
    }

    pub fn text(&mut self, table: &DeTable<'_>, key: &str) -> Option<Spanned<String>> {
        let value = table.get(key)?;
        if let DeValue::String(text) = value.get_ref() {
            return Some(Spanned::new(value.span(), text.to_string()));
        }
        self.wrong_type(value, key, "a text in quotes");
        None
    }

    pub fn count(&mut self, table: &DeTable<'_>, key: &str) -> Option<u64> {
        let value = table.get(key)?;
        let number = whole_number(value.get_ref()).and_then(|n| u64::try_from(n).ok());
        if number.is_none() {
            self.wrong_type(value, key, "a whole number, 0 or more");
        }
        number
    }

    /// Names end up in file names: lower-case letters, digits, hyphens, at most 64.
    pub fn name(&mut self, text: Spanned<String>, what: &str) -> String {
        if !is_name(text.get_ref()) {
            let message = format!("`{}` is no good {what}", text.get_ref());
            let hint = "use lower-case letters, digits and hyphens, at most 64, beginning with a letter";
            self.push(codes::BAD_NAME, &text.span(), message, hint);
            return "unnamed".to_owned();
        }
        text.into_inner()
    }

    pub fn check_grammar(&mut self, root: &DeTable<'_>) {
        self.require(root, "toile", &(0..0), "`toile = 1` as the first line: the version of this grammar");
        let Some(value) = root.get("toile") else { return };
        match whole_number(value.get_ref()) {
            Some(GRAMMAR) => {}
            Some(n) => {
                let message = format!("the file is written for grammar {n}, this program reads {GRAMMAR}");
                self.push(
                    codes::GRAMMAR_VERSION,
                    &value.span(),
                    message,
                    "use the toile version that the file was made for",
                );
            }
            None => self.wrong_type(value, "toile", "the version of the grammar: toile = 1"),
        }
    }
}

/// A TOML integer as `i64`.
pub(super) fn whole_number(value: &DeValue<'_>) -> Option<i64> {
    let DeValue::Integer(number) = value else { return None };
    i64::from_str_radix(number.as_str(), number.radix()).ok()
}

/// Lower-case letters, digits and hyphens (a dot parts vendor and stage), beginning with a letter, at most 64 bytes.
pub(super) fn is_name(text: &str) -> bool {
    text.len() <= 64
        && text.starts_with(|c: char| c.is_ascii_lowercase())
        && text.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-')
}
