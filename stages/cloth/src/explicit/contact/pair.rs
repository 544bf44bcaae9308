//! Contact pairs: two near primitives with one plane between them.

use crate::Vec3;
use crate::collision::narrow_phase::candidates::PairGeometry;
use crate::contact::parameters::ContactParameters;
use crate::explicit::tuning::{CONTACT_PAIR_GAPS, EXPLICIT_EDGE_GAP_SHARE};

/// Two near primitives and the plane between them. The body's side of a pair has no vertices: it does not move.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContactPair {
    /// Vertices of the cloth; numbers with weight 0 stand for nothing.
    pub vertices: [u32; 4],
    /// Weights of the vertices in the difference of the two nearest places.
    pub weights: [f64; 4],
    /// Unit normal of the plane, from the other side towards the cloth.
    pub normal: Vec3,
    /// Place of the body along the normal, m; 0 between cloth and cloth.
    pub offset: f64,
    /// Distance below which the pair pushes, m.
    pub gap: f64,
    /// Stiffness, N/m.
    pub stiffness: f64,
    /// Normal force of the last evaluation, N.
    pub load: f64,
    /// Distance at the last evaluation, m.
    pub distance: f64,
    /// Coefficient of friction.
    pub friction: f64,
}

impl ContactPair {
    /// Makes a pair without stiffness and load, and with an infinite distance.
    fn new(
        vertices: [u32; 4],
        weights: [f64; 4],
        normal: Vec3,
        offset: f64,
        gap: f64,
        frame: &ContactParameters,
    ) -> Self {
        let friction = frame.friction[vertices[0] as usize];
        Self { vertices, weights, normal, offset, gap, stiffness: 0.0, load: 0.0, distance: f64::INFINITY, friction }
    }

    /// The pair of a vertex and its nearest place on the body, at a distance in m.
    pub fn of_vertex(vertex: u32, plane: (Vec3, f64), distance: f64, frame: &ContactParameters) -> Self {
        let gap = frame.body_gap[vertex as usize];
        let pair = Self::new([vertex; 4], [1.0, 0.0, 0.0, 0.0], plane.0, plane.1, gap, frame);
        Self { distance, ..pair }
    }

    /// Distance of the two sides along the normal at `x`, m.
    #[inline]
    pub fn distance_at(&self, x: &[Vec3]) -> f64 {
        let w = &self.weights;
        let [a, b, c, d] = crate::pick4(x, &self.vertices);
        self.normal.dot(&(a * w[0] + b * w[1] + c * w[2] + d * w[3])) - self.offset
    }
}

/// Takes a gap of cloth to cloth: lowers the distances of its vertices and adds a pair where it is small.
///
/// `gap_share` is the share of the vertices' gap at which the pair is held; gaps from `reach` (m) on are left out.
#[inline]
pub(crate) fn take_cloth_gap(
    distance: &mut [f64],
    pairs: &mut Vec<ContactPair>,
    frame: &ContactParameters,
    reach: f64,
    g: &PairGeometry,
    gap_share: f64,
) {
    let PairGeometry { vertices, weights, separation: d, .. } = *g;
    let l = d.norm();
    if l >= reach {
        return;
    }
    let mut gap = f64::INFINITY;
    for v in vertices {
        let i = v as usize;
        distance[i] = distance[i].min(l);
        gap = gap.min(frame.self_gap[i]);
    }
    gap *= gap_share;
    if l < CONTACT_PAIR_GAPS.get() * gap && l > 0.0 {
        pairs.push(ContactPair::new(vertices, weights, d / l, 0.0, gap, frame));
    }
}

/// Takes a gap of an edge or a face to the body: lowers the distances of its vertices and adds a pair where it is
/// small. `d` is the vector from the place on the body, m.
#[inline]
pub(crate) fn take_body_gap(
    distance: &mut [f64],
    pairs: &mut Vec<ContactPair>,
    frame: &ContactParameters,
    (vertices, weights): ([u32; 4], [f64; 4]),
    d: Vec3,
    place: &Vec3,
) {
    let l = d.norm();
    let share = EXPLICIT_EDGE_GAP_SHARE.get();
    let mut gap = f64::INFINITY;
    for v in vertices {
        let i = v as usize;
        distance[i] = distance[i].min(l);
        gap = gap.min(share * frame.body_gap[i]);
    }
    if l < CONTACT_PAIR_GAPS.get() * gap && l > 0.0 {
        let normal = d / l;
        pairs.push(ContactPair::new(vertices, weights, normal, normal.dot(place), gap, frame));
    }
}
