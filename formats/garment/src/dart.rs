//! Darts and pleats as structure: mouth pointers and ordered inner points.
//!
//! Liu, Chen, Shi 2003, §1.3.1 and Fig. 4: a dart starts at pointers to boundary points and its shape is an
//! ordered list of inner points. Here the points become vertex ids when the piece is meshed, so the structure
//! cannot be lost on the way to 3D and the flattening uses it again.

use crate::{SourceRef, Vec2};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How the dart lies in the pattern.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum DartKind {
    /// A wedge that the outline follows: mouth, apex, mouth are outline vertices.
    Wedge,
    /// The outline runs straight over the mouth; the legs are internal lines. The intake is cut out when meshed.
    MarkedWedge,
    /// Closed lens inside the piece with two apexes.
    FishEye,
    /// Fold lines with a depth, sewn for part of their length or only at the mouth.
    Pleat,
}

/// How the dart was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DartEvidence {
    /// Wedge test on the outline.
    BoundaryWedge,
    /// Lines on layer 8 with ends on the boundary.
    InternalLine,
    /// Closed line on layer 8 or 11.
    Contour,
    /// Notches at the mouth and a drill hole.
    DrillAndNotches,
    /// Declared in the sewing file.
    Declared,
}

/// A dart of a piece.
///
/// A wedge has one apex, `mouth = [m0, m1]` and `legs = [m0..apex, m1..apex]`.
/// A fish-eye has two apexes, `mouth` holds its two widest points and
/// `legs[0]`, `legs[1]` run from `apexes[0]` over `mouth[i]` to `apexes[1]`.
/// `legs[0]` is met first when the outline is walked counter-clockwise.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Dart {
    /// Name, unique in the piece.
    pub name: String,
    /// Kind.
    pub kind: DartKind,
    /// Evidence.
    pub evidence: DartEvidence,
    /// One apex, or two for a fish-eye.
    #[schemars(with = "Vec<[f64; 2]>")]
    pub apexes: Vec<Vec2>,
    /// Mouth points (wedge), or the two widest points (fish-eye).
    #[schemars(with = "[[f64; 2]; 2]")]
    pub mouth: [Vec2; 2],
    /// Ordered points of each leg, from mouth to apex (fish-eye: from apex to apex), ends included.
    #[schemars(with = "[Vec<[f64; 2]>; 2]")]
    pub legs: [Vec<Vec2>; 2],
    /// Which line carries it: `cut`, `sew` or `internal`.
    pub line: String,
    /// Pleat depth, metres (pleats only).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub depth: Option<f64>,
    /// Vertex ids once the piece is meshed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mesh: Option<DartMesh>,
    /// Origin.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<SourceRef>,
}

/// The dart in the mesh of its piece: vertex ids, never coordinates.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct DartMesh {
    /// Ordered vertex ids of each leg, in the order of [`Dart::legs`]. Both legs hold equally many;
    /// `legs[0][k]` is sewn to `legs[1][k]`, and they share the apex id(s).
    pub legs: [Vec<u32>; 2],
}

impl Dart {
    /// Width of the mouth (or the widest place of a fish-eye), metres.
    #[must_use]
    pub fn intake(&self) -> f64 {
        (self.mouth[1] - self.mouth[0]).norm()
    }

    /// Length of one leg along its path, metres.
    #[must_use]
    pub fn leg_length(&self, leg: usize) -> f64 {
        self.legs[leg].windows(2).map(|w| (w[1] - w[0]).norm()).sum()
    }
}

/// Ends of the two lines of a pleat, in the order of its mouth points. A pleat that is held at its mouth alone has none.
#[must_use]
pub fn pleat_ends(mouth: &[Vec2; 2], apexes: &[Vec2]) -> [Option<Vec2>; 2] {
    match apexes {
        [] => [None, None],
        [one] => [Some(*one), Some(*one)],
        [a, b, ..] => {
            let straight = (a - mouth[0]).norm() + (b - mouth[1]).norm();
            let crossed = (b - mouth[0]).norm() + (a - mouth[1]).norm();
            if straight <= crossed { [Some(*a), Some(*b)] } else { [Some(*b), Some(*a)] }
        }
    }
}
