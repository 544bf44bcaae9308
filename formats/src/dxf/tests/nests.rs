//! Statements of one size of a nest hold for all of them.

use super::*;
use crate::dxf::write::{PieceOptions, Sizes};
use crate::rul;
use toile_garment::Vec2;

/// A back whose dart is `width` mm wide and 200 mm deep, at the middle of a waist `grown` mm wider.
fn back(width: f64, grown: f64) -> Vec<(f64, f64)> {
    let (half, middle) = (0.5 * width, 150.0 + 0.5 * grown);
    let w = 300.0 + grown;
    vec![
        (0.0, 0.0),
        (w, 0.0),
        (w, 400.0),
        (middle + half, 400.0),
        (middle, 200.0),
        (middle - half, 400.0),
        (0.0, 400.0),
    ]
}

/// Sizes 34, 36 and 38; the sample size 36 alone has points, quantity and material.
fn nest(widths: [f64; 3]) -> String {
    let w = Writer::default().pair(0, "SECTION").pair(2, "BLOCKS");
    let sizes = ["34", "36", "38"].into_iter().zip(widths).enumerate();
    let w = sizes.fold(w, |w, (i, (size, width))| {
        let outline = back(width, 20.0 * (i as f64 - 1.0));
        let w = w.block(&format!("BACK_{size}")).text("1", "Piece Name: BACK").text("1", &format!("Size: {size}"));
        let w = w.line("7", (60.0, 50.0), (60.0, 150.0)).polyline("1", true, &outline);
        let sample = |w: Writer| w.text("1", "Quantity: 2").text("1", "Material: SHELL").points("2", &outline);
        if size == "36" { sample(w) } else { w }.pair(0, "ENDBLK")
    });
    let w = w.pair(0, "ENDSEC").pair(0, "SECTION").pair(2, "ENTITIES").text("1", "Units: METRIC");
    w.text("1", "Sample Size: 36").pair(0, "ENDSEC").pair(0, "EOF").0
}

#[test]
fn a_dart_of_one_size_is_a_dart_in_all() {
    // 2.3, 4.0 and 5.2 degrees: the first alone would be undecided.
    let pattern = good(&nest([8.0, 14.0, 18.0]));
    for (piece, width) in pattern.pieces.iter().zip([8.0, 14.0, 18.0]) {
        let [dart] = piece.darts.as_slice() else { panic!("{:?}: {:?}", piece.size, piece.darts) };
        assert!((dart.width() - width).abs() < 1e-9 && dart.apexes[0].y == 200.0);
        assert!(piece.doubts.denied.is_empty());
    }
    assert_eq!(codes(&pattern.findings), [""; 0]);
    assert!(pattern.pieces[0].darts[0].reasons().contains(&"it is a dart in another size of its piece"));
    // Where no size has a dart, a slit is none.
    let slits = good(&nest([4.0, 5.0, 6.0]));
    assert!(slits.pieces.iter().all(|p| p.darts.is_empty()));
}

#[test]
fn quantity_and_material_of_the_sample_size_hold_for_all() {
    let pattern = good(&nest([14.0; 3]));
    for size in ["34", "36", "38"] {
        let (garment, _) = pattern.to_garment(Some(size), None).expect(size);
        let piece = &garment.pieces[0];
        assert_eq!((piece.quantity.plain, piece.material.as_deref()), (2, Some("SHELL")), "{size}");
    }
    // What a size says itself counts.
    let own = nest([14.0; 3]).replacen("Size: 38", "Size: 38\n  0\nTEXT\n  8\n1\n 10\n0\n 20\n0\n  1\nQuantity: 4", 1);
    let pattern = good(&own);
    assert_eq!(pattern.pieces.iter().map(|p| p.texts.quantity.plain).collect::<Vec<_>>(), [2, 2, 4]);
}

