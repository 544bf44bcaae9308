//! A file goes out as it came in: vertices, curve points and marks, in every dialect and in every size.

use super::*;
use crate::dxf::write::{Dialect, Drawing, PieceOptions, Sizes, StyleText, piece_drawing, write};
use toile_garment::Vec2;

/// Corners and curve points of a front with an armhole of a quarter circle, in a size `k` mm wider.
fn front(k: f64) -> [Vec<(f64, f64)>; 2] {
    let corners = vec![(0.0, 0.0), (300.0 + k, 0.0), (300.0 + k, 400.0), (180.0 + k, 520.0), (0.0, 520.0)];
    let curve = (1..8).map(|i| {
        let (sin, cos) = libm::sincos(f64::from(i) * 11.25_f64.to_radians());
        // Centre in the corner that the armhole cuts off.
        (300.0 + k - 120.0 * sin, 520.0 - 120.0 * cos)
    });
    [corners, curve.collect()]
}

fn outline(k: f64) -> Vec<(f64, f64)> {
    let [corners, curve] = front(k);
    let mut all = corners[..3].to_vec();
    all.extend(&curve);
    all.extend(&corners[3..]);
    all
}

fn block(w: Writer, size: &str, k: f64, marked: bool, copy: bool) -> Writer {
    let w = w.block(&format!("FRONT_{size}")).text("1", "Piece Name: FRONT").text("1", &format!("Size: {size}"));
    let w = w.line("7", (60.0, 150.0), (60.0, 450.0)).polyline("1", true, &outline(k));
    // The dense copy bends 0.7 mm less than the points it copies.
    let fine: Vec<(f64, f64)> = (1..32)
        .map(|i| libm::sincos(f64::from(i) * 2.8125_f64.to_radians()))
        .map(|(sin, cos)| (300.0 + k - 119.3 * sin, 520.0 - 119.3 * cos))
        .collect();
    let [corners, curve] = front(k);
    let dense: Vec<(f64, f64)> = corners[..3].iter().chain(&fine).chain(&corners[3..]).copied().collect();
    let w = if copy { w.polyline("84", true, &dense) } else { w };
    let line = [(40.0, 40.0), (60.0, 80.0), (100.0, 90.0)];
    let w = w.polyline("8", false, &line);
    let w = if marked {
        w.points("2", &corners).points("3", &curve).points("2", &line[..1]).points("3", &line[1..2])
    } else {
        w
    };
    w.pair(0, "ENDBLK")
}

fn nest(sizes: &[(&str, f64)], copy: bool) -> String {
    let w = Writer::default().pair(0, "SECTION").pair(2, "BLOCKS");
    let w = sizes.iter().fold(w, |w, (size, k)| block(w, size, *k, *size == "38", copy)).pair(0, "ENDSEC");
    let w = w.pair(0, "SECTION").pair(2, "ENTITIES").text("1", "Units: METRIC").text("1", "Sample Size: 38");
    w.pair(0, "ENDSEC").pair(0, "EOF").0
}

fn written(garment: &Garment, options: PieceOptions, dialect: Dialect) -> (String, Vec<Diagnostic>) {
    let mut findings = Vec::new();
    let pieces = garment.pieces.iter().map(|p| piece_drawing(p, options, &mut findings)).collect();
    let style = StyleText { name: garment.style.clone(), sample_size: garment.size.clone(), ..StyleText::default() };
    let written = write(&Drawing { style, pieces }, dialect).expect("written");
    findings.extend(written.findings);
    (String::from_utf8(written.bytes).expect("ascii"), findings)
}

/// Kinds and places of the drawn vertices of a line.
fn vertices(piece: &piece::DrawnPiece) -> Vec<(Vec2, toile_garment::outline::PointKind)> {
    piece.boundary.drawn.iter().map(|n| (n.at, n.kind)).collect()
}

