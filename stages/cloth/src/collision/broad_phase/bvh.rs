//! A tree of bounding boxes over triangles (paper §2.3: hierarchy of bounding volumes), built once by median splits
//! and refitted as the cloth moves.

use crate::Vec3;
use crate::collision::broad_phase::blocks::{TILE, Tiles};

/// The least and the most that anything moved, m.
pub(crate) type Range = [[f32; 4]; 2];

/// An axis-aligned box.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Aabb {
    pub low: Vec3,
    pub high: Vec3,
}

impl Aabb {
    pub const EMPTY: Self = Self {
        low: Vec3::new(f64::INFINITY, f64::INFINITY, f64::INFINITY),
        high: Vec3::new(f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    pub fn of(points: &[Vec3]) -> Self {
        points.iter().fold(Self::EMPTY, |b, p| Self { low: least(&b.low, p), high: most(&b.high, p) })
    }

    /// A place.
    #[inline]
    pub fn of_one(p: &Vec3) -> Self {
        Self { low: *p, high: *p }
    }

    #[inline]
    pub fn of_two(a: &Vec3, b: &Vec3) -> Self {
        Self { low: least(a, b), high: most(a, b) }
    }

    #[inline]
    pub fn of_three(t: &[Vec3; 3]) -> Self {
        Self { low: least(&least(&t[0], &t[1]), &t[2]), high: most(&most(&t[0], &t[1]), &t[2]) }
    }

    #[inline]
    pub fn join(&self, o: &Self) -> Self {
        Self { low: least(&self.low, &o.low), high: most(&self.high, &o.high) }
    }

    #[inline]
    pub fn grown(&self, by: f64) -> Self {
        let d = Vec3::repeat(by);
        Self { low: self.low - d, high: self.high + d }
    }

    #[inline]
    pub fn meets(&self, o: &Self) -> bool {
        self.low.x <= o.high.x
            && o.low.x <= self.high.x
            && self.low.y <= o.high.y
            && o.low.y <= self.high.y
            && self.low.z <= o.high.z
            && o.low.z <= self.high.z
    }

    /// How far another box is away; 0 where they meet.
    pub fn gap(&self, o: &Self) -> f64 {
        (o.low - self.high).sup(&(self.low - o.high)).sup(&Vec3::zeros()).norm()
    }
}

// Without the care for what is no number, which takes three instructions each.
#[inline]
pub(crate) fn least(a: &Vec3, b: &Vec3) -> Vec3 {
    let lower = |a: f64, b: f64| if a < b { a } else { b };
    Vec3::new(lower(a.x, b.x), lower(a.y, b.y), lower(a.z, b.z))
}

#[inline]
pub(crate) fn most(a: &Vec3, b: &Vec3) -> Vec3 {
    let higher = |a: f64, b: f64| if a > b { a } else { b };
    Vec3::new(higher(a.x, b.x), higher(a.y, b.y), higher(a.z, b.z))
}

/// May points of two boxes meet while they are displaced by any part (the same for all) of displacements from two boxes?
#[inline]
pub(crate) fn meet_moving(a: &Aabb, da: &Aabb, b: &Aabb, db: &Aabb) -> bool {
    (0..3).all(|k| {
        let low = a.low[k] - b.high[k] + (da.low[k] - db.high[k]).min(0.0);
        let high = a.high[k] - b.low[k] + (da.high[k] - db.low[k]).max(0.0);
        low <= 0.0 && high >= 0.0
    })
}

/// A box and its displacements, coordinates in single precision rounded outwards, so that four stand in a register.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sweep {
    low: [f32; 4],
    high: [f32; 4],
    least: [f32; 4],
    most: [f32; 4],
}

/// What the differences of two sweeps may be wrong by, over their largest coordinate.
const ROUNDING: f64 = 1e-6;

/// Places and moves of all vertices in single precision, rounded once for all triangles that have them as corners.
#[derive(Clone, Debug, Default)]
pub(crate) struct Flat {
    at: Vec<[f32; 4]>,
    by: Vec<[f32; 4]>,
    /// The largest coordinate.
    pub size: f64,
}

impl Flat {
    /// Takes other places, and a step from them.
    pub fn take(&mut self, x: &[Vec3], step: &[Vec3]) {
        let mut size = [0.0; 3];
        for p in x.iter().chain(step) {
            (0..3).for_each(|k| size[k] = if p[k].abs() > size[k] { p[k].abs() } else { size[k] });
        }
        self.size = size.into_iter().fold(0.0, f64::max);
        for (flat, all) in [(&mut self.at, x), (&mut self.by, step)] {
            flat.clear();
            flat.extend(all.iter().map(narrow));
        }
    }

