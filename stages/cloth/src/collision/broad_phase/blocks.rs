//! Blocks of a tree, and the pairs of triangles in two blocks that are no neighbours in the cloth.
//!
//! A block holds eight triangles. The pairs in blocks that lie side by side are computed once, so that a search does
//! not meet all neighbours again each time.

/// Leaves of the tree in one block: the leaves below one node.
pub(crate) const BLOCK_SLOTS: usize = 8;

/// The pairs of triangles in two blocks that are no neighbours.
#[derive(Debug)]
pub(crate) struct Blocks {
    /// For every block, the blocks from it on that hold neighbours of its triangles. Each has a bit for every pair of
    /// non-neighbours: eight times the slot in the first block plus the slot in the second.
    block_pairs: Vec<Vec<(u32, u64)>>,
}

impl Blocks {
    /// Makes the sets from the slot of every triangle.
    ///
    /// `present` gives the pairs of triangles in two blocks. `neighbours` are pairs of neighbours, any of them in any
    /// order and more than once.
    pub fn new(
        slots: &[u32],
        blocks: usize,
        present: impl Fn(usize, usize) -> u64,
        neighbours: impl Iterator<Item = [u32; 2]>,
    ) -> Self {
        let mut block_pairs: Vec<Vec<(u32, u64)>> = (0..blocks)
            .map(|t| vec![(u32::try_from(t).unwrap_or(u32::MAX), present(t, t) & PAIRS_IN_ONE_BLOCK)])
            .collect();
        for [f, g] in neighbours {
            let (mut p, mut q) = (slots[f as usize] as usize, slots[g as usize] as usize);
            if p > q {
                (p, q) = (q, p);
            }
            let (a, b) = (p / BLOCK_SLOTS, q / BLOCK_SLOTS);
            let bit = 1u64 << (BLOCK_SLOTS * (p % BLOCK_SLOTS) + q % BLOCK_SLOTS);
            let of = u32::try_from(b).unwrap_or(u32::MAX);
            match block_pairs[a].iter_mut().find(|n| n.0 == of) {
                Some(n) => n.1 &= !bit,
                None => block_pairs[a].push((of, present(a, b) & !bit)),
            }
        }
        Self { block_pairs }
    }

    /// The pairs in two blocks that are no neighbours, the first block not after the second. `None` if all pairs are
    /// such.
    #[inline]
    pub fn non_neighbours(&self, a: usize, b: usize) -> Option<u64> {
        self.block_pairs[a].iter().find(|n| n.0 as usize == b).map(|n| n.1)
    }
}

/// Bits of the pairs in one block, each pair once: the first slot before the second.
const PAIRS_IN_ONE_BLOCK: u64 = {
    let (mut mask, mut i) = (0u64, 0);
    while i < BLOCK_SLOTS {
        let mut j = i + 1;
        while j < BLOCK_SLOTS {
            mask |= 1 << (BLOCK_SLOTS * i + j);
            j += 1;
        }
        i += 1;
    }
    mask
};

#[cfg(test)]
mod tests {
    use crate::Vec3;
    use crate::collision::broad_phase::bvh::BoxTree;
    use crate::collision::broad_phase::swept_box::RoundedMotion;

    /// The search among non-neighbours finds the pairs that the full search finds, less the neighbours.
    #[test]
    fn only_neighbours_are_left_out() {
        let n = 41u32;
        let at = |i: u32| Vec3::new(f64::from(i % 7) * 0.01, f64::from(i * i % 11) * 0.01, f64::from(i % 3) * 0.01);
        let x: Vec<Vec3> = (0..n + 2).map(at).collect();
        let faces: Vec<[u32; 3]> = (0..n).map(|i| [i, i + 1, i + 2]).collect();
        let step = vec![Vec3::zeros(); x.len()];
        let neighbours = || (0..n).flat_map(|f| (f + 1..n.min(f + 3)).map(move |g| [g, f]));
        let mut tree = BoxTree::new(&x, &faces);
        tree.refit_moving(&x, &step, &faces, 1e-3);
        let sorted = |f: u32, g: u32| [f.min(g), f.max(g)];
        let (mut all, mut some) = (Vec::new(), Vec::new());
        tree.meeting_pairs(|f, g| all.push(sorted(f, g)));
        let mut rounded = RoundedMotion::default();
        rounded.set(&x, &step);
        let of = rounded.swept(1e-3);
        let swept_box = |f: u32| of(&faces[f as usize]);
        tree.refit_blocks(swept_box);
        let meet = |f: u32, g: u32| swept_box(f).meets(&swept_box(g));
        tree.meeting_non_neighbours(&tree.non_neighbours_beside(neighbours()), meet, |f, g| some.push(sorted(f, g)));
        all.retain(|[f, g]| g - f > 2);
        all.sort_unstable();
        some.sort_unstable();
        assert!(!all.is_empty());
        assert_eq!(all, some);
    }
}
