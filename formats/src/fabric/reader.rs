//! The file's values by table and key, checked one by one for unit and range.

use super::codes;
use super::fields::{self, FIELDS, Field, TABLES, TEXTS, Unit};
use super::{curve, look};
use crate::codes::{UNKNOWN_KEY, VALUE_OUT_OF_RANGE};
use crate::toml_text::{TomlText, describe, did_you_mean};
use serde_spanned::Spanned;
use std::collections::BTreeMap;
use toile_garment::fabric::ValueSource;
use toile_garment::{Diagnostic, SourceRef};
use toml::de::{DeTable, DeValue};

/// A value in SI with its origin.
#[derive(Clone, Debug)]
pub struct Entry {
    pub value: f64,
    pub source: ValueSource,
    pub at: SourceRef,
}

/// A measured curve.
#[derive(Clone, Debug)]
pub struct CurveEntry {
    pub points: Vec<[f64; 2]>,
    pub source: ValueSource,
    pub at: SourceRef,
}

/// Everything a file says.
#[derive(Default)]
pub struct Entries {
    pub name: String,
    pub values: BTreeMap<(&'static str, &'static str), Entry>,
    pub curves: BTreeMap<&'static str, CurveEntry>,
    /// Words of `[look]` with their places.
    pub words: BTreeMap<&'static str, (String, SourceRef)>,
    pub whole: SourceRef,
    pub findings: Vec<Diagnostic>,
}

/// Method and source that hold where a value gives none.
#[derive(Clone, Default)]
pub struct Origin {
    pub method: String,
    pub source: String,
}

/// Reads all values. Syntax errors end it; all other mistakes are collected.
pub fn read(text: &str, file: &str) -> Result<Entries, Vec<Diagnostic>> {
    let toml = TomlText::new(text, file);
    let root = toml.parse(codes::FABRIC_SYNTAX)?;
    let mut out = Entries { whole: toml.whole(), ..Entries::default() };
    let root = root.get_ref();
    let origin = origin_of(&toml, root, &Origin::default(), &mut out.findings);
    for (key, value) in root {
        let word = key.get_ref().as_ref();
        if let Some(table) = TABLES.iter().find(|t| **t == word) {
            read_table(&toml, table, value, &origin, &mut out);
        } else if word == "name" {
            out.name = value.get_ref().as_str().unwrap_or_default().to_owned();
        } else if !TEXTS.contains(&word) {
            read_value(&toml, "", key, value, &origin, &mut out);
        }
    }
    if out.name.trim().is_empty() {
        let finding = Diagnostic::error(codes::FABRIC_NAME_MISSING, "the fabric has no name").at(out.whole.clone());
        out.findings.push(finding.hint("write `name = \"cotton shirting\"` at the top of the file"));
    }
    Ok(out)
}

fn read_table(
    toml: &TomlText<'_>,
    table: &'static str,
    value: &Spanned<DeValue<'_>>,
    origin: &Origin,
    out: &mut Entries,
) {
    let Some(entries) = value.get_ref().as_table() else {
        let message = format!("`{table}` must be a table, not {}", describe(value.get_ref()));
        out.findings.push(Diagnostic::error(codes::FABRIC_VALUE, message).at(toml.place(value)));
        return;
    };
    let origin = origin_of(toml, entries, origin, &mut out.findings);
    for (key, value) in entries {
        let word = key.get_ref().as_ref();
        match (table, word) {
            (_, word) if TEXTS.contains(&word) => {}
            ("curve", word) if curve::WORDS.contains(&word) => curve::read(toml, word, value, &origin, out),
            ("look", word) if look::WORDS.contains(&word) => look::read(toml, word, value, out),
            _ => read_value(toml, table, key, value, &origin, out),
        }
    }
}

/// The texts `method` and `source` of a table; others than texts are findings.
pub fn origin_of(toml: &TomlText<'_>, table: &DeTable<'_>, above: &Origin, findings: &mut Vec<Diagnostic>) -> Origin {
    let mut origin = above.clone();
    for (key, value) in table {
        let word = key.get_ref().as_ref();
        if !TEXTS.contains(&word) {
            continue;
        }
        match (word, value.get_ref().as_str()) {
            ("method", Some(text)) => origin.method = text.to_owned(),
            ("source", Some(text)) => origin.source = text.to_owned(),
            (_, Some(_)) => {}
            (_, None) => {
                let message = format!("`{word}` must be a text, not {}", describe(value.get_ref()));
                findings.push(Diagnostic::error(codes::FABRIC_VALUE, message).at(toml.place(value)));
            }
        }
    }
    origin
}

