//! Blocks, inserts, units, layers.

use super::*;

#[test]
fn units_declared_guessed_and_doubted() {
    let none = good(&file_with(|w| w.polyline("1", true, &WEDGE), |w| w));
    assert_eq!((none.units.mm_per_unit, codes(&none.findings)), (1.0, vec!["units-guessed"]));
    let wrong = good(&file_with(|w| w.polyline("1", true, &WEDGE), |w| w.text("1", "UNITS:ENGLISH")));
    assert_eq!((wrong.units.mm_per_unit, codes(&wrong.findings)), (1.0, vec!["units-doubtful"]));
    assert_eq!(wrong.units.declared.as_deref(), Some("ENGLISH"));
    let inches: Vec<(f64, f64)> = RECTANGLE.iter().map(|(x, y)| (x / 25.4, y / 25.4)).collect();
    let inch = good(&file_with(|w| w.polyline("1", true, &inches), |w| w.text("1", "Units: ENGLISH")));
    assert_eq!(inch.units.mm_per_unit, 25.4);
    assert!((geom::area(&inch.pieces[0].boundary.positions()) - 180_000.0).abs() < 1e-3);
    let options = ReadOptions { mm_per_unit: Some(10.0), ..ReadOptions::default() };
    let asked = read(wedge_file().as_bytes(), "t.dxf", &options).expect("asked");
    assert_eq!(asked.units.mm_per_unit, 10.0);
}

#[test]
fn inserts_missing_recursive_transformed_mirrored() {
    let missing = good(&file_with(
        |w| w.polyline("1", true, &WEDGE),
        |w| w.text("1", "Units: METRIC").pair(0, "INSERT").pair(8, "1").pair(2, "GONE").xy(0.0, 0.0),
    ));
    assert_eq!(codes(&missing.findings), ["block-missing"]);
    let recursive = good(&file(|w| w.polyline("1", true, &WEDGE).pair(0, "INSERT").pair(8, "1").pair(2, "FRONT_38")));
    assert_wedge(&recursive);
    assert_eq!(codes(&recursive.findings), ["insert-recursive"]);
    let insert = |tail: &str| wedge_file().replace("\nINSERT\n", &format!("\nINSERT\n{tail}"));
    let turned = insert(" 41\n2\n 42\n2\n 50\n90\n");
    let doubled = good(&turned);
    assert_eq!(codes(&doubled.findings), ["insert-transformed"]);
    let apex = |p: &Pattern| p.pieces[0].darts[0].apexes[0];
    assert_eq!(apex(&doubled), toile_garment::Vec2::new(300.0, 1000.0));
    assert!((doubled.pieces[0].darts[0].width() - 60.0).abs() < 1e-9);
    let with = |inserts| read(turned.as_bytes(), "t.dxf", &ReadOptions { inserts, ..ReadOptions::default() });
    assert_wedge(&with(InsertRule::Ignored).expect("as drawn"));
    // (150, 500) twice as large, and a quarter turn to the left.
    let placed = apex(&with(InsertRule::Placed).expect("placed"));
    assert!((placed - toile_garment::Vec2::new(-1000.0, 300.0)).norm() < 1e-9, "{placed}");
    let mirrored = good(&insert(" 41\n-1\n"));
    assert_eq!(codes(&mirrored.findings), ["insert-mirrored"]);
    assert!((mirrored.pieces[0].darts[0].apexes[0].x + 150.0).abs() < 1e-9);
    assert!(geom::area(&mirrored.pieces[0].boundary.positions()) > 0.0);
}

#[test]
fn a_block_of_inserts_is_expanded_and_loops_end() {
    let nested = |inner: &str| {
        let text = file(|w| w.pair(0, "INSERT").pair(8, "1").pair(2, inner).xy(10.0, 20.0));
        text.replacen(
            "  2\nBLOCKS\n",
            &Writer::default()
                .pair(2, "BLOCKS")
                .block("PART")
                .pair(0, "INSERT")
                .pair(2, "FRONT_38")
                .polyline("1", true, &WEDGE)
                .pair(0, "ENDBLK")
                .0,
            1,
        )
    };
    let pattern = good(&nested("PART"));
    let front = pattern.pieces.iter().find(|p| p.block == "FRONT_38").expect("front");
    assert_eq!(front.darts[0].apexes[0], toile_garment::Vec2::new(160.0, 520.0));
    let e = bad(&file(|w| w.pair(0, "INSERT").pair(8, "1").pair(2, "FRONT_38").xy(10.0, 20.0)));
    assert!(codes(&e).contains(&"insert-recursive"), "{:?}", codes(&e));
}

