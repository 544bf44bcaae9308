//! Every doubt is said: one fixture for each.

use super::*;

/// The outline with something more in its block.
fn with(more: impl Fn(Writer) -> Writer) -> String {
    file(|w| more(w.polyline("1", true, &RECTANGLE)))
}

/// The codes of a file that is read.
fn said(text: &str) -> Vec<String> {
    good(text).findings.iter().map(|f| f.code.clone()).collect()
}

fn shifted(by: (f64, f64), scale: f64) -> Vec<(f64, f64)> {
    RECTANGLE.iter().map(|(x, y)| (x * scale + by.0, y * scale + by.1)).collect()
}

/// Another block, put behind the first one.
fn and_block(text: &str, block: &Writer) -> String {
    text.replacen("  0\nENDBLK\n", &format!("  0\nENDBLK\n{}  0\nENDBLK\n", block.0), 1)
}

#[test]
fn outlines_that_meet_themselves() {
    let bow = [(0.0, 0.0), (300.0, 0.0), (150.0, 300.0), (100.0, 400.0), (200.0, 400.0), (150.0, 300.0)];
    assert_eq!(codes(&bad(&file(|w| w.polyline("1", true, &bow)))), ["outline-crosses-itself"]);
    let pinch = [(0.0, 0.0), (300.0, 0.0), (150.0, 300.0), (300.0, 600.0), (0.0, 600.0), (150.0, 300.0)];
    let on_edge = [(0.0, 0.0), (300.0, 0.0), (300.0, 600.0), (150.0, 0.0), (0.0, 600.0)];
    for line in [pinch.as_slice(), &on_edge] {
        assert_eq!(said(&file(|w| w.polyline("1", true, line))), ["outline-touches-itself"]);
    }
    let mut spike = RECTANGLE.to_vec();
    spike.splice(3..3, [(70.0, 600.0), (70.0, 640.0), (70.0, 600.0)]);
    assert_eq!(said(&file(|w| w.polyline("1", true, &spike))), ["outline-spike"]);
    spike[4] = (70.0, 560.0);
    assert!(!said(&file(|w| w.polyline("1", true, &spike))).iter().any(|c| c.starts_with("outline")));
}

#[test]
fn sew_lines_outside_across_and_far_inside() {
    let outside = shifted((-5.0, -5.0), 1.05);
    let pattern = good(&with(|w| w.polyline("14", true, &outside)));
    assert_eq!(codes(&pattern.findings), ["sew-line-outside"]);
    assert!(pattern.pieces[0].sew.is_none() && pattern.pieces[0].inside.internal.len() == 1);
    let across = good(&with(|w| w.polyline("14", true, &shifted((150.0, 10.0), 0.9))));
    assert_eq!(codes(&across.findings), ["sew-line-crosses"]);
    let far = [(60.0, 10.0), (290.0, 10.0), (290.0, 440.0), (60.0, 440.0)];
    assert_eq!(said(&with(|w| w.polyline("14", true, &far))), ["sew-line-far"]);
    let sound = [(10.0, 10.0), (290.0, 10.0), (290.0, 560.0), (10.0, 560.0)];
    assert_eq!(said(&with(|w| w.polyline("14", true, &sound))), [] as [&str; 0]);
}

#[test]
fn inserts_in_blocks_again_and_from_behind() {
    let inner = Writer::default().block("INNER").polyline("1", true, &RECTANGLE);
    let nested = |codes: &[(i32, &str)]| {
        let text =
            file(|w| codes.iter().fold(w.pair(0, "INSERT").pair(8, "1").pair(2, "INNER"), |w, (c, v)| w.pair(*c, v)));
        said(&and_block(&text, &inner))
    };
    assert_eq!(nested(&[(41, "2"), (42, "2")]), ["insert-transformed"]);
    assert_eq!(nested(&[(41, "-1")]), ["insert-mirrored"]);
    let again = |codes: &[(i32, &str)]| {
        file_with(
            |w| w.polyline("1", true, &RECTANGLE),
            |w| {
                let w = w.text("1", "Units: METRIC").pair(0, "INSERT").pair(8, "1").pair(2, "FRONT_38");
                codes.iter().fold(w, |w, (c, v)| w.pair(*c, v))
            },
        )
    };
    for second in [[(41, "2"), (42, "2")], [(41, "-1"), (42, "1")]] {
        let pattern = good(&again(&second));
        assert_eq!(codes(&pattern.findings), ["insert-repeated"]);
        assert!(pattern.ledger.by_rule().keys().all(|(_, rule)| !rule.ends_with("the piece is mirrored")));
    }
    let behind = with(|w| w).replacen("INSERT\n", "INSERT\n230\n-1\n", 1);
    assert_eq!(said(&behind), ["insert-mirrored"]);
}

