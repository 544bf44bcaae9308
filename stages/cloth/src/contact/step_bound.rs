//! Bounds of a step by continuous collision detection: a largest fraction of the step, or shorter moves of single
//! vertices.

use crate::Vec3;
use crate::collision::body::Body;
use crate::collision::narrow_phase::ccd::{FREE_MOTION_SHARE, MovingPair};
use crate::collision::narrow_phase::pair_kind::PairKind;
use crate::collision::tuning::IMPACT_FRACTION_USED;
use crate::contact::barrier::Barrier;
use crate::contact::tuning::{VERTEX_TRUNCATION, VERTEX_TRUNCATION_ROUNDS};
use crate::report::cost::{CpuTimer, Work};

/// A pair that a step brings too near: vertices of the cloth, their number, and the part of the step up to there.
type Hit = ([u32; 4], usize, f64);

/// Calls `hit` with the vertices of the cloth if the pair allows only a part of its motion.
fn test(mut pair: MovingPair, distance: f64, cloth: ([u32; 4], usize), hit: &mut impl FnMut(Hit)) {
    let part = pair.max_step_fraction(distance);
    if part < 1.0 {
        hit((cloth.0, cloth.1, part));
    }
}

impl Barrier {
    /// The largest fraction of `step` that may be taken.
    ///
    /// The distances of the last evaluation must be those at `x`, and the lists must cover the step.
    pub fn max_step_fraction(&mut self, x: &[Vec3], step: &[Vec3]) -> f64 {
        let used = IMPACT_FRACTION_USED.get();
        let mut whole: f64 = 1.0;
        self.for_each_hit(x, step, |(_, _, part)| whole = whole.min(used * part));
        whole
    }

    /// Shortens the moves of single vertices whose pairs would come too near.
    ///
    /// The lists need not cover the step that results.
    pub fn truncate_vertices(&mut self, x: &[Vec3], step: &mut [Vec3]) {
        if !VERTEX_TRUNCATION.is_on() {
            return;
        }
        let used = IMPACT_FRACTION_USED.get();
        for _ in 0..VERTEX_TRUNCATION_ROUNDS.get() {
            let mut scale = vec![1.0; x.len()];
            let mut any = false;
            self.for_each_hit(x, step, |(vertices, cloth, part)| {
                any = true;
                for v in &vertices[..cloth] {
                    let s: &mut f64 = &mut scale[*v as usize];
                    *s = s.min(used * part);
                }
            });
            if !any {
                break;
            }
            step.iter_mut().zip(&scale).for_each(|(d, s)| *d *= *s);
        }
    }

    /// Calls `hit` for every pair that the step brings too near.
    fn for_each_hit(&mut self, x: &[Vec3], step: &[Vec3], mut hit: impl FnMut(Hit)) {
        let mut lap = CpuTimer::start();
        self.for_each_self_hit(x, step, &mut hit);
        self.statistics.costs.spend(Work::SelfContact, &mut lap);
        if let Some(body) = &self.body {
            let pairs = BodyPairs { barrier: self, body, x, step };
            pairs.for_each_vertex_hit(&mut hit);
            pairs.for_each_edge_hit(&mut hit);
            pairs.for_each_face_hit(&mut hit);
        }
        self.statistics.costs.spend(Work::BodyContact, &mut lap);
    }

    fn for_each_self_hit(&self, x: &[Vec3], step: &[Vec3], hit: &mut impl FnMut(Hit)) {
        let lists =
            [(&self.lists.cloth.points, PairKind::VertexTriangle), (&self.lists.cloth.edges, PairKind::EdgeEdge)];
        for (pairs, kind) in lists {
            for (v, distance) in pairs.iter().zip(&self.distances[kind as usize]) {
                test(MovingPair { at: crate::pick4(x, v), by: crate::pick4(step, v), kind }, *distance, (*v, 4), hit);
            }
        }
    }
}

/// The listed pairs of cloth and body, and a step of the cloth.
struct BodyPairs<'a> {
    barrier: &'a Barrier,
    body: &'a Body,
    x: &'a [Vec3],
    step: &'a [Vec3],
}

impl BodyPairs<'_> {
    #[inline]
    fn displacement(&self, v: u32) -> Vec3 {
        self.step[v as usize]
    }

    /// Can a pair at this distance, m, come too near when cloth moves by at most `longest`, m?
    #[inline]
    fn may_hit(&self, longest: f64, distance: f64) -> bool {
        self.body.is_moving() || longest > FREE_MOTION_SHARE * distance
    }

    fn test(&self, pair: MovingPair, longest: f64, listed: f64, cloth: ([u32; 4], usize), hit: &mut impl FnMut(Hit)) {
        // The listed distance may be a lower bound.
        let distance = if self.body.is_moving() { listed } else { pair.distance() };
        if self.may_hit(longest, distance) {
            test(pair, distance, cloth, hit);
        }
    }

    fn for_each_vertex_hit(&self, hit: &mut impl FnMut(Hit)) {
        let distances = &self.barrier.distances[PairKind::VertexBodyTriangle as usize];
        for (pair, listed) in self.barrier.lists.body.points.iter().zip(distances) {
            let [v, g] = pair.vertices;
            let (d, longest) = (self.displacement(v), self.displacement(v).norm());
            if self.may_hit(longest, *listed) {
                let [a, b, c] = self.body.triangle(g);
                let [p, q, r] = self.body.topology.faces[g as usize].map(|w| self.body.displacement(w));
                let kind = PairKind::VertexBodyTriangle;
                let pair = MovingPair { at: [self.x[v as usize], a, b, c], by: [d, p, q, r], kind };
                self.test(pair, longest, *listed, ([v; 4], 1), hit);
            }
        }
    }

    fn for_each_edge_hit(&self, hit: &mut impl FnMut(Hit)) {
        let (x, y) = (self.x, &self.body.positions);
        let distances = &self.barrier.distances[PairKind::EdgeBodyEdge as usize];
        for (pair, listed) in self.barrier.lists.body.edges.iter().zip(distances) {
            let [a, b, p, q] = pair.vertices;
            let (da, db) = (self.displacement(a), self.displacement(b));
            let longest = da.norm().max(db.norm());
            if self.may_hit(longest, *listed) {
                let at = [x[a as usize], x[b as usize], y[p as usize], y[q as usize]];
                let by = [da, db, self.body.displacement(p), self.body.displacement(q)];
                let pair = MovingPair { at, by, kind: PairKind::EdgeBodyEdge };
                self.test(pair, longest, *listed, ([a, b, a, a], 2), hit);
            }
        }
    }

    fn for_each_face_hit(&self, hit: &mut impl FnMut(Hit)) {
        let distances = &self.barrier.distances[PairKind::TriangleBodyVertex as usize];
        for (pair, listed) in self.barrier.lists.body.faces.iter().zip(distances) {
            let [a, b, c, w] = pair.vertices;
            let d = [a, b, c].map(|v| self.displacement(v));
            let longest = d.iter().fold(0.0, |l: f64, d| l.max(d.norm()));
            if self.may_hit(longest, *listed) {
                let [p, q, r] = crate::pick3(self.x, &[a, b, c]);
                let at = [p, q, r, self.body.positions[w as usize]];
                let by = [d[0], d[1], d[2], self.body.displacement(w)];
                let pair = MovingPair { at, by, kind: PairKind::TriangleBodyVertex };
                self.test(pair, longest, *listed, ([a, b, c, a], 3), hit);
            }
        }
    }
}
