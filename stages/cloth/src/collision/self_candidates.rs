//! Cloth near cloth. One piece that is spread out meets itself nowhere: what looks for that is made when it no longer is.

use crate::collision::broad_phase::self_search::Search;
use crate::collision::crossings::count;
use crate::collision::culling::flat_sheet::Sheet;
use crate::collision::narrow_phase::candidates::{Near, Way};
use crate::scene::topology::Topology;
use crate::{Elements, Scene, Vec3};

/// What finds cloth near cloth.
pub(crate) struct Own {
    sheet: Option<Sheet>,
    search: Option<Search>,
    /// The cloth, and where it began: a search finds the same in the same order whenever it is made.
    cloth: Elements,
    start: Vec<Vec3>,
}

impl Own {
    /// `None` for a single triangle, which meets nothing. `x`: where the cloth begins.
    pub fn new(scene: &Scene, x: &[Vec3], topology: &Topology) -> Option<Self> {
        if topology.faces.len() < 2 {
            return None;
        }
        let cloth = scene.triangles.clone();
        let sheet = Sheet::new(scene, topology);
        let search = sheet.is_none().then(|| Search::new(&cloth, x, topology));
        let start = if search.is_none() { x.to_vec() } else { Vec::new() };
        Some(Self { sheet, search, cloth, start })
    }

    /// Lists the pairs that come nearer than `gap` along a way, or `slack` beside it; edges are `edge` long.
    pub fn list(&mut self, near: &mut Near, way: &Way<'_>, gap: f64, slack: f64, edge: f64) {
        near.clear_own();
        if let Some(search) = self.search(way) {
            search.list(near, way, gap, slack, edge);
        }
    }

    /// Lists the pairs that come nearer than `gap` along a way that no other follows.
    pub fn list_once(&mut self, near: &mut Near, way: &Way<'_>, gap: f64) {
        near.clear_own();
        if let Some(search) = self.search(way) {
            search.once(way, gap, |f, g| near.add_own(f, g, way, gap));
        }
    }

    /// Does it surely cross itself nowhere? Asked of less than all pairs, and with less regard to what only touches, than
    /// [`count::own`] asks.
    pub fn surely_lies_free(&mut self, x: &[Vec3], topology: &Topology) -> bool {
        let (still, mut free) = (vec![Vec3::zeros(); x.len()], true);
        let way = Way::new(x, &still, topology, &[]);
        if let Some(search) = self.search(&way) {
            search.once(&way, 0.0, |f, g| {
                free = free && !count::cross(x, topology.faces[f as usize], topology.faces[g as usize])
            });
        }
        free
    }

    /// What searches, made when it is first needed; `None` where the cloth is surely spread out all along the way.
    fn search(&mut self, way: &Way<'_>) -> Option<&mut Search> {
        if self.sheet.as_mut().is_some_and(|s| s.is_spread(way.x, way.step, &way.topology.faces)) {
            return None;
        }
        let Self { search, cloth, start, .. } = self;
        let made = || {
            let start = std::mem::take(start);
            Search::new(cloth, &start, &Topology::of_elements(start.len(), cloth))
        };
        Some(search.get_or_insert_with(made))
    }

    pub fn forget(&mut self) {
        self.search.iter_mut().for_each(Search::forget);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Element;
    use crate::contact::barrier::Barrier;
    use crate::contact::parameters::Frame;

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
        (scene, Barrier::new(frame, None, vec![1.0; 6], own))
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
