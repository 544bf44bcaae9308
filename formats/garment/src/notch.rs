//! Notches: boundary marks that say what meets what.

use crate::{SourceRef, Vec2};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Shape of a notch (layers 4 and 80 to 83).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum NotchKind {
    /// Cut straight in.
    #[serde(rename = "slit")]
    Slit,
    /// V notch.
    V,
    /// T notch (layer 80).
    T,
    /// Castle notch (layer 81).
    #[serde(rename = "castle")]
    Castle,
    /// Check notch (layer 82).
    #[serde(rename = "check")]
    Check,
    /// U notch (layer 83).
    U,
}

/// A notch of a piece.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Notch {
    /// Shape.
    pub kind: NotchKind,
    /// Position as in the file, metres, piece plane.
    #[schemars(with = "[f64; 2]")]
    pub at: Vec2,
    /// Depth into the cloth, metres.
    pub depth: f64,
    /// Width at the line, metres.
    pub width: f64,
    /// Inward direction, radians from +x, where the file gives one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angle: Option<f64>,
    /// Which line it sits on: `boundary`, `sew`, `internal`, `fold` for a mark on the fold of a piece that was
    /// unfolded, or `off` when none is near.
    pub on: String,
    /// Name, e.g. the matching label of the sewing file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Origin.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<SourceRef>,
}

impl Notch {
    /// Does it sit on the edge of the cloth, or on the line that is sewn?
    #[must_use]
    pub fn is_on_edge(&self) -> bool {
        !matches!(self.on.as_str(), "internal" | "fold" | "off")
    }
}
