//! Energies: one file each, each with a page in `docs/`. None knows of the others.

pub(crate) mod bending;
pub(crate) mod bending_curve;
pub(crate) mod coupled;
pub(crate) mod elastic_band;
pub(crate) mod fold_line;
pub(crate) mod hysteresis;
pub(crate) mod inertia;
pub(crate) mod law;
pub(crate) mod model;
pub(crate) mod moments;
pub(crate) mod patch;
#[cfg(feature = "pressure")]
pub(crate) mod pressure;
#[cfg(not(feature = "pressure"))]
#[path = "pressure_absent.rs"]
pub(crate) mod pressure;
pub(crate) mod rest_curvature;
pub(crate) mod shear;
pub(crate) mod shear_curve;
pub(crate) mod springs;
pub(crate) mod stitch_penalty;
pub(crate) mod strain_limit;
pub(crate) mod structural;
#[cfg(test)]
pub(crate) mod tests;
pub(crate) mod tuning;
pub(crate) mod weight;

use crate::Vec3;
use crate::linear::hessian::Hessian;

/// A potential of the positions.
pub(crate) trait Energy: Send + Sync {
    /// Adds the forces at `x`, minus the gradient, N.
    fn add_forces(&self, x: &[Vec3], f: &mut [Vec3]);
    /// The energy at `x`, J.
    fn energy(&self, x: &[Vec3]) -> f64;
    /// Adds the forces at `x`, N, and returns the energy, J.
    fn evaluate(&self, x: &[Vec3], f: &mut [Vec3]) -> f64 {
        self.add_forces(x, f);
        self.energy(x)
    }
    /// Rounding error of the energy of cloth near `x`, J, where it is not in proportion to the energy itself.
    fn noise(&self, _x: &[Vec3]) -> f64 {
        0.0
    }
    /// Largest strain along warp and weft; below 0 where the cloth is compressed.
    fn strain(&self, _x: &[Vec3]) -> f64 {
        f64::NEG_INFINITY
    }
    /// Returns `true` for energy that is stored in the cloth, `false` for weight and loads.
    fn elastic(&self) -> bool {
        true
    }
    /// Adds to every vertex a bound of its row sum of the stiffness, N/m, as the cloth stands now. The largest ratio
    /// of these to the masses bounds the square of the highest frequency.
    fn add_stiffness(&self, x: &[Vec3], k: &mut [f64]);
    /// Emits springs between pairs of vertices, N/m: the part of the second derivatives that is the same everywhere and
    /// in all directions.
    fn springs(&self, _add: &mut dyn FnMut([u32; 2], f64)) {}
    /// Emits the springs of a surrogate Hessian, which has fewer pairs, for meshes too coarse for the full one to matter.
    fn surrogate_springs(&self, add: &mut dyn FnMut([u32; 2], f64)) {
        self.springs(add);
    }
    /// Returns `true` if there is a surrogate Hessian.
    fn has_surrogate(&self) -> bool {
        false
    }
    /// Pairs of vertices that the other second derivatives couple.
    fn add_pairs(&self, _pairs: &mut Vec<[u32; 2]>) {}
    /// Adds the second derivatives that are no springs, N/m.
    ///
    /// Where `convex`, they are made positive semi-definite element by element, for the preconditioner of a descent.
    /// They are full otherwise, for the test of a minimum.
    fn add_hessian(&self, _x: &[Vec3], _convex: bool, _h: &mut Hessian) {}
    /// Returns `true` if cloth at `x` locks anywhere at its strain limits and so carries more than its curves.
    fn is_locking(&self, _x: &[Vec3]) -> bool {
        false
    }
    /// Lets cloth lock over this share of its strain limits, or never if it is infinite. Returns `true` if that is a
    /// change.
    fn lock_over(&mut self, _locking: f64) -> bool {
        false
    }
}

/// Elastic energy that the cloth stores, J.
pub(crate) fn elastic(energies: &[Box<dyn Energy>], x: &[Vec3]) -> f64 {
    energies.iter().filter(|e| e.elastic()).map(|e| e.energy(x)).sum()
}

/// Adds all pairs of the vertices of an element.
pub(crate) fn clique(vertices: &[u32], pairs: &mut Vec<[u32; 2]>) {
    for i in 0..vertices.len() {
        for j in 0..i {
            pairs.push([vertices[i], vertices[j]]);
        }
    }
}
