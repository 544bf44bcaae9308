//! Mesh vertices in groups that stitches make one point.

use crate::joined::Joined;
use toile_garment::seam::Seam;
use toile_garment::{Garment, MeshVertex, Piece};

/// The groups of all mesh vertices of a garment.
pub struct SewnPoints {
    /// Number of the first vertex of every piece.
    first: Vec<usize>,
    joined: Joined,
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
        let mut points = Self { first, joined: Joined::new(count) };
        for stitch in seams.iter().flat_map(|s| &s.stitches) {
            points.joined.join(points.number(stitch.a), points.number(stitch.b));
        }
        points
    }

    /// A side of a triangle of the piece whose two ends are one point: its mesh vertices. No cloth can be that narrow.
    pub fn collapsed_side(&mut self, piece: &Piece) -> Option<[u32; 2]> {
        let of = |vertex| MeshVertex { piece: piece.id, vertex };
        let triangles = piece.mesh.iter().flat_map(|m| &m.triangles);
        let mut sides = triangles.flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]);
        sides.find(|side| {
            let [a, b] = side.map(|v| self.number(of(v)));
            self.joined.root(a) == self.joined.root(b)
        })
    }

    /// Returns `true` if stitches make two vertices one point.
    pub fn are_one(&mut self, a: MeshVertex, b: MeshVertex) -> bool {
        let [a, b] = [self.number(a), self.number(b)];
        self.joined.root(a) == self.joined.root(b)
    }

    /// The number of a vertex in the whole garment.
    fn number(&self, v: MeshVertex) -> usize {
        self.first[v.piece.index()] + v.vertex as usize
    }
}
