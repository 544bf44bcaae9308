//! `[input]`: what the caller may set, and the values of one run.

use super::codes;
use super::document::Reader;
use super::nearest::{remedy, remedy_of_many};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use toile_garment::units::Length;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The kind of value that an input may hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InputKind {
    /// Any text.
    Text,
    /// A file; a relative default is relative to the pipeline file, one from the command line to the working folder.
    Path,
    /// A number.
    Number,
    /// A length with its unit.
    Length,
}

const KINDS: [(&str, InputKind); 4] = [
    ("text", InputKind::Text),
    ("path", InputKind::Path),
    ("number", InputKind::Number),
    ("length", InputKind::Length),
];
/// Names that `{…}` gives another meaning.
pub const RESERVED: [&str; 3] = ["out", "line", "version"];

/// One declared input.
#[derive(Clone, Debug)]
pub struct Input {
    /// Kind.
    pub kind: InputKind,
    /// Default as text.
    pub default: Option<String>,
    /// A default is there but wrong, and was reported.
    pub wrong_default: bool,
    /// Where it is declared.
    pub span: Range<usize>,
}

/// The values of one run.
#[derive(Clone, Debug, Default)]
pub struct Values {
    /// Text and kind by name, `line` and `version` among them.
    pub by_name: BTreeMap<String, (InputKind, String)>,
    /// Declared, but without a good value; each was reported once.
    pub missing: BTreeSet<String>,
    /// Folders that stand behind `{name}/…` for paths given on the command line.
    pub mounts: BTreeMap<String, PathBuf>,
}

pub(super) fn read_inputs(cx: &mut Reader<'_>, root: &DeTable<'_>) -> BTreeMap<String, Input> {
    let Some((table, _)) = cx.table(root, "input", &(0..0)) else { return BTreeMap::new() };
    let mut inputs = BTreeMap::new();
    for (key, value) in table {
        let name = key.get_ref().as_ref();
        if RESERVED.contains(&name) || !is_input_name(name) {
            let hint = "use lower-case letters, digits, hyphens and underscores; `out`, `line`, `version` are taken";
            cx.push(codes::BAD_NAME, &key.span(), format!("`{name}` is no good input name"), hint);
        } else if let Some(input) = read_input(cx, name, key.span(), value) {
            inputs.insert(name.to_owned(), input);
        }
    }
    inputs
}

fn is_input_name(name: &str) -> bool {
    name.len() <= 64
        && name.starts_with(|c: char| c.is_ascii_lowercase() || c == '_')
        && name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || "-_".contains(c))
}

fn read_input(cx: &mut Reader<'_>, name: &str, span: Range<usize>, value: &Spanned<DeValue<'_>>) -> Option<Input> {
    match value.get_ref() {
        DeValue::String(kind) => {
            let kind = read_kind(cx, kind, &value.span())?;
            Some(Input { kind, default: None, wrong_default: false, span })
        }
        DeValue::Table(table) => {
            cx.refuse_unknown(table, &["kind", "default", "about"], &format!("the input `{name}`"));
            cx.require(table, "kind", &value.span(), "kind = \"text\", \"path\", \"number\" or \"length\"");
            cx.text(table, "about");
            let word = cx.text(table, "kind")?;
            let kind = read_kind(cx, word.get_ref(), &word.span())?;
            let given = table.get("default");
            let default = given.and_then(|v| read_default(cx, kind, v));
            Some(Input { kind, wrong_default: given.is_some() && default.is_none(), default, span })
        }
        _ => {
            cx.wrong_type(value, name, "a kind (\"path\") or a table { kind = \"text\", default = \"38\" }");
            None
        }
    }
}

fn read_kind(cx: &mut Reader<'_>, word: &str, span: &Range<usize>) -> Option<InputKind> {
    let found = KINDS.iter().find(|(name, _)| *name == word).map(|(_, kind)| *kind);
    if found.is_none() {
        let hint = remedy(word, KINDS.iter().map(|(name, _)| *name));
        cx.push(codes::UNKNOWN_KIND, span, format!("unknown kind `{word}` of an input"), hint);
    }
    found
}

