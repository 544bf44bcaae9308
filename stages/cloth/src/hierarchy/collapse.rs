//! Collapse of edges, the shortest first, until all are about as long as wanted.
//!
//! A vertex on a border, seam, band or fold moves along it only, where it runs nearly straight. Ends of seams, loads and the limits
//! of held regions stay.

use crate::hierarchy::charts::Charts;
use crate::hierarchy::rest_places::weights;
use crate::hierarchy::tuning::{BORDER_OFFSET_MAX, COLLAPSE_EDGE_SHARE, COLLAPSED_EDGE_MAX, COLLAPSED_SHAPE_MIN};
use crate::{Scene, Vec3};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A mesh of copies whose edges collapse.
pub(crate) struct Mesh {
    pub charts: Charts,
    /// Corners as copies; `None` for a triangle that has collapsed.
    pub triangles: Vec<Option<[u32; 3]>>,
    /// Copies that lie in each triangle.
    pub carried: Vec<Vec<u32>>,
    /// Triangles around every knot.
    stars: Vec<Vec<u32>>,
}

/// Collapses of one knot into another, the shortest first.
struct Queue {
    heap: BinaryHeap<Reverse<(u64, u32, u32)>>,
    /// Collapses of every knot that are in the queue: most are offered again before their turn.
    waiting: Vec<Vec<(u64, u32)>>,
}

impl Queue {
    fn new(seam_classes: usize) -> Self {
        Self { heap: BinaryHeap::new(), waiting: vec![Vec::new(); seam_classes] }
    }

    fn push(&mut self, length: f64, a: u32, b: u32) {
        let (waiting, one) = (&mut self.waiting[a as usize], (length.to_bits(), b));
        if !waiting.contains(&one) {
            waiting.push(one);
            self.heap.push(Reverse((one.0, a, b)));
        }
    }

    fn pop(&mut self) -> Option<(u32, u32)> {
        let Reverse((length, a, b)) = self.heap.pop()?;
        self.waiting[a as usize].retain(|one| *one != (length, b));
        Some((a, b))
    }
}

impl Mesh {
    /// The mesh of a scene before any collapse.
    pub fn new(scene: &Scene, charts: Charts) -> Self {
        let triangles: Vec<_> = charts.corners.iter().map(|c| Some(*c)).collect();
        let mut stars = vec![Vec::new(); charts.seam_classes];
        for (f, c) in (0u32..).zip(&charts.corners) {
            c.iter().for_each(|c| stars[charts.seam_class[*c as usize] as usize].push(f));
        }
        Self { carried: vec![Vec::new(); scene.triangles.len()], charts, triangles, stars }
    }

    fn seam_class(&self, copy: u32) -> u32 {
        self.charts.seam_class[copy as usize]
    }

    fn length(&self, a: u32, b: u32) -> f64 {
        (self.charts.rest[a as usize] - self.charts.rest[b as usize]).norm()
    }

