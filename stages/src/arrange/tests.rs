//! A shirt and trousers of straight pieces, with and without names.

use super::*;
use crate::roles::outline::Polygon;
use crate::roles::{Facing, PiecePoint, roles};
use crate::testing::{piece, v};
use toile_garment::Vec2;
use toile_garment::piece::PressedFold;

/// A seam between two straight edges, mm, of which the first ends meet and the last.
fn join(name: &str, a: (usize, [[f64; 2]; 2]), b: (usize, [[f64; 2]; 2])) -> Join {
    let at = |(piece, [from, to]): (usize, [[f64; 2]; 2]), k: usize| {
        let share = k as f64 / 8.0;
        let [from, to] = [from, to].map(|[x, y]| v(x, y));
        PiecePoint { piece, at: from + (to - from) * share, is_inside: false }
    };
    let [from, to] = a.1.map(|[x, y]| v(x, y));
    Join { name: name.into(), pairs: (0..=8).map(|k| [at(a, k), at(b, k)]).collect(), length: (to - from).norm() }
}

fn corners(points: &[[f64; 2]]) -> Vec<(f64, f64, char)> {
    points.iter().map(|[x, y]| (*x, *y, 't')).collect()
}

/// Front, back and two sleeves in one piece, called so.
pub fn shirt(names: [&str; 4]) -> (Vec<Piece>, Vec<Join>) {
    let trunk = |neck: f64| {
        let half = [[250.0, 0.0], [250.0, 360.0], [195.0, 545.0], [75.0, 590.0], [40.0, neck]];
        half.into_iter().chain(half.into_iter().rev().map(|[x, y]| [-x, y])).collect::<Vec<_>>()
    };
    let sleeve = [[-150.0, 0.0], [150.0, 0.0], [180.0, 150.0], [0.0, 220.0], [-180.0, 150.0]];
    let pieces = vec![
        piece(0, names[0], &corners(&trunk(510.0))),
        piece(1, names[1], &corners(&trunk(570.0))),
        piece(2, names[2], &corners(&sleeve)),
        piece(3, names[3], &corners(&sleeve)),
    ];
    let mut joins = Vec::new();
    for (arm, s) in [(2, 1.0), (3, -1.0)] {
        let side = |s: f64| [[s * 250.0, 0.0], [s * 250.0, 360.0]];
        let shoulder = |s: f64| [[s * 195.0, 545.0], [s * 75.0, 590.0]];
        let armhole = |s: f64| [[s * 250.0, 360.0], [s * 195.0, 545.0]];
        let cap = |s: f64| [[s * 180.0, 150.0], [0.0, 220.0]];
        let under = |s: f64| [[s * 150.0, 0.0], [s * 180.0, 150.0]];
        joins.push(join("side", (0, side(s)), (1, side(-s))));
        joins.push(join("shoulder", (0, shoulder(s)), (1, shoulder(-s))));
        joins.push(join("front armhole", (0, armhole(s)), (arm, cap(-s))));
        joins.push(join("back armhole", (1, armhole(-s)), (arm, cap(s))));
        joins.push(join("under the arm", (arm, under(s)), (arm, under(-s))));
    }
    (pieces, joins)
}

