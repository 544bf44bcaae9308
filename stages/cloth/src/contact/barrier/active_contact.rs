//! Active contacts: pairs of primitives nearer than their activation distance.

use crate::Vec3;
use crate::collision::narrow_phase::candidates::PairGeometry;
use crate::collision::narrow_phase::pair_kind::{PairKey, PairKind};
use crate::contact::barrier::potential::barrier;
use crate::contact::parameters::ContactParameters;
use crate::contact::tuning::EDGE_GAP_SHARE;

/// Two primitives nearer than their activation distance (a collision stencil).
#[derive(Clone, Copy, Debug)]
pub(crate) struct ActiveContact {
    /// Vertices of the cloth. Entries beyond their number repeat the first, with weight 0.
    pub vertices: [u32; 4],
    /// Derivatives of the signed distance along the normal with respect to the vertices.
    pub weights: [f64; 4],
    /// Unit vector from the second primitive to the first.
    pub normal: Vec3,
    /// Distance of the primitives, m.
    pub distance: f64,
    /// Normal force, N.
    pub normal_force: f64,
    /// Growth of the normal force as the distance shrinks, N/m.
    pub normal_stiffness: f64,
    /// Area of cloth that the contact stands for, m².
    pub area: f64,
    /// Distance below which the contact pushes, m.
    pub activation_distance: f64,
    /// Factor of the stiffness by adaptive stiffening, at least 1.
    pub stiffening: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// Identity of the pair.
    pub key: PairKey,
}

/// Values per vertex that contacts depend on, and the activation distance of vertices at the body.
#[derive(Clone, Copy)]
pub(super) struct ContactScales<'a> {
    /// Area of cloth of each vertex, m².
    pub area: &'a [f64],
    /// Stiffening of each vertex, at least 1.
    pub stiffening: &'a [f64],
    /// Least activation distance between a cloth vertex and a body triangle, m.
    pub body_activation_distance: f64,
}

/// Adds the pair to `contacts` if it is nearer than its activation distance. Returns the distance, m.
#[inline]
pub(super) fn add_if_active(
    contacts: &mut Vec<ActiveContact>,
    parameters: &ContactParameters,
    scales: ContactScales<'_>,
    kind: PairKind,
    pair: &PairGeometry,
) -> f64 {
    let PairGeometry { vertices: key, weights, separation, is_redundant } = *pair;
    let distance = separation.norm();
    let cloth = kind.cloth_vertex_count();
    let gaps = if kind.is_cloth_only() { &parameters.self_gap } else { &parameters.body_gap };
    let share = gap_share(kind);
    let gap = share * smallest_gap(gaps, &key[..cloth]);
    let gap = if kind == PairKind::VertexBodyTriangle { gap.max(scales.body_activation_distance) } else { gap };
    if distance < gap && distance > 0.0 && !is_redundant {
        let mut vertices = [key[0]; 4];
        vertices[..cloth].copy_from_slice(&key[..cloth]);
        let area = vertices[..cloth].iter().map(|v| scales.area[*v as usize]).sum::<f64>();
        contacts.push(ActiveContact {
            vertices,
            weights,
            normal: separation / distance,
            distance,
            normal_force: 0.0,
            normal_stiffness: 0.0,
            area: share * area / cloth as f64,
            activation_distance: gap,
            stiffening: vertices[..cloth].iter().map(|v| scales.stiffening[*v as usize]).fold(1.0, f64::max),
            friction: parameters.friction[key[0] as usize],
            key: (kind, key),
        });
    }
    distance
}

/// Adds the forces of contacts to `f`, N, and returns their energy, J. `stiffness` is per area, N/m³.
pub(super) fn add_forces(contacts: &mut [ActiveContact], stiffness: f64, f: &mut [Vec3]) -> f64 {
    let mut energy = 0.0;
    for t in contacts {
        let k = stiffness * t.area * t.stiffening;
        let (value, slope, curvature) = barrier(t.distance, t.activation_distance);
        energy += k * value;
        t.normal_force = -k * slope;
        t.normal_stiffness = k * curvature;
        let push = t.normal * t.normal_force;
        for i in 0..4 {
            if t.weights[i] != 0.0 {
                f[t.vertices[i] as usize] += push * t.weights[i];
            }
        }
    }
    energy
}

/// Share of the vertices' gap that a pair of this kind keeps.
#[inline]
fn gap_share(kind: PairKind) -> f64 {
    if matches!(kind, PairKind::VertexTriangle | PairKind::VertexBodyTriangle) { 1.0 } else { EDGE_GAP_SHARE.get() }
}

/// The largest of some gaps, m.
pub(super) fn largest_gap(gaps: &[f64]) -> f64 {
    gaps.iter().fold(0.0f64, |a, b| a.max(*b))
}

/// The smallest gap of some vertices, m.
pub(super) fn smallest_gap(gaps: &[f64], vertices: &[u32]) -> f64 {
    vertices.iter().fold(f64::INFINITY, |g, v| g.min(gaps[*v as usize]))
}
