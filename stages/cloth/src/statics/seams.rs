//! Sewing threads for descents: a pull of at most `force` per stitch, linear inside a small reach (paper equation 5,
//! with a cap so that pieces far apart are not torn together).

use crate::linear::hessian::Hessian;
use crate::{Scene, Vec3};
use nalgebra::Matrix3;

struct Thread {
    ends: [u32; 2],
    /// Length of seam it stands for, m.
    length: f64,
}

pub(crate) struct Seams {
    threads: Vec<Thread>,
    /// Pull per length of seam, N/m.
    pub force: f64,
    /// Gap at which the full pull acts, m.
    pub reach: f64,
}

impl Seams {
    pub fn new(scene: &Scene) -> Self {
        let edge: f64 = scene.triangles.iter().map(|t| (0..3).map(|k| t.rest_length(k)).sum::<f64>()).sum::<f64>()
            / (3.0 * scene.triangles.len().max(1) as f64);
        let threads =
            scene.stitches.iter().filter(|s| s[0] != s[1]).map(|s| Thread { ends: *s, length: edge }).collect();
        Self { threads, force: 0.0, reach: 1e-3 }
    }

    pub fn is_empty(&self) -> bool {
        self.threads.is_empty()
    }

    pub fn add_pairs(&self, pairs: &mut Vec<[u32; 2]>) {
        pairs.extend(self.threads.iter().map(|t| t.ends));
    }

    /// Energy, J; adds the forces.
    pub fn evaluate(&self, x: &[Vec3], f: &mut [Vec3]) -> f64 {
        let mut energy = 0.0;
        for t in &self.threads {
            let [a, b] = t.ends.map(|v| v as usize);
            let d = x[b] - x[a];
            let (l, most) = (d.norm(), self.force * t.length);
            let pull = if l <= self.reach {
                energy += 0.5 * most / self.reach * l * l;
                d * (most / self.reach)
            } else {
                energy += most * (l - 0.5 * self.reach);
                d * (most / l)
            };
            f[a] += pull;
            f[b] -= pull;
        }
        energy
    }

    /// Adds second derivatives.
    pub fn add_hessian(&self, x: &[Vec3], h: &mut Hessian) {
        for t in &self.threads {
            let [a, b] = t.ends.map(|v| v as usize);
            let d = x[b] - x[a];
            let (l, most) = (d.norm(), self.force * t.length);
            let block = if l <= self.reach {
                Matrix3::identity() * (most / self.reach)
            } else {
                (Matrix3::identity() - d * d.transpose() / (l * l)) * (most / l)
            };
            h.spread(&t.ends, &[1.0, -1.0], &block);
        }
    }

    /// Largest gap, m.
    pub fn widest(&self, x: &[Vec3]) -> f64 {
        self.threads.iter().map(|t| (x[t.ends[0] as usize] - x[t.ends[1] as usize]).norm()).fold(0.0, f64::max)
    }
}
