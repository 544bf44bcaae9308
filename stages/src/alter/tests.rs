//! Changes of small pieces: areas, lengths and seams.

mod across;

use super::params::{AlterParams, Change};
use super::{Alter, shapes};
use crate::sewing::resolve::{find, placed};
use crate::testing::{dart, notch, one, piece, run, seam, two_points, v};
use toile_garment::dart::DartKind;
use toile_garment::sewing::{AttachSpec, AttachStrength};
use toile_garment::{Garment, Piece, Vec2};
use toile_stage_api::StageError;

/// Outlines lie on a grid of 0.0001 mm; ten of its steps, metres.
const GRID: f64 = 1e-6;

/// A piece 200 × 300 mm with a wedge dart of 40 mm in its lower edge, 120 mm deep.
fn front() -> Piece {
    let outline = [
        (0.0, 0.0, 't'),
        (80.0, 0.0, 't'),
        (100.0, 120.0, 't'),
        (120.0, 0.0, 't'),
        (200.0, 0.0, 't'),
        (200.0, 300.0, 't'),
        (0.0, 300.0, 't'),
    ];
    let wedge = dart("waist", DartKind::Wedge, &[(100.0, 120.0)], [(80.0, 0.0), (120.0, 0.0)]);
    Piece { darts: vec![wedge], ..piece(0, "front", &outline) }
}

/// The front, and a back that is sewn to its right side.
fn garment() -> Garment {
    let mut garment = one(front());
    garment.pieces.push(crate::testing::rectangle(1, "back", 200.0, 300.0));
    let side = seam(
        "side",
        vec![two_points("front", (200.0, 0.0), (200.0, 300.0))],
        vec![two_points("back", (0.0, 0.0), (0.0, 300.0))],
    );
    garment.plan.seams = vec![side];
    garment
}

fn changes(text: &str) -> Vec<Change> {
    toml::from_str::<AlterParams>(text).expect("changes").change
}

fn altered(garment: Garment, text: &str) -> Result<Garment, StageError> {
    run(&Alter, &AlterParams { change: changes(text) }, garment).map(|(garment, _)| garment)
}

fn lengths(garment: &Garment) -> Vec<[f64; 2]> {
    let shapes = shapes(garment).expect("shapes");
    placed(find(garment, &shapes)).expect("seams").iter().map(|s| [s.a.length, s.b.length]).collect()
}

fn farthest(a: &Piece, b: &Piece) -> f64 {
    let [a, b] = [a, b].map(|p| p.outline.positions());
    let off = |p: &Vec2, list: &[Vec2]| {
        let arc = crate::sewing::ring::arcs(list, true);
        crate::sewing::ring::nearest_on(list, &arc, true, *p).1
    };
    a.iter().map(|p| off(p, &b)).chain(b.iter().map(|p| off(p, &a))).fold(0.0, f64::max)
}

#[test]
fn a_dart_turned_to_the_side_keeps_area_and_angle_and_the_side_seam_its_length() {
    let text = "[[change]]\ndo = \"pivot\"\npiece = \"front\"\ndart = \"waist\"\nto = [200, 200]\n";
    let out = altered(garment(), text).expect("pivot");
    let (before, after) = (front(), &out.pieces[0]);
    assert!((before.outline.signed_area() - after.outline.signed_area()).abs() < 1e-12);
    let dart = &after.darts[0];
    let turned = 2.0 * libm::atan(20.0 / 120.0);
    let way = |k: usize| (dart.mouth[k] - dart.apexes[0]).normalize();
    assert!((libm::acos(way(0).dot(&way(1))) - turned).abs() < GRID);
    // Its mouth is a chord over the distance of the new place from the point.
    let reach = (v(200.0, 200.0) - v(100.0, 120.0)).norm();
    assert!((dart.intake() - 2.0 * reach * libm::sin(turned / 2.0)).abs() < GRID);
    // The lower edge is 160 mm of cloth in one, the side seam skips the dart.
    let [a, b] = lengths(&out)[0];
    assert!((a - 0.3).abs() < GRID && (b - 0.3).abs() < GRID, "{a} {b}");
}

#[test]
fn a_dart_turned_away_and_back_gives_the_piece_again() {
    let there = "[[change]]\ndo = \"pivot\"\npiece = \"front\"\ndart = \"waist\"\nto = [200, 200]\n";
    let away = altered(garment(), there).expect("there");
    let place = away.pieces[0].outline.points.iter().map(|p| p.at).min_by(|a, b| a.y.total_cmp(&b.y)).expect("points");
    assert!(place.y.abs() < 0.05);
    // The middle of the waist is where both halves of the mouth meet now.
    let back = "[[change]]\ndo = \"pivot\"\npiece = \"front\"\ndart = \"waist\"\nto = [80, 0]\n";
    let again = altered(away, back).expect("back");
    let off = farthest(&front(), &again.pieces[0]);
    assert!(off < GRID, "{off}");
    assert!((lengths(&again)[0][0] - 0.3).abs() < GRID);
}

