//! How far a descent may step before a near pair comes too close, and which vertices are held back where one does.

use crate::Vec3;
use crate::collision::narrow_phase::ccd::{Pair, SAFE};
use crate::collision::narrow_phase::pair_kind::PairKind;
use crate::contact::barrier::Barrier;
use crate::report::cost::{Lap, Work};

/// Rounds in which single vertices are held back before the whole step is shortened.
const ROUNDS: usize = 5;

fn test(mut pair: Pair, distance: f64, hit: impl FnOnce(f64)) {
    let part = pair.free_part(distance);
    if part < 1.0 {
        hit(part);
    }
}

impl Barrier {
    /// The part of `step` that may be taken; the distances of the last evaluation must be those at `x`, and the lists
    /// must cover the step.
    pub fn free_part(&mut self, x: &[Vec3], step: &[Vec3]) -> f64 {
        let mut whole: f64 = 1.0;
        self.each(x, step, |_, _, part| whole = whole.min(SAFE * part));
        whole
    }

    /// Holds single vertices back where their pairs would come too near. The step is another one then, which the lists
    /// need not cover.
    pub fn hold_back(&mut self, x: &[Vec3], step: &mut [Vec3]) {
        for _ in 0..ROUNDS {
            let mut scale = vec![1.0; x.len()];
            let mut any = false;
            self.each(x, step, |vertices, cloth, part| {
                any = true;
                for v in &vertices[..cloth] {
                    let s: &mut f64 = &mut scale[*v as usize];
                    *s = s.min(SAFE * part);
                }
            });
            if !any {
                break;
            }
            step.iter_mut().zip(&scale).for_each(|(d, s)| *d *= *s);
        }
    }

    /// Calls `hit` for every pair that the step brings too near.
    fn each(&mut self, x: &[Vec3], step: &[Vec3], mut hit: impl FnMut([u32; 4], usize, f64)) {
        let mut lap = Lap::start();
        self.each_own(x, step, &mut hit);
        self.tally.costs.spend(Work::SelfContact, &mut lap);
        self.each_of_body(x, step, &mut hit);
        self.tally.costs.spend(Work::BodyContact, &mut lap);
    }

    fn each_own(&self, x: &[Vec3], step: &[Vec3], hit: &mut impl FnMut([u32; 4], usize, f64)) {
        let moved = |v: u32| step[v as usize];
        for (v, l) in self.near.points.iter().zip(&self.distances[PairKind::VertexTriangle as usize]) {
            test(Pair { at: crate::pick4(x, v), by: v.map(moved), kind: PairKind::VertexTriangle }, *l, |part| {
                hit(*v, 4, part)
            });
        }
        for (v, l) in self.near.edges.iter().zip(&self.distances[PairKind::EdgeEdge as usize]) {
            test(Pair { at: crate::pick4(x, v), by: v.map(moved), kind: PairKind::EdgeEdge }, *l, |part| {
                hit(*v, 4, part)
            });
        }
    }

    fn each_of_body(&self, x: &[Vec3], step: &[Vec3], hit: &mut impl FnMut([u32; 4], usize, f64)) {
        let moved = |v: u32| step[v as usize];
        let Some(body) = &self.body else { return };
        let [_, _, points, edges, faces] = &self.distances;
        let near = |longest: f64, l: f64| body.travels() || longest > 0.2 * l;
        // What was put down may be less than the distance.
        let mut look = |pair: Pair, longest: f64, l: f64, cloth: ([u32; 4], usize)| {
            let l = if body.travels() { l } else { pair.distance() };
            if near(longest, l) {
                test(pair, l, |part| hit(cloth.0, cloth.1, part));
            }
        };
        for (pair, l) in self.against.points.iter().zip(points) {
            let [v, g] = pair.vertices;
            let (d, longest) = (moved(v), moved(v).norm());
            if near(longest, *l) {
                let [a, b, c] = body.triangle(g);
                let [p, q, r] = body.topology.faces[g as usize].map(|w| body.moves(w));
                look(
                    Pair { at: [x[v as usize], a, b, c], by: [d, p, q, r], kind: PairKind::VertexBodyTriangle },
                    longest,
                    *l,
                    ([v; 4], 1),
                );
            }
        }
        for (pair, l) in self.against.edges.iter().zip(edges) {
            let [a, b, p, q] = pair.vertices;
            let (da, db) = (moved(a), moved(b));
            let longest = da.norm().max(db.norm());
            if near(longest, *l) {
                let at = [x[a as usize], x[b as usize], body.positions[p as usize], body.positions[q as usize]];
                let by = [da, db, body.moves(p), body.moves(q)];
                look(Pair { at, by, kind: PairKind::EdgeBodyEdge }, longest, *l, ([a, b, a, a], 2));
            }
        }
        for (pair, l) in self.against.faces.iter().zip(faces) {
            let [a, b, c, w] = pair.vertices;
            let d = [a, b, c].map(moved);
            let longest = d.iter().fold(0.0, |l: f64, d| l.max(d.norm()));
            if near(longest, *l) {
                let [p, q, r] = crate::pick3(x, &[a, b, c]);
                let at = [p, q, r, body.positions[w as usize]];
                look(
                    Pair { at, by: [d[0], d[1], d[2], body.moves(w)], kind: PairKind::TriangleBodyVertex },
                    longest,
                    *l,
                    ([a, b, c, a], 3),
                );
            }
        }
    }
}