/// Left and right front and back of trousers, and a waistband in two pieces.
fn trousers() -> (Vec<Piece>, Vec<Join>) {
    let leg = |s: f64, crotch: f64| {
        let points = [[crotch, 600.0], [0.0, 700.0], [0.0, 900.0], [240.0, 900.0], [240.0, 0.0], [20.0, 0.0]];
        let all = points.map(|[x, y]| [s * x, y]);
        if s > 0.0 { all.into_iter().rev().collect::<Vec<_>>() } else { all.to_vec() }
    };
    let band = [[-240.0, 0.0], [240.0, 0.0], [240.0, 40.0], [-240.0, 40.0]];
    let pieces = vec![
        piece(0, "FRONT-LEG-L", &corners(&leg(1.0, -50.0))),
        piece(1, "FRONT-LEG-R", &corners(&leg(-1.0, -50.0))),
        piece(2, "BACK-LEG-L", &corners(&leg(-1.0, -50.0))),
        piece(3, "BACK-LEG-R", &corners(&leg(1.0, -50.0))),
        piece(4, "WAISTBAND-FRONT", &corners(&band)),
        piece(5, "WAISTBAND-BACK", &corners(&band)),
    ];
    let crotch = |s: f64| [[0.0, 900.0], [s * -50.0, 600.0]];
    let outer = |s: f64| [[s * 240.0, 0.0], [s * 240.0, 900.0]];
    let inner = |s: f64| [[s * 20.0, 0.0], [s * -50.0, 600.0]];
    let waist = |s: f64| [[0.0, 900.0], [s * 240.0, 900.0]];
    let on_band = |s: f64| [[0.0, 0.0], [s * 240.0, 0.0]];
    let joins = vec![
        join("front crotch", (0, crotch(1.0)), (1, crotch(-1.0))),
        join("back crotch", (2, crotch(-1.0)), (3, crotch(1.0))),
        join("outer left", (0, outer(1.0)), (2, outer(-1.0))),
        join("outer right", (1, outer(-1.0)), (3, outer(1.0))),
        join("inner left", (0, inner(1.0)), (2, inner(-1.0))),
        join("inner right", (1, inner(-1.0)), (3, inner(1.0))),
        join("waist front left", (0, waist(1.0)), (4, on_band(1.0))),
        join("waist front right", (1, waist(-1.0)), (4, on_band(-1.0))),
        join("waist back left", (2, waist(-1.0)), (5, on_band(-1.0))),
        join("waist back right", (3, waist(1.0)), (5, on_band(1.0))),
        join("band left", (4, [[240.0, 0.0], [240.0, 40.0]]), (5, [[-240.0, 0.0], [-240.0, 40.0]])),
        join("band right", (4, [[-240.0, 0.0], [-240.0, 40.0]]), (5, [[240.0, 0.0], [240.0, 40.0]])),
    ];
    (pieces, joins)
}

fn arranged(pieces: &[Piece], joins: &[Join]) -> Arrangement {
    arrange(pieces, &roles(pieces, joins), joins, None, Given::nothing(pieces.len()))
}

fn middle(arrangement: &Arrangement, pieces: &[Piece], i: usize) -> Vec3 {
    let place = arrangement.places[i].as_ref().expect("a place");
    place.sheet.at(Polygon::of(&pieces[i]).centroid())
}

#[test]
fn a_shirt_hangs_at_the_shoulders_with_its_sleeves_on_the_arms_they_are_sewn_to() {
    for names in [["FRONT", "BACK", "SLEEVE", "SLEEVE-2"], ["P1", "P2", "P3", "P4"]] {
        let (pieces, joins) = shirt(names);
        let a = arranged(&pieces, &joins);
        assert!(a.unplaced.is_empty() && a.held.is_empty(), "{:?} {:?}", a.unplaced, a.held);
        let segments: Vec<&str> = a.places.iter().flatten().map(|p| p.segment.name()).collect();
        assert_eq!(segments, ["torso", "torso", "arm-left", "arm-right"]);
        assert!(middle(&a, &pieces, 0).z > 0.1 && middle(&a, &pieces, 1).z < -0.1);
        let form = Form::of(None);
        let tip = a.places[0].as_ref().expect("front").sheet.at(v(135.0, 567.5));
        assert!((tip.y - form.torso.from.y).abs() < 0.03, "{tip}");
        for (i, sign) in [(2, 1.0), (3, -1.0)] {
            let place = a.places[i].as_ref().expect("sleeve");
            assert!(place.sheet.bend.is_some());
            let (cap, hem) = (place.sheet.at(v(0.0, 220.0)), place.sheet.at(v(0.0, 0.0)));
            assert!(sign * cap.x > 0.0 && sign * (hem.x - cap.x) > 0.1 && hem.y < cap.y, "{cap} {hem}");
            // The half that is sewn to the front lies in front.
            let front = place.sheet.at(v(-sign * 90.0, 185.0));
            let back = place.sheet.at(v(sign * 90.0, 185.0));
            assert!(front.z > back.z, "{front} {back}");
        }
    }
}

