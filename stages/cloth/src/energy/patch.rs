//! Curvature of a triangle from the folds of its hinges (docs/bending.md).
//!
//! It is that of the quadratic surface through the three corners of the triangle and the three corners across its
//! edges. A uniform curvature is met exactly on any mesh.

use crate::energy::tuning::PATCH_DETERMINANT_MIN;
use crate::scene::topology::Hinge;
use crate::{Element, Scene};
use nalgebra::{Matrix2, Matrix3, Matrix3x2, Vector2, Vector3};

/// Mean over the three components of a uniform moment.
const MEAN_OF_MOMENTS: f64 = 1.0 / 3.0;

/// The fold across one side of a triangle: u₂ + u₃ = Σ weights · x, u the unit vectors from the edge into the wings.
pub(crate) struct Fold {
    pub vertices: [u32; 4],
    /// Weights of the vertices, 1/m.
    pub weights: [f64; 4],
    /// Fold of the surface ½ κ(p, p) in the triangle's axes = along · (κ₀₀, κ₁₁, 2 κ₀₁), m.
    pub along: Vector3<f64>,
    /// Unit normal of the edge.
    pub normal: Vector2<f64>,
    /// Length of the edge in this triangle, m.
    pub length: f64,
    /// Squared length of the edge over the area of both wings.
    pub slimness: f64,
}

/// Foot of a wing's altitude on the edge (share of the way from end 0 to end 1), altitude and edge length.
fn wing(e: &Element, side: usize, reversed: bool) -> (f64, f64, f64) {
    let (a, b, c) = (e.rest[side], e.rest[(side + 1) % 3], e.rest[(side + 2) % 3]);
    let length = e.rest_length(side);
    let along = ((c[0] - a[0]) * (b[0] - a[0]) + (c[1] - a[1]) * (b[1] - a[1])) / (length * length);
    (if reversed { 1.0 - along } else { along }, 2.0 * e.area().abs() / length, length)
}

impl Fold {
    /// The fold of a hinge, in the axes of its face `own` (0 or 1).
    pub fn new(h: &Hinge, own: usize, scene: &Scene) -> Self {
        let element = |w: usize| &scene.triangles[h.faces[w] as usize];
        let (e, side) = (element(own), usize::from(h.sides[own]));
        let reversed = |w: usize| element(w).vertices[usize::from(h.sides[w])] != h.vertices[0];
        let wings = [0, 1].map(|w| wing(element(w), usize::from(h.sides[w]), reversed(w)));
        let mut weights = [0.0; 4];
        for (w, (along, altitude, _)) in wings.into_iter().enumerate() {
            weights[0] -= (1.0 - along) / altitude;
            weights[1] -= along / altitude;
            weights[2 + w] += 1.0 / altitude;
        }
        let point = |k: usize| Vector2::from(e.rest[k % 3]);
        let (a, b, c) = (point(side), point(side + 1), point(side + 2));
        let edge = (b - a) / wings[own].2;
        let mut normal = Vector2::new(-edge.y, edge.x);
        if normal.dot(&(c - a)) < 0.0 {
            normal = -normal;
        }
        // The places are counted from end 0 of the hinge, with the neighbour laid flat beside this triangle.
        let along_edge = if reversed(own) { a - b } else { b - a };
        let mut points = [Vector2::zeros(), along_edge, Vector2::zeros(), Vector2::zeros()];
        for (w, (along, altitude, _)) in wings.into_iter().enumerate() {
            let out = if w == own { altitude } else { -altitude };
            points[2 + w] = along_edge * along + normal * out;
        }
        let mut along = Vector3::zeros();
        for (p, w) in points.iter().zip(weights) {
            along += Vector3::new(p.x * p.x, p.y * p.y, p.x * p.y) * (0.5 * w);
        }
        let areas: f64 = (0..2).map(|w| element(w).area().abs()).sum();
        let slimness = wings[0].2 * wings[1].2 / areas;
        Self { vertices: h.vertices, weights, along, normal, length: wings[own].2, slimness }
    }
}

/// The symmetric part of a ⊗ b as (κ₀₀, κ₁₁, 2 κ₀₁).
pub(crate) fn voigt(a: Vector2<f64>, b: Vector2<f64>) -> Vector3<f64> {
    Vector3::new(a.x * b.x, a.y * b.y, a.x * b.y + a.y * b.x)
}

/// Parts of the curvature (κ₀₀, κ₁₁, 2 κ₀₁) of a triangle by each of its folds, 1/m.
pub(crate) type Parts = [Vector3<f64>; 3];

/// The parts of the curvature of a triangle by its folds; `None` where the folds do not determine it.
///
/// `open` is the direction of the free edge of a triangle with two folds. Nothing bends across that edge.
pub(crate) fn curvature(folds: &[Fold], open: Option<Vector2<f64>>) -> Option<Parts> {
    let norm = |f: &Fold| f.along.norm();
    match folds {
        [p, q, r] => {
            let m = Matrix3::from_rows(&[p, q, r].map(|f| f.along.transpose()));
            if m.determinant().abs() < PATCH_DETERMINANT_MIN.get() * norm(p) * norm(q) * norm(r) {
                return None;
            }
            let i = m.try_inverse()?;
            Some([0, 1, 2].map(|k| i.column(k).into_owned()))
        }
        [p, q] => {
            let t = open?;
            let n = Vector2::new(-t.y, t.x);
            let basis = Matrix3x2::from_columns(&[voigt(t, t), voigt(t, n)]);
            let m = Matrix2::from_rows(&[p, q].map(|f| f.along.transpose() * basis));
            if m.determinant().abs() < PATCH_DETERMINANT_MIN.get() * norm(p) * norm(q) {
                return None;
            }
            let c = basis * m.try_inverse()?;
            Some([c.column(0).into_owned(), c.column(1).into_owned(), Vector3::zeros()])
        }
        _ => None,
    }
}

/// Sums over the two triangles of a hinge: work of a unit moment on its fold, and energy of a unit fold.
///
/// Rigidities are (1, 1, ½).
#[derive(Clone, Copy, Default)]
pub(crate) struct Share {
    moment: Vector3<f64>,
    stored: f64,
    /// Number of triangles in the sums.
    triangles: u8,
}

/// Rigidities of an isotropic sheet against (κ₀₀, κ₁₁, 2 κ₀₁).
const ISOTROPIC_RIGIDITY: Vector3<f64> = Vector3::new(1.0, 1.0, 0.5);

impl Share {
    /// Adds a triangle with its area (m²) and its part of the curvature.
    pub fn add(&mut self, area: f64, part: &Vector3<f64>) {
        self.moment += part * area;
        self.stored += area * part.dot(&part.component_mul(&ISOTROPIC_RIGIDITY));
        self.triangles += 1;
    }

    /// Softening of the mesh by this hinge, m².
    ///
    /// On a mesh in balance a uniform moment does the work l n ⊗ n on a hinge. The rest bends the mesh out of the
    /// quadratic surface.
    pub fn softening(&self, length: f64, normal: Vector2<f64>) -> f64 {
        if self.triangles < 2 || self.stored <= 0.0 {
            return 0.0;
        }
        let left = self.moment - voigt(normal, normal) * length;
        MEAN_OF_MOMENTS * left.dot(&left.component_mul(&ISOTROPIC_RIGIDITY)) / self.stored
    }
}
