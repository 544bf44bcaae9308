//! Candidate pairs of cloth with cloth.
//!
//! One flat piece that is spread out does not meet itself. The search for pairs is made when it no longer is.

use crate::collision::broad_phase::self_search::SelfBroadPhase;
use crate::collision::crossings::count;
use crate::collision::culling::flat_sheet::FlatSheet;
use crate::collision::narrow_phase::candidates::{ClothCandidates, LinearMotion};
use crate::scene::topology::Topology;
use crate::{Elements, Scene, Vec3};

/// Search for pairs of cloth with cloth.
pub(crate) struct SelfCollision {
    /// Test whether the cloth is one flat piece that is spread out.
    sheet: Option<FlatSheet>,
    search: Option<SelfBroadPhase>,
    /// The triangles of the cloth.
    cloth: Elements,
    /// Where the cloth began, until the search is made. A search finds the same pairs whenever it is made.
    initial: Vec<Vec3>,
}

impl SelfCollision {
    /// Makes the search for cloth that begins at `x`. `None` for a single triangle, which meets nothing.
    pub fn new(scene: &Scene, x: &[Vec3], topology: &Topology) -> Option<Self> {
        if topology.faces.len() < 2 {
            return None;
        }
        let cloth = scene.triangles.clone();
        let sheet = FlatSheet::new(scene, topology);
        let search = sheet.is_none().then(|| SelfBroadPhase::new(&cloth, x, topology));
        let initial = if search.is_none() { x.to_vec() } else { Vec::new() };
        Some(Self { sheet, search, cloth, initial })
    }

    /// Lists the pairs that come nearer than `gap` along a motion, or within `slack` of it, m. `edge` is the mean
    /// edge, m.
    pub fn list(&mut self, pairs: &mut ClothCandidates, motion: &LinearMotion<'_>, gap: f64, slack: f64, edge: f64) {
        pairs.remove_all();
        if let Some(search) = self.search(motion) {
            search.list(pairs, motion, gap, slack, edge);
        }
    }

    /// Lists the pairs that come nearer than `gap` along a motion, m. Nothing is kept for the next list.
    pub fn list_once(&mut self, pairs: &mut ClothCandidates, motion: &LinearMotion<'_>, gap: f64) {
        pairs.remove_all();
        if let Some(search) = self.search(motion) {
            search.list_once(motion, gap, |f, g| pairs.add_pair(f, g, motion, gap));
        }
    }

    /// Is the cloth surely free of crossings with itself?
    ///
    /// It tests fewer pairs than [`count::self_crossings`], and treats pairs that only touch less exactly.
    pub fn is_surely_free(&mut self, x: &[Vec3], topology: &Topology) -> bool {
        let (still, mut free) = (vec![Vec3::zeros(); x.len()], true);
        let motion = LinearMotion::new(x, &still, topology, &[]);
        if let Some(search) = self.search(&motion) {
            search.list_once(&motion, 0.0, |f, g| {
                free = free && !count::cross(x, topology.faces[f as usize], topology.faces[g as usize])
            });
        }
        free
    }

    /// The search, made when it is first needed; `None` where the cloth is surely spread out along the whole motion.
    fn search(&mut self, motion: &LinearMotion<'_>) -> Option<&mut SelfBroadPhase> {
        if self.sheet.as_mut().is_some_and(|s| s.is_spread(motion.x, motion.step, &motion.topology.faces)) {
            return None;
        }
        let Self { search, cloth, initial, .. } = self;
        let make = || {
            let initial = std::mem::take(initial);
            SelfBroadPhase::new(cloth, &initial, &Topology::of_elements(initial.len(), cloth))
        };
        Some(search.get_or_insert_with(make))
    }

    /// Makes the next wide search due.
    pub fn invalidate(&mut self) {
        self.search.iter_mut().for_each(SelfBroadPhase::invalidate);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Element;
    use crate::contact::barrier::Barrier;
    use crate::contact::parameters::ContactParameters;

    const HEIGHT: f64 = 1.0055;

    /// Two triangles above each other, just beyond the reach of the first wide search.
    fn stacked() -> (Scene, Barrier) {
        let rest = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let mut scene = Scene::default();
        for (n, z) in [(0, 0.0), (3, HEIGHT)] {
            scene.positions.extend(rest.map(|[x, y]| Vec3::new(x, y, z)));
            scene.triangles.push(Element { vertices: [n, n + 1, n + 2], rest, material: 0 });
        }
        let topology = Topology::of_elements(6, &scene.triangles);
        let search = SelfCollision::new(&scene, &scene.positions, &topology);
        let parameters = ContactParameters {
            has_self_contact: true,
            ..ContactParameters::plain(topology, vec![0.0; 6], vec![1e-3; 6], 1.0)
        };
        (scene, Barrier::new(parameters, None, vec![1.0; 6], search))
    }

    /// Moves of both triangles towards each other.
    fn closer(by: f64) -> Vec<Vec3> {
        (0..6).map(|v| Vec3::new(0.0, 0.0, if v < 3 { by } else { -by })).collect()
    }

    /// A list made for a step that was not taken does not count from where another step ends.
    #[test]
    fn a_step_that_was_not_taken_moves_no_list() {
        let (scene, mut barrier) = stacked();
        let up = vec![Vec3::new(0.0, 0.0, 0.01); 6];
        assert!(barrier.update_lists(&scene.positions, &up) && barrier.lists.cloth.points.is_empty());
        let along = |x: &[Vec3], by: f64| -> Vec<Vec3> { x.iter().zip(closer(by)).map(|(p, d)| p + d).collect() };
        assert!(!barrier.update_lists(&scene.positions, &closer(0.03)), "the first lists hold");
        let x = along(&scene.positions, 0.03);
        barrier.step_taken(&x);
        let x = along(&x, 0.455);
        assert!(barrier.update_lists(&x, &closer(0.0066)));
        assert!(!barrier.lists.cloth.points.is_empty());
    }
}
