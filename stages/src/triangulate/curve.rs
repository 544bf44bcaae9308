//! The lines of a piece that become chains of mesh edges, and the places where they must have a vertex.

use crate::sewing::ring::{Ring, SAME, along, arcs, nearest_on};
use toile_garment::Vec2;

/// The kinds of curves of a piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurveKind {
    /// The outline, wedge darts notched out.
    Outline,
    /// Cutout of this index.
    Cutout(usize),
    /// The closed intake of the fish-eye dart of this index.
    FishEye(usize),
    /// The line of this index to which another piece is sewn.
    SeamLine(usize),
    /// Leg of a pleat: dart and leg.
    PleatLeg(usize, usize),
    /// Internal line of this index.
    Line(usize),
}

impl CurveKind {
    /// Does the cloth end there?
    pub fn bounds_cloth(self) -> bool {
        matches!(self, Self::Outline | Self::Cutout(_) | Self::FishEye(_))
    }
}

/// A line with arc length and breaks: arc positions that must be vertices, rising.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Its kind.
    pub kind: CurveKind,
    /// Points; a closed curve does not repeat the first.
    pub points: Vec<Vec2>,
    /// Arc positions of the points; closed curves hold the total as well.
    pub arc: Vec<f64>,
    /// True for a closed one.
    pub closed: bool,
    /// Arc positions that must be vertices, rising; ends of open curves among them.
    pub breaks: Vec<f64>,
}

impl Curve {
    /// A closed curve.
    pub fn ring(kind: CurveKind, ring: &Ring) -> Self {
        Self { kind, points: ring.points.clone(), arc: ring.arc.clone(), closed: true, breaks: Vec::new() }
    }

    /// An open or closed curve through clean points.
    pub fn line(kind: CurveKind, points: Vec<Vec2>, closed: bool) -> Self {
        let arc = arcs(&points, closed);
        let breaks = if closed { Vec::new() } else { vec![0.0, arc.last().copied().unwrap_or(0.0)] };
        Self { kind, points, arc, closed, breaks }
    }

    /// Length, metres.
    pub fn total(&self) -> f64 {
        self.arc.last().copied().unwrap_or(0.0)
    }

    /// A position within the curve: closed ones wrap, open ones end.
    pub fn wrap(&self, s: f64) -> f64 {
        let total = self.total();
        if !self.closed || total <= 0.0 {
            return s.clamp(0.0, total.max(0.0));
        }
        let s = s.rem_euclid(total);
        if total - s < SAME { 0.0 } else { s }
    }

    /// Distance walking forward.
    pub fn ahead(&self, from: f64, to: f64) -> f64 {
        if self.closed { self.wrap(to - from) } else { to - from }
    }

    /// The point at an arc position.
    pub fn at(&self, s: f64) -> Vec2 {
        let n = self.points.len();
        let s = self.wrap(s);
        let i = self.arc.partition_point(|a| *a <= s).clamp(1, n) - 1;
        if !self.closed && i + 1 >= n {
            return self.points[n - 1];
        }
        along(self.points[i], self.points[(i + 1) % n], self.arc[i], self.arc[i + 1], s)
    }

    /// Points from one position to a later one: both ends, and the drawn points between.
    pub fn between(&self, from: f64, to: f64) -> Vec<Vec2> {
        let ahead = |(p, s): (&Vec2, &f64)| (self.ahead(from, *s), *p);
        let mut inner: Vec<(f64, Vec2)> = self.points.iter().zip(&self.arc).map(ahead).collect();
        inner.retain(|(d, _)| *d > SAME && *d < to - from - SAME);
        inner.sort_by(|a, b| a.0.total_cmp(&b.0));
        std::iter::once(self.at(from)).chain(inner.into_iter().map(|(_, p)| p)).chain([self.at(to)]).collect()
    }

    /// Nearest position and its distance.
    pub fn project(&self, p: Vec2) -> (f64, f64) {
        nearest_on(&self.points, &self.arc, self.closed, p)
    }

    /// Distance along the curve to the nearest break.
    pub fn to_break(&self, s: f64) -> Option<(f64, f64)> {
        let distance = |b: f64| {
            let d = self.ahead(b, s).abs();
            if self.closed { d.min(self.total() - d) } else { d }
        };
        self.breaks.iter().map(|b| (*b, distance(*b))).min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The way from a position to the nearest break, if there is one within reach; negative against the curve.
    pub fn way_to_break(&self, s: f64, reach: f64) -> Option<f64> {
        let (b, d) = self.to_break(s).filter(|(_, d)| *d <= reach)?;
        let ahead = self.wrap(b) - self.wrap(s);
        let back = if self.closed { ahead.abs() > 0.5 * self.total() } else { false };
        Some(if (ahead < 0.0) != back { -d } else { d })
    }

    /// Adds a break; says whether it is new.
    pub fn add_break(&mut self, s: f64) -> bool {
        let s = self.wrap(s);
        if self.to_break(s).is_some_and(|(_, d)| d < SAME) {
            return false;
        }
        let at = self.breaks.partition_point(|b| *b < s);
        self.breaks.insert(at, s);
        true
    }

    /// Number of stretches between breaks.
    pub fn stretches(&self) -> usize {
        if self.closed { self.breaks.len() } else { self.breaks.len().saturating_sub(1) }
    }

    /// Start and length of a stretch.
    pub fn stretch(&self, k: usize) -> (f64, f64) {
        let from = self.breaks[k];
        let to = self.breaks[(k + 1) % self.breaks.len()];
        let length = self.ahead(from, to);
        (from, if length <= 0.0 { self.total() } else { length })
    }

    /// The stretch that holds a position inside.
    pub fn stretch_at(&self, s: f64) -> usize {
        let s = self.wrap(s);
        let after = self.breaks.partition_point(|b| *b <= s);
        if after == 0 {
            self.stretches().saturating_sub(1)
        } else {
            (after - 1).min(self.stretches().saturating_sub(1))
        }
    }

    /// Turning angle at point `i`, radians, without sign.
    pub fn turn(&self, i: usize) -> f64 {
        let n = self.points.len();
        if !self.closed && (i == 0 || i + 1 == n) {
            return 0.0;
        }
        let u = self.points[i] - self.points[(i + n - 1) % n];
        let v = self.points[(i + 1) % n] - self.points[i];
        libm::atan2(u.x * v.y - u.y * v.x, u.dot(&v)).abs()
    }

    /// Turning inside a stretch, its ends left out.
    pub fn turning(&self, k: usize) -> f64 {
        let (from, length) = self.stretch(k);
        (0..self.points.len())
            .filter(|i| {
                let d = self.ahead(from, self.arc[*i]);
                d > SAME && d < length - SAME
            })
            .map(|i| self.turn(i))
            .sum()
    }

    /// Puts a point of the curve's own path among its points, so that the break there is exactly that point.
    pub fn insert_point(&mut self, s: f64, p: Vec2) {
        let s = self.wrap(s);
        let i = self.arc.partition_point(|a| *a <= s).clamp(1, self.points.len());
        for near in [i - 1, i % self.points.len()] {
            if (self.points[near] - p).norm() < SAME {
                return;
            }
        }
        // Keep arc positions as they are: the point lies on the segment.
        self.points.insert(i, p);
        self.arc.insert(i, s);
    }
}
