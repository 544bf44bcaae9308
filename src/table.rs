//! Tables of texts: for a terminal, and as Markdown.

use std::fmt::Write as _;

/// Heads of columns, and rows with a cell for each. Texts stand at the left of their columns, numbers at the right.
pub struct Table<'t> {
    /// Heads of the columns.
    pub heads: Vec<&'t str>,
    /// Cells.
    pub rows: Vec<Vec<&'t str>>,
    /// Columns that hold texts.
    pub left: &'t [usize],
}

impl Table<'_> {
    /// The table in columns of even width.
    #[must_use]
    pub fn text(&self) -> String {
        let lines = || std::iter::once(&self.heads).chain(&self.rows);
        let width = |i: usize| lines().map(|cells| cells[i].chars().count()).max().unwrap_or(0);
        let widths: Vec<usize> = (0..self.heads.len()).map(width).collect();
        let mut out = String::new();
        for cells in lines() {
            let mut line = String::new();
            for (i, (cell, width)) in cells.iter().zip(&widths).enumerate() {
                // Writing to a String cannot fail.
                let _ = match self.left.contains(&i) {
                    true => write!(line, "{cell:<width$}  "),
                    false => write!(line, "{cell:>width$}  "),
                };
            }
            let _ = writeln!(out, "{}", line.trim_end());
        }
        out
    }

    /// The table as Markdown.
    #[must_use]
    pub fn markdown(&self) -> String {
        let line = |cells: &[&str]| format!("| {} |\n", cells.join(" | "));
        let rule = |i: usize| if self.left.contains(&i) { "---" } else { "---:" };
        let rules: Vec<&str> = (0..self.heads.len()).map(rule).collect();
        let rows: String = self.rows.iter().map(|cells| line(cells)).collect();
        line(&self.heads) + &line(&rules) + &rows
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: fn() -> Table<'static> =
        || Table { heads: vec!["way", "s"], rows: vec![vec!["a", "1.25"], vec!["long one", "3"]], left: &[0] };

    #[test]
    fn columns_are_as_wide_as_their_widest_cell() {
        assert_eq!(TABLE().text(), "way          s\na         1.25\nlong one     3\n");
    }

    #[test]
    fn markdown_sets_numbers_to_the_right() {
        assert_eq!(TABLE().markdown(), "| way | s |\n| --- | ---: |\n| a | 1.25 |\n| long one | 3 |\n");
    }
}
