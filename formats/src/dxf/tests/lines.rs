//! Outlines, curves, folds, sew lines.

use super::*;

#[test]
fn outline_in_runs_reversed_and_open() {
    let runs = |gap: f64| {
        file(move |w| {
            w.polyline("1", false, &[(0.0, 0.0), (300.0, 0.0)])
                .polyline("1", false, &[(0.0, 600.0), (300.0, 600.0), (300.0, 0.0)])
                .polyline("1", false, &[(0.0, 600.0), (0.0, gap)])
        })
    };
    assert!((geom::area(&good(&runs(0.0)).pieces[0].boundary.positions()) - 180_000.0).abs() < 1e-6);
    let closed = good(&runs(0.4));
    assert_eq!(codes(&closed.findings), ["outline-gap-closed"]);
    let e = bad(&runs(30.0));
    assert_eq!(codes(&e), ["outline-open"]);
    assert!(e[0].message.contains("open") && e[0].message.contains("30.00 mm"), "{}", e[0].message);
    assert_eq!(e[0].source.as_ref().and_then(|s| s.block.clone()).as_deref(), Some("FRONT_38"));
}

#[test]
fn crossing_outline_names_the_place() {
    let e = bad(&file(|w| w.polyline("1", true, &[(0.0, 0.0), (300.0, 600.0), (300.0, 0.0), (0.0, 600.0)])));
    assert_eq!(codes(&e), ["outline-crosses-itself"]);
    assert!(e[0].message.contains("intersects itself at (150.0, 300.0) mm"));
    let flat = bad(&file(|w| w.polyline("1", true, &[(0.0, 0.0), (300.0, 0.0), (100.0, 0.0)])));
    assert_eq!(codes(&flat), ["outline-without-area"]);
}

#[test]
fn doubled_vertices_and_spikes_pass() {
    let doubled: Vec<(f64, f64)> = WEDGE.iter().flat_map(|p| [*p, *p]).chain([WEDGE[0]]).collect();
    assert_wedge(&good(&file(|w| w.polyline("1", true, &doubled).points("2", &WEDGE))));
    let mut spike = RECTANGLE.to_vec();
    spike.splice(2..2, [(300.0, 300.0), (290.0, 300.0), (300.0, 300.0)]);
    let piece = &good(&file(|w| w.polyline("1", true, &spike))).pieces[0];
    assert!((geom::area(&piece.boundary.positions()) - 180_000.0).abs() < 1e-6);
    assert!(piece.darts.is_empty());
}

/// A damaged number makes a needle of 40 m of a side; a smooth curve through its points turns the outline inside out.
#[test]
fn a_curve_that_would_turn_the_outline_over_is_not_taken() {
    let corners = [(0.0, 0.0), (480.0, 0.0), (470.0, 620.0), (18.0, 620.0)];
    let low = [(4.3, 500.0), (2.4, 470.0), (1.1, 440.0)];
    let ends = [(0.3, 41_560.0), (6.8, 530.0)];
    let side: Vec<(f64, f64)> = [(13.2, 590.0), (9.7, 86.0)]
        .into_iter()
        .chain(low)
        .chain(ends)
        .chain(low)
        .chain([(0.3, 410.0), (0.0, 380.0)])
        .collect();
    let outline: Vec<(f64, f64)> = corners.into_iter().chain(side.iter().copied()).collect();
    let pattern = good(&file(|w| w.polyline("1", true, &outline).points("2", &corners).points("3", &side)));
    let work = geom::area(&pattern.pieces[0].boundary.work_positions());
    assert!(work > 0.0, "{work}");
    assert!(codes(&pattern.findings).contains(&"curve-not-smoothed"), "{:?}", codes(&pattern.findings));
}