#[test]
fn grade_rules_a_little_beside_their_vertex_count() {
    let table =
        "NUMBER OF SIZES: 2\nSIZE LIST: 38 40\nSAMPLE SIZE: 38\nRULE: DELTA 1\n0 0 10 0\nRULE: DELTA 2\n0 0 0 0\nEND\n";
    let table = rul::read(table.as_bytes(), "t.rul").expect("table");
    let ruled = |x: f64, more: &[(f64, f64)]| {
        let outline: Vec<(f64, f64)> = RECTANGLE.iter().chain(more).copied().collect();
        let w = |w: Writer| w.polyline("1", true, &outline).points("2", &outline);
        let text = file(|writer| {
            let w = w(writer).text_at("2", "# 1", x, 0.0).text_at("2", "# 1", 300.0, 600.0);
            w.text_at("2", "# 2", 0.0, 0.0).text_at("2", "# 2", 0.0, 600.0)
        });
        let pattern = good(&text);
        let corners = pattern.to_garment(Some("40"), Some(&table)).map(|(g, _)| g.pieces[0].outline.positions());
        (codes(&pattern.findings).into_iter().map(str::to_owned).collect::<Vec<_>>(), corners.expect("graded")[1] * 1e3)
    };
    let near = |p: Vec2, x: f64| (p - Vec2::new(x, 0.0)).norm() < 1e-9;
    let (said, corner) = ruled(300.0, &[]);
    assert!(said.is_empty() && near(corner, 310.0), "{said:?} {corner}");
    let (said, corner) = ruled(300.7, &[]);
    assert!(said == ["grade-rule-beside-vertex"] && near(corner, 310.0), "{said:?} {corner}");
    // Too far from any vertex: told, and the corner moves only as far as its neighbours' rules say.
    let (said, corner) = ruled(302.0, &[]);
    assert!(said == ["grade-rule-off-vertex"] && !near(corner, 310.0), "{said:?} {corner}");
}

/// Two sizes, the second 10 mm wider by rule 1; rule 2 moves nothing.
fn two_sizes() -> rul::RuleTable {
    let table =
        "NUMBER OF SIZES: 2\nSIZE LIST: 38 40\nSAMPLE SIZE: 38\nRULE: DELTA 1\n0 0 10 0\nRULE: DELTA 2\n0 0 0 0\nEND\n";
    rul::read(table.as_bytes(), "t.rul").expect("table")
}

/// The rectangle with rule 1 on its right side and rule 2 on its left, and more.
fn ruled(x: f64, more: impl Fn(Writer) -> Writer) -> String {
    file(|w| {
        let w = w.polyline("1", true, &RECTANGLE).points("2", &RECTANGLE);
        let w = w.text_at("2", "# 1", x, 0.0).text_at("2", "# 1", 300.0, 600.0);
        more(w.text_at("2", "# 2", 0.0, 0.0).text_at("2", "# 2", 0.0, 600.0))
    })
}

#[test]
fn a_dense_copy_does_not_keep_a_rule_from_its_vertex() {
    // The copy has vertices 0.4 mm beside the corner, one of them where the text of the rule stands.
    let dense = [(0.0, 0.0), (299.6, 0.0), (300.0, 0.0), (300.0, 0.4), (300.0, 600.0), (0.0, 600.0)];
    for x in [300.4, 299.6] {
        let pattern = good(&ruled(x, |w| w.polyline("84", true, &dense)));
        assert_eq!(codes(&pattern.findings), ["grade-rule-beside-vertex"], "{x}");
        let (graded, _) = pattern.to_garment(Some("40"), Some(&two_sizes())).expect("graded");
        let corner = |p: &Vec2| (p - Vec2::new(0.31, 0.0)).norm() < 1e-9;
        assert!(graded.pieces[0].outline.positions().iter().any(corner), "{x}");
    }
    // A vertex that has a rule keeps it.
    let pattern = good(&ruled(299.6, |w| w.text_at("2", "# 2", 300.0, 0.0)));
    assert_eq!(codes(&pattern.findings), ["grade-rule-off-vertex"]);
}

