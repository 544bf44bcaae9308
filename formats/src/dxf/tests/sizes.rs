//! Sizes and grading.

use super::*;

#[test]
fn nest_chooses_sizes_and_carries_marks_over() {
    let smaller: Vec<(f64, f64)> = WEDGE.iter().map(|(x, y)| (x * 0.95, y * 0.98)).collect();
    let second = Writer::default().block("FRONT_36").text("1", "Piece Name: FRONT").text("1", "SIZE: 36");
    let second = second.polyline("1", true, &smaller).line("7", (60.0, 150.0), (60.0, 450.0)).pair(0, "ENDBLK").0;
    let base = file(|w| {
        let w = w.polyline("1", true, &WEDGE).points("2", &WEDGE);
        w.pair(0, "POINT").pair(8, "4").xy(300.0, 300.0).pair(30, "4").pair(39, "3")
    });
    let pattern = good(&base.replacen("  0\nENDBLK\n", &format!("  0\nENDBLK\n{second}"), 1));
    assert_eq!(pattern.sizes, ["38", "36"]);
    assert_eq!(garment(&pattern).size.as_deref(), Some("38"));
    let (small, _) = pattern.to_garment(Some("36"), None).expect("36");
    assert_eq!((small.pieces.len(), small.pieces[0].darts.len(), small.pieces[0].notches.len()), (1, 1, 1));
    let notch = &small.pieces[0].notches[0];
    assert!((notch.at - toile_garment::Vec2::new(0.285, 0.294)).norm() < 1e-9);
    assert_eq!(notch.kind, NotchKind::V);
    let e = pattern.to_garment(Some("44"), None).expect_err("no such size");
    assert!(e[0].code == "size-not-found" && e[0].message.contains("38, 36"));
}

#[test]
fn rule_table_grades_corners_and_what_lies_between() {
    let text = file(|w| {
        let w = w.polyline("1", true, &WEDGE).points("2", &WEDGE);
        let w = w.text_at("2", "# 1", 0.0, 0.0).text_at("2", "# 2", 300.0, 0.0);
        w.text_at("2", "# 3", 300.0, 600.0).text_at("2", "# 4", 0.0, 600.0)
    });
    let rul = "UNITS: METRIC\nNUMBER OF SIZES: 2\nSIZE LIST: 38 40\nSAMPLE SIZE: 38\nRULE: DELTA 1\n0 0 0 0\nRULE: DELTA 2\n0 0 10 0\nRULE: DELTA 3\n0 0 10 6\nRULE: DELTA 4\n0 0 0 6\n";
    let table = crate::rul::read(rul.as_bytes(), "t.rul").expect("table");
    let pattern = good(&text);
    let (g, _) = pattern.to_garment(Some("40"), Some(&table)).expect("graded");
    let piece = &g.pieces[0];
    let (lo, hi) = geom::bounds(piece.outline.positions()).expect("bounds");
    assert!((lo.norm()) < 1e-12 && (hi - toile_garment::Vec2::new(0.310, 0.606)).norm() < 1e-12);
    // The dart has no rule: its points grow by 6 mm in y and between 0 and 10 mm in x.
    let apex = piece.darts[0].apexes[0];
    assert!((apex.y - 0.506).abs() < 1e-9 && apex.x > 0.150 && apex.x < 0.160);
    assert!(piece.outline.positions().contains(&apex));
    assert_eq!(piece.size.as_deref(), Some("40"));
    let missing = crate::rul::read(rul.replace("DELTA 4", "DELTA 9").as_bytes(), "t.rul").expect("table");
    assert_eq!(pattern.to_garment(Some("40"), Some(&missing)).expect_err("rule 4")[0].code, "rule-missing");
}

/// A hem with two ruled curve points, one of them on the dense copy and one 0.3 mm beside it.
#[test]
fn curve_points_keep_their_rules_on_the_dense_copy() {
    let hem = [(0.0, 0.0), (100.0, -8.0), (200.0, -8.0), (300.0, 0.0), (300.0, 600.0), (0.0, 600.0)];
    let fine = [(0.0, 0.0), (50.0, -5.0), (100.0, -8.0), (150.0, -9.0), (199.0, -8.3), (250.0, -5.0), (300.0, 0.0)];
    let text = file(|w| {
        let w = w.polyline("1", true, &hem).points("2", &[hem[0], hem[3], hem[4], hem[5]]).points("3", &hem[1..3]);
        let dense: Vec<_> = fine.iter().chain(&hem[4..]).copied().collect();
        let w = w.polyline("84", true, &dense);
        let w = w.text_at("1", "# 1", 0.0, 0.0).text_at("1", "# 1", 300.0, 0.0).text_at("1", "# 1", 300.0, 600.0);
        w.text_at("1", "# 1", 0.0, 600.0).text_at("1", "# 2", 100.0, -8.0).text_at("1", "# 2", 200.0, -8.0)
    });
    let rul =
        "NUMBER OF SIZES: 2\nSIZE LIST: 38 40\nSAMPLE SIZE: 38\nRULE: DELTA 1\n0 0 0 0\nRULE: DELTA 2\n0 0 0 -4\n";
    let table = crate::rul::read(rul.as_bytes(), "t.rul").expect("table");
    let pattern = good(&text);
    assert!(matches!(pattern.pieces[0].boundary.making, outline::Making::Dense(_)));
    let graded = grade::grade(&pattern.pieces[0], &table, "40").expect("graded");
    let at = |x: f64, y: f64| {
        let want = toile_garment::Vec2::new(x, y);
        graded.boundary.work_positions().iter().map(|p| (p - want).norm()).fold(f64::INFINITY, f64::min)
    };
    // The point on the copy goes as ruled; that beside it carries the copy along; between both all go alike.
    assert!(at(100.0, -12.0) < 1e-9 && at(150.0, -13.0) < 1e-9, "{:?}", graded.boundary.work_positions());
    assert!(at(199.0, -12.3) < 0.05, "{:?}", graded.boundary.work_positions());
    // Half way from the corner a little over half the growth, by arc length.
    assert!(at(50.0, -7.0) < 0.05);
}