#[test]
fn curves_of_later_releases() {
    // A square of 200 mm with a half circle on its right side, as LWPOLYLINE with a bulge.
    let light = Writer::default().pair(0, "LWPOLYLINE").pair(8, "1").pair(90, "4").pair(70, "1");
    let light = light.xy(0.0, 0.0).xy(200.0, 0.0).pair(42, "1").xy(200.0, 200.0).xy(0.0, 200.0).0;
    let pattern = good(&file(|w| Writer(w.0 + &light)));
    let area = geom::area(&pattern.pieces[0].boundary.positions());
    let exact = 40_000.0 + std::f64::consts::PI * 5000.0;
    assert!((area - exact).abs() / exact < 5e-4);
    assert_eq!((pattern.census.sent, pattern.census.agreed), (1, 1));
    assert_eq!(pattern.pieces[0].points.turn_points, 4);
    // The same from lines and an arc.
    let arc =
        Writer::default().pair(0, "ARC").pair(8, "1").xy(200.0, 100.0).pair(40, "100").pair(50, "-90").pair(51, "90").0;
    let parts = good(&file(|w| {
        let w = w.line("1", (200.0, 0.0), (0.0, 0.0)).line("1", (0.0, 200.0), (0.0, 0.0)).line(
            "1",
            (0.0, 200.0),
            (200.0, 200.0),
        );
        Writer(w.0 + &arc)
    }));
    assert!((geom::area(&parts.pieces[0].boundary.positions()) - area).abs() < 20.0);
    let short = light.replace(" 90\n4", " 90\n5");
    assert_eq!(codes(&bad(&file(|w| Writer(w.0 + &short))))[0], "vertex-count-differs");
}

#[test]
fn closed_spline_is_a_circle() {
    // Periodic cubic with 8 control points on a circle, opened to 11.
    let control: Vec<(f64, f64)> = (0..11)
        .map(|i| f64::from(i) * std::f64::consts::FRAC_PI_4)
        .map(|a| (300.0 + 100.0 * libm::cos(a), 100.0 * libm::sin(a)))
        .collect();
    let mut w = Writer::default()
        .pair(0, "SPLINE")
        .pair(8, "1")
        .pair(70, "11")
        .pair(71, "3")
        .pair(72, "15")
        .pair(73, "11")
        .pair(74, "0");
    for k in 0..15 {
        w = w.pair(40, &k.to_string());
    }
    w = control.iter().fold(w, |w, (x, y)| w.xy(*x, *y));
    let pattern = good(&file(|f| Writer(f.0 + &w.0)));
    let line = pattern.pieces[0].boundary.positions();
    let radii: Vec<f64> = line.iter().map(|p| (p - toile_garment::Vec2::new(300.0, 0.0)).norm()).collect();
    let (lo, hi) = radii.iter().fold((f64::MAX, 0.0_f64), |(l, h), r| (l.min(*r), h.max(*r)));
    assert!(hi - lo < 0.5, "{lo} to {hi}");
    assert_eq!(pattern.census.agreed, 1);
}