fn read_value(
    toml: &TomlText<'_>,
    table: &'static str,
    key: &Spanned<std::borrow::Cow<'_, str>>,
    value: &Spanned<DeValue<'_>>,
    origin: &Origin,
    out: &mut Entries,
) {
    let word = key.get_ref().as_ref();
    let Some(field) = fields::find(table, word) else {
        out.findings.push(unknown(toml, table, key));
        return;
    };
    let (plain, origin) = match value.get_ref().as_table() {
        None => (value, origin.clone()),
        Some(inner) => {
            let Some((_, plain)) = inner.iter().find(|(k, _)| k.get_ref() == "value") else {
                let message = format!("`{word}` has no `value`");
                out.findings.push(Diagnostic::error(codes::FABRIC_VALUE, message).at(toml.place(value)));
                return;
            };
            for (k, _) in inner.iter().filter(|(k, _)| !["value", "method", "source"].contains(&k.get_ref().as_ref())) {
                let message = format!("unknown key `{}` of `{word}`", k.get_ref());
                let finding = Diagnostic::error(UNKNOWN_KEY, message).at(toml.place(k));
                out.findings.push(finding.hint("known here: value, method, source"));
            }
            (plain, origin_of(toml, inner, origin, &mut out.findings))
        }
    };
    match number(field, plain.get_ref()) {
        Ok((value, written)) => {
            let source = ValueSource { written, method: origin.method, source: origin.source };
            out.values.insert((table, field.key), Entry { value, source, at: toml.place(plain) });
        }
        Err(finding) => out.findings.push(finding.at(toml.place(plain))),
    }
}

/// A value in SI inside its range, and the text it was written as.
fn number(field: &Field, value: &DeValue<'_>) -> Result<(f64, String), Box<Diagnostic>> {
    let key = field.key;
    let text = match value {
        DeValue::String(text) => text.to_string(),
        DeValue::Integer(i) if field.unit == Unit::Ratio => i.as_str().to_owned(),
        DeValue::Float(f) if field.unit == Unit::Ratio => f.as_str().replace('_', ""),
        DeValue::Integer(_) | DeValue::Float(_) => {
            let bare = describe(value);
            let finding = Diagnostic::error(codes::UNIT_MISSING, format!("`{key} = {bare}` has no unit"));
            return Err(Box::new(
                finding.hint(format!("write `{key} = \"{}\"`", fields::with_unit(field.unit, &bare))),
            ));
        }
        other => {
            let message = format!("`{key}` must be a quantity, not {}", describe(other));
            return Err(Box::new(Diagnostic::error(codes::FABRIC_VALUE, message)));
        }
    };
    let number = fields::value(field.unit, &text)
        .map_err(|e| Box::new(Diagnostic::error(codes::FABRIC_VALUE, format!("`{key}`: {}", e.message))))?;
    if !(field.min..=field.max).contains(&number) {
        let message = format!("`{key} = {text}` is out of range; allowed is {}", field.allowed);
        let finding = Diagnostic::error(VALUE_OUT_OF_RANGE, message);
        return Err(Box::new(finding.hint("check the number and its unit")));
    }
    Ok((number, text))
}

fn unknown(toml: &TomlText<'_>, table: &'static str, key: &Spanned<std::borrow::Cow<'_, str>>) -> Diagnostic {
    let word = key.get_ref().as_ref();
    let place = if table.is_empty() { "at the top of a fabric file".to_owned() } else { format!("in `[{table}]`") };
    let elsewhere: Vec<&str> = FIELDS.iter().filter(|f| f.key == word).flat_map(|f| f.tables.iter().copied()).collect();
    let hint = match elsewhere.as_slice() {
        _ if ["wt", "wt_warp", "wt_weft"].contains(&word) => {
            "WT of KES-FB1 follows from EMT and LT: give emt and lt, and leave it out".to_owned()
        }
        [] => did_you_mean(word, fields::known(table)),
        [""] => format!("`{word}` stands at the top of the file, before the first table"),
        tables => {
            format!("`{word}` stands in {}", tables.iter().map(|t| format!("[{t}]")).collect::<Vec<_>>().join(", "))
        }
    };
    Diagnostic::error(UNKNOWN_KEY, format!("unknown key `{word}` {place}")).at(toml.place(key)).hint(hint)
}
