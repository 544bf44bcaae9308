//! A tree of bounding boxes over triangles, built once by median splits and refitted as the cloth moves.

use crate::Vec3;
use crate::collision::broad_phase::aabb::Aabb;
use crate::collision::broad_phase::blocks::BLOCK_SLOTS;
use crate::collision::broad_phase::swept_box::{RoundedMotion, SweptBox};

/// Marks a leaf without an item.
pub(crate) const NO_ITEM: u32 = u32::MAX;

/// A complete binary tree of boxes. Node 1 is the root, and the children of node `i` are `2i` and `2i + 1`.
#[derive(Clone, Debug)]
pub(crate) struct BoxTree {
    /// Boxes of the nodes; empty in a tree of moving triangles.
    boxes: Vec<Aabb>,
    /// Swept boxes of the nodes; empty where nothing moves.
    pub(super) swept: Vec<SweptBox>,
    /// Item of every leaf; [`NO_ITEM`] for padding.
    pub(super) items: Vec<u32>,
}

impl BoxTree {
    /// A tree over triangles at rest.
    pub fn new(x: &[Vec3], faces: &[[u32; 3]]) -> Self {
        let mut tree = Self::moving(x, faces);
        tree.refit(x, faces, 0.0);
        tree
    }

    /// A tree for moving triangles, without boxes until it is refitted.
    pub fn moving(x: &[Vec3], faces: &[[u32; 3]]) -> Self {
        let centres: Vec<Vec3> = faces.iter().map(|t| t.iter().map(|v| x[*v as usize]).sum()).collect();
        let leaves = faces.len().max(BLOCK_SLOTS).next_power_of_two();
        let mut order: Vec<u32> = (0..faces.len()).map(|i| u32::try_from(i).unwrap_or(u32::MAX)).collect();
        let mut items = vec![NO_ITEM; leaves];
        split(&centres, &mut order, &mut items);
        Self { boxes: Vec::new(), swept: Vec::new(), items }
    }

    /// Sets the boxes for new positions, each face's box grown by `margin`, m.
    pub fn refit(&mut self, x: &[Vec3], faces: &[[u32; 3]], margin: f64) {
        self.boxes.resize(2 * self.items.len(), Aabb::EMPTY);
        let of = |t: &[u32; 3]| Aabb::of_three(&crate::pick3(x, t)).grown(margin);
        fit(&mut self.boxes, &self.items, faces, Aabb::EMPTY, of, Aabb::join);
    }

    /// Sets the swept boxes for a step, for [`Self::meeting_moving`].
    pub fn refit_moving(&mut self, x: &[Vec3], step: &[Vec3], faces: &[[u32; 3]], margin: f64) {
        let mut rounded_motion = RoundedMotion::default();
        rounded_motion.set(x, step);
        self.swept.resize(2 * self.items.len(), SweptBox::NONE);
        fit(&mut self.swept, &self.items, faces, SweptBox::NONE, rounded_motion.swept(margin), SweptBox::join);
    }

    /// Emits the pairs of different items whose boxes meet somewhere along the step.
    #[cfg(test)]
    pub fn meeting_pairs(&self, emit: impl FnMut(u32, u32)) {
        self.pairs(|a, b| self.swept[a].meets(&self.swept[b]), emit);
    }

    /// Emits the pairs of different items whose boxes meet, in a fixed order.
    pub fn meeting_pairs_at_rest(&self, emit: impl FnMut(u32, u32)) {
        self.pairs(|a, b| self.boxes[a].meets(&self.boxes[b]), emit);
    }

    /// Emits the pairs of different items whose leaves `meet`.
    fn pairs(&self, meet: impl Fn(usize, usize) -> bool, mut emit: impl FnMut(u32, u32)) {
        let leaves = self.items.len();
        self.walk(leaves, meet, |a, b| {
            if a != b {
                emit(self.items[a - leaves], self.items[b - leaves]);
            }
        });
    }

    /// Descends through all pairs of nodes that `meet` to the level that begins with node `first`, and emits the
    /// pairs there. Every node of that level is also emitted with itself.
    pub(super) fn walk(&self, first: usize, meet: impl Fn(usize, usize) -> bool, mut emit: impl FnMut(usize, usize)) {
        let mut stack = vec![(1usize, 1usize)];
        while let Some((a, b)) = stack.pop() {
            if a >= first {
                emit(a, b);
            } else if a == b {
                stack.extend([(2 * a, 2 * a), (2 * a + 1, 2 * a + 1)]);
                if meet(2 * a, 2 * a + 1) {
                    stack.push((2 * a, 2 * a + 1));
                }
            } else {
                for (c, d) in [(2 * a, 2 * b), (2 * a, 2 * b + 1), (2 * a + 1, 2 * b), (2 * a + 1, 2 * b + 1)] {
                    if meet(c, d) {
                        stack.push((c, d));
                    }
                }
            }
        }
    }

    /// Emits the items whose boxes meet `bounds` somewhere along the step, in which `bounds` is displaced by any of
    /// `moves`.
    pub fn meeting_moving(&self, bounds: &Aabb, moves: &Aabb, mut emit: impl FnMut(u32)) {
        let leaves = self.items.len();
        let mut stack = vec![1usize];
        let query = SweptBox::new(bounds, moves);
        while let Some(a) = stack.pop() {
            if self.swept[a].meets(&query) {
                if a < leaves {
                    stack.extend([2 * a + 1, 2 * a]);
                } else {
                    emit(self.items[a - leaves]);
                }
            }
        }
    }
}

/// Sets the boxes of the leaves, and of all nodes above them.
fn fit<B: Copy>(
    boxes: &mut [B],
    items: &[u32],
    faces: &[[u32; 3]],
    none: B,
    of: impl Fn(&[u32; 3]) -> B,
    join: impl Fn(&B, &B) -> B,
) {
    let leaves = items.len();
    for (slot, item) in boxes[leaves..].iter_mut().zip(items) {
        *slot = faces.get(*item as usize).map_or(none, &of);
    }
    join_up(boxes, join);
}

/// Joins the lower half of the nodes up to the root.
pub(crate) fn join_up<B>(nodes: &mut [B], join: impl Fn(&B, &B) -> B) {
    for i in (1..nodes.len() / 2).rev() {
        nodes[i] = join(&nodes[2 * i], &nodes[2 * i + 1]);
    }
}

/// Distributes the items of `order` over the leaves of `slots` (a power of two), half of the slots to each side.
fn split(centres: &[Vec3], order: &mut [u32], slots: &mut [u32]) {
    if slots.len() == 1 {
        if let Some(i) = order.first() {
            slots[0] = *i;
        }
        return;
    }
    if order.is_empty() {
        return;
    }
    let bounds = order.iter().fold(Aabb::EMPTY, |b, i| {
        let c = centres[*i as usize];
        Aabb { low: b.low.inf(&c), high: b.high.sup(&c) }
    });
    let axis = (bounds.high - bounds.low).imax();
    let half = order.len().div_ceil(2);
    // Only the side of each item matters. No two items compare as equal.
    if half < order.len() {
        let place = |i: &u32| centres[*i as usize][axis];
        order.select_nth_unstable_by(half, |p, q| place(p).total_cmp(&place(q)).then(p.cmp(q)));
    }
    let (left, right) = order.split_at_mut(half);
    let (ls, rs) = slots.split_at_mut(slots.len() / 2);
    split(centres, left, ls);
    split(centres, right, rs);
}
