//! One drawn piece in one size: what the layers of a block mean together.

mod border;
pub(crate) mod codes;
mod copies;
mod folded;
mod loops;
mod marks;
mod notes;
mod offset;
mod points;
mod refused;
mod run_on;
mod sew;

pub(super) use offset::is_moved_inwards;
pub use refused::RefusedPiece;
pub(crate) use refused::in_file_order;
pub(crate) use sew::SEW_LINE_ON_8;

use super::chain::Path;
use super::darts::{Denied, DrawnDart, Pleat};
use super::desk::Desk;
use super::geom::PointIndex;
use super::notches::DrawnNotch;
use super::outline::{Marks, Outline};
use super::sheet::{Drill, Mark, Sheet, Stroke};
use std::collections::{BTreeMap, BTreeSet};
use toile_garment::outline::PointKind;
use toile_garment::piece::Quantity;
use toile_garment::{Diagnostic, Vec2};

/// Points nearer to each other than this are one, mm.
const SAME_POINT: f64 = 0.01;

/// A piece as drawn, millimetres in block coordinates.
///
/// It is built in steps: `outline` reads lines and texts, `prepare` and `finish` find notches and darts once the kinds
/// of vertices are known in every size. Until then `notches`, `darts` and `doubts` are empty.
#[derive(Clone, Debug)]
pub struct DrawnPiece {
    /// Block name.
    pub block: String,
    /// Line of the block.
    pub line: u64,
    /// Text `Piece Name`, if any.
    pub name: Option<String>,
    /// Text `Size`, if any.
    pub size: Option<String>,
    /// All other texts.
    pub texts: PieceTexts,
    /// Cut line.
    pub boundary: Outline,
    /// Sew line, where it differs.
    pub sew: Option<Outline>,
    /// Number of sew lines drawn.
    pub sew_lines: usize,
    /// Fold, grain and lines of reference.
    pub axes: Axes,
    /// Lines and marks inside the outline.
    pub inside: Inside,
    /// Points of layers 2 and 3.
    pub points: VertexPoints,
    /// Notches.
    pub notches: Vec<DrawnNotch>,
    /// Darts.
    pub darts: Vec<DrawnDart>,
    /// Candidates for darts and pleats, and look-alikes that are none.
    pub doubts: DartDoubts,
    /// Lines and marks of which `finish` makes working lines and notches.
    pub(super) unfinished: Unfinished,
}

/// The texts of a block, but for its name and size.
#[derive(Clone, Debug, Default)]
pub struct PieceTexts {
    /// Text `Quantity`, else the number of INSERTs.
    pub quantity: Quantity,
    /// Does a text or an INSERT say the quantity?
    pub quantity_told: bool,
    /// Keys of other programs that were read as those of the standard.
    pub foreign: BTreeSet<String>,
    /// Texts that have no colon behind their key, and were read as if they had.
    pub without_colon: BTreeSet<String>,
    /// Other piece texts by key, in lower case.
    pub keys: BTreeMap<String, String>,
    /// Texts without meaning: place, layer, text.
    pub others: Vec<(Vec2, String, String)>,
    /// Grade rule texts: place and rule.
    pub rules: Vec<RuleMark>,
}

/// Straight lines that say how a piece lies, each with its two ends.
#[derive(Clone, Debug, Default)]
pub struct Axes {
    /// Fold of a half piece.
    pub fold: Option<[Vec2; 2]>,
    /// Grain line.
    pub grain: Option<[Vec2; 2]>,
    /// Reference line of the grading.
    pub reference: Option<[Vec2; 2]>,
    /// Alternate reference lines, with their number where a text says it.
    pub alternates: Vec<(Option<u32>, [Vec2; 2])>,
}

/// Lines and marks inside an outline.
#[derive(Clone, Debug, Default)]
pub struct Inside {
    /// Internal lines (legs of marked darts among them).
    pub internal: Vec<Path>,
    /// Internal lines that say `NM`: not mirrored.
    pub not_mirrored: Vec<bool>,
    /// Cutouts.
    pub cutouts: Vec<Path>,
    /// Entities of cutouts that are drawn on layer 1.
    pub on_boundary_layer: Vec<u32>,
    /// Drill holes.
    pub drills: Vec<Drill>,
    /// Stripe and plaid lines (layers 9 and 10): layer and line.
    pub stripes: Vec<(String, Path)>,
}