fn assert_same(a: &piece::DrawnPiece, b: &piece::DrawnPiece, what: &str) {
    let (p, q) = (vertices(a), vertices(b));
    assert_eq!(p.len(), q.len(), "{what}");
    for ((at, kind), (there, their)) in p.iter().zip(&q) {
        assert!((at - there).norm() < 1e-4 && kind == their, "{what}: {at} {kind:?} against {there} {their:?}");
    }
    assert_eq!(
        (a.points.curve_list.len(), a.points.turn_list.len(), a.notches.len()),
        (b.points.curve_list.len(), b.points.turn_list.len(), b.notches.len()),
        "{what}"
    );
}

#[test]
fn curve_points_go_out_as_they_came() {
    for copy in [false, true] {
        let text = nest(&[("38", 0.0)], copy);
        let first = good(&text);
        assert_eq!(first.pieces[0].points.curve_list.len(), 8);
        let garment = garment(&first);
        for dialect in Dialect::ALL {
            let (again, said) = written(&garment, PieceOptions::default(), dialect);
            let second = good(&again);
            assert_same(&first.pieces[0], &second.pieces[0], &format!("{dialect:?} {copy}"));
            // What a dialect without a dense copy cannot hold is said.
            let lost = copy && !dialect.has_dense();
            assert_eq!(codes(&said), if lost { vec!["curve-copy-lost"] } else { vec![] }, "{dialect:?}");
            let (fine, there) = (first.pieces[0].boundary.work_positions(), second.pieces[0].boundary.work_positions());
            let off = geom::deviation(&fine, &there, true);
            assert!(off < if lost { 0.8 } else { 1e-3 }, "{dialect:?} {copy}: {off}");
        }
    }
}

#[test]
fn a_size_run_has_the_same_vertices_in_every_size() {
    for copy in [false, true] {
        let first = good(&nest(&[("36", -9.0), ("38", 0.0), ("40", 60.0)], copy));
        let run = Sizes::new(&first, None).expect("sizes").draw(PieceOptions::default());
        assert_eq!(run.findings, []);
        for dialect in Dialect::ALL {
            let second = good(&String::from_utf8(write(&run.drawing, dialect).expect("written").bytes).expect("ascii"));
            let counts: Vec<usize> = second.pieces.iter().map(|p| p.boundary.drawn.len()).collect();
            assert_eq!(counts, [12; 3], "{dialect:?}");
            for (a, b) in first.pieces.iter().zip(&second.pieces) {
                assert!(vertices(a).iter().zip(vertices(b)).all(|(p, q)| (p.0 - q.0).norm() < 1e-4 && p.1 == q.1));
            }
        }
    }
}

/// A waistband that is folded along its middle, with a mark on the fold and a notch on the edge.
fn waistband() -> String {
    file(|w| {
        let w = w.polyline("1", true, &[(0.0, 0.0), (300.0, 0.0), (300.0, 18.0), (0.0, 18.0)]);
        w.line("6", (0.0, 18.0), (300.0, 18.0))
            .point("4", 120.0, 18.0)
            .pair(30, "4")
            .point("4", 200.0, 0.0)
            .pair(30, "4")
    })
}

#[test]
fn a_mark_on_the_fold_is_no_notch_inside_the_piece() {
    let first = good(&waistband());
    let places: Vec<&str> = first.pieces[0].notches.iter().map(|n| n.on).collect();
    assert_eq!(places, ["fold", "boundary"]);
    let whole = garment(&first);
    let on: Vec<&str> = whole.pieces[0].notches.iter().map(|n| n.on.as_str()).collect();
    assert_eq!(on, ["fold", "boundary", "boundary"]);
    for dialect in Dialect::ALL {
        // Written whole, the mark is a short line across the fold.
        let (text, _) = written(&whole, PieceOptions::default(), dialect);
        let piece = &good(&text).pieces[0];
        assert!(piece.notches.iter().all(|n| n.on == "boundary" && n.off < 1e-4), "{:?}", piece.notches);
        assert_eq!((piece.notches.len(), piece.inside.internal.len()), (2, 1));
        let line = piece.inside.internal[0].positions();
        assert_eq!(line, [Vec2::new(120.0, 22.0), Vec2::new(120.0, 14.0)]);
        // Written as a half, it is the notch on the fold that it was.
        let half = PieceOptions { half_on_fold: true, ..PieceOptions::default() };
        let piece = &good(&written(&whole, half, dialect).0).pieces[0];
        assert_eq!(piece.notches.iter().map(|n| n.on).collect::<Vec<_>>(), ["fold", "boundary"], "{dialect:?}");
        assert!(piece.inside.internal.is_empty());
    }
    // A notch where the fold ends stands on the edge of the whole piece too.
    let hem = good(&file(|w| {
        w.polyline("1", true, &RECTANGLE).line("6", (0.0, 0.0), (0.0, 600.0)).point("4", 0.0, 0.0).pair(30, "4")
    }));
    assert_eq!(hem.pieces[0].notches[0].on, "boundary");
}

