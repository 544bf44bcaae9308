//! Optitex: blocks called by numbers, AAMA, a layer table of the user's own.

use super::facts::{Case, Facts, plain, wedge};
use super::writer::{RECTANGLE, WEDGE, Writer, file, scaled};

/// Two blocks `1` and `2`, texts of the style, and `Units`.
fn two(first: impl Fn(Writer) -> Writer, second: impl Fn(Writer) -> Writer, units: &str) -> Vec<u8> {
    file(
        "",
        |w| {
            w.block("1", |w| first(w.text("1", "Piece Name: FRONT").text("1", "Size: M")).grain())
                .block("2", |w| second(w.text("1", "Piece Name: BACK").text("1", "Size: M")).grain())
        },
        |w| {
            let w = w.insert("1").insert("2").text("1", "Style Name: ONE").text("1", "Sample Size: M");
            w.text("1", "Version: ANSI/AAMA-292").text("1", &format!("Units: {units}"))
        },
    )
}

fn m(facts: Facts) -> Facts {
    Facts { size: Some("M"), ..facts }
}

const RUL: &str = "ANSI/AAMA VERSION: 1.0.0\r\nUNITS: METRIC\r\nGRADE RULE TABLE: T\r\nNUMBER OF SIZES: 3\r\n\
    SIZE LIST: S M L\r\nSAMPLE SIZE: M\r\nRULE: DELTA 1\r\n0,0 0,0 0,0\r\nRULE: DELTA 2\r\n-10,0 0,0 10,0\r\n\
    RULE: DELTA 3\r\n-10,-20 0,0 10,20\r\nRULE: DELTA 4\r\n0,-20 0,0 0,20\r\nEND\r\n";

pub fn cases() -> Vec<Case> {
    let closed = |points: &'static [(f64, f64)]| move |w: Writer| w.polyline("1", true, points);
    let both = || vec![m(wedge("FRONT")), m(plain("BACK"))];
    let rules = |w: Writer| {
        let w = w.polyline("1", true, &RECTANGLE).points("2", &RECTANGLE);
        (0..4).fold(w, |w, i| w.text_at("2", &format!("# {}", i + 1), RECTANGLE[i]))
    };
    // Notches at the mouth and a hole 10 mm short of the apex, the outline straight: only a candidate.
    let drilled = |w: Writer| {
        let w = w.polyline("1", true, &RECTANGLE).points("4", &[(135.0, 600.0), (165.0, 600.0)]);
        w.point("13", (150.0, 510.0))
    };
    let candidate = Facts { darts: vec![("drill_and_notches", (150.0, 510.0))], marks: 2, drills: 1, ..plain("FRONT") };
    let inches = scaled(&WEDGE, 1.0 / 25.4);
    let inch_back = scaled(&RECTANGLE, 1.0 / 25.4);
    let gap = [(0.0, 0.0), (300.0, 0.0), (300.0, 600.0), (0.0, 600.0), (0.0, 0.3)];
    vec![
        Case::new("optitex-numbers", two(closed(&WEDGE), closed(&RECTANGLE), "METRIC"), both()).by("optitex"),
        Case::new("optitex-rules", two(rules, closed(&RECTANGLE), "METRIC"), vec![m(plain("FRONT")), m(plain("BACK"))])
            .graded(RUL, "FRONT", "L", &[(0.0, 0.0), (310.0, 0.0), (310.0, 620.0), (0.0, 620.0)]),
        Case::new(
            "optitex-rules-down",
            two(rules, closed(&RECTANGLE), "METRIC"),
            vec![m(plain("FRONT")), m(plain("BACK"))],
        )
        .graded(RUL, "FRONT", "S", &[(290.0, 0.0), (290.0, 580.0), (0.0, 580.0)]),
        Case::new(
            "optitex-drilled-dart",
            two(drilled, closed(&RECTANGLE), "METRIC"),
            vec![m(candidate), m(plain("BACK"))],
        )
        .tells(&["dart-candidate"]),
        Case::new(
            "optitex-inches",
            two(|w| w.polyline("1", true, &inches), |w| w.polyline("1", true, &inch_back), "ENGLISH"),
            vec![
                // The grain line of the writer is in the same numbers, so it is 25.4 times as long.
                Facts { darts: vec![("boundary_wedge", (150.0, 500.0))], ..m(wedge("FRONT")) },
                m(plain("BACK")),
            ],
        )
        .unit(25.4),
        Case::new(
            "optitex-gap",
            two(|w| w.polyline("1", false, &gap), closed(&RECTANGLE), "METRIC"),
            // The gap of 0.3 mm is closed by its straight line.
            vec![m(plain("FRONT")), m(plain("BACK"))],
        )
        .tells(&["outline-gap-closed"]),
        Case::new(
            "optitex-own-layers",
            two(
                |w| w.polyline("CUT", true, &WEDGE).point("PUNCH", (150.0, 490.0)),
                |w| w.polyline("CUT", true, &RECTANGLE),
                "METRIC",
            ),
            vec![m(Facts { drills: 1, ..wedge("FRONT") }), m(plain("BACK"))],
        )
        .layers(&[("CUT", "1"), ("PUNCH", "13")]),
        Case::new(
            "optitex-half",
            two(
                closed(&RECTANGLE),
                |w| w.polyline("1", true, &RECTANGLE).line("6", (0.0, 0.0), (0.0, 600.0)),
                "METRIC",
            ),
            vec![m(plain("FRONT")), m(Facts { half: true, ..plain("BACK") })],
        ),
        Case::new(
            "optitex-capped-dart",
            // A folded mouth: 3 mm of cap between the mouth points and the edge, legs unchanged.
            two(
                |w| {
                    let line = [
                        (0.0, 0.0),
                        (300.0, 0.0),
                        (300.0, 600.0),
                        (165.0, 600.0),
                        (150.0, 500.0),
                        (135.0, 600.0),
                        (0.0, 600.0),
                    ];
                    let cap = [
                        (-10.0, -10.0),
                        (310.0, -10.0),
                        (310.0, 610.0),
                        (170.0, 610.0),
                        (150.0, 604.0),
                        (130.0, 610.0),
                        (-10.0, 610.0),
                    ];
                    w.polyline("1", true, &cap).polyline("14", true, &line)
                },
                closed(&RECTANGLE),
                "METRIC",
            ),
            // 320 × 620 less half of 40 × 6; round: 1880 − 40 + 2·√(20² + 6²).
            vec![
                m(Facts { area: 1982.8, perimeter: 1840.0 + 2.0 * libm::sqrt(436.0), ..wedge("FRONT") }),
                m(plain("BACK")),
            ],
        ),
    ]
}
