//! From a piece of the garment document (metres) to the writer's drawing (millimetres).

use super::codes;
use super::fold::half;
use super::model::{CutNotes, DrawDrill, DrawLine, DrawNotch, DrawPoint, LayerText, NotchLine, PieceDrawing};
use super::sparse;
use crate::dxf::outline::SPARSE;
use toile_garment::dart::{Dart, DartKind};
use toile_garment::notch::{Notch, NotchKind};
use toile_garment::outline::{LinePoint, PieceLine, PointKind};
use toile_garment::{Diagnostic, Piece, SourceRef, Vec2};

/// Millimetres in a metre.
const MM: f64 = 1e3;
/// A line that was not changed has its corners where they were drawn, metres.
const SAME_CORNER: f64 = 1e-9;

/// How a piece is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PieceOptions {
    /// Draw a piece that was unfolded as its half with a fold line again. Whole pieces are read by more systems.
    pub half_on_fold: bool,
    /// Add what the cutting room wants of a dart: a drill hole 10 mm from its apex and notches at its mouth.
    pub mark_darts: bool,
}

/// The drawing of a piece. Marked and fish-eye darts become lines on layer 8, as they were.
pub fn piece_drawing(piece: &Piece, options: PieceOptions, findings: &mut Vec<Diagnostic>) -> PieceDrawing {
    let boundary = piece.cut_line.as_ref().unwrap_or(&piece.outline);
    let (eyes, darts): (Vec<&Dart>, Vec<&Dart>) = piece.darts.iter().partition(|d| layer(&d.source) == "11");
    let mut internal: Vec<_> = piece.internal_lines.iter().map(line).collect();
    internal.extend(darts.into_iter().flat_map(dart_lines));
    let (on_boundary, on_eleven): (Vec<&PieceLine>, Vec<&PieceLine>) =
        piece.cutouts.iter().partition(|l| layer(&l.source) == "1");
    let drawn = piece.drawn.clone().unwrap_or_default();
    let drawing = PieceDrawing {
        name: piece.base_name().to_owned(),
        size: piece.size.clone(),
        cut: CutNotes {
            quantity: piece.quantity,
            material: piece.material.clone(),
            category: piece.category.clone(),
            annotation: piece.annotation.clone(),
        },
        boundary: closed_line(boundary, if piece.cut_line.is_some() { &drawn.cut_line } else { &drawn.outline }),
        sew_line: piece.cut_line.is_some().then(|| closed_line(&piece.outline, &drawn.outline)),
        internal,
        cutouts: on_eleven.into_iter().map(line).chain(eyes.into_iter().flat_map(dart_lines)).collect(),
        boundary_cutouts: on_boundary.into_iter().map(line).collect(),
        notches: piece.notches.iter().map(|n| notch(n, piece)).collect(),
        drill_holes: piece
            .drill_holes
            .iter()
            .map(|d| DrawDrill { at: d.at * MM, diameter: d.diameter.map(|d| d * MM) })
            .collect(),
        stripes: piece.match_lines.iter().map(|l| (stripe_layer(l), line(l))).collect(),
        rules: Vec::new(),
        grain: piece.grain.map(|g| g.map(|p| p * MM)),
        fold: None,
        texts: piece
            .texts
            .iter()
            .map(|t| LayerText { at: t.at * MM, layer: t.layer.clone(), text: t.text.clone() })
            .collect(),
    };
    let drawing = if options.mark_darts { with_dart_marks(drawing, piece) } else { drawing };
    let drawing = match piece.fold.filter(|_| options.half_on_fold) {
        Some(fold) => half(drawing, fold.map(|p| p * MM), findings),
        None => drawing,
    };
    if drawing.fold.is_some() { drawing } else { with_marks_on_fold(drawing, findings) }
}

/// The layer something came from.
fn layer(source: &Option<SourceRef>) -> &str {
    source.as_ref().and_then(|s| s.layer.as_deref()).unwrap_or_default()
}

