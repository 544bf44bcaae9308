//! The writer's own drawing: pieces in millimetres, and lines whose points have a kind.

use super::codes;
use super::tags::decimal;
use crate::codes::COORDINATE_OUT_OF_RANGE;
use toile_garment::notch::NotchKind;
use toile_garment::outline::PointKind;
use toile_garment::piece::Quantity;
use toile_garment::{Diagnostic, Vec2};

/// Which of the standards' habits the file follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dialect {
    /// ANSI/AAMA-292: no notch layers 80 and up, no dense copies, `Tolerance`.
    Aama,
    /// ASTM D6673: notch layers 80 to 83, dense copies on 84 and 87, right and left quantity.
    Astm,
    /// The habits of ASTM, with the version header, upper-case keys and group 250 that CLO writes.
    Clo,
    /// The habits of ASTM, with lines split into runs between turn points, texts 0.25 high, and names of 20 ASCII
    /// characters.
    Gerber,
    /// The habits of AAMA, with blocks called by numbers.
    Optitex,
    /// For drawing programs: layers declared with colours and the unit in the header, no dense copies.
    Plain,
}

impl Dialect {
    /// All of them.
    pub const ALL: [Self; 6] = [Self::Aama, Self::Astm, Self::Clo, Self::Gerber, Self::Optitex, Self::Plain];

    /// Does it have the layers 80 to 83 and the quantity in right and left?
    #[must_use]
    pub fn is_astm(self) -> bool {
        !matches!(self, Self::Aama | Self::Optitex)
    }

    /// Does it have dense copies on 84 and 87?
    #[must_use]
    pub fn has_dense(self) -> bool {
        matches!(self, Self::Astm | Self::Clo | Self::Gerber)
    }

    /// Are names and texts cut to what the narrowest reader keeps?
    #[must_use]
    pub fn is_narrow(self) -> bool {
        self == Self::Gerber
    }
}

/// A style: all its pieces in all its sizes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// Texts of the style.
    pub style: StyleText,
    /// One entry per piece and size.
    pub pieces: Vec<PieceDrawing>,
}

/// Texts of the style.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct StyleText {
    /// Style name.
    pub name: String,
    /// Base size of a nest.
    pub sample_size: Option<String>,
    /// Who made the pattern.
    pub author: String,
    /// When it was made, as the file is to say it.
    pub date: Option<String>,
    /// Name of the grade rule table.
    pub rule_table: Option<String>,
}

/// A point of a line, millimetres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawPoint {
    /// Where.
    pub at: Vec2,
    /// Turn points stand again on layer 2, curve points on layer 3.
    pub kind: PointKind,
}

/// An open or closed line.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DrawLine {
    /// Vertices; a closed line does not repeat its first.
    pub points: Vec<DrawPoint>,
    /// Joined at the ends?
    pub closed: bool,
    /// A denser copy for layers 84 and 87, holding every corner of `points`. Without one, `points` may hold the points
    /// of smooth curves: they are sorted out when the line is written.
    pub dense: Option<Vec<Vec2>>,
}

/// The line that a notch sits on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NotchLine {
    /// The cut line (layer 1).
    #[default]
    Cut,
    /// The sew line (layer 14).
    Sew,
    /// The fold of a half piece.
    Fold,
    /// None of these.
    None,
}

/// A notch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawNotch {
    /// Shape.
    pub kind: NotchKind,
    /// Base point, mm.
    pub at: Vec2,
    /// Depth along the angle, mm.
    pub depth: f64,
    /// Width at the edge, mm.
    pub width: f64,
    /// Direction into the piece, degrees from +x; square to the edge when there is none.
    pub angle: Option<f64>,
    /// The line it sits on: what is written lies on it.
    pub on: NotchLine,
}

/// A drill hole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawDrill {
    /// Where, mm.
    pub at: Vec2,
    /// Diameter, mm.
    pub diameter: Option<f64>,
}

/// A grade rule at a point of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawRule {
    /// Where, mm.
    pub at: Vec2,
    /// Number of the rule.
    pub rule: u32,
    /// Layer of the line.
    pub layer: &'static str,
    /// Kind of the point.
    pub kind: PointKind,
}

/// A text kept on its layer.
#[derive(Clone, Debug, PartialEq)]
pub struct LayerText {
    /// Where, mm.
    pub at: Vec2,
    /// Layer.
    pub layer: String,
    /// Text.
    pub text: String,
}

