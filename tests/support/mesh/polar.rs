//! Sectors of discs and rings.

use super::{Family, Mesh, delaunay, jitter};
use std::f64::consts::TAU;
use toile_garment::Vec3;

/// A sector around the origin and its lines.
#[derive(Clone, Debug)]
pub struct Sector {
    pub mesh: Mesh,
    /// Vertices of every circle from the inner to the outer, each from angle 0 to the sector's angle.
    pub circles: Vec<Vec<usize>>,
    /// Radius of every circle, m.
    pub radii: Vec<f64>,
    /// Rad; more than a full turn is possible.
    pub angle: f64,
    /// Angle of every vertex, rad.
    pub angles: Vec<f64>,
}

/// A sector of `angle` (rad) between two radii with edges near `h`; an inner radius of 0 gives one vertex there.
pub fn sector(inner: f64, outer: f64, angle: f64, h: f64, family: Family) -> Sector {
    let count = ((outer - inner) / h).round().max(1.0) as usize;
    let radii: Vec<f64> = (0..=count).map(|k| inner + (outer - inner) * k as f64 / count as f64).collect();
    let mut rest: Vec<[f64; 2]> = Vec::new();
    let mut circles: Vec<Vec<usize>> = Vec::new();
    let mut angles: Vec<f64> = Vec::new();
    for r in &radii {
        let cells = if *r == 0.0 { 0 } else { (angle * r / h).round().max(2.0) as usize };
        circles.push((rest.len()..=rest.len() + cells).collect());
        let at = |i: usize| if cells == 0 { 0.0 } else { angle * i as f64 / cells as f64 };
        rest.extend((0..=cells).map(|i| [r * libm::cos(at(i)), r * libm::sin(at(i))]));
        angles.extend((0..=cells).map(at));
    }
    let mut triangles = Vec::new();
    for pair in circles.windows(2) {
        between(&pair[0], &pair[1], &mut triangles);
    }
    if family == Family::Irregular {
        let edge: Vec<usize> = circles.iter().flat_map(|c| [c[0], c[c.len() - 1]]).collect();
        let last = circles[circles.len() - 1].clone();
        let held: std::collections::BTreeSet<usize> =
            edge.into_iter().chain(circles[0].iter().copied()).chain(last).collect();
        let before = rest.clone();
        jitter::shake(&mut rest, 0.25 * h, |_| [1.0, 1.0]);
        held.iter().for_each(|v| rest[*v] = before[*v]);
        delaunay::flip(&rest, &mut triangles);
        for (a, p) in angles.iter_mut().zip(&rest).filter(|(_, p)| libm::hypot(p[0], p[1]) > 0.0) {
            let turn = libm::atan2(p[1], p[0]) - *a;
            *a += turn - TAU * (turn / TAU).round();
        }
    }
    let at = rest.iter().map(|r| Vec3::new(r[0], r[1], 0.0)).collect();
    Sector { mesh: Mesh { at, rest, triangles }, circles, radii, angle, angles }
}

impl Sector {
    /// The two straight sides as pairs, inside out.
    pub fn sides(&self) -> Vec<[usize; 2]> {
        self.circles.iter().map(|c| [c[0], c[c.len() - 1]]).filter(|[a, b]| a != b).collect()
    }

    /// Puts every vertex where its radius and angle say.
    pub fn place(mut self, to: impl Fn(f64, f64) -> Vec3) -> Self {
        let polar = self.mesh.rest.iter().map(|p| libm::hypot(p[0], p[1])).zip(&self.angles);
        self.mesh.at = polar.map(|(r, a)| to(r, *a)).collect();
        self
    }

    /// Bends the sector onto a cone without stretch: it goes `turn` (rad, ≤ 2π) round an axis that points up, the tip
    /// at the origin, the cloth below it.
    pub fn onto_cone(self, turn: f64) -> Self {
        let sine = self.angle / turn;
        let cosine = (1.0 - sine * sine).max(0.0).sqrt();
        self.place(|r, a| Vec3::new(r * sine * libm::cos(a / sine), r * sine * libm::sin(a / sine), -r * cosine))
    }
}

/// Triangles between two circles, walking by angle.
fn between(low: &[usize], high: &[usize], out: &mut Vec<[usize; 3]>) {
    let (n, m) = (low.len() - 1, high.len() - 1);
    let (mut i, mut j) = (0, 0);
    while i < n || j < m {
        let ahead = |k: usize, of: usize| (k as f64 + 0.5) / of as f64;
        if j >= m || (i < n && ahead(i, n) < ahead(j, m)) {
            out.push([low[i], high[j], low[i + 1]]);
            i += 1;
        } else {
            out.push([low[i], high[j], high[j + 1]]);
            j += 1;
        }
    }
}
