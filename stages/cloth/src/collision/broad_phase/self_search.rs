//! The broad phase of self-contact, in two rounds.
//!
//! From time to time a tree finds the pairs of blocks that are not far apart. Neighbours in the cloth are known once
//! for all. Every list takes from both the pairs that may meet.

use crate::collision::broad_phase::blocks::Blocks;
use crate::collision::broad_phase::bvh::BoxTree;
use crate::collision::broad_phase::motion_bounds::MotionBounds;
use crate::collision::broad_phase::swept_box::{RoundedMotion, SweptBox};
use crate::collision::culling::normal_cone::NormalCones;
use crate::collision::narrow_phase::candidates::{ClothCandidates, LinearMotion};
use crate::collision::tuning::{DRIFTED_BLOCK_PAIRS, MOTION_BOUNDS, WIDE_SEARCH_SLACK};
use crate::scene::topology::Topology;
use crate::{Element, Vec3};

/// Bound of the rounding of moves in single precision, over the largest coordinate.
const ROUNDING_OF_MOTION: f64 = 4e-6;

/// The broad phase of self-contact.
pub(crate) struct SelfBroadPhase {
    tree: BoxTree,
    /// The slot of each triangle in the tree.
    slots: Vec<u32>,
    blocks: Blocks,
    cones: NormalCones,
    /// Pairs of triangles that are no neighbours and were nearer than `wide_reach` at the last wide search.
    pairs: Vec<[u32; 2]>,
    /// Reach of the last wide search, m.
    wide_reach: f64,
    bounds: MotionBounds,
    /// Pairs of blocks that have drifted since the last wide search.
    drifted: Vec<[usize; 2]>,
    /// Pairs of triangles that meet along the motion.
    meeting: Vec<[u32; 2]>,
    rounded: RoundedMotion,
    /// Swept boxes of the triangles, grown by half the reach.
    swept: Vec<SweptBox>,
}

impl SelfBroadPhase {
    /// Makes the search for cloth that begins at `x`, where its tree is built.
    pub fn new(cloth: &[Element], x: &[Vec3], topology: &Topology) -> Self {
        let (tree, cones) = (BoxTree::moving(x, &topology.faces), NormalCones::new(cloth, x.len(), topology));
        Self {
            slots: tree.slots(),
            blocks: tree.non_neighbours_beside(cones.all_neighbours()),
            cones,
            pairs: Vec::new(),
            wide_reach: 0.0,
            bounds: MotionBounds::new(&tree, x.len(), &topology.faces),
            tree,
            drifted: Vec::new(),
            meeting: Vec::new(),
            rounded: RoundedMotion::default(),
            swept: Vec::new(),
        }
    }

    /// Lists the pairs that come nearer than `gap` along a motion, or within `slack` of it, m. `edge` is the mean
    /// edge, m.
    pub fn list(
        &mut self,
        candidates: &mut ClothCandidates,
        motion: &LinearMotion<'_>,
        gap: f64,
        slack: f64,
        edge: f64,
    ) {
        let reach = gap + 2.0 * slack;
        self.set_motion(motion, reach);
        self.neighbours(motion, |f, g| candidates.add_pair(f, g, motion, reach));
        self.find_meeting_pairs(motion, reach, gap + 2.0 * slack.max(WIDE_SEARCH_SLACK.get() * edge));
        self.meeting.iter().for_each(|&[f, g]| candidates.add_pair(f, g, motion, reach));
    }

    /// Emits the pairs of triangles that may come nearer than `reach` along a motion, m. Nothing is kept for the next
    /// list.
    pub fn list_once(&mut self, motion: &LinearMotion<'_>, reach: f64, mut emit: impl FnMut(u32, u32)) {
        self.set_motion(motion, reach);
        self.neighbours(motion, &mut emit);
        self.invalidate();
        let Self { tree, blocks, swept, .. } = self;
        let swept_box = |f: u32| swept[f as usize];
        tree.refit_blocks(swept_box);
        tree.meeting_non_neighbours(blocks, |f, g| swept_box(f).meets(&swept_box(g)), emit);
    }

    /// Takes a motion: computes swept boxes and normal cones.
    fn set_motion(&mut self, motion: &LinearMotion<'_>, reach: f64) {
        self.rounded.set(motion.x, motion.step);
        self.swept.clear();
        self.swept.extend(motion.topology.faces.iter().map(self.rounded.swept(0.5 * reach)));
        self.cones.set_motion(motion.x, motion.step, motion.topology);
    }

