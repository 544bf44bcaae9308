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

/// A property of a flattened piece that a pattern maker checks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CheckKind {
    /// Change of its area, as a share.
    Area,
    /// Change of the length of an edge, metres.
    Edge,
    /// Change of a sewn edge beside its seam partner, from the start of the seam to the worst station, metres.
    Seam,
    /// Change of the intake of a dart, metres.
    DartIntake,
    /// Difference of the legs of a dart, metres.
    DartLegs,
    /// Change of the way of a notch from the start of its edge, metres.
    Notch,
    /// Change of the way of a notch beside the same place of the seam partner, metres.
    NotchPartner,
    /// Turn of a corner, radians.
    Corner,
    /// Bow of an edge that was straight, metres.
    Bow,
    /// Distance from the mirror image, metres.
    Symmetry,
    /// Turn of the grain line, radians.
    Grain,
    /// Places where its outline crosses itself, up to 100.
    Overlap,
    /// Largest strain that no flat piece avoids, as a share.
    Strain,
}

/// The largest change of one kind on a piece.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Check {
    /// The property that was checked.
    pub kind: CheckKind,
    /// Where: the name of an edge, a seam, a dart or another piece.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub place: String,
    /// The notch, as `FRONT.n3`; empty where it is about none.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub notch: String,
    /// How far along the edge or seam, metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub along: Option<f64>,
    /// The change: a share, metres or radians.
    pub value: f64,
    /// The largest change that is allowed. `None` where it was not judged.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub limit: Option<f64>,
}

impl Check {
    /// Is the change within what is allowed?
    #[must_use]
    pub fn passes(&self) -> bool {
        self.limit.is_none_or(|limit| self.value.abs() <= limit)
    }

    /// The change in the words of the trade: `side seam 1.8 mm off its partner at 212 mm`.
    #[must_use]
    pub fn words(&self) -> String {
        let (place, mm) = (&self.place, 1e3 * self.value);
        let notch = if self.notch.is_empty() { "a notch".to_owned() } else { format!("notch `{}`", self.notch) };
        let (size, degrees) = (mm.abs(), self.value.to_degrees());
        let at = self.along.map(|s| format!(", {:.0} mm from its start", 1e3 * s)).unwrap_or_default();
        match self.kind {
            CheckKind::Area => format!("area {:+.2} %", 100.0 * self.value),
            CheckKind::Edge => format!("{place} {mm:+.2} mm"),
            CheckKind::Seam => format!("seam `{place}` {size:.2} mm off its partner{at}"),
            CheckKind::DartIntake => format!("intake of dart `{place}` {mm:+.2} mm"),
            CheckKind::DartLegs => format!("legs of dart `{place}` differ by {size:.2} mm"),
            CheckKind::Notch => format!("{notch} on {place} moved by {mm:+.2} mm{at}"),
            CheckKind::NotchPartner => format!("{notch} of seam `{place}` {size:.2} mm off its partner{at}"),
            CheckKind::Corner => format!("{place} turned by {degrees:+.2}°"),
            CheckKind::Bow => format!("{place}, once straight, bows by {size:.2} mm"),
            CheckKind::Symmetry if place.is_empty() => format!("{size:.2} mm off its own mirror image"),
            CheckKind::Symmetry => format!("{size:.2} mm off the mirror image of `{place}`"),
            CheckKind::Grain => format!("grain turned by {degrees:+.2}°"),
            CheckKind::Overlap => format!("its outline crosses itself at {:.0} places", self.value),
            CheckKind::Strain => format!("laid flat it is strained by {:.0} %", 100.0 * self.value.abs()),
        }
    }
}

/// The verdict on a flattened piece.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PieceVerdict {
    /// Piece.
    pub piece: PieceId,
    /// The worst of every kind.
    pub checks: Vec<Check>,
}

impl PieceVerdict {
    /// Is every change within what is allowed?
    #[must_use]
    pub fn passes(&self) -> bool {
        self.checks.iter().all(Check::passes)
    }

    /// Words for the checks that are over their limits.
    #[must_use]
    pub fn fails(&self) -> Vec<String> {
        self.checks.iter().filter(|c| !c.passes()).map(Check::words).collect()
    }
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
    /// A verdict on every piece; none where the stored pieces came back.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub verdicts: Vec<PieceVerdict>,
}
