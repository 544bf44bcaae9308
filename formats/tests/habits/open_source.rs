//! Valentina, Seamly2D and FreeSewing.

use super::facts::{Case, Facts, plain, wedge};
use super::writer::{RECTANGLE, WEDGE, Writer, bytes_of, file, header, scaled};

/// With a comment, a release and blocks of drawing spaces, as dxfrw writes them.
fn valentina(release: &str, extra: &[(&str, i32, &str)], blocks: impl Fn(Writer) -> Writer) -> Vec<u8> {
    let mut variables = vec![("$ACADVER", 1, release)];
    variables.extend(extra);
    let head = Writer::default().pair(999, "dxfrw 1.0.1").0 + &header(&variables);
    file(
        &head,
        |w| blocks(w.block("$MODEL_SPACE", |w| w)),
        |w| w.insert("FRONT").text("1", "Style Name: V").text("1", "Units: METRIC"),
    )
}

fn stroke(w: Writer, at: (f64, f64)) -> Writer {
    // A V notch drawn with two strokes.
    w.line("4", at, (at.0 - 5.0, at.1 + 2.0)).line("4", (at.0 - 5.0, at.1 + 2.0), (at.0, at.1 + 4.0))
}

/// The cut line 10 mm round the rectangle.
const ROUND: [(f64, f64); 4] = [(-10.0, -10.0), (310.0, -10.0), (310.0, 610.0), (-10.0, 610.0)];

fn with_allowance(name: &'static str) -> Facts {
    Facts { area: 1984.0, perimeter: 1880.0, ..plain(name) }
}

fn classic() -> Vec<Case> {
    let named = |w: Writer, name: &str| w.text("1", &format!("Piece Name: {name}"));
    let r12 = valentina("AC1009", &[], |w| w.block("FRONT", |w| named(w, "FRONT").polyline("1", true, &WEDGE).grain()));
    let slash = valentina("AC1009", &[], |w| {
        w.block("FRONT/A", |w| w.polyline("1", true, &WEDGE).text("15", "FRONT/A").grain())
    });
    let details = valentina("AC1009", &[], |w| {
        w.block("DETAIL", |w| named(w, "A").polyline("1", true, &WEDGE).grain())
            .block("DETAIL", |w| named(w, "B").polyline("1", true, &RECTANGLE).grain())
    });
    let seam = valentina("AC1015", &[("$INSUNITS", 70, "4")], |w| {
        w.block("FRONT", |w| named(w, "FRONT").light("1", true, &ROUND).light("14", true, &WEDGE).grain())
    });
    let eight = valentina("AC1009", &[], |w| {
        w.block("FRONT", |w| named(w, "FRONT").polyline("1", true, &ROUND).polyline("8", true, &RECTANGLE).grain())
    });
    let strokes = valentina("AC1009", &[], |w| {
        w.block("FRONT", |w| stroke(named(w, "FRONT").polyline("1", true, &RECTANGLE).grain(), (300.0, 200.0)))
    });
    let kinds = valentina("AC1015", &[("$INSUNITS", 70, "4")], |w| {
        w.block("FRONT", |w| {
            let w = named(w, "FRONT").light("1", true, &RECTANGLE).grain();
            let w =
                w.point("80", (300.0, 100.0)).notch("5", "4", "180").point("81", (300.0, 200.0)).notch("5", "4", "180");
            w.point("83", (300.0, 300.0)).notch("5", "4", "180")
        })
    });
    let binary_like = valentina("AC1009", &[("$TDCREATE", 40, "2451544.9")], |w| {
        w.block("FRONT", |w| named(w, "FRONT").polyline("1", true, &WEDGE).grain())
    });
    vec![
        Case::new("valentina-r12", r12, vec![wedge("FRONT")]),
        Case::new("valentina-slash", slash, vec![Facts { name: None, ..wedge("") }]),
        Case::new("valentina-details", details, vec![wedge("A"), plain("B")]).tells(&["block-name-repeats"]),
        Case::new("valentina-seam-allowance", seam, vec![Facts { area: 1984.0, perimeter: 1880.0, ..wedge("FRONT") }]),
        Case::new("valentina-sew-line-on-8", eight, vec![with_allowance("FRONT")]),
        Case::new("valentina-strokes", strokes, vec![Facts { strokes: 1, ..plain("FRONT") }]),
        Case::new("valentina-kinds-of-notches", kinds, vec![Facts { marks: 3, ..plain("FRONT") }]).by("valentina"),
        Case::new("valentina-date-of-the-header", binary_like, vec![wedge("FRONT")]),
    ]
}

fn encodings() -> Vec<Case> {
    let text = |release: &str, pages: &[(&str, i32, &str)]| {
        valentina(release, pages, |w| {
            w.block("FRONT", |w| w.text("1", "Piece Name: XXXX").polyline("1", true, &WEDGE).grain())
        })
    };
    let utf8 = bytes_of(&text("AC1021", &[]), "XXXX", "Перёд".as_bytes());
    let cp1252 = bytes_of(&text("AC1015", &[("$DWGCODEPAGE", 3, "ANSI_1252")]), "XXXX", b"Vorderst\xFCck");
    let cp1251 = bytes_of(&text("AC1015", &[("$DWGCODEPAGE", 3, "ANSI_1251")]), "XXXX", b"\xCF\xE5\xF0\xE5\xE4");
    let escaped = bytes_of(&text("AC1015", &[]), "XXXX", b"\\U+524D\\U+7247");
    vec![
        Case::new("valentina-utf-8", utf8, vec![wedge("Перёд")]),
        Case::new("valentina-cp1252", cp1252, vec![wedge("Vorderstück")]),
        Case::new("valentina-cp1251", cp1251, vec![wedge("Перед")]),
        Case::new("valentina-escapes", escaped, vec![wedge("前片")]),
    ]
}

fn seamly() -> Vec<Case> {
    let free = |w: Writer| w.text("19", "Front").text("19", "Cut 2 on fabric");
    let labels = valentina("AC1009", &[], |w| {
        w.block("FRONT", |w| {
            stroke(free(w.polyline("1", true, &ROUND).polyline("8", true, &RECTANGLE).grain()), (310.0, 200.0))
        })
    });
    let cm = scaled(&WEDGE, 0.1);
    let centimetres = file(
        &header(&[("$ACADVER", 1, "AC1015"), ("$INSUNITS", 70, "5")]),
        |w| w.block("FRONT", |w| w.text("1", "Piece Name: FRONT").light("1", true, &cm).grain()),
        |w| w.insert("FRONT"),
    );
    let half = valentina("AC1009", &[], |w| {
        w.block("FRONT", |w| {
            let sew = [(0.0, 600.0), (0.0, 600.0), (290.0, 600.0), (290.0, 10.0), (0.0, 10.0)];
            let w = w.text("1", "Piece Name: FRONT").polyline("1", true, &RECTANGLE).polyline("14", false, &sew[1..]);
            w.line("6", (0.0, 0.0), (0.0, 600.0)).grain()
        })
    });
    vec![
        Case::new("seamly-labels-and-strokes", labels, vec![Facts { name: None, strokes: 1, ..with_allowance("") }]),
        Case::new("seamly-centimetres", centimetres, vec![wedge("FRONT")]).unit(10.0),
        // The sew line is open at the fold: 290 × 590 mm of the half.
        Case::new("sew-line-open-at-the-fold", half, vec![Facts { half: true, net_area: 1711.0, ..plain("FRONT") }]),
    ]
}

pub fn cases() -> Vec<Case> {
    [classic(), encodings(), seamly()].concat()
}
