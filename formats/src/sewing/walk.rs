//! Walking a TOML table with spans: every mistake is kept with its place, and the walk goes on.

use super::codes;
use super::keys::Keys;
use super::lines::Lines;
use serde_spanned::Spanned;
use std::ops::Range;
use toile_garment::units::{Dimension, Length};
use toile_garment::{Code, Diagnostic, SourceRef, Vec2};
use toml::de::{DeTable, DeValue};

/// A value with its span.
pub type Value<'v> = &'v Spanned<DeValue<'v>>;

/// Collects mistakes.
pub struct Walk<'a> {
    lines: &'a Lines<'a>,
    /// All mistakes so far.
    pub errors: Vec<Diagnostic>,
}

/// A table whose keys are taken one by one; what is left over is unknown.
pub struct Table<'v> {
    table: &'v DeTable<'v>,
    taken: Vec<&'v str>,
    /// Where it stands.
    pub span: Range<usize>,
    /// The keys it may have.
    pub keys: &'static Keys,
}

impl<'v> Table<'v> {
    /// Starts taking keys.
    pub fn new(table: &'v DeTable<'v>, span: Range<usize>, keys: &'static Keys) -> Self {
        Self { table, taken: Vec::new(), span, keys }
    }

    /// The value of a key. A key that is not among those of the table is never read.
    pub fn take(&mut self, key: &str) -> Option<Value<'v>> {
        let (key, value) = self.table.get_key_value(self.keys.find(key)?.name)?;
        self.taken.push(key.get_ref());
        Some(value)
    }

    /// The value of a key that must be there.
    pub fn need(&mut self, key: &str, walk: &mut Walk<'_>) -> Option<Value<'v>> {
        let value = self.take(key);
        if value.is_none() {
            let name = self.keys.name;
            let example = self.keys.find(key).map_or("…", |k| k.example);
            walk.error(codes::SEWING_KEY_MISSING, self.span.start, format!("`{name}` has no `{key}`"), |d| {
                d.hint(format!("add {key} = {example}"))
            });
        }
        value
    }

    /// Reports the keys nobody took.
    pub fn finish(self, walk: &mut Walk<'_>) {
        let what = self.keys.heading;
        for key in self.table.keys().filter(|k| !self.taken.iter().any(|t| *t == k.get_ref().as_ref())) {
            let message = format!("unknown key `{}` in {what}", key.get_ref());
            let hint = nearest(key.get_ref(), self.keys.keys.iter().map(|k| k.name));
            walk.error(codes::SEWING_UNKNOWN_KEY, key.span().start, message, |d| d.hint(hint));
        }
    }
}

/// "did you mean …", or the list of what is known.
pub fn nearest<'k>(word: &str, known: impl Iterator<Item = &'k str> + Clone) -> String {
    let best = known
        .clone()
        .map(|k| (strsim::damerau_levenshtein(&word.to_lowercase(), &k.to_lowercase()), k))
        .min_by_key(|(d, _)| *d);
    match best {
        Some((distance, k)) if distance <= 1 + word.chars().count() / 3 => format!("did you mean `{k}`?"),
        _ => format!("known here: {}", known.collect::<Vec<_>>().join(", ")),
    }
}

impl<'a> Walk<'a> {
    /// Starts with nothing found.
    pub fn new(lines: &'a Lines<'a>) -> Self {
        Self { lines, errors: Vec::new() }
    }

    /// The place of an offset.
    pub fn source(&self, offset: usize, table: Option<&str>) -> SourceRef {
        self.lines.source(offset, table)
    }

    /// Keeps a mistake.
    pub fn error(
        &mut self,
        code: Code,
        offset: usize,
        message: impl Into<String>,
        with: impl FnOnce(Diagnostic) -> Diagnostic,
    ) {
        let finding = Diagnostic::error(code, message).at(self.lines.source(offset, None));
        self.errors.push(with(finding));
    }

    pub fn wrong_type(&mut self, value: Value<'_>, key: &str, expected: &str) {
        let found = value.get_ref().type_str();
        let message = format!("`{key}` must be {expected}, found {found}");
        self.error(codes::SEWING_WRONG_TYPE, value.span().start, message, |d| d);
    }

    /// A text.
    pub fn text(&mut self, value: Value<'_>, key: &str) -> Option<String> {
        match value.get_ref() {
            DeValue::String(s) if !s.trim().is_empty() => Some(s.trim().to_owned()),
            DeValue::String(_) => {
                self.error(codes::SEWING_EMPTY_TEXT, value.span().start, format!("`{key}` is empty"), |d| d);
                None
            }
            _ => {
                self.wrong_type(value, key, "a text in quotes");
                None
            }
        }
    }

    /// A list of texts.
    pub fn texts(&mut self, value: Value<'_>, key: &str) -> Option<Vec<String>> {
        let DeValue::Array(items) = value.get_ref() else {
            self.wrong_type(value, key, "a list of texts");
            return None;
        };
        Some(items.iter().filter_map(|item| self.text(item, key)).collect())
    }

