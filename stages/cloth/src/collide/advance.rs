//! How far a step may go: continuous collision detection by additive conservative advancement (Li et al. 2021), so
//! that along an accepted step no near pair comes closer than a share of its distance, and nothing crosses.

use super::barrier::{BODY_EDGE, BODY_FACE, BODY_POINT, Barrier, EDGE, POINT};
use super::closest::{point_triangle_gap, segment_gap};
use crate::Vec3;
use crate::cost::{Lap, Work};

/// Share of its distance that a pair keeps in a step.
const KEEP: f64 = 0.2;
/// Nearer than this a pair comes only slowly, m: far above rounding, also to `f32`.
const NEAREST: f64 = 2e-5;
/// Share of a found time of impact that is used.
const SAFE: f64 = 0.9;
/// Rounds in which single vertices are held back before the whole step is shortened.
const ROUNDS: usize = 5;
const MOST_ADVANCES: usize = 64;
/// A pair that comes so near to a distance, over it, is said to reach it.
const NEARLY: f64 = 1e-3;

/// A pair: positions and displacements of its four points, and which of them are on the first side (its kind).
pub(super) struct Pair {
    pub at: [Vec3; 4],
    pub by: [Vec3; 4],
    pub kind: u8,
}

impl Pair {
    fn distance(&self) -> f64 {
        let [p, q, r, s] = &self.at;
        match self.kind {
            POINT | BODY_POINT => point_triangle_gap(p, [q, r, s]),
            BODY_FACE => point_triangle_gap(s, [p, q, r]),
            _ => segment_gap([p, q], [r, s]),
        }
    }

    /// Bound of how fast the two sides approach: largest displacements against their mean.
    fn pace(&mut self) -> f64 {
        let mean = (self.by[0] + self.by[1] + self.by[2] + self.by[3]) * 0.25;
        self.by.iter_mut().for_each(|d| *d -= mean);
        let n = self.by.map(|d| d.norm());
        match self.kind {
            POINT | BODY_POINT => n[0] + n[1].max(n[2]).max(n[3]),
            BODY_FACE => n[3] + n[0].max(n[1]).max(n[2]),
            _ => n[0].max(n[1]) + n[2].max(n[3]),
        }
    }

    /// Largest part (at most 1) of the displacement that keeps [`KEEP`] of the distance.
    fn free_part(&mut self, distance: f64) -> f64 {
        let pace = self.pace();
        let least = (KEEP * distance).max(NEAREST.min(0.8 * distance));
        if pace <= distance - least {
            return 1.0;
        }
        let (mut t, mut gap) = (0.0, distance);
        for _ in 0..MOST_ADVANCES {
            let step = SAFE * (gap - least) / pace;
            t += step;
            if t >= 1.0 {
                return 1.0;
            }
            for k in 0..4 {
                self.at[k] += self.by[k] * step;
            }
            gap = self.distance();
            if gap - least < 0.05 * (distance - least) {
                break;
            }
        }
        t
    }

    /// Does it stay farther apart than `least` all along the displacement? `false`, too, where that takes too long to tell.
    pub fn stays_beyond(&mut self, least: f64) -> bool {
        let (pace, mut left) = (self.pace(), 1.0);
        for _ in 0..MOST_ADVANCES {
            let room = self.distance() - least;
            if room <= NEARLY * least {
                return false;
            }
            if pace * left <= room {
                return true;
            }
            let step = room / pace;
            left -= step;
            (0..4).for_each(|k| self.at[k] += self.by[k] * step);
        }
        false
    }
}

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
        for (v, l) in self.near.points.iter().zip(&self.distances[usize::from(POINT)]) {
            test(Pair { at: crate::pick4(x, v), by: v.map(moved), kind: POINT }, *l, |part| hit(*v, 4, part));
        }
        for (v, l) in self.near.edges.iter().zip(&self.distances[usize::from(EDGE)]) {
            test(Pair { at: crate::pick4(x, v), by: v.map(moved), kind: EDGE }, *l, |part| hit(*v, 4, part));
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
                    Pair { at: [x[v as usize], a, b, c], by: [d, p, q, r], kind: BODY_POINT },
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
                look(Pair { at, by, kind: BODY_EDGE }, longest, *l, ([a, b, a, a], 2));
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
                    Pair { at, by: [d[0], d[1], d[2], body.moves(w)], kind: BODY_FACE },
                    longest,
                    *l,
                    ([a, b, c, a], 3),
                );
            }
        }
    }
}
