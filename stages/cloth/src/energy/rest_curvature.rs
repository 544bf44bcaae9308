//! Curvature of unloaded cloth: the part −∫ κ₀ · D κ of the bending energy ½ ∫ (κ − κ₀) · D (κ − κ₀)
//! (docs/rest-curvature.md). The part without κ₀ is that of `bending.rs`.

use crate::energy::Energy;
use crate::energy::bending::{Patch, patches, rigidity};
use crate::energy::moments::Bent;
use crate::scene::topology::Topology;
use crate::{Scene, Vec3};
use nalgebra::Vector3;

/// The triangles whose fabric curls.
pub(crate) struct RestCurvature {
    patches: Vec<Patch>,
}

impl RestCurvature {
    /// `None` where every fabric lies flat without load.
    pub fn new(scene: &Scene, topology: &Topology) -> Option<Self> {
        let curls = |f: usize| scene.materials[scene.triangles[f].material as usize].curls();
        if !scene.materials.iter().any(crate::Material::curls) {
            return None;
        }
        let rigidities: Vec<Vector3<f64>> = scene.materials.iter().map(rigidity).collect();
        let all = patches(scene, topology, &rigidities);
        Some(Self { patches: all.into_iter().filter(|(f, _)| curls(*f)).map(|(_, p)| p).collect() })
    }
}

/// Adds the forces of a patch at `x` and returns its energy.
fn push(patch: &Patch, x: &[Vec3], f: &mut [Vec3]) -> f64 {
    let bent = Bent::new(patch, x);
    bent.push(patch, &patch.rest, x, f);
    energy(patch, &bent)
}

fn energy(patch: &Patch, bent: &Bent) -> f64 {
    let free: f64 = patch.rest.iter().map(|r| 0.5 * r * r).sum();
    free - bent.sum(&patch.rest).dot(&bent.normal())
}

impl Energy for RestCurvature {
    fn add_forces(&self, x: &[Vec3], f: &mut [Vec3]) {
        self.evaluate(x, f);
    }

    fn energy(&self, x: &[Vec3]) -> f64 {
        self.patches.iter().map(|p| energy(p, &Bent::new(p, x))).sum()
    }

    fn evaluate(&self, x: &[Vec3], f: &mut [Vec3]) -> f64 {
        self.patches.iter().map(|p| push(p, x, f)).sum()
    }

    /// Its second derivatives are smaller than those of bending by the angle over which one triangle curls. They are left
    /// out of all Hessians.
    fn add_stiffness(&self, _: &[Vec3], _: &mut [f64]) {}
}