    /// Triangles around a knot with their corners.
    fn around(&self, seam_class: u32) -> impl Iterator<Item = (u32, [u32; 3])> + '_ {
        self.stars[seam_class as usize].iter().filter_map(|f| self.triangles[*f as usize].map(|c| (*f, c)))
    }

    /// Knots of the triangles around a knot, itself among them, ascending.
    fn ring(&self, seam_class: u32) -> Vec<u32> {
        let mut ring: Vec<u32> = self.around(seam_class).flat_map(|(_, c)| c).map(|c| self.seam_class(c)).collect();
        ring.sort_unstable();
        ring.dedup();
        ring
    }

    /// Collapses until edges are about `edge` long, m.
    pub fn collapse(&mut self, edge: f64) {
        let mut queue = Queue::new(self.charts.seam_classes);
        for seam_class in (0u32..).take(self.charts.seam_classes) {
            self.offer(seam_class, edge, &mut queue);
        }
        while let Some((a, b)) = queue.pop() {
            let Some(moves) = self.moves(a, b, edge) else { continue };
            self.take(a, b, &moves);
            self.ring(b).into_iter().for_each(|k| self.offer(k, edge, &mut queue));
        }
    }

    /// Offers the collapses of a knot into its neighbours.
    fn offer(&self, a: u32, edge: f64, queue: &mut Queue) {
        let mut seen: Vec<(u32, f64)> = Vec::new();
        for (_, corners) in self.around(a) {
            let Some(mine) = corners.into_iter().find(|c| self.seam_class(*c) == a) else { continue };
            seen.extend(corners.iter().filter(|c| **c != mine).map(|c| (self.seam_class(*c), self.length(mine, *c))));
        }
        seen.sort_by(|p, q| p.0.cmp(&q.0).then(p.1.total_cmp(&q.1)));
        seen.dedup_by_key(|s| s.0);
        for (b, length) in seen.into_iter().filter(|s| s.1 < COLLAPSE_EDGE_SHARE.get() * edge) {
            queue.push(length, a, b);
        }
    }

    /// Pairs of a copy of `a` and the copy of `b` that it becomes; `None` where the collapse is not allowed.
    fn moves(&self, a: u32, b: u32, edge: f64) -> Option<Vec<(u32, u32)>> {
        if self.charts.fixed[a as usize] || self.charts.pinned[a as usize] && !self.charts.pinned[b as usize] {
            return None;
        }
        let mut moves: Vec<(u32, u32)> = Vec::new();
        let mut mine: Vec<u32> = Vec::new();
        for (_, c) in self.around(a) {
            let own = c.into_iter().find(|c| self.seam_class(*c) == a)?;
            mine.push(own);
            moves.extend(c.iter().filter(|c| self.seam_class(**c) == b).map(|c| (own, *c)));
        }
        mine.sort_unstable();
        mine.dedup();
        moves.sort_unstable();
        moves.dedup();
        // Every copy goes to exactly one copy.
        let fits = !mine.is_empty() && moves.len() == mine.len() && moves.iter().zip(&mine).all(|(m, c)| m.0 == *c);
        (fits && self.linked(a, b) && self.smooth(a, b, edge) && self.shaped(a, &moves, edge)).then_some(moves)
    }

    /// Returns `true` if the surface stays one: the two share no neighbours but those of their common triangles.
    fn linked(&self, a: u32, b: u32) -> bool {
        let (first, second) = (self.ring(a), self.ring(b));
        let shared = first.iter().filter(|k| **k != a && **k != b && second.binary_search(k).is_ok()).count();
        let mut across: Vec<u32> = self
            .around(a)
            .filter(|(_, c)| c.iter().any(|c| self.seam_class(*c) == b))
            .flat_map(|(_, c)| c)
            .map(|c| self.seam_class(c))
            .filter(|k| *k != a && *k != b)
            .collect();
        across.sort_unstable();
        across.dedup();
        shared == across.len()
    }

    /// Returns `true` if a knot may go to `b`: from inside the cloth always, from a border or seam only along it where
    /// it is nearly straight.
    fn smooth(&self, a: u32, b: u32, edge: f64) -> bool {
        let lines = self.lines(a);
        match lines.as_slice() {
            [] => true,
            [p, q] => {
                let other = if p.0 == b { q } else { p };
                (p.0 == b || q.0 == b)
                    && p.1 == q.1
                    && (!self.charts.pinned[a as usize] || self.charts.pinned[other.0 as usize])
                    && self.straight(a, b, other.0, edge)
            }
            _ => false,
        }
    }

    /// Neighbours of a knot along borders, seams, bands, folds and limits of held regions, with the number of triangles there.
    fn lines(&self, a: u32) -> Vec<(u32, usize)> {
        let mut sides: Vec<(u32, [u32; 2], bool)> = Vec::new();
        for (_, c) in self.around(a) {
            let Some(k) = (0..3).find(|k| self.seam_class(c[*k]) == a) else { continue };
            for (other, third) in [(c[(k + 1) % 3], c[(k + 2) % 3]), (c[(k + 2) % 3], c[(k + 1) % 3])] {
                let pinned = |c: u32| self.charts.pinned[self.seam_class(c) as usize];
                let limit = pinned(c[k]) && pinned(other) && !pinned(third);
                let line = |c: u32| self.charts.line[self.seam_class(c) as usize];
                let along = line(other) != 0 && line(other) == line(c[k]);
                sides.push((self.seam_class(other), [c[k], other], limit || along));
            }
        }
        sides.sort_unstable();
        // A band, a fold and the limit of a held region are lines, too.
        sides
            .chunk_by(|p, q| p.0 == q.0)
            .filter(|same| same.len() != 2 || same[0].1 != same[1].1 || same.iter().any(|s| s.2))
            .map(|same| (same[0].0, same.len()))
            .collect()
    }

    /// Returns `true` if the way from `b` over `a` to `c` is nearly straight on every side.
    fn straight(&self, a: u32, b: u32, c: u32, edge: f64) -> bool {
        let mut ends: Vec<(u32, u32, u32)> = Vec::new();
        for (_, corners) in self.around(a) {
            let Some(own) = corners.into_iter().find(|c| self.seam_class(*c) == a) else { continue };
            ends.extend(
                corners
                    .iter()
                    .filter(|k| [b, c].contains(&self.seam_class(**k)))
                    .map(|k| (own, self.seam_class(*k), *k)),
            );
        }
        ends.sort_unstable();
        ends.dedup();
        ends.chunk_by(|p, q| p.0 == q.0).all(|side| {
            let [p, q] = side else { return false };
            let at = |c: u32| self.charts.rest[c as usize];
            let (m, p, q) = (at(p.0), at(p.2), at(q.2));
            let (whole, part) = (q - p, m - p);
            let off = whole.cross(&part).norm() / whole.norm();
            let along = part.dot(&whole);
            off < BORDER_OFFSET_MAX.get() * edge && along > 0.0 && along < whole.norm_squared()
        })
    }

    /// Returns `true` if no triangle turns over, becomes a sliver or too large.
    fn shaped(&self, a: u32, moves: &[(u32, u32)], edge: f64) -> bool {
        let mut left = vec![0; moves.len()];
        for (_, c) in self.around(a) {
            let Some(k) = (0..3).find(|k| self.seam_class(c[*k]) == a) else { continue };
            let Ok(m) = moves.binary_search_by_key(&c[k], |m| m.0) else { return false };
            let target = moves[m].1;
            if c.contains(&target) {
                continue;
            }
            left[m] += 1;
            let mut new = c;
            new[k] = target;
            let (old, shape) = (self.shape(&c), self.shape(&new));
            let turned = old.dot(&shape) <= 0.0;
            let (old, shape) = (old.norm(), shape.norm());
            let long = (0..3).any(|k| self.length(new[k], new[(k + 1) % 3]) > COLLAPSED_EDGE_MAX.get() * edge);
            if turned || shape < COLLAPSED_SHAPE_MIN.get().min(old) || long {
                return false;
            }
        }
        left.iter().all(|n| *n > 0)
    }

    /// Normal of a triangle. Its length is the area over that of the equilateral triangle with the same sum of squared
    /// sides.
    fn shape(&self, c: &[u32; 3]) -> Vec3 {
        let [p, q, r] = c.map(|c| self.charts.rest[c as usize]);
        let squares: f64 = (0..3).map(|k| self.length(c[k], c[(k + 1) % 3])).map(|l| l * l).sum();
        (q - p).cross(&(r - p)) * (2.0 * 3.0f64.sqrt() / squares)
    }

    /// Collapses knot `a` into `b`.
    fn take(&mut self, a: u32, b: u32, moves: &[(u32, u32)]) {
        let star: Vec<(u32, [u32; 3])> = self.around(a).collect();
        let mut homeless: Vec<(u32, u32)> = moves.iter().map(|m| (m.1, m.0)).collect();
        for (f, c) in &star {
            let Some((own, target)) = c.iter().find_map(|c| moves.iter().find(|m| m.0 == *c)) else { continue };
            homeless.extend(std::mem::take(&mut self.carried[*f as usize]).into_iter().map(|p| (*target, p)));
            let new = c.map(|k| if k == *own { *target } else { k });
            self.triangles[*f as usize] = (!c.contains(target)).then_some(new);
            if !c.contains(target) {
                self.stars[b as usize].push(*f);
            }
        }
        let triangles = &self.triangles;
        self.stars[b as usize].retain(|f| triangles[*f as usize].is_some());
        self.stars[a as usize].clear();
        for (target, p) in homeless {
            if let Some(f) = self.home(target, p, star.iter().map(|s| s.0)) {
                self.carried[f as usize].push(p);
            }
        }
    }

    /// The one of some triangles around a copy in which a place lies deepest.
    fn home(&self, target: u32, p: u32, among: impl Iterator<Item = u32>) -> Option<u32> {
        let mut best = (f64::NEG_INFINITY, None);
        for f in among {
            let Some(c) = self.triangles[f as usize].filter(|c| c.contains(&target)) else { continue };
            let w = weights(&c.map(|c| self.charts.rest[c as usize]), &self.charts.rest[p as usize]);
            let depth = w[0].min(w[1]).min(w[2]);
            if depth > best.0 {
                best = (depth, Some(f));
            }
        }
        best.1
    }
}