fn read_default(cx: &mut Reader<'_>, kind: InputKind, value: &Spanned<DeValue<'_>>) -> Option<String> {
    let text = match (kind, value.get_ref()) {
        (InputKind::Number, DeValue::Integer(n)) => n.to_string(),
        (InputKind::Number, DeValue::Float(n)) => n.to_string(),
        (InputKind::Text | InputKind::Path | InputKind::Length, DeValue::String(text)) => text.to_string(),
        _ => {
            cx.wrong_type(value, "default", if kind == InputKind::Number { "a number" } else { "a text in quotes" });
            return None;
        }
    };
    match check(kind, &text) {
        Ok(()) => Some(text),
        Err(message) => {
            cx.push(codes::WRONG_TYPE, &value.span(), message, "correct the default");
            None
        }
    }
}

/// Does the text suit the kind?
fn check(kind: InputKind, text: &str) -> Result<(), String> {
    match kind {
        InputKind::Number => {
            let good = DeValue::parse(text).is_ok_and(|v| {
                matches!(v.get_ref(), DeValue::Integer(_) | DeValue::Float(_))
                    && v.get_ref().as_float().is_none_or(|f| f.as_str().parse().is_ok_and(f64::is_finite))
            });
            if good { Ok(()) } else { Err(format!("`{text}` is no number")) }
        }
        InputKind::Length => Length::from_str(text).map(|_| ()).map_err(|e| e.message),
        InputKind::Path if text.contains('\0') => Err("a path cannot hold a NUL".to_owned()),
        InputKind::Text | InputKind::Path => Ok(()),
    }
}

/// The values of this run: defaults, then what the command line sets. `given` holds name, value and its index.
pub(super) fn settle(
    cx: &mut Reader<'_>,
    inputs: &BTreeMap<String, Input>,
    given: &[(String, String, usize)],
    line: &str,
    version: u64,
) -> Values {
    let mut values = Values::default();
    for (name, input) in inputs {
        match given.iter().rev().find(|(n, ..)| n == name) {
            Some((_, text, index)) => set_one(cx, &mut values, name, input.kind, text, *index),
            None => match &input.default {
                Some(text) => {
                    values.by_name.insert(name.clone(), (input.kind, text.clone()));
                }
                None => {
                    values.missing.insert(name.clone());
                    if !input.wrong_default {
                        let message = format!("the input `{name}` has no value");
                        cx.push(codes::MISSING_INPUT, &input.span, message, format!("give one: --set {name}=…"));
                    }
                }
            },
        }
    }
    values.by_name.insert("line".to_owned(), (InputKind::Text, line.to_owned()));
    values.by_name.insert("version".to_owned(), (InputKind::Text, version.to_string()));
    values
}

fn set_one(cx: &mut Reader<'_>, values: &mut Values, name: &str, kind: InputKind, text: &str, index: usize) {
    if let Err(message) = check(kind, text) {
        let span = cx.source.span_of_set(index);
        cx.push(codes::WRONG_TYPE, &span, message, format!("`{name}` is of kind {}", word_of(kind)));
        values.missing.insert(name.to_owned());
        return;
    }
    let mut text = text.to_owned();
    if kind == InputKind::Path {
        // The name stands for the folder, so that no outside path gets into the document.
        let path = Path::new(&text);
        let file = path.file_name().map(|f| f.to_string_lossy().into_owned()).unwrap_or_default();
        let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
        values.mounts.insert(name.to_owned(), if folder.as_os_str().is_empty() { PathBuf::from(".") } else { folder });
        text = format!("{{{name}}}/{file}");
    }
    values.by_name.insert(name.to_owned(), (kind, text));
}

fn word_of(kind: InputKind) -> &'static str {
    KINDS.iter().find(|(_, k)| *k == kind).map_or("text", |(word, _)| word)
}

/// The error of an override that names neither an input nor a stage. `owners` are the parameters of this name, which the
/// line to type names; `known` is all that might be meant.
pub(super) fn refuse_unknown_set(cx: &mut Reader<'_>, index: usize, set: &str, owners: &[String], known: Vec<String>) {
    let (key, value) = set.split_once('=').unwrap_or((set, ""));
    let span = cx.source.span_of_set(index);
    let hint = if owners.is_empty() {
        remedy_of_many(key.trim(), known.iter().map(String::as_str))
    } else {
        let lines: Vec<String> = owners.iter().map(|owner| format!("--set '{owner}={value}'")).collect();
        format!("write {}", lines.join(" or "))
    };
    let message = format!("`{}` is neither an input nor a stage's parameter (stage-id.key)", key.trim());
    cx.push(codes::UNKNOWN_SET, &span, message, hint);
}
