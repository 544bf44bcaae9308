//! Drawing programs: no blocks, curves of every kind, scaled and nested INSERTs.

use super::facts::{Case, Facts, plain, wedge};
use super::writer::{RECTANGLE, WEDGE, Writer, file, header, scaled};
use std::f64::consts::PI;

fn flat(head: &[(&str, i32, &str)], entities: impl Fn(Writer) -> Writer) -> Vec<u8> {
    file(&header(head), |w| w, entities)
}

fn nameless(facts: Facts) -> Facts {
    Facts { name: None, ..facts }
}

/// 200 × 100 mm with a half circle of radius 50 mm at its right end. The arc is 36 chords: the fewest whose sagitta
/// keeps within 0.05 mm, π / (2·acos(1 − 0.05 / 50)) rounded up.
fn stadium_half() -> Facts {
    let area = 200.0 + 36.0 * 12.5 * libm::sin(PI / 36.0);
    Facts { area, net_area: area, perimeter: 500.0 + 36.0 * 100.0 * libm::sin(PI / 72.0), ..plain("") }
}

fn piece(w: Writer) -> Writer {
    w.text("1", "Piece Name: FRONT").polyline("1", true, &WEDGE).grain()
}

fn style(w: Writer) -> Writer {
    w.text("1", "Style Name: S").text("1", "Units: METRIC")
}

pub fn cases() -> Vec<Case> {
    let lines = flat(&[("$INSUNITS", 70, "4")], |w| {
        let n = WEDGE.len();
        (0..n).fold(w, |w, i| w.line("CUT", WEDGE[i], WEDGE[(i + 1) % n])).grain()
    });
    let light = flat(&[("$ACADVER", 1, "AC1015"), ("$INSUNITS", 70, "4")], |w| w.light("0", true, &WEDGE));
    let inches = scaled(&WEDGE, 1.0 / 25.4);
    let inch = flat(&[("$INSUNITS", 70, "1")], |w| w.polyline("0", true, &inches));
    let two = flat(&[("$INSUNITS", 70, "4")], |w| {
        let right: Vec<(f64, f64)> = RECTANGLE.iter().map(|(x, y)| (x + 400.0, *y)).collect();
        w.polyline("0", true, &RECTANGLE).polyline("0", true, &right)
    });
    let hole = file(
        "",
        |w| w.block("FRONT", |w| piece(w).pair(0, "CIRCLE").pair(8, "13").xy(10, (150.0, 490.0)).pair(40, "2")),
        |w| style(w.insert("FRONT")),
    );
    let arc = file(
        "",
        |w| {
            w.block("END", |w| {
                let w = w.text("1", "Piece Name: END").polyline(
                    "1",
                    false,
                    &[(200.0, 100.0), (0.0, 100.0), (0.0, 0.0), (200.0, 0.0)],
                );
                w.pair(0, "ARC").pair(8, "1").xy(10, (200.0, 50.0)).pair(40, "50").pair(50, "-90").pair(51, "90").line(
                    "7",
                    (20.0, 20.0),
                    (20.0, 80.0),
                )
            })
        },
        |w| style(w.insert("END")),
    );
    let inserted =
        |tail: fn(Writer) -> Writer| file("", |w| w.block("FRONT", piece), |w| style(tail(w.insert("FRONT"))));
    let doubled = Facts {
        area: 4.0 * 1785.0,
        net_area: 4.0 * 1785.0,
        perimeter: 2.0 * super::facts::ROUND,
        darts: vec![("boundary_wedge", (300.0, 1000.0))],
        ..plain("FRONT")
    };
    let mirrored = Facts { darts: vec![("boundary_wedge", (-150.0, 500.0))], ..wedge("FRONT") };
    let nested = file(
        "",
        |w| {
            let w = w.block("LINE", |w| w.polyline("0", true, &WEDGE));
            w.block("FRONT", |w| w.text("1", "Piece Name: FRONT").insert("LINE").grain())
        },
        |w| style(w.insert("FRONT")),
    );
    let marks = file(
        "",
        |w| {
            let w = w.block("HOLE", |w| w.point("0", (0.0, 0.0)));
            w.block("FRONT", |w| piece(w).pair(0, "INSERT").pair(8, "13").pair(2, "HOLE").xy(10, (150.0, 490.0)))
        },
        |w| style(w.insert("FRONT")),
    );
    let table = file(
        "",
        |w| {
            let w = w
                .block("FRONT", piece)
                .block("BACK", |w| w.text("1", "Piece Name: BACK").polyline("1", true, &RECTANGLE).grain());
            w.block("TABLE", |w| w.insert("FRONT").insert("BACK").pair(41, "2").pair(42, "2"))
        },
        |w| style(w.insert("TABLE")),
    );
    let metre = scaled(&WEDGE, 0.001);
    let metres = flat(&[("$INSUNITS", 70, "6")], |w| w.polyline("0", true, &metre));
    vec![
        Case::new("drawing-lines", lines, vec![nameless(wedge(""))]).tells(&["pieces-from-entities"]),
        Case::new("drawing-light", light, vec![nameless(wedge(""))]),
        Case::new("drawing-inches", inch, vec![nameless(wedge(""))]).unit(25.4),
        Case::new("drawing-metres", metres, vec![nameless(wedge(""))]).unit(1000.0),
        Case::new("drawing-two", two, vec![nameless(plain("")), nameless(plain(""))]),
        Case::new("drawing-circle-hole", hole, vec![Facts { drills: 1, ..wedge("FRONT") }]),
        Case::new("drawing-arc", arc, vec![Facts { name: Some("END"), ..stadium_half() }]),
        Case::new("insert-twice-as-large", inserted(|w| w.pair(41, "2").pair(42, "2").pair(50, "30")), vec![doubled])
            .tells(&["insert-transformed"]),
        Case::new("insert-mirrored", inserted(|w| w.pair(41, "-1").pair(42, "1")), vec![mirrored])
            .tells(&["insert-mirrored"]),
        Case::new("insert-nested-outline", nested, vec![wedge("FRONT")]),
        Case::new("insert-nested-mark", marks, vec![Facts { drills: 1, ..wedge("FRONT") }]),
        Case::new(
            "insert-table-of-pieces",
            table,
            // The back is four times as large: 7200 cm², 3600 mm round.
            vec![wedge("FRONT"), Facts { area: 7200.0, net_area: 7200.0, perimeter: 3600.0, ..plain("BACK") }],
        ),
    ]
}
