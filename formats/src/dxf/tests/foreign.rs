//! Keys and layers of other programs: read, or said.

use super::*;
use crate::dxf::write::{Dialect, Drawing, PieceOptions, StyleText, piece_drawing, write};

#[test]
fn keys_of_other_programs_name_the_piece() {
    let w = Writer::default().pair(0, "SECTION").pair(2, "BLOCKS").block("B1").polyline("1", true, &RECTANGLE);
    let w = w.text("1", "PIECE: FRONT").text("1", "SIZE: 160/84A").text("1", "QTY: 2").text("1", "Mat: COTTON");
    let w = w.text("1", "LINING: NO").line("7", (60.0, 150.0), (60.0, 450.0)).pair(0, "ENDBLK").pair(0, "ENDSEC");
    let w = w.pair(0, "SECTION").pair(2, "ENTITIES").text("1", "Units: METRIC").pair(0, "ENDSEC").pair(0, "EOF");
    let pattern = good(&w.0);
    let piece = &pattern.pieces[0];
    assert_eq!((piece.label(), piece.size.as_deref(), piece.texts.quantity.plain), ("FRONT", Some("160/84A"), 2));
    assert_eq!(piece.texts.keys["material"], "COTTON");
    assert_eq!(codes(&pattern.findings), ["text-key-foreign", "text-key-unknown"]);
    assert!(pattern.findings[0].message.contains("`mat`, `piece`, `qty`"), "{}", pattern.findings[0].message);
    assert!(pattern.findings[1].message.contains("`lining`") && piece.texts.others[0].2 == "LINING: NO");
    // The keys of the standard come first.
    let both = good(&file(|w| {
        w.text("1", "PIECE: X").text("1", "Quantity: 3").text("1", "QTY: 1").polyline("1", true, &RECTANGLE)
    }));
    assert_eq!((both.pieces[0].label(), both.pieces[0].texts.quantity.plain), ("FRONT", 3));
}

#[test]
fn notches_on_3_and_drill_holes_on_2_are_used_and_said() {
    let text = file(|w| {
        let w = w.polyline("1", true, &RECTANGLE).line("3", (150.0, 0.0), (150.0, 5.0));
        let w = w.polyline("3", false, &[(300.0, 200.0), (295.0, 200.0)]);
        let w = w.pair(0, "CIRCLE").pair(8, "2").xy(150.0, 200.0).pair(40, "1.5");
        w.line("2", (20.0, 20.0), (200.0, 20.0)).point("14", 5.0, 5.0)
    });
    let pattern = good(&text);
    let piece = &pattern.pieces[0];
    assert_eq!((piece.notches.len(), piece.inside.drills.len()), (2, 1));
    assert!(piece.notches.iter().all(|n| n.on == "boundary" && (n.depth - 5.0).abs() < 1e-9));
    assert_eq!(piece.inside.drills[0].diameter, Some(3.0));
    let said = codes(&pattern.findings);
    assert_eq!(said.iter().filter(|c| **c == "layer-foreign").count(), 2, "{said:?}");
    // A long line on layer 2 and a point on layer 14 have no role: said, not only counted.
    assert_eq!(said.iter().filter(|c| **c == "entities-left-out").count(), 2, "{said:?}");
}

#[test]
fn outlines_on_another_layer_are_told_with_the_line_to_write() {
    let text = file(|w| w.polyline("CUT LINE", true, &RECTANGLE).line("GRAIN", (60.0, 150.0), (60.0, 450.0)));
    let refused = bad(&text);
    let without = refused.iter().find(|f| f.code == "no-pieces").expect("no piece");
    let hint = without.hint.as_deref().expect("remedy");
    assert!(hint.contains("`CUT LINE`, `GRAIN`"), "{hint}");
    assert!(hint.ends_with("with.layers = { \"CUT LINE\" = \"1\" }"), "{hint}");
    let read = |table: &[(&str, &str)]| {
        let layers = table.iter().map(|(a, b)| ((*a).to_owned(), (*b).to_owned())).collect();
        read(text.as_bytes(), "p.dxf", &ReadOptions { layers, ..ReadOptions::default() }).expect("a pattern")
    };
    assert_eq!(codes(&read(&[("CUT LINE", "1"), ("GRAIN", "7")]).findings), [""; 0]);
    // A layer that is not there is said; one that is to be left out is counted as such.
    let table = [("CUT LINE", "1"), ("SEW", "14"), ("GRAIN", "ignore")];
    assert_eq!(codes(&read(&table).findings), ["layer-not-in-file", "entities-left-out"]);
}