#[test]
fn a_half_piece_goes_out_as_the_half_that_was_drawn() {
    // The fold is on the left or on the right of the half, and is drawn upwards or downwards.
    for (sign, ends) in [(1.0, [0.0, 520.0]), (-1.0, [0.0, 520.0]), (1.0, [520.0, 0.0]), (-1.0, [520.0, 0.0])] {
        let [corners, curve] = front(0.0).map(|list| list.into_iter().map(|(x, y)| (sign * x, y)).collect::<Vec<_>>());
        let line: Vec<_> = outline(0.0).into_iter().map(|(x, y)| (sign * x, y)).collect();
        let text = file(|w| {
            let w = w.polyline("1", true, &line).points("2", &corners).points("3", &curve);
            let w = w.line("6", (0.0, ends[0]), (0.0, ends[1])).point("13", sign * 90.0, 200.0);
            w.point("4", sign * 300.0, 150.0).pair(30, "4")
        });
        let first = good(&text);
        let whole = garment(&first);
        let options = PieceOptions { half_on_fold: true, ..PieceOptions::default() };
        for dialect in Dialect::ALL {
            let (again, _) = written(&whole, options, dialect);
            let (a, b) = (&first.pieces[0], &good(&again).pieces[0]);
            let side = |p: &piece::DrawnPiece| vertices(p).iter().all(|(at, _)| at.x * sign > -1e-4);
            assert!(side(a) && side(b), "{dialect:?} {sign} {ends:?}");
            assert_eq!(a.boundary.drawn.len(), b.boundary.drawn.len(), "{dialect:?}");
            let drills = |p: &piece::DrawnPiece| p.inside.drills.iter().map(|d| d.at).collect::<Vec<_>>();
            assert!(drills(a).iter().zip(drills(b)).all(|(p, q)| (p - q).norm() < 1e-4), "{dialect:?}");
            assert!((a.notches[0].at - b.notches[0].at).norm() < 1e-4, "{dialect:?}");
        }
    }
}

#[test]
fn lines_that_pass_the_fold_of_a_half_piece_are_not_lost() {
    // Internal lines that reach 5 mm over the fold, cutouts and stripes on it and beside it.
    let text = file(|w| {
        let w = w.polyline("1", true, &RECTANGLE).line("6", (0.0, 0.0), (0.0, 600.0));
        let w = w.line("8", (-5.0, 100.0), (90.0, 100.0)).line("8", (-5.0, 200.0), (90.0, 200.0));
        let w = w.line("8", (20.0, 300.0), (40.0, 350.0));
        let w = w.polyline("11", true, &[(-20.0, 400.0), (20.0, 400.0), (20.0, 440.0), (-20.0, 440.0)]);
        let w = w.polyline("11", true, &[(60.0, 400.0), (80.0, 400.0), (80.0, 440.0), (60.0, 440.0)]);
        w.line("9", (-50.0, 500.0), (50.0, 500.0)).line("9", (100.0, 100.0), (100.0, 500.0))
    });
    let counts = |p: &piece::DrawnPiece| [p.inside.internal.len(), p.inside.cutouts.len(), p.inside.stripes.len()];
    let first = good(&text);
    assert_eq!(counts(&first.pieces[0]), [3, 2, 2]);
    let whole = garment(&first);
    let of = |g: &Garment| [&g.pieces[0].internal_lines, &g.pieces[0].cutouts, &g.pieces[0].match_lines].map(Vec::len);
    assert_eq!(of(&whole), [6, 3, 3], "what is its own mirror image stands once");
    let options = PieceOptions { half_on_fold: true, ..PieceOptions::default() };
    for dialect in Dialect::ALL {
        let second = good(&written(&whole, options, dialect).0);
        assert_eq!(counts(&second.pieces[0]), [3, 2, 2], "{dialect:?}");
        assert_eq!(of(&garment(&second)), [6, 3, 3], "{dialect:?}");
    }
}

