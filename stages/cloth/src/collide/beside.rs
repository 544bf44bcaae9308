//! Which triangles of a body at rest are beside each triangle of the cloth, kept while that stays in a box a little wider than
//! it was asked for: a walk through the body's tree costs more than all else that is asked of most triangles.

use super::body::Body;
use super::tree::Aabb;

/// Candidates of every triangle of the cloth.
#[derive(Clone, Debug, Default)]
pub(crate) struct Beside {
    kept: Vec<(Aabb, Vec<u32>)>,
}

impl Beside {
    /// Triangles of the body whose boxes may meet `bounds` of triangle `f`, in the order of the body's tree, and maybe others;
    /// those within `margin` more are kept for the next time.
    pub fn candidates(&mut self, f: u32, bounds: &Aabb, margin: f64, body: &Body) -> &[u32] {
        if self.kept.len() <= f as usize {
            self.kept.resize(f as usize + 1, (Aabb::EMPTY, Vec::new()));
        }
        let (held, list) = &mut self.kept[f as usize];
        if !held.holds(bounds) {
            *held = bounds.grown(margin);
            list.clear();
            body.candidates(held, |g| list.push(g));
        }
        list
    }
}
