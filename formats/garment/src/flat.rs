//! The surface flattened back to 2D.

use crate::Vec2;
use crate::ids::PieceId;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Length of an edge or leg before and after, metres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LengthChange {
    /// Name of the feature: `edge 3`, `side-left`, `dart-1 leg 0`.
    pub name: String,
    /// In the original piece.
    pub original: f64,
    /// In the flattened piece.
    pub flat: f64,
    /// On the 3D surface.
    pub surface: f64,
}

/// A dart before and after.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DartChange {
    /// Name.
    pub name: String,
    /// Angle at the apex, radians: original, flat.
    pub angle: [f64; 2],
    /// Mouth width, metres: original, flat.
    pub width: [f64; 2],
    /// Leg lengths, metres: original a, original b, flat a, flat b.
    pub legs: [f64; 4],
}

/// Strain of the cloth, per triangle.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StrainMap {
    /// Along the warp.
    pub warp: Vec<f64>,
    /// Along the weft.
    pub weft: Vec<f64>,
    /// Shear angle, radians.
    pub shear: Vec<f64>,
}

/// One flattened piece.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FlatPiece {
    /// Piece.
    pub piece: PieceId,
    /// Flat positions, one per mesh vertex, metres, on the stored grain.
    #[schemars(with = "Vec<[f64; 2]>")]
    pub positions: Vec<Vec2>,
    /// Area: original, flat, surface; square metres.
    pub area: [f64; 3],
    /// Edges between corners.
    pub edges: Vec<LengthChange>,
    /// Darts.
    pub darts: Vec<DartChange>,
    /// Turn of the grain line against the original, radians.
    pub grain_shift: f64,
    /// Strain from the original piece to the surface (the drape's own strain).
    pub drape_strain: StrainMap,
    /// Strain from the flattened piece to the surface.
    pub flat_strain: StrainMap,
    /// Rounds the solver took.
    pub rounds: u32,
    /// Largest motion in the last round, metres.
    pub last_motion: f64,
    /// Enclosed Gaussian curvature of the lengths asked for (angle defect summed over inner vertices), radians.
    pub curvature: f64,
    /// Strain that no flat piece can avoid, lengths asked for against flat: mean and largest of |stretch − 1|.
    #[serde(default)]
    pub forced_strain: [f64; 2],
}

/// A sewn pair after flattening.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PairChange {
    /// Seam name.
    pub name: String,
    /// Length of side a: original, flat; metres.
    pub a: [f64; 2],
    /// Length of side b: original, flat; metres.
    pub b: [f64; 2],
}

/// Which lengths the flattened pieces were asked to have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FlatMetric {
    /// Those of the 3D surface: nothing is known of the cloth's strain.
    #[default]
    Surface,
    /// The stored ones, changed by what the 3D edit changed; the strain of the drape stays in the cloth.
    Carried,
    /// The stored ones, since the drape was not edited: the stored piece comes back by construction.
    Unedited,
}

/// All flattened pieces.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Flat {
    /// Lengths asked for.
    #[serde(default)]
    pub metric: FlatMetric,
    /// One per piece.
    pub pieces: Vec<FlatPiece>,
    /// Sewn pairs.
    pub pairs: Vec<PairChange>,
    /// How many changes are over their tolerance, where a tolerance was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub over_tolerance: Option<usize>,
}
