//! Contact parameters of a scene, shared by both solvers: gaps, friction and stiffness. They never change during a run.

use crate::scene::measures::{mean_edge, or_earth, side};
use crate::scene::topology::Topology;
use crate::{Scene, Settings};

/// Stiffness of contacts times gap over what the cloth presses with, so that similar scenes stay similar: about 2e5 N/m³ in
/// a skirt of 0.2 kg/m² and 1 kN/m with a gap of 1.25 mm, which 300 Pa then close by half.
const PRESS: f64 = 8.0;
/// Its largest slope in the metric of a descent over the same pressure times gap: 1e5 N/m in that skirt. Beyond it single
/// precision loses the cloth behind the contact.
const STEEPEST: f64 = 2e6;

/// What never changes during a run.
pub(crate) struct Frame {
    pub topology: Topology,
    pub groups: Vec<u32>,
    /// Distance to hold to the body and to cloth, per vertex, m; 0 where the kind is off.
    pub body_gap: Vec<f64>,
    pub own_gap: Vec<f64>,
    pub friction: Vec<f64>,
    pub inverse_mass: Vec<f64>,
    /// Mean edge length, m.
    pub edge: f64,
    pub own: bool,
    /// Stiffness of contacts over area, N/m³, and the largest that the metric of a descent takes, N/m.
    pub press: f64,
    pub steepest: f64,
}

#[cfg(test)]
impl Frame {
    /// Without friction and without pairs of the cloth itself, in contacts as stiff as a skirt's; gaps per vertex, m.
    pub fn plain(topology: Topology, body_gap: Vec<f64>, own_gap: Vec<f64>, edge: f64) -> Self {
        let n = body_gap.len();
        Self {
            topology,
            groups: (0..).take(n).collect(),
            body_gap,
            own_gap,
            friction: vec![0.0; n],
            inverse_mass: vec![1.0; n],
            edge,
            own: false,
            press: 2e5,
            steepest: 1e5,
        }
    }
}

/// What cloth presses with, Pa: the geometric mean of its weight on its area (the Earth's where there is no gravity) and of
/// its stretch stiffness (at 1 %) over the size of the scene's largest part; of the heaviest and stiffest cloth, so that no order
/// counts.
fn pressure(scene: &Scene, s: &Settings, topology: &Topology) -> f64 {
    let heaviest = scene.triangles.iter().map(|t| scene.materials[t.material as usize].areal_mass).fold(0.0, f64::max);
    let gravity = scene.gravity.norm() * s.gravity_scale.abs();
    let weight = heaviest * or_earth(gravity);
    (weight * stretch(scene) / side(scene, topology)).sqrt()
}

/// Stretch stiffness at 1 % of the stiffest cloth, N/m.
fn stretch(scene: &Scene) -> f64 {
    let used = scene.triangles.iter().map(|t| &scene.materials[t.material as usize]);
    used.map(|m| m.warp.tangent(0.01).max(m.weft.tangent(0.01))).fold(0.0, f64::max)
}

/// Contact parameters of a scene; `body`, `own`: does the cloth meet a body, and itself?
pub(crate) fn frame(
    scene: &Scene,
    s: &Settings,
    topology: Topology,
    inverse_mass: &[f64],
    body: bool,
    own: bool,
) -> Frame {
    let n = scene.positions.len();
    let (mut thickness, mut friction) = (vec![0.0f64; n], vec![0.0f64; n]);
    let mut least = vec![f64::INFINITY; n];
    for t in &scene.triangles {
        let m = &scene.materials[t.material as usize];
        let altitude = t.altitude();
        for v in t.vertices.map(|v| v as usize) {
            thickness[v] = thickness[v].max(m.thickness);
            friction[v] = friction[v].max(m.friction);
            least[v] = least[v].min(altitude);
        }
    }
    let layer = |i: usize| f64::from(scene.layers.get(i).copied().unwrap_or(0).max(0));
    // Thicker than the mesh is fine, it would push a flat sheet apart from itself.
    let own_gap: Vec<f64> =
        (0..n).map(|i| if own { s.self_gap.max(thickness[i]).min(0.3 * least[i]) } else { 0.0 }).collect();
    let body_gap = |i: usize| s.body_gap + 0.5 * thickness[i] + layer(i) * s.self_gap.max(thickness[i]);
    let body_gap: Vec<f64> = (0..n).map(|i| if body { body_gap(i) } else { 0.0 }).collect();
    let gap = body_gap.iter().chain(&own_gap).fold(0.0f64, |a, b| a.max(*b));
    let pressure = pressure(scene, s, &topology);
    Frame {
        press: PRESS * pressure / gap,
        steepest: STEEPEST * pressure * gap,
        groups: crate::scene::weld::groups(n, &scene.stitches),
        body_gap,
        own_gap,
        friction,
        inverse_mass: inverse_mass.to_vec(),
        edge: mean_edge(scene),
        own,
        topology,
    }
}
