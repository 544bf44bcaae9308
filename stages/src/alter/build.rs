//! Pieces from changed outlines.

use super::contour::{self, Contour, Vertex};
use super::marks::Region;
use crate::sewing::ring::Ring;
use toile_formats::allowance::{Allowance, cut_line};
use toile_garment::dart::{Dart, DartKind};
use toile_garment::notch::Notch;
use toile_garment::outline::{OutlineEdge, PieceLine};
use toile_garment::piece::DrillHole;
use toile_garment::sewing::SeamSpec;
use toile_garment::{Diagnostic, Piece, Vec2};

/// Seam allowance of new edges where nothing is said, metres.
pub const ALLOWANCE: f64 = 10e-3;

/// Places nearer to each other are one, metres.
pub const SAME_PLACE: f64 = 1e-6;

/// One piece of what an old piece became.
#[derive(Clone, Debug)]
pub struct Part {
    /// Name.
    pub name: String,
    /// Outline.
    pub contour: Contour,
    /// Its darts that are new or changed.
    pub darts: Vec<Dart>,
    /// Its new notches.
    pub notches: Vec<Notch>,
    /// Its new drill holes.
    pub holes: Vec<DrillHole>,
}

/// An old dart that is gone, or made anew in another form.
#[derive(Clone, Copy, Debug)]
pub struct Gone {
    /// Its number.
    pub dart: usize,
    /// Are the marks of its mouth gone, too?
    pub has_no_mouth: bool,
    /// Are the marks of its point gone, too?
    pub has_no_point: bool,
}

impl Gone {
    /// A dart with its marks, or without them.
    pub fn new(dart: usize, is_unmarked: bool) -> Self {
        Self { dart, has_no_mouth: is_unmarked, has_no_point: is_unmarked }
    }
}

/// A changed piece: its parts, and how the cloth moved.
#[derive(Clone, Debug)]
pub struct Altered {
    /// The parts.
    pub parts: Vec<Part>,
    /// How the cloth moved.
    pub regions: Vec<Region>,
    /// The old darts that are gone or made anew.
    pub gone: Vec<Gone>,
    /// The old outline.
    pub ring: Ring,
    /// The seams between the parts.
    pub seams: Vec<SeamSpec>,
    /// Seam allowance of new edges, metres.
    pub allowance: f64,
    /// The change in words.
    pub told: String,
    /// Findings of the change.
    pub findings: Vec<Diagnostic>,
}

impl Altered {
    /// The parts as pieces.
    pub fn pieces(&self, old: &Piece) -> Vec<Piece> {
        (0..self.parts.len()).map(|k| self.piece(old, k)).collect()
    }

    fn piece(&self, old: &Piece, k: usize) -> Piece {
        let part = &self.parts[k];
        let outline = PieceLine { points: contour::points(&part.contour.vertices), ..old.outline.clone() };
        let edges = outline.edges();
        let name = part.name.clone();
        let mut piece = Piece { name, outline, edges, cut_line: None, drawn: None, mesh: None, ..old.clone() };
        self.carry_marks(old, k, &mut piece);
        piece.darts.extend(part.darts.iter().cloned());
        piece.drill_holes.extend(part.holes.iter().cloned());
        if let Some(cut) = &old.cut_line {
            piece.cut_line = self.cut_line(cut, k, &piece);
        }
        let cut = piece.cut_line.as_ref().map(|c| Ring::new(c.positions(), Vec::new()));
        piece.notches.extend(part.notches.iter().map(|n| on_cut_line(n, cut.as_ref())));
        piece
    }

    /// The cut line: along every edge the allowance of the old one, along new edges what is asked for. It runs over the
    /// mouths of darts.
    fn cut_line(&self, cut: &PieceLine, k: usize, piece: &Piece) -> Option<PieceLine> {
        let vertices = filled(&self.parts[k].contour.vertices, &piece.darts);
        let outline = PieceLine { points: contour::points(&vertices), ..piece.outline.clone() };
        let edges = outline.edges();
        let cut = Ring::new(cut.positions(), Vec::new());
        let width = |v: usize| {
            let [a, b] = vertices[v].stretch?;
            let middle = Some((a + b) / 2.0).filter(|s| self.ring.gap_around(*s).is_none())?;
            Some((cut.project(self.ring.at(middle)).1, b - a))
        };
        let n = vertices.len();
        let of_edge = |e: &OutlineEdge| {
            let count = (e.to as usize + n - e.from as usize - 1) % n + 1;
            let mut widths: Vec<(f64, f64)> = (0..count).filter_map(|i| width((e.from as usize + i) % n)).collect();
            widths.sort_by(|a, b| a.0.total_cmp(&b.0));
            (e.index, median(&widths).unwrap_or(self.allowance))
        };
        let widths = edges.iter().map(of_edge).collect();
        let allowance = Allowance { width: self.allowance, edges: widths, ..Allowance::default() };
        let around = Piece { outline, edges, name: piece.name.clone(), ..Piece::default() };
        cut_line(&around, &allowance).ok().map(|(line, _)| line)
    }
}

/// A new notch where scissors clip it: on the cut line, square to it.
fn on_cut_line(notch: &Notch, cut: Option<&Ring>) -> Notch {
    let Some(cut) = cut else { return notch.clone() };
    let at = cut.at(cut.project(notch.at).0);
    let inward = notch.at - at;
    let angle = (inward.norm() > SAME_PLACE).then(|| libm::atan2(inward.y, inward.x));
    Notch { at, angle: angle.or(notch.angle), ..notch.clone() }
}

/// An outline without the wedges of its darts.
fn filled(vertices: &[Vertex], darts: &[Dart]) -> Vec<Vertex> {
    let n = vertices.len();
    let at = |p: Vec2| vertices.iter().position(|v| (v.at - p).norm() < SAME_PLACE);
    let mut is_in_dart = vec![false; n];
    for dart in darts.iter().filter(|d| d.kind == DartKind::Wedge) {
        let (Some(first), Some(second)) = (at(dart.mouth[0]), at(dart.mouth[1])) else { continue };
        (1..(second + n - first) % n).for_each(|k| is_in_dart[(first + k) % n] = true);
    }
    let kept = vertices.iter().zip(&is_in_dart).filter(|(_, is_in)| !**is_in);
    kept.map(|(v, _)| *v).collect()
}

/// The value in the middle of sorted values with weights.
fn median(values: &[(f64, f64)]) -> Option<f64> {
    let half = values.iter().map(|v| v.1).sum::<f64>() / 2.0;
    let mut sum = 0.0;
    values
        .iter()
        .find(|v| {
            sum += v.1;
            sum >= half
        })
        .map(|v| v.0)
}

/// The middle of two points.
pub fn middle(a: Vec2, b: Vec2) -> Vec2 {
    (a + b) / 2.0
}