    /// Sweeps of triangles on their way, grown by as much, and by what rounding can do.
    pub fn sweeps(&self, margin: f64) -> impl Fn(&[u32; 3]) -> Sweep + '_ {
        let rounding = ROUNDING * (self.size + margin);
        let [margin, rounding, ..] = narrow(&Vec3::new(margin + rounding, rounding, 0.0));
        move |[a, b, c]| {
            let (a, b, c) = (*a as usize, *b as usize, *c as usize);
            let [low, high] = bounds(&self.at[a], &self.at[b], &self.at[c], margin);
            let [least, most] = bounds(&self.by[a], &self.by[b], &self.by[c], rounding);
            Sweep { low, high, least, most }
        }
    }
}

// Boxes are grown by more than this rounds.
#[allow(clippy::cast_possible_truncation)]
#[inline]
pub(crate) fn narrow(p: &Vec3) -> [f32; 4] {
    [p.x as f32, p.y as f32, p.z as f32, 0.0]
}

#[inline]
fn bounds(a: &[f32; 4], b: &[f32; 4], c: &[f32; 4], grown: f32) -> [[f32; 4]; 2] {
    let mut both = [[0.0; 4]; 2];
    for k in 0..4 {
        both[0][k] = lower(lower(a[k], b[k]), c[k]) - grown;
        both[1][k] = higher(higher(a[k], b[k]), c[k]) + grown;
    }
    both
}

impl Sweep {
    const NONE: Self = Self { low: [1e30; 4], high: [-1e30; 4], least: [1e30; 4], most: [-1e30; 4] };

    fn new(place: &Aabb, moves: &Aabb) -> Self {
        let size = [place.low, place.high, moves.low, moves.high].iter().map(|p| p.amax()).fold(0.0, f64::max);
        let (place, moves) = (place.grown(ROUNDING * size), moves.grown(ROUNDING * size));
        let [low, high, least, most] = [place.low, place.high, moves.low, moves.high].map(|p| narrow(&p));
        Self { low, high, least, most }
    }

    /// By as much on all sides.
    #[inline]
    pub fn grown(&self, by: f32) -> Self {
        let mut grown = *self;
        for k in 0..4 {
            grown.low[k] -= by;
            grown.high[k] += by;
        }
        grown
    }

    #[inline]
    fn join(&self, o: &Self) -> Self {
        let mut both = *self;
        for k in 0..4 {
            both.low[k] = lower(both.low[k], o.low[k]);
            both.high[k] = higher(both.high[k], o.high[k]);
            both.least[k] = lower(both.least[k], o.least[k]);
            both.most[k] = higher(both.most[k], o.most[k]);
        }
        both
    }

    /// As [`meet_moving`]; never says no where that says yes.
    #[inline]
    pub fn meets(&self, o: &Self) -> bool {
        self.meets_moved(&[self.least, self.most], o, &[o.least, o.most])
    }

    /// The same with other moves.
    #[inline]
    fn meets_moved(&self, [least, most]: &Range, o: &Self, [low, high]: &Range) -> bool {
        let mut apart = false;
        for k in 0..4 {
            let (come, go) = (least[k] - high[k], most[k] - low[k]);
            apart |= self.low[k] - o.high[k] + lower(come, 0.0) > 0.0;
            apart |= self.high[k] - o.low[k] + higher(go, 0.0) < 0.0;
        }
        !apart
    }
}

