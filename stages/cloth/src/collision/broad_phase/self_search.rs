//! The broad phase of self-contact: a tree of boxes finds the pairs of triangles that may meet along a motion.
//!
//! Neighbours in the cloth are known once for all, and normal cones tell which of them need a test.

use crate::collision::broad_phase::blocks::Blocks;
use crate::collision::broad_phase::bvh::BoxTree;
use crate::collision::broad_phase::swept_box::{RoundedMotion, SweptBox};
use crate::collision::culling::normal_cone::NormalCones;
use crate::collision::narrow_phase::candidates::LinearMotion;
use crate::scene::topology::Topology;
use crate::{Element, Vec3};

/// The broad phase of self-contact.
pub(crate) struct SelfBroadPhase {
    tree: BoxTree,
    blocks: Blocks,
    cones: NormalCones,
    rounded: RoundedMotion,
    /// Swept boxes of the triangles, grown by half the reach.
    swept: Vec<SweptBox>,
}

impl SelfBroadPhase {
    /// Makes the search for cloth that begins at `x`, where its tree is built.
    pub fn new(cloth: &[Element], x: &[Vec3], topology: &Topology) -> Self {
        let (tree, cones) = (BoxTree::moving(x, &topology.faces), NormalCones::new(cloth, x.len(), topology));
        Self {
            blocks: tree.non_neighbours_beside(cones.all_neighbours()),
            cones,
            tree,
            rounded: RoundedMotion::default(),
            swept: Vec::new(),
        }
    }

    /// Emits the pairs of triangles that may come nearer than `reach` along a motion, m.
    pub fn list(&mut self, motion: &LinearMotion<'_>, reach: f64, mut emit: impl FnMut(u32, u32)) {
        self.set_motion(motion, reach);
        let Self { tree, blocks, cones, swept, .. } = self;
        let meet = |f: u32, g: u32| swept[f as usize].meets(&swept[g as usize]);
        cones.unsafe_neighbours(motion.topology, |f, g, joined| {
            if joined || meet(f, g) {
                emit(f, g);
            }
        });
        tree.refit_blocks(|f| swept[f as usize]);
        tree.meeting_non_neighbours(blocks, meet, emit);
    }

    /// Takes a motion: computes swept boxes and normal cones.
    fn set_motion(&mut self, motion: &LinearMotion<'_>, reach: f64) {
        self.rounded.set(motion.x, motion.step);
        self.swept.clear();
        self.swept.extend(motion.topology.faces.iter().map(self.rounded.swept(0.5 * reach)));
        self.cones.set_motion(motion.x, motion.step, motion.topology);
    }
}
