//! Where an outline comes back to a place it has passed: at a vertex, or with a vertex on an edge.
//!
//! Crossings in the middle of two edges are [`geom::crossing`]'s. Lines drawn forth and back (slits, bridges) pass.

use super::geom;
use std::collections::BTreeSet;
use std::f64::consts::TAU;
use toile_garment::Vec2;

/// A vertex this near a vertex or an edge touches it, mm.
const TOUCH: f64 = 0.01;
/// Rays nearer to each other than this lie on each other, radians.
const SAME_RAY: f64 = 0.01;
/// Smaller loops between two passes are notches and rounding, mm round and mm².
const LOOP: (f64, f64) = (30.0, 25.0);
/// A loop of less area than this share of its length squared is a line drawn forth and back.
const FLAT: f64 = 1e-4;

/// The way an outline meets itself at a place it passes twice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Contact {
    /// It goes through itself there.
    Crosses(Vec2),
    /// It only touches itself.
    Touches(Vec2),
}

/// One pass: the place, and the neighbours before and after it.
struct Pass {
    at: Vec2,
    before: Vec2,
    after: Vec2,
}

struct Line<'a> {
    points: &'a [Vec2],
    /// Length and twice the area swept, up to each vertex.
    sums: Vec<(f64, f64)>,
}

impl<'a> Line<'a> {
    fn new(points: &'a [Vec2]) -> Self {
        let n = points.len();
        let (mut sums, mut sum) = (Vec::with_capacity(n + 1), (0.0, 0.0));
        for i in 0..=n {
            sums.push(sum);
            let (a, b) = (points[i % n] - points[0], points[(i + 1) % n] - points[0]);
            sum = (sum.0 + (b - a).norm(), sum.1 + geom::cross(a, b));
        }
        Self { points, sums }
    }

    /// Is the loop from vertex `from` on to vertex `to` and straight back no more than a detail?
    fn is_detail(&self, from: usize, to: usize) -> bool {
        let n = self.points.len();
        let (a, b, all) = (self.sums[from], self.sums[to], self.sums[n]);
        let turn = if to < from { all } else { (0.0, 0.0) };
        let (p, q) = (self.points[to] - self.points[0], self.points[from] - self.points[0]);
        let length = b.0 - a.0 + turn.0 + (p - q).norm();
        let area = 0.5 * (b.1 - a.1 + turn.1 + geom::cross(p, q)).abs();
        length < LOOP.0 || area < LOOP.1 || area < FLAT * length * length
    }

    /// The first vertex away from `i` that lies apart from it.
    fn beside(&self, i: usize, step: usize) -> Vec2 {
        let n = self.points.len();
        let apart = (1..9).map(|k| self.points[(i + k * step) % n]).find(|p| (p - self.points[i]).norm() > 5.0 * TOUCH);
        apart.unwrap_or(self.points[(i + step) % n])
    }

    fn vertex(&self, i: usize) -> Pass {
        let n = self.points.len();
        Pass { at: self.points[i], before: self.beside(i, n - 1), after: self.beside(i, 1) }
    }

    /// The contact of vertex `v` with segment `s`; `None` where they do not meet.
    fn judge(&self, v: usize, s: usize) -> Option<Contact> {
        let n = self.points.len();
        let (p, a, b) = (self.points[v], self.points[s], self.points[(s + 1) % n]);
        let (distance, t) = geom::point_segment(p, a, b);
        if distance > TOUCH {
            return None;
        }
        let length = (b - a).norm();
        let other = if t * length <= TOUCH {
            s
        } else if (1.0 - t) * length <= TOUCH {
            (s + 1) % n
        } else {
            // The segment itself goes through between its ends.
            let pass = Pass { at: p, before: a, after: b };
            return (!self.is_detail(v, s) && !self.is_detail((s + 1) % n, v))
                .then(|| meeting(&self.vertex(v), &pass))
                .flatten();
        };
        (!self.is_detail(v, other) && !self.is_detail(other, v))
            .then(|| meeting(&self.vertex(v), &self.vertex(other)))
            .flatten()
    }
}

/// Two passes of one place; `None` where they run along each other.
fn meeting(one: &Pass, two: &Pass) -> Option<Contact> {
    let at = one.at;
    let angle = |from: Vec2, p: Vec2| libm::atan2(p.y - from.y, p.x - from.x);
    let start = angle(at, one.before);
    let turned = |from: Vec2, p: Vec2| {
        let a = libm::fmod(angle(from, p) - start, TAU);
        if a < 0.0 { a + TAU } else { a }
    };
    let out = turned(at, one.after);
    let rays = [turned(two.at, two.before), turned(two.at, two.after)];
    let near = |a: f64, b: f64| {
        let d = (a - b).abs();
        d.min(TAU - d) < SAME_RAY
    };
    if rays.iter().any(|r| near(*r, 0.0) || near(*r, out)) {
        return None;
    }
    let crosses = (rays[0] < out) != (rays[1] < out);
    Some(if crosses { Contact::Crosses(at) } else { Contact::Touches(at) })
}

/// Do the boxes of two segments keep their distance?
fn apart(a: [Vec2; 2], b: [Vec2; 2]) -> bool {
    let off =
        |p: [f64; 2], q: [f64; 2]| p[0].min(p[1]) > q[0].max(q[1]) + TOUCH || q[0].min(q[1]) > p[0].max(p[1]) + TOUCH;
    off([a[0].x, a[1].x], [b[0].x, b[1].x]) || off([a[0].y, a[1].y], [b[0].y, b[1].y])
}

