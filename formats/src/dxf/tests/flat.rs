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
