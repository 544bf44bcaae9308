//! Darts drawn loosely, and what runs as a dart does and is none. The same piece as in `dart_forms`.

use super::dart_forms::{APEX, EYE, Fact, LEG, MOUTH, SIDE, check, piece, top};
use super::*;

const WEDGE: Fact = ("boundary_wedge", APEX, MOUTH, [LEG, LEG]);
const MARKED: Fact = ("internal_line", APEX, MOUTH, [LEG, LEG]);

type Point = (f64, f64);

/// Lines from each mouth point to the apex beside it.
fn legs(ends: &[(Point, Point)]) -> String {
    piece(&RECTANGLE, |w| ends.iter().fold(w, |w, (a, b)| w.line("8", *a, *b)))
}

#[test]
fn a_blunt_apex_is_one_point() {
    for width in [0.005, 0.05, 0.3, 2.0] {
        let pair = [(150.0 + width / 2.0, 500.0), (150.0 - width / 2.0, 500.0)];
        let line = top(&[MOUTH[0], pair[0], pair[1], MOUTH[1]]);
        let text = piece(&line, |w| w);
        check(&format!("{width} mm wide"), &text, &[WEDGE]);
        check("unmarked", &file(|w| w.polyline("1", true, &line)), &[WEDGE]);
        let cut = [(-10.0, -10.0), (310.0, -10.0), (310.0, 610.0), (-10.0, 610.0)];
        check("sew line", &file(|w| w.polyline("1", true, &cut).polyline("14", true, &line)), &[WEDGE]);
        let pattern = good(&text);
        let told: &[&str] = if width > 0.06 { &["dart-apex-blunt"] } else { &[] };
        assert_eq!(codes(&pattern.findings), told);
        // The apex is one vertex of the piece.
        let piece = garment(&pattern).pieces.remove(0);
        let apex = piece.darts[0].apexes[0];
        assert_eq!(piece.outline.points.iter().filter(|p| (p.at - apex).norm() < 3e-3).count(), 1);
    }
    // The flat bottom of a slit is no apex.
    check("slit", &piece(&top(&[(151.0, 600.0), (151.0, 500.0), (149.0, 500.0), (149.0, 600.0)]), |w| w), &[]);
}

#[test]
fn vertices_drawn_twice_a_little_apart_are_one() {
    for apart in [0.01, 0.05] {
        let line: Vec<(f64, f64)> =
            top(&[MOUTH[0], APEX, MOUTH[1]]).into_iter().flat_map(|(x, y)| [(x, y), (x + apart, y)]).collect();
        check("to the side", &piece(&line, |w| w), &[WEDGE]);
        let line = top(&[MOUTH[0], APEX, (APEX.0, APEX.1 + apart), MOUTH[1]]);
        check("up the leg", &piece(&line, |w| w), &[WEDGE]);
    }
}

#[test]
fn blunt_tips_of_a_lens() {
    let fact = [("contour", EYE[0], [EYE[1], EYE[3]], [SIDE, SIDE])];
    for width in [0.1, 0.5] {
        let (l, r) = (150.0 - width / 2.0, 150.0 + width / 2.0);
        let eye = [(r, 450.0), (l, 450.0), EYE[1], (l, 150.0), (r, 150.0), EYE[3]];
        check("closed", &piece(&RECTANGLE, |w| w.polyline("8", true, &eye)), &fact);
        let sides = [[eye[1], eye[2], eye[3]], [eye[4], eye[5], eye[0]]];
        let strokes = |layer| piece(&RECTANGLE, |w| sides.iter().fold(w, |w, s| w.polyline(layer, false, s)));
        check("two sides", &strokes("8"), &fact);
        check("two sides of a cutout", &strokes("11"), &fact);
    }
}