fn written(pattern: &Pattern, options: PieceOptions) -> Pattern {
    let garment = garment(pattern);
    let mut findings = Vec::new();
    let pieces = garment.pieces.iter().map(|p| piece_drawing(p, options, &mut findings)).collect();
    assert_eq!(findings, []);
    let bytes = write(&Drawing { style: StyleText::default(), pieces }, Dialect::Astm).expect("written").bytes;
    good(&String::from_utf8(bytes).expect("ascii"))
}

#[test]
fn cutouts_come_back_on_the_layer_they_came_from() {
    let square = |x: f64| [(x, 100.0), (x + 50.0, 100.0), (x + 50.0, 150.0), (x, 150.0)];
    let eye = [(150.0, 250.0), (157.0, 330.0), (150.0, 410.0), (143.0, 330.0)];
    let first = good(&file(|w| {
        let w =
            w.polyline("1", true, &RECTANGLE).polyline("1", true, &square(40.0)).polyline("11", true, &square(200.0));
        w.polyline("11", true, &eye)
    }));
    let second = written(&first, PieceOptions::default());
    for pattern in [&first, &second] {
        let piece = &pattern.pieces[0];
        assert_eq!((piece.darts.len(), piece.inside.cutouts.len(), piece.inside.internal.len()), (1, 3, 0));
        let on_one: Vec<f64> = piece
            .inside
            .cutouts
            .iter()
            .filter(|p| p.ids.iter().any(|id| piece.inside.on_boundary_layer.contains(id)))
            .map(|p| p.points[0].0.x)
            .collect();
        assert_eq!(on_one.len(), 1);
        assert!((40.0..=90.0).contains(&on_one[0]));
    }
}

#[test]
fn a_half_piece_keeps_its_fold_when_internal_lines_are_not_mirrored() {
    let first = good(&file(|w| {
        let w = w.polyline("1", true, &RECTANGLE).line("6", (0.0, 0.0), (0.0, 600.0));
        let w = w.line("8", (40.0, 200.0), (120.0, 220.0)).line("8", (40.0, 400.0), (120.0, 400.0));
        w.text_at("8", "NM", 40.0, 200.0)
    }));
    let whole = garment(&first);
    assert_eq!(whole.pieces[0].internal_lines.len(), 3);
    let second = written(&first, PieceOptions { half_on_fold: true, ..PieceOptions::default() });
    let piece = &second.pieces[0];
    assert!(piece.axes.fold.is_some() && (geom::area(&piece.boundary.positions()) - 180_000.0).abs() < 1e-6);
    assert_eq!(piece.inside.not_mirrored, [true, false]);
    assert_eq!(garment(&second).pieces[0].internal_lines.len(), 3);
    assert_eq!(piece.texts.others.iter().filter(|t| t.2 == "NM").count(), 1);
}

/// The rule table beside a pattern tells its unit.
#[test]
fn the_rule_table_tells_the_unit_of_a_pattern_without_one() {
    let small: Vec<(f64, f64)> = RECTANGLE.iter().map(|(x, y)| (x / 10.0, y / 10.0)).collect();
    let text = file_with(|w| w.polyline("1", true, &small).point("2", 0.0, 0.0), |w| w);
    let unit = |rules: Option<&str>| {
        let table = rules.map(|u| format!("UNITS: {u}\nNUMBER OF SIZES: 1\nSIZE LIST: 38\nSAMPLE SIZE: 38\nEND\n"));
        let seen = inspect(text.as_bytes(), "t.dxf", table.as_ref().map(|t| t.as_bytes())).expect("inspection");
        (seen.pattern.units.mm_per_unit, seen.pattern.findings[0].code.clone())
    };
    assert_eq!(unit(None), (10.0, "units-guessed".into()));
    assert_eq!(unit(Some("ENGLISH")), (25.4, "units-from-rules".into()));
}