#[test]
fn a_closed_dart_lengthens_the_edge_that_spreads() {
    let text = "[[change]]\ndo = \"close\"\npiece = \"front\"\ndart = \"waist\"\nto = [100, 300]\n";
    let out = altered(garment(), text).expect("close");
    assert!(out.pieces[0].darts.is_empty());
    let leg = (v(80.0, 0.0) - v(100.0, 120.0)).norm();
    let spread = 2.0 * 0.18 * 0.02 / leg;
    let area = front().outline.signed_area() + 0.5 * spread * 0.18 * 0.12 / leg;
    assert!((out.pieces[0].outline.signed_area() - area).abs() < GRID);
}

#[test]
fn a_part_of_a_dart_leaves_two_darts_of_the_same_angle_together() {
    let text = "[[change]]\ndo = \"pivot\"\npiece = \"front\"\ndart = \"waist\"\nto = [200, 200]\nshare = \"50 %\"\nback = \"10 mm\"\n";
    let out = altered(garment(), text).expect("pivot");
    let names: Vec<&str> = out.pieces[0].darts.iter().map(|d| d.name.as_str()).collect();
    assert_eq!(names, ["waist", "dart-1"]);
    let apart = (out.pieces[0].darts[0].apexes[0] - out.pieces[0].darts[1].apexes[0]).norm();
    assert!(apart > 0.008, "{apart}");
    assert!((lengths(&out)[0][0] - 0.3).abs() < GRID);
}

#[test]
fn a_cut_through_a_dart_takes_it_up_and_sews_the_parts() {
    let text = "[[change]]\ndo = \"cut\"\npiece = \"front\"\nalong = [\"waist\", [105, 200], [100, 300]]\n\
                into = { left = \"left\", right = \"right\" }\n";
    let out = altered(garment(), text).expect("cut");
    let names: Vec<&str> = out.pieces.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["left", "right", "back"]);
    assert!(out.pieces.iter().all(|p| p.darts.is_empty()));
    let area: f64 = out.pieces[..2].iter().map(|p| p.outline.signed_area()).sum();
    assert!((area - front().outline.signed_area()).abs() < 1e-12);
    let all = lengths(&out);
    // The side stays, and the new seam has the leg of the dart and the line on both sides.
    assert!((all[0][0] - 0.3).abs() < GRID);
    let leg = (v(80.0, 0.0) - v(100.0, 120.0)).norm();
    let line = (v(100.0, 120.0) - v(105.0, 200.0)).norm() + (v(105.0, 200.0) - v(100.0, 300.0)).norm();
    assert!(all[1].iter().all(|l| (l - leg - line).abs() < 1e-9), "{all:?}");
    let left = &out.pieces[0].outline;
    assert!(left.points.iter().all(|p| p.at.x < 0.1055));
}

#[test]
fn a_cut_of_an_edge_that_is_sewn_parts_its_side_of_the_seam() {
    let text = "[[change]]\ndo = \"cut\"\npiece = \"front\"\nalong = [[0, 200], { edge = 4, at = \"100 mm\" }]\n\
                into = { upper = \"upper\", lower = \"lower\" }\n";
    let out = altered(garment(), text).expect("cut");
    assert_eq!(out.plan.seams[0].a.len(), 2);
    let all = lengths(&out);
    assert!((all[0][0] - 0.3).abs() < GRID, "{all:?}");
}

