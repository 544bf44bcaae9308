//! The motion of a body in one step.

use crate::Vec3;
use crate::collision::broad_phase::bvh::BoxTree;

/// Displacements of a body's vertices in a step, and a tree that follows them.
#[derive(Clone)]
pub(crate) struct BodyMotion {
    /// Displacement of each vertex in the current step, m.
    pub step: Vec<Vec3>,
    /// The body moves in the current step.
    pub is_moving: bool,
    /// Tree of the moving triangles.
    pub tree: BoxTree,
}

impl BodyMotion {
    /// A body that does not move yet. `tree` is a tree of its triangles, `vertices` the number of its vertices.
    pub fn at_rest(tree: BoxTree, vertices: usize) -> Self {
        Self { step: vec![Vec3::zeros(); vertices], is_moving: false, tree }
    }
}
