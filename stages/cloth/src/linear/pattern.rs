//! Pairs of unknowns that are coupled, without their blocks and with blocks that are multiples of the identity.

use std::ops::Range;
use std::sync::Arc;

/// The pairs of unknowns that are coupled: the rows of each column, the diagonal first, ascending.
///
/// A clone copies nothing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Pattern {
    /// Place of the first row of every column, and the number of all rows.
    pub start: Arc<Vec<u32>>,
    /// Rows of all columns.
    pub rows: Arc<Vec<u32>>,
}

impl Pattern {
    /// The pattern of `n` unknowns whose couplings are `pairs` (row > column, in any order).
    pub fn new(n: usize, mut pairs: Vec<[u32; 2]>) -> Self {
        pairs.sort_unstable();
        pairs.dedup();
        let mut start = Vec::with_capacity(n + 1);
        let mut rows = Vec::with_capacity(pairs.len() + n);
        let mut next = pairs.iter().peekable();
        for column in 0u32.. {
            start.push(u32::try_from(rows.len()).unwrap_or(u32::MAX));
            if column as usize == n {
                break;
            }
            rows.push(column);
            while let Some(p) = next.next_if(|p| p[0] == column) {
                rows.push(p[1]);
            }
        }
        Self { start: start.into(), rows: rows.into() }
    }

    /// Number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.start.len().saturating_sub(1)
    }

    /// Places of the blocks of a column.
    #[inline]
    pub fn places(&self, column: usize) -> Range<usize> {
        self.start[column] as usize..self.start[column + 1] as usize
    }

    /// Place of a block; `None` outside the pattern.
    #[inline]
    pub fn find(&self, column: u32, row: u32) -> Option<usize> {
        let a = self.start[column as usize] as usize;
        let b = self.start[column as usize + 1] as usize;
        self.rows[a..b].binary_search(&row).ok().map(|k| a + k)
    }
}

/// Multiples of the identity on a pattern. A clone copies nothing.
#[derive(Clone, Debug, Default)]
pub(crate) struct IsotropicBlocks {
    pub pattern: Pattern,
    /// Factors of the identity, N/m.
    pub factors: Arc<Vec<f64>>,
}
