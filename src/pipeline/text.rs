//! The text of a pipeline file with the overrides of the command line; every offset leads back to a place.

use std::ops::Range;
use toile_garment::{Code, Diagnostic, SourceRef};

/// Largest pipeline file, bytes.
pub const MAX_BYTES: u64 = 1 << 20;

/// A pipeline file's text and the `--set` values, addressed by one range of offsets: offsets beyond the text stand
/// for the overrides, so that a wrong override is reported as such.
#[derive(Clone, Debug)]
pub struct SourceText {
    file: String,
    text: String,
    /// Offset of each line's first byte: a file full of mistakes asks for thousands of places.
    lines: Vec<usize>,
    sets: Vec<String>,
}

impl SourceText {
    /// A text under the name messages give it.
    #[must_use]
    pub fn new(file: impl Into<String>, text: impl Into<String>, sets: Vec<String>) -> Self {
        let text = text.into();
        let lines = std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at + 1)).collect();
        Self { file: file.into(), text, lines, sets }
    }

    /// The text.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The file's name as given.
    #[must_use]
    pub fn file(&self) -> &str {
        &self.file
    }

    /// The `--set` values as given.
    #[must_use]
    pub fn sets(&self) -> &[String] {
        &self.sets
    }

    /// The span that stands for an override.
    #[must_use]
    pub fn span_of_set(&self, index: usize) -> Range<usize> {
        let at = self.text.len() + 1 + index;
        at..at
    }

    /// File, line and column of a span.
    #[must_use]
    pub fn place(&self, span: &Range<usize>) -> SourceRef {
        if let Some(set) = span.start.checked_sub(self.text.len() + 1).and_then(|i| self.sets.get(i)) {
            return SourceRef::file(format!("--set {set}"));
        }
        let at = if self.text.is_char_boundary(span.start) { span.start } else { self.text.len() };
        let line = self.lines.partition_point(|first| *first <= at);
        let first = line.checked_sub(1).and_then(|i| self.lines.get(i)).map_or(0, |first| *first);
        let column = self.text.get(first..at).map_or(0, |before| before.chars().count()) as u64 + 1;
        SourceRef { file: self.file.clone(), line: Some(line as u64), column: Some(column), ..SourceRef::default() }
    }

    /// An error at a span.
    #[must_use]
    pub fn error(&self, code: Code, span: &Range<usize>, message: impl Into<String>) -> Diagnostic {
        Diagnostic::error(code, message).at(self.place(span))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_lines_and_characters_from_one() {
        let text = SourceText::new("p.toml", "a = 1\nµ = é\n", vec!["x=1".into()]);
        let place = text.place(&(11..12));
        assert_eq!((place.line, place.column), (Some(2), Some(5)));
        assert_eq!(text.place(&text.span_of_set(0)).file, "--set x=1");
        assert_eq!(text.place(&(0..0)).line, Some(1));
        let line_and_column = |at: usize| (text.place(&(at..at)).line, text.place(&(at..at)).column);
        assert_eq!(line_and_column(5), (Some(1), Some(6)), "a line's end belongs to it");
        assert_eq!(line_and_column(6), (Some(2), Some(1)));
        assert_eq!(line_and_column(7), (Some(3), Some(1)), "inside a character: the end of the text");
    }
}
