//! Flat drawings: closed lines of ENTITIES, in a frame or not, with open lines beside them.

use super::*;

const FRONT: [(f64, f64); 4] = [(0.0, 0.0), (300.0, 0.0), (260.0, 420.0), (20.0, 420.0)];

fn shifted(dx: f64) -> Vec<(f64, f64)> {
    FRONT.iter().map(|(x, y)| (x + dx, *y)).collect()
}

fn flat(body: impl Fn(Writer) -> Writer) -> String {
    let w = Writer::default().pair(0, "SECTION").pair(2, "ENTITIES").text("0", "Units: METRIC");
    body(w).pair(0, "ENDSEC").pair(0, "EOF").0
}

fn areas(pattern: &Pattern) -> Vec<f64> {
    pattern.pieces.iter().map(|p| geom::area(&p.boundary.positions()).round()).collect()
}

#[test]
fn notch_ticks_outside_the_outline_are_notches() {
    for out in [0.0001, 0.02, 0.4] {
        let text = flat(|w| {
            let w = w.polyline("0", true, &FRONT).polyline("0", true, &shifted(400.0));
            let w = w.polyline("0", false, &[(150.0, -out), (150.0, 5.0)]);
            w.line("0", (550.0, 5.0), (550.0, -out)).polyline(
                "0",
                false,
                &[(100.0, 100.0), (150.0, 180.0), (200.0, 100.0)],
            )
        });
        let pattern = good(&text);
        assert_eq!((areas(&pattern), pattern.refused.len()), (vec![113_400.0; 2], 0), "{out}");
        for piece in &pattern.pieces {
            let [notch] = piece.notches.as_slice() else { panic!("{out}: {:?}", piece.notches) };
            assert!(notch.on == "boundary" && notch.at.y.abs() <= out && (notch.depth - 5.0).abs() <= out + 1e-9);
        }
        assert_eq!(pattern.pieces[0].inside.internal.len(), 1);
    }
}

#[test]
fn an_open_outline_is_refused_alone_and_strays_are_said() {
    let text = flat(|w| {
        let w = w.polyline("0", true, &FRONT).polyline("0", false, &shifted(400.0));
        w.line("0", (1000.0, 0.0), (1100.0, 0.0))
    });
    let pattern = good(&text);
    // The side of 420 mm is missing: that is no gap of an outline.
    assert_eq!((pattern.pieces.len(), pattern.refused.len()), (1, 0));
    let said = pattern.findings.iter().find(|f| f.code == "entities-left-out").expect("said");
    assert!(said.message.starts_with("2 open line(s)"), "{}", said.message);
    let mut gap = shifted(400.0);
    gap.push((401.0, 30.0));
    let pattern = good(&flat(|w| w.polyline("0", true, &FRONT).polyline("0", false, &gap)));
    assert_eq!(codes(&pattern.refused[0].faults), ["outline-open"]);
}

#[test]
fn a_plot_frame_is_left_out_and_said() {
    let frame = [(-50.0, -50.0), (850.0, -50.0), (850.0, 550.0), (-50.0, 550.0)];
    for layer in ["0", "1"] {
        let text = flat(|w| {
            w.polyline(layer, true, &frame).polyline(layer, true, &FRONT).polyline(layer, true, &shifted(400.0))
        });
        let pattern = good(&text);
        assert_eq!(areas(&pattern), [113_400.0; 2]);
        let said = pattern.findings.iter().find(|f| f.code == "plot-frame-left-out").expect("said");
        assert!(said.message.contains("900 × 600 mm"), "{}", said.message);
        assert_eq!(pattern.ledger.count(ledger::Verdict::Refused), 1);
    }
    // A front with two pockets, and one with a big cutout, are pieces.
    let pocket = |x: f64| [(x, 300.0), (x + 100.0, 300.0), (x + 100.0, 420.0), (x, 420.0)];
    let pockets = good(&flat(|w| {
        w.polyline("0", true, &RECTANGLE).polyline("0", true, &pocket(30.0)).polyline("0", true, &pocket(170.0))
    }));
    assert_eq!((areas(&pockets), pockets.pieces[0].inside.internal.len()), (vec![180_000.0], 2));
    let hole = [(40.0, 60.0), (260.0, 60.0), (260.0, 540.0), (40.0, 540.0)];
    let facing = good(&flat(|w| w.polyline("0", true, &RECTANGLE).polyline("0", true, &hole)));
    assert_eq!(facing.pieces.len(), 1);
}

fn rectangle(x: f64, y: f64, w: f64, h: f64) -> [(f64, f64); 4] {
    [(x, y), (x + w, y), (x + w, y + h), (x, y + h)]
}

/// A drawing of closed lines on layer 0.
fn lines(list: &[&[(f64, f64)]]) -> Pattern {
    good(&flat(|w| list.iter().fold(w, |w, line| w.polyline("0", true, line))))
}

fn said(pattern: &Pattern, code: &str) -> usize {
    pattern.findings.iter().filter(|f| f.code == code).count()
}

