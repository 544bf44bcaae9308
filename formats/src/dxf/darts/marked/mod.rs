//! Darts marked inside the piece: legs on layer 8 with their ends on the outline.
//!
//! `ground.rs` opens the lines, cuts them off and puts their ends onto the outline; `legs.rs` pairs them and tells the
//! legs of darts from the sides of boxes (plackets, flaps, pockets).

mod ground;
mod legs;

use super::dart::{Denied, DrawnDart};
use super::thresholds::{COUNT_OF_MARKED_LINES, DISTANCE_OF_SAME_DART};
use super::zigzag;
use crate::dxf::chain::Path;
use crate::dxf::limits;
use crate::dxf::outline::Outline;
use ground::Ground;
use legs::{Leg, dart, halves, pairs};
use toile_garment::Vec2;

/// Marked darts among internal lines, and what looks like one and is none. Legs that run over an allowance to the cut
/// line, or past the edge, are cut off at the sewn outline.
#[must_use]
pub fn marked(internal: &[Path], outline: &Outline, cut: Option<&[Vec2]>) -> (Vec<DrawnDart>, Vec<Denied>) {
    let (line, work) = (outline.positions(), outline.work_positions());
    let ground = Ground::new(&line, &work, cut.unwrap_or(&line));
    let (mut found, mut denied, mut single) = (Vec::new(), Vec::new(), Vec::new());
    let mut take = |legs: Option<Result<DrawnDart, Denied>>| match legs {
        Some(Ok(dart)) => add(&mut found, dart),
        Some(Err(why)) => denied.push(why),
        None => {}
    };
    let mut tests = 0;
    for path in internal.iter().take(COUNT_OF_MARKED_LINES) {
        let cost = path.points.len() * ground.size();
        if tests + cost > limits::DART_TESTS {
            continue;
        }
        tests += cost;
        for points in ground.lines(path) {
            match [ground.on(points[0]), ground.on(points[points.len() - 1])] {
                [true, true] if points.len() >= 3 => {
                    take(halves(points).and_then(|legs| dart(legs, path.line, path.ids.clone(), &work)));
                }
                [true, false] => single.push(Leg { points, path }),
                [false, true] => single.push(Leg { points: points.into_iter().rev().collect(), path }),
                _ => {}
            }
        }
    }
    for pair in pairs(&single) {
        take(dart(pair.legs, pair.line, pair.ids, &work));
    }
    let (found, row) = zigzag::without_rows(found, &[]);
    denied.extend(row);
    (found, denied)
}

/// Adds a dart unless it is drawn there already; then the lines belong to that one.
fn add(found: &mut Vec<DrawnDart>, dart: DrawnDart) {
    let near = |a: Vec2, b: Vec2| (a - b).norm() <= DISTANCE_OF_SAME_DART;
    let same = |d: &&mut DrawnDart| {
        near(d.apexes[0], dart.apexes[0]) && near(d.mouth[0], dart.mouth[0]) && near(d.mouth[1], dart.mouth[1])
    };
    let full = found.len() >= COUNT_OF_MARKED_LINES;
    match found.iter_mut().find(same) {
        Some(there) => there.ids.extend(&dart.ids),
        None if full => {}
        None => found.push(dart),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dxf::outline::Marks;

    fn path(points: &[(f64, f64)], closed: bool) -> Path {
        let points = points.iter().map(|(x, y)| (Vec2::new(*x, *y), true)).collect();
        Path { ids: vec![7], line: 9, points, closed }
    }

    fn sheet() -> Outline {
        let mut o = Outline::new(path(&[(0.0, 0.0), (300.0, 0.0), (300.0, 600.0), (0.0, 600.0)], true));
        o.classify(&Marks::new(&[], &[], &Default::default()));
        o
    }

    #[test]
    fn bent_line_two_lines_and_triangle_are_one_dart() {
        let forms = [
            vec![path(&[(135.0, 600.0), (150.0, 500.0), (165.0, 600.0)], false)],
            vec![path(&[(150.0, 500.0), (135.0, 600.0)], false), path(&[(165.0, 600.0), (150.0, 500.1)], false)],
            vec![path(&[(165.0, 600.0), (135.0, 600.0), (150.0, 500.0)], true)],
        ];
        for form in forms {
            let darts = marked(&form, &sheet(), None).0;
            assert_eq!(darts.len(), 1, "{form:?}");
            assert!((darts[0].apexes[0] - Vec2::new(150.0, 500.0)).norm() <= 0.1 + 1e-9);
            assert_eq!(darts[0].mouth[0], Vec2::new(165.0, 600.0), "counter-clockwise first");
        }
    }

    #[test]
    fn lines_that_end_inside_are_no_darts() {
        assert!(marked(&[path(&[(135.0, 580.0), (150.0, 500.0), (165.0, 580.0)], false)], &sheet(), None).0.is_empty());
    }
}
