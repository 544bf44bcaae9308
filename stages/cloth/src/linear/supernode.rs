//! A supernode: neighbouring columns of the factor that have the same rows below them.

/// Scalar rows that stand side by side in a node and in the owner of one of them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Run {
    pub from: u32,
    pub to: u32,
    pub length: u32,
}

/// A node in which some rows of another are columns.
#[derive(Clone, Debug)]
pub(crate) struct Owner {
    pub node: u32,
    /// Where these rows end, scalars counted from the other's first column.
    pub to: usize,
    /// Where they and all rows after them stand.
    pub runs: Vec<Run>,
}

/// Columns that share their rows; counted in vertices, each three scalars.
#[derive(Debug)]
pub(crate) struct Node {
    /// Place of the first column in the order of elimination.
    pub first: u32,
    pub columns: u32,
    /// Rows below the columns, ascending.
    pub rows: Vec<u32>,
    /// The nodes that own `rows`, which take this one's products.
    pub owners: Vec<Owner>,
    /// Where its values start.
    pub start: usize,
}

impl Node {
    /// Scalar rows, columns included.
    pub fn height(&self) -> usize {
        3 * (self.columns as usize + self.rows.len())
    }

    pub fn width(&self) -> usize {
        3 * self.columns as usize
    }

    /// Where a row of the order stands in the columns and rows.
    pub fn place(&self, row: u32) -> u32 {
        if row < self.first + self.columns {
            return row - self.first;
        }
        self.columns + u32::try_from(self.rows.partition_point(|r| *r < row)).unwrap_or(u32::MAX)
    }
}
