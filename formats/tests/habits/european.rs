//! Lectra, Grafis, Assyst, PolyPattern, Browzwear: what their documentation and public tests tell of their files.

use super::facts::{Case, Facts, plain, wedge};
use super::writer::{RECTANGLE, WEDGE, Writer, file, moved};

/// One block with a body, and more in ENTITIES.
fn one(block: &str, body: impl Fn(Writer) -> Writer, more: impl Fn(Writer) -> Writer) -> Vec<u8> {
    file("", |w| w.block(block, |w| body(w).grain()), |w| more(w.insert(block)))
}

fn metric(w: Writer) -> Writer {
    w.text("1", "Style Name: S").text("1", "Units: METRIC")
}

fn front(w: Writer) -> Writer {
    w.text("1", "Piece Name: FRONT").text("1", "Size: 38")
}

fn s38(facts: Facts) -> Facts {
    Facts { size: Some("38"), ..facts }
}

fn lectra() -> Vec<Case> {
    let author = |w: Writer| metric(w).text("1", "Author: LECTRA").text("1", "Product: MODARIS V8");
    let body = |w: Writer| front(w).polyline("1", true, &WEDGE).points("2", &WEDGE);
    let marked = |w: Writer| {
        let w = front(w).polyline("1", true, &RECTANGLE).points("2", &RECTANGLE);
        w.line("8", (135.0, 600.0), (150.0, 500.0)).line("8", (165.0, 600.0), (150.0, 500.0))
    };
    let eye = |w: Writer| {
        let lens = [(150.0, 450.0), (160.0, 300.0), (150.0, 150.0), (140.0, 300.0)];
        front(w).polyline("1", true, &RECTANGLE).points("2", &RECTANGLE).polyline("11", true, &lens)
    };
    let marked_dart = Facts { darts: vec![("internal_line", (150.0, 500.0))], internal: 2, ..plain("FRONT") };
    let lens = Facts { darts: vec![("contour", (150.0, 150.0))], cutouts: 1, ..plain("FRONT") };
    let spaced = |w: Writer| body(w).text("1", "Quantity: 2").text("1", "Category: shell");
    vec![
        Case::new("lectra-plain", one("FRONT 38", body, author), vec![s38(wedge("FRONT"))]).by("lectra"),
        Case::new("lectra-marked-dart", one("FRONT", marked, author), vec![s38(marked_dart)]).by("lectra"),
        Case::new("lectra-cutout-dart", one("FRONT", eye, author), vec![s38(lens)]).by("lectra"),
        Case::new(
            "lectra-quantity",
            one("FRONT", spaced, author),
            vec![s38(Facts { quantity: [2, 0], ..wedge("FRONT") })],
        )
        .by("lectra"),
    ]
}

fn polypattern() -> Vec<Case> {
    let style =
        |w: Writer| metric(w).text("1", "Author: POLYPATTERN").text("1", "Tolerance: 0,2").text("1", "Sample Size: 38");
    let open = |w: Writer| front(w).repeated("1", &WEDGE).text("1", "Quantity: 1,0");
    let rules = |w: Writer| {
        let w = front(w).repeated("1", &RECTANGLE).points("2", &RECTANGLE);
        w.text_at("2", "# 1", RECTANGLE[0]).text_at("2", "# 2", RECTANGLE[2])
    };
    let table = "ANSI/AAMA VERSION: 1.0.0\nUNITS: METRIC\nNUMBER OF SIZES: 2\nSIZE LIST: 38 40\nSAMPLE SIZE: 38\n\
        RULE: DELTA 1 0 0 0 0\nRULE: DELTA 2 0 0 8 6\nEND\n";
    vec![
        Case::new("polypattern-open", one("FRONT_38", open, style), vec![s38(wedge("FRONT"))]).by("polypattern"),
        // Between the two graded corners the others move by their share of the way: one third and two thirds of it.
        Case::new("polypattern-rule-on-one-line", one("FRONT_38", rules, style), vec![s38(plain("FRONT"))]).graded(
            table,
            "FRONT",
            "40",
            &[(0.0, 0.0), (308.0, 606.0), (300.0 + 8.0 / 3.0, 2.0)],
        ),
    ]
}

