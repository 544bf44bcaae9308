//! The garment as one surface: sewn vertices are one vertex.

use crate::joined::Joined;
use std::collections::BTreeMap;
use toile_garment::body::Body;
use toile_garment::garment::Shape;
use toile_garment::{Garment, MeshVertex, Vec3};

/// A piece of a free edge shorter than this is a gap at a seam's end and no hem, metres.
const SHORTEST_HEM: f64 = 0.05;

/// The draped surface.
#[derive(Clone, Debug, Default)]
pub struct Surface {
    /// Positions, metres, +y up.
    pub points: Vec<Vec3>,
    /// Triangles.
    pub triangles: Vec<[u32; 3]>,
    /// Piece of each triangle.
    pub piece: Vec<u32>,
}

/// A free edge of the sewn garment: hem, neckline, waist.
#[derive(Clone, Debug, PartialEq)]
pub struct Hem {
    /// Pieces it runs along.
    pub pieces: Vec<u32>,
    /// Mean height along the edge, metres.
    pub height: f64,
    /// Mean place to the side, metres; tells left from right.
    pub side: f64,
    /// Least and largest place to the side, metres.
    pub sides: [f64; 2],
    /// Lowest and highest point, metres.
    pub heights: [f64; 2],
    /// Length in 3D, metres.
    pub length: f64,
    /// Its edges, as numbers of triangles of the surface and of the corner at which each edge begins.
    pub edges: Vec<(usize, usize)>,
}

/// An edge that only one triangle has: its ends, its piece, and that triangle with the corner at which it begins.
type FreeEdge = ([u32; 2], u32, (usize, usize));

impl Surface {
    /// The surface of a draped garment; `None` before the drape.
    #[must_use]
    pub fn of(garment: &Garment) -> Option<Self> {
        garment.drape.as_ref().map(|shape| Self::sewn(garment, shape))
    }

    /// The surface of a body.
    #[must_use]
    pub fn of_body(body: &Body) -> Self {
        let piece = vec![0; body.triangles.len()];
        Self { points: body.positions.clone(), triangles: body.triangles.clone(), piece }
    }

    /// The surface of a garment in some shape.
    fn sewn(garment: &Garment, shape: &Shape) -> Self {
        let mut first = Vec::new();
        let mut points = Vec::new();
        for positions in &shape.positions {
            first.push(points.len());
            points.extend_from_slice(positions);
        }
        let index = |v: &MeshVertex| first.get(v.piece.index()).map(|f| f + v.vertex as usize);
        let mut joined = Joined::new(points.len());
        for stitch in garment.seams.iter().flat_map(|s| &s.stitches) {
            if let (Some(a), Some(b)) = (index(&stitch.a), index(&stitch.b)) {
                joined.join(a, b);
            }
        }
        let mut surface = Self { points, ..Self::default() };
        for (number, piece) in garment.pieces.iter().enumerate() {
            for triangle in piece.mesh.iter().flat_map(|m| &m.triangles) {
                let whole = triangle.map(|v| joined.root(first[number] + v as usize) as u32);
                surface.triangles.push(whole);
                surface.piece.push(number as u32);
            }
        }
        surface
    }

    /// Corners of a triangle.
    #[must_use]
    pub fn corners(&self, triangle: usize) -> [Vec3; 3] {
        self.triangles[triangle].map(|v| self.points[v as usize])
    }

