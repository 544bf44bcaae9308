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
}

/// Name of a pair: its kind and its vertices (for a body triangle, its index). The same pair has the same key at every evaluation.
pub(crate) type PairKey = (PairKind, [u32; 4]);