#[test]
fn growths_turn_with_the_reference_line() {
    let text = file(|w| {
        w.polyline("1", true, &RECTANGLE).text_at("1", "# 1", 300.0, 600.0).line("5", (10.0, 10.0), (10.0, 90.0))
    });
    let table =
        crate::rul::read(b"NUMBER OF SIZES: 2\nSIZE LIST: 38 40\nSAMPLE SIZE: 38\nRULE: DELTA 1\n0 0 5 0\n", "t.rul")
            .expect("table");
    let graded = grade::grade(&good(&text).pieces[0], &table, "40").expect("graded");
    // One rule only: the whole outline moves with it, along the reference line, which is +y here.
    assert!((graded.boundary.drawn[2].at - toile_garment::Vec2::new(300.0, 605.0)).norm() < 1e-9);
}

#[test]
fn an_alternate_rule_stands_in_the_frame_of_its_own_line() {
    // The reference line is +x; the first alternate is +y, the one with the text `# 7` is −x.
    let text = |rule: &str| {
        file(|w| {
            let w = w.polyline("1", true, &RECTANGLE).text_at("1", rule, 300.0, 600.0).text_at("1", "# 0", 0.0, 0.0);
            let w = w.line("5", (10.0, 10.0), (90.0, 10.0)).line("5", (20.0, 20.0), (20.0, 90.0));
            w.line("5", (250.0, 30.0), (200.0, 30.0)).text_at("5", "# 7", 250.0, 30.0)
        })
    };
    let table =
        crate::rul::read(b"NUMBER OF SIZES: 2\nSIZE LIST: 38 40\nSAMPLE SIZE: 38\nRULE: DELTA 1\n0 0 5 2\n", "t.rul")
            .expect("table");
    let corner = |rule: &str| {
        let pattern = good(&text(rule));
        let graded = grade::grade(&pattern.pieces[0], &table, "40").expect("graded");
        (graded.boundary.drawn[2].at - toile_garment::Vec2::new(300.0, 600.0), pattern.findings.len())
    };
    for (rule, (x, y), findings) in
        [("# 1", (5.0, 2.0), 0), ("# 1, 1", (-2.0, 5.0), 0), ("# 1, 7", (-5.0, -2.0), 0), ("# 1, 9", (5.0, 2.0), 1)]
    {
        let (growth, told) = corner(rule);
        assert!((growth - toile_garment::Vec2::new(x, y)).norm() < 1e-9, "{rule}: {growth}");
        assert_eq!(told, findings, "{rule}");
    }
}

#[test]
fn a_size_that_the_asked_pieces_lack_is_said_with_those_they_have() {
    let w = Writer::default().pair(0, "SECTION").pair(2, "BLOCKS");
    let w = [("A", "36"), ("A", "38"), ("C", "38")].into_iter().fold(w, |w, (name, size)| {
        let w = w.block(&format!("{name}_{size}")).text("1", &format!("Piece Name: {name}"));
        w.text("1", &format!("Size: {size}")).polyline("1", true, &RECTANGLE).pair(0, "ENDBLK")
    });
    let w = w.pair(0, "ENDSEC").pair(0, "SECTION").pair(2, "ENTITIES").text("1", "Units: METRIC");
    let mut pattern = good(&w.text("1", "Sample Size: 36").pair(0, "ENDSEC").pair(0, "EOF").0);
    pattern.keep_pieces(&["C".to_owned()]).expect("C is there");
    let [error] = &pattern.to_garment(None, None).expect_err("not in 36")[..] else { panic!("one error") };
    assert_eq!(error.code, "size-not-found");
    assert!(error.message.contains("`36`") && error.message.ends_with("`C` is in 38"), "{}", error.message);
}

#[test]
fn the_sound_pieces_of_a_size_can_be_used_without_the_bad_ones() {
    let w = Writer::default().pair(0, "SECTION").pair(2, "BLOCKS");
    let bow = [(0.0, 0.0), (300.0, 600.0), (300.0, 0.0), (0.0, 600.0)];
    let w = w.block("A").text("1", "Piece Name: A").text("1", "Size: 36").polyline("1", true, &RECTANGLE);
    let w = w.pair(0, "ENDBLK").block("B").text("1", "Piece Name: B").text("1", "Size: 36").polyline("1", true, &bow);
    let w = w.pair(0, "ENDBLK").pair(0, "ENDSEC").pair(0, "SECTION").pair(2, "ENTITIES").text("1", "Units: METRIC");
    let pattern = good(&w.pair(0, "ENDSEC").pair(0, "EOF").0);
    assert!(pattern.to_garment(None, None).is_err());
    let (garment, _) = pattern.of_sound_pieces().to_garment(None, None).expect("A");
    assert_eq!(garment.pieces.iter().map(|p| p.name.as_str()).collect::<Vec<_>>(), ["A"]);
}
