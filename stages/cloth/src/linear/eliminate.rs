//! Elimination: a finished node is taken out of all its ancestors at once (right-looking supernodal Cholesky).
//!
//! Ng, Peyton: Block sparse Cholesky algorithms on advanced uniprocessor computers, SIAM J. Sci. Comput. 14 (1993), in
//! its right-looking form.

use crate::linear::dense;
use crate::linear::dense::{PackedColumns, STRIP_ROWS};
use crate::linear::separator_halves::PartView;
use crate::linear::supernode::Node;
use crate::linear::supernode::RowRun;
use crate::linear::triangular_solve;
use pulp::{Simd, WithSimd};
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

/// Work arrays of an elimination.
#[derive(Default)]
pub(crate) struct Workspace {
    pack: PackedColumns,
    sums: Vec<f32>,
}

/// The elimination of some nodes.
///
/// It is a named type because only such types are compiled as a whole for the widest registers of the machine.
pub(crate) struct Eliminate<'a> {
    pub all: &'a [Node],
    pub part: Range<usize>,
    pub values: PartView<'a>,
    pub workspace: &'a mut Workspace,
    /// Set where a pivot is not positive, here or on the other thread.
    pub failed: &'a AtomicBool,
}

impl WithSimd for Eliminate<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        // The number of columns at a time is that of the registers.
        match S::F32_LANES {
            16 => self.by::<S, 1, 8>(simd),
            8 => self.by::<S, 2, 4>(simd),
            4 => self.by::<S, 4, 4>(simd),
            _ => self.by::<S, 16, 4>(simd),
        }
    }
}

impl Eliminate<'_> {
    /// Eliminates all nodes in order; each takes its products out of the nodes that own its rows.
    #[inline(always)]
    fn by<S: Simd, const V: usize, const W: usize>(mut self, simd: S) {
        let Workspace { pack, sums } = self.workspace;
        for node in &self.all[self.part.clone()] {
            if self.failed.load(Ordering::Relaxed) {
                return;
            }
            let (height, width) = (node.height(), node.width());
            let panel = self.values.at(node.start, height * width);
            if !dense::factor_panel::<S, V, W>(simd, panel, height, width, pack) {
                return self.failed.store(true, Ordering::Relaxed);
            }
            // The panel is still in the cache here; its products are made of the pack.
            triangular_solve::store_for_solves(panel, height, width, sums);
            let padded = height.next_multiple_of(STRIP_ROWS);
            if sums.len() < W * padded {
                sums.resize(W * padded, 0.0);
            }
            let sums = &mut sums[..W * padded];
            let mut next = Next::default();
            for first in (width - width % W..height).step_by(W) {
                dense::products::<S, V, W>(simd, pack, first, padded, sums);
                for column in first.max(width)..(first + W).min(height) {
                    next.take_out_column(
                        node,
                        self.all,
                        column,
                        &sums[(column - first) * padded..][..height],
                        &mut self.values,
                    );
                }
            }
        }
    }
}

/// The place of the products of the next column: the ancestor of its row, and the first run that reaches this column.
#[derive(Default)]
struct Next {
    ancestor: usize,
    run: usize,
}

impl Next {
    /// Takes one column of products out of the node that owns it; columns come in their order.
    #[inline(always)]
    fn take_out_column(&mut self, node: &Node, all: &[Node], column: usize, sums: &[f32], values: &mut PartView<'_>) {
        while node.ancestors.get(self.ancestor).is_some_and(|o| o.to <= column) {
            (self.ancestor, self.run) = (self.ancestor + 1, 0);
        }
        let Some(ancestor) = node.ancestors.get(self.ancestor) else { return };
        let ends = |r: &RowRun| (r.from + r.length) as usize <= column;
        while ancestor.runs.get(self.run).is_some_and(ends) {
            self.run += 1;
        }
        let Some(first) = ancestor.runs.get(self.run) else { return };
        let skipped = column.saturating_sub(first.from as usize);
        let target = &all[ancestor.node as usize];
        let start = target.start + (first.to as usize + skipped) * target.height();
        let into = values.at(start, target.height());
        for run in &ancestor.runs[self.run..] {
            let (from, to, length) = (run.from as usize, run.to as usize, run.length as usize);
            let skipped = column.saturating_sub(from);
            for (v, s) in into[to + skipped..to + length].iter_mut().zip(&sums[from + skipped..][..length - skipped]) {
                *v -= s;
            }
        }
    }
}
