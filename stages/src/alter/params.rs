//! Parameters of `alter`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use toile_garment::units::{Length, Share};

/// Parameters of `alter`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AlterParams {
    /// The changes, made one after another. Edges and darts are called as they are after the change before.
    #[serde(default)]
    pub change: Vec<Change>,
}

/// A change of a piece.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "do", rename_all = "lowercase")]
pub enum Change {
    /// Turns a dart into another place of the outline, about its point.
    Pivot(Pivot),
    /// Closes a dart and lets the edge open instead: slash and spread. The edge becomes longer by the intake there.
    Close(Close),
    /// Moves the point of a dart.
    Point(MovePoint),
    /// Cuts a piece apart along a line, and sews the parts to each other.
    Cut(Cut),
}

impl Change {
    /// Name of the piece.
    pub fn piece(&self) -> &str {
        match self {
            Self::Pivot(p) => &p.piece,
            Self::Close(p) => &p.piece,
            Self::Point(p) => &p.piece,
            Self::Cut(p) => &p.piece,
        }
    }

    /// Its places.
    pub fn spots(&mut self) -> Vec<&mut Spot> {
        match self {
            Self::Pivot(p) => vec![&mut p.to],
            Self::Close(p) => vec![&mut p.to],
            Self::Point(p) => vec![&mut p.to],
            Self::Cut(p) => p.along.iter_mut().collect(),
        }
    }
}

/// Turns a dart into another place of the outline.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Pivot {
    /// Name of the piece.
    pub piece: String,
    /// Name of the dart, e.g. `dart-1`. `toile inspect` lists them.
    pub dart: String,
    /// Where the dart is to open.
    pub to: Spot,
    /// How much of its angle is turned there (`"100 %"`). What is left stays in the old place.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub share: Option<Share>,
    /// How far the points of both darts are drawn back from each other where a part of the angle is turned (20 mm).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub back: Option<Length>,
}

/// Closes a dart and spreads an edge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Close {
    /// Name of the piece.
    pub piece: String,
    /// Name of the dart.
    pub dart: String,
    /// Where the edge is to spread.
    pub to: Spot,
}

/// Moves the point of a dart.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MovePoint {
    /// Name of the piece.
    pub piece: String,
    /// Name of the dart.
    pub dart: String,
    /// The new point.
    pub to: Spot,
}

/// Cuts a piece apart.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cut {
    /// Name of the piece.
    pub piece: String,
    /// The line, from a place on the outline or the point of a dart to another one. At the point of a dart it goes on
    /// along the legs, and the dart is taken up by the seam.
    pub along: Vec<Spot>,
    /// Names of the parts as the piece is drawn: `{ upper = "YOKE", lower = "FRONT" }` along the grain, or
    /// `{ left = …, right = … }` across it.
    pub into: Parts,
    /// Name of the seam between them; without it the names of both parts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seam: Option<String>,
    /// Seam allowance of the new edges, where the piece has a cut line (10 mm).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub allowance: Option<Length>,
    /// True where the line is a smooth curve through its places.
    #[serde(default)]
    pub smooth: bool,
}

/// Names of two parts.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "{ upper = …, lower = … } or { left = …, right = … }")]
pub enum Parts {
    /// One above the other, along the grain.
    Along(Along),
    /// Side by side, across the grain.
    Across(Across),
}

/// Names of parts above one another.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Along {
    /// The upper one.
    pub upper: String,
    /// The lower one.
    pub lower: String,
}

/// Names of parts beside each other.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Across {
    /// The left one, as the piece is drawn.
    pub left: String,
    /// The right one.
    pub right: String,
}

/// A place on a piece.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "the name of a dart, whose point is meant, [x, y] in mm on the piece, [x, y, z] in mm on the draped \
                 garment, or { edge = …, at = … }"
)]
pub enum Spot {
    /// The point of a dart.
    Dart(String),
    /// Coordinates of the piece, mm.
    Plane([f64; 2]),
    /// The place of the piece that is nearest to a point in space, mm, in the axes of the files: on the drape, or on
    /// what was sewn.
    Space([f64; 3]),
    /// A place on an edge.
    Edge(EdgeSpot),
}

/// A place on an edge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EdgeSpot {
    /// Number or name of the edge, as `toile inspect` tells it.
    pub edge: EdgeLabel,
    /// Where on it, as in a sewing file: `"40 mm"`, `"30 % from end"`, `"notch 1"`, `"middle"`.
    pub at: String,
}

/// Number or name of an edge.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "the number of an edge, or its name")]
pub enum EdgeLabel {
    /// Its number.
    Number(u32),
    /// Its name.
    Name(String),
}

impl EdgeLabel {
    /// The label that a sewing file has.
    pub fn text(&self) -> String {
        match self {
            Self::Number(n) => n.to_string(),
            Self::Name(n) => n.clone(),
        }
    }
}
