//! Triangles of cloth near each other, found in two rounds: seldom a tree finds what is not far apart, and neighbours in the cloth are
//! known for good; out of these every list takes what may meet.

use crate::collision::broad_phase::blocks::Tiles;
use crate::collision::broad_phase::bvh::{Flat, Sweep, Tree};
use crate::collision::broad_phase::motion_bounds::Drift;
use crate::collision::culling::normal_cone::Calm;
use crate::collision::narrow_phase::candidates::{Near, Way};
use crate::scene::topology::Topology;
use crate::{Element, Vec3};

/// Slack of what is not far apart over the mean edge.
const FAR_SLACK: f64 = 0.3;
/// So many pairs of tiles over the tiles may have drifted before a search is made anew.
const DRIFTED: f64 = 0.5;
/// What single precision may be wrong by in drifts, over the largest coordinate.
const ROUNDING: f64 = 4e-6;

/// What finds them.
pub(crate) struct Search {
    tree: Tree,
    /// Of every triangle, its slot in the tree.
    slots: Vec<u32>,
    tiles: Tiles,
    calm: Calm,
    /// Pairs of triangles that are no neighbours and were nearer than `found`, m, when a search was made.
    pairs: Vec<[u32; 2]>,
    found: f64,
    drift: Drift,
    /// Pairs of tiles that have drifted, and pairs of triangles that meet on a way.
    drifted: Vec<[usize; 2]>,
    meeting: Vec<[u32; 2]>,
    flat: Flat,
    /// Boxes of the triangles on their way, grown by half the reach.
    sweeps: Vec<Sweep>,
}

impl Search {
    /// `x`: where the cloth begins, whose tree it is.
    pub fn new(cloth: &[Element], x: &[Vec3], topology: &Topology) -> Self {
        let (tree, calm) = (Tree::moving(x, &topology.faces), Calm::new(cloth, x.len(), topology));
        Self {
            slots: tree.slots(),
            tiles: tree.strangers_beside(calm.all_neighbours()),
            calm,
            pairs: Vec::new(),
            found: 0.0,
            drift: Drift::new(&tree, x.len(), &topology.faces),
            tree,
            drifted: Vec::new(),
            meeting: Vec::new(),
            flat: Flat::default(),
            sweeps: Vec::new(),
        }
    }

    /// Lists the pairs that come nearer than `gap` along a way, or `slack` beside it; edges are `edge` long.
    pub fn list(&mut self, near: &mut Near, way: &Way<'_>, gap: f64, slack: f64, edge: f64) {
        let reach = gap + 2.0 * slack;
        self.look(way, reach);
        self.neighbours(way, |f, g| near.add_own(f, g, way, reach));
        self.find(way, reach, gap + 2.0 * slack.max(FAR_SLACK * edge));
        self.meeting.iter().for_each(|&[f, g]| near.add_own(f, g, way, reach));
    }

    /// All triangles that may come nearer than `reach` along a way, and no list: nothing is kept for the next one.
    pub fn once(&mut self, way: &Way<'_>, reach: f64, mut emit: impl FnMut(u32, u32)) {
        self.look(way, reach);
        self.neighbours(way, &mut emit);
        self.forget();
        let Self { tree, tiles, sweeps, .. } = self;
        let sweep = |f: u32| sweeps[f as usize];
        tree.refit_tiles(sweep);
        tree.meeting_strangers(tiles, |f, g| sweep(f).meets(&sweep(g)), emit);
    }

    /// Takes a way: boxes, and where the cloth is calm.
    fn look(&mut self, way: &Way<'_>, reach: f64) {
        self.flat.take(way.x, way.step);
        self.sweeps.clear();
        self.sweeps.extend(way.topology.faces.iter().map(self.flat.sweeps(0.5 * reach)));
        self.calm.look(way.x, way.step, way.topology);
    }

    /// Neighbours in the cloth that may meet on the way that was taken.
    fn neighbours(&self, way: &Way<'_>, mut emit: impl FnMut(u32, u32)) {
        let meet = |f: u32, g: u32| self.sweeps[f as usize].meets(&self.sweeps[g as usize]);
        self.calm.restless(way.topology, |f, g, joined| {
            if joined || meet(f, g) {
                emit(f, g);
            }
        });
    }

