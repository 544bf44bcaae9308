//! Cloth near cloth, found in two rounds: seldom a tree finds what is not far apart, and neighbours in the cloth are
//! known for good; out of these every list takes what may meet.

use super::calm::Calm;
use super::listed::Listed;
use super::near::{Near, Way};
use super::sheet::Sheet;
use super::tiles::Tiles;
use super::tree::{Sweep, Tree};
use crate::topology::Topology;
use crate::{Scene, Vec3};

/// Slack of what is not far apart over the mean edge, and the longest step for which it is worth while.
const FAR_SLACK: f64 = 0.3;
const FAR_STEP: f64 = 0.2;

/// What finds cloth near cloth.
pub(crate) struct Own {
    tree: Tree,
    tiles: Tiles,
    calm: Calm,
    sheet: Option<Sheet>,
    /// Pairs of triangles that are no neighbours.
    pairs: Vec<[u32; 2]>,
    listed: Listed,
    /// Boxes of the triangles on their way, grown by half the reach.
    sweeps: Vec<Sweep>,
}

impl Own {
    pub fn new(scene: &Scene, x: &[Vec3], topology: &Topology) -> Self {
        let (tree, calm) = (Tree::moving(x, &topology.faces), Calm::new(scene, topology));
        let sheet = Sheet::new(scene, topology);
        let tiles = Tiles::new(&tree, calm.all_neighbours());
        Self { tree, tiles, calm, sheet, pairs: Vec::new(), listed: Listed::default(), sweeps: Vec::new() }
    }

    /// Lists the pairs that come nearer than `gap` along a way, or `slack` beside it; edges are `edge` long.
    pub fn list(&mut self, near: &mut Near, way: &Way<'_>, gap: f64, slack: f64, edge: f64) {
        near.clear_own();
        if self.sheet.as_ref().is_some_and(|s| s.is_spread(way)) {
            // A sheet spread out meets itself nowhere, so nothing is listed and the old list grows stale.
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
        self.sweep(way, 0.5 * reach);
        let meet = |f: u32, g: u32| self.sweeps[f as usize].meets(&self.sweeps[g as usize]);
        self.calm.restless(way.topology, |f, g, joined| {
            if joined || meet(f, g) {
                near.add_own(f, g, way, reach);
            }
        });
        self.pairs.iter().filter(|[f, g]| meet(*f, *g)).for_each(|&[f, g]| near.add_own(f, g, way, reach));
    }

    /// Most pairs were near when they were found, and are not on this way: their boxes tell so soonest.
    fn sweep(&mut self, way: &Way<'_>, grown: f64) {
        self.sweeps.clear();
        self.sweeps.extend(way.topology.faces.iter().map(|t| Sweep::of(t, way.x, way.step, grown)));
    }

    fn search(&mut self, way: &Way<'_>, reach: f64) {
        self.pairs.clear();
        self.tree.refit_moving(way.x, way.step, &way.topology.faces, 0.5 * reach);
        self.tree.meeting_strangers(&self.tiles, |f, g| self.pairs.push([f, g]));
    }

    /// `x` was reached along a way that was listed.
    pub fn took(&mut self, x: &[Vec3]) {
        self.listed.took(x);
    }

    pub fn forget(&mut self) {
        self.listed.forget();
    }
}

#[cfg(test)]
mod tests {
    use super::super::barrier::Barrier;
    use super::super::contact::Frame;
    use super::*;
    use crate::Element;

    const APART: f64 = 1.0055;

    /// Two triangles above each other, just too far apart for the first wide search.
    fn stacked() -> (Scene, Barrier) {
        let rest = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let mut scene = Scene::default();
        for (n, z) in [(0, 0.0), (3, APART)] {
            scene.positions.extend(rest.map(|[x, y]| Vec3::new(x, y, z)));
            scene.triangles.push(Element { vertices: [n, n + 1, n + 2], rest, material: 0 });
        }
        let topology = Topology::of_elements(6, &scene.triangles);
        let own = Own::new(&scene, &scene.positions, &topology);
        let frame = Frame { own: true, ..Frame::plain(topology, vec![0.0; 6], vec![1e-3; 6], 1.0) };
        (scene, Barrier::new(frame, None, vec![1.0; 6], Some(own)))
    }

    /// Moves towards each other, of both triangles.
    fn closer(by: f64) -> Vec<Vec3> {
        (0..6).map(|v| Vec3::new(0.0, 0.0, if v < 3 { by } else { -by })).collect()
    }

    /// The list made for a step that is not taken must not count from where another step leads.
    #[test]
    fn a_step_that_was_not_taken_moves_no_list() {
        let (scene, mut barrier) = stacked();
        let up = vec![Vec3::new(0.0, 0.0, 0.01); 6];
        assert!(barrier.cover(&scene.positions, &up) && barrier.near.points.is_empty());
        let along = |x: &[Vec3], by: f64| -> Vec<Vec3> { x.iter().zip(closer(by)).map(|(p, d)| p + d).collect() };
        assert!(!barrier.cover(&scene.positions, &closer(0.03)), "the first lists hold");
        let x = along(&scene.positions, 0.03);
        barrier.took(&x);
        let x = along(&x, 0.455);
        assert!(barrier.cover(&x, &closer(0.0066)));
        assert!(!barrier.near.points.is_empty());
    }
}
