//! Substitution with a factor: forwards through its nodes, and backwards.

use crate::linear::dense::STRIP_ROWS;
use crate::linear::separator_halves::PartView;
use crate::linear::supernode::Node;
use crate::linear::triangular_solve;
use pulp::{Simd, WithSimd};

/// The direction of a substitution.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Way {
    /// Forward substitution with the lower triangle, children before parents.
    Down,
    /// Backward substitution with its transpose, parents before children.
    Up,
}

/// The substitution in some nodes of a factor.
pub(crate) struct Substitute<'a> {
    pub way: Way,
    pub nodes: &'a [Node],
    pub values: &'a [f32],
    pub right: PartView<'a>,
    /// Work array of one node.
    pub local: &'a mut Vec<f32>,
}

impl WithSimd for Substitute<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        match S::F32_LANES {
            16 => self.by::<S, 1>(simd),
            8 => self.by::<S, 2>(simd),
            4 => self.by::<S, 4>(simd),
            _ => self.by::<S, 16>(simd),
        }
    }
}

impl Substitute<'_> {
    #[inline(always)]
    fn by<S: Simd, const V: usize>(mut self, simd: S) {
        if self.way == Way::Down {
            for node in self.nodes {
                let (l, local) = gather(node, self.values, &self.right, self.local);
                triangular_solve::solve_lower::<S, V>(simd, l, local, node.width());
                scatter(node, &mut self.right, local);
            }
        } else {
            for node in self.nodes.iter().rev() {
                let (l, local) = gather(node, self.values, &self.right, self.local);
                triangular_solve::solve_upper::<S, V>(simd, l, local, node.width());
                self.right.at(3 * node.first as usize, node.width()).copy_from_slice(&local[..node.width()]);
            }
        }
    }
}

/// Rows of a node that belong to its own part of the tree, and those above.
#[inline(always)]
fn parted<'a>(node: &'a Node, right: &PartView<'_>) -> (&'a [u32], &'a [u32]) {
    let from = (right.from / 3) as u32;
    node.rows.split_at(node.rows.partition_point(|r| *r < from))
}

#[inline(always)]
fn gather<'a>(
    node: &Node,
    values: &'a [f32],
    right: &PartView<'_>,
    local: &'a mut Vec<f32>,
) -> (&'a [f32], &'a mut [f32]) {
    let (first, width, length) = (3 * node.first as usize - right.first, node.width(), node.height() + STRIP_ROWS);
    if local.len() < length {
        local.resize(length, 0.0);
    }
    let local = &mut local[..length];
    local[node.height()..].fill(0.0);
    local[..width].copy_from_slice(&right.own[first..first + width]);
    let (near, far) = parted(node, right);
    let (mine, above) = local[width..].as_chunks_mut().0.split_at_mut(near.len());
    let (own, over) = (right.own.as_chunks::<3>().0, right.above.as_chunks::<3>().0);
    let (first, from) = (right.first / 3, right.from / 3);
    near.iter().zip(mine).for_each(|(row, part)| *part = own[*row as usize - first]);
    far.iter().zip(above).for_each(|(row, part)| *part = over[*row as usize - from]);
    (&values[node.start..node.start + node.height() * width + STRIP_ROWS], local)
}

#[inline(always)]
fn scatter(node: &Node, right: &mut PartView<'_>, local: &[f32]) {
    let width = node.width();
    right.at(3 * node.first as usize, width).copy_from_slice(&local[..width]);
    let (near, far) = parted(node, right);
    let (mine, above) = local[width..].as_chunks().0.split_at(near.len());
    let (first, from) = (right.first / 3, right.from / 3);
    let (own, over) = (right.own.as_chunks_mut::<3>().0, right.above.as_chunks_mut::<3>().0);
    near.iter().zip(mine).for_each(|(row, part)| own[*row as usize - first] = *part);
    far.iter().zip(above).for_each(|(row, part)| over[*row as usize - from] = *part);
}