fn grafis_assyst() -> Vec<Case> {
    let aama = |w: Writer| metric(w).text("1", "Author: GRAFIS").text("1", "Version: ANSI/AAMA-292");
    let short = |w: Writer| w.text("1", "Piece Name: RFRONT01").polyline("1", true, &WEDGE).points("2", &WEDGE);
    let runs = |w: Writer| front(w).runs("1", &WEDGE).points("2", &WEDGE);
    let backwards = |w: Writer| {
        // Runs out of order, every second one backwards.
        let n = WEDGE.len();
        [3, 0, 5, 1, 6, 4, 2].iter().fold(front(w), |w, i| {
            let (a, b) = (WEDGE[*i], WEDGE[(*i + 1) % n]);
            if i % 2 == 0 { w.polyline("1", false, &[a, b]) } else { w.polyline("1", false, &[b, a]) }
        })
    };
    let assyst = |w: Writer| metric(w).text("1", "Author: ASSYST;CAD.ASSYST;2020");
    let alternate = |w: Writer| {
        let w = front(w).polyline("1", true, &RECTANGLE).points("2", &RECTANGLE);
        let w = w.line("5", (10.0, 10.0), (90.0, 10.0)).line("5", (20.0, 20.0), (20.0, 90.0));
        w.text_at("2", "# 1", RECTANGLE[0]).text_at("2", "# 2, 1", RECTANGLE[2])
    };
    let table = "UNITS: METRIC\nNUMBER OF SIZES: 2\nSIZE LIST: 38 40\nSAMPLE SIZE: 38\n\
        RULE: DELTA 1\n0 0 0 0\nRULE: DELTA 2\n0 0 6 0\nEND\n";
    let sample = |w: Writer| assyst(w).text("1", "Sample Size: 38");
    vec![
        Case::new("grafis-short-names", one("RFRONT01", short, aama), vec![wedge("RFRONT01")]).by("grafis"),
        Case::new("grafis-runs", one("FRONT", runs, aama), vec![s38(wedge("FRONT"))]).by("grafis"),
        Case::new("assyst-runs-backwards", one("FRONT", backwards, assyst), vec![s38(wedge("FRONT"))]).by("assyst"),
        // The second rule grows along the alternate line, which is +y.
        Case::new("assyst-alternate-line", one("FRONT", alternate, sample), vec![s38(plain("FRONT"))]).graded(
            table,
            "FRONT",
            "40",
            &[(0.0, 0.0), (300.0, 606.0)],
        ),
        Case::new(
            "assyst-mirrored-pair",
            file(
                "",
                |w| w.block("FRONT", |w| front(w).polyline("1", true, &WEDGE).grain()),
                |w| assyst(w.insert("FRONT").insert("FRONT").pair(41, "-1").pair(42, "1")),
            ),
            vec![s38(Facts { quantity: [1, 1], ..wedge("FRONT") })],
        ),
    ]
}

fn browzwear() -> Vec<Case> {
    let style = |w: Writer| metric(w).text("1", "Author: Browzwear VStitcher").text("1", "Creation Date: 11-24-2017");
    let raised = |w: Writer| {
        let w = front(w).polyline("1", true, &WEDGE).points("2", &WEDGE);
        let w = w.point("4", (300.0, 200.0)).notch("0.7", "0", "0").pair(38, "0.7").point("1", (300.0, 200.0));
        w.pair(0, "TEXT").pair(8, "1").xy(10, (1.0, 1.0))
    };
    let placed = |w: Writer| style(w.pair(0, "INSERT").pair(8, "1").pair(2, "GONE_M").xy(10, (50.0, 2.0)));
    let away = moved(&WEDGE, -500.0, -900.0);
    let negative = |w: Writer| front(w).polyline("1", true, &away).points("2", &away);
    vec![
        Case::new(
            "browzwear-depth-in-cm",
            one("FRONT_38", raised, style),
            vec![s38(Facts { marks: 1, ..wedge("FRONT") })],
        )
        .by("browzwear"),
        Case::new(
            "browzwear-missing-block",
            one("FRONT_38", raised, placed),
            vec![s38(Facts { marks: 1, ..wedge("FRONT") })],
        )
        .tells(&["block-missing"]),
        Case::new(
            "browzwear-far-from-the-origin",
            one("FRONT_38", negative, style),
            vec![s38(Facts { darts: vec![("boundary_wedge", (-350.0, -400.0))], ..wedge("FRONT") })],
        ),
    ]
}

pub fn cases() -> Vec<Case> {
    [lectra(), polypattern(), grafis_assyst(), browzwear()].concat()
}
