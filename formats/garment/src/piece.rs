//! A pattern piece.

use crate::dart::{Dart, DartKind};
use crate::ids::PieceId;
use crate::mesh::PieceMesh;
use crate::notch::Notch;
use crate::outline::{LinePoint, OutlineEdge, PieceLine};
use crate::{SourceRef, Vec2};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How often a piece is cut: plain, and mirrored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Quantity {
    /// Copies lie as drawn.
    pub plain: u32,
    /// Mirrored.
    pub mirrored: u32,
}

impl Default for Quantity {
    fn default() -> Self {
        Self { plain: 1, mirrored: 0 }
    }
}

/// A drill hole (layer 13).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DrillHole {
    /// Position, metres.
    #[schemars(with = "[f64; 2]")]
    pub at: Vec2,
    /// Diameter, metres, where the file gives one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub diameter: Option<f64>,
    /// Origin.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<SourceRef>,
}

/// A text that belongs to a piece and has no meaning for the program; kept for export.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PieceText {
    /// Position, metres.
    #[schemars(with = "[f64; 2]")]
    pub at: Vec2,
    /// DXF layer.
    pub layer: String,
    /// The text.
    pub text: String,
}

/// The vertices of the closed lines of a piece as its file draws them, where the lines alone do not tell them.
///
/// A line that is sewn also holds the points of the smooth curve between them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DrawnVertices {
    /// Vertices of `Piece::outline`, unfolded; none where the line tells them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub outline: Vec<LinePoint>,
    /// Vertices of `Piece::cut_line`, unfolded; none where the line tells them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub cut_line: Vec<LinePoint>,
}

/// A fold that is pressed into the cloth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PressedFold {
    /// Name.
    pub name: String,
    /// Points of its line, metres.
    #[schemars(with = "Vec<[f64; 2]>")]
    pub line: Vec<Vec2>,
    /// Angle by which the cloth is folded back from flat, radians, over 0 where the right side is outside.
    pub angle: f64,
    /// Name of the pleat that it is a fold of.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pleat: Option<String>,
}

/// A pattern piece: what is sewn (`outline`), what is cut (`cut_line`), and all marks on it.
///
/// The right side of the cloth faces the reader. `outline` is counter-clockwise, unfolded, and is the line that is
/// meshed and sewn: the sew line where the file has one, else the cut line. Wedge darts are notched out of it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Piece {
    /// Id, equal to the index in `Garment::pieces`.
    pub id: PieceId,
    /// Name, unique in the garment.
    pub name: String,
    /// DXF block it came from.
    pub block: String,
    /// Size label.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size: Option<String>,
    /// How often it is cut.
    #[serde(default)]
    pub quantity: Quantity,
    /// Material name, as the file says or the texture stage sets.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// Category text.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub category: Option<String>,
    /// Annotation text.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub annotation: Option<String>,
    /// True if the piece is the mirror image of its block.
    #[serde(default)]
    pub mirrored: bool,
    /// The sewn and meshed line, counter-clockwise.
    pub outline: PieceLine,
    /// Edges of `outline` between corners, counter-clockwise, numbered from 0.
    #[serde(default)]
    pub edges: Vec<OutlineEdge>,
    /// The cut line where it differs from `outline` (with seam allowance).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cut_line: Option<PieceLine>,
    /// Vertices of both lines as the file draws them, where the lines do not tell them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drawn: Option<DrawnVertices>,
    /// Notches.
    #[serde(default)]
    pub notches: Vec<Notch>,
    /// Drill holes.
    #[serde(default)]
    pub drill_holes: Vec<DrillHole>,
    /// Grain line; from its first to its second point is the warp direction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<[[f64; 2]; 2]>")]
    pub grain: Option<[Vec2; 2]>,
    /// Fold line of a half piece that was unfolded (layer 6).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<[[f64; 2]; 2]>")]
    pub fold: Option<[Vec2; 2]>,
    /// Internal lines (layer 8), dart legs of marked darts not among them.
    #[serde(default)]
    pub internal_lines: Vec<PieceLine>,
    /// Cutouts (layer 11), holes in the cloth.
    #[serde(default)]
    pub cutouts: Vec<PieceLine>,
    /// Stripe and plaid lines (layers 9 and 10), by which pieces are laid on patterned cloth; named `stripe` or
    /// `plaid`. A mark is a line of one point.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub match_lines: Vec<PieceLine>,
    /// Darts and pleats.
    #[serde(default)]
    pub darts: Vec<Dart>,
    /// Pressed folds.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub folds: Vec<PressedFold>,
    /// Other texts.
    #[serde(default)]
    pub texts: Vec<PieceText>,
    /// The mesh, once triangulated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mesh: Option<PieceMesh>,
    /// Origin.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<SourceRef>,
}