#[test]
fn the_deeper_neckline_is_the_front() {
    let (pieces, joins) = shirt(["P1", "P2", "P3", "P4"]);
    let found = roles(&pieces, &joins);
    let told: Vec<_> = found.iter().map(|r| (r.part, r.facing)).collect();
    let (bodice, sleeve) = (Some(Part::Bodice), Some(Part::Sleeve));
    assert_eq!(told, [(bodice, Some(Facing::Front)), (bodice, Some(Facing::Back)), (sleeve, None), (sleeve, None)]);
    assert!(found.iter().all(|r| r.confidence > 0.4 && r.confidence < 0.9 && !r.evidence.is_empty()));
}

#[test]
fn a_band_at_the_hem_lifts_no_shirt_to_the_waist() {
    // Without a shoulder seam, as of a raglan, nothing but the sleeves tells the height.
    let heights = |has_band: bool| {
        let (mut pieces, mut joins) = shirt(["front bodice", "back bodice", "sleeve left", "sleeve right"]);
        joins.retain(|j| j.name != "shoulder");
        if has_band {
            let band = [[-240.0, 0.0], [240.0, 0.0], [240.0, 60.0], [-240.0, 60.0]];
            pieces.push(piece(4, "hem rib", &corners(&band)));
            joins.push(join("hem", (0, [[-250.0, 0.0], [250.0, 0.0]]), (4, [[-240.0, 60.0], [0.0, 60.0]])));
            joins.push(join("hem", (1, [[-250.0, 0.0], [250.0, 0.0]]), (4, [[0.0, 60.0], [240.0, 60.0]])));
        }
        let arrangement = arranged(&pieces, &joins);
        [0, 1].map(|i| middle(&arrangement, &pieces, i).y)
    };
    assert_eq!(heights(true), heights(false));
}

#[test]
fn a_band_at_the_hem_hangs_from_the_edge_by_which_it_is_sewn() {
    for (low, high) in [(0.0, 60.0), (60.0, 0.0)] {
        let (mut pieces, mut joins) = shirt(["front bodice", "back bodice", "sleeve left", "sleeve right"]);
        let band = [[-240.0, 0.0], [240.0, 0.0], [240.0, 60.0], [-240.0, 60.0]];
        pieces.push(piece(4, "hem rib", &corners(&band)));
        joins.push(join("hem", (0, [[-250.0, 0.0], [250.0, 0.0]]), (4, [[-240.0, high], [0.0, high]])));
        joins.push(join("hem", (1, [[-250.0, 0.0], [250.0, 0.0]]), (4, [[0.0, high], [240.0, high]])));
        let arrangement = arranged(&pieces, &joins);
        let sheet = &arrangement.places[4].as_ref().expect("a place").sheet;
        let height = |y: f64| sheet.at(Vec2::new(0.0, y * 1e-3)).y;
        assert!(height(high) > height(low) + 0.05, "{} {}", height(high), height(low));
    }
}

#[test]
fn trousers_are_held_at_the_waist_and_their_legs_lie_side_by_side() {
    let (pieces, joins) = trousers();
    let a = arranged(&pieces, &joins);
    assert!(a.unplaced.is_empty());
    assert_eq!(a.held, [Held { piece: 4, edge: 2 }, Held { piece: 5, edge: 2 }]);
    let at = |i| middle(&a, &pieces, i);
    assert!(at(0).x > 0.05 && at(1).x < -0.05 && at(2).x > 0.05 && at(3).x < -0.05);
    assert!(at(0).z > 0.1 && at(1).z > 0.1 && at(2).z < -0.1 && at(3).z < -0.1);
    // The forks of the fronts do not cross.
    let seen = |i: usize| {
        let sheet = &a.places[i].as_ref().expect("a place").sheet;
        Polygon::of(&pieces[i]).map(|p| Vec2::new(sheet.at(p).x, sheet.at(p).y))
    };
    assert!(!seen(0).overlaps(&seen(1)));
    // The inner ends of the hems come near to the middle, which the forks do not pass.
    for (i, x) in [(0, 20.0), (1, -20.0), (2, -20.0), (3, 20.0)] {
        let side = if i % 2 == 0 { 1.0 } else { -1.0 };
        let hem = a.places[i].as_ref().expect("a place").sheet.at(v(x, 0.0));
        let fork = seen(i).points.iter().map(|p| side * p.x).fold(f64::INFINITY, f64::min);
        assert!(fork > 0.0 && side * hem.x < fork + 0.02, "{i}: {hem:?}");
    }
    let top = a.places[4].as_ref().expect("band").sheet.at(v(0.0, 40.0)).y;
    assert!((top - Form::of(None).waist).abs() < 0.005, "{top}");
}

