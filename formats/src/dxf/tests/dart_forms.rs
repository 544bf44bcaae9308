//! Every form of dart that is drawn, and what looks like one: small files with facts worked out by hand.
//!
//! All stand on a piece of 300 × 600 mm, drawn counter-clockwise, with its grain along y.

use super::*;

/// A dart that must be found: kind, apex, mouth (any order) and leg lengths (any order).
pub(super) type Fact = (&'static str, (f64, f64), [(f64, f64); 2], [f64; 2]);

pub(super) fn check(name: &str, text: &str, facts: &[Fact]) -> serde_json::Value {
    let json = inspect(text.as_bytes(), "t.dxf", None).unwrap_or_else(|e| panic!("{name}: {e:?}")).json;
    let piece = json["pieces"][0].clone();
    let darts = piece["darts"].as_array().expect("darts").clone();
    assert_eq!(darts.len(), facts.len(), "{name}: {darts:#?}");
    for (dart, (kind, apex, mouth, legs)) in darts.iter().zip(facts) {
        let point = |v: &serde_json::Value| (v[0].as_f64().expect("x"), v[1].as_f64().expect("y"));
        let near = |a: (f64, f64), b: (f64, f64)| libm::hypot(a.0 - b.0, a.1 - b.1) <= 0.1;
        assert_eq!(dart["kind"], *kind, "{name}");
        let apexes = dart["apexes_mm"].as_array().cloned().unwrap_or_else(|| vec![dart["apex_mm"].clone()]);
        assert!(apexes.iter().any(|a| near(point(a), *apex)), "{name}: {apexes:?}");
        let drawn = [point(&dart["mouth_mm"][0]), point(&dart["mouth_mm"][1])];
        let same = |a: usize, b: usize| near(drawn[0], mouth[a]) && near(drawn[1], mouth[b]);
        assert!(same(0, 1) || same(1, 0), "{name}: {drawn:?}");
        let mut lengths = [0, 1].map(|i| dart["leg_path_mm"][i].as_f64().expect("leg"));
        let mut wanted = *legs;
        lengths.sort_by(f64::total_cmp);
        wanted.sort_by(f64::total_cmp);
        assert!((lengths[0] - wanted[0]).abs() <= 0.2 && (lengths[1] - wanted[1]).abs() <= 0.2, "{name}: {lengths:?}");
        assert!(dart["confidence"].as_f64().is_some_and(|c| (0.05..=0.99).contains(&c)), "{name}");
        assert!(dart["evidence"].as_array().is_some_and(|e| !e.is_empty()), "{name}");
    }
    piece
}

/// The rectangle with points put into its top edge, right to left.
pub(super) fn top(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut line = RECTANGLE[..3].to_vec();
    line.extend(points);
    line.push(RECTANGLE[3]);
    line
}

pub(super) fn piece(line: &[(f64, f64)], body: impl Fn(Writer) -> Writer) -> String {
    file(|w| body(w.polyline("1", true, line).points("2", line)))
}

pub(super) fn notched(w: Writer, points: &[(f64, f64)]) -> Writer {
    points.iter().fold(w, |w, (x, y)| w.point("4", *x, *y).pair(30, "5").pair(39, "0"))
}

pub(super) const MOUTH: [(f64, f64); 2] = [(165.0, 600.0), (135.0, 600.0)];
pub(super) const APEX: (f64, f64) = (150.0, 500.0);
/// √(15² + 100²).
pub(super) const LEG: f64 = 101.1187;

#[test]
fn wedges_in_the_outline() {
    let plain = top(&[MOUTH[0], APEX, MOUTH[1]]);
    let sure = |piece: &serde_json::Value| piece["darts"][0]["confidence"].as_f64().expect("confidence");
    let bare = check("straight legs", &piece(&plain, |w| w), &[("boundary_wedge", APEX, MOUTH, [LEG, LEG])]);
    let full = check(
        "with notches and drill",
        &piece(&plain, |w| notched(w, &MOUTH).point("13", 150.0, 512.0)),
        &[("boundary_wedge", APEX, MOUTH, [LEG, LEG])],
    );
    assert!(sure(&full) > sure(&bare), "more evidence, more confidence");
    // Legs of 101.1 and √(45² + 100²) = 109.7 mm: leaning.
    let leaning = top(&[(165.0, 600.0), (150.0, 500.0), (105.0, 600.0)]);
    let facts = [("boundary_wedge", APEX, [(165.0, 600.0), (105.0, 600.0)], [LEG, 109.6586])];
    check("unequal legs", &piece(&leaning, |w| w), &facts);
    // Doubled vertices.
    let doubled: Vec<(f64, f64)> = plain.iter().flat_map(|p| [*p, *p]).collect();
    check("doubled vertices", &piece(&doubled, |w| w), &[("boundary_wedge", APEX, MOUTH, [LEG, LEG])]);
    // Clockwise.
    let clockwise: Vec<(f64, f64)> = plain.iter().rev().copied().collect();
    check("clockwise", &piece(&clockwise, |w| w), &[("boundary_wedge", APEX, MOUTH, [LEG, LEG])]);
    // No layers 2 and 3.
    let unmarked = file(|w| w.polyline("1", true, &plain));
    check("unmarked corners", &unmarked, &[("boundary_wedge", APEX, MOUTH, [LEG, LEG])]);
    // A shallow one of 4.3 degrees: legs of √(4.5² + 120²).
    let slim = top(&[(154.5, 600.0), (150.0, 480.0), (145.5, 600.0)]);
    let facts = [("boundary_wedge", (150.0, 480.0), [(154.5, 600.0), (145.5, 600.0)], [120.0843, 120.0843])];
    check("slim", &piece(&slim, |w| w), &facts);
    // At the side edge, and two on one edge.
    let mut side = RECTANGLE.to_vec();
    side.splice(2..2, [(300.0, 285.0), (200.0, 300.0), (300.0, 315.0)]);
    let facts = [("boundary_wedge", (200.0, 300.0), [(300.0, 285.0), (300.0, 315.0)], [LEG, LEG])];
    check("bust dart", &piece(&side, |w| w), &facts);
    let two = top(&[(215.0, 600.0), (200.0, 500.0), (185.0, 600.0), (115.0, 600.0), (100.0, 500.0), (85.0, 600.0)]);
    let facts = [
        ("boundary_wedge", (200.0, 500.0), [(215.0, 600.0), (185.0, 600.0)], [LEG, LEG]),
        ("boundary_wedge", (100.0, 500.0), [(115.0, 600.0), (85.0, 600.0)], [LEG, LEG]),
    ];
    check("two waist darts", &piece(&two, |w| w), &facts);
    // A mouth on a slanted edge: the corner before it is no part of the leg.
    let slanted =
        [(0.0, 0.0), (300.0, 0.0), (300.0, 590.0), (165.0, 600.0), (150.0, 500.0), (135.0, 602.0), (0.0, 612.0)];
    let facts = [("boundary_wedge", APEX, [(165.0, 600.0), (135.0, 602.0)], [LEG, 103.0971])];
    check("slanted edge", &piece(&slanted, |w| w), &facts);
}

#[test]
fn curved_legs_by_their_path() {
    // Legs of two chords: √(7² + 50²) + √(8² + 50²) = 50.4876 + 50.6360.
    let legs = 101.1235;
    let line = top(&[(165.0, 600.0), (158.0, 550.0), (150.0, 500.0), (142.0, 550.0), (135.0, 600.0)]);
    let corners: Vec<(f64, f64)> = line.iter().copied().filter(|p| p.1 != 550.0).collect();
    let text =
        file(|w| w.polyline("1", true, &line).points("2", &corners).points("3", &[(158.0, 550.0), (142.0, 550.0)]));
    check("curved", &text, &[("boundary_wedge", APEX, MOUTH, [legs, legs])]);
}

#[test]
fn wedges_on_the_sew_line_alone() {
    let cut = [(-10.0, -10.0), (310.0, -10.0), (310.0, 610.0), (-10.0, 610.0)];
    let sew = top(&[MOUTH[0], APEX, MOUTH[1]]);
    for layer in ["14", "8"] {
        let text = file(|w| w.polyline("1", true, &cut).polyline(layer, true, &sew));
        let piece = check(layer, &text, &[("boundary_wedge", APEX, MOUTH, [LEG, LEG])]);
        assert_eq!(piece["darts"][0]["line"], "sew");
    }
    // The sew line in runs, as Gerber writes it.
    let runs = file(|w| {
        let w = w.polyline("1", true, &cut);
        (0..sew.len()).fold(w, |w, i| w.polyline("14", false, &[sew[i], sew[(i + 1) % sew.len()]]))
    });
    check("runs", &runs, &[("boundary_wedge", APEX, MOUTH, [LEG, LEG])]);
    // A folded cap on the cut line above the mouth.
    let capped = [
        (-10.0, -10.0),
        (310.0, -10.0),
        (310.0, 610.0),
        (166.0, 610.0),
        (150.0, 616.0),
        (134.0, 610.0),
        (-10.0, 610.0),
    ];
    let text = file(|w| w.polyline("1", true, &capped).polyline("14", true, &sew));
    check("cap on the cut line", &text, &[("boundary_wedge", APEX, MOUTH, [LEG, LEG])]);
}

#[test]
fn darts_marked_inside() {
    let facts = [("internal_line", APEX, MOUTH, [LEG, LEG])];
    let bent = [MOUTH[1], APEX, MOUTH[0]];
    check("one line", &piece(&RECTANGLE, |w| w.polyline("8", false, &bent)), &facts);
    let two = piece(&RECTANGLE, |w| w.line("8", MOUTH[1], APEX).line("8", APEX, MOUTH[0]));
    check("two lines", &two, &facts);
    let closed = piece(&RECTANGLE, |w| w.polyline("8", true, &bent));
    check("closed triangle", &closed, &facts);
    // A cap: the outline rises over the mouth, the legs stay.
    let cap = top(&[MOUTH[0], (150.0, 606.0), MOUTH[1]]);
    check("cap", &piece(&cap, |w| w.polyline("8", false, &bent)), &facts);
    // With the mouth points as vertices and marks.
    let full = piece(&top(&MOUTH), |w| notched(w.polyline("8", false, &bent), &MOUTH).point("13", 150.0, 510.0));
    let found = check("notches and drill", &full, &facts);
    assert!(found["darts"][0]["confidence"].as_f64().is_some_and(|c| c > 0.95));
    // Legs that run over the allowance to the cut line: cut off at the sew line, 10 mm from its end.
    let cut = [(-10.0, -10.0), (310.0, -10.0), (310.0, 610.0), (-10.0, 610.0)];
    let long = [(133.5, 610.0), APEX, (166.5, 610.0)];
    let text = file(|w| w.polyline("1", true, &cut).polyline("14", true, &RECTANGLE).polyline("8", false, &long));
    check("legs to the cut line", &text, &facts);
    // Unequal: √(45² + 100²) = 109.66.
    let leaning = piece(&RECTANGLE, |w| w.polyline("8", false, &[(105.0, 600.0), APEX, MOUTH[0]]));
    check("leaning", &leaning, &[("internal_line", APEX, [MOUTH[0], (105.0, 600.0)], [LEG, 109.6586])]);
}

/// Tips at y 450 and 150, widest 24 mm at y 300: sides of 2·√(12² + 150²) mm.
pub(super) const EYE: [(f64, f64); 4] = [(150.0, 450.0), (138.0, 300.0), (150.0, 150.0), (162.0, 300.0)];
pub(super) const SIDE: f64 = 300.9585;

#[test]
fn fish_eyes() {
    let facts = [("contour", EYE[0], [EYE[1], EYE[3]], [SIDE, SIDE])];
    check("closed on 8", &piece(&RECTANGLE, |w| w.polyline("8", true, &EYE)), &facts);
    check("cutout on 11", &piece(&RECTANGLE, |w| w.polyline("11", true, &EYE)), &facts);
    let repeated = [EYE[0], EYE[1], EYE[2], EYE[3], EYE[0]];
    check("first vertex repeated", &piece(&RECTANGLE, |w| w.polyline("8", false, &repeated)), &facts);
    let strokes = piece(&RECTANGLE, |w| (0..4).fold(w, |w, i| w.line("8", EYE[i], EYE[(i + 1) % 4])));
    check("four lines", &strokes, &facts);
    let sides = piece(&RECTANGLE, |w| {
        w.polyline("8", false, &[EYE[0], EYE[1], EYE[2]]).polyline("8", false, &[EYE[0], EYE[3], EYE[2]])
    });
    check("two sides", &sides, &facts);
    // Lying across the grain, but drilled at a tip: a dart all the same.
    let across = [(50.0, 300.0), (150.0, 312.0), (250.0, 300.0), (150.0, 288.0)];
    let side = 2.0 * libm::sqrt(12.0 * 12.0 + 100.0 * 100.0);
    let facts = [("contour", (50.0, 300.0), [(150.0, 312.0), (150.0, 288.0)], [side, side])];
    check("drilled", &piece(&RECTANGLE, |w| w.polyline("8", true, &across).point("13", 62.0, 300.0)), &facts);
}

#[test]
fn drill_and_notches_are_a_candidate_and_no_dart() {
    let text = piece(&RECTANGLE, |w| notched(w, &MOUTH).point("13", 150.0, 510.0));
    // √(15² + 90²).
    let found = check("drill", &text, &[("drill_and_notches", (150.0, 510.0), MOUTH, [91.2414, 91.2414])]);
    assert_eq!(found["darts"][0]["candidate"], true);
    let pattern = good(&text);
    assert!(garment(&pattern).pieces[0].darts.is_empty());
    assert_eq!(codes(&pattern.findings), ["dart-candidate"]);
    // Two holes that claim one mouth are buttons or eyelets.
    check("two holes", &piece(&RECTANGLE, |w| notched(w, &MOUTH).points("13", &[(150.0, 510.0), (150.0, 480.0)])), &[]);
    check("off the axis", &piece(&RECTANGLE, |w| notched(w, &MOUTH).point("13", 170.0, 510.0)), &[]);
    let kite = piece(&RECTANGLE, |w| w.points("13", &EYE));
    check("four holes", &kite, &[]);
    assert_eq!(codes(&good(&kite).findings), ["dart-candidate"]);
}

#[test]
fn what_is_no_dart() {
    // 1 mm wide: a slit; its reason is told.
    let slit = check("slit", &piece(&top(&[(150.5, 600.0), (150.0, 400.0), (149.5, 600.0)]), |w| w), &[]);
    assert!(slit["not_darts"][0]["why"].as_str().is_some_and(|w| w.contains("slit")));
    check("tab", &piece(&top(&[(165.0, 600.0), (150.0, 700.0), (135.0, 600.0)]), |w| w), &[]);
    check("notch", &piece(&top(&[(153.0, 600.0), (150.0, 594.0), (147.0, 600.0)]), |w| w), &[]);
    check("wide V", &piece(&top(&[(250.0, 600.0), (150.0, 400.0), (50.0, 600.0)]), |w| w), &[]);
    // 120 mm wide and 140 deep: it would pass as a dart but for its place in the middle of a symmetric piece.
    let neck = [(0.0, 0.0), (300.0, 0.0), (300.0, 585.0), (210.0, 600.0), (150.0, 460.0), (90.0, 600.0), (0.0, 585.0)];
    let found = check("V neckline", &piece(&neck, |w| w), &[]);
    assert!(found["not_darts"][0]["why"].as_str().is_some_and(|w| w.contains("neckline")));
    // A pocket opening with one straight side, along the grain.
    let pocket = [(150.0, 400.0), (142.0, 362.0), (140.0, 325.0), (142.0, 288.0), (150.0, 250.0), (151.0, 325.0)];
    let found = check("D pocket", &piece(&RECTANGLE, |w| w.polyline("8", true, &pocket)), &[]);
    assert!(found["not_darts"][0]["why"].as_str().is_some_and(|w| w.contains("straight")));
    let lens = [(80.0, 300.0), (150.0, 308.0), (220.0, 300.0), (150.0, 292.0)];
    let found = check("pocket lens", &piece(&RECTANGLE, |w| w.polyline("8", true, &lens)), &[]);
    assert!(found["not_darts"][0]["why"].as_str().is_some_and(|w| w.contains("pocket")));
    let welt = [(100.0, 300.0), (240.0, 300.0), (240.0, 312.0), (100.0, 312.0)];
    check("welt", &piece(&RECTANGLE, |w| w.polyline("8", true, &welt)), &[]);
    check("line inside", &piece(&RECTANGLE, |w| w.polyline("8", false, &[(135.0, 580.0), APEX, (165.0, 580.0)])), &[]);
    check("circle", &piece(&RECTANGLE, |w| w.pair(0, "CIRCLE").pair(8, "11").xy(150.0, 300.0).pair(40, "30")), &[]);
}

#[test]
fn pleats_are_told_and_not_made() {
    let pleat = |body: fn(Writer) -> Writer| {
        let text = piece(&RECTANGLE, |w| {
            body(w.line("8", (130.0, 600.0), (130.0, 500.0)).line("8", (170.0, 600.0), (170.0, 500.0)))
        });
        let found = inspect(text.as_bytes(), "t.dxf", None).expect("read").json["pieces"][0].clone();
        assert_eq!(found["dart_count"], 0);
        found["pleats"].clone()
    };
    let notches = pleat(|w| notched(w, &[(130.0, 600.0), (170.0, 600.0)]));
    assert_eq!((&notches[0]["kind"], &notches[0]["width_mm"]), (&"pleat".into(), &40.0.into()));
    assert_eq!(pleat(|w| w.text_at("8", "PLEAT", 150.0, 550.0))[0]["kind"], "pleat");
    // Without notches and words it may be a pocket.
    assert_eq!(pleat(|w| w), serde_json::json!([]));
    let text = piece(&RECTANGLE, |w| {
        notched(
            w.line("8", (130.0, 600.0), (145.0, 500.0)).line("8", (155.0, 500.0), (170.0, 600.0)),
            &[(130.0, 600.0), (170.0, 600.0)],
        )
    });
    let found = inspect(text.as_bytes(), "t.dxf", None).expect("read").json["pieces"][0].clone();
    assert_eq!(found["pleats"][0]["kind"], "dart_pleat");
    assert_eq!(codes(&good(&text).findings), ["pleat-candidate"]);
    assert!(garment(&good(&text)).pieces[0].darts.is_empty());
}
