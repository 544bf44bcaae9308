//! Curvature of unloaded cloth: the part −∫ κ₀ · D κ of the bending energy ½ ∫ (κ − κ₀) · D (κ − κ₀)
//! (docs/rest-curvature.md). The part without κ₀ is that of `bending.rs`.

use crate::energy::Energy;
use crate::energy::bending::{Patch, patches, rigidity};
use crate::scene::topology::Topology;
use crate::{Scene, Vec3, pick3};
use nalgebra::Vector3;

/// The triangles whose fabric curls.
pub(crate) struct RestCurvature {
    patches: Vec<Patch>,
}

/// The moments of a patch at some places.
struct Turned {
    /// Curvature vectors of the rows, each times its value at rest, summed: √(N·m) squared over m.
    moment: Vec3,
    /// Twice the triangle's area as a vector along its normal, m².
    area: Vec3,
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

impl Turned {
    fn new(patch: &Patch, x: &[Vec3]) -> Self {
        let bend = patch.bend(x);
        let moment = (0..3).map(|row| bend[row] * patch.rest[row]).sum();
        let [a, b, c] = pick3(x, &[0, 1, 2].map(|k: usize| patch.vertices[k]));
        Self { moment, area: (b - a).cross(&(c - a)) }
    }

    /// The triangle's normal; 0 without an area.
    fn normal(&self) -> Vec3 {
        self.area.try_normalize(0.0).unwrap_or_else(Vec3::zeros)
    }
}

/// Adds the forces of a patch at `x` and returns its energy.
fn push(patch: &Patch, x: &[Vec3], f: &mut [Vec3]) -> f64 {
    let turned = Turned::new(patch, x);
    let normal = turned.normal();
    for (k, v) in patch.vertices.iter().enumerate() {
        let weight: f64 = (0..3).map(|row| patch.rest[row] * patch.rows[row][k]).sum();
        f[*v as usize] += normal * weight;
    }
    // The normal turns with the corners: d(n · m) = (m − n (n · m)) · dN / |N|, with N = (b − a) × (c − a).
    let size = turned.area.norm();
    if size > 0.0 {
        let across = (turned.moment - normal * normal.dot(&turned.moment)) / size;
        let corners = [0, 1, 2].map(|k: usize| patch.vertices[k]);
        let [a, b, c] = pick3(x, &corners);
        let (at_b, at_c) = ((c - a).cross(&across), across.cross(&(b - a)));
        f[corners[0] as usize] -= at_b + at_c;
        f[corners[1] as usize] += at_b;
        f[corners[2] as usize] += at_c;
    }
    energy(patch, &turned)
}

fn energy(patch: &Patch, turned: &Turned) -> f64 {
    let free: f64 = patch.rest.iter().map(|r| 0.5 * r * r).sum();
    free - turned.moment.dot(&turned.normal())
}

impl Energy for RestCurvature {
    fn add_forces(&self, x: &[Vec3], f: &mut [Vec3]) {
        self.evaluate(x, f);
    }

    fn energy(&self, x: &[Vec3]) -> f64 {
        self.patches.iter().map(|p| energy(p, &Turned::new(p, x))).sum()
    }

    fn evaluate(&self, x: &[Vec3], f: &mut [Vec3]) -> f64 {
        self.patches.iter().map(|p| push(p, x, f)).sum()
    }

    /// Its second derivatives are smaller than those of bending by the angle over which one triangle curls. They are left
    /// out of all Hessians.
    fn add_stiffness(&self, _: &[Vec3], _: &mut [f64]) {}
}
