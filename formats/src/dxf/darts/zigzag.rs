//! Teeth of a zigzag edge: wedges in a row that share their mouth points are no darts.

use super::dart::{Denied, DrawnDart};
use super::thresholds::{ANGLE_OF_TEETH, COUNT_OF_TEETH, DIFFERENCE_OF_TEETH, DISTANCE_OF_SHARED_MOUTH};
use crate::dxf::geom::{self, PointIndex};
use toile_garment::Vec2;

/// Why a tooth is no dart.
pub const WHY: &str = "it is one of a row of like wedges side by side: a zigzag edge";
/// Takes the rows out of the darts of a line; its vertices tell whether two wedges lie between halves of others.
#[must_use]
pub fn without_rows(darts: Vec<DrawnDart>, line: &[Vec2]) -> (Vec<DrawnDart>, Vec<Denied>) {
    let rows = rows(&darts);
    let places = if rows.iter().any(|row| row.len() == 2) { line } else { &[] };
    let places = PointIndex::new(DISTANCE_OF_SHARED_MOUTH, places.iter().enumerate().map(|(i, p)| (*p, i)));
    let mut tooth = vec![false; darts.len()];
    for row in &rows {
        let whole = row.len() >= COUNT_OF_TEETH;
        let in_row = whole || matches!(row.as_slice(), [a, b] if between_halves(&darts[*a], &darts[*b], line, &places));
        row.iter().for_each(|i| tooth[*i] = in_row);
    }
    let (mut kept, mut denied) = (Vec::new(), Vec::new());
    for (dart, tooth) in darts.into_iter().zip(tooth) {
        if tooth {
            denied.push(Denied { at: dart.apexes[0], why: WHY, form: dart.form });
        } else {
            kept.push(dart);
        }
    }
    (kept, denied)
}

/// Groups of like darts that hang together by their mouth points.
fn rows(darts: &[DrawnDart]) -> Vec<Vec<usize>> {
    let mouths = darts.iter().enumerate().flat_map(|(i, d)| d.mouth.map(|m| (m, i)));
    let index = PointIndex::new(DISTANCE_OF_SHARED_MOUTH, mouths);
    let mut seen = vec![false; darts.len()];
    let mut rows = Vec::new();
    for first in 0..darts.len() {
        let (mut row, mut next) = (Vec::new(), vec![first]);
        while let Some(i) = next.pop() {
            if std::mem::replace(&mut seen[i], true) {
                continue;
            }
            row.push(i);
            let beside = darts[i].mouth.iter().flat_map(|m| index.near(*m, DISTANCE_OF_SHARED_MOUTH)).map(|(_, j)| j);
            next.extend(beside.filter(|j| !seen[*j] && like(&darts[i], &darts[*j])));
        }
        rows.extend((!row.is_empty()).then_some(row));
    }
    rows
}

fn alike(a: f64, b: f64) -> bool {
    (a - b).abs() <= DIFFERENCE_OF_TEETH * a.max(b)
}

fn like(a: &DrawnDart, b: &DrawnDart) -> bool {
    let depth = |d: &DrawnDart| d.leg_chord(0) + d.leg_chord(1);
    alike(a.width(), b.width()) && alike(depth(a), depth(b))
}

/// Does the line go on at both outer mouth points of two neighbours as it does between them?
fn between_halves(a: &DrawnDart, b: &DrawnDart, line: &[Vec2], places: &PointIndex) -> bool {
    let Some((a, b)) =
        [(a, b), (b, a)].into_iter().find(|(a, b)| (a.mouth[1] - b.mouth[0]).norm() <= DISTANCE_OF_SHARED_MOUTH)
    else {
        return false;
    };
    let n = line.len();
    let vertex = |p: Vec2| places.near(p, DISTANCE_OF_SHARED_MOUTH).first().map(|(_, i)| *i);
    let (Some(first), Some(last)) = (vertex(a.mouth[0]), vertex(b.mouth[1])) else { return false };
    let point = |tip: Vec2, p: Vec2, q: Vec2| geom::angle(p - tip, q - tip);
    let between = point(a.mouth[1], a.apexes[0], b.apexes[0]);
    let half = |at: usize, beyond: Vec2, apex: Vec2| {
        let (side, leg) = ((beyond - line[at]).norm(), (apex - line[at]).norm());
        alike(side, leg) && (point(line[at], apex, beyond) - between).abs() <= ANGLE_OF_TEETH
    };
    half(first, line[(first + n - 1) % n], a.apexes[0]) && half(last, line[(last + 1) % n], b.apexes[0])
}