#[test]
fn internal_lines_keep_their_curve_points_in_every_size() {
    let line = [(50.0, 100.0), (150.0, 140.0), (200.0, 150.0), (250.0, 140.0)];
    let text = ruled(300.0, |w| {
        let w = w.polyline("8", false, &line).points("2", &[line[0], line[3]]).points("3", &line[1..3]);
        w.text_at("2", "# 2", line[0].0, line[0].1).text_at("2", "# 1", line[3].0, line[3].1)
    });
    let (pattern, table) = (good(&text), two_sizes());
    let kinds = |size: &str| {
        let (garment, _) = pattern.to_garment(Some(size), Some(&table)).expect(size);
        let line = &garment.pieces[0].internal_lines[0];
        (line.points.iter().map(|p| p.kind).collect::<Vec<_>>(), line.points[3].at.x)
    };
    let ((sample, _), (graded, end)) = (kinds("38"), kinds("40"));
    assert_eq!(sample, graded);
    assert_eq!(graded[1], toile_garment::outline::PointKind::Curve);
    assert!((end - 0.26).abs() < 1e-9);
}

#[test]
fn names_that_differ_in_case_alone_are_told() {
    let piece = |w: Writer, block: &str, name: &str| {
        let w = w.block(block).text("1", &format!("Piece Name: {name}")).text("1", "Size: 38");
        w.line("7", (60.0, 150.0), (60.0, 450.0)).polyline("1", true, &RECTANGLE).pair(0, "ENDBLK")
    };
    let text = |names: [&str; 2]| {
        let w = Writer::default().pair(0, "SECTION").pair(2, "BLOCKS");
        let w = piece(piece(w, "A", names[0]), "B", names[1]);
        let w = w.pair(0, "ENDSEC").pair(0, "SECTION").pair(2, "ENTITIES").text("1", "Units: METRIC");
        w.text("1", "Sample Size: 38").pair(0, "ENDSEC").pair(0, "EOF").0
    };
    let said = |names| codes(&good(&text(names)).findings).iter().map(|c| (*c).to_owned()).collect::<Vec<_>>();
    assert_eq!(said(["FRONT", "front"]), ["piece-names-alike"]);
    assert!(said(["FRONT", "FRONT-2"]).is_empty());
}

#[test]
fn a_fabric_that_becomes_the_material_is_told() {
    let of = |texts: [&str; 2]| {
        let pattern = good(&file(|w| w.polyline("1", true, &RECTANGLE).text("1", texts[0]).text("1", texts[1])));
        let material = garment(&pattern).pieces[0].material.clone();
        (material, codes(&pattern.findings).iter().map(|c| (*c).to_owned()).collect::<Vec<_>>())
    };
    assert_eq!(of(["Fabric: SHELL", "Quantity: 1"]), (Some("SHELL".to_owned()), vec!["text-key-foreign".to_owned()]));
    assert_eq!(of(["Material: SHELL", "Quantity: 1"]), (Some("SHELL".to_owned()), vec![]));
}

