//! Pressed folds: those of `[[fold]]`, and those of pleats.

use crate::sewing::lookup;
use crate::sewing::ring::Ring;
use std::f64::consts::PI;
use toile_garment::outline::{LinePoint, PieceLine, PointKind};
use toile_garment::piece::PressedFold;
use toile_garment::sewing::{DartSpec, FoldSpec, PleatPress};
use toile_garment::{Diagnostic, Garment, Piece, SourceRef, Vec2};

/// A line that ends this near to a fold's points is its line already, m.
const ON_LINE: f64 = 1e-3;
/// Two places nearer than this are one, m.
const SAME_PLACE: f64 = 1e-9;

/// Presses the folds of the `[[fold]]` tables into their pieces.
pub fn declare(garment: &mut Garment, wanted: impl Fn(&str) -> bool, errors: &mut Vec<Diagnostic>) {
    let specs: Vec<FoldSpec> = garment.plan.folds.iter().filter(|f| wanted(&f.piece)).cloned().collect();
    for spec in &specs {
        match lookup::piece(garment, &spec.piece, spec.source.as_ref()) {
            Ok(id) => {
                let piece = &mut garment.pieces[id.index()];
                draw(piece, &spec.line, spec.source.as_ref());
                piece.folds.push(PressedFold { name: spec.name.clone(), line: spec.line.clone(), angle: spec.angle });
            }
            Err(e) => errors.push(e),
        }
    }
}

/// A fold line of a pleat: the share of the way from its first line to its second, and the angle over 180°.
type Fold = (f64, f64);

/// The folds of a pleat. Where the right side is outside, the angle is over 0.
fn folds(press: PleatPress) -> Vec<Fold> {
    match press {
        PleatPress::Knife => vec![(0.0, 1.0), (0.5, -1.0)],
        PleatPress::Inverted => vec![(0.0, 1.0), (0.25, -1.0), (0.75, -1.0), (1.0, 1.0)],
        PleatPress::Box => vec![(0.0, -1.0), (0.25, 1.0), (0.75, 1.0), (1.0, -1.0)],
    }
}

/// Presses a pleat of this name, whose lines run from its mouth to these ends. Its legs are sewn and drawn already.
pub fn press(piece: &mut Piece, spec: &DartSpec, name: &str, ends: [Vec2; 2]) {
    let Some(press) = spec.press else { return };
    let outline = Ring::from_line(&piece.outline.positions());
    for (n, (share, turn)) in (1..).zip(folds(press)) {
        let line = vec![between(&outline, spec.mouth, share), between(&outline, ends, share)];
        let on_leg = share == 0.0 || share == 1.0;
        let from = match spec.sewn {
            Some(sewn) if on_leg => line[0] + (line[1] - line[0]) * (sewn / (line[1] - line[0]).norm()).min(1.0),
            None if on_leg => line[1],
            _ => line[0],
        };
        if (line[1] - from).norm() > ON_LINE {
            draw(piece, &[from, line[1]], spec.source.as_ref());
        }
        piece.folds.push(PressedFold { name: format!("{name}-{n}"), line, angle: turn * PI });
    }
}

/// The point at this share of the way between two points; where both lie on the outline, so does it.
fn between(outline: &Ring, ends: [Vec2; 2], share: f64) -> Vec2 {
    let straight = ends[0] + (ends[1] - ends[0]) * share;
    let off = |p: Vec2| outline.project(p).1;
    if outline.points.len() < 3 || off(straight) < SAME_PLACE || ends.iter().any(|p| off(*p) > ON_LINE) {
        return straight;
    }
    outline.at(outline.project(straight).0)
}

/// Draws a line on a piece. One that is drawn there already is moved onto it.
fn draw(piece: &mut Piece, points: &[Vec2], source: Option<&SourceRef>) {
    let near = |a: Option<&Vec2>, b: Option<&Vec2>| a.zip(b).is_some_and(|(a, b)| (a - b).norm() < ON_LINE);
    for line in piece.internal_lines.iter_mut().filter(|l| l.points.len() == points.len()) {
        let drawn = line.positions();
        let ends = [drawn.first(), drawn.last()];
        let same = near(ends[0], points.first()) && near(ends[1], points.last());
        let turned = near(ends[0], points.last()) && near(ends[1], points.first());
        if same || turned {
            let last = points.len() - 1;
            (0..=last).for_each(|i| line.points[i].at = points[if same { i } else { last - i }]);
            return;
        }
    }
    let points = points.iter().map(|p| LinePoint { at: *p, kind: PointKind::Plain }).collect();
    piece.internal_lines.push(PieceLine { points, closed: false, name: None, source: source.cloned() });
}
