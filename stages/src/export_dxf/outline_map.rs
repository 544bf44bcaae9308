//! The outline of a piece before and after, vertex by vertex, and how lines beside it (cut line, notches) follow.

use super::carry::{by_nearest, chain_rides};
use toile_garment::dart::DartKind;
use toile_garment::{Piece, Vec2};

/// Two segments nearer to parallel than this (sine of the turn) have no corner to rebuild.
const SMOOTH: f64 = 0.01;
/// A rebuilt corner lies this near to the turned one, as a share of its distance from the line; else it is a spike.
const SPIKE: f64 = 0.2;

/// Moves every vertex of the outline.
///
/// Vertices that are mesh vertices go where those went. Those between ride on the chain edge beside them, so that a
/// curve that was finer than the mesh stays as fine. `None` when the mesh does not follow the outline.
pub fn moved_outline(piece: &Piece, flat: &[Vec2]) -> Option<Vec<Vec2>> {
    let mesh = piece.mesh.as_ref()?;
    let chain = &mesh.outline()?.vertices;
    let points = &piece.outline.points;
    let n = points.len();
    let anchors: Vec<(usize, usize)> = (0..n)
        .filter_map(|i| {
            let v = (*mesh.outline_vertex.get(i)?)?;
            Some((i, chain.iter().position(|c| *c == v)?))
        })
        .collect();
    if anchors.len() < 2 {
        return None;
    }
    let mut out: Vec<Vec2> = points.iter().map(|p| p.at).collect();
    for (k, (i, c)) in anchors.iter().enumerate() {
        let (j, d) = anchors[(k + 1) % anchors.len()];
        *out.get_mut(*i)? = *flat.get(*chain.get(*c)? as usize)?;
        let steps = (d + chain.len() - c) % chain.len();
        let mut run: Vec<u32> = (0..=steps).map(|s| chain[(c + s) % chain.len()]).collect();
        if marked_mouth(piece, points[*i].at, points[j].at) {
            // The mesh goes round the intake, the outline straight over the mouth.
            run = vec![chain[*c], chain[d]];
        }
        let rides = chain_rides(mesh, flat, &run, false);
        let between = (j + n - i) % n;
        for s in 1..between {
            let at = (i + s) % n;
            *out.get_mut(at)? = by_nearest(&rides, points[at].at)?;
        }
    }
    Some(out)
}

fn marked_mouth(piece: &Piece, a: Vec2, b: Vec2) -> bool {
    let same = |p: Vec2, q: Vec2| (p - q).norm() < 1e-6;
    piece.darts.iter().filter(|d| d.kind == DartKind::MarkedWedge).any(|d| {
        let [m, n] = d.mouth;
        (same(m, a) && same(n, b)) || (same(m, b) && same(n, a))
    })
}

/// A closed line before and after, that points beside it follow.
pub struct Follow {
    from: Vec<Vec2>,
    to: Vec<Vec2>,
}

/// Where a point beside a line belongs.
enum Foot {
    /// Within the segment that starts at this vertex.
    Segment(usize),
    /// At this vertex.
    Vertex(usize),
}

impl Follow {
    /// The outline, bridged over the mouths of wedge darts that the cut line does not follow.
    pub fn new(piece: &Piece, moved: &[Vec2]) -> Self {
        let points: Vec<Vec2> = piece.outline.positions();
        let cut: Vec<Vec2> = piece.cut_line.as_ref().map(|l| l.positions()).unwrap_or_default();
        let mut kept = vec![true; points.len()];
        for dart in piece.darts.iter().filter(|d| d.kind == DartKind::Wedge) {
            let Some(apex) = dart.apexes.first() else { continue };
            let [m0, m1] = dart.mouth;
            let triangle = [m0, *apex, m1];
            if cut.iter().any(|p| inside(*p, triangle)) {
                continue;
            }
            let find = |q: Vec2| points.iter().position(|p| (p - q).norm() < 1e-6);
            let (Some(a), Some(b)) = (find(m0), find(m1)) else { continue };
            let n = points.len();
            for s in 1..(b + n - a) % n {
                kept[(a + s) % n] = false;
            }
        }
        let pick = |all: &[Vec2]| all.iter().zip(&kept).filter(|(_, k)| **k).map(|(p, _)| *p).collect();
        Self { from: pick(&points), to: pick(moved) }
    }

