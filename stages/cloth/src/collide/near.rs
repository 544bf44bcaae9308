//! Lists of primitives that are near each other, kept until the motion since their making uses up the slack.

use super::body::Body;
use super::tree::{Aabb, Tree};
use crate::Vec3;
use crate::topology::Topology;

/// Vertex–triangle and edge–edge pairs; vertex numbers throughout.
#[derive(Clone, Debug, Default)]
pub(crate) struct Near {
    /// Vertex, triangle corners (cloth).
    pub points: Vec<[u32; 4]>,
    /// Ends of two cloth edges.
    pub edges: Vec<[u32; 4]>,
    /// Cloth vertex, body triangle.
    pub body_points: Vec<[u32; 2]>,
    /// Ends of a cloth edge, ends of a body edge.
    pub body_edges: Vec<[u32; 4]>,
    /// Cloth triangle corners, body vertex.
    pub body_faces: Vec<[u32; 4]>,
}

/// Are two edges' (or points') boxes further apart than `reach`?
#[inline]
fn far(a: &[Vec3], b: &[Vec3], reach: f64) -> bool {
    (0..3).any(|k| {
        let span = |p: &[Vec3]| p.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |s, v| (s.0.min(v[k]), s.1.max(v[k])));
        let ((l0, h0), (l1, h1)) = (span(a), span(b));
        l0 > h1 + reach || l1 > h0 + reach
    })
}

/// What one face brings to its pairs: the corners and edges it owns.
struct Owned {
    corners: [u32; 3],
    bits: u8,
}

impl Owned {
    fn of(t: &Topology, f: u32) -> Self {
        Self { corners: t.faces[f as usize], bits: t.owned[f as usize] }
    }

    fn vertices(&self) -> impl Iterator<Item = u32> + '_ {
        (0..3).filter(|k| self.bits & (1 << k) != 0).map(|k| self.corners[k])
    }

    fn edges(&self) -> impl Iterator<Item = (usize, [u32; 2])> + '_ {
        (0..3).filter(|k| self.bits & (8 << k) != 0).map(|k| (k, [self.corners[k], self.corners[(k + 1) % 3]]))
    }
}

impl Near {
    /// Cloth–cloth pairs nearer than `reach`; vertices of one group (stitched together) count as one vertex.
    pub fn fill_own(&mut self, x: &[Vec3], topology: &Topology, groups: &[u32], tree: &Tree, reach: f64) {
        self.points.clear();
        self.edges.clear();
        let at = |v: u32| x[v as usize];
        let group = |v: u32| groups[v as usize];
        tree.own_pairs(|f, g| {
            let (a, b) = (Owned::of(topology, f), Owned::of(topology, g));
            for (one, other) in [(&a, &b), (&b, &a)] {
                for v in one.vertices() {
                    let c = other.corners;
                    if c.iter().all(|w| group(*w) != group(v)) && !far(&[at(v)], &c.map(at), reach) {
                        self.points.push([v, c[0], c[1], c[2]]);
                    }
                }
            }
            for (_, p) in a.edges() {
                for (_, q) in b.edges() {
                    let apart = p.iter().all(|v| q.iter().all(|w| group(*v) != group(*w)));
                    if apart && !far(&p.map(at), &q.map(at), reach) {
                        self.edges.push([p[0], p[1], q[0], q[1]]);
                    }
                }
            }
        });
    }

    /// Cloth–body pairs nearer than `reach`.
    pub fn fill_body(&mut self, x: &[Vec3], topology: &Topology, body: &Body, reach: f64) {
        self.body_points.clear();
        self.body_edges.clear();
        self.body_faces.clear();
        let at = |v: u32| x[v as usize];
        let place = |v: u32| body.positions[v as usize];
        for f in (0u32..).take(topology.faces.len()) {
            let a = Owned::of(topology, f);
            let bounds = Aabb::of(&a.corners.map(at)).grown(reach);
            if !bounds.meets(&body.bounds) {
                continue;
            }
            body.candidates(&bounds, |g| {
                let b = Owned::of(&body.topology, g);
                let c = b.corners.map(place);
                for v in a.vertices() {
                    if !far(&[at(v)], &c, reach) {
                        self.body_points.push([v, g]);
                    }
                }
                for w in b.vertices() {
                    if !far(&[place(w)], &a.corners.map(at), reach) {
                        self.body_faces.push([a.corners[0], a.corners[1], a.corners[2], w]);
                    }
                }
                for (k, q) in b.edges() {
                    if !body.pressing_edges[body.topology.face_edges[g as usize][k] as usize] {
                        continue;
                    }
                    for (_, p) in a.edges() {
                        if !far(&p.map(at), &q.map(place), reach) {
                            self.body_edges.push([p[0], p[1], q[0], q[1]]);
                        }
                    }
                }
            });
        }
    }
}