/// The points of layers 2 and 3, which say what kinds the vertices are.
#[derive(Clone, Debug, Default)]
pub struct VertexPoints {
    /// Points of layer 2 in file order, doubled ones merged.
    pub turn_list: Vec<Vec2>,
    /// Number of corners: points of layer 2, or corners of the outline where there are none.
    pub turn_points: usize,
    /// Points of layer 3, doubled ones merged.
    pub curve_list: Vec<Vec2>,
    /// Are there points of layers 2 or 3 in the block?
    pub marked: bool,
}

/// Candidates and look-alikes: they were not made darts.
#[derive(Clone, Debug, Default)]
pub struct DartDoubts {
    /// Wedges and lenses that were not taken as darts, with the reason.
    pub denied: Vec<Denied>,
    /// Wedges and marked legs whose evidence does not decide whether they are darts.
    pub undecided: Vec<DrawnDart>,
    /// A drill hole and two notches that may be a dart.
    pub candidates: Vec<(Vec2, [Vec2; 2])>,
    /// Pairs of fold lines.
    pub pleats: Vec<Pleat>,
}

/// Lines and marks that the first step keeps for the second.
#[derive(Clone, Debug)]
pub(super) struct Unfinished {
    /// Dense copy of the cut line (layer 84).
    pub dense: Option<Outline>,
    /// Dense copy of the sew line (layer 87).
    pub dense_sew: Option<Outline>,
    /// Notches drawn as points.
    pub marks: Vec<Mark>,
    /// Notches drawn as strokes.
    pub strokes: Vec<Stroke>,
}

/// A grade rule text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RuleMark {
    /// Place, mm.
    pub at: Vec2,
    /// Number of the rule.
    pub rule: u32,
    /// Alternate reference line in whose frame the growth stands.
    pub line: Option<u32>,
}

pub(crate) fn mm(p: Vec2) -> String {
    format!("({:.1}, {:.1}) mm", p.x, p.y)
}

impl Axes {
    /// The lines of a sheet. The fold is found later, when the outline is known.
    fn new(sheet: &Sheet) -> Self {
        let length = |ends: &[Vec2; 2]| (ends[1] - ends[0]).norm();
        Self {
            fold: None,
            grain: sheet.axes.grain.iter().map(|s| s.ends).max_by(|a, b| length(a).total_cmp(&length(b))),
            reference: sheet.axes.reference.first().map(|s| s.ends),
            alternates: sheet.axes.reference.iter().skip(1).map(|s| (None, s.ends)).collect(),
        }
    }
}

impl VertexPoints {
    fn new(sheet: &Sheet, marked: bool) -> Self {
        let turn_list = distinct(&sheet.turn);
        Self { turn_points: turn_list.len(), turn_list, curve_list: distinct(&sheet.curve), marked }
    }
}

/// The points of a list without those that repeat another.
fn distinct(list: &[Vec2]) -> Vec<Vec2> {
    let mut index = PointIndex::new(SAME_POINT, []);
    let new = |(i, p): (usize, &Vec2)| index.insert_new(*p, i, SAME_POINT).then_some(*p);
    list.iter().enumerate().filter_map(new).collect()
}

/// How often a piece is cut, by its INSERTs if there are any.
fn quantity(inserted: Option<[u32; 2]>) -> Quantity {
    inserted.map_or_else(Quantity::default, |[plain, mirrored]| Quantity { plain, mirrored })
}

impl DrawnPiece {
    /// The outline that is sewn: the sew line where there is one.
    #[must_use]
    pub fn sewn(&self) -> &Outline {
        self.sew.as_ref().unwrap_or(&self.boundary)
    }

    /// Piece name, or the block's.
    #[must_use]
    pub fn label(&self) -> &str {
        self.name.as_deref().filter(|n| !n.is_empty()).unwrap_or(&self.block)
    }