/// The first place where a closed line crosses itself at a vertex, else the places where it touches itself.
#[must_use]
pub fn contacts(points: &[Vec2]) -> Vec<Contact> {
    let n = points.len();
    if n < 4 {
        return Vec::new();
    }
    let line = Line::new(points);
    let mut found: Vec<(usize, Contact)> = Vec::new();
    let mut seen = BTreeSet::new();
    geom::near_pairs(points, TOUCH, &mut |j, i| {
        if apart([points[j], points[(j + 1) % n]], [points[i], points[(i + 1) % n]]) {
            return;
        }
        for (v, s) in [(i, j), (j, i), ((i + 1) % n, j), ((j + 1) % n, i)] {
            let own = v == s || v == (s + 1) % n;
            if !own
                && let Some(contact) = line.judge(v, s)
                && seen.insert((v, s))
            {
                found.push((v.min(s), contact));
            }
        }
    });
    found.sort_by_key(|f| f.0);
    let crosses = found.iter().map(|f| f.1).find(|c| matches!(c, Contact::Crosses(_)));
    if let Some(crosses) = crosses {
        return vec![crosses];
    }
    let mut places: Vec<Vec2> = Vec::new();
    for (_, contact) in found {
        let (Contact::Touches(p) | Contact::Crosses(p)) = contact;
        if places.len() < 8 && places.iter().all(|q| (q - p).norm() > 1.0) {
            places.push(p);
        }
    }
    places.into_iter().map(Contact::Touches).collect()
}

/// Tips of spikes without width that stand out of a closed line, with their lengths, if at least `least` mm long.
#[must_use]
pub fn outward_spikes(points: &[Vec2], least: f64) -> Vec<(Vec2, f64)> {
    let n = points.len();
    let mut out = Vec::new();
    for i in 0..n {
        let (before, tip, after) = (points[(i + n - 1) % n], points[i], points[(i + 1) % n]);
        let (u, v) = (before - tip, after - tip);
        if u.dot(&v) <= 0.0 || geom::cross(u, v).abs() > TOUCH * u.norm().max(v.norm()) {
            continue;
        }
        let length = spike_length(points, i);
        if length < least || out.len() >= 8 {
            continue;
        }
        let along = if u.norm() < v.norm() { u } else { v };
        let aside = Vec2::new(-along.y, along.x) * (0.05 / along.norm().max(1e-9));
        let middle = tip + along * 0.5;
        if [middle + aside, middle - aside].iter().all(|p| !geom::inside(*p, points)) {
            out.push((tip, length));
        }
    }
    out
}

/// How far the line runs back on itself from a tip.
fn spike_length(points: &[Vec2], tip: usize) -> f64 {
    let n = points.len();
    let mut length = 0.0;
    for k in 1..n / 2 {
        let (a, b) = (points[(tip + n - k) % n], points[(tip + k) % n]);
        let [from_a, from_b] = [points[(tip + n - k + 1) % n], points[(tip + k - 1) % n]];
        let (da, db) = ((a - from_a).norm(), (b - from_b).norm());
        if (a - b).norm() > TOUCH {
            let (u, v) = (a - from_a, b - from_b);
            let along = u.dot(&v) > 0.0 && geom::cross(u, v).abs() <= TOUCH * da.max(db);
            return length + if along { da.min(db) } else { 0.0 };
        }
        length += da.min(db);
    }
    length
}

#[cfg(test)]
mod tests {
    use super::*;

    fn v(list: &[(f64, f64)]) -> Vec<Vec2> {
        list.iter().map(|(x, y)| Vec2::new(*x, *y)).collect()
    }

    #[test]
    fn lobes_cross_or_touch_at_a_vertex() {
        let bow = v(&[(0.0, 0.0), (300.0, 0.0), (150.0, 300.0), (100.0, 400.0), (200.0, 400.0), (150.0, 300.0)]);
        assert_eq!(contacts(&bow), [Contact::Crosses(Vec2::new(150.0, 300.0))]);
        let pinch = v(&[(0.0, 0.0), (300.0, 0.0), (150.0, 300.0), (300.0, 600.0), (0.0, 600.0), (150.0, 300.0)]);
        assert_eq!(contacts(&pinch), [Contact::Touches(Vec2::new(150.0, 300.0))]);
        let on_edge = v(&[(0.0, 0.0), (300.0, 0.0), (300.0, 600.0), (150.0, 0.0), (0.0, 600.0)]);
        assert_eq!(contacts(&on_edge), [Contact::Touches(Vec2::new(150.0, 0.0))]);
        let through = v(&[(0.0, 0.0), (300.0, 0.0), (300.0, 600.0), (200.0, 0.0), (150.0, -90.0), (100.0, 0.0)]);
        assert!(matches!(contacts(&through)[..], [Contact::Crosses(_)]));
    }

    #[test]
    fn slits_bridges_and_plain_outlines_are_no_contacts() {
        let slit = v(&[
            (0.0, 0.0),
            (300.0, 0.0),
            (300.0, 300.0),
            (200.0, 300.0),
            (300.0, 300.0),
            (300.0, 600.0),
            (0.0, 600.0),
        ]);
        assert_eq!(contacts(&slit), []);
        assert_eq!(outward_spikes(&slit, 10.0), []);
        let spike = v(&[
            (0.0, 0.0),
            (300.0, 0.0),
            (300.0, 300.0),
            (340.0, 300.0),
            (300.0, 300.0),
            (300.0, 600.0),
            (0.0, 600.0),
        ]);
        assert_eq!(contacts(&spike), []);
        assert_eq!(outward_spikes(&spike, 10.0), [(Vec2::new(340.0, 300.0), 40.0)]);
    }
}
