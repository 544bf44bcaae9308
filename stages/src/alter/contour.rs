//! An outline that is being changed. Every vertex knows which stretch of the old outline begins at it.

use super::motion::Motion;
use crate::sewing::ring::{Gap, Ring};
use toile_formats::dxf::geom::{self, inside};
use toile_garment::outline::{LinePoint, OutlineEdge, PieceLine, PointKind};
use toile_garment::{Piece, Vec2};

/// A place this near to a vertex is the vertex, metres.
const SAME_VERTEX: f64 = 1e-4;
/// Parts of the old outline shorter than this are none, metres.
const NOTHING: f64 = 1e-7;
/// A vertex that turns more is a corner, radians.
const CORNER: f64 = 0.26;

/// A vertex.
#[derive(Clone, Copy, Debug)]
pub struct Vertex {
    /// Position, metres.
    pub at: Vec2,
    /// Kind.
    pub kind: PointKind,
    /// Arc positions on the old ring of the segment that begins here; none where that segment is new.
    pub stretch: Option<[f64; 2]>,
}

impl Vertex {
    /// A vertex at which a new segment begins.
    pub fn new(at: Vec2, kind: PointKind) -> Self {
        Self { at, kind, stretch: None }
    }

    /// The vertex where its cloth has moved.
    pub fn moved(&self, motion: &Motion) -> Self {
        Self { at: motion.apply(self.at), ..*self }
    }
}

/// Vertices as points of a line.
pub fn points(vertices: &[Vertex]) -> Vec<LinePoint> {
    vertices.iter().map(|v| LinePoint { at: v.at, kind: v.kind }).collect()
}

/// A closed outline, counter-clockwise.
#[derive(Clone, Debug, Default)]
pub struct Contour {
    /// Vertices in order.
    pub vertices: Vec<Vertex>,
}

/// A part of the old outline on the new one.
#[derive(Clone, Copy, Debug)]
pub struct Carried {
    /// Where it begins and ends on the way that was asked for, metres.
    pub way: [f64; 2],
    /// Its ends on the new outline, walked forward.
    pub ends: [Vec2; 2],
    /// Number of the new segment in its contour.
    pub segment: usize,
}

impl Contour {
    /// The outline of a piece as it is sewn: wedge darts are notched out.
    pub fn of(piece: &Piece, ring: &Ring) -> Self {
        let mut kinds = vec![None; ring.points.len()];
        for (line, at) in ring.of_line.iter().enumerate() {
            let Some((i, point)) = at.and_then(|i| Some((i, piece.outline.points.get(line)?))) else { continue };
            if kinds[i] != Some(PointKind::Turn) {
                kinds[i] = Some(point.kind);
            }
        }
        for gap in &ring.gaps {
            [Some(gap.from), gap.apex, Some(gap.to)]
                .into_iter()
                .flatten()
                .for_each(|i| kinds[i] = Some(PointKind::Turn));
        }
        let vertex = |(i, at): (usize, &Vec2)| Vertex {
            at: *at,
            kind: kinds[i].unwrap_or(PointKind::Plain),
            stretch: Some([ring.arc[i], ring.arc[i + 1]]),
        };
        Self { vertices: ring.points.iter().enumerate().map(vertex).collect() }
    }

    /// The segments of every edge between corners.
    pub fn edges(&self) -> Vec<Vec<usize>> {
        let n = self.vertices.len();
        let line = PieceLine { points: points(&self.vertices), closed: true, ..PieceLine::default() };
        let segments = |e: &OutlineEdge| {
            let (from, to) = (e.from as usize, e.to as usize);
            (0..=(to + n - from - 1) % n).map(|k| (from + k) % n).collect()
        };
        line.edges().iter().map(segments).collect()
    }

    /// Its area, m².
    pub fn area(&self) -> f64 {
        geom::area(&self.points())
    }

    /// Positions.
    pub fn points(&self) -> Vec<Vec2> {
        self.vertices.iter().map(|v| v.at).collect()
    }

    /// The number of the vertex at an arc position of the old ring, which gets a vertex where it has none.
    pub fn insert(&mut self, s: f64) -> usize {
        let n = self.vertices.len();
        let holds = |v: &Vertex| v.stretch.is_some_and(|[a, b]| a <= s + NOTHING && s <= b + NOTHING);
        let Some(k) = self.vertices.iter().position(holds) else { return 0 };
        let next = (k + 1) % n;
        let [a, b] = self.vertices[k].stretch.unwrap_or_default();
        if s - a < SAME_VERTEX {
            return k;
        }
        if b - s < SAME_VERTEX {
            return next;
        }
        let at = self.vertices[k].at + (self.vertices[next].at - self.vertices[k].at) * ((s - a) / (b - a));
        self.vertices[k].stretch = Some([a, s]);
        self.vertices.insert(k + 1, Vertex { at, kind: PointKind::Turn, stretch: Some([s, b]) });
        k + 1
    }

