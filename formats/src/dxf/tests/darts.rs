//! Darts and what is none.

use super::*;

#[test]
fn marked_dart_has_its_mouth_on_outline_vertices() {
    let pattern = good(&file(|w| {
        let w = w.polyline("1", true, &RECTANGLE).points("2", &RECTANGLE);
        w.polyline("8", false, &[(135.0, 600.0), (150.0, 500.0), (165.0, 600.0)]).polyline(
            "8",
            false,
            &[(50.0, 50.0), (250.0, 50.0)],
        )
    }));
    let g = garment(&pattern);
    let piece = &g.pieces[0];
    assert_eq!((piece.darts.len(), piece.internal_lines.len()), (1, 1));
    assert_eq!(piece.darts[0].kind, DartKind::MarkedWedge);
    let outline = piece.outline.positions();
    assert!(piece.darts[0].legs.iter().all(|l| outline.contains(&l[0])));
    assert!((piece.outline.signed_area() - 0.18).abs() < 1e-12);
    assert_eq!(piece.edges.len(), 4);
}

#[test]
fn godet_wedges_and_slits_are_no_darts() {
    let insert = Writer::default().block("GODET").text("1", "Piece Name: GODET").text("1", "SIZE: 38");
    let insert =
        insert.polyline("1", true, &[(500.0, 0.0), (600.0, 0.0), (550.0, 87.9)]).line("7", (550.0, 0.0), (550.0, 50.0));
    // Its sides are as long as the legs of the wedge, about 101.1 mm.
    let insert = insert.pair(0, "ENDBLK").0;
    let text = wedge_file().replacen("  0\nENDBLK\n", &format!("  0\nENDBLK\n{insert}"), 1);
    let pattern = good(&inserting(&text, "GODET"));
    assert!(pattern.pieces[0].darts.is_empty());
    assert_eq!(codes(&pattern.findings), ["wedge-not-a-dart"]);
    assert!(pattern.findings[0].message.contains("(150.0, 500.0) mm"));
}

#[test]
fn unequal_legs_are_reported_in_mm() {
    let mut points = WEDGE;
    points[5] = (135.0, 612.0);
    let pattern = good(&file(|w| w.polyline("1", true, &points).points("2", &points)));
    assert_eq!(codes(&pattern.findings), ["dart-legs-differ"]);
    assert!(pattern.findings[0].message.contains("11.9 mm"));
}
