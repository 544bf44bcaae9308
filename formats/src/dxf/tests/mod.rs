//! Fixtures of each deviation, written here tag by tag.

mod binary;
mod blocks;
mod dart_evidence;
mod dart_forms;
mod dart_loose;
mod darts;
mod doubts;
mod flat;
mod fold_forms;
mod foreign;
mod lines;
mod marks;
mod narrow;
mod nests;
mod refused;
mod sizes;
mod text;
mod unchanged;
mod vendors;

use super::*;
use toile_garment::dart::DartKind;
use toile_garment::notch::NotchKind;
use toile_garment::{Diagnostic, Garment, Severity};

/// Writes DXF text pair by pair.
#[derive(Clone, Default)]
struct Writer(String);

impl Writer {
    fn pair(mut self, code: i32, value: &str) -> Self {
        self.0.push_str(&format!("{code:>3}\n{value}\n"));
        self
    }

    fn xy(self, x: f64, y: f64) -> Self {
        self.pair(10, &x.to_string()).pair(20, &y.to_string())
    }

    fn text(self, layer: &str, text: &str) -> Self {
        self.text_at(layer, text, 100.0, 300.0)
    }

    fn text_at(self, layer: &str, text: &str, x: f64, y: f64) -> Self {
        self.pair(0, "TEXT").pair(8, layer).xy(x, y).pair(40, "0.25").pair(1, text)
    }

    fn polyline(self, layer: &str, closed: bool, points: &[(f64, f64)]) -> Self {
        let mut w = self.pair(0, "POLYLINE").pair(8, layer).pair(66, "1").pair(70, if closed { "1" } else { "0" });
        for (x, y) in points {
            w = w.pair(0, "VERTEX").pair(8, layer).xy(*x, *y);
        }
        w.pair(0, "SEQEND")
    }

    fn line(self, layer: &str, a: (f64, f64), b: (f64, f64)) -> Self {
        let w = self.pair(0, "LINE").pair(8, layer).xy(a.0, a.1);
        w.pair(11, &b.0.to_string()).pair(21, &b.1.to_string())
    }

    fn point(self, layer: &str, x: f64, y: f64) -> Self {
        self.pair(0, "POINT").pair(8, layer).xy(x, y)
    }

    fn points(self, layer: &str, list: &[(f64, f64)]) -> Self {
        list.iter().fold(self, |w, (x, y)| w.point(layer, *x, *y))
    }

    fn block(self, name: &str) -> Self {
        self.pair(0, "BLOCK").pair(8, "0").pair(2, name).pair(70, "64").xy(0.0, 0.0)
    }
}

const RECTANGLE: [(f64, f64); 4] = [(0.0, 0.0), (300.0, 0.0), (300.0, 600.0), (0.0, 600.0)];
const WEDGE: [(f64, f64); 7] =
    [(0.0, 0.0), (300.0, 0.0), (300.0, 600.0), (165.0, 600.0), (150.0, 500.0), (135.0, 600.0), (0.0, 600.0)];

/// One piece FRONT in size 38 with what `body` puts into its block, and `more` in ENTITIES.
fn file_with(body: impl Fn(Writer) -> Writer, more: impl Fn(Writer) -> Writer) -> String {
    let w = Writer::default().pair(0, "SECTION").pair(2, "HEADER").pair(0, "ENDSEC");
    let w = w.pair(0, "SECTION").pair(2, "BLOCKS").block("FRONT_38");
    let w = body(w.text("1", "Piece Name: FRONT").text("1", "SIZE: 38")).line("7", (60.0, 150.0), (60.0, 450.0));
    let w = w.pair(0, "ENDBLK").pair(0, "ENDSEC").pair(0, "SECTION").pair(2, "ENTITIES");
    let w = w.pair(0, "INSERT").pair(8, "1").pair(2, "FRONT_38").xy(0.0, 0.0);
    more(w.text("1", "Style Name: TEST").text("1", "Sample Size: 38")).pair(0, "ENDSEC").pair(0, "EOF").0
}

fn file(body: impl Fn(Writer) -> Writer) -> String {
    file_with(body, |w| w.text("1", "Units: METRIC"))
}

/// The file with an INSERT of one more block.
fn inserting(text: &str, block: &str) -> String {
    let insert = Writer::default().pair(0, "INSERT").pair(8, "1").pair(2, block).0;
    text.replacen("  0\nINSERT\n", &format!("{insert}  0\nINSERT\n"), 1)
}

fn good(text: &str) -> Pattern {
    read(text.as_bytes(), "t.dxf", &ReadOptions::default()).unwrap_or_else(|e| panic!("{e:?}"))
}

fn bad(text: &str) -> Vec<Diagnostic> {
    read(text.as_bytes(), "t.dxf", &ReadOptions::default()).expect_err("must be refused")
}

fn codes(list: &[Diagnostic]) -> Vec<&str> {
    list.iter().map(|d| d.code.as_str()).collect()
}

fn garment(pattern: &Pattern) -> Garment {
    pattern.to_garment(None, None).expect("garment").0
}

fn wedge_file() -> String {
    file(|w| w.polyline("1", true, &WEDGE).points("2", &WEDGE))
}

/// The piece every harmless deviation must still give.
fn assert_wedge(pattern: &Pattern) {
    let piece = &pattern.pieces[0];
    assert!((geom::area(&piece.boundary.positions()) - 178_500.0).abs() < 20.0);
    assert_eq!(piece.darts.len(), 1);
    assert!((piece.darts[0].apexes[0].y - 500.0).abs() < 1e-9);
    assert!((piece.darts[0].leg_path(0) - 101.119).abs() < 1e-3);
    let l = &pattern.ledger;
    let sum = [ledger::Verdict::Accepted, ledger::Verdict::Interpreted, ledger::Verdict::Refused].map(|v| l.count(v));
    assert_eq!(sum.iter().sum::<usize>(), l.entities());
}
