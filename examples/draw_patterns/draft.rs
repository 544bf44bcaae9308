//! Drafting: edges of straight lines and curves, mirroring about the centre, solving for a measure.

use toile_garment::Vec2;

/// Steps of the dense copy between two vertices of a curve.
const DENSE: usize = 5;

/// A run of the outline between two corners.
#[derive(Clone, Debug)]
pub struct Edge {
    /// Its name, for checks.
    pub name: &'static str,
    /// Fine points.
    dense: Vec<Vec2>,
    /// Which of the fine points are vertices of the pattern.
    marked: Vec<usize>,
}

/// A point.
pub fn at(x: f64, y: f64) -> Vec2 {
    Vec2::new(x, y)
}

/// Unit vector at an angle in degrees from +x.
pub fn towards(degrees: f64) -> Vec2 {
    let r = degrees.to_radians();
    Vec2::new(libm::cos(r), libm::sin(r))
}

/// Turned a quarter to the left.
pub fn left(v: Vec2) -> Vec2 {
    Vec2::new(-v.y, v.x)
}

/// Turned about a point, degrees counter-clockwise.
pub fn turned(p: Vec2, about: Vec2, degrees: f64) -> Vec2 {
    let (u, d) = (towards(degrees), p - about);
    about + Vec2::new(u.x * d.x - u.y * d.y, u.y * d.x + u.x * d.y)
}

impl Edge {
    /// An edge that starts here; continue with [`Self::line`] and [`Self::curve`].
    pub fn start(name: &'static str, from: Vec2) -> Self {
        Self { name, dense: vec![from], marked: vec![0] }
    }

    /// A straight edge.
    pub fn straight(name: &'static str, from: Vec2, to: Vec2) -> Self {
        Self::start(name, from).line(to, 1)
    }

    /// Goes on straight, with `n` vertices, so that readers that draw smooth curves through the vertices stay straight.
    pub fn line(mut self, to: Vec2, n: usize) -> Self {
        let from = self.last();
        for i in 1..=n {
            self.push(from + (to - from) * (i as f64 / n as f64), true);
        }
        self
    }

    /// Goes on in a smooth curve of `n` steps that leaves along `leave` and arrives along `arrive`.
    /// The reach of both handles is a share of the chord.
    pub fn curve(mut self, leave: Vec2, to: Vec2, arrive: Vec2, reach: [f64; 2], n: usize) -> Self {
        let from = self.last();
        let chord = (to - from).norm();
        let (p, q) = (from + leave.normalize() * (chord * reach[0]), to - arrive.normalize() * (chord * reach[1]));
        let steps = n * DENSE;
        for i in 1..=steps {
            let t = i as f64 / steps as f64;
            let s = 1.0 - t;
            let point = from * (s * s * s) + p * (3.0 * s * s * t) + q * (3.0 * s * t * t) + to * (t * t * t);
            self.push(point, i % DENSE == 0);
        }
        self
    }

    /// Goes on along a circle about a centre, in `n` steps, by degrees counter-clockwise.
    pub fn arc(mut self, about: Vec2, degrees: f64, n: usize) -> Self {
        let from = self.last();
        let steps = n * DENSE;
        for i in 1..=steps {
            self.push(turned(from, about, degrees * i as f64 / steps as f64), i % DENSE == 0);
        }
        self
    }

    fn push(&mut self, point: Vec2, marked: bool) {
        if marked {
            self.marked.push(self.dense.len());
        }
        self.dense.push(point);
    }

    /// First point.
    pub fn first(&self) -> Vec2 {
        self.dense[0]
    }

    /// Last point.
    pub fn last(&self) -> Vec2 {
        self.dense[self.dense.len() - 1]
    }

    /// Fine points.
    pub fn dense(&self) -> &[Vec2] {
        &self.dense
    }

    /// Is this fine point a vertex of the pattern?
    pub fn is_marked(&self, i: usize) -> bool {
        self.marked.binary_search(&i).is_ok()
    }

    /// Length of the fine line, mm.
    pub fn length(&self) -> f64 {
        self.dense.windows(2).map(|w| (w[1] - w[0]).norm()).sum()
    }

