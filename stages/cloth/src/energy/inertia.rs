//! Inertia and damping of one stage of a time step, as terms of the energy that a descent lowers:
//! ½ r Σ m |x − x̃|² + s/(2h) Σ (x − b)ᵀ C (x − b), with the velocity (x − b)/h, and the cloth's own energy times s.

use crate::Vec3;
use crate::linear::hessian::Hessian;
use nalgebra::Matrix3;

pub(crate) struct Inert {
    /// kg, per vertex.
    pub mass: Vec<f64>,
    /// r, 1/s².
    pub rate: f64,
    /// Share s of the cloth's energy: ½ in the trapezoidal stage, whose other half acted at the start of the step.
    pub share: f64,
    /// Where the vertices would go by themselves, x̃, m.
    pub target: Vec<Vec3>,
    /// b, m.
    pub base: Vec<Vec3>,
    /// h, s.
    pub h: f64,
    /// Damping of every vertex, C, kg/s.
    pub viscous: Vec<Matrix3<f64>>,
}

impl Inert {
    /// Scales what the cloth gave so far, adds inertia and damping; the energy, J.
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

    /// Scales the cloth's second derivatives and adds those of the damping; the inertia is the metric's shift.
    pub fn add_hessian(&self, h: &mut Hessian) {
        if self.share != 1.0 {
            h.values.iter_mut().for_each(|v| *v *= self.share);
            h.extra.iter_mut().for_each(|e| e.2 *= self.share);
        }
        let k = self.share / self.h;
        for (v, c) in (0u32..).zip(&self.viscous) {
            h.add(v, &(c * k));
        }
    }
}
