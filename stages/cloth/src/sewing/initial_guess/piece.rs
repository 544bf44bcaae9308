//! A flat piece, and how it lies when it is bent about a line in its plane: as on a cylinder, so that no length in the cloth
//! changes.

use crate::sewing::tuning::{GUESS_DIRECTIONS, GUESS_FLATNESS};
use crate::{Element, Vec3};

/// Where the lines lie across the piece, from its middle (0) to its ends (−1 and 1).
const LINE_PLACES: [f64; 5] = [0.0, -0.5, 0.5, -1.0, 1.0];
/// Largest turn of a piece from its line to the farther end, rad.
const TURN_MOST: f64 = std::f64::consts::FRAC_PI_2;

/// A line in the plane of a piece.
#[derive(Clone, Copy, Debug)]
struct Line {
    at: Vec3,
    along: Vec3,
    across: Vec3,
    /// Largest curvature about it, 1/m.
    most: f64,
}

/// How a piece is bent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Bend {
    line: usize,
    /// 1/m, towards the side that the normal shows to.
    curvature: f64,
}

/// Vertices of one piece, flat where they are.
#[derive(Debug)]
pub(crate) struct Piece {
    pub vertices: Vec<u32>,
    /// Where they began.
    at: Vec<Vec3>,
    normal: Vec3,
    lines: Vec<Line>,
}

/// Normal of triangles that lie in one plane, and their mean weft in it, both of length one.
fn plane<'a>(triangles: impl Iterator<Item = &'a Element>, x: &[Vec3]) -> Option<[Vec3; 2]> {
    let (mut normal, mut weft) = (Vec3::zeros(), Vec3::zeros());
    for t in triangles {
        let [a, b, c] = crate::pick3(x, &t.vertices);
        let (area, [p, q, r]) = (t.area().abs(), t.gradients());
        normal += (b - a).cross(&(c - a));
        weft += (a * p[0] + b * q[0] + c * r[0]) * area;
    }
    let normal = normal.try_normalize(0.0)?;
    Some([normal, (weft - normal * weft.dot(&normal)).try_normalize(0.0)?])
}

impl Piece {
    /// `None` where it is not flat.
    pub fn new<'a>(vertices: Vec<u32>, triangles: impl Iterator<Item = &'a Element>, x: &[Vec3]) -> Option<Self> {
        let [normal, weft] = plane(triangles, x)?;
        let at: Vec<Vec3> = vertices.iter().map(|v| x[*v as usize]).collect();
        let middle = at.iter().sum::<Vec3>() / at.len() as f64;
        let size = at.iter().map(|p| (p - middle).norm()).fold(0.0, f64::max);
        // Nor is what lies beyond numbers.
        if !at.iter().all(|p| (p - middle).dot(&normal).abs() <= GUESS_FLATNESS.get() * size) {
            return None;
        }
        let warp = normal.cross(&weft);
        let directions_tried = GUESS_DIRECTIONS.get();
        let directions = (0..directions_tried).map(|k| {
            let (sin, cos) = libm::sincos(std::f64::consts::PI * f64::from(k) / f64::from(directions_tried));
            [weft * cos - warp * sin, weft * sin + warp * cos]
        });
        let lines = directions.flat_map(|d| lines(&at, &middle, d)).collect();
        Some(Self { vertices, at, normal, lines })
    }

    /// Where a place of the flat piece goes.
    pub fn place(&self, p: &Vec3, bend: Bend) -> Vec3 {
        if bend.curvature == 0.0 {
            return *p;
        }
        let (line, curvature) = (&self.lines[bend.line], bend.curvature);
        let d = p - line.at;
        let (sin, cos) = libm::sincos(d.dot(&line.across) * curvature);
        line.at
            + line.along * d.dot(&line.along)
            + line.across * (sin / curvature)
            + self.normal * ((1.0 - cos) / curvature)
    }

    /// Puts all its vertices where they go, among all places.
    pub fn put(&self, bend: Bend, x: &mut [Vec3]) {
        for (v, p) in self.vertices.iter().zip(&self.at) {
            x[*v as usize] = self.place(p, bend);
        }
    }

    /// Bends about all lines, so many to each side.
    pub fn bends(&self, each: i32) -> Vec<Bend> {
        let about = |line: usize| {
            let most = self.lines[line].most;
            let part = move |k: i32| f64::from(k) / f64::from(each);
            (-each..=each).filter(|k| *k != 0).map(move |k| Bend { line, curvature: part(k) * most })
        };
        (0..self.lines.len()).flat_map(about).collect()
    }

    /// The same bend with its curvature changed by these parts of the largest curvature.
    pub fn variants(&self, bend: Bend, parts: &[f64]) -> Vec<Bend> {
        let most = self.lines[bend.line].most;
        let more = |part: &f64| (bend.curvature + part * most).clamp(-most, most);
        parts.iter().map(|part| Bend { curvature: more(part), ..bend }).collect()
    }
}

