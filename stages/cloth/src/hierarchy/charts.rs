//! Charts of the cloth: copies of vertices, one for each side of a seam, so that every copy has one rest place.
//!
//! A knot is the class of all vertices that are, or will be, sewn to one point.

use crate::hierarchy::rest_places;
use crate::scene::weld::groups;
use crate::{Scene, Vec3};

/// Copies and knots of all vertices of a scene.
#[derive(Debug)]
pub(crate) struct Charts {
    /// Copies at the corners of every triangle.
    pub corners: Vec<[u32; 3]>,
    /// Vertex of every copy.
    pub vertex: Vec<u32>,
    /// Rest place of every copy, m.
    pub rest: Vec<Vec3>,
    /// Rest places of the corners of every triangle before any collapse, m.
    pub places: Vec<[Vec3; 3]>,
    /// Set where these are places in space, of a curved rest shape.
    pub curved: bool,
    /// Knot of every copy.
    pub seam_class: Vec<u32>,
    /// Number of knots.
    pub seam_classes: usize,
    /// Knots that must stay because of a load, or because lines meet there.
    pub fixed: Vec<bool>,
    /// Knots with a held vertex.
    pub pinned: Vec<bool>,
    /// Number of the band or fold that each knot lies on, counted from 1; 0 for none.
    pub line: Vec<u32>,
}

impl Charts {
    /// The charts of a scene.
    pub fn new(scene: &Scene) -> Self {
        let n = 3 * scene.triangles.len();
        let (places, curved) = rest_places::corners(scene);
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
        let seam_classes = scene.positions.len();
        let mark = |vertices: &mut dyn Iterator<Item = u32>| {
            let mut marked = vec![false; seam_classes];
            vertices.for_each(|v| marked[sewn[v as usize] as usize] = true);
            marked
        };
        let mut fixed = mark(&mut scene.loads.iter().map(|l| l.vertex));
        let pinned = mark(&mut scene.pins.iter().map(|p| p.vertex));
        let mut line = vec![0; seam_classes];
        let lines = scene.bands.iter().map(|b| &b.vertices).chain(scene.folds.iter().map(|f| &f.vertices));
        for (n, vertices) in (1u32..).zip(lines) {
            for v in vertices {
                let k = sewn[*v as usize] as usize;
                // Where lines meet, cloth stays.
                fixed[k] |= line[k] != 0 && line[k] != n;
                line[k] = n;
            }
        }
        let seam_class = vertex.iter().map(|v| sewn[*v as usize]).collect();
        Self { corners, vertex, rest, places, curved, seam_class, seam_classes, fixed, pinned, line }
    }
}

/// Pairs of triangle corners that are one place of the cloth: neighbours across an edge with the same rest places.
fn joined(scene: &Scene, places: &[[Vec3; 3]]) -> Vec<[u32; 2]> {
    let rest = |i: usize| places[i / 3][i % 3];
    let mut pairs = Vec::new();
    for same in rest_places::triangle_sides(scene).chunk_by(|p, q| (p.0, p.1) == (q.0, q.1)) {
        for (n, p) in same.iter().enumerate() {
            for q in &same[n + 1..] {
                let material = scene.triangles[p.2 / 3].material == scene.triangles[q.2 / 3].material;
                if material
                    && rest_places::is_same_place(&rest(p.2), &rest(q.2))
                    && rest_places::is_same_place(&rest(p.3), &rest(q.3))
                {
                    let link = |i: usize, j: usize| [i, j].map(|c| u32::try_from(c).unwrap_or(u32::MAX));
                    pairs.extend([link(p.2, q.2), link(p.3, q.3)]);
                }
            }
        }
    }
    pairs
}
