//! The mesh of a piece in its own plane.

use crate::Vec2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The kind of a chain of mesh edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ChainKind {
    /// The outline (closed).
    Outline,
    /// A cutout (closed).
    Cutout,
    /// A leg of a dart (open; the same ids stand in the dart).
    DartLeg,
    /// An internal line, or a fold line of a pleat.
    InternalLine,
    /// A line inside the piece to which another piece is sewn (open).
    SeamLine,
}

/// A chain of mesh edges that a line of the piece became.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct MeshChain {
    /// Kind of the chain.
    pub kind: ChainKind,
    /// Index of the line it came from (outline 0, cutout k, dart k, internal line k, seam line k).
    pub index: u32,
    /// Vertex ids in order; neighbours are joined by mesh edges. A closed chain does not repeat its first id.
    pub vertices: Vec<u32>,
    /// Is the last vertex joined to the first?
    pub closed: bool,
}

/// Triangles of a piece, counter-clockwise in the piece plane, right side of the cloth up.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PieceMesh {
    /// Rest positions, metres.
    #[schemars(with = "Vec<[f64; 2]>")]
    pub rest: Vec<Vec2>,
    /// Triangles.
    pub triangles: Vec<[u32; 3]>,
    /// Chains; the first is the outer outline of the meshed cloth (marked dart intakes cut out), counter-clockwise.
    pub chains: Vec<MeshChain>,
    /// For every vertex of the piece outline (`Piece::outline.points`) its mesh vertex, where it is one.
    pub outline_vertex: Vec<Option<u32>>,
    /// Rest positions of the corners of every triangle, metres, where no single flat layout holds them all: the rest
    /// shape of a curved cloth mesh (import-mesh), or a layout with cuts. Each triangle has a frame of its own, x along
    /// the weft, y along the warp, counter-clockwise. When set, it is the rest shape, and `rest` only a picture.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<Vec<[[f64; 2]; 3]>>")]
    pub rest_corners: Option<Vec<[Vec2; 3]>>,
}

impl PieceMesh {
    /// The chain of the outer outline.
    #[must_use]
    pub fn outline(&self) -> Option<&MeshChain> {
        self.chains.iter().find(|c| c.kind == ChainKind::Outline)
    }

    /// Rest positions of the corners of triangle `t`, metres.
    #[must_use]
    pub fn rest_triangle(&self, t: usize) -> Option<[Vec2; 3]> {
        if let Some(corners) = &self.rest_corners {
            return corners.get(t).copied();
        }
        let [a, b, c] = self.triangles.get(t)?.map(|i| self.rest.get(i as usize).copied());
        Some([a?, b?, c?])
    }

    /// Area of the mesh at rest, square metres.
    #[must_use]
    pub fn area(&self) -> f64 {
        let cross = |[a, b, c]: [Vec2; 3]| 0.5 * (b - a).perp(&(c - a));
        (0..self.triangles.len()).filter_map(|t| self.rest_triangle(t)).map(cross).sum()
    }

    /// Signed area of one triangle, square metres.
    #[must_use]
    pub fn triangle_area(&self, t: [u32; 3]) -> f64 {
        let [a, b, c] = t.map(|i| self.rest[i as usize]);
        0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x))
    }
}