/// Half the length of the line for a mark on the fold, at least, mm.
const MARK_ON_FOLD: f64 = 2.5;

/// A mark on the fold of a piece that is written whole lies inside it, where no notch can be: it is a short internal
/// line across the fold.
fn with_marks_on_fold(mut drawing: PieceDrawing, findings: &mut Vec<Diagnostic>) -> PieceDrawing {
    let (marks, notches): (Vec<DrawNotch>, _) = drawing.notches.into_iter().partition(|n| n.on == NotchLine::Fold);
    drawing.notches = notches;
    if !marks.is_empty() {
        let text = format!(
            "{} mark(s) on the fold of `{}` are written as short internal lines (layer 8): the piece is written whole",
            marks.len(),
            drawing.name
        );
        findings.push(
            Diagnostic::info(codes::MARK_ON_FOLD_AS_LINE, text).hint("half_on_fold = true keeps them as they were"),
        );
    }
    for mark in marks {
        let (sin, cos) = libm::sincos(mark.angle.unwrap_or(0.0).to_radians());
        let half = Vec2::new(cos, sin) * mark.depth.max(MARK_ON_FOLD);
        let end = |at: Vec2| DrawPoint { at, kind: PointKind::Turn };
        let points = vec![end(mark.at - half), end(mark.at + half)];
        drawing.internal.push(DrawLine { points, closed: false, dense: None });
    }
    drawing
}

/// The vertices of a closed line of a piece as they are drawn: those of `Piece::drawn`, or as the line tells them.
#[must_use]
pub fn drawn_vertices(line: &PieceLine, drawn: &[LinePoint]) -> Vec<LinePoint> {
    if !drawn.is_empty() {
        return drawn.to_vec();
    }
    let points: Vec<DrawPoint> = line.points.iter().map(|p| DrawPoint { at: p.at * MM, kind: p.kind }).collect();
    let told = sparse::sparse(&points, line.closed, sparse::CLOSE).points;
    told.into_iter().map(|p| LinePoint { at: p.at / MM, kind: p.kind }).collect()
}

/// A closed line with its vertices as drawn, where they are known and still those of the line: its corners are theirs.
fn closed_line(line: &PieceLine, drawn: &[LinePoint]) -> DrawLine {
    let corners =
        |list: &[LinePoint]| list.iter().filter(|p| p.kind == PointKind::Turn).map(|p| p.at).collect::<Vec<_>>();
    let (own, theirs) = (corners(&line.points), corners(drawn));
    let n = own.len();
    let same = |turn: usize| (0..n).all(|i| (own[(i + turn) % n] - theirs[i]).norm() <= SAME_CORNER);
    let known = !drawn.is_empty() && n == theirs.len() && (n == 0 || (0..n).any(same));
    if !known {
        return self::line(line);
    }
    let fine = line.points.iter().map(|p| p.at * MM).collect();
    let points = drawn.iter().map(|p| DrawPoint { at: p.at * MM, kind: p.kind }).collect();
    DrawLine { points, closed: line.closed, dense: Some(fine) }
}

fn stripe_layer(line: &PieceLine) -> &'static str {
    if line.name.as_deref() == Some("plaid") { "10" } else { "9" }
}

/// Drill holes stand this far from the apex, mm.
const SHORT_OF_APEX: f64 = 10.0;
/// Depth of the notches, mm.
const DEPTH: f64 = 4.0;