#[test]
fn legs_in_one_piece_lie_around_the_left_and_the_right_half_of_the_body() {
    // The back rise is longer. It lies to the right as drawn on a left leg.
    let leg = |s: f64| {
        let points = [[-200.0, 0.0], [200.0, 0.0], [260.0, 600.0], [220.0, 900.0], [-220.0, 850.0], [-260.0, 600.0]];
        let all = points.map(|[x, y]| [s * x, y]);
        if s > 0.0 { all.to_vec() } else { all.into_iter().rev().collect() }
    };
    let pieces = vec![piece(0, "LEG", &corners(&leg(-1.0))), piece(1, "LEG-M", &corners(&leg(1.0)))];
    let inner = |s: f64| [[s * 200.0, 0.0], [s * 260.0, 600.0]];
    let back = |s: f64| [[s * 260.0, 600.0], [s * 220.0, 900.0]];
    let front = |s: f64| [[s * -260.0, 600.0], [s * -220.0, 850.0]];
    let joins = vec![
        join("inner right", (0, inner(1.0)), (0, inner(-1.0))),
        join("inner left", (1, inner(1.0)), (1, inner(-1.0))),
        join("back crotch", (0, back(-1.0)), (1, back(1.0))),
        join("front crotch", (0, front(-1.0)), (1, front(1.0))),
    ];
    let arrangement = arranged(&pieces, &joins);
    let at = |i: usize, [x, y]: [f64; 2]| arrangement.places[i].as_ref().expect("a place").sheet.at(v(x, y));
    assert!(at(0, [0.0, 500.0]).x < -0.1 && at(1, [0.0, 500.0]).x > 0.1, "right and left");
    // The rises of both meet before and behind the body.
    for (own, other, is_front) in [([220.0, 850.0], [-220.0, 850.0], true), ([-220.0, 900.0], [220.0, 900.0], false)] {
        let (p, q) = (at(0, own), at(1, other));
        assert!((p - q).norm() < 0.15 && (p.z > 0.05) == is_front && (q.z > 0.05) == is_front, "{p} {q}");
    }
}

#[test]
fn places_that_a_person_gives_stay_and_the_rest_follows() {
    let (pieces, joins) = shirt(["FRONT", "BACK", "SLEEVE", "SLEEVE-2"]);
    let given = Sheet { origin: Vec3::new(0.0, 0.6, 0.25), ..Sheet::facing(Vec3::z(), Vec3::y(), 0.0) };
    let sheets = vec![Some(given.clone()), None, None, None];
    let all = Given { sheets, ..Given::nothing(4) };
    let a = arrange(&pieces, &roles(&pieces, &joins), &joins, None, all);
    assert_eq!(a.places[0].as_ref().expect("front").translation(), given.origin);
    let (front, back) = (middle(&a, &pieces, 0), middle(&a, &pieces, 1));
    assert!((front.y - back.y).abs() < 0.03, "{front} {back}");
}

#[test]
fn a_lapel_that_folds_over_lies_outside_and_a_facing_that_does_not_stays_inside() {
    // Both outlines go the same way round along the neckline where the lapel lies turned over on the front.
    for (sign, is_outside) in [(1.0, true), (-1.0, false)] {
        let (mut pieces, mut joins) = shirt(["FRONT", "BACK", "SLEEVE", "SLEEVE-2"]);
        let mut lapel = vec![[0.0, 0.0], [sign * 50.0, 40.0], [sign * 50.0, 87.0], [0.0, 87.0]];
        if sign < 0.0 {
            lapel.reverse();
        }
        pieces.push(piece(4, "COLLAR-FRONT-LEFT", &corners(&lapel)));
        joins.push(join("lapel", (0, [[75.0, 590.0], [40.0, 510.0]]), (4, [[0.0, 87.0], [0.0, 0.0]])));
        let a = arranged(&pieces, &joins);
        let (front, lapel) = (middle(&a, &pieces, 0), middle(&a, &pieces, 4));
        assert_eq!(lapel.z > front.z, is_outside, "{front} {lapel}");
    }
}

