//! Seams as sewn: vertex runs and stitches.

use crate::ids::{DartId, MeshVertex, PieceId, SeamId};
use crate::source::SourceRef;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Why two runs are sewn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum SeamKind {
    /// Declared in the sewing file.
    Seam,
    /// The two legs of a dart.
    Dart {
        /// Piece that holds the dart.
        piece: PieceId,
        /// The dart.
        dart: DartId,
    },
}

/// A run of mesh vertices along the boundary of one piece.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct SeamRun {
    /// Piece.
    pub piece: PieceId,
    /// Vertex ids in sewing order.
    pub vertices: Vec<u32>,
}

/// One side of a seam: runs in sewing order, possibly over several pieces.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SeamSide {
    /// Runs.
    pub runs: Vec<SeamRun>,
    /// Length, metres.
    pub length: f64,
}

/// One vertex pair made from a seam.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Stitch {
    /// Vertex of side a.
    pub a: MeshVertex,
    /// Vertex of side b.
    pub b: MeshVertex,
}

/// A seam: the design pairing of two boundary runs, with its stitches.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Seam {
    /// Id, equal to the index in `Garment::seams`.
    pub id: SeamId,
    /// Name.
    pub name: String,
    /// Why.
    #[serde(flatten)]
    pub kind: SeamKind,
    /// Side a.
    pub a: SeamSide,
    /// Side b.
    pub b: SeamSide,
    /// Length of a minus length of b, metres.
    pub ease: f64,
    /// Declared gather ratio, longer over shorter.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gather: Option<f64>,
    /// The stitches in sewing order.
    pub stitches: Vec<Stitch>,
    /// Origin.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<SourceRef>,
}
