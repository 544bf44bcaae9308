//! Deferred detection of self-contact: steps without a search for pairs of cloth with cloth.
//!
//! A proof follows the steps, on the straight way from where they began to where they ended. Where no cloth comes
//! within its gap along that way, the end is as free of crossings as the start, and no contact was left out there.
//! The equilibrium solver may do so because only the place where the cloth comes to rest counts, not the way to it.

use crate::Vec3;
use crate::collision::narrow_phase::candidates::LinearMotion;
use crate::collision::narrow_phase::ccd::MovingPair;
use crate::collision::narrow_phase::pair_kind::PairKind;
use crate::contact::barrier::Barrier;
use crate::contact::barrier::active_contact::{largest_gap, smallest_gap};
use crate::contact::barrier::candidate_lists::SelfDetection;
use crate::contact::tuning::EDGE_GAP_SHARE;
use crate::report::cost::{CpuTimer, Work};

impl Barrier {
    /// May the detection of self-contact be deferred? It may where the last evaluation found no such contact.
    pub fn may_defer_self_detection(&self) -> bool {
        // Contacts of cloth with cloth come first.
        let is_free = self.contacts.first().is_none_or(|t| !t.key.0.is_cloth_only());
        self.lists.self_collision.is_some() && is_free
    }

    /// Stops the search for pairs of cloth with cloth until [`Self::resume_self_detection`].
    pub fn defer_self_detection(&mut self) {
        self.statistics.deferred_blocks += 1;
        self.lists.self_detection = SelfDetection::Deferred;
        self.clear_self_pairs();
    }

    /// Resumes the search for pairs of cloth with cloth.
    pub fn resume_self_detection(&mut self) {
        self.lists.self_detection = SelfDetection::Due;
    }

    /// Does all cloth stay farther from other cloth than its gap on the straight way between two places?
    pub fn is_clear_between(&mut self, from: &[Vec3], to: &[Vec3]) -> bool {
        self.lists.self_detection = SelfDetection::Due;
        let Some(search) = &mut self.lists.self_collision else { return true };
        let mut lap = CpuTimer::start();
        let step: Vec<Vec3> = to.iter().zip(from).map(|(p, q)| p - q).collect();
        let motion = LinearMotion::new(from, &step, &self.parameters.topology, &self.parameters.stitch_groups);
        search.list(&mut self.lists.cloth, &motion, largest_gap(&self.parameters.self_gap));
        let clear = self.listed_pairs_stay_clear(from, &step);
        self.statistics.rolled_back_blocks += u64::from(!clear);
        self.clear_self_pairs();
        self.statistics.costs.spend(Work::SelfContact, &mut lap);
        clear
    }

    fn clear_self_pairs(&mut self) {
        self.lists.cloth.remove_all();
        let [points, edges, ..] = &mut self.distances;
        points.clear();
        edges.clear();
    }

    /// Do all listed pairs of cloth with cloth stay farther apart than their gaps along a step?
    fn listed_pairs_stay_clear(&self, x: &[Vec3], step: &[Vec3]) -> bool {
        let clear = |v: &[u32; 4], kind: PairKind, share: f64| {
            let mut pair = MovingPair { at: crate::pick4(x, v), by: crate::pick4(step, v), kind };
            pair.stays_beyond(share * smallest_gap(&self.parameters.self_gap, v))
        };
        let (pairs, edge_share) = (&self.lists.cloth, EDGE_GAP_SHARE.get());
        pairs.points.iter().all(|v| clear(v, PairKind::VertexTriangle, 1.0))
            && pairs.edges.iter().all(|v| clear(v, PairKind::EdgeEdge, edge_share))
    }
}

#[cfg(all(test, feature = "self-contact"))]
mod tests {
    use super::*;
    use crate::collision::self_candidates::SelfCollision;
    use crate::contact::parameters::ContactParameters;
    use crate::scene::topology::Topology;
    use crate::{Element, Scene};

    const GAP: f64 = 1e-2;

    /// Two triangles, the second above the first.
    fn stacked() -> (Barrier, Vec<Vec3>) {
        let rest = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let mut scene = Scene::default();
        for (n, z) in [(0, 0.0), (3, 0.3)] {
            scene.positions.extend(rest.map(|[x, y]| Vec3::new(x, y, z)));
            scene.triangles.push(Element { vertices: [n, n + 1, n + 2], rest, material: 0 });
        }
        let topology = Topology::of_elements(6, &scene.triangles);
        let search = SelfCollision::new(&scene, &scene.positions, &topology);
        let plain = ContactParameters::plain(topology, vec![0.0; 6], vec![GAP; 6], 1.0);
        let parameters = ContactParameters { has_self_contact: true, ..plain };
        let mut barrier = Barrier::new(parameters, None, vec![1.0; 6], search);
        barrier.update_lists(&scene.positions, &[Vec3::zeros(); 6]);
        (barrier, scene.positions)
    }

    #[test]
    fn a_way_through_the_cloth_is_not_clear_although_its_end_is() {
        let (mut barrier, start) = stacked();
        let mut clear = |down: f64, aside: f64| {
            let mut end = start.clone();
            end[3..].iter_mut().for_each(|p| *p += Vec3::new(aside, 0.0, -down));
            barrier.is_clear_between(&start, &end)
        };
        assert!(clear(0.0, 0.0) && clear(-5.0, 0.0));
        assert!(
            clear(0.3 - 1.1 * GAP, 0.0) && !clear(0.3 - 0.9 * GAP, 0.0),
            "within its gap it would have been pushed"
        );
        assert!(!clear(0.6, 0.0), "it went through");
        assert!(clear(0.6, 4.0), "it went past");
    }

    #[test]
    fn cloth_that_moves_as_one_stays_clear() {
        let (mut barrier, start) = stacked();
        let end: Vec<Vec3> = start.iter().map(|p| p + Vec3::new(3.0, 2.0, -7.0)).collect();
        assert!(barrier.is_clear_between(&start, &end));
    }

    #[test]
    fn after_deferred_detection_lists_are_due() {
        let (mut barrier, start) = stacked();
        let still = [Vec3::zeros(); 6];
        assert!(!barrier.update_lists(&start, &still), "the first lists hold");
        barrier.defer_self_detection();
        assert!(!barrier.update_lists(&start, &still));
        barrier.resume_self_detection();
        assert!(barrier.update_lists(&start, &still) && !barrier.update_lists(&start, &still));
    }
}