/// Pieces that no INSERT places, and quantities that INSERTs and texts tell differently.
#[test]
fn inserts_that_are_missing_or_too_many() {
    let other = |w: Writer| w.polyline("1", true, &RECTANGLE).text("1", "Piece Name: OTHER").text("1", "Size: 38");
    let other = |w: Writer| other(w).line("7", (50.0, 50.0), (50.0, 400.0));
    let lonely = and_block(&with(|w| w), &other(Writer::default().block("OTHER_38")));
    assert_eq!(said(&lonely), ["block-not-inserted"]);
    assert_eq!(good(&lonely).pieces.len(), 2, "it is read all the same");
    let twice = |quantity: &str| {
        let insert = |w: Writer| w.pair(0, "INSERT").pair(8, "1").pair(2, "FRONT_38");
        let block = |w: Writer| w.polyline("1", true, &RECTANGLE).text("1", &format!("Quantity: {quantity}"));
        file_with(block, |w| insert(w.text("1", "Units: METRIC")))
    };
    assert_eq!(said(&twice("2")), [] as [&str; 0]);
    assert_eq!(said(&twice("1")), ["text-contradicts"]);
    assert_eq!(said(&with(|w| w.text("1", "Quantity: 0"))), ["quantity-unclear"]);
}

#[test]
fn blocks_in_blocks_without_end_are_refused_at_once() {
    let inner = |name: &str, of: &str| {
        (0..60).fold(Writer::default().block(name), |w, _| w.pair(0, "INSERT").pair(8, "1").pair(2, of))
    };
    let mut text = file(|w| w.polyline("1", true, &RECTANGLE).pair(0, "INSERT").pair(8, "1").pair(2, "A"));
    for (name, of) in [("A", "B"), ("B", "C"), ("C", "D")] {
        text = and_block(&text, &inner(name, of));
    }
    let e = bad(&and_block(&text, &Writer::default().block("D").point("13", 1.0, 1.0)));
    assert_eq!(codes(&e), ["insert-too-many"]);
}

#[test]
fn cutouts_that_cannot_be_cut() {
    let square = |x: f64, y: f64| [(x, y), (x + 50.0, y), (x + 50.0, y + 50.0), (x, y + 50.0)];
    assert_eq!(said(&with(|w| w.polyline("11", true, &square(100.0, 100.0)))), [] as [&str; 0]);
    let open = square(100.0, 100.0);
    let bow = [(50.0, 50.0), (100.0, 100.0), (100.0, 50.0), (50.0, 100.0)];
    let cases = [
        ("cutout-outside", square(280.0, 100.0)),
        ("cutout-outside", square(450.0, 100.0)),
        ("cutout-outside", RECTANGLE),
        ("cutout-crosses-itself", bow),
    ];
    for (code, line) in cases {
        assert_eq!(said(&with(|w| w.polyline("11", true, &line))), [code]);
    }
    assert_eq!(said(&with(|w| w.polyline("11", false, &open))), ["cutout-open"]);
    let two = with(|w| w.polyline("11", true, &square(100.0, 100.0)).polyline("11", true, &square(130.0, 100.0)));
    assert_eq!(said(&two), ["cutouts-overlap"]);
}

#[test]
fn sizes_and_pieces_that_do_not_fit() {
    let block = |block: &str, name: &str, size: &str, line: &[(f64, f64)]| {
        let w = Writer::default()
            .block(block)
            .text("1", &format!("Piece Name: {name}"))
            .text("1", &format!("SIZE: {size}"));
        w.polyline("1", true, line).points("2", line).line("7", (60.0, 150.0), (60.0, 450.0))
    };
    let base = file(|w| w.polyline("1", true, &WEDGE).points("2", &WEDGE));
    let cases = [
        (base.clone(), block("FRONT_36", "FRONT", "36", &RECTANGLE), vec!["sizes-differ-in-vertices"]),
        (base.clone(), block("A2", "FRONT", "38", &WEDGE), vec!["piece-repeats"]),
        (
            base.replace("Sample Size: 38", "Sample Size: 44"),
            block("FRONT_36", "FRONT", "36", &WEDGE),
            vec!["sample-size-missing"],
        ),
        (
            base.replace("Sample Size: 38", "None"),
            block("FRONT_36", "FRONT", "36", &WEDGE),
            vec!["entities-left-out", "sample-size-missing"],
        ),
        (base.clone(), block("BACK_36", "BACK", "36", &RECTANGLE), vec!["piece-lacks-size", "piece-lacks-size"]),
    ];
    for (text, more, expected) in cases {
        let name = more.0.lines().nth(5).expect("the name of the block").to_owned();
        assert_eq!(said(&inserting(&and_block(&text, &more), &name)), expected);
    }
}

