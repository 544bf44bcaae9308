//! From a piece of the garment document (metres) to the writer's drawing (millimetres).

use super::fold::half;
use super::model::{DrawDrill, DrawLine, DrawNotch, DrawPoint, LayerText, PieceDrawing};
use toile_garment::dart::{Dart, DartKind};
use toile_garment::notch::{Notch, NotchKind};
use toile_garment::outline::{PieceLine, PointKind};
use toile_garment::{Diagnostic, Piece, Vec2};

/// Millimetres in a metre.
const MM: f64 = 1e3;

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
    let mut internal: Vec<_> = piece.internal_lines.iter().map(line).collect();
    internal.extend(piece.darts.iter().flat_map(dart_lines));
    let drawing = PieceDrawing {
        name: base_name(piece),
        size: piece.size.clone(),
        quantity: piece.quantity,
        material: piece.material.clone(),
        category: piece.category.clone(),
        annotation: piece.annotation.clone(),
        boundary: line(boundary),
        sew_line: piece.cut_line.is_some().then(|| line(&piece.outline)),
        internal,
        cutouts: piece.cutouts.iter().map(line).collect(),
        notches: piece.notches.iter().map(notch).collect(),
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
    match piece.fold.filter(|_| options.half_on_fold) {
        Some(fold) => half(drawing, fold.map(|p| p * MM), findings),
        None => drawing,
    }
}

/// The name without its size: pieces read in several sizes are called `piece@size`.
fn base_name(piece: &Piece) -> String {
    let tail = piece.size.as_deref().map(|s| format!("@{s}"));
    let base = tail.and_then(|t| piece.name.strip_suffix(t.as_str()));
    base.filter(|b| !b.is_empty()).unwrap_or(&piece.name).to_owned()
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
                drawing.notches.push(DrawNotch { kind: NotchKind::Slit, at: mouth, depth: DEPTH, width: 0.0, angle });
            }
        }
    }
    drawing
}

fn line(line: &PieceLine) -> DrawLine {
    let points = line.points.iter().map(|p| DrawPoint { at: p.at * MM, kind: p.kind }).collect();
    DrawLine { points, closed: line.closed, dense: None }
}

fn notch(notch: &Notch) -> DrawNotch {
    DrawNotch {
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
    let points = points
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
    DrawLine { points, closed, dense: None }
}
