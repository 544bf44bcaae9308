//! Search of a tree for pairs of triangles that are no neighbours, block by block.

use crate::collision::broad_phase::blocks::{BLOCK_SLOTS, Blocks};
use crate::collision::broad_phase::bvh::{BoxTree, NO_ITEM, join_up};
use crate::collision::broad_phase::swept_box::SweptBox;

impl BoxTree {
    /// Sets the swept boxes down to the blocks, for [`Self::meeting_non_neighbours`]. That needs half of the memory.
    pub fn refit_blocks(&mut self, of: impl Fn(u32) -> SweptBox) {
        let blocks = self.blocks();
        self.swept.resize(2 * blocks, SweptBox::NONE);
        for block in 0..blocks {
            self.swept[blocks + block] = self.block(block).fold(SweptBox::NONE, |all, item| all.join(&of(item)));
        }
        join_up(&mut self.swept, SweptBox::join);
    }

    /// The pairs of non-neighbours among the items. `neighbours` are pairs of neighbours, any of them in any order
    /// and more than once.
    pub fn non_neighbours_beside(&self, neighbours: impl Iterator<Item = [u32; 2]>) -> Blocks {
        Blocks::new(&self.slots(), self.blocks(), |a, b| self.present(a, b), neighbours)
    }

    /// Number of blocks.
    pub fn blocks(&self) -> usize {
        self.items.len() / BLOCK_SLOTS
    }

    /// The slot of every item.
    pub fn slots(&self) -> Vec<u32> {
        let mut slots = vec![NO_ITEM; self.items.len()];
        for (slot, item) in (0u32..).zip(&self.items).filter(|(_, i)| **i != NO_ITEM) {
            slots[*item as usize] = slot;
        }
        slots
    }

    /// The pairs of items in two blocks: one bit each, at eight times the slot in the first block plus the slot in
    /// the second.
    pub fn present(&self, a: usize, b: usize) -> u64 {
        let slots = |t: usize| (0..BLOCK_SLOTS).filter(move |k| self.items[BLOCK_SLOTS * t + k] != NO_ITEM);
        let row: u64 = slots(b).map(|k| 1 << k).sum();
        slots(a).map(|k| row << (BLOCK_SLOTS * k)).sum()
    }

    /// Emits the pairs of non-neighbours that `meet`, in a fixed order, from blocks whose boxes meet somewhere along
    /// the step.
    ///
    /// Parts that move as one do not meet: only the difference of their displacements counts.
    pub fn meeting_non_neighbours(
        &self,
        blocks: &Blocks,
        meet: impl Fn(u32, u32) -> bool,
        mut emit: impl FnMut(u32, u32),
    ) {
        let first = self.blocks();
        let there = |item: u32| item != NO_ITEM;
        let close = |a: usize, b: usize| self.swept[a].meets(&self.swept[b]);
        self.walk(first, close, |a, b| {
            let (a, b) = (a.min(b) - first, a.max(b) - first);
            let mut left = blocks.non_neighbours(a, b).unwrap_or(u64::MAX);
            while left != 0 {
                let n = left.trailing_zeros() as usize;
                left &= left - 1;
                let (f, g) =
                    (self.items[BLOCK_SLOTS * a + n / BLOCK_SLOTS], self.items[BLOCK_SLOTS * b + n % BLOCK_SLOTS]);
                if there(f) && there(g) && meet(f, g) {
                    emit(f, g);
                }
            }
        });
    }

    /// The items of a block.
    pub fn block(&self, block: usize) -> impl Iterator<Item = u32> + '_ {
        self.items[BLOCK_SLOTS * block..BLOCK_SLOTS * (block + 1)].iter().copied().filter(|i| *i != NO_ITEM)
    }
}
