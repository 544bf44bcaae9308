//! Pleats, yokes, button fronts and bands that no name tells, drafted here.

use super::layout::marked;
use super::{Known, Nameless, button_fronts, pleats, propose};
use crate::sewing::apply;
use crate::sewing::shapes::shapes;
use crate::testing::{notch, piece, rectangle, v};
use toile_garment::outline::{LinePoint, PieceLine, PointKind};
use toile_garment::piece::DrillHole;
use toile_garment::sewing::{CopySpec, PleatPress, SewingPlan};
use toile_garment::{Garment, Piece, PieceId, Report, Vec2};

fn garment(pieces: Vec<Piece>) -> Garment {
    let pieces = pieces.into_iter().enumerate().map(|(i, p)| Piece { id: PieceId::from(i), ..p }).collect();
    Garment { pieces, ..Garment::default() }
}

/// An inner line, mm.
fn line(from: (f64, f64), to: (f64, f64)) -> PieceLine {
    let points = [from, to].map(|(x, y)| LinePoint { at: v(x, y), kind: PointKind::Plain }).to_vec();
    PieceLine { points, closed: false, ..PieceLine::default() }
}

/// A back that is 40 mm wider than its yoke, with notches on its upper edge.
fn back_and_yoke(notches: [f64; 2]) -> Garment {
    let mut back = rectangle(0, "back", 444.0, 520.0);
    back.notches = notches.map(|x| notch(x, 520.0)).to_vec();
    garment(vec![back, rectangle(0, "yoke", 404.0, 120.0)])
}

/// Are two points those of a mouth, mm?
fn is_mouth(mouth: [Vec2; 2], at: [(f64, f64); 2]) -> bool {
    mouth.iter().zip(at).all(|(p, (x, y))| (p - v(x, y)).norm() < 1e-6)
}

/// Numbers of atoms of the panels.
fn atoms(garment: &Garment) -> Vec<usize> {
    let layout = marked(garment, &shapes(garment).expect("shapes"), &[]);
    layout.panels.iter().map(|p| p.atoms.len()).collect()
}

#[test]
fn a_back_has_a_pleat_where_its_notches_take_what_it_has_more_than_its_yoke() {
    let mut garment = back_and_yoke([202.0, 242.0]);
    let found = pleats(&garment, &[]);
    assert!(found.len() == 1 && found[0].piece == "back" && is_mouth(found[0].mouth, [(242.0, 520.0), (202.0, 520.0)]));
    // The edge goes on over the pleat, and is sewn to the yoke as a whole.
    let plan = SewingPlan { darts: found, ..SewingPlan::default() };
    apply(&mut garment, plan, &mut Report::default()).expect("a pleat");
    assert_eq!(atoms(&garment), [4, 4]);
    let proposal = propose(&garment, &Nameless, &Known::default()).expect("proposal");
    let yoke = proposal.seams.iter().find(|s| s.a.len() + s.b.len() == 3).expect("a seam over the pleat");
    assert!((yoke.length_a - 0.404).abs() < 1e-9 && (yoke.length_b - 0.404).abs() < 1e-9, "{yoke:?}");
    let pleated = if yoke.a.len() == 2 { &yoke.a } else { &yoke.b };
    let both = pleated[0].edges[0].with(&pleated[1].edges[0]).expect("one edge");
    assert_eq!((both.number, both.places), (2, None));
}

#[test]
fn a_pleat_alone_lies_in_the_middle_and_takes_just_what_is_too_much() {
    assert!(pleats(&back_and_yoke([102.0, 142.0]), &[]).is_empty());
    assert!(pleats(&back_and_yoke([204.0, 240.0]), &[]).is_empty());
    // A piece that is not sewn asks for none.
    assert!(pleats(&back_and_yoke([202.0, 242.0]), &["yoke".to_owned()]).is_empty());
}

