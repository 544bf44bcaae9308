//! Cloth near cloth, found in two rounds: seldom a tree finds what is not far apart, and neighbours in the cloth are
//! known for good; out of these every list takes what may meet.

use super::calm::Calm;
use super::listed::Listed;
use super::near::{Near, Way};
use super::sheet::Sheet;
use super::tree::Tree;
use crate::topology::Topology;
use crate::{Scene, Vec3};

/// Slack of what is not far apart over the mean edge, and the longest step for which it is worth while.
const FAR_SLACK: f64 = 0.5;
const FAR_STEP: f64 = 0.15;

/// What finds cloth near cloth.
pub(crate) struct Own {
    tree: Tree,
    calm: Calm,
    sheet: Option<Sheet>,
    /// Pairs of triangles that are no neighbours.
    pairs: Vec<[u32; 2]>,
    listed: Listed,
}

impl Own {
    pub fn new(scene: &Scene, x: &[Vec3], topology: &Topology) -> Self {
        let (tree, calm) = (Tree::new(x, &topology.faces), Calm::new(scene, topology));
        let sheet = Sheet::new(scene, topology);
        Self { tree, calm, sheet, pairs: Vec::new(), listed: Listed::default() }
    }

    /// Lists the pairs that come nearer than `gap` along a way, or `slack` beside it; edges are `edge` long.
    pub fn list(&mut self, near: &mut Near, way: &Way<'_>, gap: f64, slack: f64, edge: f64) {
        near.clear_own();
        if self.sheet.as_ref().is_some_and(|s| s.is_spread(way)) {
            self.listed.forget();
            return;
        }
        if !self.listed.covers(way.x, way.longest, slack) {
            let wide = if way.longest > FAR_STEP * edge { slack } else { slack.max(FAR_SLACK * edge) };
            self.search(way, gap + 2.0 * wide);
            self.listed.made(way.x, wide);
        }
        self.calm.look(way.x, way.step, way.topology);
        let reach = gap + 2.0 * slack;
        self.calm.restless(way.topology, |f, g| near.add_own(f, g, way, reach));
        self.pairs.iter().for_each(|&[f, g]| near.add_own(f, g, way, reach));
    }

    fn search(&mut self, way: &Way<'_>, reach: f64) {
        self.pairs.clear();
        self.tree.refit_moving(way.x, way.step, &way.topology.faces, 0.5 * reach);
        let (calm, pairs) = (&self.calm, &mut self.pairs);
        self.tree.meeting_pairs(|f, g| {
            if !calm.neighbours(way.topology, f, g) {
                pairs.push([f, g]);
            }
        });
    }

    /// `x` was reached.
    pub fn took(&mut self, x: &[Vec3]) {
        self.listed.took(x);
    }

    pub fn forget(&mut self) {
        self.listed.forget();
    }
}