#[test]
fn curve_points_that_no_line_uses_are_said() {
    let square = [(0.0, 0.0), (300.0, 0.0), (300.0, 520.0), (0.0, 520.0)];
    let read = good(&file(|w| {
        let w = w.polyline("1", true, &outline(0.0)).points("2", &front(0.0)[0]).points("3", &front(0.0)[1]);
        // A turn point decides where both kinds stand.
        w.polyline("84", true, &square).points("3", &[(150.0, 610.0), (40.0, 610.0), (300.0, 0.0)])
    }));
    let said: Vec<&Diagnostic> = read.findings.iter().filter(|f| f.code.as_str() == "curve-points-unused").collect();
    assert_eq!(said.len(), 1);
    assert!(said[0].message.starts_with("3 of the 10 curve points"), "{}", said[0].message);
}

/// A second annotation and a fabric beside the material stay texts of the piece, in every dialect.
#[test]
fn texts_that_repeat_a_key_are_kept() {
    let text = file(|w| {
        let w =
            w.polyline("1", true, &RECTANGLE).text_at("1", "Fabric: LINING", 20.0, 30.0).text("1", "Material: SILK");
        w.text("1", "Annotation: PRESS").text_at("8", "ANNOTATION: TURN", 40.0, 50.0).text("1", "Annotation: PRESS")
    });
    let first = garment(&good(&text));
    let piece = &first.pieces[0];
    assert_eq!((piece.material.as_deref(), piece.annotation.as_deref()), (Some("SILK"), Some("PRESS")));
    let mut others: Vec<(&str, &str)> = piece.texts.iter().map(|t| (t.layer.as_str(), t.text.as_str())).collect();
    others.sort_unstable();
    assert_eq!(others, [("1", "Fabric: LINING"), ("8", "ANNOTATION: TURN")]);
    for dialect in Dialect::ALL {
        let again = garment(&good(&written(&first, PieceOptions::default(), dialect).0));
        let twin = &again.pieces[0];
        assert_eq!((&twin.material, &twin.annotation), (&piece.material, &piece.annotation), "{dialect:?}");
        let mut texts = twin.texts.clone();
        texts.sort_by(|a, b| a.layer.cmp(&b.layer));
        let places: Vec<Vec2> = texts.iter().map(|t| t.at * 1e3).collect();
        assert!((places[0] - Vec2::new(20.0, 30.0)).norm() < 1e-4 && (places[1] - Vec2::new(40.0, 50.0)).norm() < 1e-4);
    }
    // An empty text says nothing, so that the next one counts.
    let empty = file(|w| w.polyline("1", true, &RECTANGLE).text("1", "Material: ").text("1", "Material: WOOL"));
    assert_eq!(garment(&good(&empty)).pieces[0].material.as_deref(), Some("WOOL"));
}

#[test]
fn texts_of_the_style_that_are_not_kept_are_said() {
    let body = |w: Writer| w.polyline("1", true, &RECTANGLE);
    let said = |author: &str| {
        let more = |w: Writer| {
            let w = w.text("1", "Units: METRIC").text("1", &format!("Author: {author}")).text("1", "Product: toile 1");
            w.text("1", "Creation Date: 27-11-2026").text("1", "Creation Time: ")
        };
        let (_, findings) = good(&file_with(body, more)).to_garment(None, None).expect("garment");
        findings.iter().map(|f| f.message.clone()).collect::<Vec<_>>()
    };
    let lost = |keys: &str| vec![format!("the garment does not keep these texts of the style: {keys}")];
    assert_eq!(said("Anna;Drafter;3"), lost("`author`, `creation date`"));
    assert_eq!(said("toile;toile;1"), lost("`creation date`"));
}

