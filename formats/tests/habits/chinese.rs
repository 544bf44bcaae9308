//! Richpeace, ET, Boke: no blank after the colon, GBK, numbers of layers of their own.

use super::facts::{Case, Facts, plain, wedge};
use super::writer::{RECTANGLE, WEDGE, Writer, bytes_of, file, header};

fn richpeace(body: impl Fn(Writer) -> Writer) -> Vec<u8> {
    file(
        &header(&[]),
        |w| w.block("FRONT_M1", |w| body(w.text("1", "Piece Name:FRONT").text("1", "SAMPLE SIZE:M")).grain()),
        |w| {
            let w =
                w.insert("FRONT_M1").text("1", "Style Name:S350").text("1", "Sample Size:M").text("1", "Units:METRIC");
            w.text("1", "Creation Date:11-24-2017").text("1", "Grade Rule Table:NAME")
        },
    )
}

fn m(facts: Facts) -> Facts {
    Facts { size: Some("M"), ..facts }
}

pub fn cases() -> Vec<Case> {
    let closed_twice = |w: Writer| {
        let mut line = WEDGE.to_vec();
        line.push(WEDGE[0]);
        w.polyline("1", true, &line).points("2", &WEDGE)
    };
    let teeth = |w: Writer| {
        let w = w.polyline("1", true, &WEDGE).points("2", &WEDGE).point("80", (300.0, 200.0)).notch("6", "4", "180");
        w.text("8", "# 0").text("7", "# 0").polyline("8", false, &[(20.0, 20.0), (120.0, 40.0), (220.0, 20.0)])
    };
    let doubled = |w: Writer| {
        let w = w.polyline("1", true, &WEDGE).points("2", &WEDGE);
        (0..2).fold(w, |w, _| w.point("4", (300.0, 200.0)).notch("6", "0", "180"))
    };
    let rules = |w: Writer| {
        let w = w.polyline("1", true, &RECTANGLE).points("2", &RECTANGLE);
        (0..4).fold(w, |w, i| w.text_at("2", &format!("# {}", i + 1), RECTANGLE[i]))
    };
    let boke = "UNITS: METRIC\nNUMBER OF SIZES: 2\nSIZE LIST: M L\nSAMPLE SIZE: M\nRULE: DELTA 1\n0 0\n0 0\n\
        RULE: DELTA 2\n0 0\n12 0\nRULE: DELTA 3\n0 0\n12 5\nRULE: DELTA 4\n0 0\n0 5\nEND\n";
    let gbk = bytes_of(&richpeace(closed_twice), "Grade Rule Table:NAME", b"Grade Rule Table:\xB9\xE6\xD4\xF2\xB1\xED");
    let other = |w: Writer| w.polyline("1", true, &WEDGE).point("3", (300.0, 200.0)).point("2", (150.0, 490.0));
    let nest = file(
        "",
        |w| {
            let big = [(0.0, 0.0), (310.0, 0.0), (310.0, 620.0), (0.0, 620.0)];
            w.block("FRONT_M1", |w| {
                w.text("1", "Piece Name:FRONT")
                    .text("1", "SIZE:M")
                    .polyline("1", true, &RECTANGLE)
                    .points("2", &RECTANGLE)
                    .grain()
            })
            .block("FRONT_L2", |w| {
                w.text("1", "Piece Name:FRONT").text("1", "SIZE:L").polyline("1", true, &big).grain()
            })
        },
        |w| w.text("1", "Style Name:N").text("1", "Sample Size:M").text("1", "Units:METRIC"),
    );
    vec![
        Case::new("richpeace-closed-twice", richpeace(closed_twice), vec![m(wedge("FRONT"))]),
        Case::new("richpeace-t-notch", richpeace(teeth), vec![m(Facts { marks: 1, internal: 1, ..wedge("FRONT") })])
            .by("richpeace"),
        Case::new("richpeace-gbk", gbk, vec![m(wedge("FRONT"))]).tells(&["encoding-guessed"]),
        Case::new("richpeace-notch-twice", richpeace(doubled), vec![m(Facts { marks: 1, ..wedge("FRONT") })]),
        Case::new("boke-one-pair-a-line", richpeace(rules), vec![m(plain("FRONT"))]).graded(
            boke,
            "FRONT",
            "L",
            &[(0.0, 0.0), (312.0, 0.0), (312.0, 605.0), (0.0, 605.0)],
        ),
        Case::new("et-layers", richpeace(other), vec![m(Facts { marks: 1, drills: 1, ..wedge("FRONT") })])
            .layers(&[("3", "4"), ("2", "13")]),
        Case::new(
            "richpeace-nest",
            nest,
            // 310 × 620 mm.
            vec![
                m(plain("FRONT")),
                Facts { size: Some("L"), area: 1922.0, net_area: 1922.0, perimeter: 1860.0, ..plain("FRONT") },
            ],
        ),
    ]
}