#[test]
fn centre_lines_and_doubled_lines_make_no_second_dart() {
    let centre = ((150.0, 600.0), APEX);
    let sides = [(MOUTH[0], APEX), (MOUTH[1], APEX)];
    for order in [[sides[0], sides[1], centre], [centre, sides[0], sides[1]], [sides[0], centre, sides[1]]] {
        check("centre line", &legs(&order), &[MARKED]);
    }
    check("lines twice", &legs(&[sides[0], sides[1], sides[0], sides[1]]), &[MARKED]);
    let bent = [MOUTH[0], APEX, MOUTH[1]];
    let twice = piece(&RECTANGLE, |w| w.polyline("8", false, &bent).polyline("8", false, &bent));
    check("polyline twice", &twice, &[MARKED]);
    assert!(garment(&good(&twice)).pieces[0].internal_lines.is_empty());
    // Two darts that share their apex.
    let side = [((300.0, 485.0), (200.0, 500.0)), ((300.0, 515.0), (200.0, 500.0))];
    let waist = [((215.0, 600.0), (200.0, 500.0)), ((185.0, 600.0), (200.0, 500.0))];
    let facts = [
        ("internal_line", (200.0, 500.0), [side[0].0, side[1].0], [LEG, LEG]),
        ("internal_line", (200.0, 500.0), [waist[0].0, waist[1].0], [LEG, LEG]),
    ];
    check("one apex", &legs(&[waist[0], side[0], waist[1], side[1]]), &facts);
}

#[test]
fn legs_that_miss_each_other_or_the_edge() {
    for gap in [0.15, 0.25] {
        let text = legs(&[(MOUTH[0], (150.0 + gap, 500.0)), (MOUTH[1], (150.0 - gap, 500.0))]);
        check("gap at the apex", &text, &[MARKED]);
    }
    check("one leg short", &legs(&[(MOUTH[0], (150.045, 500.3)), (MOUTH[1], APEX)]), &[MARKED]);
    // 5 mm apart they are two lines.
    check("far apart", &legs(&[(MOUTH[0], (152.5, 500.0)), (MOUTH[1], (147.5, 500.0))]), &[]);
    // Past the edge, or short of it: the mouth is where the legs meet the edge.
    for by in [0.2, 0.2 / 15.0, 0.005, -0.005] {
        let end = |m: (f64, f64)| (m.0 + (m.0 - APEX.0) * by, m.1 + (m.1 - APEX.1) * by);
        let bent = [end(MOUTH[0]), APEX, end(MOUTH[1])];
        check("past the edge", &piece(&RECTANGLE, |w| w.polyline("8", false, &bent)), &[MARKED]);
        check("two lines", &legs(&[(APEX, bent[0]), (APEX, bent[2])]), &[MARKED]);
    }
    let cut = [(-10.0, -10.0), (310.0, -10.0), (310.0, 610.0), (-10.0, 610.0)];
    let triangle = [(133.5, 610.0), APEX, (166.5, 610.0)];
    let text = file(|w| w.polyline("1", true, &cut).polyline("14", true, &RECTANGLE).polyline("8", true, &triangle));
    check("closed triangle to the cut line", &text, &[MARKED]);
}

#[test]
fn two_darts_may_share_a_mouth_point() {
    let facts = |kind| {
        [
            (kind, (180.0, 500.0), [(195.0, 600.0), (165.0, 600.0)], [LEG, LEG]),
            (kind, (150.0, 500.0), [(165.0, 600.0), (135.0, 600.0)], [LEG, LEG]),
        ]
    };
    let line = [(195.0, 600.0), (180.0, 500.0), (165.0, 600.0), (150.0, 500.0), (135.0, 600.0)];
    check("wedges", &piece(&top(&line), |w| w), &facts("boundary_wedge"));
    check("one line", &piece(&RECTANGLE, |w| w.polyline("8", false, &line)), &facts("internal_line"));
}

#[test]
fn teeth_of_an_edge_are_no_darts() {
    let zigzag: Vec<(f64, f64)> = (0_u8..=12).map(|i| (f64::from(i) * 25.0, f64::from(i % 2) * 60.0)).collect();
    let mut hem = zigzag.clone();
    hem.extend([(300.0, 600.0), (0.0, 600.0)]);
    let text = piece(&hem, |w| w);
    let found = check("hem", &text, &[]);
    assert_eq!(found["not_darts"].as_array().map(Vec::len), Some(6));
    assert_eq!(codes(&good(&text).findings), ["wedge-not-a-dart"]);
    // Two whole teeth between two halves.
    let crown = [
        (0.0, 0.0),
        (240.0, 0.0),
        (240.0, 60.0),
        (200.0, 130.0),
        (160.0, 60.0),
        (120.0, 130.0),
        (80.0, 60.0),
        (40.0, 130.0),
        (0.0, 60.0),
    ];
    check("crown", &piece(&crown, |w| w), &[]);
    let quilt = piece(&RECTANGLE, |w| {
        (0_u8..5)
            .map(|i| f64::from(i) * 60.0)
            .fold(w, |w, x| w.line("8", (x, 600.0), (x + 30.0, 500.0)).line("8", (x + 30.0, 500.0), (x + 60.0, 600.0)))
    });
    check("quilting", &quilt, &[]);
}

