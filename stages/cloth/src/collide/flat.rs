//! Faces of a body that lie in one plane. Over the edge between two of them a vertex of the cloth is held by the one it is
//! over: held by both it would stand higher there, and what slides across would bump and rub on an edge that is none.

use super::body::Body;
use crate::Vec3;
use crate::topology::{Hinge, Topology};

/// Two faces lie in one plane up to this angle, rad.
const FLAT: f64 = 1e-6;
/// So near to the edge its owner holds in any case, m: rounding must not make it neither.
const BOTH: f64 = 1e-8;

/// The edges between two faces of one plane; empty where there is none.
pub(super) fn edges(x: &[Vec3], topology: &Topology) -> Vec<bool> {
    let mut hinges = vec![0u8; topology.edges.len()];
    let mut flat = vec![false; topology.edges.len()];
    for h in &topology.hinges {
        let edge = topology.face_edges[h.faces[0] as usize][usize::from(h.sides[0])] as usize;
        hinges[edge] = hinges[edge].saturating_add(1);
        flat[edge] = hinges[edge] == 1 && goes_straight_on(x, h);
    }
    if flat.contains(&true) { flat } else { Vec::new() }
}

/// Do the two faces lie in one plane, on both sides of their edge?
fn goes_straight_on(x: &[Vec3], h: &Hinge) -> bool {
    let [a, b, c, d] = h.vertices.map(|v| x[v as usize]);
    let (m, n) = ((b - a).cross(&(c - a)), (d - a).cross(&(b - a)));
    m.dot(&n) > 0.0 && m.cross(&n).norm() <= FLAT * m.norm() * n.norm()
}

impl Body {
    /// Is another face of the plane of face `g` under a point at `d` from the place in `g`, told by the corners' weights, that
    /// is nearest to it? Right over an edge it is the face that owns the edge.
    pub fn goes_on(&self, g: u32, weights: &[f64; 3], d: &Vec3) -> bool {
        if self.flat_edges.is_empty() || !self.amid_plane(g, weights) {
            return false;
        }
        let aside = crate::unit_normal(self.triangle(g)).map_or(0.0, |n| (d - n * n.dot(d)).norm());
        aside > BOTH || !self.owns(g, weights)
    }

    /// Does a face own the edge that a point of it is on? At a corner it counts as its.
    fn owns(&self, g: u32, weights: &[f64; 3]) -> bool {
        let mut without = (0..3).filter(|k| weights[*k] == 0.0);
        match (without.next(), without.next()) {
            (Some(k), None) => self.topology.owned[g as usize] & (8 << ((k + 1) % 3)) != 0,
            _ => true,
        }
    }

    /// Are all edges of a face that go through a point of it, given by the weights of the corners, flat?
    fn amid_plane(&self, g: u32, weights: &[f64; 3]) -> bool {
        // They lie opposite to the corners that have no part in it; edge k runs from corner k.
        let edges = self.topology.face_edges[g as usize];
        let mut through = (0..3).filter(|k| weights[*k] == 0.0).map(|k| edges[(k + 1) % 3]).peekable();
        through.peek().is_some() && through.all(|e| self.flat_edges[e as usize])
    }
}

#[cfg(test)]
mod tests {
    use super::super::closest::point_triangle;
    use super::*;
    use crate::BodyMesh;

    /// A level square of two faces beside a third that rises from it.
    fn body() -> Body {
        let at = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, 1.0], [0.0, 0.0, 1.0], [2.0, 0.5, 0.5]];
        let mesh = BodyMesh {
            positions: at.map(|[x, y, z]| Vec3::new(x, y, z)).to_vec(),
            triangles: vec![[0, 2, 1], [0, 3, 2], [1, 2, 4]],
        };
        Body::new(&mesh).unwrap()
    }

    fn holds(body: &Body, p: Vec3) -> Vec<u32> {
        let goes_on = |g: u32| {
            let [a, b, c] = body.triangle(g);
            let w = point_triangle(&p, &a, &b, &c);
            body.goes_on(g, &w, &(p - (a * w[0] + b * w[1] + c * w[2])))
        };
        (0..3).filter(|g| !goes_on(*g)).collect()
    }

    #[test]
    fn over_an_edge_in_a_plane_one_face_holds() {
        let body = body();
        assert_eq!(holds(&body, Vec3::new(0.501, 1e-3, 0.499)), [0, 2]);
        assert_eq!(holds(&body, Vec3::new(0.499, 1e-3, 0.501)), [1, 2]);
    }

    #[test]
    fn on_the_edge_itself_its_owner_holds() {
        assert_eq!(holds(&body(), Vec3::new(0.5, 1e-3, 0.5)), [0, 2]);
    }

    #[test]
    fn beyond_the_rim_of_the_plane_something_holds() {
        let body = body();
        for (x, z) in [(-0.01, 0.5), (-0.01, -0.02), (0.5, 1.01), (1.01, 1.02), (1.001, 0.5), (-0.02, -0.01)] {
            let held = holds(&body, Vec3::new(x, 1e-3, z));
            assert!(held.contains(&0) || held.contains(&1), "({x}, {z}): {held:?}");
        }
    }
}
