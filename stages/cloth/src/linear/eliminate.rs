//! Elimination: a finished node is taken out of all nodes that own its rows at once.
//!
//! Ng, Peyton: Block sparse Cholesky algorithms on advanced uniprocessor computers, SIAM J. Sci. Comput. 14 (1993), in
//! its right-looking form.

use crate::linear::dense;
use crate::linear::dense::{Pack, TALL};
use crate::linear::separator_halves::Reach;
use crate::linear::supernode::Node;
use crate::linear::supernode::Run;
use crate::linear::triangular_solve;
use pulp::{Simd, WithSimd};
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

/// Room to work in.
#[derive(Default)]
pub(crate) struct Bench {
    pack: Pack,
    sums: Vec<f32>,
}

/// Eliminates some nodes. What runs under the widest registers of the machine is a named type, because only those are compiled for
/// them as a whole.
pub(crate) struct Eliminate<'a> {
    pub all: &'a [Node],
    pub part: Range<usize>,
    pub values: Reach<'a>,
    pub bench: &'a mut Bench,
    /// Is there a pivot that is not positive, here or in what is done beside it?
    pub failed: &'a AtomicBool,
}

impl WithSimd for Eliminate<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        // As many columns at a time as there are registers for.
        match S::F32_LANES {
            16 => self.by::<S, 1, 8>(simd),
            8 => self.by::<S, 2, 4>(simd),
            4 => self.by::<S, 4, 4>(simd),
            _ => self.by::<S, 16, 4>(simd),
        }
    }
}

impl Eliminate<'_> {
    /// All its nodes in order; each takes its products out of the nodes that own its rows.
    #[inline(always)]
    fn by<S: Simd, const V: usize, const W: usize>(mut self, simd: S) {
        let Bench { pack, sums } = self.bench;
        for node in &self.all[self.part.clone()] {
            if self.failed.load(Ordering::Relaxed) {
                return;
            }
            let (height, width) = (node.height(), node.width());
            let panel = self.values.at(node.start, height * width);
            if !dense::factor_panel::<S, V, W>(simd, panel, height, width, pack) {
                return self.failed.store(true, Ordering::Relaxed);
            }
            // While it is near; its products are made of the pack.
            triangular_solve::lay_out(panel, height, width, sums);
            let tall = height.next_multiple_of(TALL);
            if sums.len() < W * tall {
                sums.resize(W * tall, 0.0);
            }
            let sums = &mut sums[..W * tall];
            let mut next = Next::default();
            for first in (width - width % W..height).step_by(W) {
                dense::products::<S, V, W>(simd, pack, first, tall, sums);
                for column in first.max(width)..(first + W).min(height) {
                    next.spread(node, self.all, column, &sums[(column - first) * tall..][..height], &mut self.values);
                }
            }
        }
    }
}

/// Where the products of the next column go: the owner of its row, and the first run that reaches so far.
#[derive(Default)]
struct Next {
    owner: usize,
    run: usize,
}

impl Next {
    /// Takes one column of products out of the node that owns it; columns come in their order.
    #[inline(always)]
    fn spread(&mut self, node: &Node, all: &[Node], column: usize, sums: &[f32], values: &mut Reach<'_>) {
        while node.owners.get(self.owner).is_some_and(|o| o.to <= column) {
            (self.owner, self.run) = (self.owner + 1, 0);
        }
        let Some(owner) = node.owners.get(self.owner) else { return };
        let ends = |r: &Run| (r.from + r.length) as usize <= column;
        while owner.runs.get(self.run).is_some_and(ends) {
            self.run += 1;
        }
        let Some(first) = owner.runs.get(self.run) else { return };
        let late = column.saturating_sub(first.from as usize);
        let target = &all[owner.node as usize];
        let start = target.start + (first.to as usize + late) * target.height();
        let into = values.at(start, target.height());
        for run in &owner.runs[self.run..] {
            let (from, to, length) = (run.from as usize, run.to as usize, run.length as usize);
            let late = column.saturating_sub(from);
            for (v, s) in into[to + late..to + length].iter_mut().zip(&sums[from + late..][..length - late]) {
                *v -= s;
            }
        }
    }
}