fn said<'a>(pattern: &'a Pattern, code: &str) -> Vec<&'a str> {
    pattern.findings.iter().filter(|f| f.code == code).map(|f| f.message.as_str()).collect()
}

#[test]
fn a_quantity_under_a_foreign_key_is_never_lost_in_silence() {
    let with = |texts: &[&str]| {
        good(&file(|w| texts.iter().fold(w.polyline("1", true, &RECTANGLE), |w, text| w.text("1", text))))
    };
    let unclear = with(&["Qty: two pairs"]);
    assert_eq!(said(&unclear, "quantity-unclear"), ["`FRONT`: `Qty: two pairs` cannot be understood; 1 was taken"]);
    // The key of the standard says it.
    let told = with(&["Qty: two pairs", "Quantity: 2"]);
    assert_eq!((said(&told, "quantity-unclear").len(), told.pieces[0].texts.quantity.plain), (0, 2));
    let differ = with(&["Qty: 3", "Quantity: 2"]);
    assert_eq!((said(&differ, "text-contradicts").len(), differ.pieces[0].texts.quantity.plain), (1, 2));
    let twice = with(&["Qty: 3", "Amount: 4"]);
    assert_eq!((said(&twice, "text-contradicts").len(), twice.pieces[0].texts.quantity.plain), (1, 3));
    assert_eq!(said(&with(&["Qty: 2", "Quantity: 2"]), "text-contradicts").len(), 0);
}

#[test]
fn foreign_keys_of_the_style_are_understood_and_said() {
    let small = RECTANGLE.map(|(x, y)| (0.1 * x, 0.1 * y));
    let plain = file_with(|w| w.polyline("1", true, &small), |w| w.text("1", "Unit: CM"));
    let text = plain.replace("Style Name: TEST", "Style: TEST").replace("Sample Size: 38", "Sample: 38");
    let pattern = read(text.as_bytes(), "t.dxf", &ReadOptions::default()).expect("read");
    assert_eq!((pattern.units.mm_per_unit, pattern.sample_size.as_deref()), (10.0, Some("38")));
    assert_eq!(pattern.style.as_deref(), Some("TEST"));
    let told = said(&pattern, "text-key-foreign");
    assert_eq!(told.len(), 1);
    assert!(["`unit` as `units`", "`sample` as", "`style` as"].iter().all(|part| told[0].contains(part)), "{told:?}");
    assert!(said(&pattern, "units-guessed").is_empty());
    // The keys of the standard go before.
    let both = file_with(|w| w.polyline("1", true, &RECTANGLE), |w| w.text("1", "Model: X").text("1", "Units METRIC"));
    let pattern = good(&both);
    assert_eq!((pattern.style.as_deref(), pattern.units.mm_per_unit), (Some("TEST"), 1.0));
    assert_eq!(pattern.units.declared.as_deref(), Some("METRIC"));
}

#[test]
fn a_size_without_a_colon_is_read_and_said() {
    let text = file(|w| w.polyline("1", true, &RECTANGLE).text("1", "QTY 2").text("1", "SIZE CHART"));
    let pattern = good(&text.replace("SIZE: 38", "SIZE 38"));
    let piece = &pattern.pieces[0];
    assert_eq!((piece.size.as_deref(), piece.texts.quantity.plain), (Some("38"), 2));
    assert!(said(&pattern, "text-key-foreign").iter().any(|m| m.contains("`QTY 2`, `SIZE 38`")));
    assert_eq!(piece.texts.others.len(), 1, "a label stays a label");
    // Where a text says the size, the label beside it stays a label.
    let pattern = good(&file(|w| w.polyline("1", true, &RECTANGLE).text("1", "SIZE 40")));
    assert_eq!((pattern.pieces[0].size.as_deref(), said(&pattern, "text-key-foreign").len()), (Some("38"), 0));
}
