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

/// Four curve points on a quarter of a circle of 150 mm: the chords leave it by 2.9 mm.
fn sparse_curve() -> Vec<(f64, f64)> {
    let on_arc = |k: i32| {
        let angle = (-90.0 - 22.5 * f64::from(k)).to_radians();
        (300.0 + 150.0 * libm::cos(angle), 400.0 + 150.0 * libm::sin(angle))
    };
    [(0.0, 0.0), (300.0, 0.0)].into_iter().chain((0..=4).map(on_arc)).chain([(0.0, 400.0)]).collect()
}

#[test]
fn a_notch_on_a_sparse_curve_is_judged_by_the_curve() {
    let outline = sparse_curve();
    let angle = (-90.0_f64 - 11.25).to_radians();
    let along = |radius: f64| (300.0 + radius * libm::cos(angle), 400.0 + radius * libm::sin(angle));
    let (on, inner) = (along(150.0), along(154.0));
    let piece = |body: &dyn Fn(Writer) -> Writer| {
        let corners: Vec<(f64, f64)> = [0, 1, 2, 6, 7].map(|i| outline[i]).to_vec();
        let text = file(|w| body(w.polyline("1", true, &outline).points("2", &corners).points("3", &outline[3..6])));
        good(&text)
    };
    for (pattern, depth) in [
        (piece(&|w| w.point("4", on.0, on.1).pair(30, "4")), 4.0),
        // A stroke from the curve inwards: its base is on the curve, although its other end is near the chord.
        (piece(&|w| w.line("4", inner, on)), 4.0),
    ] {
        assert_eq!(codes(&pattern.findings), ["curve-interpolated"]);
        let notch = &pattern.pieces[0].notches[0];
        assert!(notch.on == "boundary" && notch.off < 0.2, "{notch:?}");
        assert!((notch.at - Vec2::new(on.0, on.1)).norm() < 1e-9 && (notch.depth - depth).abs() < 0.2, "{notch:?}");
        let inwards = notch.angle.expect("angle");
        assert!(libm::cos(inwards - angle) > 0.99, "{inwards} {angle}");
    }
}

#[test]
fn a_mark_beside_the_fold_is_one_mark_on_it() {
    let half = [(0.0, 0.0), (150.0, 0.0), (150.0, 400.0), (0.0, 400.0)];
    let text = file(|w| {
        let w = w.polyline("1", true, &half).line("6", (0.0, 0.0), (0.0, 400.0));
        let w = w.point("4", 0.4, 300.0).point("4", 0.4, 0.0).point("13", 0.3, 200.0).point("13", 40.0, 200.0);
        w.polyline("8", false, &[(0.4, 100.0), (0.4, 150.0)])
    });
    let piece = &garment(&good(&text)).pieces[0];
    let on_fold = piece.notches.iter().map(|n| n.at.x).chain(piece.drill_holes.iter().map(|d| d.at.x));
    assert_eq!(on_fold.filter(|x| *x == 0.0).count(), 3);
    assert_eq!((piece.notches.len(), piece.drill_holes.len(), piece.internal_lines.len()), (2, 3, 1));
}
