//! Notches, drill holes, stripes, names.

use super::*;
use toile_garment::Vec2;

#[test]
fn notches_cut_into_the_outline_are_notches() {
    let mut line = RECTANGLE.to_vec();
    line.splice(2..2, [(300.0, 297.0), (294.0, 300.0), (300.0, 303.0)]);
    let pattern = good(&file(|w| w.polyline("1", true, &line).points("2", &line)));
    let piece = &pattern.pieces[0];
    assert_eq!(codes(&pattern.findings), ["notch-cut-in"]);
    let notch = &piece.notches[0];
    assert_eq!((notch.kind, notch.at, notch.cut), (NotchKind::V, Vec2::new(300.0, 300.0), true));
    assert!((notch.depth - 6.0).abs() < 1e-9 && (notch.width - 6.0).abs() < 1e-9);
    assert!((notch.angle.expect("inwards") - std::f64::consts::PI).abs() < 1e-9);
    // The drawn area keeps the notch, the sewn piece does not.
    assert!((geom::area(&piece.boundary.positions()) - 179_982.0).abs() < 1e-6);
    let g = garment(&pattern);
    assert!((g.pieces[0].outline.signed_area() - 0.18).abs() < 1e-12);
    assert_eq!(g.pieces[0].edges.len(), 4);
}

#[test]
fn a_notch_on_both_lines_is_one_pair() {
    let cut = [(-10.0, -10.0), (310.0, -10.0), (310.0, 610.0), (-10.0, 610.0)];
    let pattern = good(&file(|w| {
        let w = w.polyline("1", true, &cut).polyline("14", true, &RECTANGLE);
        w.point("4", 310.0, 250.0).pair(30, "4").point("4", 300.0, 250.0).pair(30, "4").point("4", 300.0, 450.0)
    }));
    let notches = &pattern.pieces[0].notches;
    let on: Vec<_> = notches.iter().map(|n| (n.on, n.twin)).collect();
    assert_eq!(on, [("boundary", None), ("sew", Some(0)), ("sew", None)]);
    // Without a code 50 the direction is the inward normal.
    assert!(notches.iter().all(|n| (n.angle.expect("angle") - std::f64::consts::PI).abs() < 1e-9));
}

#[test]
fn drill_holes_have_diameters_and_stripes_are_kept() {
    let pattern = good(&file(|w| {
        let w = w.polyline("1", true, &RECTANGLE).point("13", 150.0, 300.0).pair(30, "6").point("13", 100.0, 300.0);
        let w = w.pair(0, "CIRCLE").pair(8, "13").xy(50.0, 300.0).pair(40, "2");
        w.line("9", (0.0, 200.0), (300.0, 200.0)).line("10", (150.0, 0.0), (150.0, 600.0)).point("9", 10.0, 200.0)
    }));
    assert_eq!(codes(&pattern.findings), [] as [&str; 0]);
    let g = garment(&pattern);
    let piece = &g.pieces[0];
    let diameters: Vec<_> = piece.drill_holes.iter().map(|d| d.diameter.map(|d| (d * 1e6).round() / 1e3)).collect();
    assert_eq!(diameters, [Some(6.0), None, Some(4.0)]);
    let names: Vec<_> = piece.match_lines.iter().map(|l| (l.name.as_deref(), l.points.len())).collect();
    assert_eq!(names, [(Some("stripe"), 2), (Some("plaid"), 2), (Some("stripe"), 1)]);
    assert_eq!(pattern.ledger.count(ledger::Verdict::Refused), 0);
}

#[test]
fn names_and_sizes_from_block_names() {
    let block = |name: &str| Writer::default().block(name).polyline("1", true, &RECTANGLE).pair(0, "ENDBLK").0;
    let text = |names: &[&str]| {
        let blocks: String = names.iter().map(|n| block(n)).collect();
        let w = Writer::default().pair(0, "SECTION").pair(2, "BLOCKS");
        Writer(w.0 + &blocks).pair(0, "ENDSEC").pair(0, "EOF").0
    };
    let nest = good(&text(&["FRONT_36", "FRONT_38", "BACK_36", "BACK_38"]));
    assert_eq!(nest.sizes, ["36", "38"]);
    assert_eq!(nest.to_garment(Some("36"), None).expect("36").0.pieces.len(), 2);
    assert!(codes(&nest.findings).contains(&"name-from-block"));
    let numbered = good(&text(&["SLEEVE_1", "SLEEVE_2"]));
    assert_eq!((numbered.sizes.len(), garment(&numbered).pieces.len()), (0, 2));
}

#[test]
fn unknown_keys_stay_as_they_are() {
    let pattern = good(&file(|w| {
        w.polyline("1", true, &RECTANGLE)
            .text("1", "Stretch  Direction: Both: ways")
            .text("1", "Rotation: 180")
            .text("8", "B")
    }));
    let texts: Vec<_> = garment(&pattern).pieces[0].texts.iter().map(|t| (t.layer.clone(), t.text.clone())).collect();
    let expected = [("1", "Stretch  Direction: Both: ways"), ("1", "Rotation: 180"), ("8", "B")];
    assert_eq!(texts, expected.map(|(l, t)| (l.to_owned(), t.to_owned())));
}