    /// Carries a point that lies beside the line, and says by what angle (radians) its surroundings turned.
    ///
    /// A point beside a segment keeps its distance from it; one at a corner keeps its distances from both sides.
    pub fn carry(&self, p: Vec2) -> (Vec2, f64) {
        match self.foot(p) {
            Some(Foot::Segment(i)) => self.beside(i, p),
            Some(Foot::Vertex(i)) => self.at_vertex(i, p),
            None => (p, 0.0),
        }
    }

    fn segment(line: &[Vec2], i: usize) -> [Vec2; 2] {
        [line[i], line[(i + 1) % line.len()]]
    }

    fn turn(&self, i: usize) -> f64 {
        let angle = |[a, b]: [Vec2; 2]| libm::atan2(b.y - a.y, b.x - a.x);
        wrap(angle(Self::segment(&self.to, i)) - angle(Self::segment(&self.from, i)))
    }

    fn foot(&self, p: Vec2) -> Option<Foot> {
        let mut best: Option<(f64, Foot)> = None;
        let n = self.from.len();
        for i in 0..n {
            let [a, b] = Self::segment(&self.from, i);
            let d = b - a;
            if d.norm_squared() < 1e-18 {
                continue;
            }
            let t = ((p - a).dot(&d) / d.norm_squared()).clamp(0.0, 1.0);
            let gap = (a + d * t - p).norm_squared();
            // A foot within 1 µm of a vertex is that vertex, so that both its sides count.
            let slack = 1e-6 / d.norm();
            let foot = match t {
                _ if t <= slack => Foot::Vertex(i),
                _ if t >= 1.0 - slack => Foot::Vertex((i + 1) % n),
                _ => Foot::Segment(i),
            };
            if best.as_ref().is_none_or(|(g, _)| gap < *g) {
                best = Some((gap, foot));
            }
        }
        best.map(|(_, foot)| foot)
    }

    /// The same share along the segment, the same distance from it.
    fn beside(&self, i: usize, p: Vec2) -> (Vec2, f64) {
        let (from, to) = (Self::segment(&self.from, i), Self::segment(&self.to, i));
        let (d, e) = (from[1] - from[0], to[1] - to[0]);
        let t = (p - from[0]).dot(&d) / d.norm_squared();
        let height = offset(p, from);
        (to[0] + e * t + left(e) * height, self.turn(i))
    }

    fn at_vertex(&self, i: usize, p: Vec2) -> (Vec2, f64) {
        let n = self.from.len();
        let before = (i + n - 1) % n;
        let (a, b) = (self.turn(before), self.turn(i));
        let mean = a + wrap(b - a) / 2.0;
        let turned = self.to[i] + rotate(p - self.from[i], mean);
        let sides = [before, i].map(|k| (Self::segment(&self.from, k), Self::segment(&self.to, k)));
        let rebuilt = meet(sides[0].1, offset(p, sides[0].0), sides[1].1, offset(p, sides[1].0));
        let arm = (p - self.from[i]).norm();
        (rebuilt.filter(|r| (r - turned).norm() <= SPIKE * arm).unwrap_or(turned), mean)
    }
}

/// Signed distance to the left of a segment's line.
fn offset(p: Vec2, [a, b]: [Vec2; 2]) -> f64 {
    left(b - a).dot(&(p - a))
}

/// Unit vector to the left.
fn left(d: Vec2) -> Vec2 {
    let n = d.norm();
    if n > 0.0 { Vec2::new(-d.y, d.x) / n } else { Vec2::zeros() }
}

fn rotate(v: Vec2, angle: f64) -> Vec2 {
    let (s, c) = libm::sincos(angle);
    Vec2::new(c * v.x - s * v.y, s * v.x + c * v.y)
}

fn wrap(angle: f64) -> f64 {
    let turns = libm::round(angle / std::f64::consts::TAU);
    angle - turns * std::f64::consts::TAU
}

/// Where two lines, moved to the left by these distances, meet; `None` for lines that hardly turn.
fn meet([a, b]: [Vec2; 2], up: f64, [c, d]: [Vec2; 2], vp: f64) -> Option<Vec2> {
    let (u, v) = (left(b - a), left(d - c));
    let cross = u.x * v.y - u.y * v.x;
    if cross.abs() < SMOOTH {
        return None;
    }
    let (p, q) = (u.dot(&a) + up, v.dot(&c) + vp);
    Some(Vec2::new((p * v.y - q * u.y) / cross, (q * u.x - p * v.x) / cross))
}

fn inside(p: Vec2, [a, b, c]: [Vec2; 3]) -> bool {
    let side = |a: Vec2, b: Vec2| (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) > 0.0;
    let s = side(a, b);
    s == side(b, c) && s == side(c, a)
}