/// A pocket that is not drawn in the largest size is not in that size of the written run either, with its rule table.
#[test]
fn a_piece_that_a_size_lacks_is_lacking_in_a_written_size_run() {
    let pocket = |w: Writer, size: &str, k: f64| {
        let w = w.block(&format!("POCKET_{size}")).text("1", "Piece Name: POCKET").text("1", &format!("Size: {size}"));
        let w = w.polyline("1", true, &[(400.0, 0.0), (500.0 + k, 0.0), (500.0 + k, 100.0), (400.0, 100.0)]);
        w.line("7", (420.0, 20.0), (420.0, 80.0)).pair(0, "ENDBLK")
    };
    let w = Writer::default().pair(0, "SECTION").pair(2, "BLOCKS");
    let sizes = [("36", -9.0), ("38", 0.0), ("40", 60.0)];
    let w = sizes.iter().fold(w, |w, (size, k)| block(w, size, *k, *size == "38", false));
    let w = pocket(pocket(w, "36", -5.0), "38", 0.0).pair(0, "ENDSEC").pair(0, "SECTION").pair(2, "ENTITIES");
    let w = w.text("1", "Units: METRIC").text("1", "Sample Size: 38").pair(0, "ENDSEC").pair(0, "EOF");
    let run = Sizes::new(&good(&w.0), None).expect("sizes").draw(PieceOptions::default());
    assert_eq!(codes(&run.findings), ["piece-not-in-size", "sizes-without-rules"]);
    let rules = run.table.as_ref().expect("rules");
    for dialect in Dialect::ALL {
        let bytes = write(&run.drawing, dialect).expect("written").bytes;
        let again = good(&String::from_utf8(bytes).expect("ascii"));
        let table = crate::rul::write(rules, dialect.is_astm(), dialect != Dialect::Clo);
        let table = crate::rul::read(&table, "t.rul").expect("rules");
        for (size, count) in [("36", 2), ("38", 2), ("40", 1)] {
            let (garment, _) = again.to_garment(Some(size), Some(&table)).expect("garment");
            assert_eq!(garment.pieces.len(), count, "{dialect:?} {size}");
        }
    }
}

/// A written size run holds all sizes and pieces: a choice of them is no remedy for one that crosses itself.
#[test]
fn a_size_run_does_not_advise_to_choose_sizes() {
    let w = Writer::default().pair(0, "SECTION").pair(2, "BLOCKS");
    let sizes = [("36", -9.0), ("38", 0.0)];
    let w = sizes.iter().fold(w, |w, (size, k)| block(w, size, *k, *size == "38", false));
    let w = w.block("BOW_38").text("1", "Piece Name: BOW").text("1", "Size: 38");
    let w = w.polyline("1", true, &[(400.0, 0.0), (500.0, 100.0), (520.0, 0.0), (400.0, 120.0)]).pair(0, "ENDBLK");
    let w = w.pair(0, "ENDSEC").pair(0, "SECTION").pair(2, "ENTITIES");
    let w = w.text("1", "Units: METRIC").text("1", "Sample Size: 38").pair(0, "ENDSEC").pair(0, "EOF");
    let pattern = read(w.0.as_bytes(), "t.dxf", &ReadOptions::default()).expect("a pattern");
    let one = pattern.to_garment(Some("38"), None).expect_err("crosses itself");
    assert_eq!(codes(&one), ["outline-crosses-itself", "sound-parts"]);
    let run = Sizes::new(&pattern, None).err().expect("crosses itself");
    assert_eq!(codes(&run), ["outline-crosses-itself"]);
}