#[test]
fn half_piece_is_unfolded_with_all_that_is_on_it() {
    let half: Vec<(f64, f64)> =
        vec![(0.0, 0.0), (150.0, 0.0), (150.0, 600.0), (90.0, 600.0), (75.0, 500.0), (60.0, 600.0), (0.0, 600.0)];
    let text = file(|w| {
        let w = w.polyline("1", true, &half).points("2", &half).line("6", (0.0, 600.0), (0.0, 0.0));
        let w = w.pair(0, "POINT").pair(8, "4").xy(150.0, 200.0).pair(30, "5").pair(39, "0").pair(50, "180");
        let w = w.point("13", 75.0, 490.0).polyline("8", false, &[(20.0, 100.0), (80.0, 100.0)]);
        w.polyline("8", false, &[(20.0, 200.0), (80.0, 200.0)]).text_at("8", "NM", 20.0, 200.0)
    });
    let pattern = good(&text);
    assert!(pattern.pieces[0].axes.fold.is_some());
    let g = garment(&pattern);
    let piece = &g.pieces[0];
    assert!((piece.outline.signed_area() - 2.0 * 0.0885).abs() < 1e-9);
    assert_eq!(
        (piece.darts.len(), piece.notches.len(), piece.drill_holes.len(), piece.internal_lines.len()),
        (2, 2, 2, 3)
    );
    let outline = piece.outline.positions();
    for dart in &piece.darts {
        assert!(dart.legs.iter().flatten().all(|p| outline.contains(p)), "legs are outline vertices");
        let (a, b) =
            (outline.iter().position(|p| *p == dart.legs[0][0]), outline.iter().position(|p| *p == dart.apexes[0]));
        let n = outline.len();
        assert_eq!((a.expect("mouth") + 1) % n, b.expect("apex"), "leg 0 comes first counter-clockwise");
    }
    // The mirrored notch points inwards: along +x on the left edge.
    let left = piece.notches.iter().find(|n| n.at.x < 0.0).expect("left notch");
    assert!((libm::cos(left.angle.expect("angle")) - 1.0).abs() < 1e-9);
    // The hem runs on over the fold: no corner there.
    let at_fold = piece.outline.points.iter().find(|p| p.at.norm() < 1e-9).expect("fold vertex");
    assert_ne!(at_fold.kind, toile_garment::outline::PointKind::Turn);
}

#[test]
fn sew_line_on_14_and_on_8() {
    let cut: [(f64, f64); 7] = [
        (-10.0, -10.0),
        (310.0, -10.0),
        (310.0, 610.0),
        (160.6, 610.0),
        (150.0, 550.0),
        (139.4, 610.0),
        (-10.0, 610.0),
    ];
    for layer in ["14", "8"] {
        let pattern = good(&file(|w| w.polyline("1", true, &cut).polyline(layer, true, &WEDGE)));
        let piece = &pattern.pieces[0];
        assert_eq!((piece.sew_lines, piece.inside.internal.len(), piece.darts.len()), (1, 0, 1), "layer {layer}");
        assert_eq!(piece.darts[0].on, "sew");
        let g = garment(&pattern);
        assert!((g.pieces[0].outline.signed_area() - 0.1785).abs() < 1e-9);
        assert!(g.pieces[0].cut_line.as_ref().is_some_and(|c| c.signed_area() > 0.19));
    }
}

#[test]
fn lines_drawn_twice_are_read_once() {
    let run = |i: usize| [RECTANGLE[i], RECTANGLE[(i + 1) % 4]];
    let split = good(&file(|w| (0..4).fold(w, |w, i| w.polyline("1", false, &run(i)).polyline("1", false, &run(i)))));
    let whole = good(&file(|w| w.polyline("1", true, &RECTANGLE).polyline("1", true, &RECTANGLE)));
    for pattern in [split, whole] {
        assert!((geom::area(&pattern.pieces[0].boundary.positions()) - 180_000.0).abs() < 1e-6);
        assert_eq!(codes(&pattern.findings), ["outline-doubled"]);
        assert_eq!(pattern.ledger.count(ledger::Verdict::Refused), 0);
    }
    // Out and back on the same way is a slit of 10 mm.
    let slit = good(&file(|w| {
        let w = w.polyline("1", false, &run(0)).polyline("1", false, &[(300.0, 0.0), (300.0, 300.0)]);
        let w = w.polyline("1", false, &[(300.0, 300.0), (290.0, 300.0)]);
        let w = w.polyline("1", false, &[(290.0, 300.0), (300.0, 300.0)]);
        w.polyline("1", false, &[(300.0, 300.0), (300.0, 600.0)]).polyline("1", false, &run(2)).polyline(
            "1",
            false,
            &run(3),
        )
    }));
    assert_eq!(codes(&slit.findings), ["notch-cut-in"]);
    let notch = &slit.pieces[0].notches[0];
    assert_eq!((notch.kind, notch.at), (NotchKind::Slit, toile_garment::Vec2::new(300.0, 300.0)));
    assert_eq!(garment(&slit).pieces[0].outline.points.len(), 5, "the slit is no corner of the cloth");
}

