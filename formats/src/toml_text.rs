//! TOML text with places: every value keeps its line and column, and all mistakes are collected.

use crate::codes::FILE_TOO_LARGE;
use serde_spanned::Spanned;
use toile_garment::{Code, Diagnostic, SourceRef};
use toml::de::{DeTable, DeValue};

/// Largest TOML file that is read, bytes.
pub const MAX_BYTES: usize = 1 << 20;

/// A TOML text and its name for messages.
pub struct TomlText<'a> {
    file: &'a str,
    text: &'a str,
    line_starts: Vec<usize>,
}

impl<'a> TomlText<'a> {
    /// Wraps a text.
    pub fn new(text: &'a str, file: &'a str) -> Self {
        let starts = text.bytes().enumerate().filter(|(_, b)| *b == b'\n').map(|(i, _)| i + 1);
        Self { file, text, line_starts: std::iter::once(0).chain(starts).collect() }
    }

    /// The parsed table, or every syntax error.
    pub fn parse(&self, code: Code) -> Result<Spanned<DeTable<'a>>, Vec<Diagnostic>> {
        if self.text.len() > MAX_BYTES {
            let message = format!("the file has {} bytes, over the limit of {MAX_BYTES}", self.text.len());
            return Err(vec![Diagnostic::error(FILE_TOO_LARGE, message).at(SourceRef::file(self.file))]);
        }
        let (table, errors) = DeTable::parse_recoverable(self.text);
        if errors.is_empty() {
            return Ok(table);
        }
        Err(errors
            .iter()
            .take(50)
            .map(|e| {
                let message = e.message().lines().collect::<Vec<_>>().join("; ");
                Diagnostic::error(code, message)
                    .at(e.span().map_or_else(|| SourceRef::file(self.file), |s| self.at(s.start)))
            })
            .collect())
    }

    /// Line and column of a byte.
    pub fn at(&self, byte: usize) -> SourceRef {
        let line = self.line_starts.partition_point(|s| *s <= byte).max(1);
        let start = self.line_starts.get(line - 1).copied().unwrap_or(0);
        let column = self.text.get(start..byte.min(self.text.len())).map_or(1, |t| t.chars().count() + 1);
        SourceRef {
            file: self.file.to_owned(),
            line: Some(line as u64),
            column: Some(column as u64),
            ..SourceRef::default()
        }
    }

    /// Place of a value or key.
    pub fn place<T>(&self, item: &Spanned<T>) -> SourceRef {
        self.at(item.span().start)
    }

    /// Place of the file as a whole.
    pub fn whole(&self) -> SourceRef {
        SourceRef::file(self.file)
    }
}

/// The known name nearest to a mistyped one, as a hint.
pub fn did_you_mean<'n>(word: &str, known: impl Iterator<Item = &'n str>) -> String {
    let known: Vec<&str> = known.collect();
    let near = known.iter().map(|k| (strsim::damerau_levenshtein(word, k), *k)).min();
    match near {
        Some((distance, name)) if distance <= 3.min(word.chars().count()) => format!("did you mean `{name}`?"),
        _ => format!("known here: {}", known.join(", ")),
    }
}

/// A short word for the kind of a value, with the text of numbers.
pub fn describe(value: &DeValue<'_>) -> String {
    match value {
        DeValue::Integer(i) => i.as_str().to_owned(),
        DeValue::Float(f) => f.as_str().to_owned(),
        DeValue::String(s) => format!("\"{s}\""),
        other => format!("a {}", other.type_str()),
    }
}
