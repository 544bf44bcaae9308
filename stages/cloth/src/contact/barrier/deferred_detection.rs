//! Steps without a look at cloth near cloth: whether it was needed is told afterwards, by the straight way from where they
//! began to where they ended. A drape asks where cloth comes to lie, not which way it took: where nothing comes within its gap
//! along that way, the end is as free of crossings as the start, and no contact was left out there.

use crate::Vec3;
use crate::collision::narrow_phase::candidates::Way;
use crate::collision::narrow_phase::ccd::Pair;
use crate::collision::narrow_phase::pair_kind::PairKind;
use crate::contact::barrier::{Barrier, EDGE_SHARE, Sight, least, thick};
use crate::report::cost::{Lap, Work};

impl Barrier {
    /// Is cloth looked for beside cloth, and does none touch any, as the last evaluation saw it?
    pub fn may_look_away(&self) -> bool {
        // Touches of cloth with cloth come first.
        self.own.is_some() && self.touches.first().is_none_or(|t| !t.key.0.is_cloth_only())
    }

    /// From here on cloth is not looked for beside cloth …
    pub fn look_away(&mut self) {
        self.tally.ahead += 1;
        self.sight = Sight::Away;
        self.forget_own();
    }

    /// … and from here on it is.
    pub fn look_again(&mut self) {
        self.sight = Sight::Lost;
    }

    /// Does all cloth that is near cloth on the straight way from one place to another stay farther off than its gap?
    pub fn is_clear_between(&mut self, from: &[Vec3], to: &[Vec3]) -> bool {
        self.sight = Sight::Lost;
        let Some(own) = &mut self.own else { return true };
        let mut lap = Lap::start();
        let step: Vec<Vec3> = to.iter().zip(from).map(|(p, q)| p - q).collect();
        let way = Way::new(from, &step, &self.frame.topology, &self.frame.groups);
        own.list_once(&mut self.near, &way, thick(&self.frame.own_gap));
        let clear = self.stays_clear(from, &step);
        self.tally.back += u64::from(!clear);
        self.forget_own();
        self.tally.costs.spend(Work::SelfContact, &mut lap);
        clear
    }

    fn forget_own(&mut self) {
        self.near.clear_own();
        let [points, edges, ..] = &mut self.distances;
        points.clear();
        edges.clear();
    }

    /// Do all listed pairs of cloth stay farther off than their gaps along a step?
    fn stays_clear(&self, x: &[Vec3], step: &[Vec3]) -> bool {
        let clear = |v: &[u32; 4], kind: PairKind, share: f64| {
            let mut pair = Pair { at: crate::pick4(x, v), by: crate::pick4(step, v), kind };
            pair.stays_beyond(share * least(&self.frame.own_gap, v))
        };
        self.near.points.iter().all(|v| clear(v, PairKind::VertexTriangle, 1.0))
            && self.near.edges.iter().all(|v| clear(v, PairKind::EdgeEdge, EDGE_SHARE))
    }
}

#[cfg(all(test, feature = "self-contact"))]
mod tests {
    use super::*;
    use crate::collision::self_candidates::Own;
    use crate::contact::parameters::Frame;
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
        let own = Own::new(&scene, &scene.positions, &topology);
        let frame = Frame { own: true, ..Frame::plain(topology, vec![0.0; 6], vec![GAP; 6], 1.0) };
        let mut barrier = Barrier::new(frame, None, vec![1.0; 6], own);
        barrier.cover(&scene.positions, &[Vec3::zeros(); 6]);
        (barrier, scene.positions)
    }

    #[test]
    fn a_way_through_the_cloth_is_not_clear_however_free_its_end() {
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
    fn cloth_that_moves_along_together_stays_clear() {
        let (mut barrier, start) = stacked();
        let end: Vec<Vec3> = start.iter().map(|p| p + Vec3::new(3.0, 2.0, -7.0)).collect();
        assert!(barrier.is_clear_between(&start, &end));
    }

    #[test]
    fn after_a_look_away_lists_are_due() {
        let (mut barrier, start) = stacked();
        let still = [Vec3::zeros(); 6];
        assert!(!barrier.cover(&start, &still), "the first lists hold");
        barrier.look_away();
        assert!(!barrier.cover(&start, &still));
        barrier.look_again();
        assert!(barrier.cover(&start, &still) && !barrier.cover(&start, &still));
    }
}
