//! Darts drawn as wedges in the outline: found by stated tests, never by guess.
//!
//! The outline turns back at an apex; a leg runs from there to the next corner on either side. A lens that is cut open
//! to the edge is the same drawing with legs that close again, and ends at its widest place.

use super::dart::{Denied, DrawnDart, Form};
use super::legs_test::wedge_test;
use super::thresholds::{BOW_OF_LEG, LENGTH_OF_WALK, PLACE_OF_PROBE, SLIT_OF_OPEN_LENS, TURN_OF_APEX, TURN_OF_LEG_END};
use super::zigzag;
use crate::dxf::chain::JOIN;
use crate::dxf::geom;
use crate::dxf::outline::{Node, Outline};
use toile_garment::Vec2;
use toile_garment::outline::PointKind;

/// All wedges of a closed outline that pass the tests, and those with legs of some length that do not.
#[must_use]
pub fn wedges(outline: &Outline, on: &'static str) -> (Vec<DrawnDart>, Vec<Denied>) {
    let nodes = &outline.drawn;
    let n = nodes.len();
    let positions = outline.positions();
    let mut found: Vec<DrawnDart> = Vec::new();
    let mut denied = Vec::new();
    for apex in (0..n).filter(|i| nodes[*i].kind == PointKind::Turn) {
        let turn = geom::turn(positions[(apex + n - 1) % n], positions[apex], positions[(apex + 1) % n]);
        if turn.to_degrees() > -TURN_OF_APEX {
            continue;
        }
        let (Some(before), Some(after)) = (walk(nodes, apex, false), walk(nodes, apex, true)) else { continue };
        let whole: [Vec<usize>; 2] = [before, after].map(|leg| leg.into_iter().rev().collect());
        let apex_at = positions[apex];
        let test = |legs: &[Vec<usize>; 2]| {
            let (a, b) = (positions[legs[0][0]], positions[legs[1][0]]);
            // The mouth must open to the outside: a chord through cloth means a notch of another kind.
            let middle = (a + b) * (0.5 * (1.0 - PLACE_OF_PROBE)) + apex_at * PLACE_OF_PROBE;
            legs[0][0] != legs[1][0] && wedge_test(apex_at, a, b).is_ok() && !geom::inside(middle, &positions)
        };
        if test(&whole) {
            found.extend(build(outline, &positions, apex, &whole, &whole, on));
        } else if let Some(wide) = widest(&whole, &positions).filter(test) {
            found.extend(build(outline, &positions, apex, &wide, &whole, on));
        } else if let Err(why) = wedge_test(apex_at, positions[whole[0][0]], positions[whole[1][0]]) {
            denied.push(Denied { at: apex_at, why, form: Form::Wedge });
        }
    }
    let (found, teeth) = zigzag::without_rows(found, &positions);
    denied.extend(teeth);
    (found, denied)
}

/// A fish-eye dart that is cut open to the edge: its legs close again at the edge. Cut off at the widest place.
fn widest(whole: &[Vec<usize>; 2], positions: &[Vec2]) -> Option<[Vec<usize>; 2]> {
    let at = |leg: &[usize], i: usize| positions[leg[i]];
    let (a, b) = (at(&whole[0], 0), at(&whole[1], 0));
    let apex = at(&whole[0], whole[0].len() - 1);
    let axis = (a + b) * 0.5 - apex;
    let cut = |leg: &[usize]| {
        let offset = |i: &usize| geom::cross(axis, at(leg, *i) - apex).abs();
        let i = (1..leg.len().saturating_sub(1)).max_by(|i, j| offset(i).total_cmp(&offset(j)))?;
        Some(leg[i..].to_vec())
    };
    let legs = [cut(&whole[0])?, cut(&whole[1])?];
    let mouth = (at(&legs[0], 0) - at(&legs[1], 0)).norm();
    ((a - b).norm() <= SLIT_OF_OPEN_LENS * mouth).then_some(legs)
}

/// The next vertex that is not the same one drawn twice.
fn beside(nodes: &[Node], i: usize, forward: bool) -> Vec2 {
    let n = nodes.len();
    let step = |k: usize| nodes[if forward { i + k } else { i + n * k - k } % n].at;
    (1..4).map(step).find(|p| (p - nodes[i].at).norm() > JOIN).unwrap_or_else(|| step(1))
}

