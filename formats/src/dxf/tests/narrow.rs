//! Sew lines of narrow pieces: being an offset of the cut line decides.

use super::*;

fn rectangle(x: f64, y: f64, w: f64, h: f64) -> [(f64, f64); 4] {
    [(x, y), (x + w, y), (x + w, y + h), (x, y + h)]
}

#[test]
fn the_sew_line_of_a_strap_is_found_on_both_layers() {
    for layer in ["8", "14"] {
        let text = file(|w| {
            let w = w.polyline("1", true, &rectangle(0.0, 0.0, 400.0, 30.0));
            w.polyline(layer, true, &rectangle(10.0, 10.0, 380.0, 10.0))
        });
        let piece = &good(&text).pieces[0];
        let net = geom::area(&piece.sewn().positions());
        assert!((net - 3800.0).abs() < 1e-6 && piece.sew_lines == 1, "layer {layer}: {net}");
        assert!(piece.darts.is_empty() && piece.inside.internal.is_empty());
    }
    // Drawn as four open lines, in disorder.
    let [a, b, c, d] = rectangle(10.0, 10.0, 380.0, 10.0);
    let text = file(|w| {
        let w = w.polyline("1", true, &rectangle(0.0, 0.0, 400.0, 30.0));
        w.line("8", a, b).line("8", d, c).line("8", b, c).line("8", d, a)
    });
    let piece = &good(&text).pieces[0];
    assert!((geom::area(&piece.sewn().positions()) - 3800.0).abs() < 1e-6 && piece.inside.internal.is_empty());
}

/// A pointed flap, 60 mm wide, with an allowance of 8 mm: the sew line is a long lens that is no fish-eye dart.
#[test]
fn the_sew_line_of_a_pointed_flap_is_no_dart() {
    let lens = |half: f64, bow: f64| -> Vec<(f64, f64)> {
        let arc = |k: i32, side: f64| {
            let x = half * f64::from(k) / 10.0;
            (150.0 + x, 300.0 + side * bow * (1.0 - (x / half) * (x / half)))
        };
        (-10..10).map(|k| arc(k, -1.0)).chain((-9..=10).rev().map(|k| arc(k, 1.0))).collect()
    };
    let text = file(|w| w.polyline("1", true, &lens(150.0, 38.0)).polyline("8", true, &lens(118.0, 29.5)));
    let piece = &good(&text).pieces[0];
    assert!(piece.sew.is_some() && piece.darts.is_empty(), "{:?}", piece.darts);
}

#[test]
fn what_is_no_offset_is_no_sew_line() {
    // A buttonhole box at one end of a strap, a fish-eye dart in a narrow yoke, a pocket on a front.
    let yoke = [(100.0, 40.0), (150.0, 30.0), (200.0, 40.0), (150.0, 50.0)];
    let pocket = rectangle(40.0, 300.0, 120.0, 120.0);
    let cases: [[&[(f64, f64)]; 2]; 3] = [
        [&rectangle(0.0, 0.0, 400.0, 30.0), &rectangle(10.0, 10.0, 30.0, 10.0)],
        [&rectangle(0.0, 0.0, 300.0, 80.0), &yoke],
        [&RECTANGLE, &pocket],
    ];
    for [cut, inner] in cases {
        for layer in ["8", "14"] {
            let piece = &good(&file(|w| w.polyline("1", true, cut).polyline(layer, true, inner))).pieces[0];
            assert!(piece.sew.is_none(), "layer {layer}: {inner:?}");
        }
    }
}

#[test]
fn a_loop_of_the_sew_line_is_cut_off_and_a_crossing_is_said() {
    let inner = |corner: &[(f64, f64)]| {
        let mut line = vec![(10.0, 10.0), (290.0, 10.0), (290.0, 590.0)];
        line.extend(corner);
        file(move |w| w.polyline("1", true, &RECTANGLE).polyline("14", true, &line))
    };
    let looped = good(&inner(&[(8.0, 590.0), (8.0, 596.0), (14.0, 584.0)]));
    assert_eq!(codes(&looped.findings), ["outline-loop-cut-off"]);
    assert_eq!(looped.pieces[0].sewn().drawn.len(), 5);
    assert!(geom::crossing(&looped.pieces[0].sewn().positions()) == geom::Crossing::None);
    let crossed = good(&inner(&[(10.0, 590.0), (250.0, 300.0), (250.0, 560.0), (10.0, 300.0)]));
    assert_eq!(codes(&crossed.findings), ["sew-line-crosses-itself"]);
}