#[test]
fn texts_that_say_nothing_or_two_things() {
    for (quantity, expected) in
        [("1+1", vec![]), ("2 PAIR", vec![]), ("abc", vec!["quantity-unclear"]), ("1,1,1", vec!["quantity-unclear"])]
    {
        assert_eq!(said(&with(|w| w.text("1", &format!("Quantity: {quantity}")))), expected, "{quantity}");
    }
    assert_eq!(said(&with(|w| w.text("1", "Piece Name: BACK"))), ["text-contradicts"]);
    let twice = |other: &str| with(|w| w.text("1", "Quantity: 2").text("1", &format!("Quantity: {other}")));
    assert_eq!(said(&twice("3")), ["text-contradicts"]);
    assert_eq!(said(&twice("2,0")), [] as [&str; 0]);
    assert_eq!(said(&with(|w| w).replace("Piece Name: FRONT", "none")), ["piece-name-missing"]);
    let m_text =
        with(|w| w.pair(0, "MTEXT").pair(8, "1").xy(0.0, 0.0).pair(1, r"{\fArial;Material: SILK\PQuantity: 3}"));
    let piece = &good(&m_text).pieces[0];
    assert_eq!((piece.texts.keys["material"].as_str(), piece.texts.quantity.plain), ("SILK", 3));
    let named = with(|w| w.pair(0, "ATTDEF").pair(8, "1").xy(0.0, 0.0).pair(1, "SILK").pair(2, "Material"));
    assert_eq!(good(&named).pieces[0].texts.keys["material"], "SILK");
    let loose = file_with(
        |w| w.polyline("1", true, &RECTANGLE),
        |w| {
            let w = w.text("1", "Units: METRIC").point("4", 300.0, 100.0);
            w.pair(0, "ATTRIB").pair(8, "1").xy(0.0, 0.0).pair(1, "SILK").pair(2, "Material")
        },
    );
    assert_eq!(said(&loose), ["lines-outside-blocks", "entities-left-out"]);
    let attribute =
        |w: Writer, tag: &str, value: &str| w.pair(0, "ATTRIB").pair(8, "1").xy(0.0, 0.0).pair(1, value).pair(2, tag);
    let inserted = |more: &dyn Fn(Writer) -> Writer| {
        let of_block = |w: Writer| w.polyline("1", true, &RECTANGLE).pair(0, "ATTDEF").pair(8, "1").xy(0.0, 0.0);
        let text = file(|w| of_block(w).pair(1, "COTTON").pair(2, "Material"));
        let insert = Writer::default().pair(0, "INSERT").pair(8, "1").pair(2, "FRONT_38").xy(0.0, 0.0);
        let first = more(attribute(attribute(insert, "Material", "SILK"), "COLOUR", "RED")).pair(0, "SEQEND").0;
        text.replacen("  0\nINSERT\n  8\n1\n  2\nFRONT_38\n 10\n0\n 20\n0\n", &first, 1)
    };
    let pattern = good(&inserted(&|w| w));
    assert_eq!(codes(&pattern.findings), ["text-key-unknown"]);
    assert!(pattern.findings[0].message.contains("`colour`"));
    let piece = &pattern.pieces[0];
    assert_eq!((piece.texts.keys["material"].as_str(), piece.texts.others[0].2.as_str()), ("SILK", "COLOUR: RED"));
    let again = |material: &str| {
        let second = |w: Writer| w.pair(0, "INSERT").pair(8, "1").pair(2, "FRONT_38").xy(0.0, 0.0);
        said(&inserted(&|w| attribute(second(w), "Material", material)))
    };
    assert_eq!(again("SILK"), ["text-key-unknown"]);
    assert_eq!(again("WOOL"), ["entities-left-out", "text-key-unknown"]);
    let two =
        file_with(|w| w.polyline("1", true, &RECTANGLE), |w| w.text("1", "Units: METRIC").text("1", "Units: ENGLISH"));
    assert_eq!(said(&two), ["units-contradict"]);
}

