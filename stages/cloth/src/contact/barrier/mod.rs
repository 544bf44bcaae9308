//! Contact as a smooth energy of the true distances, for descents (docs/contact.md).
//!
//! Two primitives at distance d, nearer than their activation distance ĝ, store κ a b(d). Here κ is a stiffness, a
//! the area of cloth and b the barrier of incremental potential contact (Li et al. 2020, equation 6). Candidate
//! pairs are listed anew when the cloth has moved by the slack of the lists.

pub(crate) mod active_contact;
mod adaptive_stiffness;
mod candidate_lists;
mod deferred_detection;
mod gap_update;
pub(crate) mod potential;
pub(crate) mod statistics;

use crate::Vec3;
use crate::collision::body::Body;
use crate::collision::narrow_phase::pair_kind::PairKind;
use crate::collision::self_candidates::SelfCollision;
use crate::contact::barrier::active_contact::{ActiveContact, ContactScales, add_forces, add_if_active, largest_gap};
use crate::contact::barrier::candidate_lists::CandidateLists;
use crate::contact::barrier::statistics::ContactStatistics;
use crate::contact::parameters::ContactParameters;
use crate::contact::tuning::{CONTACT_HESSIAN_LIMIT, EDGE_GAP_SHARE};
use crate::linear::hessian::Hessian;
use crate::report::cost::{CpuTimer, Work};

/// State of contact at the vertices of the cloth.
struct VertexStates {
    /// Area of cloth, m².
    area: Vec<f64>,
    /// Factor of the contact stiffness, at least 1.
    stiffening: Vec<f64>,
    /// Gap to the body before any gap update, m.
    wanted_gap: Vec<f64>,
    /// The vertex began with the load under which it rests.
    is_warm_started: Vec<bool>,
}

impl VertexStates {
    fn scales(&self, body_activation_distance: f64) -> ContactScales<'_> {
        ContactScales { area: &self.area, stiffening: &self.stiffening, body_activation_distance }
    }
}

/// The contact energy of a scene, with its candidate pairs and active contacts.
pub(crate) struct Barrier {
    pub parameters: ContactParameters,
    pub body: Option<Body>,
    pub lists: CandidateLists,
    /// Least activation distance between vertices and the body, m. While pieces are sewn it exceeds the gap, so
    /// that the cloth slides round the body.
    pub body_activation_distance: f64,
    vertices: VertexStates,
    /// Active contacts at the last evaluation, those of cloth with cloth first.
    pub contacts: Vec<ActiveContact>,
    /// Distances of the listed pairs at the last evaluation, m, in the order of the lists, one list for each pair
    /// kind. A pair with the body that does not push may have a lower bound here.
    pub distances: [Vec<f64>; 5],
    pub statistics: ContactStatistics,
}

impl Barrier {
    /// A contact energy without lists. `area` is the area of cloth per vertex, m².
    pub fn new(
        parameters: ContactParameters,
        body: Option<Body>,
        area: Vec<f64>,
        self_collision: Option<SelfCollision>,
    ) -> Self {
        Self {
            vertices: VertexStates {
                stiffening: vec![1.0; area.len()],
                wanted_gap: parameters.body_gap.clone(),
                is_warm_started: vec![false; area.len()],
                area,
            },
            parameters,
            body,
            lists: CandidateLists::new(self_collision),
            body_activation_distance: 0.0,
            contacts: Vec::new(),
            distances: Default::default(),
            statistics: ContactStatistics::new(),
        }
    }

    /// Ensures that the lists hold every pair that comes near along the step, when all vertices take the same part
    /// of it.
    ///
    /// Returns whether the lists were made anew.
    pub fn update_lists(&mut self, x: &[Vec3], step: &[Vec3]) -> bool {
        let activation = self.body_activation_distance;
        self.lists.update(x, step, &self.parameters, self.body.as_mut(), activation, &mut self.statistics)
    }

    /// Makes the lists at `x` anew.
    pub fn rebuild_lists(&mut self, x: &[Vec3]) {
        self.lists.validity.invalidate();
        self.update_lists(x, &vec![Vec3::zeros(); x.len()]);
    }

    /// Records that a step to `x` was taken.
    pub fn step_taken(&mut self, x: &[Vec3]) {
        self.lists.validity.step_taken(x);
    }

    /// Finds the active contacts at `x`, adds their forces to `f`, N, and returns the energy, J.
    pub fn evaluate(&mut self, x: &[Vec3], f: &mut [Vec3]) -> f64 {
        let mut lap = CpuTimer::start();
        self.contacts.clear();
        self.find_self_contacts(x);
        let cloth = self.contacts.len();
        let mut energy = add_forces(&mut self.contacts, self.parameters.stiffness, f);
        self.statistics.costs.spend(Work::SelfContact, &mut lap);
        self.find_body_contacts(x);
        energy += add_forces(&mut self.contacts[cloth..], self.parameters.stiffness, f);
        self.statistics.costs.spend(Work::BodyContact, &mut lap);
        self.statistics.count_contacts(cloth, self.contacts.len() - cloth);
        energy
    }