impl Bend {
    /// So much of it.
    pub fn part(self, part: f64) -> Self {
        Self { curvature: part * self.curvature, ..self }
    }

    pub fn is_none(self) -> bool {
        self.curvature == 0.0
    }
}

/// Lines that run along the second of two directions.
fn lines(at: &[Vec3], middle: &Vec3, [across, along]: [Vec3; 2]) -> impl Iterator<Item = Line> {
    let start = [f64::INFINITY, f64::NEG_INFINITY];
    let span = at.iter().map(|p| (p - middle).dot(&across)).fold(start, |[low, high], s| [low.min(s), high.max(s)]);
    let (centre, half) = (0.5 * (span[0] + span[1]), 0.5 * (span[1] - span[0]));
    let (middle, farther) = (*middle, move |share: f64| (1.0 + share.abs()) * half);
    LINE_PLACES.into_iter().map(move |share| Line {
        at: middle + across * (centre + share * half),
        along,
        across,
        most: TURN_MOST / farther(share),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;
    use crate::optimize::test_sheets;

    fn piece(moved: impl Fn(Vec3) -> Vec3) -> Option<(Piece, Vec<Vec3>)> {
        let mut scene = Scene::default();
        test_sheets::add(&mut scene, 6, 0.3, 0.0, |_, _| false);
        let x: Vec<Vec3> = scene.positions.iter().map(|p| moved(*p)).collect();
        let all = (0u32..).take(x.len()).collect();
        Piece::new(all, scene.triangles.iter(), &x).map(|p| (p, x))
    }

    #[test]
    fn a_bent_piece_keeps_its_lengths_and_turns_by_a_right_angle_at_most() {
        let (piece, x) = piece(|p| p).expect("a flat piece");
        for bend in piece.bends(3) {
            let line = piece.lines[bend.line];
            let mut bent = x.clone();
            piece.put(bend, &mut bent);
            let mut most: f64 = 0.0;
            for (p, q) in x.iter().zip(&bent) {
                // Along the line nothing moves; across it an arc is as long as it was flat.
                assert!((p - q).dot(&line.along).abs() < 1e-12);
                let (s, radius) = ((p - line.at).dot(&line.across), 1.0 / bend.curvature);
                let from_axis = (q - line.at - piece.normal * radius) - line.along * (q - line.at).dot(&line.along);
                assert!((from_axis.norm() - radius.abs()).abs() < 1e-12 * radius.abs().max(1.0));
                most = most.max((s * bend.curvature).abs());
            }
            assert!(most < TURN_MOST + 1e-9, "{most}");
            // Neighbours in the mesh turn by a third of the most between them, and are a chord apart.
            for (a, b) in [(0usize, 1usize), (7, 14), (20, 27)] {
                let (flat, now) = ((x[a] - x[b]).norm(), (bent[a] - bent[b]).norm());
                assert!(now <= flat + 1e-12 && now > 0.98 * flat, "{flat} {now}");
            }
        }
    }

    #[test]
    fn cloth_that_is_not_flat_is_no_piece_to_bend() {
        assert!(piece(|p| p + Vec3::new(0.0, p.x * p.x, 0.0)).is_none());
        assert!(piece(|p| p * f64::NAN).is_none());
        assert!(piece(|p| p + Vec3::new(0.0, 1e-5 * libm::sin(40.0 * p.x), 0.0)).is_some());
    }
}