    /// Lowest and highest point of the cloth, metres.
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        let heights = self.triangles.iter().flatten().map(|v| self.points[*v as usize].y);
        heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], y| [low.min(y), high.max(y)])
    }

    /// All free edges, in an order that does not depend on the mesh.
    #[must_use]
    pub fn hems(&self) -> Vec<Hem> {
        let mut joined = Joined::new(self.points.len());
        let free = self.free_edges();
        free.iter().for_each(|(e, ..)| joined.join(e[0] as usize, e[1] as usize));
        let mut by_part: BTreeMap<usize, Vec<&FreeEdge>> = BTreeMap::new();
        for edge in &free {
            by_part.entry(joined.root(edge.0[0] as usize)).or_default().push(edge);
        }
        let mut hems: Vec<Hem> = by_part.values().map(|edges| self.hem(edges)).collect();
        hems.retain(|h| h.length >= SHORTEST_HEM);
        let order = |a: &Hem, b: &Hem| {
            a.pieces.cmp(&b.pieces).then(a.height.total_cmp(&b.height)).then(a.side.total_cmp(&b.side))
        };
        hems.sort_by(order);
        hems
    }

    /// Edges of one triangle only.
    fn free_edges(&self) -> Vec<FreeEdge> {
        let mut edges: Vec<FreeEdge> = Vec::with_capacity(3 * self.triangles.len());
        for (t, (corners, piece)) in self.triangles.iter().zip(&self.piece).enumerate() {
            edges.extend((0..3).map(|k| {
                let (p, q) = (corners[k], corners[(k + 1) % 3]);
                ([p.min(q), p.max(q)], *piece, (t, k))
            }));
        }
        edges.sort_unstable();
        let alone = |group: &[FreeEdge]| (group.len() == 1).then(|| group[0]);
        edges.chunk_by(|a, b| a.0 == b.0).filter_map(alone).collect()
    }

    fn hem(&self, edges: &[&FreeEdge]) -> Hem {
        const NOTHING: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];
        let wider = |[low, high]: [f64; 2], x: f64| [low.min(x), high.max(x)];
        let mut hem = Hem {
            pieces: Vec::new(),
            height: 0.0,
            side: 0.0,
            sides: NOTHING,
            heights: NOTHING,
            length: 0.0,
            edges: Vec::new(),
        };
        for ([a, b], piece, place) in edges {
            hem.edges.push(*place);
            let [a, b] = [a, b].map(|v| self.points[*v as usize]);
            let length = (b - a).norm();
            let middle = 0.5 * (a + b);
            hem.length += length;
            hem.height += length * middle.y;
            hem.side += length * middle.x;
            hem.sides = [a, b].iter().fold(hem.sides, |sides, p| wider(sides, p.x));
            hem.heights = [a, b].iter().fold(hem.heights, |heights, p| wider(heights, p.y));
            hem.pieces.push(*piece);
        }
        hem.pieces.sort_unstable();
        hem.pieces.dedup();
        let whole = hem.length.max(f64::MIN_POSITIVE);
        Hem { height: hem.height / whole, side: hem.side / whole, ..hem }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A tube of `n` sides and `rows` rows around the y axis: radius and height in metres.
    pub fn tube(n: u32, rows: u32, radius: f64, height: f64) -> Surface {
        let mut surface = Surface::default();
        for row in 0..=rows {
            for k in 0..n {
                let t = f64::from(k) * std::f64::consts::TAU / f64::from(n);
                let y = height * f64::from(row) / f64::from(rows);
                surface.points.push(Vec3::new(radius * libm::cos(t), y, radius * libm::sin(t)));
            }
        }
        for row in 0..rows {
            for k in 0..n {
                let (a, b) = (row * n + k, row * n + (k + 1) % n);
                surface.triangles.extend([[a, b, a + n], [b, b + n, a + n]]);
                surface.piece.extend([0, 0]);
            }
        }
        surface
    }

    #[test]
    fn a_tube_has_two_hems() {
        let hems = tube(60, 10, 0.2, 0.7).hems();
        assert_eq!(hems.len(), 2);
        assert!(hems[0].height.abs() < 1e-12 && (hems[1].height - 0.7).abs() < 1e-12);
        let chord = 60.0 * 2.0 * 0.2 * libm::sin(std::f64::consts::PI / 60.0);
        assert!(hems.iter().all(|h| (h.length - chord).abs() < 1e-12));
        assert_eq!(tube(60, 10, 0.2, 0.7).range(), [0.0, 0.7]);
    }

    #[test]
    fn sewn_vertices_are_one() {
        let mut joined = Joined::new(5);
        joined.join(4, 2);
        joined.join(2, 1);
        assert_eq!((joined.root(4), joined.root(3)), (1, 3));
    }
}
