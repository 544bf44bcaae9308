//! Shear springs of the paper (class 2: the cloth's shear), on the edges that lie off the grain (docs/shear.md).

use crate::energy::Energy;
use crate::energy::structural::{Spring, add_spring_hessian, pull, row_sums, springs};
use crate::linear::hessian::Hessian;
use crate::scene::topology::Topology;
use crate::{Scene, Vec3};

/// The shear springs of a cloth.
pub(crate) struct Shear {
    springs: Vec<Spring>,
    /// Shear stiffness G of every material, N/m.
    stiffness: Vec<f64>,
}

impl Shear {
    pub fn new(scene: &Scene, topology: &Topology) -> Self {
        let mut springs = springs(scene, topology);
        springs.retain(|s| s.share[2] > 1e-12);
        Self { springs, stiffness: scene.materials.iter().map(|m| m.shear).collect() }
    }

    /// Stiffness of a spring per section, N/m.
    fn modulus(&self, s: &Spring) -> f64 {
        s.share[2] * self.stiffness[s.fabric as usize]
    }
}

impl Energy for Shear {
    fn add_forces(&self, x: &[Vec3], f: &mut [Vec3]) {
        for s in &self.springs {
            let k = s.section * self.modulus(s);
            pull(x, f, s, |e| k * e);
        }
    }

    fn energy(&self, x: &[Vec3]) -> f64 {
        let of = |s: &Spring| {
            let e = (x[s.ends[1] as usize] - x[s.ends[0] as usize]).norm() / s.length - 1.0;
            0.5 * s.section * s.length * self.modulus(s) * e * e
        };
        self.springs.iter().map(of).sum()
    }

    fn add_stiffness(&self, _: &[Vec3], k: &mut [f64]) {
        for s in &self.springs {
            row_sums(s.ends, s.section / s.length * self.modulus(s), k);
        }
    }

    fn add_pairs(&self, pairs: &mut Vec<[u32; 2]>) {
        pairs.extend(self.springs.iter().map(|s| s.ends));
    }

    fn add_hessian(&self, x: &[Vec3], convex: bool, h: &mut Hessian) {
        for s in &self.springs {
            let k = s.section * self.modulus(s);
            let e = (x[s.ends[1] as usize] - x[s.ends[0] as usize]).norm() / s.length - 1.0;
            add_spring_hessian(x, s, k * e, k, convex, h);
        }
    }
}