impl Piece {
    /// The name without its size: pieces that are read in several sizes are called `piece@size`.
    #[must_use]
    pub fn base_name(&self) -> &str {
        let of_size = |size: &str| self.name.strip_suffix(size)?.strip_suffix('@').filter(|base| !base.is_empty());
        self.size.as_deref().and_then(of_size).unwrap_or(&self.name)
    }

    /// Area of the cloth inside the sewn line, square metres: without cut-outs, and without the intakes of darts that
    /// are cut out when the piece is meshed.
    #[must_use]
    pub fn cloth_area(&self) -> f64 {
        if let Some(mesh) = &self.mesh {
            return mesh.area();
        }
        let is_cut_out = |d: &&Dart| matches!(d.kind, DartKind::MarkedWedge | DartKind::FishEye);
        let intake = |d: &Dart| area(&d.legs[0].iter().chain(d.legs[1].iter().rev()).copied().collect::<Vec<_>>());
        let intakes: f64 = self.darts.iter().filter(is_cut_out).map(intake).sum();
        let holes: f64 = self.cutouts.iter().map(|c| c.signed_area().abs()).sum();
        self.outline.signed_area().abs() - intakes - holes
    }

    /// Unit warp direction: the grain line where there is one, else +y.
    #[must_use]
    pub fn warp(&self) -> Vec2 {
        self.grain.map(|[a, b]| b - a).filter(|d| d.norm() > 1e-9).map_or_else(|| Vec2::new(0.0, 1.0), |d| d / d.norm())
    }
}

/// Area inside a ring of points, square metres.
fn area(ring: &[Vec2]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(a, b)| 0.5 * a.perp(b)).sum::<f64>().abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dart::DartEvidence;
    use crate::outline::PointKind;

    /// A square of 1 m with a marked dart of 0.1 m × 0.5 m; its outline runs straight over the mouth.
    fn darted(kind: DartKind) -> Piece {
        let [a, apex, b] = [[0.45, 0.0], [0.5, 0.5], [0.55, 0.0]].map(Vec2::from);
        let dart = Dart {
            name: "dart-1".into(),
            kind,
            evidence: DartEvidence::InternalLine,
            apexes: vec![apex],
            mouth: [a, b],
            legs: [vec![a, apex], vec![b, apex]],
            line: "internal".into(),
            depth: None,
            mesh: None,
            source: None,
        };
        let corner = |[x, y]: [f64; 2]| LinePoint { at: Vec2::new(x, y), kind: PointKind::Turn };
        let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(corner).to_vec();
        let outline = PieceLine { points, closed: true, ..PieceLine::default() };
        Piece { outline, darts: vec![dart], ..Piece::default() }
    }

    #[test]
    fn the_area_of_cloth_is_without_the_intake_that_is_cut_out() {
        let near = |kind, area: f64| assert!((darted(kind).cloth_area() - area).abs() < 1e-12);
        near(DartKind::MarkedWedge, 0.975);
        near(DartKind::Pleat, 1.0);
        near(DartKind::Wedge, 1.0);
    }
}
