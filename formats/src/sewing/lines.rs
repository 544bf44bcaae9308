//! From byte offsets to lines and columns.

use toile_garment::SourceRef;

/// Line starts of a text.
pub struct Lines<'a> {
    text: &'a str,
    file: &'a str,
    starts: Vec<usize>,
}

impl<'a> Lines<'a> {
    /// Indexes a text.
    pub fn new(text: &'a str, file: &'a str) -> Self {
        let starts = std::iter::once(0).chain(text.match_indices('\n').map(|(i, _)| i + 1)).collect();
        Self { text, file, starts }
    }

    /// The place of a byte offset; `table` is the table it stands in.
    pub fn source(&self, offset: usize, table: Option<&str>) -> SourceRef {
        let offset = offset.min(self.text.len());
        let line = self.starts.partition_point(|s| *s <= offset).max(1);
        let start = self.starts[line - 1];
        let column = self.text.get(start..offset).map_or(1, |t| t.chars().count() + 1);
        SourceRef {
            file: self.file.to_owned(),
            block: table.map(str::to_owned),
            layer: None,
            line: Some(line as u64),
            column: Some(column as u64),
        }
    }
}
