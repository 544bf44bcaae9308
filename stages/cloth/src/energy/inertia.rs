//! Inertia and damping of one stage of a time step, as terms of the energy that a descent lowers.
//!
//! The terms are ½ r Σ m |x − x̃|² + s/(2h) Σ (x − b)ᵀ C (x − b), with the velocity (x − b)/h. The energy of the cloth
//! counts times s.

use crate::Vec3;
use crate::linear::hessian::Hessian;
use nalgebra::Matrix3;

/// The inertia term of a stage.
pub(crate) struct Inertia {
    /// Mass of every vertex, kg.
    pub mass: Vec<f64>,
    /// Factor r of the inertia, 1/s².
    pub rate: f64,
    /// Share s of the cloth's energy: ½ in the trapezoidal stage, whose other half acted at the start of the step.
    pub share: f64,
    /// Places x̃ to which the vertices would go by themselves, m.
    pub target: Vec<Vec3>,
    /// Places b from which velocities are taken, m.
    pub base: Vec<Vec3>,
    /// Time h of the velocities, s.
    pub h: f64,
    /// Damping of every vertex, C, kg/s.
    pub viscous: Vec<Matrix3<f64>>,
}

impl Inertia {
    /// Scales energy and forces of the cloth, adds those of inertia and damping, and returns the energy, J.
    pub fn evaluate(&self, x: &[Vec3], energy: f64, f: &mut [Vec3]) -> f64 {
        let mut sum = self.share * energy;
        let k = self.share / self.h;
        for i in 0..x.len() {
            let (d, e) = (x[i] - self.target[i], x[i] - self.base[i]);
            let (pull, drag) = (d * (self.rate * self.mass[i]), self.viscous[i] * e * k);
            sum += 0.5 * (d.dot(&pull) + e.dot(&drag));
            f[i] = f[i] * self.share - pull - drag;
        }
        sum
    }

    /// Scales the second derivatives of the cloth and adds those of the damping.
    ///
    /// The inertia is the shift of the preconditioner.
    pub fn add_hessian(&self, h: &mut Hessian) {
        if self.share != 1.0 {
            h.scale(self.share);
        }
        let k = self.share / self.h;
        for (v, c) in (0u32..).zip(&self.viscous) {
            h.add(v, &(c * k));
        }
    }
}