/// A block `SHEET` that inserts others, and what ENTITIES insert.
fn with_blocks(blocks: impl Fn(Writer) -> Writer, inserts: impl Fn(Writer) -> Writer) -> String {
    let w = blocks(Writer::default().pair(0, "SECTION").pair(2, "BLOCKS")).pair(0, "ENDSEC");
    let w = w.pair(0, "SECTION").pair(2, "ENTITIES").text("1", "Units: METRIC").text("1", "Style Name: T");
    inserts(w).pair(0, "ENDSEC").pair(0, "EOF").0
}

fn insert(w: Writer, block: &str, scale: (f64, f64), degrees: f64) -> Writer {
    let w = w.pair(0, "INSERT").pair(8, "1").pair(2, block).xy(5.0, 7.0);
    w.pair(41, &scale.0.to_string()).pair(42, &scale.1.to_string()).pair(50, &degrees.to_string())
}

fn piece_block(w: Writer, name: &str) -> Writer {
    w.block(name).polyline("1", true, &WEDGE).line("7", (60.0, 150.0), (60.0, 450.0)).pair(0, "ENDBLK")
}

#[test]
fn a_block_of_pieces_passes_its_scale_on() {
    let text = with_blocks(
        |w| {
            let w = piece_block(piece_block(w, "A"), "B").block("SHEET");
            insert(insert(w, "A", (1.0, 0.5), 90.0), "B", (-1.0, 1.0), 0.0).pair(0, "ENDBLK")
        },
        |w| insert(w, "SHEET", (2.0, 1.0), 0.0),
    );
    let pattern = good(&text);
    assert_eq!(pattern.pieces.len(), 2);
    let size = |i: usize| {
        let (lo, hi) = geom::bounds(pattern.pieces[i].boundary.positions()).expect("points");
        hi - lo
    };
    // A: half as high, a quarter turn, then what was its height (now along x) twice as long: 300 × 600 again.
    assert!((size(0) - toile_garment::Vec2::new(300.0, 600.0)).norm() < 1e-9, "{}", size(0));
    // B: twice as wide and mirrored.
    assert!((size(1) - toile_garment::Vec2::new(600.0, 600.0)).norm() < 1e-9, "{}", size(1));
    assert!(codes(&pattern.findings).contains(&"insert-mirrored"));
}

#[test]
fn marks_in_blocks_of_their_own_belong_to_the_piece_that_inserts_them() {
    let text = with_blocks(
        |w| {
            let w = w.block("DRILL").point("0", 0.0, 0.0).pair(30, "4").pair(0, "ENDBLK").block("FRONT");
            let w = w.polyline("1", true, &WEDGE).line("7", (60.0, 150.0), (60.0, 450.0));
            let w = w.pair(0, "INSERT").pair(8, "13").pair(2, "DRILL").xy(150.0, 490.0).pair(41, "2").pair(42, "2");
            w.pair(0, "ENDBLK")
        },
        |w| w.pair(0, "INSERT").pair(8, "1").pair(2, "FRONT"),
    );
    let pattern = good(&text);
    assert_eq!((pattern.pieces.len(), codes(&pattern.findings)), (1, vec!["piece-name-missing"]));
    let drill = &pattern.pieces[0].inside.drills[0];
    assert_eq!((drill.at, drill.diameter), (toile_garment::Vec2::new(150.0, 490.0), Some(8.0)));
}

#[test]
fn a_piece_inserted_left_and_right_is_cut_twice() {
    let text = with_blocks(|w| piece_block(w, "A"), |w| insert(insert(w, "A", (1.0, 1.0), 0.0), "A", (-1.0, 1.0), 0.0));
    let pattern = good(&text);
    assert_wedge(&pattern);
    assert_eq!((pattern.pieces[0].texts.quantity.plain, pattern.pieces[0].texts.quantity.mirrored), (1, 1));
    assert!(pattern.pieces[0].darts[0].apexes[0].x > 0.0);
}

