//! Lines drawn across darts.

use super::{GRID, altered, changes, front, garment, lengths};
use crate::alter::{Alter, AlterParams};
use crate::testing::{dart, one, piece, run, seam, two_points, v};
use toile_garment::dart::DartKind;
use toile_garment::{Garment, Piece};

fn cut(along: &str, more: &str) -> String {
    format!(
        "[[change]]\ndo = \"cut\"\npiece = \"front\"\nalong = {along}\ninto = {{ upper = \"body\", lower = \"band\" }}\n{more}"
    )
}

fn area(pieces: &[Piece]) -> f64 {
    pieces.iter().map(|p| p.outline.signed_area()).sum()
}

/// Meshes and sews on paper: the lengths of both sides of every seam and dart.
fn sewn(garment: Garment) -> Vec<[f64; 2]> {
    let (garment, _) = run(&crate::triangulate::Triangulate, &Default::default(), garment).expect("mesh");
    let rest: Vec<Vec<toile_garment::Vec2>> =
        garment.pieces.iter().map(|p| p.mesh.as_ref().expect("mesh").rest.clone()).collect();
    let (garment, _) = run(&crate::assemble::Assemble, &Default::default(), garment).expect("assembly");
    let length = |side: &toile_garment::seam::SeamSide| -> f64 {
        let runs = side.runs.iter().flat_map(|r| r.vertices.windows(2).map(|w| (r.piece.index(), w[0], w[1])));
        runs.map(|(p, a, b)| (rest[p][a as usize] - rest[p][b as usize]).norm()).sum()
    };
    garment.seams.iter().map(|s| [length(&s.a), length(&s.b)]).collect()
}

#[test]
fn a_line_across_a_dart_closes_it_at_its_mouth_and_leaves_its_point() {
    let mut garment = garment();
    let hem = seam(
        "hem",
        vec![two_points("front", (0.0, 0.0), (200.0, 0.0))],
        vec![two_points("back", (0.0, 300.0), (160.0, 300.0))],
    );
    garment.plan.seams.push(hem);
    let out = altered(garment, &cut("[[0, 60], [200, 60]]", "")).expect("cut");
    let names: Vec<&str> = out.pieces.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["body", "band", "back"]);
    assert!((area(&out.pieces[..2]) - front().outline.signed_area()).abs() < 1e-12);
    // The band is cloth in one, the dart of the body begins at the seam.
    assert!(out.pieces[1].darts.is_empty() && out.pieces[1].notches.len() == 1);
    let dart = &out.pieces[0].darts[0];
    assert!((dart.leg_length(0) - dart.leg_length(1)).abs() < GRID && dart.leg_length(0) < 0.08);
    assert!((dart.apexes[0] - v(100.0, 120.0)).norm() < GRID);
    let all = lengths(&out);
    assert!(all.iter().all(|[a, b]| (a - b).abs() < GRID), "{all:?}");
    assert!((all[0][0] - 0.3).abs() < GRID && (all[1][0] - 0.16).abs() < GRID, "{all:?}");
    // On the closed dart the line is straight.
    let turned = 2.0 * libm::atan(20.0 / 120.0);
    let ends = [v(0.0, 60.0), v(200.0, 60.0)].map(|p| p - v(100.0, 120.0));
    let straight = (toile_formats::dxf::geom::rotate(ends[1], -turned) - ends[0]).norm();
    assert!((all[2][0] - straight).abs() < GRID, "{all:?} {straight}");
    let all = sewn(out);
    assert!(all.iter().all(|[a, b]| (a - b).abs() < GRID), "{all:?}");
}

#[test]
fn places_on_both_legs_tell_where_a_line_crosses_a_dart() {
    let along = "[[0, 60], [90, 60], [110, 60], [200, 60]]";
    for smooth in ["", "smooth = true\n"] {
        let out = altered(garment(), &cut(along, smooth)).expect("cut");
        let mouth = out.pieces[0].darts[0].mouth;
        assert!((mouth[0] - v(90.0, 60.0)).norm() < 2e-4 && (mouth[1] - v(110.0, 60.0)).norm() < 2e-4, "{mouth:?}");
        let all = lengths(&out);
        assert!((all[1][0] - all[1][1]).abs() < GRID, "{all:?}");
    }
}

