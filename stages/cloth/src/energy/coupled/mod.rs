//! Triangle springs whose coefficients depend on all three elongations (docs/coupled.md).
//!
//! Still springs: forces act along the three edges of a triangle. But each coefficient comes from the Green strain
//! that the three lengths give together, so that any orthotropic, non-linear fabric is met exactly.

pub(crate) mod lanes;
pub(crate) mod stiff;
pub(crate) mod triangle;

use crate::energy::Energy;
use crate::energy::law::Fabric;
use crate::linear::hessian::Hessian;
use crate::{Element, Elements, Scene, Settings, Vec3};
use lanes::TriangleBlocks;
use stiff::AssembleHessian;
use triangle::{Strain, Triangle, angle, strain, stress_and_energy};

/// The in-plane energy of a cloth by coupled triangle springs.
pub(crate) struct Coupled {
    triangles: TriangleBlocks,
    /// The elements of the scene, for their shape gradients.
    elements: Elements,
    fabrics: Vec<Fabric>,
}

impl Coupled {
    pub fn new(scene: &Scene, settings: &Settings) -> Self {
        Self {
            triangles: TriangleBlocks::new(&scene.triangles.iter().map(Triangle::new).collect::<Vec<_>>()),
            elements: scene.triangles.clone(),
            fabrics: scene.materials.iter().map(|m| Fabric::new(m, settings)).collect(),
        }
    }

    /// All triangles with their shape gradients.
    fn shapes(&self) -> impl Iterator<Item = (Triangle, [[f64; 2]; 3])> + '_ {
        self.triangles.triangles().zip(self.elements.iter().map(Element::gradients))
    }

    /// Strain of every triangle.
    pub fn strains<'a>(&'a self, x: &'a [Vec3]) -> impl Iterator<Item = Strain> + 'a {
        self.triangles.triangles().map(|t| strain(&t.green(&t.edges(x))))
    }
}

impl Energy for Coupled {
    fn add_forces(&self, x: &[Vec3], f: &mut [Vec3]) {
        self.evaluate(x, f);
    }

    fn evaluate(&self, x: &[Vec3], f: &mut [Vec3]) -> f64 {
        self.triangles.evaluate(&self.fabrics, x, f)
    }

    fn strain(&self, x: &[Vec3]) -> f64 {
        self.strains(x).map(|s| s.stretch[0].max(s.stretch[1]) - 1.0).fold(f64::NEG_INFINITY, f64::max)
    }

    fn is_locking(&self, x: &[Vec3]) -> bool {
        self.triangles.triangles().any(|t| {
            let green = t.green(&t.edges(x));
            self.fabrics[t.fabric as usize].is_locking(strain(&green).stretch, &green)
        })
    }

    fn lock_over(&mut self, locking: f64) -> bool {
        self.fabrics.iter_mut().fold(false, |any, f| f.lock_over(locking) | any)
    }

    fn energy(&self, x: &[Vec3]) -> f64 {
        let of = |t: Triangle| t.area * stress_and_energy(&t.green(&t.edges(x)), &self.fabrics[t.fabric as usize]).1;
        self.triangles.triangles().map(of).sum()
    }

    fn add_stiffness(&self, x: &[Vec3], k: &mut [f64]) {
        for (t, w) in self.shapes() {
            let fabric = &self.fabrics[t.fabric as usize];
            let s = strain(&t.green(&t.edges(x)));
            let weft = fabric.weft.tangent(s.stretch[0] - 1.0);
            let warp = fabric.warp.tangent(s.stretch[1] - 1.0);
            let (_, slope) = angle(s.sine);
            let rate = Triangle::rate(&w, weft, warp, fabric.cross, fabric.shear * slope * slope);
            for v in t.vertices {
                k[v as usize] += t.area / 3.0 * rate;
            }
        }
    }

    fn add_pairs(&self, pairs: &mut Vec<[u32; 2]>) {
        self.triangles.triangles().for_each(|t| crate::energy::clique(&t.vertices, pairs));
    }

    fn add_hessian(&self, x: &[Vec3], convex: bool, h: &mut Hessian) {
        self.triangles.arch().dispatch(AssembleHessian {
            triangles: &self.triangles,
            elements: &self.elements,
            fabrics: &self.fabrics,
            x,
            convex,
            into: h,
        });
    }
}