#[test]
fn a_double_frame_and_a_frame_with_a_piece_beside_it_are_left_out() {
    let frame = rectangle(-50.0, -50.0, 900.0, 600.0);
    let (second, beside) = (shifted(400.0), shifted(1000.0));
    let double = lines(&[&rectangle(-60.0, -60.0, 920.0, 620.0), &frame, &FRONT, &second]);
    assert_eq!((areas(&double), said(&double, "plot-frame-left-out")), (vec![113_400.0; 2], 2));
    let one_outside = lines(&[&frame, &FRONT, &second, &beside]);
    assert_eq!((areas(&one_outside), said(&one_outside, "plot-frame-left-out")), (vec![113_400.0; 3], 1));
    // A back with two large pockets beside other pieces is no frame, and told.
    let pockets = [rectangle(20.0, 300.0, 120.0, 260.0), rectangle(160.0, 300.0, 120.0, 260.0)];
    let back = lines(&[&RECTANGLE, &pockets[0], &pockets[1], &second, &beside]);
    assert_eq!((back.pieces.len(), said(&back, "plot-frame-undecided")), (3, 1));
}

#[test]
fn what_may_be_a_frame_or_a_piece_is_said() {
    let frame = rectangle(-50.0, -50.0, 900.0, 600.0);
    let title = rectangle(640.0, -40.0, 200.0, 60.0);
    for list in [vec![&frame[..], &FRONT], vec![&frame[..], &FRONT, &title]] {
        let pattern = lines(&list);
        assert_eq!((areas(&pattern), said(&pattern, "plot-frame-undecided")), (vec![540_000.0], 1));
    }
    // A rectangle with its sew line and small marks is a piece without doubt, and so is what lies in another piece.
    let sewn = lines(&[&RECTANGLE, &rectangle(10.0, 10.0, 280.0, 580.0), &rectangle(50.0, 50.0, 20.0, 8.0)]);
    assert_eq!((said(&sewn, "plot-frame-undecided"), sewn.pieces[0].sew.is_some()), (0, true));
    let flap = [rectangle(60.0, 100.0, 150.0, 150.0), rectangle(100.0, 140.0, 60.0, 60.0)];
    assert_eq!(said(&lines(&[&FRONT, &flap[0], &flap[1]]), "plot-frame-undecided"), 0);
}

/// The remedy of the warning works: without the frame, or with its layer left out, the piece is read.
#[test]
fn a_frame_on_a_layer_of_its_own_can_be_left_out() {
    let frame = rectangle(-50.0, -50.0, 900.0, 600.0);
    let text = flat(|w| w.polyline("FRAME", true, &frame).polyline("0", true, &FRONT));
    let layers = [("FRAME".to_owned(), "ignore".to_owned())].into();
    let pattern = read(text.as_bytes(), "t.dxf", &ReadOptions { layers, ..ReadOptions::default() }).expect("read");
    assert_eq!((areas(&pattern), said(&pattern, "plot-frame-undecided")), (vec![113_400.0], 0));
    assert_eq!(areas(&lines(&[&FRONT])), [113_400.0]);
}

/// A text on layer 0 at a place.
fn note(w: Writer, x: f64, y: f64, text: &str) -> Writer {
    w.pair(0, "TEXT").pair(8, "0").xy(x, y).pair(1, text)
}

#[test]
fn a_title_block_is_no_piece() {
    let title = rectangle(900.0, 0.0, 180.0, 60.0);
    let both = |w: Writer| w.polyline("0", true, &FRONT).polyline("0", true, &shifted(400.0));
    let words = |w: Writer| note(note(w, 910.0, 40.0, "STYLE 4711"), 910.0, 10.0, "Scale 1:1");
    let plain = good(&flat(|w| words(both(w).polyline("0", true, &title))));
    assert_eq!((areas(&plain), said(&plain, "plot-frame-left-out")), (vec![113_400.0; 2], 1));
    // A table: in one rectangle with lines across, and in cells that touch.
    let lined = good(&flat(|w| {
        let w = both(w).polyline("0", true, &title).line("0", (900.0, 30.0), (1080.0, 30.0));
        note(note(w, 910.0, 40.0, "4711 A"), 910.0, 10.0, "Date 1.1.26")
    }));
    assert_eq!((areas(&lined), said(&lined, "plot-frame-left-out")), (vec![113_400.0; 2], 1));
    let cells = good(&flat(|w| {
        let w = both(w).polyline("0", true, &rectangle(900.0, 0.0, 90.0, 30.0));
        let w = w.polyline("0", true, &rectangle(990.0, 0.0, 90.0, 30.0));
        note(note(w, 910.0, 10.0, "款号 4711"), 1000.0, 10.0, "A. Name")
    }));
    assert_eq!((areas(&cells), said(&cells, "plot-frame-left-out")), (vec![113_400.0; 2], 1));
    // A waistband with its labels is a piece; where they may be those of a sheet, that is told.
    for (labels, doubts) in [(["PIECE: BAND", "Style 4711"], 0), (["CUT ON GRAIN", "interline"], 1)] {
        let band = good(&flat(|w| {
            let w = both(w).polyline("0", true, &title);
            note(note(w, 910.0, 40.0, labels[0]), 910.0, 10.0, labels[1])
        }));
        assert_eq!((band.pieces.len(), said(&band, "plot-frame-undecided")), (3, doubts), "{labels:?}");
    }
}