#[test]
fn pointed_and_round_boxes_are_no_darts() {
    let boxes: [(&str, &[Point]); 5] = [
        ("placket", &[(135.0, 600.0), (135.0, 440.0), (150.0, 430.0), (165.0, 440.0), (165.0, 600.0)]),
        ("long point", &[(135.0, 600.0), (135.0, 500.0), (150.0, 470.0), (165.0, 500.0), (165.0, 600.0)]),
        ("tower", &[(100.0, 0.0), (100.0, 150.0), (112.0, 165.0), (125.0, 150.0), (125.0, 0.0)]),
        ("flap", &[(60.0, 600.0), (60.0, 540.0), (110.0, 500.0), (160.0, 540.0), (160.0, 600.0)]),
        (
            "round",
            &[
                (135.0, 600.0),
                (135.0, 450.0),
                (142.0, 437.0),
                (150.0, 435.0),
                (158.0, 437.0),
                (165.0, 450.0),
                (165.0, 600.0),
            ],
        ),
    ];
    for (name, line) in boxes {
        let text = piece(&RECTANGLE, |w| w.polyline("8", false, line));
        let found = check(name, &text, &[]);
        assert!(found["not_darts"][0]["why"].as_str().is_some_and(|w| w.contains("placket")), "{name}: {found}");
        assert_eq!(codes(&good(&text).findings), ["wedge-not-a-dart"], "{name}");
        assert_eq!(garment(&good(&text)).pieces[0].internal_lines.len(), 1, "{name}: it stays an internal line");
    }
    // Legs that are steeper at the edge: √(13² + 60²) + √(7² + 70²).
    let double = [(130.0, 600.0), (143.0, 540.0), (150.0, 470.0), (157.0, 540.0), (170.0, 600.0)];
    let facts = [("internal_line", (150.0, 470.0), [(130.0, 600.0), (170.0, 600.0)], [131.741, 131.741])];
    check("two angles", &piece(&RECTANGLE, |w| w.polyline("8", false, &double)), &facts);
}

#[test]
fn v_necks_of_whole_pieces_and_darts_in_the_middle() {
    let front = |half: f64, deep: f64, shoulder: f64| {
        piece(
            &[
                (0.0, 0.0),
                (300.0, 0.0),
                (300.0, shoulder),
                (150.0 + half, 600.0),
                (150.0, 600.0 - deep),
                (150.0 - half, 600.0),
                (0.0, shoulder),
            ],
            |w| w,
        )
    };
    // 28 degrees and 100 mm; 26 degrees and 70 mm; 37 degrees and 50 mm.
    for (half, deep) in [(50.0, 200.0), (35.0, 150.0), (25.0, 75.0)] {
        let text = front(half, deep, 585.0);
        let found = check("neck", &text, &[]);
        assert!(found["not_darts"][0]["why"].as_str().is_some_and(|w| w.contains("neckline")));
        assert_eq!(codes(&good(&text).findings), ["wedge-not-a-dart"]);
    }
    check("waist dart", &front(15.0, 100.0, 600.0), &[WEDGE]);
}

/// A wide dart in the middle of a waist is one; between shoulders it is a neckline.
#[test]
fn a_wide_wedge_in_the_middle_is_a_neckline_between_shoulders_only() {
    for (fall, darts) in [(0.0, 1), (-10.0, 1), (40.0, 0)] {
        let (side, top) = (600.0 - fall, 600.0);
        let outline =
            [(0.0, 0.0), (520.0, 0.0), (500.0, side), (300.0, top), (260.0, 480.0), (220.0, top), (20.0, side)];
        let pattern = good(&file(|w| w.polyline("1", true, &outline).points("2", &outline)));
        assert_eq!(garment(&pattern).pieces[0].darts.len(), darts, "shoulders fall by {fall} mm");
    }
}
