//! Measured bending: what the cloth carries over the straight line of its bending rigidity (docs/curves.md).

use crate::energy::Energy;
use crate::energy::bending::{Patch, patches};
use crate::energy::law::Law;
use crate::energy::moments::Bent;
use crate::linear::hessian::Hessian;
use crate::scene::topology::Topology;
use crate::{Scene, Settings, Vec3};
use nalgebra::Vector3;

/// The bend of a triangle along one of its yarns. The rows of the patch are √A κ.
struct Curved {
    patch: Patch,
    /// Number of the law.
    law: usize,
    /// Square root √A of the area, m.
    size: f64,
}

/// All triangles of fabrics with measured curves of bending.
pub(crate) struct BendingCurve {
    triangles: Vec<Curved>,
    laws: Vec<Law>,
}

/// Rigidities of 1 along [warp, weft], against (κ₀₀, κ₁₁, 2 κ₀₁): weft, warp, twist.
const ALONG: [[f64; 3]; 2] = [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0]];

impl BendingCurve {
    /// `None` where no fabric has a measured curve of bending.
    pub fn new(scene: &Scene, topology: &Topology, settings: &Settings) -> Option<Self> {
        let mut all = Self { triangles: Vec::new(), laws: Vec::new() };
        for (yarn, along) in ALONG.into_iter().enumerate() {
            let law = |m: &crate::Material| {
                let law = Law::above_least_slope(m.bending.curve[yarn].as_ref()?, settings.curve_cap())?;
                all.laws.push(law);
                Some(all.laws.len() - 1)
            };
            let of_material: Vec<Option<usize>> = scene.materials.iter().map(law).collect();
            if of_material.iter().all(Option::is_none) {
                continue;
            }
            let rigidity = |law: &Option<usize>| law.map_or_else(Vector3::zeros, |_| Vector3::from(along));
            let rigidities: Vec<Vector3<f64>> = of_material.iter().map(rigidity).collect();
            for (face, patch) in patches(scene, topology, &rigidities) {
                let e = &scene.triangles[face];
                let Some(law) = of_material[e.material as usize] else { continue };
                all.triangles.push(Curved { patch, law, size: e.area().abs().sqrt() });
            }
        }
        Some(all).filter(|all| !all.triangles.is_empty())
    }
}

impl Curved {
    /// Curvatures of the rows beyond those of unloaded cloth, 1/m.
    fn curvatures(&self, bent: &Bent) -> [f64; 3] {
        let normal = bent.normal();
        [0, 1, 2].map(|row| (normal.dot(&bent.bend[row]) - self.patch.rest[row]) / self.size)
    }

    fn energy(&self, law: &Law, bent: &Bent) -> f64 {
        let stored = self.curvatures(bent).map(|k| law.odd(k).1);
        self.size * self.size * (stored[0] + stored[1] + stored[2])
    }
}

impl Energy for BendingCurve {
    fn add_forces(&self, x: &[Vec3], f: &mut [Vec3]) {
        self.evaluate(x, f);
    }

    fn energy(&self, x: &[Vec3]) -> f64 {
        self.triangles.iter().map(|t| t.energy(&self.laws[t.law], &Bent::new(&t.patch, x))).sum()
    }

    fn evaluate(&self, x: &[Vec3], f: &mut [Vec3]) -> f64 {
        let mut energy = 0.0;
        for t in &self.triangles {
            let (law, bent) = (&self.laws[t.law], Bent::new(&t.patch, x));
            bent.push(&t.patch, &t.curvatures(&bent).map(|k| -t.size * law.odd(k).0), x, f);
            energy += t.energy(law, &bent);
        }
        energy
    }

    fn add_stiffness(&self, x: &[Vec3], k: &mut [f64]) {
        for t in &self.triangles {
            let curvatures = t.curvatures(&Bent::new(&t.patch, x));
            for (row, curvature) in t.patch.rows.iter().zip(curvatures) {
                let sum: f64 = row.iter().map(|w| w.abs()).sum();
                let stiff = self.laws[t.law].tangent(curvature.abs());
                for (v, w) in t.patch.vertices.iter().zip(row) {
                    k[*v as usize] += stiff * w.abs() * sum;
                }
            }
        }
    }

    fn add_pairs(&self, pairs: &mut Vec<[u32; 2]>) {
        for t in &self.triangles {
            // Corners across open sides are no vertices of their own.
            let mut own = t.patch.vertices.to_vec();
            own.sort_unstable();
            own.dedup();
            crate::energy::clique(&own, pairs);
        }
    }

    /// The part along the normal: slope of the curve times the square of the row.
    fn add_hessian(&self, x: &[Vec3], _convex: bool, h: &mut Hessian) {
        for t in &self.triangles {
            let bent = Bent::new(&t.patch, x);
            let normal = bent.normal();
            let slopes = t.curvatures(&bent).map(|k| self.laws[t.law].slope(k.abs()));
            let across = normal * normal.transpose();
            let stiff = |i: usize, j: usize| -> f64 {
                t.patch.rows.iter().zip(slopes).map(|(row, slope)| slope * row[i] * row[j]).sum()
            };
            for i in 0..6 {
                h.add(t.patch.vertices[i], &(across * stiff(i, i)));
                for j in (0..i).filter(|j| stiff(i, *j) != 0.0) {
                    h.couple(t.patch.vertices[i], t.patch.vertices[j], &(across * stiff(i, j)));
                }
            }
        }
    }
}