/// Drill holes and notches of the darts, where there are none yet.
fn with_dart_marks(mut drawing: PieceDrawing, piece: &Piece) -> PieceDrawing {
    for dart in piece.darts.iter().filter(|d| d.kind != DartKind::Pleat) {
        let middle = (dart.mouth[0] + dart.mouth[1]) * (0.5 * MM);
        for apex in &dart.apexes {
            let (apex, back) = (apex * MM, middle - apex * MM);
            let at = apex + back * (SHORT_OF_APEX / back.norm().max(SHORT_OF_APEX));
            if back.norm() > SHORT_OF_APEX && !drawing.drill_holes.iter().any(|d| (d.at - apex).norm() <= 20.0) {
                drawing.drill_holes.push(DrawDrill { at, diameter: None });
            }
        }
        if dart.kind == DartKind::FishEye {
            continue;
        }
        for mouth in dart.mouth.map(|m| m * MM) {
            let inwards = dart.apexes.first().map_or(Vec2::zeros(), |a| a * MM - middle);
            let angle = (inwards.norm() > 0.0).then(|| libm::atan2(inwards.y, inwards.x).to_degrees());
            if !drawing.notches.iter().any(|n| (n.at - mouth).norm() <= 14.0) {
                let on = if drawing.sew_line.is_some() { NotchLine::Sew } else { NotchLine::Cut };
                let slit = DrawNotch { kind: NotchKind::Slit, at: mouth, depth: DEPTH, width: 0.0, angle, on };
                drawing.notches.push(slit);
            }
        }
    }
    drawing
}

fn line(line: &PieceLine) -> DrawLine {
    let points = line.points.iter().map(|p| DrawPoint { at: p.at * MM, kind: p.kind }).collect();
    DrawLine { points, closed: line.closed, dense: None }
}

fn notch(notch: &Notch, piece: &Piece) -> DrawNotch {
    let on = match notch.on.as_str() {
        "sew" if piece.cut_line.is_some() => NotchLine::Sew,
        "boundary" | "cut" | "sew" => NotchLine::Cut,
        "fold" => NotchLine::Fold,
        _ => NotchLine::None,
    };
    DrawNotch {
        on,
        kind: notch.kind,
        at: notch.at * MM,
        depth: notch.depth * MM,
        width: notch.width * MM,
        angle: notch.angle.map(f64::to_degrees),
    }
}

/// The lines of a dart that the outline does not follow.
fn dart_lines(dart: &Dart) -> Vec<DrawLine> {
    let [a, b] = &dart.legs;
    let there = a.iter().copied();
    match dart.kind {
        DartKind::Wedge => Vec::new(),
        DartKind::MarkedWedge => vec![marked(there.chain(b.iter().rev().skip(1).copied()), dart, false)],
        DartKind::FishEye => {
            let back = b.iter().rev().skip(1).take(b.len().saturating_sub(2)).copied();
            vec![marked(there.chain(back), dart, true)]
        }
        DartKind::Pleat => [a, b].map(|leg| marked(leg.iter().copied(), dart, false)).into(),
    }
}

/// A dart line: apexes and mouth are turn points, the rest of the legs are curve points. The mouth of a marked dart is
/// left to the outline, which may run straight over it.
fn marked(points: impl Iterator<Item = Vec2>, dart: &Dart, closed: bool) -> DrawLine {
    let corner = |p: &Vec2| dart.apexes.iter().chain(&dart.mouth).any(|c| (c - p).norm() < 1e-6);
    let points: Vec<DrawPoint> = points
        .map(|p| {
            let on_outline = dart.kind == DartKind::MarkedWedge && dart.mouth.iter().any(|m| (m - p).norm() < 1e-6);
            let kind = match corner(&p) {
                true if on_outline => PointKind::Plain,
                true => PointKind::Turn,
                false => PointKind::Curve,
            };
            DrawPoint { at: p * MM, kind }
        })
        .collect();
    let far = points.windows(2).any(|w| (w[1].at - w[0].at).norm() > SPARSE);
    // A leg of few points is drawn straight from point to point: a reader must not bend it.
    let kind = |p: &DrawPoint| if far && p.kind == PointKind::Curve { PointKind::Plain } else { p.kind };
    let points = points.iter().map(|p| DrawPoint { kind: kind(p), ..*p }).collect();
    DrawLine { points, closed, dense: None }
}