/// A notch that is cut deeply into the outline of one size, and flatly into that of another, is a notch in both. So
/// both are written with the same vertices.
#[test]
fn a_notch_cut_into_one_size_is_one_in_all() {
    let notched = |depth: f64, half: f64| {
        let top = [(300.0, 400.0), (150.0 + half, 400.0), (150.0, 400.0 - depth), (150.0 - half, 400.0), (0.0, 400.0)];
        [(0.0, 0.0), (300.0, 0.0)].into_iter().chain(top).collect::<Vec<(f64, f64)>>()
    };
    let sizes = |depths: [f64; 2], half: f64| {
        let w = Writer::default().pair(0, "SECTION").pair(2, "BLOCKS");
        let w = ["36", "38"].into_iter().zip(depths).fold(w, |w, (size, depth)| {
            let w = w.block(&format!("A_{size}")).text("1", "Piece Name: A").text("1", &format!("Size: {size}"));
            w.line("7", (60.0, 50.0), (60.0, 150.0)).polyline("1", true, &notched(depth, half)).pair(0, "ENDBLK")
        });
        let w = w.pair(0, "ENDSEC").pair(0, "SECTION").pair(2, "ENTITIES").text("1", "Units: METRIC");
        good(&w.text("1", "Sample Size: 36").pair(0, "ENDSEC").pair(0, "EOF").0)
    };
    let cut = |p: &Pattern| p.pieces.iter().map(|p| p.boundary.cut.len()).collect::<Vec<_>>();
    assert_eq!(cut(&sizes([5.0, 1.5], 3.0)), [1, 1]);
    assert_eq!(cut(&sizes([1.5, 1.5], 3.0)), [0, 0]);
    assert_eq!(cut(&sizes([5.0, 0.2], 3.0)), [1, 0]);
    // A slit grows with the size. One that is deep in every size is a slit of the garment.
    assert_eq!(cut(&sizes([10.0, 25.0], 0.03)), [1, 1]);
    assert_eq!(cut(&sizes([25.0, 25.0], 0.03)), [0, 0]);
    assert_eq!(cut(&sizes([10.0, 25.0], 3.0)), [1, 0]);
}

#[test]
fn a_finding_of_all_sizes_is_told_once_in_the_size_asked_for() {
    // 1.4 to 2.9 degrees, without a dart in any size: each size is undecided.
    let pattern = good(&nest([5.0, 8.0, 10.0]));
    let of = |size: Option<&str>| -> Vec<String> {
        let of_block = |f: &Diagnostic| f.source.as_ref().and_then(|s| s.block.clone());
        pattern.findings_of_size(size).iter().filter(|f| f.code == "dart-undecided").filter_map(of_block).collect()
    };
    assert_eq!(pattern.findings.iter().filter(|f| f.code == "dart-undecided").count(), 3, "{:?}", pattern.findings);
    assert_eq!(of(None), ["BACK_36"]);
    assert_eq!(of(Some("38")), ["BACK_38"]);
    let told = pattern.findings_of_size(None);
    assert!(told.iter().any(|f| f.message.ends_with("(and alike in 2 other sizes)")), "{told:?}");
}

/// Corners and notches of a size that are not as many as in the sample size are told with their counts.
#[test]
fn sizes_with_other_numbers_of_corners_or_notches_are_said() {
    let w = Writer::default().pair(0, "SECTION").pair(2, "BLOCKS");
    let w = [("34", 2), ("36", 2), ("38", 1)].into_iter().fold(w, |w, (size, notches)| {
        let mut line = RECTANGLE.to_vec();
        if size == "38" {
            line.push((-200.0, 300.0));
        }
        let w = w.block(&format!("A_{size}")).text("1", "Piece Name: A").text("1", &format!("Size: {size}"));
        let w = w.line("7", (60.0, 150.0), (60.0, 450.0)).polyline("1", true, &line);
        (0..notches).fold(w, |w, k| w.point("4", 300.0, 100.0 + 200.0 * f64::from(k))).pair(0, "ENDBLK")
    });
    let w = w.pair(0, "ENDSEC").pair(0, "SECTION").pair(2, "ENTITIES").text("1", "Units: METRIC");
    let pattern = good(&w.text("1", "Sample Size: 36").pair(0, "ENDSEC").pair(0, "EOF").0);
    let mut told: Vec<&str> = pattern.findings.iter().map(|f| f.message.as_str()).collect();
    told.sort_unstable();
    assert_eq!(codes(&pattern.findings).len(), 2, "{told:?}");
    let has = |what: &str, counts: [usize; 2]| {
        let [other, base] = counts;
        let text = format!("the sizes 38 ({other}) of `A` have another number of {what} than size 36 ({base})");
        told.iter().any(|m| m.starts_with(&text))
    };
    assert!(has("corners", [5, 4]) && has("notches", [1, 2]), "{told:?}");
    // A run that is written tells the counts, too.
    let run = Sizes::new(&pattern, None).expect("sizes").draw(PieceOptions::default());
    let counts = "(34, 36: 4 vertices, 2 notches; 38: 5 vertices, 1 notches)";
    assert!(run.findings.iter().any(|f| f.message.ends_with(counts)), "{:?}", run.findings);
}