#[test]
fn ten_to_the_seventh_inserts_are_refused_fast() {
    let mut w = Writer::default().pair(0, "SECTION").pair(2, "BLOCKS");
    for level in 0..7 {
        w = w.block(&format!("B{level}"));
        for _ in 0..10 {
            w = w.pair(0, "INSERT").pair(2, &format!("B{}", level + 1));
        }
        w = w.pair(0, "ENDBLK");
    }
    let w = w.block("B7").polyline("1", true, &RECTANGLE).pair(0, "ENDBLK").pair(0, "ENDSEC").pair(0, "EOF");
    assert!(codes(&bad(&w.0)).contains(&"insert-too-many"));
}

#[test]
fn equal_block_names_both_survive() {
    let two = Writer::default().block("FRONT_38").text("1", "Piece Name: B").polyline("1", true, &RECTANGLE);
    let two = two.line("7", (0.0, 0.0), (0.0, 9.0)).pair(0, "ENDBLK").0;
    let text = wedge_file().replacen("  0\nENDBLK\n", &format!("  0\nENDBLK\n{two}"), 1);
    let pattern = good(&text);
    assert_eq!(pattern.pieces.len(), 2);
    assert!(codes(&pattern.findings).contains(&"block-name-repeats"));
    let names: Vec<String> = garment(&pattern).pieces.into_iter().map(|p| p.name).collect();
    assert_eq!(names, ["FRONT", "B"]);
}

#[test]
fn flat_drawing_gives_its_loops() {
    let w = Writer::default().pair(0, "SECTION").pair(2, "ENTITIES").polyline("CUT", true, &WEDGE);
    let w =
        w.line("7", (60.0, 150.0), (60.0, 450.0)).polyline("CUT", true, &[(500.0, 0.0), (700.0, 0.0), (600.0, 300.0)]);
    let pattern = good(&w.pair(0, "ENDSEC").pair(0, "EOF").0);
    assert_eq!(pattern.pieces.len(), 2);
    assert!(codes(&pattern.findings).contains(&"pieces-from-entities"));
    assert_eq!(pattern.pieces[0].darts.len(), 1);
    assert!(pattern.pieces[0].axes.grain.is_some() && pattern.pieces[1].axes.grain.is_none());
}

#[test]
fn layers_can_be_remapped() {
    let text = file(|w| w.polyline("OUT", true, &WEDGE).point("13", 150.0, 490.0));
    let options = ReadOptions { layers: [("OUT".to_owned(), "1".to_owned())].into(), ..ReadOptions::default() };
    assert_wedge(&read(text.as_bytes(), "t.dxf", &options).expect("remapped"));
}

#[test]
fn inspection_has_the_agreed_keys() {
    let inspection = inspect(wedge_file().as_bytes(), "t.dxf", None).expect("inspection");
    let json = &inspection.json;
    for key in ["units", "mm_per_unit", "style_name", "sizes", "sample_size", "ledger", "findings", "pieces"] {
        assert!(json.get(key).is_some(), "{key}");
    }
    let piece = &json["pieces"][0];
    for key in [
        "block",
        "name",
        "size",
        "quantity",
        "area_cm2",
        "area_unfolded_cm2",
        "perimeter_mm",
        "bbox_mm",
        "boundary_vertices",
        "half_piece_on_fold",
        "net_area_cm2",
        "net_perimeter_mm",
        "darts",
        "notches",
        "notch_count",
        "drill_count",
        "internal_line_count",
        "cutout_count",
        "grain_line_mm",
        "turn_point_count",
        "curve_point_count",
        "edges",
    ] {
        assert!(piece.get(key).is_some(), "{key}");
    }
    assert_eq!(piece["area_cm2"], 1785.0);
    assert_eq!(piece["darts"][0]["kind"], "boundary_wedge");
    assert_eq!(piece["edges"].as_array().map(Vec::len), Some(7));
    assert!(inspection.text.contains("FRONT") && inspection.text.contains("0 refused"));
    let again = inspect(wedge_file().as_bytes(), "t.dxf", None).expect("again");
    assert_eq!(again.json.to_string(), json.to_string());
}
