//! Energies: one file each, each with a page in `docs/`. None knows of the others.

pub(crate) mod bending;
pub(crate) mod coupled;
pub(crate) mod hysteresis;
pub(crate) mod inertia;
pub(crate) mod law;
pub(crate) mod model;
pub(crate) mod patch;
#[cfg(feature = "pressure")]
pub(crate) mod pressure;
#[cfg(not(feature = "pressure"))]
#[path = "pressure_absent.rs"]
pub(crate) mod pressure;
pub(crate) mod shear;
pub(crate) mod springs;
pub(crate) mod stitch_penalty;
pub(crate) mod strain_limit;
pub(crate) mod structural;
#[cfg(test)]
pub(crate) mod tests;
pub(crate) mod weight;

use crate::Vec3;
use crate::linear::hessian::Hessian;

/// A potential of the positions.
pub(crate) trait Energy: Send + Sync {
    /// Adds minus the gradient, N.
    fn add_forces(&self, x: &[Vec3], f: &mut [Vec3]);
    /// J.
    fn energy(&self, x: &[Vec3]) -> f64;
    /// Both at once: adds the forces, gives the energy.
    fn evaluate(&self, x: &[Vec3], f: &mut [Vec3]) -> f64 {
        self.add_forces(x, f);
        self.energy(x)
    }
    /// How far off rounding may leave the energy of cloth that lies about so, J, where that does not go with the energy itself.
    fn noise(&self, _x: &[Vec3]) -> f64 {
        0.0
    }
    /// The largest strain that it knows of, along the threads; compressed is below 0.
    fn strain(&self, _x: &[Vec3]) -> f64 {
        f64::NEG_INFINITY
    }
    /// Is it stored in the cloth (and not weight or load)?
    fn elastic(&self) -> bool {
        true
    }
    /// Adds to every vertex a bound of its row sum of the stiffness, N/m, as the cloth stands now. The largest ratio
    /// of these to the masses bounds the square of the highest frequency.
    fn add_stiffness(&self, x: &[Vec3], k: &mut [f64]);
    /// Pairs of vertices that the second derivatives couple.
    fn add_pairs(&self, pairs: &mut Vec<[u32; 2]>);
    /// Adds the second derivatives, N/m; made positive semi-definite element by element where `convex` (the metric of a
    /// descent), as they are otherwise (the test of a minimum).
    fn add_hessian(&self, x: &[Vec3], convex: bool, h: &mut Hessian);
    /// What may stand for the second derivatives on a mesh too coarse for them to matter: fewer pairs …
    fn add_rough_pairs(&self, pairs: &mut Vec<[u32; 2]>) {
        self.add_pairs(pairs);
    }
    /// … and their stiffness, N/m.
    fn add_rough_hessian(&self, x: &[Vec3], convex: bool, h: &mut Hessian) {
        self.add_hessian(x, convex, h);
    }
    /// Is there such a thing?
    fn rough(&self) -> bool {
        false
    }
    /// Does cloth that lies so carry more anywhere than its curves, because it locks at its strain limits?
    fn is_locking(&self, _x: &[Vec3]) -> bool {
        false
    }
    /// Lets cloth lock over this share of its strain limits, never if it is infinite; says whether that is anything new.
    fn lock_over(&mut self, _locking: f64) -> bool {
        false
    }
    /// Are the second derivatives the same everywhere?
    fn quadratic(&self) -> bool {
        false
    }
}

/// What the cloth stores, J.
pub(crate) fn elastic(energies: &[Box<dyn Energy>], x: &[Vec3]) -> f64 {
    energies.iter().filter(|e| e.elastic()).map(|e| e.energy(x)).sum()
}

/// All pairs of an element's vertices.
pub(crate) fn clique(vertices: &[u32], pairs: &mut Vec<[u32; 2]>) {
    for i in 0..vertices.len() {
        for j in 0..i {
            pairs.push([vertices[i], vertices[j]]);
        }
    }
}
