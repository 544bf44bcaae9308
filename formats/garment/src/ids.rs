//! Typed ids that tie the aspects of a garment together.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

macro_rules! id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema)]
        #[serde(transparent)]
        pub struct $name(pub u32);

        impl $name {
            /// The id as an index into the list it belongs to.
            #[must_use]
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }

        impl From<usize> for $name {
            fn from(index: usize) -> Self {
                Self(u32::try_from(index).unwrap_or(u32::MAX))
            }
        }
    };
}

id!(
    /// Index of a piece in `Garment::pieces`.
    PieceId
);
id!(
    /// Index of a dart in `Piece::darts` of its piece.
    DartId
);
id!(
    /// Index of a seam in `Garment::seams`.
    SeamId
);

/// One vertex of one meshed piece: the index is into `PieceMesh::rest`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema)]
pub struct MeshVertex {
    /// The piece.
    pub piece: PieceId,
    /// The vertex within the piece.
    pub vertex: u32,
}