#[inline]
pub(crate) fn lower(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

#[inline]
pub(crate) fn higher(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// A complete binary tree; node 1 is the root, the children of `i` are `2i` and `2i + 1`.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    /// Empty where all moves.
    boxes: Vec<Aabb>,
    /// The boxes and how they move in a step; empty where nothing moves.
    sweeps: Vec<Sweep>,
    /// Item of every leaf; `u32::MAX` for padding.
    items: Vec<u32>,
}

impl Tree {
    pub fn new(x: &[Vec3], faces: &[[u32; 3]]) -> Self {
        let mut tree = Self::moving(x, faces);
        tree.refit(x, faces, 0.0);
        tree
    }

    /// One that only follows what moves.
    pub fn moving(x: &[Vec3], faces: &[[u32; 3]]) -> Self {
        let centres: Vec<Vec3> = faces.iter().map(|t| t.iter().map(|v| x[*v as usize]).sum()).collect();
        let leaves = faces.len().max(TILE).next_power_of_two();
        let mut order: Vec<u32> = (0..faces.len()).map(|i| u32::try_from(i).unwrap_or(u32::MAX)).collect();
        let mut items = vec![u32::MAX; leaves];
        split(&centres, &mut order, &mut items);
        Self { boxes: Vec::new(), sweeps: Vec::new(), items }
    }

    /// New boxes for moved vertices, each face's box grown by `margin`.
    pub fn refit(&mut self, x: &[Vec3], faces: &[[u32; 3]], margin: f64) {
        self.boxes.resize(2 * self.items.len(), Aabb::EMPTY);
        let of = |t: &[u32; 3]| Aabb::of_three(&crate::pick3(x, t)).grown(margin);
        fit(&mut self.boxes, &self.items, faces, Aabb::EMPTY, of, Aabb::join);
    }

    /// Also takes the displacements of a step, for [`Self::meeting_moving`].
    pub fn refit_moving(&mut self, x: &[Vec3], step: &[Vec3], faces: &[[u32; 3]], margin: f64) {
        let mut flat = Flat::default();
        flat.take(x, step);
        self.sweeps.resize(2 * self.items.len(), Sweep::NONE);
        fit(&mut self.sweeps, &self.items, faces, Sweep::NONE, flat.sweeps(margin), Sweep::join);
    }

    /// Takes the sweeps of items, for [`Self::meeting_strangers`]: keeps them down to the tiles, which is half of the memory.
    pub fn refit_tiles(&mut self, of: impl Fn(u32) -> Sweep) {
        let tiles = self.tiles();
        self.sweeps.resize(2 * tiles, Sweep::NONE);
        for tile in 0..tiles {
            self.sweeps[tiles + tile] = self.tile(tile).fold(Sweep::NONE, |all, item| all.join(&of(item)));
        }
        join_up(&mut self.sweeps, Sweep::join);
    }

    /// Pairs of different items whose boxes meet somewhere along the step.
    #[cfg(test)]
    pub fn meeting_pairs(&self, emit: impl FnMut(u32, u32)) {
        self.pairs(|a, b| self.sweeps[a].meets(&self.sweeps[b]), emit);
    }

    /// The pairs of strangers among its items. `neighbours`: pairs of items that are none, any of them in any order and more
    /// than once.
    pub fn strangers_beside(&self, neighbours: impl Iterator<Item = [u32; 2]>) -> Tiles {
        Tiles::new(&self.slots(), self.tiles(), |a, b| self.present(a, b), neighbours)
    }

    /// Number of tiles.
    pub fn tiles(&self) -> usize {
        self.items.len() / TILE
    }

    /// The slot of every item.
    pub fn slots(&self) -> Vec<u32> {
        let mut slots = vec![u32::MAX; self.items.len()];
        for (slot, item) in (0u32..).zip(&self.items).filter(|(_, i)| **i != u32::MAX) {
            slots[*item as usize] = slot;
        }
        slots
    }

    /// The pairs of items in two tiles: a bit for each, eight times the slot in the first plus that in the second.
    pub fn present(&self, a: usize, b: usize) -> u64 {
        let slots = |t: usize| (0..TILE).filter(move |k| self.items[TILE * t + k] != u32::MAX);
        let row: u64 = slots(b).map(|k| 1 << k).sum();
        slots(a).map(|k| row << (TILE * k)).sum()
    }

    /// Pairs of strangers that `meet` in tiles whose sweeps meet somewhere along the step, in a fixed order. What moves along
    /// together does not meet: only the difference of the displacements counts.
    pub fn meeting_strangers(&self, tiles: &Tiles, meet: impl Fn(u32, u32) -> bool, mut emit: impl FnMut(u32, u32)) {
        let first = self.tiles();
        let there = |item: u32| item != u32::MAX;
        let close = |a: usize, b: usize| self.sweeps[a].meets(&self.sweeps[b]);
        self.walk(first, close, |a, b| {
            let (a, b) = (a.min(b) - first, a.max(b) - first);
            let mut left = tiles.strangers(a, b).unwrap_or(u64::MAX);
            while left != 0 {
                let n = left.trailing_zeros() as usize;
                left &= left - 1;
                let (f, g) = (self.items[TILE * a + n / TILE], self.items[TILE * b + n % TILE]);
                if there(f) && there(g) && meet(f, g) {
                    emit(f, g);
                }
            }
        });
    }

    /// Pairs of tiles in which strangers may meet that the last search found apart: those that may have come near since, and
    /// moved against each other by more than `spare`. `moves`: since then, of all nodes down to the tiles.
    pub fn drifted(&self, moves: &[Range], spare: f32, mut emit: impl FnMut(usize, usize)) {
        let first = self.tiles();
        let loose = |a: usize, b: usize| {
            let (p, q, mut far) = (&moves[a], &moves[b], false);
            for k in 0..4 {
                far |= higher(p[1][k] - q[0][k], q[1][k] - p[0][k]) > spare;
            }
            far
        };
        let meet = |a: usize, b: usize| self.sweeps[a].meets_moved(&moves[a], &self.sweeps[b], &moves[b]);
        self.walk(
            first,
            |a, b| loose(a, b) && meet(a, b),
            |a, b| {
                if loose(a, b) {
                    emit(a.min(b) - first, a.max(b) - first);
                }
            },
        );
    }

    /// Strangers in two tiles, in the order in which a search tells of them.
    pub fn strangers(&self, tiles: &Tiles, a: usize, b: usize, mut emit: impl FnMut(u32, u32)) {
        let mut left = tiles.strangers(a, b).unwrap_or_else(|| self.present(a, b));
        while left != 0 {
            let n = left.trailing_zeros() as usize;
            left &= left - 1;
            emit(self.items[TILE * a + n / TILE], self.items[TILE * b + n % TILE]);
        }
    }

    /// When a search comes to a pair of items in these slots, as a number that grows.
    pub fn turn(&self, [p, q]: [u32; 2]) -> u64 {
        let (p, q) = (u64::from(p.min(q)), u64::from(p.max(q)));
        let tile = TILE as u64;
        let (a, b) = (p / tile, q / tile);
        let turn = (0..self.tiles().trailing_zeros()).rev().fold(0, |turn, level| {
            let (i, j) = (a >> level & 1, b >> level & 1);
            let together = a >> (level + 1) == b >> (level + 1);
            turn << 2
                | if !together {
                    3 - (2 * i + j)
                } else if i != j {
                    0
                } else {
                    2 - i
                }
        });
        turn * tile * tile + p % tile * tile + q % tile
    }

    /// Items of a tile.
    pub fn tile(&self, tile: usize) -> impl Iterator<Item = u32> + '_ {
        self.items[TILE * tile..TILE * (tile + 1)].iter().copied().filter(|i| *i != u32::MAX)
    }

    /// Pairs of different items whose boxes meet, in a fixed order.
    pub fn own_pairs(&self, emit: impl FnMut(u32, u32)) {
        self.pairs(|a, b| self.boxes[a].meets(&self.boxes[b]), emit);
    }

    /// Pairs of different items whose leaves `meet`.
    fn pairs(&self, meet: impl Fn(usize, usize) -> bool, mut emit: impl FnMut(u32, u32)) {
        let leaves = self.items.len();
        self.walk(leaves, meet, |a, b| {
            if a != b {
                emit(self.items[a - leaves], self.items[b - leaves]);
            }
        });
    }

    /// Walks down all pairs of nodes that `meet`, to those of the level that begins with node `first`, and each of them
    /// with itself.
    fn walk(&self, first: usize, meet: impl Fn(usize, usize) -> bool, mut emit: impl FnMut(usize, usize)) {
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
}

impl Tree {
    /// Items whose boxes meet `bounds` somewhere along the step, in which `bounds` is displaced by any of `moves`.
    pub fn meeting_moving(&self, bounds: &Aabb, moves: &Aabb, mut emit: impl FnMut(u32)) {
        let leaves = self.items.len();
        let mut stack = vec![1usize];
        let asked = Sweep::new(bounds, moves);
        while let Some(a) = stack.pop() {
            if self.sweeps[a].meets(&asked) {
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

/// Joins what stands at the lower half of the nodes up to the root.
pub(crate) fn join_up<B>(nodes: &mut [B], join: impl Fn(&B, &B) -> B) {
    for i in (1..nodes.len() / 2).rev() {
        nodes[i] = join(&nodes[2 * i], &nodes[2 * i + 1]);
    }
}

/// Puts the items of `order` into the leaves of `slots` (a power of two), half of the slots to each side.
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
    // Which items go to which side is all that counts; no two compare as equal.
    if half < order.len() {
        let place = |i: &u32| centres[*i as usize][axis];
        order.select_nth_unstable_by(half, |p, q| place(p).total_cmp(&place(q)).then(p.cmp(q)));
    }
    let (left, right) = order.split_at_mut(half);
    let (ls, rs) = slots.split_at_mut(slots.len() / 2);
    split(centres, left, ls);
    split(centres, right, rs);
}
