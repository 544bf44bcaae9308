//! Darts as they lie open on the flat piece, where a line crosses them.

use crate::alter::motion::Motion;
use crate::sewing::ring::{Gap, Ring, along, arcs, nearest_on};
use toile_formats::dxf::geom::{cross, inside};
use toile_garment::dart::DartKind;
use toile_garment::{Piece, Vec2};

/// A line may end this share of a segment beyond its ends.
const ENDS: f64 = 1e-6;
/// The direction of a leg is taken over this share of it to both sides.
const NEAR: f64 = 0.02;
/// A place this near to a leg lies on it, metres.
const ON_LEG: f64 = 1e-3;

/// A leg, measured by shares of its length: from the mouth to the point, or from one point of a fish-eye to the other.
#[derive(Clone, Debug)]
pub struct Leg {
    points: Vec<Vec2>,
    arc: Vec<f64>,
}

impl Leg {
    fn new(points: Vec<Vec2>) -> Self {
        let arc = arcs(&points, false);
        Self { points, arc }
    }

    /// Its length, metres.
    pub fn length(&self) -> f64 {
        self.arc.last().copied().unwrap_or_default()
    }

    /// The place at a share of its length.
    pub fn at(&self, share: f64) -> Vec2 {
        let s = share.clamp(0.0, 1.0) * self.length();
        let i = self.arc.partition_point(|a| *a <= s).clamp(1, self.arc.len().max(2) - 1) - 1;
        along(self.points[i], self.points[i + 1], self.arc[i], self.arc[i + 1], s)
    }

    /// Its direction at a share of its length.
    fn way(&self, share: f64) -> Vec2 {
        self.at(share + NEAR) - self.at(share - NEAR)
    }

    /// Its points between two shares, the ends included.
    pub fn part(&self, from: f64, to: f64) -> Vec<Vec2> {
        let [low, high] = [from, to].map(|share| share * self.length());
        let inner = self.points.iter().zip(&self.arc).filter(|(_, s)| low < **s && **s < high).map(|(p, _)| *p);
        std::iter::once(self.at(from)).chain(inner).chain([self.at(to)]).collect()
    }

    /// Where a segment meets it: shares of the segment and of the leg.
    pub fn hits(&self, [a, b]: [Vec2; 2]) -> Vec<[f64; 2]> {
        let within = -ENDS..=1.0 + ENDS;
        let legs = self.points.windows(2).zip(self.arc.windows(2));
        let hit = |(w, s): (&[Vec2], &[f64])| {
            let (u, v) = (b - a, w[1] - w[0]);
            let area = cross(u, v);
            let [t, k] = [cross(w[0] - a, v) / area, cross(w[0] - a, u) / area];
            let is_hit = area.abs() > 1e-15 && within.contains(&t) && within.contains(&k);
            is_hit.then(|| [t, (s[0] + k * (s[1] - s[0])) / self.length()])
        };
        legs.filter_map(hit).collect()
    }

    /// The leg where the cloth beside it has moved.
    pub fn moved(&self, motion: &Motion) -> Self {
        Self { points: self.points.iter().map(|p| motion.apply(*p)).collect(), arc: self.arc.clone() }
    }
}

/// A dart that lies open.
#[derive(Clone, Debug)]
pub struct Open<'r> {
    /// Number in the piece.
    pub dart: usize,
    /// Both legs: those of a wedge in the order of the outline.
    pub legs: [Leg; 2],
    /// Its place on the outline; none for a fish-eye.
    pub gap: Option<&'r Gap>,
}

impl<'r> Open<'r> {
    /// The darts of a piece whose cloth is not there: wedges, marked or cut, and fish-eyes.
    pub fn all(piece: &Piece, ring: &'r Ring) -> Vec<Self> {
        let n = ring.points.len();
        let walk = |from: usize, to: usize| (0..=(to + n - from) % n).map(|k| ring.points[(from + k) % n]).collect();
        let wedge = |gap: &'r Gap| {
            let (down, mut up): (Vec<Vec2>, Vec<Vec2>) = (walk(gap.from, gap.apex?), walk(gap.apex?, gap.to));
            up.reverse();
            Some(Self { dart: gap.dart, legs: [down, up].map(Leg::new), gap: Some(gap) })
        };
        let eyes = piece.darts.iter().enumerate().filter(|(_, d)| d.kind == DartKind::FishEye);
        let eyes = eyes.map(|(dart, d)| Self { dart, legs: d.legs.clone().map(Leg::new), gap: None });
        let has_legs = |open: &Self| open.legs.iter().all(|l| l.points.len() > 1 && l.length() > 0.0);
        ring.gaps.iter().filter_map(wedge).chain(eyes).filter(has_legs).collect()
    }

    fn polygon(&self) -> Vec<Vec2> {
        let [a, b] = &self.legs;
        a.points.iter().chain(b.points.iter().rev()).copied().collect()
    }

    /// A place that is meant to lie on a leg, or the place itself. `None`: it lies where no cloth is.
    pub fn placed(&self, p: Vec2) -> Option<Vec2> {
        let near = self.legs.each_ref().map(|l| nearest_on(&l.points, &l.arc, false, p));
        let [a, b] = near.map(|n| n.1);
        let (leg, (s, distance)) = if a <= b { (0, near[0]) } else { (1, near[1]) };
        if distance < ON_LEG {
            return Some(self.legs[leg].at(s / self.legs[leg].length()));
        }
        (!inside(p, &self.polygon())).then_some(p)
    }

    /// Where a segment crosses the dart: its share, the leg that it meets first, and the shares of the legs.
    pub fn crossed(&self, segment: [Vec2; 2]) -> Option<(f64, usize, [f64; 2])> {
        let [a, b] = segment;
        let polygon = self.polygon();
        let hits = self.legs.each_ref().map(|l| l.hits(segment));
        let pairs = hits[0].iter().flat_map(|x| hits[1].iter().map(move |y| (*x, *y)));
        let through = |(x, y): &([f64; 2], [f64; 2])| {
            (x[0] - y[0]).abs() > ENDS && inside(a + (b - a) * (x[0] + y[0]) / 2.0, &polygon)
        };
        let found = pairs.filter(through).min_by(|(a, b), (c, d)| (a[0] - b[0]).abs().total_cmp(&(c[0] - d[0]).abs()));
        found.map(|(x, y)| (x[0].min(y[0]), usize::from(y[0] < x[0]), [x[1], y[1]]))
    }

    /// The motion that closes the dart at a share of its legs: it carries the leg met last onto the one met first.
    pub fn closing(&self, first: usize, share: f64) -> Motion {
        let [a, b] = [first, 1 - first].map(|k| &self.legs[k]);
        Motion::onto(b.at(share), b.way(share), a.at(share), a.way(share))
    }

    /// How far the legs lie apart between the mouth and a share of them, once they are closed there, metres.
    pub fn misfit(&self, first: usize, share: f64) -> f64 {
        let closing = self.closing(first, share);
        let apart = |k: u32| {
            let share = share * f64::from(k) / 16.0;
            (closing.apply(self.legs[1 - first].at(share)) - self.legs[first].at(share)).norm()
        };
        (0..=16).map(apart).fold(0.0, f64::max)
    }
}