    fn find_self_contacts(&mut self, x: &[Vec3]) {
        let [points, edges, ..] = &mut self.distances;
        points.clear();
        edges.clear();
        let (parameters, scales, contacts) = (&self.parameters, self.vertices.scales(0.0), &mut self.contacts);
        let pairs = &self.lists.cloth;
        let mut distance = |kind, pair| add_if_active(contacts, parameters, scales, kind, &pair);
        points.extend(pairs.point_gaps(x).map(|pair| distance(PairKind::VertexTriangle, pair)));
        edges.extend(pairs.edge_gaps(x).map(|pair| distance(PairKind::EdgeEdge, pair)));
    }

    fn find_body_contacts(&mut self, x: &[Vec3]) {
        let Some(body) = &self.body else { return };
        let [_, _, points, edges, faces] = &mut self.distances;
        for list in [&mut *points, &mut *edges, &mut *faces] {
            list.clear();
        }
        let (lists, smallest) = (&self.lists.body, &mut self.statistics.smallest_body_distance);
        if lists.is_empty() {
            return;
        }
        lists.displacements(x, &mut self.lists.displacements);
        let gap = largest_gap(&self.parameters.body_gap);
        let (feature_reach, vertex_reach) = (EDGE_GAP_SHARE.get() * gap, gap.max(self.body_activation_distance));
        let moved = &*self.lists.displacements;
        let (parameters, contacts) = (&self.parameters, &mut self.contacts);
        let scales = self.vertices.scales(self.body_activation_distance);
        let mut distance = |kind, pair| add_if_active(contacts, parameters, scales, kind, &pair);
        edges.extend(lists.edges.iter().map(|p| {
            p.distance_beyond(2, moved, feature_reach)
                .unwrap_or_else(|| distance(PairKind::EdgeBodyEdge, p.edge_gap(x, body).0))
        }));
        faces.extend(lists.faces.iter().map(|p| {
            p.distance_beyond(3, moved, feature_reach)
                .unwrap_or_else(|| distance(PairKind::TriangleBodyVertex, p.face_gap(x, body).0))
        }));
        // Every triangle pushes by itself. The nearest one alone would jump from side to side in a crease.
        points.extend(lists.points.iter().map(|p| {
            p.distance_beyond(1, moved, vertex_reach).unwrap_or_else(|| {
                let distance = distance(PairKind::VertexBodyTriangle, p.point_gap(x, body).0);
                *smallest = smallest.min(distance);
                distance
            })
        }));
    }

    /// Adds the second derivatives of the last evaluation, N/m.
    ///
    /// The curvature of the distances is left out: it only turns contacts, and is negative.
    pub fn add_hessian(&self, hessian: &mut Hessian) {
        let limit = if CONTACT_HESSIAN_LIMIT.is_on() { self.parameters.hessian_limit } else { f64::INFINITY };
        for t in &self.contacts {
            let stiffness = t.normal_stiffness.min(limit);
            hessian.spread(&t.vertices, &t.weights, &(t.normal * t.normal.transpose() * stiffness));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pairs whose distances are not computed because nothing moved far enough do not push.
    ///
    /// At all places within the reach of the lists, energy and forces equal those of lists made there, up to
    /// rounding.
    #[test]
    fn pairs_beyond_reach_do_not_push() {
        let (gap, edge) = (2e-3, 0.02);
        let topology = || crate::scene::topology::Topology::new(4, vec![[0, 1, 2], [1, 3, 2]]);
        let mesh = crate::BodyMesh {
            positions: [[0.0, 0.0, 0.0], [0.06, 0.0, 0.0], [0.03, 0.05, 0.0], [0.03, 0.02, -0.05]]
                .map(Vec3::from)
                .to_vec(),
            triangles: vec![[0, 1, 2], [1, 0, 3], [2, 1, 3], [0, 2, 3]],
        };
        let fresh = || {
            let parameters = ContactParameters::plain(topology(), vec![gap; 4], vec![0.0; 4], edge);
            Barrier::new(parameters, Body::new(&mesh), vec![1e-4; 4], None)
        };
        let at = |k: f64| {
            let z = 2.4e-3 - 1.2e-3 * k;
            [[0.02, -0.004, z], [0.04, -0.004, z + 1e-3], [0.02, 0.01, z], [0.04, 0.012, z + 2e-3]].map(Vec3::from)
        };
        let (start, end) = (at(0.0), at(1.0));
        let step: Vec<Vec3> = end.iter().zip(&start).map(|(p, q)| p - q).collect();
        let mut kept = fresh();
        assert!(kept.update_lists(&start, &step));
        let mut pushed = 0;
        for k in 0..=20 {
            let x = at(f64::from(k) / 20.0);
            let mut anew = fresh();
            anew.update_lists(&x, &[Vec3::zeros(); 4]);
            let (mut f, mut g) = ([Vec3::zeros(); 4], [Vec3::zeros(); 4]);
            let (a, b) = (kept.evaluate(&x, &mut f), anew.evaluate(&x, &mut g));
            assert!((a - b).abs() <= 1e-14 * a.abs() && kept.contacts.len() == anew.contacts.len(), "{k}: {a} {b}");
            assert!(f.iter().zip(&g).all(|(p, q)| (p - q).norm() <= 1e-14 * (1.0 + p.norm())));
            pushed += usize::from(a > 0.0);
        }
        assert!((5..20).contains(&pushed), "{pushed}");
    }
}