#[test]
fn folds_points_and_marks_out_of_place() {
    let half = |w: Writer| w.polyline("1", true, &RECTANGLE);
    let split = good(&file(|w| half(w).line("6", (0.0, 0.0), (0.0, 300.0)).line("6", (0.0, 600.0), (0.0, 300.0))));
    assert!(split.pieces[0].axes.fold.is_some() && split.findings.is_empty());
    let two = good(&file(|w| half(w).line("6", (0.0, 0.0), (0.0, 600.0)).line("6", (0.0, 0.0), (300.0, 0.0))));
    assert_eq!((codes(&two.findings), two.pieces[0].axes.fold.is_some()), (vec!["fold-second"], true));
    assert_eq!(said(&with(|w| w.points("2", &[(100.0, 300.0), (200.0, 300.0)]))), ["points-off-vertices"]);
    assert_eq!(said(&with(|w| w.point("13", 400.0, 100.0))), ["mark-outside"]);
    assert_eq!(said(&with(|w| w.line("8", (100.0, 300.0), (1300.0, 300.0)))), ["mark-outside"]);
    assert_eq!(said(&with(|w| w.line("8", (100.0, 300.0), (320.0, 300.0)))), [] as [&str; 0]);
    assert_eq!(said(&with(|w| w.point("4", 300.0, 100.0).pair(30, "500"))), ["notch-too-large"]);
    let slope = with(|w| w).replacen(" 10\n300\n", " 10\n300\n 30\n400\n", 1);
    assert_eq!(said(&slope), ["line-not-flat"]);
}

#[test]
fn bytes_that_are_no_text() {
    let plain = wedge_file();
    assert_wedge(&good(&format!("{plain}{}", "\0".repeat(700))));
    let e = bad("\u{1}\u{2}\nx\n");
    assert!(e[0].message.contains("2 byte(s) that are no text"), "{}", e[0].message);
}

#[test]
fn rule_tables_that_do_not_belong() {
    let text = file(|w| w.polyline("1", true, &RECTANGLE).points("2", &RECTANGLE).text_at("2", "# 3", 300.0, 600.0));
    let text = text.replace("Style Name: TEST", "Grade Rule Table: T");
    let rul = "UNITS: METRIC\nGRADE RULE TABLE: T\nNUMBER OF SIZES: 2\nSIZE LIST: 38 40\nSAMPLE SIZE: 38\nRULE: DELTA 3\n0 0 10 6\nEND\n";
    let look = |rul: &str| {
        let inspection = inspect(text.as_bytes(), "t.dxf", Some(rul.as_bytes())).expect("pieces");
        inspection.pattern.findings.iter().map(|f| f.code.clone()).collect::<Vec<_>>()
    };
    assert_eq!(look(rul), [] as [&str; 0]);
    // Sizes that only the rules make are listed, as they can be asked for.
    let shown = inspect(text.as_bytes(), "t.dxf", Some(rul.as_bytes())).expect("pieces").text;
    assert!(shown.contains("\nsizes 38  by grade rules 40  sample 38\n"), "{shown}");
    let cases = [
        (rul.replace("TABLE: T", "TABLE: U"), vec!["rule-table-differs"]),
        (
            rul.replace("SAMPLE SIZE: 38", "SAMPLE SIZE: 40").replace("0 0 10 6", "-10 -6 0 0"),
            vec!["rule-table-differs"],
        ),
        (rul.replace("DELTA 3", "DELTA 4"), vec!["rules-missing"]),
        (rul.replace("METRIC", "ENGLISH"), vec!["rule-growth-doubtful"]),
        (rul.replace("END\n", ""), vec!["rule-end-missing"]),
        (String::new(), vec!["rule-table-broken", "rule-without-sizes"]),
        (rul.replace("SIZES: 2", "SIZES: 4"), vec!["rule-table-broken", "rule-sizes-differ"]),
    ];
    for (rul, expected) in cases {
        assert_eq!(look(&rul), expected, "{rul}");
    }
    let broken =
        inspect(text.as_bytes(), "t.dxf", Some(rul.replace("SIZES: 2", "SIZES: 4").as_bytes())).expect("pieces");
    assert_eq!(broken.pattern.findings[1].source.as_ref().and_then(|s| s.line), Some(3));
}
