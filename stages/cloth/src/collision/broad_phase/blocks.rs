//! Triangles of one cloth that are strangers: no neighbours in it. A tree keeps eight triangles in a tile; which of two tiles
//! that lie side by side are strangers is worked out once, so that a search does not meet all neighbours again each time.

/// Slots of a tile: the leaves below one node.
pub(crate) const TILE: usize = 8;

/// For every tile, the tiles from it on that hold neighbours of its triangles, each with a bit for every pair of strangers
/// (eight times the slot in the first plus that in the second).
#[derive(Debug)]
pub(crate) struct Tiles {
    near: Vec<Vec<(u32, u64)>>,
}

impl Tiles {
    /// `slots`: the slot of every triangle; `tiles`: their number; `present`: the pairs of triangles in two tiles;
    /// `neighbours`: pairs of triangles, any of them in any order and more than once.
    pub fn new(
        slots: &[u32],
        tiles: usize,
        present: impl Fn(usize, usize) -> u64,
        neighbours: impl Iterator<Item = [u32; 2]>,
    ) -> Self {
        let mut near: Vec<Vec<(u32, u64)>> =
            (0..tiles).map(|t| vec![(u32::try_from(t).unwrap_or(u32::MAX), present(t, t) & BELOW)]).collect();
        for [f, g] in neighbours {
            let (mut p, mut q) = (slots[f as usize] as usize, slots[g as usize] as usize);
            if p > q {
                (p, q) = (q, p);
            }
            let (a, b) = (p / TILE, q / TILE);
            let bit = 1u64 << (TILE * (p % TILE) + q % TILE);
            let of = u32::try_from(b).unwrap_or(u32::MAX);
            match near[a].iter_mut().find(|n| n.0 == of) {
                Some(n) => n.1 &= !bit,
                None => near[a].push((of, present(a, b) & !bit)),
            }
        }
        Self { near }
    }

    /// The pairs of strangers in two tiles (the first not after the second); `None` if all are.
    #[inline]
    pub fn strangers(&self, a: usize, b: usize) -> Option<u64> {
        self.near[a].iter().find(|n| n.0 as usize == b).map(|n| n.1)
    }
}

/// Of the pairs in one tile, each once: the first slot before the second.
const BELOW: u64 = {
    let (mut mask, mut i) = (0u64, 0);
    while i < TILE {
        let mut j = i + 1;
        while j < TILE {
            mask |= 1 << (TILE * i + j);
            j += 1;
        }
        i += 1;
    }
    mask
};

#[cfg(test)]
mod tests {
    use crate::Vec3;
    use crate::collision::broad_phase::bvh::{Flat, Tree};

    /// The search among strangers finds what the search among all finds, less the neighbours.
    #[test]
    fn only_neighbours_are_left_out() {
        let n = 41u32;
        let at = |i: u32| Vec3::new(f64::from(i % 7) * 0.01, f64::from(i * i % 11) * 0.01, f64::from(i % 3) * 0.01);
        let x: Vec<Vec3> = (0..n + 2).map(at).collect();
        let faces: Vec<[u32; 3]> = (0..n).map(|i| [i, i + 1, i + 2]).collect();
        let step = vec![Vec3::zeros(); x.len()];
        let neighbours = || (0..n).flat_map(|f| (f + 1..n.min(f + 3)).map(move |g| [g, f]));
        let mut tree = Tree::new(&x, &faces);
        tree.refit_moving(&x, &step, &faces, 1e-3);
        let sorted = |f: u32, g: u32| [f.min(g), f.max(g)];
        let (mut all, mut some) = (Vec::new(), Vec::new());
        tree.meeting_pairs(|f, g| all.push(sorted(f, g)));
        let mut flat = Flat::default();
        flat.take(&x, &step);
        let of = flat.sweeps(1e-3);
        let sweep = |f: u32| of(&faces[f as usize]);
        tree.refit_tiles(sweep);
        let meet = |f: u32, g: u32| sweep(f).meets(&sweep(g));
        tree.meeting_strangers(&tree.strangers_beside(neighbours()), meet, |f, g| some.push(sorted(f, g)));
        all.retain(|[f, g]| g - f > 2);
        let slots = tree.slots();
        let mut turns = Vec::new();
        tree.meeting_strangers(&tree.strangers_beside(neighbours()), meet, |f, g| {
            turns.push(tree.turn([f, g].map(|f| slots[f as usize])));
        });
        assert!(turns.windows(2).all(|t| t[0] < t[1]));
        all.sort_unstable();
        some.sort_unstable();
        assert!(!all.is_empty());
        assert_eq!(all, some);
    }
}
