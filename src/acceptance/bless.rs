//! Writes golden values into a file of cases. All else that stands in it stays, comments too.

use super::judge::{Kind, Verdict};
use super::{GoldenCase, TestFile, codes};
use crate::codes::WRITE_FAILED;
use crate::engine::{clean, read_limited, write_whole};
use std::path::{Path, PathBuf};
use toile_garment::Diagnostic;
use toml_edit::{Array, ArrayOfTables, DocumentMut, Item, Table, TableLike, Value};

/// Largest garment that is kept, bytes.
const MAX_GARMENT: u64 = 1 << 30;

/// Golden values that are to be written.
pub struct Blessed {
    /// All changes in words; nothing if the file stays as it is.
    pub changed: Vec<String>,
    text: String,
    garments: Vec<(PathBuf, Vec<u8>)>,
}

/// The file with the values of these runs. `verdicts` are in the order of its cases, `None` for cases that were left
/// out.
///
/// # Errors
/// When a case does not end as its file asks.
pub fn bless(file: &TestFile, verdicts: &[Option<Verdict>], reason: &str) -> Result<Blessed, Vec<Diagnostic>> {
    let refused: Vec<Diagnostic> = pairs(file, verdicts).flat_map(|(_, case, v)| asked(file, case, v)).collect();
    if !refused.is_empty() {
        return Err(refused);
    }
    let broken = |why: String| vec![Diagnostic::error(WRITE_FAILED, why)];
    let mut document: DocumentMut =
        file.source.text().parse().map_err(|e: toml_edit::TomlError| broken(e.to_string()))?;
    let mut blessed = Blessed { changed: Vec::new(), text: String::new(), garments: Vec::new() };
    for (number, case, verdict) in pairs(file, verdicts) {
        let Some(table) = case_table(&mut document, number) else { continue };
        let changed = values(table, case, verdict);
        blessed.changed.extend(changed.into_iter().map(|c| format!("{}: {c}", case.name)));
        if let Some((path, bytes)) = garment(file, case, verdict).map_err(broken)? {
            blessed.changed.push(format!("{}: {}", case.name, clean(&path)));
            blessed.garments.push((file.folder.join(path), bytes));
        }
    }
    if !blessed.changed.is_empty() {
        add_history(&mut document, reason, &blessed.changed);
    }
    Ok(Blessed { text: document.to_string(), ..blessed })
}

fn pairs<'a>(
    file: &'a TestFile,
    verdicts: &'a [Option<Verdict>],
) -> impl Iterator<Item = (usize, &'a GoldenCase, &'a Verdict)> {
    let run = file.cases.iter().zip(verdicts).enumerate();
    run.filter_map(|(number, (case, verdict))| Some((number, case, verdict.as_ref()?)))
}

/// Differences of a case that nobody blesses.
fn asked(file: &TestFile, case: &GoldenCase, verdict: &Verdict) -> Vec<Diagnostic> {
    let asked = verdict.differences.iter().filter(|d| d.kind == Kind::Asked);
    let refuse = |d: &super::Difference| {
        let finding = file.source.error(codes::TEST_NOT_BLESSED, &d.span, format!("`{}`: {}", case.name, d.why));
        finding.hint("correct the pipeline, or what the file asks for, and bless again")
    };
    asked.map(refuse).collect()
}

fn case_table(document: &mut DocumentMut, number: usize) -> Option<&mut dyn TableLike> {
    match document.get_mut("case")? {
        Item::ArrayOfTables(tables) => tables.get_mut(number).map(|t| t as &mut dyn TableLike),
        Item::Value(Value::Array(items)) => {
            items.get_mut(number)?.as_inline_table_mut().map(|t| t as &mut dyn TableLike)
        }
        _ => None,
    }
}

/// The table behind keys.
fn inner<'t>(table: &'t mut dyn TableLike, keys: &[String]) -> Option<&'t mut dyn TableLike> {
    match keys.split_first() {
        None => Some(table),
        Some((key, rest)) => inner(table.get_mut(key)?.as_table_like_mut()?, rest),
    }
}