    /// Finds the strangers that meet on this way. Most that were near when a search was made are not on this way: their boxes
    /// tell so soonest. Where tiles have drifted too far since, they are looked at anew.
    fn find(&mut self, way: &Way<'_>, reach: f64, wide: f64) {
        if !self.has_held(way, reach) {
            self.search(way, reach, wide);
        }
        let Self { tree, tiles, sweeps, pairs, drifted, meeting, slots, .. } = self;
        let meet = |f: u32, g: u32| sweeps[f as usize].meets(&sweeps[g as usize]);
        meeting.clear();
        meeting.extend(pairs.iter().filter(|[f, g]| meet(*f, *g)));
        if drifted.is_empty() {
            return;
        }
        for [a, b] in drifted.drain(..) {
            tree.strangers(tiles, a, b, |f, g| {
                if meet(f, g) {
                    meeting.push([f, g]);
                }
            });
        }
        meeting.sort_unstable_by_key(|pair| tree.turn(pair.map(|f| slots[f as usize])));
        meeting.dedup();
    }

    /// Does what the last search found still hold for all but a few tiles?
    fn has_held(&mut self, way: &Way<'_>, reach: f64) -> bool {
        self.drifted.clear();
        if !self.drift.is_known() {
            return false;
        }
        self.drift.take(way);
        let spare = self.found - reach - ROUNDING * self.flat.size;
        // Rounding is within what has just been taken off.
        #[allow(clippy::cast_possible_truncation)]
        self.tree.drifted(&self.drift.nodes, spare as f32, |a, b| self.drifted.push([a, b]));
        self.drifted.len() as f64 <= DRIFTED * self.tree.tiles() as f64
    }

    /// Finds all strangers nearer than `wide` along the way; the sweeps are those for `reach`.
    fn search(&mut self, way: &Way<'_>, reach: f64, wide: f64) {
        let Self { tree, tiles, sweeps, pairs, drifted, .. } = self;
        pairs.clear();
        drifted.clear();
        // The sweeps allow for more than this rounds.
        #[allow(clippy::cast_possible_truncation)]
        let more = (wide - reach) as f32;
        let sweep = |f: u32| &sweeps[f as usize];
        tree.refit_tiles(|f| sweep(f).grown(0.5 * more));
        tree.meeting_strangers(tiles, |f, g| sweep(f).grown(more).meets(sweep(g)), |f, g| pairs.push([f, g]));
        self.drift.start(way.x);
        self.found = wide;
    }

    pub fn forget(&mut self) {
        self.drift.forget();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A strip that crumples more and more as it travels: lists are those that a search at every step makes, in their order.
    #[test]
    fn what_drifts_is_listed_as_if_searched_anew() {
        let (n, mut scene) = (60u32, crate::Scene::default());
        let at = |i: u32, y: f64| [f64::from(i), y];
        for i in 0..n {
            scene.positions.extend([0.0, 1.0, 2.0].map(|y| Vec3::new(f64::from(i), y, 0.0)));
            for k in (0..2).filter(|_| i + 1 < n) {
                let (p, y) = (3 * i + k, f64::from(k));
                let mut add = |vertices, rest| scene.triangles.push(Element { vertices, rest, material: 0 });
                add([p, p + 3, p + 4], [at(i, y), at(i + 1, y), at(i + 1, y + 1.0)]);
                add([p, p + 4, p + 1], [at(i, y), at(i + 1, y + 1.0), at(i, y + 1.0)]);
            }
        }
        let count = scene.positions.len();
        let topology = Topology::of_elements(count, &scene.triangles);
        let groups: Vec<u32> = (0..u32::try_from(count).unwrap()).collect();
        let place = |t: f64| -> Vec<Vec3> {
            let fold = |p: &Vec3| {
                let (wave, deep) = (p.x * 0.6, 2.0 * t * libm::sin(p.x * 0.11 + 3.0 * t));
                Vec3::new(p.x * (1.0 - 0.6 * t) + 9.0 * t, p.y + 0.3 * t * wave, deep * libm::sin(wave) + 5.0 * t)
            };
            scene.positions.iter().map(fold).collect()
        };
        let (mut kept, mut listed) = (Search::new(&scene.triangles, &scene.positions, &topology), 0);
        for i in 0..120 {
            let t = f64::from(i) / 120.0;
            let (x, next) = (place(t), place(t + 0.004));
            let step: Vec<Vec3> = next.iter().zip(&x).map(|(q, p)| (q - p) * 1.5).collect();
            let way = Way::new(&x, &step, &topology, &groups);
            let mut fresh = Search::new(&scene.triangles, &scene.positions, &topology);
            let [mut near, mut wanted] = [Near::default(), Near::default()];
            kept.list(&mut near, &way, 0.2, 0.1, 1.0);
            fresh.list(&mut wanted, &way, 0.2, 0.1, 1.0);
            assert_eq!((&near.points, &near.edges), (&wanted.points, &wanted.edges), "{i}");
            listed += near.edges.len();
        }
        assert!(listed > 1000, "{listed}");
    }
}
