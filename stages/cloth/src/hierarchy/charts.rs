//! Copies of vertices: one for each side of a seam, so that every copy has one rest place.

use crate::hierarchy::prolong;
use crate::scene::weld::groups;
use crate::{Scene, Vec3};

#[derive(Debug)]
pub(crate) struct Charts {
    /// Copies at the corners of every triangle.
    pub corners: Vec<[u32; 3]>,
    /// Vertex, rest place, and knot of every copy. Copies of one knot are, or will be sewn, together.
    pub vertex: Vec<u32>,
    pub rest: Vec<Vec3>,
    /// Rest places of the corners of every triangle, as they were.
    pub places: Vec<[Vec3; 3]>,
    /// Are they places in space, of a rest shape that is curved?
    pub curved: bool,
    pub knot: Vec<u32>,
    /// Knots, and which of them must stay.
    pub knots: usize,
    pub fixed: Vec<bool>,
    pub pinned: Vec<bool>,
}

impl Charts {
    pub fn new(scene: &Scene) -> Self {
        let n = 3 * scene.triangles.len();
        let (places, curved) = prolong::corners(scene);
        let group = groups(n, &joined(scene, &places));
        let mut number = vec![u32::MAX; n];
        let (mut vertex, mut rest) = (Vec::new(), Vec::new());
        for (i, root) in group.iter().enumerate().filter(|(i, r)| **r as usize == *i) {
            let t = &scene.triangles[i / 3];
            number[*root as usize] = u32::try_from(vertex.len()).unwrap_or(u32::MAX);
            vertex.push(t.vertices[i % 3]);
            rest.push(places[i / 3][i % 3]);
        }
        let at = |i: usize| number[group[i] as usize];
        let corners = (0..scene.triangles.len()).map(|f| [at(3 * f), at(3 * f + 1), at(3 * f + 2)]).collect();
        let sewn = groups(scene.positions.len(), &scene.stitches);
        let knots = scene.positions.len();
        let mark = |vertices: &mut dyn Iterator<Item = u32>| {
            let mut marked = vec![false; knots];
            vertices.for_each(|v| marked[sewn[v as usize] as usize] = true);
            marked
        };
        let fixed = mark(&mut scene.loads.iter().map(|l| l.vertex));
        let pinned = mark(&mut scene.pins.iter().map(|p| p.vertex));
        let knot = vertex.iter().map(|v| sewn[*v as usize]).collect();
        Self { corners, vertex, rest, places, curved, knot, knots, fixed, pinned }
    }
}

/// Pairs of triangle corners that are one place of the cloth: neighbours across an edge with the same rest places.
fn joined(scene: &Scene, places: &[[Vec3; 3]]) -> Vec<[u32; 2]> {
    let rest = |i: usize| places[i / 3][i % 3];
    let mut pairs = Vec::new();
    for same in prolong::sides(scene).chunk_by(|p, q| (p.0, p.1) == (q.0, q.1)) {
        for (n, p) in same.iter().enumerate() {
            for q in &same[n + 1..] {
                let material = scene.triangles[p.2 / 3].material == scene.triangles[q.2 / 3].material;
                if material && prolong::near(&rest(p.2), &rest(q.2)) && prolong::near(&rest(p.3), &rest(q.3)) {
                    let link = |i: usize, j: usize| [i, j].map(|c| u32::try_from(c).unwrap_or(u32::MAX));
                    pairs.extend([link(p.2, q.2), link(p.3, q.3)]);
                }
            }
        }
    }
    pairs
}