#[test]
fn a_piece_that_is_sewn_to_nothing_has_no_place() {
    let (mut pieces, joins) = shirt(["FRONT", "BACK", "SLEEVE", "SLEEVE-2"]);
    pieces.push(piece(4, "LABEL", &corners(&[[0.0, 0.0], [40.0, 0.0], [40.0, 20.0], [0.0, 20.0]])));
    let a = arranged(&pieces, &joins);
    assert_eq!(a.unplaced, [(4, "it is sewn to nothing".to_owned())]);
}

/// The shirt with a lining of front and back, which is sewn in at the armholes.
fn lined() -> (Vec<Piece>, Vec<Join>) {
    let (mut pieces, mut joins) = shirt(["FRONT", "BACK", "SLEEVE", "SLEEVE-2"]);
    for (k, name) in [(4, "LINING-FRONT"), (5, "LINING-BACK")] {
        let points: Vec<[f64; 2]> = pieces[k - 4].outline.positions().iter().map(|p| [p.x * 1e3, p.y * 1e3]).collect();
        pieces.push(piece(k, name, &corners(&points)));
    }
    for s in [1.0, -1.0] {
        let side = |s: f64| [[s * 250.0, 0.0], [s * 250.0, 360.0]];
        let armhole = |s: f64| [[s * 250.0, 360.0], [s * 195.0, 545.0]];
        joins.push(join("side of the lining", (4, side(s)), (5, side(-s))));
        joins.push(join("armhole of the lining", (0, armhole(s)), (4, armhole(s))));
        joins.push(join("armhole of the lining", (1, armhole(s)), (5, armhole(s))));
    }
    (pieces, joins)
}

#[test]
fn a_lining_starts_inside_and_a_folded_collar_is_sewn_last() {
    let (pieces, joins) = lined();
    let a = arranged(&pieces, &joins);
    let outwards = |i: usize| middle(&a, &pieces, i).z;
    assert!(outwards(0) > outwards(4) + 0.015, "{} {}", outwards(0), outwards(4));
    assert!(outwards(1) < outwards(5) - 0.015, "{} {}", outwards(1), outwards(5));
    // What a person says of the layers goes before.
    let given = Given { layers: vec![0, 0, 0, 0, 1, 1], ..Given::nothing(6) };
    let outside = arrange(&pieces, &roles(&pieces, &joins), &joins, None, given);
    assert!(middle(&outside, &pieces, 4).z > middle(&outside, &pieces, 0).z + 0.015);

    // A collar that is pressed over itself comes when all else is sewn.
    let mut folded = pieces;
    folded[5].name = "COLLAR".into();
    let line = vec![v(-250.0, 300.0), v(250.0, 300.0)];
    folded[5].folds.push(PressedFold { name: "roll".into(), line, angle: -3.1, pleat: None });
    assert_eq!(sewn_last(&folded, &roles(&folded, &joins), &joins), [5]);
}

/// A long leg in one piece begins on the inner side of its leg: the threads of its inseam do not lead through the leg.
#[test]
fn the_hem_of_a_long_leg_in_one_piece_lies_around_its_leg() {
    let leg = |s: f64| {
        let points = [[-106.0, 0.0], [106.0, 0.0], [260.0, 700.0], [205.0, 880.0], [-155.0, 960.0], [-260.0, 700.0]];
        let all = points.map(|[x, y]| [s * x, y]);
        if s > 0.0 { all.to_vec() } else { all.into_iter().rev().collect() }
    };
    let pieces = vec![piece(0, "LEG", &corners(&leg(1.0))), piece(1, "LEG-M", &corners(&leg(-1.0)))];
    let inner = |s: f64| [[s * 106.0, 0.0], [s * 260.0, 700.0]];
    let joins = vec![
        join("inner right", (0, inner(1.0)), (0, inner(-1.0))),
        join("inner left", (1, inner(1.0)), (1, inner(-1.0))),
        join("front crotch", (0, [[260.0, 700.0], [205.0, 880.0]]), (1, [[-260.0, 700.0], [-205.0, 880.0]])),
        join("back crotch", (0, [[-260.0, 700.0], [-155.0, 960.0]]), (1, [[260.0, 700.0], [155.0, 960.0]])),
    ];
    let arrangement = arranged(&pieces, &joins);
    let form = Form::of(None);
    for (i, leg) in [(0, &form.legs[1]), (1, &form.legs[0])] {
        let sheet = &arrangement.places[i].as_ref().expect("a place").sheet;
        let at = |x: f64, y: f64| sheet.at(v(x, y));
        // Both ends of the hem lie nearer to the middle than the axis of the leg, and its middle farther.
        assert!(at(106.0, 0.0).x.abs() < leg.to.x.abs() && at(-106.0, 0.0).x.abs() < leg.to.x.abs(), "{i}");
        assert!(at(0.0, 0.0).x.abs() > leg.to.x.abs() && at(0.0, 0.0).x * leg.to.x > 0.0, "{i}");
        // Lengths stay.
        let crotch = (at(260.0, 700.0) - at(259.0, 700.0)).norm();
        assert!((crotch - 1e-3).abs() < 1e-6, "{crotch}");
    }
}

