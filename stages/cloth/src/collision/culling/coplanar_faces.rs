//! Faces of a body that lie in one plane. Over the edge between two of them a vertex of the cloth is held by the one it is
//! over: held by both it would stand higher there, and what slides across would bump and rub on an edge that is none.

use crate::Vec3;
use crate::scene::topology::{Hinge, Topology};

/// Two faces lie in one plane up to this angle, rad.
const FLAT: f64 = 1e-6;
/// No face.
pub(crate) const NONE: u32 = u32::MAX;

/// The edges between two faces of one plane; empty where there is none.
pub(crate) fn edges(x: &[Vec3], topology: &Topology) -> Vec<bool> {
    let mut hinges = vec![0u8; topology.edges.len()];
    let mut flat = vec![false; topology.edges.len()];
    for h in &topology.hinges {
        let edge = topology.edge_of(h);
        hinges[edge] = hinges[edge].saturating_add(1);
        flat[edge] = hinges[edge] == 1 && goes_straight_on(x, h);
    }
    if flat.contains(&true) { flat } else { Vec::new() }
}

/// For each side of each face, the face in which its plane goes on; empty where no plane does.
pub(crate) fn across(topology: &Topology, flat: &[bool]) -> Vec<[u32; 3]> {
    if flat.is_empty() {
        return Vec::new();
    }
    let mut out = vec![[NONE; 3]; topology.faces.len()];
    for h in &topology.hinges {
        let [(f, i), (g, j)] = [0, 1].map(|k| (h.faces[k] as usize, usize::from(h.sides[k])));
        if flat[topology.edge_of(h)] {
            out[f][i] = h.faces[1];
            out[g][j] = h.faces[0];
        }
    }
    out
}

/// Do the two faces lie in one plane, on both sides of their edge?
fn goes_straight_on(x: &[Vec3], h: &Hinge) -> bool {
    let [a, b, c, d] = h.vertices.map(|v| x[v as usize]);
    let (m, n) = ((b - a).cross(&(c - a)), (d - a).cross(&(b - a)));
    m.dot(&n) > 0.0 && m.cross(&n).norm() <= FLAT * m.norm() * n.norm()
}
