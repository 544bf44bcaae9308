//! Wedges that the rest of the file says are no darts: places for godets, slits, vents.

use crate::dxf::darts::{Denied, DrawnDart, Form};
use crate::dxf::desk::Desk;
use crate::dxf::geom;
use crate::dxf::piece::DrawnPiece;
use toile_garment::Diagnostic;
use toile_garment::outline::PointKind;

/// A wedge whose legs are as long as the two sides of another piece's point is a place for a godet; and where the file
/// marks its darts by drill holes, a wedge without one is a slit or vent.
pub(super) fn deny_inserts_and_unmarked(pieces: &mut [DrawnPiece], desk: &mut Desk<'_>) {
    let points: Vec<Vec<[f64; 2]>> = pieces.iter().map(convex_points).collect();
    let drilled = |piece: &DrawnPiece, dart: &DrawnDart| {
        let polygon = [dart.mouth[0], dart.apexes[0], dart.mouth[1]];
        piece.drills.iter().any(|d| {
            (d.at - dart.apexes[0]).norm() <= 30.0
                && (geom::inside(d.at, &polygon) || geom::distance(d.at, &polygon, true) <= 20.0)
        })
    };
    let notched = |piece: &DrawnPiece, dart: &DrawnDart| {
        dart.mouth.iter().all(|m| piece.notches.iter().any(|n| (n.at - m).norm() <= 12.0))
    };
    let is_wedge = |d: &DrawnDart| d.form == Form::Wedge;
    // A habit needs more than one witness: at least two drilled darts, and no fewer than without.
    let (mut with, mut without) = (0_usize, 0_usize);
    for piece in pieces.iter() {
        for dart in piece.darts.iter().filter(|d| is_wedge(d)) {
            if drilled(piece, dart) { with += 1 } else { without += 1 }
        }
    }
    let habit = with >= 2 && with >= without;
    for i in 0..pieces.len() {
        let (name, size) = (pieces[i].name.clone(), pieces[i].size.clone());
        let verdicts: Vec<Option<&'static str>> = pieces[i]
            .darts
            .iter()
            .map(|dart| {
                if !is_wedge(dart) {
                    return None;
                }
                let legs = [dart.leg_path(0), dart.leg_path(1)];
                let fits = |p: &[f64; 2]| {
                    let near = |a: f64, b: f64| (a - b).abs() <= (0.004 * b).max(0.5);
                    (near(p[0], legs[0]) && near(p[1], legs[1])) || (near(p[0], legs[1]) && near(p[1], legs[0]))
                };
                let other = (0..points.len()).filter(|j| {
                    *j != i && pieces[*j].size == size && (pieces[*j].name.is_none() || pieces[*j].name != name)
                });
                if other.into_iter().any(|j| points[j].iter().any(fits)) {
                    Some("another piece has a point with sides as long as its legs: an insert (godet) goes there")
                } else if habit && !drilled(&pieces[i], dart) && !notched(&pieces[i], dart) {
                    Some("the darts of this file have a drill hole at the apex and this wedge has neither that nor notches at its mouth")
                } else {
                    None
                }
            })
            .collect();
        let mut verdicts = verdicts.into_iter();
        let piece = &mut pieces[i];
        let (label, block) = (piece.label().to_owned(), piece.block.clone());
        let mut denied = Vec::new();
        piece.darts.retain(|dart| {
            let Some(why) = verdicts.next().flatten() else { return true };
            let at = dart.apexes[0];
            denied.push(Denied { at, why, form: dart.form });
            let text =
                format!("the wedge at ({:.1}, {:.1}) mm of `{label}` was not taken as a dart: {why}", at.x, at.y);
            let place = desk.findings.place_in(&block, Some("1"), dart.line);
            let hint = "if it is a dart, declare it in the sewing file: [[dart]] piece, apex, mouth, kind = \"wedge\"";
            desk.findings.push(Diagnostic::warning("wedge-not-a-dart", text).at(place).hint(hint));
            false
        });
        piece.denied.extend(denied);
    }
}

/// Lengths of the two edges at each sharp convex corner.
fn convex_points(piece: &DrawnPiece) -> Vec<[f64; 2]> {
    let nodes = &piece.sewn().drawn;
    let n = nodes.len();
    let corners: Vec<usize> = (0..n)
        .filter(|i| {
            let turn = geom::turn(nodes[(i + n - 1) % n].at, nodes[*i].at, nodes[(i + 1) % n].at).to_degrees();
            nodes[*i].kind == PointKind::Turn && turn.abs() > 20.0
        })
        .collect();
    let m = corners.len();
    if m < 3 || n > 5000 {
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
            // An insert is pointed: 100 degrees or less inside.
            (turn > 80.0).then(|| [run(a, c), run(c, b)])
        })
        .collect()
}
