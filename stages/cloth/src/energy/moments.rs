//! Moments about the curvatures of a patch along the normal of its triangle.

use crate::energy::bending::Patch;
use crate::{Vec3, pick3};

/// The bend of a patch at some places.
pub(crate) struct Bent {
    /// Curvature vectors of the rows: √J with the rigidities of bending, 1 with rigidities of 1.
    pub bend: [Vec3; 3],
    /// Twice the triangle's area as a vector along its normal, m².
    area: Vec3,
}

impl Bent {
    pub fn new(patch: &Patch, x: &[Vec3]) -> Self {
        let [a, b, c] = pick3(x, &[0, 1, 2].map(|k: usize| patch.vertices[k]));
        Self { bend: patch.bend(x), area: (b - a).cross(&(c - a)) }
    }

    /// The triangle's normal; 0 without an area.
    pub fn normal(&self) -> Vec3 {
        self.area.try_normalize(0.0).unwrap_or_else(Vec3::zeros)
    }

    /// The vector m of which n · m is the work of moments on all rows, with the normal n.
    pub fn sum(&self, moments: &[f64; 3]) -> Vec3 {
        (0..3).map(|row| self.bend[row] * moments[row]).sum()
    }

    /// Adds the forces of moments that bend the patch further: the gradient of n · Σ moments · bend.
    pub fn push(&self, patch: &Patch, moments: &[f64; 3], x: &[Vec3], f: &mut [Vec3]) {
        let normal = self.normal();
        for (k, v) in patch.vertices.iter().enumerate() {
            let weight: f64 = (0..3).map(|row| moments[row] * patch.rows[row][k]).sum();
            f[*v as usize] += normal * weight;
        }
        // The normal turns with the corners: d(n · m) = (m − n (n · m)) · dN / |N|, with N = (b − a) × (c − a).
        let size = self.area.norm();
        if size > 0.0 {
            let moment = self.sum(moments);
            let across = (moment - normal * normal.dot(&moment)) / size;
            let corners = [0, 1, 2].map(|k: usize| patch.vertices[k]);
            let [a, b, c] = pick3(x, &corners);
            let (at_b, at_c) = ((c - a).cross(&across), across.cross(&(b - a)));
            f[corners[0] as usize] -= at_b + at_c;
            f[corners[1] as usize] += at_b;
            f[corners[2] as usize] += at_c;
        }
    }
}
