//! Cloth meshes and bodies of our own making.

pub mod body;
pub mod delaunay;
pub mod jitter;
pub mod polar;
pub mod sheet;

use std::fmt::Write as _;
use toile_garment::Vec3;

/// A triangle mesh: where it starts, and its rest layout (weft, warp), metres.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    pub at: Vec<Vec3>,
    /// Empty for a body.
    pub rest: Vec<[f64; 2]>,
    pub triangles: Vec<[usize; 3]>,
}

/// How the triangles lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Rows of (nearly) equilateral triangles.
    Regular,
    /// Squares, all cut along the same diagonal.
    Right,
    /// Regular rows, shaken and joined afresh.
    Irregular,
}

pub const FAMILIES: [Family; 3] = [Family::Regular, Family::Right, Family::Irregular];

impl Family {
    pub fn name(self) -> &'static str {
        match self {
            Self::Regular => "regular",
            Self::Right => "right",
            Self::Irregular => "irregular",
        }
    }
}

impl Mesh {
    /// Puts every vertex where its rest place says.
    pub fn place(mut self, to: impl Fn([f64; 2]) -> Vec3) -> Self {
        self.at = self.rest.iter().map(|r| to(*r)).collect();
        self
    }

    /// Turns the grain: a yarn of the warp then lies at `angle` (rad) to the mesh's second axis.
    pub fn turn(mut self, angle: f64) -> Self {
        let (s, c) = (libm::sin(angle), libm::cos(angle));
        self.rest.iter_mut().for_each(|r| *r = [c * r[0] - s * r[1], s * r[0] + c * r[1]]);
        self
    }

    /// Rest area of every vertex (m²) times a value at its rest place.
    pub fn weights(&self, of: impl Fn([f64; 2]) -> f64) -> Vec<f64> {
        let mut sum = vec![0.0; self.rest.len()];
        for t in &self.triangles {
            t.iter().for_each(|v| sum[*v] += area(&self.rest, t).abs() / 3.0);
        }
        sum.iter().zip(&self.rest).map(|(a, r)| a * of(*r)).collect()
    }

    /// Largest elongation of an edge over its rest length.
    pub fn stretch(&self, at: &[Vec3]) -> f64 {
        let of = |i: usize, j: usize| {
            let rest = libm::hypot(self.rest[j][0] - self.rest[i][0], self.rest[j][1] - self.rest[i][1]);
            (at[j] - at[i]).norm() / rest - 1.0
        };
        let edges = self.triangles.iter().flat_map(|t| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])]);
        edges.map(|(i, j)| of(i, j)).fold(f64::NEG_INFINITY, f64::max)
    }

    pub fn obj(&self) -> String {
        let mut text = String::new();
        for p in &self.at {
            let _ = writeln!(text, "v {} {} {}", p.x, p.y, p.z);
        }
        for [u, v] in &self.rest {
            let _ = writeln!(text, "vt {u} {v}");
        }
        for t in &self.triangles {
            text.push('f');
            for i in t.map(|i| i + 1) {
                let _ = if self.rest.is_empty() { write!(text, " {i}") } else { write!(text, " {i}/{i}") };
            }
            text.push('\n');
        }
        text
    }

    /// Adds another mesh; gives the index of its first vertex.
    pub fn join(&mut self, other: &Self) -> usize {
        let first = self.at.len();
        self.at.extend(&other.at);
        self.rest.extend(&other.rest);
        self.triangles.extend(other.triangles.iter().map(|t| t.map(|i| i + first)));
        first
    }

    /// Stitches that close a rectangle of this girth to a ring: its first side to its last.
    pub fn round(&self, girth: f64) -> Vec<[usize; 2]> {
        let side = |u: f64| self.pick(|r| (r[0] - u).abs() < 1e-9);
        side(0.0).into_iter().zip(side(girth)).map(|(a, b)| [a, b]).collect()
    }

    /// Vertices whose rest place answers to this.
    pub fn pick(&self, is: impl Fn([f64; 2]) -> bool) -> Vec<usize> {
        (0..self.rest.len()).filter(|i| is(self.rest[*i])).collect()
    }
}

/// Rest area of a triangle, m².
pub fn area(rest: &[[f64; 2]], t: &[usize; 3]) -> f64 {
    let [a, b, c] = t.map(|i| rest[i]);
    0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
}
