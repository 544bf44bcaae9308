//! Mesh vertices in groups that stitches make one point.

use toile_garment::seam::Seam;
use toile_garment::{Garment, MeshVertex, Piece};

/// The groups of all mesh vertices of a garment.
pub struct SewnPoints {
    /// Number of the first vertex of every piece.
    first: Vec<usize>,
    /// Another vertex of the same group, or the vertex itself.
    parent: Vec<usize>,
}

impl SewnPoints {
    /// The groups that the stitches of these seams make.
    pub fn new(garment: &Garment, seams: &[Seam]) -> Self {
        let mut first = Vec::with_capacity(garment.pieces.len());
        let mut count = 0;
        for piece in &garment.pieces {
            first.push(count);
            count += piece.mesh.as_ref().map_or(0, |m| m.rest.len());
        }
        let mut points = Self { first, parent: (0..count).collect() };
        for stitch in seams.iter().flat_map(|s| &s.stitches) {
            points.join(stitch.a, stitch.b);
        }
        points
    }

    /// A side of a triangle of the piece whose two ends are one point: its mesh vertices. No cloth can be that narrow.
    pub fn collapsed_side(&mut self, piece: &Piece) -> Option<[u32; 2]> {
        let of = |vertex| MeshVertex { piece: piece.id, vertex };
        let triangles = piece.mesh.iter().flat_map(|m| &m.triangles);
        let mut sides = triangles.flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]);
        sides.find(|[a, b]| self.point(of(*a)) == self.point(of(*b)))
    }

    /// The vertex that stands for the group.
    fn point(&mut self, v: MeshVertex) -> usize {
        let mut at = self.first[v.piece.index()] + v.vertex as usize;
        while self.parent[at] != at {
            self.parent[at] = self.parent[self.parent[at]];
            at = self.parent[at];
        }
        at
    }

    fn join(&mut self, a: MeshVertex, b: MeshVertex) {
        let (a, b) = (self.point(a), self.point(b));
        self.parent[a.max(b)] = a.min(b);
    }
}