/// A program may draw the sew line, and the notches on it, in the sample size alone.
#[test]
fn notches_that_the_sample_size_shows_on_both_lines_are_not_more() {
    let cut = [(-10.0, -10.0), (310.0, -10.0), (310.0, 610.0), (-10.0, 610.0)];
    let w = Writer::default().pair(0, "SECTION").pair(2, "BLOCKS");
    let w = ["34", "36"].into_iter().fold(w, |w, size| {
        let w = w.block(&format!("A_{size}")).text("1", "Piece Name: A").text("1", &format!("Size: {size}"));
        let w = w.line("7", (60.0, 150.0), (60.0, 450.0)).polyline("1", true, &cut).point("4", 310.0, 250.0);
        let sample = |w: Writer| w.polyline("14", true, &RECTANGLE).point("4", 300.0, 250.0);
        if size == "36" { sample(w) } else { w }.pair(0, "ENDBLK")
    });
    let w = w.pair(0, "ENDSEC").pair(0, "SECTION").pair(2, "ENTITIES").text("1", "Units: METRIC");
    let pattern = good(&w.text("1", "Sample Size: 36").pair(0, "ENDSEC").pair(0, "EOF").0);
    assert_eq!(codes(&pattern.findings), [""; 0]);
}

/// Notches stand in the sample size alone: one on a curve, which is 7 mm off its chord, and one on the sew line.
#[test]
fn notches_on_curves_and_on_sew_lines_are_carried_to_the_other_sizes() {
    let at = |radius: f64, k: f64| {
        let angle = std::f64::consts::PI * (0.25 + k / 8.0);
        (radius * libm::cos(angle), radius * libm::sin(angle))
    };
    let arc = |radius: f64| {
        let mut line = vec![(-200.0, -100.0), (200.0, -100.0)];
        line.extend((0..=4).map(|k| at(radius, f64::from(k))));
        line
    };
    let w = Writer::default().pair(0, "SECTION").pair(2, "BLOCKS");
    let w = [("34", 390.0), ("36", 400.0), ("38", 410.0)].into_iter().fold(w, |w, (size, radius)| {
        let w = w.block(&format!("A_{size}")).text("1", "Piece Name: A").text("1", &format!("Size: {size}"));
        let sew = [(-190.0, -90.0), (190.0, -90.0), (190.0, 180.0), (-190.0, 180.0)];
        let w = w.polyline("1", true, &arc(radius)).polyline("14", true, &sew);
        let middle = at(radius, 1.5);
        let sample = |w: Writer| {
            let w = w.points("2", &arc(radius)[..3]).points("2", &arc(radius)[6..]).points("3", &arc(radius)[3..6]);
            w.point("4", middle.0, middle.1).point("4", 190.0, 50.0)
        };
        if size == "36" { sample(w) } else { w }.pair(0, "ENDBLK")
    });
    let w = w.pair(0, "ENDSEC").pair(0, "SECTION").pair(2, "ENTITIES").text("1", "Units: METRIC");
    let pattern = good(&w.text("1", "Sample Size: 36").pair(0, "ENDSEC").pair(0, "EOF").0);
    for (piece, radius) in pattern.pieces.iter().zip([390.0, 400.0, 410.0]) {
        let [on_curve, on_sew] = piece.notches.as_slice() else { panic!("{:?}: {:?}", piece.size, piece.notches) };
        let wanted = at(radius, 1.5);
        assert!((on_curve.at - Vec2::new(wanted.0, wanted.1)).norm() < 0.01, "{:?}: {on_curve:?}", piece.size);
        assert_eq!((on_sew.at, on_sew.on), (Vec2::new(190.0, 50.0), "sew"), "{:?}", piece.size);
    }
}