#[test]
fn half_pieces_open_at_the_fold() {
    let half = [(0.0, 600.0), (0.0, 0.0), (150.0, 0.0), (150.0, 600.0)];
    let open = [half[1], half[2], half[3], half[0]];
    let sew = [(0.0, 10.0), (140.0, 10.0), (140.0, 590.0), (0.0, 590.0)];
    for layer in ["14", "8"] {
        let pattern =
            good(&file(|w| w.polyline("1", false, &open).line("6", half[0], half[1]).polyline(layer, false, &sew)));
        let said: &[&str] = if layer == "8" { &["layer-foreign"] } else { &[] };
        assert_eq!(codes(&pattern.findings), said, "layer {layer}");
        let g = garment(&pattern);
        let piece = &g.pieces[0];
        assert!((piece.outline.signed_area() - 0.28 * 0.58).abs() < 1e-9, "{}", piece.outline.signed_area());
        assert!((piece.cut_line.as_ref().expect("cut line").signed_area() - 0.18).abs() < 1e-9);
    }
}

#[test]
fn grain_and_fold_may_be_polylines() {
    let text = file(|w| w.polyline("1", true, &RECTANGLE).polyline("5", false, &[(10.0, 10.0), (10.0, 90.0)]));
    let at = text.find("LINE\n  8\n7\n").expect("grain");
    let end = text[at..].find("  0\n").expect("end") + at;
    let grain = Writer::default().polyline("7", false, &[(60.0, 150.0), (60.0, 300.0), (60.0, 450.0)]).0;
    let text = format!("{}{}{}", &text[..at - 4], grain, &text[end..]);
    let pattern = good(&text);
    assert_eq!(codes(&pattern.findings), [] as [&str; 0]);
    assert_eq!(pattern.pieces[0].axes.grain.map(|g| (g[1] - g[0]).y), Some(300.0));
    assert!(pattern.pieces[0].axes.reference.is_some());
}

#[test]
fn a_closed_line_without_vertices_is_nothing() {
    let empty = good(&file(|w| w.polyline("1", true, &WEDGE).polyline("1", true, &[]).polyline("14", true, &[])));
    assert_wedge(&empty);
    assert_eq!(codes(&bad(&file(|w| w.polyline("1", true, &[])))), ["outline-missing"]);
    assert_eq!(codes(&bad(&file(|w| w.polyline("1", true, &[(5.0, 5.0)])))), ["outline-missing"]);
}

#[test]
fn a_dense_copy_without_an_original_is_said() {
    let hole = [(100.0, 100.0), (140.0, 100.0), (140.0, 140.0), (100.0, 140.0)];
    let sew = [(10.0, 10.0), (290.0, 10.0), (290.0, 590.0), (10.0, 590.0)];
    for (layer, original, line) in [("86", "11", &hole), ("85", "8", &hole), ("87", "14", &sew)] {
        let alone = good(&file(|w| w.polyline("1", true, &RECTANGLE).polyline(layer, true, line)));
        assert_eq!(codes(&alone.findings), ["copy-without-original"], "{layer}");
        let text =
            file(|w| w.polyline("1", true, &RECTANGLE).polyline(layer, true, line).polyline(original, true, line));
        assert_eq!(codes(&good(&text).findings), [""; 0], "{layer}");
        // The remedy works: the layer is mapped.
        let layers = [(layer.to_owned(), original.to_owned())].into();
        let text = file(|w| w.polyline("1", true, &RECTANGLE).polyline(layer, true, line));
        let mapped = read(text.as_bytes(), "t.dxf", &ReadOptions { layers, ..ReadOptions::default() }).expect("read");
        assert!(!codes(&mapped.findings).contains(&"copy-without-original"), "{layer}");
    }
}