    /// A list of one text or more.
    pub fn names(&mut self, value: Value<'_>, key: &str) -> Option<Vec<String>> {
        if value.get_ref().as_array().is_some_and(|items| items.is_empty()) {
            self.error(codes::SEWING_EMPTY_LIST, value.span().start, format!("`{key}` names no piece"), |d| {
                d.hint("write at least one name, or leave the table out")
            });
            return None;
        }
        self.texts(value, key)
    }

    /// A text or a whole number, as text: names and numbers of edges.
    pub fn label(&mut self, value: Value<'_>, key: &str) -> Option<String> {
        match value.get_ref() {
            DeValue::Integer(_) => self.integer(value, key).map(|n| n.to_string()),
            _ => self.text(value, key),
        }
    }

    /// One of several words.
    pub fn word<T: Copy>(&mut self, value: Value<'_>, key: &str, words: &[(&str, T)]) -> Option<T> {
        let text = self.text(value, key)?;
        let found = words.iter().find(|(w, _)| *w == text).map(|(_, t)| *t);
        if found.is_none() {
            let hint = nearest(&text, words.iter().map(|(w, _)| *w));
            let message = format!("`{key}` cannot be `{text}`");
            self.error(codes::SEWING_UNKNOWN_WORD, value.span().start, message, |d| d.hint(hint));
        }
        found
    }

    /// `true` or `false`.
    pub fn flag(&mut self, value: Value<'_>, key: &str) -> Option<bool> {
        let flag = value.get_ref().as_bool();
        if flag.is_none() {
            self.wrong_type(value, key, "true or false");
        }
        flag
    }

    /// A whole number.
    pub fn integer(&mut self, value: Value<'_>, key: &str) -> Option<i32> {
        let number = value.get_ref().as_integer().and_then(|n| i32::from_str_radix(n.as_str(), n.radix()).ok());
        if number.is_none() {
            self.wrong_type(value, key, "a whole number");
        }
        number
    }

    /// A plain finite number.
    pub fn number(&mut self, value: Value<'_>, key: &str) -> Option<f64> {
        let number = match value.get_ref() {
            DeValue::Integer(n) => i64::from_str_radix(n.as_str(), n.radix()).ok().map(|n| n as f64),
            DeValue::Float(n) => n.as_str().parse().ok(),
            _ => None,
        };
        let finite = number.filter(|n: &f64| n.is_finite());
        if finite.is_none() {
            self.wrong_type(value, key, "a finite number");
        }
        finite
    }

    /// A quantity with its unit, in SI.
    pub fn quantity<D: Dimension>(&mut self, value: Value<'_>, key: &str) -> Option<f64> {
        let at = value.span().start;
        match value.get_ref() {
            DeValue::String(s) => match toile_garment::units::parse::<D>(s) {
                Ok(v) => Some(v),
                Err(e) => {
                    self.error(codes::SEWING_BAD_QUANTITY, at, format!("`{key}`: {}", e.message), |d| d);
                    None
                }
            },
            DeValue::Integer(_) | DeValue::Float(_) => {
                let number = match value.get_ref() {
                    DeValue::Integer(n) => n.as_str().to_owned(),
                    DeValue::Float(n) => n.as_str().to_owned(),
                    _ => String::new(),
                };
                let message = format!("`{key}`: a {} needs a unit", D::NAME);
                let hint = format!("write \"{number} {}\", not a bare {number}", D::UNITS[0].0);
                self.error(codes::SEWING_BARE_NUMBER, at, message, |d| d.hint(hint));
                None
            }
            _ => {
                self.wrong_type(value, key, &format!("a {} in quotes, e.g. \"{}\"", D::NAME, D::EXAMPLE));
                None
            }
        }
    }

    /// The items of a list of fixed length.
    pub fn list<'v>(&mut self, value: Value<'v>, key: &str, n: usize, example: &str) -> Option<Vec<Value<'v>>> {
        match value.get_ref() {
            DeValue::Array(items) if items.len() == n => Some(items.iter().collect()),
            _ => {
                self.wrong_type(value, key, &format!("a list of {n}, e.g. {example}"));
                None
            }
        }
    }

    /// A point: two lengths.
    pub fn point(&mut self, value: Value<'_>, key: &str) -> Option<Vec2> {
        let items = self.list(value, key, 2, "[\"12 mm\", \"340 mm\"]")?;
        let x = self.quantity::<Length>(items[0], key);
        let y = self.quantity::<Length>(items[1], key);
        Some(Vec2::new(x?, y?))
    }

    /// A line: two points or more.
    pub fn points(&mut self, value: Value<'_>, key: &str) -> Option<Vec<Vec2>> {
        let DeValue::Array(items) = value.get_ref() else {
            self.wrong_type(value, key, "a list of points");
            return None;
        };
        if items.len() < 2 {
            let message = format!("`{key}` has fewer than two points");
            self.error(codes::SEWING_EMPTY_LIST, value.span().start, message, |d| d);
            return None;
        }
        items.iter().map(|item| self.point(item, key)).collect()
    }
}