    /// The fine segment and the share of it at a distance from the start.
    pub fn locate(&self, distance: f64) -> (usize, f64) {
        let mut rest = distance;
        for (i, w) in self.dense.windows(2).enumerate() {
            let d = (w[1] - w[0]).norm();
            if rest <= d || i + 2 == self.dense.len() {
                return (i, (rest / d).min(1.0));
            }
            rest -= d;
        }
        (0, 0.0)
    }

    /// The point at a distance from the start.
    fn point(&self, distance: f64) -> Vec2 {
        let (i, share) = self.locate(distance);
        self.dense[i] + (self.dense[i + 1] - self.dense[i]) * share
    }

    /// The parts before and after a distance from the start, with names and steps of their own: sizes are then alike.
    pub fn cut(&self, distance: f64, names: [&'static str; 2], steps: [usize; 2]) -> [Self; 2] {
        let ends = [[0.0, distance], [distance, self.length()]];
        [0, 1].map(|k| {
            let ([from, to], n) = (ends[k], steps[k] * DENSE);
            let first = if k == 0 { self.first() } else { self.point(from) };
            let mut part = Self::start(names[k], first);
            for i in 1..=n {
                let last = k == 1 && i == n;
                let p = if last { self.last() } else { self.point(from + (to - from) * i as f64 / n as f64) };
                part.push(p, i % DENSE == 0);
            }
            part
        })
    }

    /// The same edge turned about a point, degrees counter-clockwise.
    pub fn turned(mut self, about: Vec2, degrees: f64) -> Self {
        self.dense.iter_mut().for_each(|p| *p = turned(*p, about, degrees));
        self
    }

    /// The same edge walked the other way.
    pub fn reversed(mut self) -> Self {
        let n = self.dense.len();
        self.dense.reverse();
        self.marked = self.marked.iter().rev().map(|i| n - 1 - i).collect();
        self
    }

    /// x → −x, walked the other way, so that a mirrored outline stays counter-clockwise.
    pub fn mirrored(mut self, name: &'static str) -> Self {
        self.name = name;
        for p in &mut self.dense {
            p.x = -p.x;
        }
        self.reversed()
    }

    /// This edge and a following one as one.
    pub fn then(mut self, next: Self) -> Self {
        let offset = self.dense.len() - 1;
        self.dense.extend(&next.dense[1..]);
        self.marked.extend(next.marked[1..].iter().map(|i| i + offset));
        self
    }
}

/// A whole outline from its right half, which runs counter-clockwise from the lower to the upper centre.
/// The first edge of the result is the one across the lower centre, from left to right.
pub fn whole(half: &[Edge], left_name: impl Fn(&'static str) -> &'static str) -> Vec<Edge> {
    let (first, last) = (&half[0], &half[half.len() - 1]);
    let inner = &half[1..half.len() - 1];
    let mut out = vec![first.clone().mirrored(first.name).then(first.clone())];
    out.extend(inner.iter().cloned());
    out.push(last.clone().then(last.clone().mirrored(last.name)));
    out.extend(inner.iter().rev().map(|e| e.clone().mirrored(left_name(e.name))));
    out
}

/// A band from its lower left corner: lower edge, right end, upper edge, left end.
pub fn band(names: [&'static str; 4], length: f64, height: f64) -> Vec<Edge> {
    let corners = [at(0.0, 0.0), at(length, 0.0), at(length, height), at(0.0, height)];
    let edge = |i: usize| Edge::straight(names[i], corners[i], corners[(i + 1) % 4]);
    (0..4).map(edge).collect()
}

/// The x in `lo..hi` at which a rising or falling function is zero.
pub fn solve(mut lo: f64, mut hi: f64, f: impl Fn(f64) -> f64) -> f64 {
    let rising = f(hi) > f(lo);
    for _ in 0..100 {
        let mid = 0.5 * (lo + hi);
        if (f(mid) > 0.0) == rising { hi = mid } else { lo = mid }
    }
    0.5 * (lo + hi)
}

/// Sum of the lengths of edges.
#[cfg(test)]
pub fn length(edges: &[Edge]) -> f64 {
    edges.iter().map(Edge::length).sum()
}
