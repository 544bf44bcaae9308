//! Elimination: a finished node is taken out of all its ancestors at once (right-looking supernodal Cholesky).
//!
//! Ng, Peyton: Block sparse Cholesky algorithms on advanced uniprocessor computers, SIAM J. Sci. Comput. 14 (1993).

use super::dense::{factor_panel, products};
use super::supernodes::{Ancestor, Node};
use pulp::{Simd, WithSimd};

/// The elimination of all nodes. Only a named type is compiled as a whole for the widest registers of the machine.
pub struct Eliminate<'a> {
    pub nodes: &'a [Node],
    pub values: &'a mut [f64],
}

impl WithSimd for Eliminate<'_> {
    /// `false` when a pivot is not positive.
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> bool {
        // Registers of a strip, and columns that are summed together.
        match S::F64_LANES {
            8 => self.by::<S, 1, 8>(simd),
            4 => self.by::<S, 2, 4>(simd),
            2 => self.by::<S, 4, 2>(simd),
            _ => self.by::<S, 8, 2>(simd),
        }
    }
}

impl Eliminate<'_> {
    #[inline(always)]
    fn by<S: Simd, const V: usize, const W: usize>(self, simd: S) -> bool {
        let Self { nodes, values } = self;
        let mut sums = Vec::new();
        for node in nodes {
            let (height, width, stride) = (node.height(), node.width(), node.stride());
            let (until, after) = values.split_at_mut(node.start + stride * width);
            let panel = &mut until[node.start..];
            if sums.len() < W * stride {
                sums.resize(W * stride, 0.0);
            }
            if !factor_panel::<S, V, W>(simd, panel, stride, width, &mut sums) {
                return false;
            }
            let mut owners = node.ancestors.iter().peekable();
            for first in (width..height).step_by(W) {
                let begin = products::<S, V, W>(simd, panel, stride, width, first, &mut sums);
                for column in first..height.min(first + W) {
                    let row = (column - width) / 2;
                    while owners.next_if(|o| o.rows[1] <= row).is_some() {}
                    let Some(owner) = owners.peek() else { continue };
                    let sum = &sums[(column - begin) * stride..][width + 2 * row..height];
                    take_out(owner, row, column % 2, sum, after, node.start + stride * width);
                }
            }
        }
        true
    }
}

/// Takes a column of products out of the node that owns it; `sum` begins with the row of the column.
#[inline(always)]
fn take_out(owner: &Ancestor, row: usize, second: usize, sum: &[f64], after: &mut [f64], skipped: usize) {
    let places = &owner.places[row - owner.rows[0]..];
    let (start, stride) = owner.at;
    let column = start + (2 * places[0] as usize + second) * stride - skipped;
    let into = &mut after[column..][..stride];
    for (place, s) in places.iter().zip(sum.as_chunks::<2>().0) {
        let at = 2 * *place as usize;
        into[at] -= s[0];
        into[at + 1] -= s[1];
    }
}
