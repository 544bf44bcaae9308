//! The kinds of primitive pairs that may touch.

/// Kind of a pair of primitives. The order is the order in which contacts are summed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum PairKind {
    /// A cloth vertex and a cloth triangle.
    VertexTriangle,
    /// Two cloth edges.
    EdgeEdge,
    /// A cloth vertex and a body triangle.
    VertexBodyTriangle,
    /// A cloth edge and a body edge.
    EdgeBodyEdge,
    /// A cloth triangle and a body vertex.
    TriangleBodyVertex,
}

impl PairKind {
    /// Does the pair consist of cloth alone?
    pub fn is_cloth_only(self) -> bool {
        self <= Self::EdgeEdge
    }

    /// Number of cloth vertices in the pair. They come first.
    #[inline]
    pub fn cloth_vertex_count(self) -> usize {
        match self {
            Self::VertexTriangle | Self::EdgeEdge => 4,
            Self::VertexBodyTriangle => 1,
            Self::EdgeBodyEdge => 2,
            Self::TriangleBodyVertex => 3,
        }
    }
}

/// Identity of a pair: its kind and its vertices, or the index of a body triangle. A pair has the same key at every
/// evaluation.
pub(crate) type PairKey = (PairKind, [u32; 4]);
