//! Coplanar faces of a body.
//!
//! Over the edge between two coplanar faces one face holds a cloth vertex, the one it is over. If both held it, it
//! would stand higher there, and sliding cloth would bump on an edge that does not exist.

use crate::Vec3;
use crate::collision::tuning::{COPLANAR_ANGLE, COPLANAR_FACES};
use crate::scene::topology::{Hinge, Topology};

/// Stands for no face.
pub(crate) const NO_FACE: u32 = u32::MAX;

/// Marks of the edges between two coplanar faces; empty where there is none.
pub(crate) fn coplanar_edges(x: &[Vec3], topology: &Topology) -> Vec<bool> {
    if !COPLANAR_FACES.is_on() {
        return Vec::new();
    }
    let mut hinges = vec![0u8; topology.edges.len()];
    let mut flat = vec![false; topology.edges.len()];
    for h in &topology.hinges {
        let edge = topology.edge_of(h);
        hinges[edge] = hinges[edge].saturating_add(1);
        flat[edge] = hinges[edge] == 1 && is_coplanar(x, h);
    }
    if flat.contains(&true) { flat } else { Vec::new() }
}

/// For each side of each face, the coplanar face beyond it; empty where no faces are coplanar.
pub(crate) fn coplanar_neighbours(topology: &Topology, flat: &[bool]) -> Vec<[u32; 3]> {
    if flat.is_empty() {
        return Vec::new();
    }
    let mut out = vec![[NO_FACE; 3]; topology.faces.len()];
    for h in &topology.hinges {
        let [(f, i), (g, j)] = [0, 1].map(|k| (h.faces[k] as usize, usize::from(h.sides[k])));
        if flat[topology.edge_of(h)] {
            out[f][i] = h.faces[1];
            out[g][j] = h.faces[0];
        }
    }
    out
}

/// Do the two faces of a hinge lie in one plane, on both sides of their edge?
fn is_coplanar(x: &[Vec3], h: &Hinge) -> bool {
    let [a, b, c, d] = h.vertices.map(|v| x[v as usize]);
    let (m, n) = ((b - a).cross(&(c - a)), (d - a).cross(&(b - a)));
    m.dot(&n) > 0.0 && m.cross(&n).norm() <= COPLANAR_ANGLE.get() * m.norm() * n.norm()
}