/// The front of the shirt in two, cut from the neckline to the hem. Of its seams those on the right half go to the part.
fn shirt_in_two() -> (Vec<Piece>, Vec<Join>) {
    let (mut pieces, mut joins) = shirt(["FRONT", "BACK", "SLEEVE", "SLEEVE-2"]);
    let half = [[20.0, 0.0], [250.0, 0.0], [250.0, 360.0], [195.0, 545.0], [75.0, 590.0], [40.0, 510.0], [20.0, 510.0]];
    let other = [[-250.0, 0.0], [20.0, 0.0], [20.0, 510.0], [-40.0, 510.0], [-75.0, 590.0], [-195.0, 545.0]];
    let other = other.into_iter().chain([[-250.0, 360.0]]).collect::<Vec<_>>();
    // The part is drawn elsewhere, and turned by a quarter.
    let drawn = |[x, y]: [f64; 2]| [900.0 - y, x];
    pieces[0] = piece(0, "P", &corners(&other));
    pieces.push(piece(4, "Q", &corners(&half.map(drawn))));
    for point in joins.iter_mut().flat_map(|j| &mut j.pairs).flatten().filter(|p| p.piece == 0 && p.at.x > 0.0) {
        (point.piece, point.at) = (4, Vec2::new(0.9 - point.at.y, point.at.x));
    }
    let line = [[20.0, 0.0], [20.0, 510.0]];
    joins.push(join("style line", (0, line), (4, line.map(drawn))));
    (pieces, joins)
}

#[test]
fn parts_of_a_piece_start_where_it_would() {
    let (whole, whole_joins) = shirt(["FRONT", "BACK", "SLEEVE", "SLEEVE-2"]);
    let expected = arranged(&whole, &whole_joins);
    let (pieces, joins) = shirt_in_two();
    let front = Whole { name: "FRONT".to_owned(), parts: vec![0, 4] };
    let Arranged { arrangement: a, starts: laid, apart } =
        arrange_wholes(&pieces, &joins, &[front], None, Given::nothing(5));
    assert!(apart.is_empty());
    assert!(a.unplaced.is_empty(), "{:?}", a.unplaced);
    let at = |i: usize, p: Vec2| a.places[i].as_ref().expect("a place").sheet.at(laid[i].at(p));
    let front = |p: Vec2| expected.places[0].as_ref().expect("a place").sheet.at(p);
    for [x, y] in [[-250.0, 0.0], [-75.0, 590.0]] {
        assert!((at(0, v(x, y)) - front(v(x, y))).norm() < 2e-3, "{:?} {:?}", at(0, v(x, y)), front(v(x, y)));
    }
    // The second part leaves a gap of 10 mm.
    for [x, y] in [[250.0, 0.0], [75.0, 590.0]] {
        let (found, whole) = (at(4, v(900.0 - y, x)), front(v(x + 10.0, y)));
        assert!((found - whole).norm() < 2e-3, "{found:?} {whole:?}");
    }
    // Two sleeves are not sewn to each other, and start one by one.
    let sleeves = Whole { name: "SLEEVES".to_owned(), parts: vec![2, 3] };
    let found = arrange_wholes(&pieces, &joins, &[sleeves], None, Given::nothing(5));
    assert_eq!((found.apart, found.arrangement.places.len()), (vec!["SLEEVES".to_owned()], 5));
}