/// Puts the values of a run into its case; what changed, in words.
fn values(table: &mut dyn TableLike, case: &GoldenCase, verdict: &Verdict) -> Vec<String> {
    let mut changed = Vec::new();
    for figure in case.figures.iter().filter(|f| f.within.is_some()) {
        let name = &figure.bounds.figure;
        let Some(value) = verdict.figures.get(name).map(|v| figure.rounded(*v)) else { continue };
        let keys = [&["figures".to_owned()], figure.keys.as_slice()].concat();
        if figure.value.is_some_and(|v| figure.shown(v) == figure.shown(value)) {
            continue;
        }
        let Some(inside) = inner(table, &keys) else { continue };
        let before = figure.value.map_or_else(|| "none".to_owned(), |v| figure.shown(v));
        changed.push(format!("{name} {before} → {}", figure.shown(value)));
        put(inside, "value", if figure.is_length { figure.shown(value).into() } else { number(value) });
    }
    for hash in &case.hashes {
        let Some(found) = verdict.outputs.get(&hash.path).filter(|f| hash.blake3.as_ref() != Some(*f)) else {
            continue;
        };
        let Some(inside) = inner(table, &["hashes".to_owned()]) else { continue };
        let before = hash.blake3.as_ref().map_or("none", |h| &h[..12]);
        changed.push(format!("{} {before} → {}", hash.path, &found[..12]));
        put(inside, &hash.path, found.as_str().into());
    }
    changed
}

/// A number as a person would write it: counts without a point.
#[expect(clippy::cast_possible_truncation, reason = "whole and below 2^53")]
fn number(value: f64) -> Value {
    let is_whole = value.trunc() == value && value.abs() < 9e15;
    if is_whole { Value::from(value as i64) } else { Value::from(value) }
}

/// Sets a value; blanks and comments around an old one stay.
fn put(table: &mut dyn TableLike, key: &str, mut value: Value) {
    match table.get_mut(key).and_then(Item::as_value_mut) {
        Some(old) => {
            *value.decor_mut() = old.decor().clone();
            *old = value;
        }
        None => {
            // The blank before a closing brace belongs to the value that was the last.
            if let Some(last) = table.iter_mut().last().and_then(|(_, item)| item.as_value_mut()) {
                let is_blank = last.decor().suffix().and_then(|s| s.as_str()).is_some_and(|s| s.trim().is_empty());
                if is_blank {
                    last.decor_mut().set_suffix("");
                }
            }
            table.insert(key, Item::Value(value));
        }
    }
}

/// The garment of a case, if it is another one than the golden one.
fn garment(file: &TestFile, case: &GoldenCase, verdict: &Verdict) -> Result<Option<(PathBuf, Vec<u8>)>, String> {
    let (Some(like), Some(garment)) = (&case.like, &verdict.garment) else { return Ok(None) };
    let bytes = read_limited(garment, garment, MAX_GARMENT).map_err(|e| e.to_string())?;
    let golden = file.folder.join(&like.path);
    let is_same = read_limited(&golden, &golden, MAX_GARMENT).is_ok_and(|old| old == bytes);
    Ok((!is_same).then(|| (like.path.clone(), bytes)))
}

/// Adds an entry to the history: why, by which version of the program, and what changed. No clock.
fn add_history(document: &mut DocumentMut, reason: &str, changed: &[String]) {
    let mut list = Array::new();
    for words in changed {
        list.push_formatted(Value::from(words.as_str()).decorated("\n    ", ""));
    }
    list.set_trailing("\n");
    list.set_trailing_comma(true);
    let mut entry = Table::new();
    entry.insert("reason", reason.into());
    entry.insert("toile", env!("CARGO_PKG_VERSION").into());
    entry.insert("changed", list.into());
    match document.get_mut("history") {
        Some(Item::ArrayOfTables(entries)) => entries.push(entry),
        Some(Item::Value(Value::Array(entries))) => entries.push(entry.into_inline_table()),
        _ => {
            let mut entries = ArrayOfTables::new();
            entries.push(entry);
            document.insert("history", Item::ArrayOfTables(entries));
        }
    }
}

impl Blessed {
    /// Writes garments, and the file last: a file that names a value is never without its garment.
    ///
    /// # Errors
    /// When the disk refuses.
    pub fn write(&self, path: &Path) -> Result<(), Diagnostic> {
        let failed = |path: &Path, error: &std::io::Error| {
            Diagnostic::error(WRITE_FAILED, format!("cannot write `{}`: {error}", clean(path)))
        };
        for (garment, bytes) in &self.garments {
            let folder = garment.parent().unwrap_or(Path::new(""));
            std::fs::create_dir_all(folder).map_err(|e| failed(folder, &e))?;
            write_whole(garment, bytes).map_err(|e| failed(garment, &e))?;
        }
        write_whole(path, self.text.as_bytes()).map_err(|e| failed(path, &e))
    }
}
