//! A supernode: neighbouring columns of the factor that have the same rows below them.

/// Scalar rows that stand side by side in a node and in one of its ancestors.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RowRun {
    /// Place of the first row in the node.
    pub from: u32,
    /// Place of the first row in the ancestor.
    pub to: u32,
    /// Number of rows.
    pub length: u32,
}

/// A node in which some rows of another one are columns: an update target of that node.
#[derive(Clone, Debug)]
pub(crate) struct Ancestor {
    /// Number of the node.
    pub node: u32,
    /// End of these rows, in scalars from the first column of the other node.
    pub to: usize,
    /// Places of these rows and of all rows after them.
    pub runs: Vec<RowRun>,
}

/// Columns that share their rows; counted in vertices, each three scalars.
#[derive(Debug)]
pub(crate) struct Node {
    /// Place of the first column in the order of elimination.
    pub first: u32,
    /// Number of columns.
    pub columns: u32,
    /// Rows below the columns, ascending.
    pub rows: Vec<u32>,
    /// The nodes whose columns are `rows`; they take the products of this one.
    pub ancestors: Vec<Ancestor>,
    /// Place of its first value in the factor.
    pub start: usize,
}

impl Node {
    /// Number of scalar rows, those of the columns included.
    pub fn height(&self) -> usize {
        3 * (self.columns as usize + self.rows.len())
    }

    /// Number of scalar columns.
    pub fn width(&self) -> usize {
        3 * self.columns as usize
    }

    /// Place of a row of the order among the columns and rows of the node.
    pub fn place(&self, row: u32) -> u32 {
        if row < self.first + self.columns {
            return row - self.first;
        }
        self.columns + u32::try_from(self.rows.partition_point(|r| *r < row)).unwrap_or(u32::MAX)
    }
}