/// A dress block with a fish-eye dart and a marked dart that comes from above.
fn block() -> Garment {
    let outline = [(0.0, 0.0, 't'), (300.0, 0.0, 't'), (300.0, 400.0, 't'), (0.0, 400.0, 't')];
    let eye = dart("waist", DartKind::FishEye, &[(80.0, 100.0), (80.0, 300.0)], [(70.0, 200.0), (90.0, 200.0)]);
    let marked = dart("bust", DartKind::MarkedWedge, &[(200.0, 150.0)], [(185.0, 400.0), (215.0, 400.0)]);
    one(Piece { darts: vec![eye, marked], ..piece(0, "front", &outline) })
}

#[test]
fn a_line_across_a_fish_eye_leaves_a_dart_on_both_sides() {
    for along in ["[[0, 210], [300, 210]]", "[[300, 190], [150, 200], [0, 210]]"] {
        let out = altered(block(), &cut(along, "")).expect("cut");
        let [body, band] = [&out.pieces[0], &out.pieces[1]];
        let names = |p: &Piece| p.darts.iter().map(|d| d.name.clone()).collect::<std::collections::BTreeSet<_>>();
        let by_name = |name: &str| out.pieces.iter().find(|p| p.name == name).expect("part");
        assert_eq!(names(by_name("body")), ["waist".to_owned()].into());
        assert_eq!(names(by_name("band")), ["bust".to_owned(), "waist".to_owned()].into());
        // The marked dart is not cloth, and neither is the fish-eye.
        let cloth = 0.3 * 0.4 - 0.5 * 0.02 * 0.2 - 0.5 * 0.03 * 0.25;
        assert!((area(&[body.clone(), band.clone()]) - cloth).abs() < GRID);
        let all = lengths(&out);
        assert!((all[0][0] - all[0][1]).abs() < GRID, "{all:?}");
        let all = sewn(out);
        assert_eq!(all.len(), 4);
        assert!(all.iter().all(|[a, b]| (a - b).abs() < GRID), "{all:?}");
    }
}

#[test]
fn legs_that_do_not_fit_are_sewn_where_the_line_cuts_them_off() {
    // One leg bends outwards by 7 mm, below the line.
    let outline = [
        (0.0, 0.0, 't'),
        (80.0, 0.0, 't'),
        (80.0, 40.0, 'c'),
        (100.0, 120.0, 't'),
        (120.0, 0.0, 't'),
        (200.0, 0.0, 't'),
        (200.0, 300.0, 't'),
        (0.0, 300.0, 't'),
    ];
    let wedge = dart("waist", DartKind::Wedge, &[(100.0, 120.0)], [(80.0, 0.0), (120.0, 0.0)]);
    let whole = Piece { darts: vec![wedge], ..piece(0, "front", &outline) };
    let cloth = whole.outline.signed_area();
    let out = altered(one(whole), &cut("[[0, 70], [200, 70]]", "")).expect("cut");
    let names: Vec<&str> = out.pieces.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["body", "band", "band-2"]);
    assert!((area(&out.pieces) - cloth).abs() < GRID);
    let seams: Vec<&str> = out.plan.seams.iter().map(|s| s.name.as_str()).collect();
    assert_eq!(seams, ["body band", "front waist"]);
    assert_eq!(out.plan.seams[0].b.len(), 2);
    let all = lengths(&out);
    assert!((all[0][0] - all[0][1]).abs() < GRID, "{all:?}");
}

#[test]
fn a_line_from_the_point_of_a_dart_may_cross_another_dart() {
    let text = "[[change]]\ndo = \"pivot\"\npiece = \"front\"\ndart = \"waist\"\nto = [200, 200]\nshare = \"50 %\"\n";
    let away = altered(garment(), text).expect("pivot");
    let whole = away.pieces[0].outline.signed_area();
    // From the point of the new dart the line passes over the old one, or crosses it near its point.
    for end in ["[0, 60]", "[40, 0]"] {
        let change = AlterParams { change: changes(&cut(&format!("[\"dart-1\", {end}]"), "")) };
        let (out, report) = run(&Alter, &change, away.clone()).expect("cut");
        println!("{:?}", report.findings);
        assert!((area(&out.pieces[..2]) - whole).abs() < GRID);
        assert_eq!(out.pieces.iter().map(|p| p.darts.len()).sum::<usize>(), 1);
        let all = lengths(&out);
        assert!(all.iter().all(|[a, b]| (a - b).abs() < GRID), "{all:?}");
    }
}