    /// First step: lines chained and kinds set.
    ///
    /// # Errors
    /// The outline is wrong, which is then a finding.
    pub(crate) fn outline(block: &str, line: u64, mut sheet: Sheet, desk: &mut Desk<'_>) -> Result<Self, RefusedPiece> {
        let without_colon = notes::add_colons(&mut sheet.notes);
        let names = notes::names(&sheet.notes);
        let (outline, inner, marks) = match Self::line_of_sheet(block, line, &sheet, desk) {
            Some(found) => found,
            None => return Err(RefusedPiece::new(block, line, sheet, names)),
        };
        let [name, size] = names;
        let gap = desk.rules.tolerances.gap;
        let mut piece = Self {
            block: block.to_owned(),
            line,
            name,
            size,
            texts: PieceTexts {
                quantity: quantity(sheet.inserted),
                quantity_told: sheet.inserted.is_some(),
                without_colon,
                ..PieceTexts::default()
            },
            sew: None,
            sew_lines: 0,
            axes: Axes::new(&sheet),
            points: VertexPoints::new(&sheet, marks.any),
            inside: Inside {
                internal: sheet.internal.into_iter().map(Path::tidy).filter(|p| p.points.len() >= 2).collect(),
                not_mirrored: Vec::new(),
                on_boundary_layer: inner.iter().flat_map(|p| p.ids.iter().copied()).collect(),
                cutouts: inner.into_iter().chain(border::cutouts(sheet.cutouts, desk)).collect(),
                drills: sheet.drills,
                stripes: sheet.stripes,
            },
            notches: Vec::new(),
            darts: Vec::new(),
            doubts: DartDoubts::default(),
            unfinished: Unfinished {
                dense: border::closed_copy(sheet.dense, gap),
                dense_sew: border::closed_copy(sheet.dense_sew, gap),
                marks: sheet.marks,
                strokes: sheet.notch_strokes,
            },
            boundary: outline,
        };
        piece.read_notes(sheet.notes, desk);
        piece.check_rules(desk);
        piece.find_fold(&sheet.axes.mirror, desk);
        piece.find_sew_line(sheet.sew, desk);
        if let Some(sew) = &mut piece.sew {
            sew.classify(&marks);
        }
        piece.say_copies_of_nothing(&sheet.dense_other, desk);
        piece.settle_rules(desk);
        if !piece.points.marked {
            let corners = piece.boundary.drawn.iter().filter(|n| n.kind == PointKind::Turn);
            piece.points.turn_points = corners.count();
        }
        piece.check_grain(desk);
        Ok(piece)
    }

    /// The outline with its kinds, closed lines inside it, and the points that say the kinds.
    fn line_of_sheet(
        block: &str,
        line: u64,
        sheet: &Sheet,
        desk: &mut Desk<'_>,
    ) -> Option<(Outline, Vec<Path>, Marks)> {
        let (main, inner) = border::boundary(block, line, sheet, desk)?;
        let marks = Marks::new(&sheet.turn, &sheet.curve, &desk.rules.tolerances);
        let mut outline = Outline::new(main);
        outline.classify(&marks);
        border::check_shape(block, &mut outline, desk)?;
        points::check(block, line, sheet, desk);
        Some((outline, inner, marks))
    }

    /// The piece set aside, with its reasons.
    pub(crate) fn refuse(self, faults: Vec<Diagnostic>) -> RefusedPiece {
        let line = Path {
            ids: self.boundary.ids.clone(),
            line: self.boundary.line,
            points: self.boundary.drawn.iter().map(|n| (n.at, n.drawn)).collect(),
            closed: true,
        };
        let Self { block, line: at, name, size, points, .. } = self;
        RefusedPiece { block, line: at, name, size, marked: points.marked, lines: vec![line], faults }
    }

    fn check_grain(&mut self, desk: &mut Desk<'_>) {
        if self.axes.grain.is_some_and(|[a, b]| (b - a).norm() < 1.0) {
            self.axes.grain = None;
        }
        if self.axes.grain.is_none() {
            let text = format!("`{}` has no grain line (layer 7)", self.label());
            desk.say(
                Diagnostic::warning(codes::GRAIN_MISSING, text).hint("the warp is then taken along +y"),
                &self.block,
                "7",
                self.line,
            );
        }
    }

    /// Second step, once kinds are known in every size: apexes and notches of the outline.
    pub(crate) fn prepare(&mut self, desk: &mut Desk<'_>) {
        self.join_blunt_apexes(desk);
        self.find_cut_notches();
    }

    /// Third step, once notches cut into the outline are known in every size: working lines, notches, darts.
    pub(crate) fn finish(&mut self, desk: &mut Desk<'_>) {
        self.say_cut_notches(desk);
        self.say_unused_curve_points(desk);
        self.make_work(desk);
        self.find_notches(desk);
        self.find_darts(desk);
        self.deny_necklines(desk);
    }
}
