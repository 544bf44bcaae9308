//! Wedges that the rest of the file says are no darts: places for godets, slits, vents.

use super::codes;
use super::dart::{DECLARE, Denied, DrawnDart, Form};
use super::thresholds::{
    CORNERS_OF_INSERT, COUNT_OF_HABIT, DIFFERENCE_OF_INSERT, DISTANCE_OF_HABIT_DRILL, DISTANCE_OF_HABIT_NOTCH,
    DISTANCE_OF_INSERT, MARGIN_OF_HABIT_DRILL, TURN_OF_INSERT_CORNER, TURN_OF_INSERT_POINT, VERTICES_OF_INSERT,
};
use crate::dxf::desk::Desk;
use crate::dxf::geom;
use crate::dxf::piece::DrawnPiece;
use toile_garment::Diagnostic;
use toile_garment::outline::PointKind;

/// Why a place for an insert is no dart.
const INSERT: &str = "another piece has a point with sides as long as its legs: an insert (godet) goes there";
/// Why a wedge that the file does not mark is no dart.
const UNMARKED: &str =
    "the darts of this file have a drill hole at the apex and this wedge has neither that nor notches at its mouth";

/// Denies wedges by the rest of the file. A wedge whose legs are as long as the two sides of another piece's point is a
/// place for a godet. Where the file marks its darts by drill holes, a wedge without one is a slit or vent.
pub(in crate::dxf) fn deny_inserts_and_unmarked(pieces: &mut [DrawnPiece], desk: &mut Desk<'_>) {
    let points: Vec<Vec<[f64; 2]>> = pieces.iter().map(convex_points).collect();
    let habit = drills_its_darts(pieces);
    for i in 0..pieces.len() {
        let reason = |dart: &DrawnDart| {
            if dart.form != Form::Wedge {
                None
            } else if takes_insert(dart, i, pieces, &points) {
                Some(INSERT)
            } else {
                (habit && !drilled(&pieces[i], dart) && !notched(&pieces[i], dart)).then_some(UNMARKED)
            }
        };
        let verdicts: Vec<Option<&'static str>> = pieces[i].darts.iter().map(reason).collect();
        deny(&mut pieces[i], verdicts, desk);
    }
}

/// Takes the denied ones out of the darts of a piece and tells why.
fn deny(piece: &mut DrawnPiece, verdicts: Vec<Option<&'static str>>, desk: &mut Desk<'_>) {
    let mut verdicts = verdicts.into_iter();
    let (label, block) = (piece.label().to_owned(), piece.block.clone());
    let mut denied = Vec::new();
    piece.darts.retain(|dart| {
        let Some(why) = verdicts.next().flatten() else { return true };
        let at = dart.apexes[0];
        denied.push(Denied { at, why, form: dart.form });
        let text = format!("the wedge at ({:.1}, {:.1}) mm of `{label}` was not taken as a dart: {why}", at.x, at.y);
        desk.say(Diagnostic::warning(codes::WEDGE_NOT_A_DART, text).hint(DECLARE), &block, "1", dart.line);
        false
    });
    piece.doubts.denied.extend(denied);
}

/// Tells whether the file marks its wedges by drill holes. A habit needs more than one witness, and no fewer than speak
/// against it.
fn drills_its_darts(pieces: &[DrawnPiece]) -> bool {
    let (mut with, mut without) = (0_usize, 0_usize);
    for piece in pieces {
        for dart in piece.darts.iter().filter(|d| d.form == Form::Wedge) {
            if drilled(piece, dart) { with += 1 } else { without += 1 }
        }
    }
    with >= COUNT_OF_HABIT && with >= without
}

/// Tells whether a drill hole lies in the dart near its apex, or a little beside it.
fn drilled(piece: &DrawnPiece, dart: &DrawnDart) -> bool {
    let polygon = [dart.mouth[0], dart.apexes[0], dart.mouth[1]];
    piece.inside.drills.iter().any(|d| {
        (d.at - dart.apexes[0]).norm() <= DISTANCE_OF_HABIT_DRILL
            && (geom::inside(d.at, &polygon) || geom::distance(d.at, &polygon, true) <= MARGIN_OF_HABIT_DRILL)
    })
}

/// Tells whether both mouth points have a notch.
fn notched(piece: &DrawnPiece, dart: &DrawnDart) -> bool {
    dart.mouth.iter().all(|m| piece.notches.iter().any(|n| (n.at - m).norm() <= DISTANCE_OF_HABIT_NOTCH))
}

/// Tells whether another piece of the same size has a point whose sides are as long as the legs.
fn takes_insert(dart: &DrawnDart, i: usize, pieces: &[DrawnPiece], points: &[Vec<[f64; 2]>]) -> bool {
    let legs = [dart.leg_path(0), dart.leg_path(1)];
    let near = |a: f64, b: f64| (a - b).abs() <= (DIFFERENCE_OF_INSERT * b).max(DISTANCE_OF_INSERT);
    let fits =
        |p: &[f64; 2]| (near(p[0], legs[0]) && near(p[1], legs[1])) || (near(p[0], legs[1]) && near(p[1], legs[0]));
    let (name, size) = (&pieces[i].name, &pieces[i].size);
    let other =
        |j: &usize| *j != i && pieces[*j].size == *size && (pieces[*j].name.is_none() || pieces[*j].name != *name);
    (0..points.len()).filter(other).any(|j| points[j].iter().any(fits))
}

/// Lengths of the two edges at each sharp convex corner.
fn convex_points(piece: &DrawnPiece) -> Vec<[f64; 2]> {
    let nodes = &piece.sewn().drawn;
    let n = nodes.len();
    let corners: Vec<usize> = (0..n)
        .filter(|i| {
            let turn = geom::turn(nodes[(i + n - 1) % n].at, nodes[*i].at, nodes[(i + 1) % n].at).to_degrees();
            nodes[*i].kind == PointKind::Turn && turn.abs() > TURN_OF_INSERT_CORNER
        })
        .collect();
    let m = corners.len();
    if m < CORNERS_OF_INSERT || n > VERTICES_OF_INSERT {
        return Vec::new();
    }
    let run = |from: usize, to: usize| {
        let steps = (to + n - from) % n;
        (0..steps).map(|k| (nodes[(from + k + 1) % n].at - nodes[(from + k) % n].at).norm()).sum::<f64>()
    };
    (0..m)
        .filter_map(|k| {
            let (a, c, b) = (corners[(k + m - 1) % m], corners[k], corners[(k + 1) % m]);
            let turn = geom::turn(nodes[(c + n - 1) % n].at, nodes[c].at, nodes[(c + 1) % n].at).to_degrees();
            (turn > TURN_OF_INSERT_POINT).then(|| [run(a, c), run(c, b)])
        })
        .collect()
}
