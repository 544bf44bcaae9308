//! Contact parameters of a scene, shared by both solvers: gaps, friction and stiffness.

use crate::contact::tuning::{
    HESSIAN_LIMIT_OF_CONTACT, SELF_GAP_PER_ALTITUDE, STIFFNESS_OF_CONTACT, STRAIN_OF_CONTACT_PRESSURE,
};
use crate::scene::measures::{mean_edge, or_earth, side};
use crate::scene::topology::Topology;
use crate::{Scene, Settings};

/// Contact parameters of a scene. Only the gap update changes them during a run.
pub(crate) struct ContactParameters {
    pub topology: Topology,
    /// The stitch group of every vertex. Vertices of one group count as one vertex.
    pub stitch_groups: Vec<u32>,
    /// Distance that each vertex keeps from the body, m; 0 without a body.
    pub body_gap: Vec<f64>,
    /// Distance that each vertex keeps from other cloth, m; 0 without self-contact.
    pub self_gap: Vec<f64>,
    /// Coefficient of friction of each vertex.
    pub friction: Vec<f64>,
    /// Inverse mass of each vertex, 1/kg; 0 for a held vertex.
    pub inverse_mass: Vec<f64>,
    /// Mean edge length, m.
    pub mean_edge: f64,
    /// The scene has self-contact.
    pub has_self_contact: bool,
    /// Stiffness of contacts over their area, N/m³.
    pub stiffness: f64,
    /// Largest second derivative of a contact in the preconditioner, N/m.
    pub hessian_limit: f64,
}

#[cfg(test)]
impl ContactParameters {
    /// Parameters without friction and self-contact, with contacts as stiff as a skirt's. Gaps are per vertex, m.
    pub fn plain(topology: Topology, body_gap: Vec<f64>, self_gap: Vec<f64>, mean_edge: f64) -> Self {
        let n = body_gap.len();
        Self {
            topology,
            stitch_groups: (0..).take(n).collect(),
            body_gap,
            self_gap,
            friction: vec![0.0; n],
            inverse_mass: vec![1.0; n],
            mean_edge,
            has_self_contact: false,
            stiffness: 2e5,
            hessian_limit: 1e5,
        }
    }
}

/// The pressure that the cloth exerts, Pa.
///
/// It is the geometric mean of weight per area and of stretch stiffness over the size of the scene's largest part.
/// The heaviest and the stiffest cloth count, so that the order of materials does not matter. Without gravity the
/// Earth's is used.
fn contact_pressure(scene: &Scene, s: &Settings, topology: &Topology) -> f64 {
    let heaviest = scene.triangles.iter().map(|t| scene.materials[t.material as usize].areal_mass).fold(0.0, f64::max);
    let gravity = scene.gravity.norm() * s.gravity_scale.abs();
    let weight = heaviest * or_earth(gravity);
    (weight * stretch_stiffness(scene) / side(scene, topology)).sqrt()
}

/// Stretch stiffness of the stiffest cloth, N/m.
fn stretch_stiffness(scene: &Scene) -> f64 {
    let strain = STRAIN_OF_CONTACT_PRESSURE.get();
    let used = scene.triangles.iter().map(|t| &scene.materials[t.material as usize]);
    used.map(|m| m.warp.tangent(strain).max(m.weft.tangent(strain))).fold(0.0, f64::max)
}

/// Contact parameters of a scene. `has_body` and `has_self_contact` say which kinds of contact it has.
pub(crate) fn contact_parameters(
    scene: &Scene,
    s: &Settings,
    topology: Topology,
    inverse_mass: &[f64],
    has_body: bool,
    has_self_contact: bool,
) -> ContactParameters {
    let n = scene.positions.len();
    let (mut thickness, mut friction) = (vec![0.0f64; n], vec![0.0f64; n]);
    let mut altitude = vec![f64::INFINITY; n];
    for t in &scene.triangles {
        let m = &scene.materials[t.material as usize];
        let smallest = t.altitude();
        for v in t.vertices.map(|v| v as usize) {
            thickness[v] = thickness[v].max(m.thickness);
            friction[v] = friction[v].max(m.friction);
            altitude[v] = altitude[v].min(smallest);
        }
    }
    let layer = |i: usize| f64::from(scene.layers.get(i).copied().unwrap_or(0).max(0));
    let share = SELF_GAP_PER_ALTITUDE.get();
    // A gap thicker than the mesh is fine would push a flat sheet apart from itself.
    let self_gap = |i: usize| s.self_gap.max(thickness[i]).min(share * altitude[i]);
    let self_gap: Vec<f64> = (0..n).map(|i| if has_self_contact { self_gap(i) } else { 0.0 }).collect();
    let body_gap = |i: usize| s.body_gap + 0.5 * thickness[i] + layer(i) * s.self_gap.max(thickness[i]);
    let body_gap: Vec<f64> = (0..n).map(|i| if has_body { body_gap(i) } else { 0.0 }).collect();
    let gap = body_gap.iter().chain(&self_gap).fold(0.0f64, |a, b| a.max(*b));
    let pressure = contact_pressure(scene, s, &topology);
    ContactParameters {
        stiffness: STIFFNESS_OF_CONTACT.get() * pressure / gap,
        hessian_limit: HESSIAN_LIMIT_OF_CONTACT.get() * pressure * gap,
        stitch_groups: crate::scene::weld::groups(n, &scene.stitches),
        body_gap,
        self_gap,
        friction,
        inverse_mass: inverse_mass.to_vec(),
        mean_edge: mean_edge(scene),
        has_self_contact,
        topology,
    }
}