    /// The vertices of a dart on the old ring: mouth, point, mouth.
    pub fn dart(&self, ring: &Ring, gap: &Gap) -> Option<[usize; 3]> {
        let at = |i: usize| self.vertices.iter().position(|v| v.stretch.is_some_and(|[a, _]| a == ring.arc[i]));
        Some([at(gap.from)?, at(gap.apex?)?, at(gap.to)?])
    }

    /// The vertices from one to another, walked forward, both included. No segment of the old outline begins at the last.
    pub fn chain(&self, from: usize, to: usize) -> Vec<Vertex> {
        let n = self.vertices.len();
        let mut chain: Vec<Vertex> = (0..=(to + n - from) % n).map(|k| self.vertices[(from + k) % n]).collect();
        if let Some(last) = chain.last_mut() {
            last.stretch = None;
        }
        chain
    }

    /// The vertices between those nearest to two places, walked forward, both included.
    pub fn between(&self, from: Vec2, to: Vec2) -> Vec<Vertex> {
        let nearest = |p: Vec2| {
            let far = |k: &usize| (self.vertices[*k].at - p).norm();
            (0..self.vertices.len()).min_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or_default()
        };
        self.chain(nearest(from), nearest(to))
    }

    /// Drops vertices that lie on the vertex before them. It begins where the old outline began, or soon after, so that
    /// edges keep their numbers as far as they can.
    pub fn cleaned(mut self) -> Self {
        let begins = |v: &Vertex| v.stretch.map_or(f64::INFINITY, |[a, _]| a);
        let first = (0..self.vertices.len())
            .min_by(|i, k| begins(&self.vertices[*i]).total_cmp(&begins(&self.vertices[*k])))
            .unwrap_or(0);
        self.vertices.rotate_left(first);
        let mut kept: Vec<Vertex> = Vec::with_capacity(self.vertices.len());
        for v in self.vertices.drain(..) {
            match kept.last_mut() {
                Some(last) if (v.at - last.at).norm() < NOTHING => last.stretch = v.stretch.or(last.stretch),
                _ => kept.push(v),
            }
        }
        Self { vertices: kept }
    }

    /// Tells corners from smooth places at these vertices, by the angle at which the outline turns there.
    pub fn tell_kinds(&mut self, at: &[Vec2]) {
        let n = self.vertices.len();
        for i in 0..n {
            if at.iter().any(|p| (p - self.vertices[i].at).norm() < NOTHING) {
                let [a, b, c] = [(i + n - 1) % n, i, (i + 1) % n].map(|k| self.vertices[k].at);
                self.vertices[i].kind =
                    if geom::turn(a, b, c).abs() > CORNER { PointKind::Turn } else { PointKind::Plain };
            }
        }
    }

    /// The stretches of this contour that a walk along the old ring covers, in its order.
    pub fn carried(&self, ring: &Ring, from: f64, length: f64) -> Vec<Carried> {
        let n = self.vertices.len();
        let total = ring.total();
        let mut out = Vec::new();
        for (segment, vertex) in self.vertices.iter().enumerate() {
            let Some([a, b]) = vertex.stretch else { continue };
            let next = self.vertices[(segment + 1) % n].at;
            let begins = ring.ahead(from, a);
            for begins in [begins, begins - total] {
                let (start, end) = (begins.max(0.0), (begins + b - a).min(length));
                if end - start > NOTHING {
                    let at = |way: f64| vertex.at + (next - vertex.at) * ((way - begins) / (b - a)).clamp(0.0, 1.0);
                    out.push(Carried { way: [start, end], ends: [at(start), at(end)], segment });
                }
            }
        }
        out.sort_by(|x, y| x.way[0].total_cmp(&y.way[0]));
        out
    }

    /// Does a line between two places run inside, but for its ends on the outline?
    pub fn holds_line(&self, line: &[Vec2]) -> bool {
        let points = self.points();
        let n = points.len();
        let crosses = |p: Vec2, q: Vec2| (0..n).any(|i| do_cross([p, q], [points[i], points[(i + 1) % n]]));
        line.windows(2).all(|w| inside((w[0] + w[1]) / 2.0, &points) && !crosses(w[0], w[1]))
    }

    /// Two segments of it that cross, as the place where they do.
    pub fn crossing(&self) -> Option<Vec2> {
        let points = self.points();
        let n = points.len();
        let side = |i: usize| [points[i], points[(i + 1) % n]];
        let crossed = |i: usize| (i + 2..n).find(|k| do_cross(side(i), side(*k))).map(|_| points[i]);
        (0..n).find_map(crossed)
    }
}

/// Do two segments cross, each with its inner part?
pub fn do_cross([a, b]: [Vec2; 2], [c, d]: [Vec2; 2]) -> bool {
    let side = |p: Vec2, q: Vec2, r: Vec2| {
        let area = geom::cross(q - p, r - p);
        // Points nearer than a thousandth of a millimetre lie on the line.
        if area.abs() < 1e-6 * (q - p).norm().max(1e-12) { 0.0 } else { area.signum() }
    };
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}
