//! Prolongation: the shape of a coarser level is carried to the finer cloth by barycentric weights.

use crate::Vec3;
use crate::hierarchy::collapse::Mesh;
use crate::hierarchy::rest_places::weights;

/// A place on a triangle of the coarser cloth.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Anchor {
    vertices: [u32; 3],
    weights: [f64; 3],
}

/// Positions of the finer vertices from those of the coarser cloth (prolongation), m.
pub(crate) fn prolong(anchors: &[Vec<Anchor>], x: &[Vec3]) -> Vec<Vec3> {
    let place = |a: &Anchor| (0..3).map(|k| x[a.vertices[k] as usize] * a.weights[k]).sum::<Vec3>();
    anchors.iter().map(|all| all.iter().map(place).sum::<Vec3>() / all.len().max(1) as f64).collect()
}

/// Places of all vertices on the triangles of a collapsed mesh.
pub(crate) fn anchors(mesh: &Mesh, number: &[u32]) -> Vec<Vec<Anchor>> {
    let mut anchors = vec![Vec::new(); number.len()];
    for (v, n) in number.iter().enumerate().filter(|(_, n)| **n != u32::MAX) {
        anchors[v].push(Anchor { vertices: [*n; 3], weights: [1.0, 0.0, 0.0] });
    }
    for (corners, carried) in mesh.triangles.iter().zip(&mesh.carried) {
        let Some(corners) = corners else { continue };
        let rest = corners.map(|c| mesh.charts.rest[c as usize]);
        let vertices = corners.map(|c| number[mesh.charts.vertex[c as usize] as usize]);
        for c in carried {
            let v = mesh.charts.vertex[*c as usize] as usize;
            if number[v] == u32::MAX {
                anchors[v].push(Anchor { vertices, weights: weights(&rest, &mesh.charts.rest[*c as usize]) });
            }
        }
    }
    anchors
}
