//! Gravity (equation 4 of the paper) and dead loads.
//!
//! The paper gives every particle the same share of the weight. Here shares go by area, so that uneven meshes hang
//! evenly.

use crate::energy::Energy;
use crate::{Scene, Vec3};

/// Weight and dead loads of all vertices.
pub(crate) struct Weight {
    /// Force on every vertex, N.
    force: Vec<Vec3>,
}

impl Weight {
    /// The weight of a scene; `mass` is that of every vertex, kg.
    pub fn new(scene: &Scene, mass: &[f64], gravity_scale: f64) -> Self {
        let g = scene.gravity * gravity_scale;
        let mut force: Vec<Vec3> = mass.iter().map(|m| g * *m).collect();
        for l in &scene.loads {
            force[l.vertex as usize] += l.force;
        }
        Self { force }
    }
}

impl Energy for Weight {
    fn add_forces(&self, _: &[Vec3], f: &mut [Vec3]) {
        for (f, w) in f.iter_mut().zip(&self.force) {
            *f += w;
        }
    }

    fn energy(&self, x: &[Vec3]) -> f64 {
        -self.force.iter().zip(x).map(|(w, p)| w.dot(p)).sum::<f64>()
    }

    fn elastic(&self) -> bool {
        false
    }

    fn add_stiffness(&self, _: &[Vec3], _: &mut [f64]) {}
}