    /// Emits the neighbours in the cloth that may meet along the motion.
    fn neighbours(&self, motion: &LinearMotion<'_>, mut emit: impl FnMut(u32, u32)) {
        let meet = |f: u32, g: u32| self.swept[f as usize].meets(&self.swept[g as usize]);
        self.cones.unsafe_neighbours(motion.topology, |f, g, joined| {
            if joined || meet(f, g) {
                emit(f, g);
            }
        });
    }

    /// Finds the pairs of non-neighbours that meet along the motion.
    ///
    /// Most pairs of the last wide search do not meet, and their boxes show it at the least cost. Blocks that have
    /// drifted too far since that search are searched anew.
    fn find_meeting_pairs(&mut self, motion: &LinearMotion<'_>, reach: f64, new_reach: f64) {
        if !self.is_search_valid(motion, reach) {
            self.search_widely(motion, reach, new_reach);
        }
        let Self { tree, blocks, swept, pairs, drifted, meeting, slots, .. } = self;
        let meet = |f: u32, g: u32| swept[f as usize].meets(&swept[g as usize]);
        meeting.clear();
        meeting.extend(pairs.iter().filter(|[f, g]| meet(*f, *g)));
        if drifted.is_empty() {
            return;
        }
        for [a, b] in drifted.drain(..) {
            tree.non_neighbours(blocks, a, b, |f, g| {
                if meet(f, g) {
                    meeting.push([f, g]);
                }
            });
        }
        meeting.sort_unstable_by_key(|pair| tree.rank(pair.map(|f| slots[f as usize])));
        meeting.dedup();
    }

    /// Is the last wide search still valid for all but a few blocks?
    fn is_search_valid(&mut self, motion: &LinearMotion<'_>, reach: f64) -> bool {
        self.drifted.clear();
        if !MOTION_BOUNDS.is_on() || !self.bounds.is_known() {
            return false;
        }
        self.bounds.set_motion(motion);
        let spare = self.wide_reach - reach - ROUNDING_OF_MOTION * self.rounded.size;
        // The rounding has just been taken off.
        #[allow(clippy::cast_possible_truncation)]
        self.tree.drifted_blocks(&self.bounds.nodes, spare as f32, |a, b| self.drifted.push([a, b]));
        self.drifted.len() as f64 <= DRIFTED_BLOCK_PAIRS.get() * self.tree.blocks() as f64
    }

    /// Finds all pairs of non-neighbours nearer than `wide_reach` along the motion, m. The swept boxes are those for
    /// `reach`.
    fn search_widely(&mut self, motion: &LinearMotion<'_>, reach: f64, new_reach: f64) {
        let Self { tree, blocks, swept, pairs, drifted, .. } = self;
        pairs.clear();
        drifted.clear();
        // The swept boxes allow for more than this rounding.
        #[allow(clippy::cast_possible_truncation)]
        let more = (new_reach - reach) as f32;
        let swept_box = |f: u32| &swept[f as usize];
        tree.refit_blocks(|f| swept_box(f).grown(0.5 * more));
        tree.meeting_non_neighbours(
            blocks,
            |f, g| swept_box(f).grown(more).meets(swept_box(g)),
            |f, g| pairs.push([f, g]),
        );
        self.bounds.start(motion.x);
        self.wide_reach = new_reach;
    }

    /// Makes the next wide search due.
    pub fn invalidate(&mut self) {
        self.bounds.invalidate();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A strip crumples more and more as it travels. Its lists equal those of a search at every step, in the same
    /// order.
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
        let (mut kept, mut listed) = (SelfBroadPhase::new(&scene.triangles, &scene.positions, &topology), 0);
        for i in 0..120 {
            let t = f64::from(i) / 120.0;
            let (x, next) = (place(t), place(t + 0.004));
            let step: Vec<Vec3> = next.iter().zip(&x).map(|(q, p)| (q - p) * 1.5).collect();
            let motion = LinearMotion::new(&x, &step, &topology, &groups);
            let mut fresh = SelfBroadPhase::new(&scene.triangles, &scene.positions, &topology);
            let [mut candidates, mut wanted] = [ClothCandidates::default(), ClothCandidates::default()];
            kept.list(&mut candidates, &motion, 0.2, 0.1, 1.0);
            fresh.list(&mut wanted, &motion, 0.2, 0.1, 1.0);
            assert_eq!((&candidates.points, &candidates.edges), (&wanted.points, &wanted.edges), "{i}");
            listed += candidates.edges.len();
        }
        assert!(listed > 1000, "{listed}");
    }
}
