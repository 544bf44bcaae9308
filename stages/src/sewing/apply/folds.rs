//! Pressed folds: those of `[[fold]]`, and those of pleats.

use super::contradictions;
use crate::sewing::codes;
use crate::sewing::lookup;
use crate::sewing::ring::Ring;
use std::f64::consts::PI;
use toile_garment::dart::pleat_ends;
use toile_garment::outline::{LinePoint, PieceLine, PointKind};
use toile_garment::piece::PressedFold;
use toile_garment::sewing::{DartSpec, FoldSpec, PleatPress, SewingPlan};
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
                if let Some(other) = piece.folds.iter().find(|f| share_a_stretch(&f.line, &spec.line)) {
                    errors.push(on_one_line(&garment.plan, &piece.name, spec, other));
                    continue;
                }
                draw(piece, &spec.line, spec.source.as_ref());
                let (name, line) = (spec.name.clone(), spec.line.clone());
                piece.folds.push(PressedFold { name, line, angle: spec.angle, pleat: None });
            }
            Err(e) => errors.push(e),
        }
    }
}

/// Do two lines run along each other for more than their tolerance?
fn share_a_stretch(a: &[Vec2], b: &[Vec2]) -> bool {
    let along = |p: &[Vec2], q: &[Vec2]| {
        let way = (p[1] - p[0]).try_normalize(SAME_PLACE).unwrap_or_else(Vec2::zeros);
        let (on, length) = (|x: Vec2| (x - p[0]).dot(&way), (p[1] - p[0]).norm());
        let is_near = q.iter().all(|x| (x - p[0]).perp(&way).abs() < ON_LINE);
        let (low, high) = (on(q[0]).min(on(q[1])), on(q[0]).max(on(q[1])));
        is_near && high.min(length) - low.max(0.0) > ON_LINE
    };
    a.windows(2).any(|p| b.windows(2).any(|q| along(p, q) || along(q, p)))
}

/// The finding on a fold whose line is that of another fold, which alone would be pressed.
fn on_one_line(plan: &SewingPlan, piece: &str, spec: &FoldSpec, other: &PressedFold) -> Diagnostic {
    let of_fold = || plan.folds.iter().find(|f| f.name == other.name).and_then(|f| f.source.as_ref());
    let of_pleat = |name: &String| {
        let named = |d: &&DartSpec| d.piece.eq_ignore_ascii_case(piece) && d.name.as_ref() == Some(name);
        plan.darts.iter().find(named).and_then(|d| d.source.as_ref())
    };
    let at = other.pleat.as_ref().map_or_else(of_fold, of_pleat);
    let message = format!(
        "piece `{piece}`: fold `{}` lies on the line of fold `{}`{}, and a line has one angle",
        spec.name,
        other.name,
        contradictions::written(at)
    );
    let remedy = "remove one of them, or move its line; a pleat has the folds that `press` says";
    Diagnostic::error(codes::TABLES_CONTRADICT, message).at(spec.source.clone()).hint(remedy)
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

/// A pressed fold of a pleat.
struct Pressed {
    line: [Vec2; 2],
    angle: f64,
    /// The part of the line that is drawn for it. Legs are sewn, and drawn already.
    drawn: Option<[Vec2; 2]>,
}

/// Presses a pleat of this name, whose lines run from its mouth to these ends.
pub fn press(piece: &mut Piece, spec: &DartSpec, name: &str, ends: [Vec2; 2]) {
    for (n, fold) in (1..).zip(pressed(&piece.outline.positions(), spec, ends)) {
        if let Some(drawn) = fold.drawn {
            draw(piece, &drawn, spec.source.as_ref());
        }
        let (pleat, line) = (Some(name.to_owned()), fold.line.into());
        piece.folds.push(PressedFold { name: format!("{name}-{n}"), line, angle: fold.angle, pleat });
    }
}

/// The lines that are drawn for the folds of a pleat on a piece with this outline, in their order.
pub fn drawn_for(outline: &[Vec2], spec: &DartSpec) -> Vec<Option<[Vec2; 2]>> {
    let [Some(a), Some(b)] = pleat_ends(&spec.mouth, &spec.apexes) else { return Vec::new() };
    pressed(outline, spec, [a, b]).into_iter().map(|fold| fold.drawn).collect()
}

fn pressed(outline: &[Vec2], spec: &DartSpec, ends: [Vec2; 2]) -> Vec<Pressed> {
    let outline = Ring::from_line(outline);
    let fold = |(share, turn): Fold| {
        let line = [between(&outline, spec.mouth, share), between(&outline, ends, share)];
        let on_leg = share == 0.0 || share == 1.0;
        let from = match spec.sewn {
            Some(sewn) if on_leg => line[0] + (line[1] - line[0]) * (sewn / (line[1] - line[0]).norm()).min(1.0),
            None if on_leg => line[1],
            _ => line[0],
        };
        let drawn = ((line[1] - from).norm() > ON_LINE).then_some([from, line[1]]);
        Pressed { line, angle: turn * PI, drawn }
    };
    spec.press.into_iter().flat_map(folds).map(fold).collect()
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
    match find(piece, points) {
        Some((k, is_turned)) => put(&mut piece.internal_lines[k], points, is_turned),
        None => {
            let points = points.iter().map(|p| LinePoint { at: *p, kind: PointKind::Plain }).collect();
            piece.internal_lines.push(PieceLine { points, closed: false, name: None, source: source.cloned() });
        }
    }
}

/// The internal line of a piece that is this line, and whether it is drawn the other way round.
pub fn find(piece: &Piece, points: &[Vec2]) -> Option<(usize, bool)> {
    let near = |a: Option<&Vec2>, b: Option<&Vec2>| a.zip(b).is_some_and(|(a, b)| (a - b).norm() < ON_LINE);
    let turned = |line: &PieceLine| {
        let drawn = line.positions();
        let ends = [drawn.first(), drawn.last()];
        let is_same = near(ends[0], points.first()) && near(ends[1], points.last());
        let is_turned = near(ends[0], points.last()) && near(ends[1], points.first());
        (line.points.len() == points.len() && (is_same || is_turned)).then_some(!is_same)
    };
    piece.internal_lines.iter().enumerate().find_map(|(k, line)| Some((k, turned(line)?)))
}

/// Puts the points of a line onto others of the same number.
pub fn put(line: &mut PieceLine, points: &[Vec2], is_turned: bool) {
    let last = points.len().saturating_sub(1);
    for (i, point) in line.points.iter_mut().enumerate() {
        let onto = if is_turned { last.saturating_sub(i) } else { i };
        point.at = points.get(onto).copied().unwrap_or(point.at);
    }
}