#[test]
fn lines_from_notches_are_pressed_pleats() {
    let mut panel = rectangle(0, "panel", 510.0, 500.0);
    for x in [60.0, 130.0, 290.0, 360.0] {
        panel.notches.push(notch(x, 500.0));
        // One line goes on to the cut line.
        panel.internal_lines.push(line((x, 510.0), (x, if x > 200.0 { -20.0 } else { 100.0 })));
    }
    let found = pleats(&garment(vec![panel]), &[]);
    assert_eq!(found.len(), 2);
    assert!(found.iter().all(|p| p.press == Some(PleatPress::Knife) && p.sewn == Some(0.0)));
    assert!(is_mouth(found[1].mouth, [(130.0, 500.0), (60.0, 500.0)]), "{:?}", found[1]);
    assert!((found[1].apexes[0] - v(130.0, 100.0)).norm() < 1e-6, "{:?}", found[1].apexes);
    assert!(found[0].apexes[0].y >= 0.0 && found[0].apexes[0].y < 1e-3, "{:?}", found[0].apexes);
}

#[test]
fn the_side_of_a_front_is_marked_where_the_yoke_meets_the_back() {
    let yoke = |height: f64| rectangle(0, "yoke", 200.0, height);
    let with =
        |yoke: Piece| garment(vec![rectangle(0, "front", 230.0, 600.0), rectangle(0, "back", 200.0, 530.0), yoke]);
    assert_eq!(atoms(&with(yoke(70.0))), [6, 4, 4]);
    assert_eq!(atoms(&with(yoke(75.0))), [4, 4, 4]);
}

#[test]
fn a_notch_that_the_other_side_lacks_does_not_part_an_edge_that_fits_as_a_whole() {
    let mut front = rectangle(0, "front", 500.0, 300.0);
    front.notches = vec![notch(430.0, 300.0)];
    let with = |length: f64| atoms(&garment(vec![front.clone(), rectangle(0, "band", length, 45.0)]));
    assert_eq!(with(500.0), [4, 4]);
    assert_eq!(with(430.0), [5, 4]);
}

#[test]
fn a_front_with_holes_on_a_line_is_closed_by_buttons() {
    let points = [(-45.0, 0.0, 't'), (250.0, 0.0, 't'), (230.0, 500.0, 't'), (80.0, 540.0, 't'), (0.0, 450.0, 't')];
    let mut front = piece(0, "front", &[&points[..], &[(-15.0, 450.0, 't'), (-45.0, 450.0, 't')]].concat());
    front.internal_lines = vec![line((0.0, 450.0), (0.0, 0.0)), line((-15.0, 450.0), (-15.0, 0.0))];
    let hole = |y: f64| DrillHole { at: v(0.0, y), diameter: None, source: None };
    front.drill_holes = [400.0, 300.0, 200.0].map(hole).to_vec();
    front.drill_holes.push(DrillHole { at: v(120.0, 350.0), diameter: None, source: None });
    let copy = CopySpec { piece: "front".into(), name: "front-M".into(), mirror: true, source: None };
    let with = |copies: Vec<CopySpec>| {
        let plan = SewingPlan { copies, ..SewingPlan::default() };
        button_fronts(&Garment { plan, ..garment(vec![front.clone()]) })
    };
    let found = with(vec![copy]);
    assert_eq!(found[0].buttons, [v(0.0, 400.0), v(0.0, 300.0), v(0.0, 200.0)]);
    assert_eq!(found[0].fold, Some([v(-15.0, 450.0), v(-15.0, 0.0)]));
    assert!(
        found[0].is_beyond(&[v(-45.0, 450.0), v(-45.0, 0.0)]) && !found[0].is_beyond(&[v(0.0, 450.0), v(-15.0, 450.0)])
    );
    // A piece that is cut once meets no other half.
    assert!(with(Vec::new()).is_empty());
}

#[test]
fn a_single_band_goes_around_the_waist_whatever_its_name_is() {
    let panel = |name: &str, top: f64| {
        piece(0, name, &[(0.0, 0.0, 't'), (top + 150.0, 0.0, 't'), (top + 75.0, 600.0, 't'), (75.0, 600.0, 't')])
    };
    let skirt = garment(vec![panel("1", 350.0), panel("2", 390.0), rectangle(0, "3", 770.0, 40.0)]);
    let proposal = propose(&skirt, &Nameless, &Known::default()).expect("proposal");
    let waist = proposal.seams.iter().find(|s| s.a.iter().chain(&s.b).any(|r| r.piece == 2)).expect("a band");
    let edges: Vec<_> = waist.a.iter().map(|r| (r.piece, r.edges[0].number)).collect();
    assert!(edges.len() == 2 && edges.iter().all(|(piece, edge)| *piece < 2 && *edge == 2), "{edges:?}");
}