/// Texts of a piece about its cutting.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CutNotes {
    /// How often it is cut.
    pub quantity: Quantity,
    /// Material.
    pub material: Option<String>,
    /// Category.
    pub category: Option<String>,
    /// Annotation.
    pub annotation: Option<String>,
}

/// One piece in one size, millimetres.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PieceDrawing {
    /// Piece name, the same in all sizes.
    pub name: String,
    /// Size label.
    pub size: Option<String>,
    /// Notes for the cutter.
    pub cut: CutNotes,
    /// The line that is cut (layer 1).
    pub boundary: DrawLine,
    /// The line that is sewn (layer 14), where it differs; open on a half piece.
    pub sew_line: Option<DrawLine>,
    /// Internal lines (8), marked darts among them.
    pub internal: Vec<DrawLine>,
    /// Cutouts (11).
    pub cutouts: Vec<DrawLine>,
    /// Cutouts that are drawn on the layer of the outline (1).
    pub boundary_cutouts: Vec<DrawLine>,
    /// Notches (4, 80 to 83).
    pub notches: Vec<DrawNotch>,
    /// Drill holes (13).
    pub drill_holes: Vec<DrawDrill>,
    /// Stripe and plaid lines with their layer (9 or 10); a line of one point is a mark.
    pub stripes: Vec<(&'static str, DrawLine)>,
    /// Points with their grade rules.
    pub rules: Vec<DrawRule>,
    /// Grain line (7, and again on 5).
    pub grain: Option<[Vec2; 2]>,
    /// Fold of a half piece (6).
    pub fold: Option<[Vec2; 2]>,
    /// Other texts.
    pub texts: Vec<LayerText>,
}

impl DrawLine {
    /// Positions for layers 84 and 87.
    #[must_use]
    pub fn dense_points(&self) -> Vec<Vec2> {
        self.dense.clone().unwrap_or_else(|| self.points.iter().map(|p| p.at).collect())
    }
}

impl PieceDrawing {
    /// All lines with their layers.
    pub fn lines(&self) -> impl Iterator<Item = (&'static str, &DrawLine)> {
        let boundary = std::iter::once(("1", &self.boundary));
        let sew = self.sew_line.iter().map(|l| ("14", l));
        let internal = self.internal.iter().map(|l| ("8", l));
        let cutouts = self.cutouts.iter().map(|l| ("11", l)).chain(self.boundary_cutouts.iter().map(|l| ("1", l)));
        boundary.chain(sew).chain(internal).chain(cutouts)
    }

    /// Lower left and upper right corner of the boundary, mm.
    #[must_use]
    pub fn bounds(&self) -> [Vec2; 2] {
        let mut points = self.boundary.points.iter().map(|p| p.at);
        let first = points.next().unwrap_or_else(Vec2::zeros);
        points.fold([first, first], |[lo, hi], p| [lo.inf(&p), hi.sup(&p)])
    }
}

/// Why a piece cannot be written.
pub fn fault(piece: &PieceDrawing) -> Option<Diagnostic> {
    if piece.boundary.points.len() < 3 {
        let n = piece.boundary.points.len();
        return Some(Diagnostic::error(
            codes::BOUNDARY_TOO_SHORT,
            format!("the boundary of piece `{}` has {n} points, a piece needs at least 3", piece.name),
        ));
    }
    let bad = |p: &Vec2| !(p.x.abs() < 1e7 && p.y.abs() < 1e7);
    let lines = piece.lines().flat_map(|(_, l)| l.points.iter().map(|p| p.at).chain(l.dense.iter().flatten().copied()));
    let marks = piece.notches.iter().map(|n| n.at).chain(piece.drill_holes.iter().map(|d| d.at));
    let sizes =
        piece.notches.iter().flat_map(|n| [Vec2::new(n.depth, n.width), Vec2::new(n.angle.unwrap_or(0.0), 0.0)]);
    let rest = piece.grain.iter().chain(&piece.fold).flatten().copied().chain(piece.texts.iter().map(|t| t.at));
    let rest = rest.chain(piece.stripes.iter().flat_map(|(_, l)| l.points.iter().map(|p| p.at)));
    let rest = rest.chain(piece.drill_holes.iter().map(|d| Vec2::new(d.diameter.unwrap_or(0.0), 0.0)));
    let wrong = lines.chain(marks).chain(sizes).chain(rest).find(bad)?;
    Some(Diagnostic::error(
        COORDINATE_OUT_OF_RANGE,
        format!(
            "piece `{}` holds ({}, {}) mm, which is not a place on a pattern",
            piece.name,
            decimal(wrong.x),
            decimal(wrong.y)
        ),
    ))
}