/// A strap, a flap and a half belt have no allowance along one long side; the sew line lies on the cut line there.
#[test]
fn a_side_without_allowance_may_be_the_longest() {
    let strap = rectangle(0.0, 0.0, 400.0, 24.0);
    let flap = [(0.0, 0.0), (120.0, 0.0), (120.0, 40.0), (100.0, 60.0), (20.0, 60.0), (0.0, 40.0)];
    let flap_sewn = [(8.0, 0.0), (112.0, 0.0), (112.0, 36.7), (96.7, 52.0), (23.3, 52.0), (8.0, 36.7)];
    let cases: [[&[(f64, f64)]; 2]; 2] = [[&strap, &rectangle(10.0, 0.0, 380.0, 14.0)], [&flap, &flap_sewn]];
    for [cut, sewn] in cases {
        for layer in ["8", "14"] {
            let piece = &good(&file(|w| w.polyline("1", true, cut).polyline(layer, true, sewn))).pieces[0];
            assert!(piece.sew.is_some() && piece.inside.internal.is_empty(), "layer {layer}: {sewn:?}");
        }
    }
}

#[test]
fn what_shares_most_of_the_outline_is_no_sew_line() {
    let belt = rectangle(0.0, 0.0, 400.0, 40.0);
    let cases: [[&[(f64, f64)]; 2]; 4] = [
        // A facing along the upper edge, a copy of the outline, half of a belt, a pocket in a corner.
        [&belt, &rectangle(0.0, 20.0, 400.0, 20.0)],
        [&belt, &belt],
        [&belt, &rectangle(0.0, 0.0, 200.0, 40.0)],
        [&RECTANGLE, &rectangle(0.0, 0.0, 150.0, 150.0)],
    ];
    for [cut, inner] in cases {
        let piece = &good(&file(|w| w.polyline("1", true, cut).polyline("8", true, inner))).pieces[0];
        assert!(piece.sew.is_none() && piece.inside.internal.len() == 1, "{inner:?}");
    }
    // What lies on the fold has no allowance and proves none: a facing along the edge of a half belt.
    let text = file(|w| {
        let w = w.polyline("1", true, &belt).line("6", (0.0, 0.0), (400.0, 0.0));
        w.polyline("8", true, &rectangle(0.0, 20.0, 400.0, 20.0))
    });
    let piece = &good(&text).pieces[0];
    assert!(piece.axes.fold.is_some() && piece.sew.is_none(), "{:?}", piece.sew);
}

/// A bow encloses next to nothing, so its area does not say that it is meant for the sew line.
#[test]
fn a_sew_line_that_is_a_bow_is_said() {
    let bow = [(10.0, 10.0), (290.0, 590.0), (290.0, 10.0), (10.0, 590.0)];
    let pattern = good(&file(|w| w.polyline("1", true, &RECTANGLE).polyline("14", true, &bow)));
    assert_eq!(codes(&pattern.findings), ["sew-line-crosses-itself"]);
    assert!(pattern.findings[0].severity == Severity::Warning && pattern.findings[0].hint.is_some());
    assert!(pattern.pieces[0].sew.is_none() && pattern.pieces[0].inside.internal.len() == 1);
    // A small bow is a stitch, as before.
    let small = bow.map(|(x, y)| (100.0 + 0.2 * x, 100.0 + 0.2 * y));
    let pattern = good(&file(|w| w.polyline("1", true, &RECTANGLE).polyline("14", true, &small)));
    assert_eq!(codes(&pattern.findings), ["stitch-line"]);
}

/// A half piece whose fold line is missing has a sew line that is open along the straight edge in its middle.
#[test]
fn a_sew_line_that_is_open_along_one_straight_edge_asks_for_the_fold() {
    let open = [(0.0, 30.0), (290.0, 30.0), (290.0, 590.0), (0.0, 590.0)];
    let drawn = |fold: bool, line: &[(f64, f64)]| {
        good(&file(|w| {
            let w = w.polyline("1", true, &RECTANGLE).polyline("14", false, line);
            if fold { w.line("6", (0.0, 0.0), (0.0, 600.0)) } else { w }
        }))
    };
    let pattern = drawn(false, &open);
    let warnings = |pattern: &Pattern| -> Vec<String> {
        let all = pattern.findings.iter().filter(|f| f.severity == Severity::Warning);
        all.map(|f| f.code.to_string()).collect()
    };
    assert_eq!(warnings(&pattern), ["fold-missing"], "{:?}", pattern.findings);
    assert!(pattern.findings[0].hint.as_ref().is_some_and(|h| h.contains("layer 6")));
    // With its fold the piece is unfolded, and nothing is asked.
    let folded = drawn(true, &open);
    assert!(warnings(&folded).is_empty() && folded.pieces[0].sew.is_some(), "{:?}", folded.findings);
    // A seam from edge to edge is a drawn line, and so is a small one at one edge.
    for line in
        [&[(0.0, 300.0), (150.0, 320.0), (300.0, 300.0)][..], &[(0.0, 30.0), (60.0, 30.0), (60.0, 90.0), (0.0, 90.0)]]
    {
        assert!(warnings(&drawn(false, line)).is_empty(), "{line:?}");
    }
}
