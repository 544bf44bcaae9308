//! Bounds of the motion of blocks of cloth against each other since a wide search.
//!
//! Pairs that the search found apart stay apart until their two blocks have used up the rest of the distance between
//! them. Cloth that moves as one uses up nothing.

use crate::Vec3;
use crate::collision::broad_phase::bvh::{BoxTree, join_up};
use crate::collision::broad_phase::packed_lists::PackedLists;
use crate::collision::broad_phase::swept_box::{MotionRange, higher, lower, rounded};
use crate::collision::narrow_phase::candidates::LinearMotion;

/// The range of no moves at all.
const NO_MOTION: MotionRange = [[1e30; 4], [-1e30; 4]];

/// Bounds of the moves since the search, up to both ends of a step.
#[derive(Debug, Default)]
pub(crate) struct MotionBounds {
    /// Positions of the cloth at the search.
    at: Vec<Vec3>,
    /// Corners of the triangles of each block.
    corners: PackedLists,
    /// Range of the moves of each vertex.
    vertices: Vec<MotionRange>,
    /// Range of the moves of each node of the tree, down to the blocks.
    pub nodes: Vec<MotionRange>,
}

impl MotionBounds {
    /// Bounds for a tree over the triangles `faces` of cloth with this number of vertices.
    pub fn new(tree: &BoxTree, vertices: usize, faces: &[[u32; 3]]) -> Self {
        let corners = PackedLists::new(tree.blocks(), vertices, |block, add| {
            tree.block(block as usize).flat_map(|f| faces[f as usize]).for_each(add);
        });
        Self { corners, nodes: vec![NO_MOTION; 2 * tree.blocks()], ..Self::default() }
    }

    /// Records that a search was made at `x`.
    pub fn start(&mut self, x: &[Vec3]) {
        self.at.clear();
        self.at.extend_from_slice(x);
    }

    /// Forgets the search.
    pub fn invalidate(&mut self) {
        self.at.clear();
    }

    /// Has there been a search?
    pub fn is_known(&self) -> bool {
        !self.at.is_empty()
    }

    /// Computes the ranges of the moves up to the ends of a step.
    pub fn set_motion(&mut self, motion: &LinearMotion<'_>) {
        self.vertices.clear();
        self.vertices.extend(motion.x.iter().zip(motion.step).zip(&self.at).map(|((p, d), at)| {
            let by = p - at;
            range(&by, &(by + d))
        }));
        let blocks = self.nodes.len() / 2;
        for block in (0..blocks).rev() {
            let corners = self.corners.of(u32::try_from(block).unwrap_or(u32::MAX));
            self.nodes[blocks + block] =
                corners.iter().fold(NO_MOTION, |all, v| join(&all, &self.vertices[*v as usize]));
        }
        join_up(&mut self.nodes, join);
    }
}

/// The range of two moves. Comparisons of ranges allow for the rounding.
#[inline]
fn range(from: &Vec3, to: &Vec3) -> MotionRange {
    let (p, q) = (rounded(from), rounded(to));
    join(&[p, p], &[q, q])
}

#[inline]
fn join(a: &MotionRange, b: &MotionRange) -> MotionRange {
    let mut both = *a;
    for k in 0..4 {
        both[0][k] = lower(a[0][k], b[0][k]);
        both[1][k] = higher(a[1][k], b[1][k]);
    }
    both
}