#[test]
fn what_cannot_be_done_is_refused_in_words() {
    let refused = |text: &str| match altered(garment(), text) {
        Err(StageError::Parameter(list)) => {
            list.iter().map(|d| format!("{} {}", d.code, d.message)).collect::<String>()
        }
        other => panic!("{other:?}"),
    };
    let pivot = |dart: &str, to: &str| {
        refused(&format!("[[change]]\ndo = \"pivot\"\npiece = \"front\"\ndart = \"{dart}\"\nto = {to}\n"))
    };
    assert!(pivot("bust", "[200, 200]").starts_with("alter-dart change 1: piece `front` has no dart `bust`"));
    assert!(pivot("waist", "[150, 200]").starts_with("alter-place change 1: the place (150.0, 200.0)"));
    assert!(pivot("waist", "[20, 0, 0]").contains("has no shape in space yet"));
    let cut = "[[change]]\ndo = \"cut\"\npiece = \"front\"\nalong = [[10, 0], [190, 0]]\ninto = { upper = \"a\", lower = \"b\" }\n";
    assert!(refused(cut).starts_with("alter-line-leaves-piece"));
    // With the dart closed this line would run below its mouth.
    let below = "[[change]]\ndo = \"cut\"\npiece = \"front\"\nalong = [[0, 2], [200, 2]]\n\
                  into = { upper = \"a\", lower = \"b\" }\n";
    assert!(refused(below).contains("meets the point or the mouth of dart `waist`"));
    let in_dart = "[[change]]\ndo = \"cut\"\npiece = \"front\"\nalong = [[0, 60], [100, 60], [200, 60]]\n\
                  into = { upper = \"a\", lower = \"b\" }\n";
    assert!(refused(in_dart).contains("lies in dart `waist`"));
    assert!(pivot("waist", "{ edge = 1, at = \"middle\" }").contains("edge `1` is the leg of a dart"));
    let same = "[[change]]\ndo = \"cut\"\npiece = \"front\"\nalong = [[0, 200], [200, 200]]\ninto = { upper = \"back\", lower = \"b\" }\n";
    assert!(refused(same).contains("cannot be called `back`"));
}

#[test]
fn what_is_held_and_marked_stays_so() {
    let mut held = garment();
    let hold = |edge: &str| AttachSpec {
        piece: "front".into(),
        edge: edge.into(),
        to: "waist".into(),
        strength: AttachStrength::Hold,
        source: None,
    };
    // Both halves of the lower edge, and marks at the dart.
    held.plan.attachments = vec![hold("0"), hold("3")];
    held.pieces[0].notches = vec![notch(80.0, 0.0), notch(120.0, 0.0)];
    let close = "[[change]]\ndo = \"close\"\npiece = \"front\"\ndart = \"waist\"\nto = [100, 300]\n";
    let out = altered(held.clone(), close).expect("close");
    // The halves meet at a corner of 19 degrees, and both are held by names. The marks of the dart are gone.
    let piece = &out.pieces[0];
    let is_there = |a: &AttachSpec| piece.edges.iter().any(|e| e.name.as_ref() == Some(&a.edge));
    assert!(out.plan.attachments.len() == 2 && out.plan.attachments.iter().all(is_there));
    assert!(piece.notches.is_empty());
    let half = "[[change]]\ndo = \"pivot\"\npiece = \"front\"\ndart = \"waist\"\nto = [200, 200]\nshare = \"50 %\"\n";
    let out = altered(held, half).expect("pivot");
    // Both darts have notches at their mouths.
    let darts = &out.pieces[0].darts;
    let marked = |m: &Vec2| out.pieces[0].notches.iter().any(|n| (n.at - m).norm() < 1e-6);
    assert!(darts.len() == 2 && darts.iter().all(|d| d.mouth.iter().all(marked)), "{:?}", out.pieces[0].notches);
    assert_eq!(out.plan.attachments.len(), 2);
}

/// A slash and spread of the seam's edge makes one of its sides longer, and this is told.
#[test]
fn an_edge_that_spreads_in_a_seam_is_told_with_its_name() {
    let text = "[[change]]\ndo = \"close\"\npiece = \"front\"\ndart = \"waist\"\nto = [200, 200]\n";
    let params = AlterParams { change: changes(text) };
    let (_, report) = run(&Alter, &params, garment()).expect("closed");
    let told = |code: &str| report.findings.iter().find(|f| f.code == code).expect("told").message.clone();
    assert!(told("altered").contains("edge `front."), "{}", told("altered"));
    assert!(told("alter-seam-differs").contains("sides of seam `side` differ by"), "{}", told("alter-seam-differs"));
    let point = "[[change]]\ndo = \"point\"\npiece = \"front\"\ndart = \"waist\"\nto = [100, 90]\n";
    let (out, report) = run(&Alter, &AlterParams { change: changes(point) }, garment()).expect("moved");
    assert!(report.findings.iter().all(|f| f.code != "alter-seam-differs"));
    // The edges keep their numbers.
    let starts = |p: &Piece| p.edges.iter().map(|e| p.outline.points[e.from as usize].at).collect::<Vec<Vec2>>();
    let (before, after) = (starts(&front()), starts(&out.pieces[0]));
    let is_kept = |k: usize| (before[k] - after[k]).norm() < GRID || before[k] == v(100.0, 120.0);
    assert!(before.len() == after.len() && (0..before.len()).all(is_kept), "{before:?} {after:?}");
}
