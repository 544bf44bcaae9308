//! The motion of a body in one step.

use crate::Vec3;
use crate::collision::broad_phase::bvh::Tree;

/// Displacements of a body's vertices in the step that is tried, and a tree that follows them.
#[derive(Clone)]
pub(crate) struct Travel {
    pub step: Vec<Vec3>,
    pub going: bool,
    pub tree: Tree,
}

impl Travel {
    /// A body of so many vertices that does not move yet; `tree`: a tree of its moving triangles.
    pub fn at_rest(tree: Tree, vertices: usize) -> Self {
        Self { step: vec![Vec3::zeros(); vertices], going: false, tree }
    }
}
