//! Candidate pairs of cloth with cloth.

use crate::collision::broad_phase::self_search::SelfBroadPhase;
use crate::collision::crossings::count;
use crate::collision::narrow_phase::candidates::{ClothCandidates, LinearMotion};
use crate::scene::topology::Topology;
use crate::{Scene, Vec3};

/// Search for pairs of cloth with cloth.
pub(crate) struct SelfCollision(SelfBroadPhase);

impl SelfCollision {
    /// Makes the search for cloth that begins at `x`. `None` for a single triangle, which meets nothing.
    pub fn new(scene: &Scene, x: &[Vec3], topology: &Topology) -> Option<Self> {
        (topology.faces.len() > 1).then(|| Self(SelfBroadPhase::new(&scene.triangles, x, topology)))
    }

    /// Lists the pairs that come nearer than `reach` along a motion, m.
    pub fn list(&mut self, pairs: &mut ClothCandidates, motion: &LinearMotion<'_>, reach: f64) {
        pairs.remove_all();
        self.0.list(motion, reach, |f, g| pairs.add_pair(f, g, motion, reach));
    }

    /// Is the cloth surely free of crossings with itself?
    ///
    /// It tests fewer pairs than [`count::self_crossings`], and treats pairs that only touch less exactly.
    pub fn is_surely_free(&mut self, x: &[Vec3], topology: &Topology) -> bool {
        let (still, mut free) = (vec![Vec3::zeros(); x.len()], true);
        let motion = LinearMotion::new(x, &still, topology, &[]);
        self.0.list(&motion, 0.0, |f, g| {
            free = free && !count::cross(x, topology.faces[f as usize], topology.faces[g as usize])
        });
        free
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Element;
    use crate::contact::barrier::Barrier;
    use crate::contact::parameters::ContactParameters;

    const HEIGHT: f64 = 1.0055;

    /// Two triangles above each other, just beyond the reach of the first lists.
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