/// Along the outline from an apex to the corner where the leg ends; apex first.
pub(super) fn walk(nodes: &[Node], apex: usize, forward: bool) -> Option<Vec<usize>> {
    let n = nodes.len();
    let step = |i: usize| if forward { (i + 1) % n } else { (i + n - 1) % n };
    let (mut path, mut length, mut at) = (vec![apex], 0.0, apex);
    while path.len() <= n {
        let next = step(at);
        length += (nodes[next].at - nodes[at].at).norm();
        if length > LENGTH_OF_WALK {
            return None;
        }
        path.push(next);
        let (before, after) = (beside(nodes, next, false), beside(nodes, next, true));
        let turn = geom::turn(before, nodes[next].at, after).to_degrees();
        let chord = (nodes[next].at - nodes[apex].at).norm();
        if nodes[next].kind == PointKind::Turn && turn.abs() > TURN_OF_LEG_END && chord > JOIN {
            return (turn > 0.0 && length <= chord * BOW_OF_LEG).then_some(path);
        }
        at = next;
    }
    None
}

fn build(
    outline: &Outline,
    positions: &[Vec2],
    apex: usize,
    legs: &[Vec<usize>; 2],
    whole: &[Vec<usize>; 2],
    on: &'static str,
) -> Option<DrawnDart> {
    let drawn = |leg: &[usize]| leg.iter().map(|i| positions[*i]).collect::<Vec<_>>();
    let place = |i: usize| outline.place.get(i).copied().flatten();
    let work = work_positions_between(outline, place(whole[0][0])?, place(apex)?);
    let mut back = work_positions_between(outline, place(apex)?, place(whole[1][0])?);
    back.reverse();
    Some(DrawnDart {
        form: Form::Wedge,
        apexes: vec![positions[apex]],
        mouth: [positions[legs[0][0]], positions[legs[1][0]]],
        legs: [drawn(&legs[0]), drawn(&legs[1])],
        work: [work, back],
        open_lens: legs != whole,
        on,
        line: outline.line,
        ids: Vec::new(),
        evidence: Vec::new(),
    })
}

fn work_positions_between(outline: &Outline, from: usize, to: usize) -> Vec<Vec2> {
    let n = outline.work.len();
    let steps = (to + n - from) % n;
    (0..=steps).map(|k| outline.work[(from + k) % n].at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dxf::chain::Path;
    use crate::dxf::outline::Marks;

    fn outline(points: &[(f64, f64)]) -> Outline {
        let points = points.iter().map(|(x, y)| (Vec2::new(*x, *y), true)).collect();
        let mut o = Outline::new(Path { ids: vec![0], line: 1, points, closed: true });
        o.classify(&Marks::new(&[], &[], &Default::default()));
        o.make_work(None, 0.05);
        o
    }

    fn with_wedge(left: (f64, f64), apex: (f64, f64), right: (f64, f64)) -> Outline {
        outline(&[(0.0, 0.0), (300.0, 0.0), (300.0, 600.0), right, apex, left, (0.0, 600.0)])
    }

    #[test]
    fn wedge_with_unequal_legs_is_found_as_drawn() {
        let darts = wedges(&with_wedge((135.0, 612.0), (150.0, 500.0), (165.0, 600.0)), "cut").0;
        assert_eq!(darts.len(), 1);
        assert_eq!(darts[0].apexes, [Vec2::new(150.0, 500.0)]);
        assert_eq!(darts[0].mouth, [Vec2::new(165.0, 600.0), Vec2::new(135.0, 612.0)]);
        assert!((darts[0].leg_chord(0) - 101.119).abs() < 1e-3 && (darts[0].leg_chord(1) - 113.0).abs() < 1e-3);
    }

    #[test]
    fn slits_notches_tabs_and_necklines_are_no_darts() {
        // 1 mm wide: a slit.
        assert!(wedges(&with_wedge((149.5, 600.0), (150.0, 400.0), (150.5, 600.0)), "cut").0.is_empty());
        // 8 mm deep: a notch cut into the outline.
        assert!(wedges(&with_wedge((148.0, 600.0), (150.0, 592.0), (152.0, 600.0)), "cut").0.is_empty());
        // Outward: a tab.
        assert!(wedges(&with_wedge((135.0, 600.0), (150.0, 700.0), (165.0, 600.0)), "cut").0.is_empty());
        // 200 mm wide: a V neck.
        assert!(wedges(&with_wedge((50.0, 600.0), (150.0, 400.0), (250.0, 600.0)), "cut").0.is_empty());
    }

    #[test]
    fn curved_legs_are_measured_along_the_path() {
        let o = outline(&[
            (0.0, 0.0),
            (300.0, 0.0),
            (300.0, 600.0),
            (170.0, 600.0),
            (163.0, 550.0),
            (150.0, 480.0),
            (137.0, 550.0),
            (130.0, 600.0),
            (0.0, 600.0),
        ]);
        let darts = wedges(&o, "cut").0;
        assert_eq!(darts.len(), 1);
        assert_eq!(darts[0].legs[0].len(), 3);
        assert!(darts[0].leg_path(0) > darts[0].leg_chord(0));
    }
}
