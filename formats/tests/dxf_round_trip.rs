//! The reader reads what the writer writes: the sample patterns, out and in again.

use std::path::PathBuf;
use toile_formats::dxf::write::{Dialect, Drawing, PieceOptions, Sizes, StyleText, piece_drawing, write};
use toile_formats::dxf::{ReadOptions, geom, inspect, read};
use toile_formats::rul;
use toile_garment::outline::{PieceLine, PointKind};
use toile_garment::{Garment, Piece, Severity};

fn import(bytes: &[u8], name: &str, size: &str) -> Garment {
    let pattern = read(bytes, name, &ReadOptions::default()).expect("read");
    let (garment, findings) = pattern.to_garment(Some(size), None).expect("garment");
    for f in &findings {
        assert!(f.severity != Severity::Error, "{name} {size}: {f}");
    }
    garment
}

fn export(garment: &Garment, dialect: Dialect) -> Vec<u8> {
    let mut findings = Vec::new();
    let pieces = garment.pieces.iter().map(|p| piece_drawing(p, PieceOptions::default(), &mut findings)).collect();
    let style = StyleText { name: garment.style.clone(), sample_size: garment.size.clone(), ..StyleText::default() };
    write(&Drawing { style, pieces }, dialect).expect("written").bytes
}

/// Curves that are read back keep this near, mm: the chords of both are up to 0.05 mm off. Where the dialect has a
/// dense copy, all vertices of a line come back. Else its corners and curve points do, and the reader makes the curve.
const CURVE: f64 = 0.1;

fn same_curve(a: &PieceLine, b: &PieceLine, dialect: Dialect, what: &str) {
    let marked = |l: &PieceLine| l.points.iter().filter(|p| p.kind != PointKind::Plain).cloned().collect::<Vec<_>>();
    let (p, q) = if dialect.has_dense() { (a.points.clone(), b.points.clone()) } else { (marked(a), marked(b)) };
    assert_eq!(p.len(), q.len(), "{what}");
    assert!(p.iter().zip(&q).all(|(p, q)| (p.at - q.at).norm() < 1e-6 && p.kind == q.kind), "{what}");
    let off = geom::deviation(&a.positions(), &b.positions(), true) * 1e3;
    assert!(off <= CURVE, "{what}: {off} mm");
}

fn same(a: &Piece, b: &Piece, dialect: Dialect) {
    same_curve(&a.outline, &b.outline, dialect, &a.name);
    assert_eq!(a.cut_line.is_some(), b.cut_line.is_some());
    if let Some((a, b)) = a.cut_line.as_ref().zip(b.cut_line.as_ref()) {
        same_curve(a, b, dialect, "cut line");
    }
    let lines = |p: &Piece| {
        let mut v = p.internal_lines.clone();
        v.extend(p.cutouts.clone());
        v.extend(p.match_lines.clone());
        v
    };
    let (la, lb) = (lines(a), lines(b));
    assert_eq!(la.len(), lb.len(), "{}", a.name);
    for (x, y) in la.iter().zip(&lb) {
        assert_eq!(x.points.len(), y.points.len(), "{}", a.name);
        for (p, q) in x.points.iter().zip(&y.points) {
            assert!((p.at - q.at).norm() < 1e-6, "{}: {} against {}", a.name, p.at, q.at);
        }
    }
    assert_eq!(a.edges.len(), b.edges.len());
    assert_eq!(a.notches.len(), b.notches.len());
    for (x, y) in a.notches.iter().zip(&b.notches) {
        assert!((x.at - y.at).norm() < 1e-6);
        assert_eq!(x.kind, y.kind);
    }
    assert_eq!(a.darts.len(), b.darts.len(), "{}", a.name);
    for (x, y) in a.darts.iter().zip(&b.darts) {
        assert_eq!(x.kind, y.kind);
        assert!(x.apexes.iter().zip(&y.apexes).all(|(p, q)| (p - q).norm() < 1e-6));
        assert!((x.intake() - y.intake()).abs() < 1e-6);
    }
    assert_eq!(a.drill_holes.len(), b.drill_holes.len());
    for (x, y) in a.drill_holes.iter().zip(&b.drill_holes) {
        assert!((x.at - y.at).norm() < 1e-6 && x.diameter.is_some() == y.diameter.is_some());
        assert!((x.diameter.unwrap_or(0.0) - y.diameter.unwrap_or(0.0)).abs() < 1e-6);
    }
    let texts = |p: &Piece| p.texts.iter().map(|t| (t.layer.clone(), t.text.clone())).collect::<Vec<_>>();
    assert_eq!(texts(a), texts(b), "{}", a.name);
    let g = |p: &Piece| p.grain.expect("grain");
    assert!((g(a)[0] - g(b)[0]).norm() < 1e-6 && (g(a)[1] - g(b)[1]).norm() < 1e-6);
    assert_eq!((&a.name, &a.size, &a.material, &a.category), (&b.name, &b.size, &b.material, &b.category));
}

#[test]
fn samples_go_out_and_in_unchanged() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../samples/patterns");
    for style in ["long-skirt", "fitted-bodice", "t-shirt"] {
        for word in ["aama", "astm"] {
            let name = format!("{style}.{word}.dxf");
            let bytes = std::fs::read(folder.join(&name)).expect("sample");
            for size in ["36", "38", "40"] {
                let first = import(&bytes, &name, size);
                for dialect in Dialect::ALL {
                    let second = import(&export(&first, dialect), "again.dxf", size);
                    assert_eq!(first.pieces.len(), second.pieces.len());
                    for (a, b) in first.pieces.iter().zip(&second.pieces) {
                        same(a, b, dialect);
                    }
                }
            }
        }
    }
}

/// Pairs of a small DXF.
struct Text(String);

impl Text {
    fn pair(mut self, code: i32, value: &str) -> Self {
        self.0.push_str(&format!("{code}\n{value}\n"));
        self
    }

    fn xy(self, code: i32, x: f64, y: f64) -> Self {
        self.pair(code, &x.to_string()).pair(code + 10, &y.to_string())
    }

    fn text(self, layer: &str, text: &str, x: f64, y: f64) -> Self {
        self.pair(0, "TEXT").pair(8, layer).xy(10, x, y).pair(1, text)
    }

    fn polyline(self, layer: &str, closed: bool, points: &[(f64, f64)]) -> Self {
        let mut w = self.pair(0, "POLYLINE").pair(8, layer).pair(70, if closed { "1" } else { "0" });
        for (x, y) in points {
            w = w.pair(0, "VERTEX").pair(8, layer).xy(10, *x, *y);
        }
        w.pair(0, "SEQEND")
    }

    fn points(self, layer: &str, list: &[(f64, f64)]) -> Self {
        list.iter().fold(self, |w, (x, y)| w.pair(0, "POINT").pair(8, layer).xy(10, *x, *y))
    }

    fn line(self, layer: &str, a: (f64, f64), b: (f64, f64)) -> Self {
        self.pair(0, "LINE").pair(8, layer).xy(10, a.0, a.1).xy(11, b.0, b.1)
    }
}

const SEW: [(f64, f64); 7] =
    [(0.0, 0.0), (300.0, 0.0), (300.0, 600.0), (165.0, 600.0), (150.0, 500.0), (135.0, 600.0), (0.0, 600.0)];

/// One piece in one size with everything a piece can hold; `k` grows it.
fn block(w: Text, size: &str, k: f64) -> Text {
    let grow = |list: &[(f64, f64)]| {
        list.iter().map(|(x, y)| (x * (1.0 + k / 300.0), y)).map(|(x, y)| (x, *y)).collect::<Vec<_>>()
    };
    let cut = grow(&[(-10.0, -10.0), (310.0, -10.0), (312.0, 300.0), (310.0, 610.0), (-10.0, 610.0)]);
    let w = w.pair(0, "BLOCK").pair(8, "0").pair(2, &format!("X_{size}")).xy(10, 0.0, 0.0);
    let w = w.text("1", "Piece Name: 前片 côté / a very long name of a piece", 1.0, 1.0).text(
        "1",
        &format!("Size: {size}"),
        1.0,
        1.0,
    );
    let w = w.text("1", "Quantity: 1,1", 1.0, 1.0).text("1", "Material: étoffe", 1.0, 1.0).text(
        "1",
        "Category: front",
        1.0,
        1.0,
    );
    let w = w
        .text("1", "Annotation: éclair \u{1F457}", 1.0, 1.0)
        .text("15", "note %% 1", 50.0, 50.0)
        .text("8", "NM", 40.0, 40.0);
    let w = w.text("1", "Stretch Direction: Both: ways", 5.0, 5.0);
    let w = w.polyline("1", true, &cut).polyline("14", true, &grow(&SEW));
    let turns: Vec<_> = cut.iter().enumerate().filter(|(i, _)| *i != 2).map(|(_, p)| *p).chain(grow(&SEW)).collect();
    let w = w.points("2", &turns).points("3", &[cut[2]]);
    let w = w.points("4", &grow(&[(310.0, 100.0)])).pair(30, "4").pair(39, "3").pair(50, "180");
    let w = w.points("4", &grow(&[(-10.0, 100.0)])).pair(30, "5").pair(39, "0").pair(50, "0");
    let w = w.points("13", &grow(&[(150.0, 510.0)])).pair(30, "2.5").points("13", &grow(&[(50.0, 500.0)]));
    let w =
        w.line("7", (60.0, 150.0), (60.0, 450.0)).line("9", (0.0, 200.0), (300.0, 200.0)).points("10", &[(20.0, 20.0)]);
    let w = w.polyline("8", false, &grow(&[(40.0, 40.0), (120.0, 60.0), (200.0, 40.0)]));
    let w = w.polyline("8", true, &grow(&[(220.0, 450.0), (214.0, 350.0), (220.0, 250.0), (226.0, 350.0)]));
    let w = w.polyline("11", true, &grow(&[(40.0, 300.0), (60.0, 300.0), (60.0, 320.0), (40.0, 320.0)]));
    w.pair(0, "ENDBLK")
}

fn nest(sizes: &[(&str, f64)]) -> String {
    let w = Text(String::new()).pair(0, "SECTION").pair(2, "BLOCKS");
    let w = sizes.iter().fold(w, |w, (size, k)| block(w, size, *k)).pair(0, "ENDSEC");
    let w = w.pair(0, "SECTION").pair(2, "ENTITIES").text("1", "Style Name: TOUT", 0.0, 0.0);
    w.text("1", "Units: METRIC", 0.0, 0.0).text("1", "Sample Size: 38", 0.0, 0.0).pair(0, "ENDSEC").pair(0, "EOF").0
}

#[test]
fn everything_a_piece_holds_goes_out_and_in() {
    let text = nest(&[("38", 0.0)]);
    let first = import(text.as_bytes(), "all.dxf", "38");
    let piece = &first.pieces[0];
    assert_eq!((piece.darts.len(), piece.match_lines.len(), piece.drill_holes.len(), piece.texts.len()), (2, 2, 2, 3));
    for dialect in Dialect::ALL {
        let bytes = export(&first, dialect);
        assert!(bytes.is_ascii());
        let second = import(&bytes, "again.dxf", "38");
        let mut back = second.pieces[0].clone();
        if dialect == Dialect::Gerber {
            // Names of 20 ASCII characters: the one loss, and it is told.
            assert_eq!(back.name, "-- cote - a very lon");
            back = Piece {
                name: piece.name.clone(),
                material: piece.material.clone(),
                annotation: piece.annotation.clone(),
                ..back
            };
        }
        same(piece, &back, dialect);
        assert_eq!(piece.annotation, back.annotation, "{dialect:?}");
        let sides = if dialect.is_astm() { (1, 1) } else { (2, 0) };
        assert_eq!((back.quantity.plain, back.quantity.mirrored), sides);
        assert_eq!(piece.edges.len(), back.edges.len());
    }
}

#[test]
fn a_size_run_goes_out_with_its_rules_and_grades_back() {
    let sizes = [("36", -9.0), ("38", 0.0), ("40", 12.0), ("42", 30.0)];
    let text = nest(&sizes);
    let pattern = read(text.as_bytes(), "nest.dxf", &ReadOptions::default()).expect("nest");
    let run = Sizes::new(&pattern, None).expect("sizes").draw(PieceOptions::default());
    assert_eq!(run.findings, []);
    let table = run.table.as_ref().expect("table");
    assert_eq!(
        (table.sizes.clone(), table.sample.as_deref()),
        (vec!["36".into(), "38".into(), "40".into(), "42".into()], Some("38"))
    );
    for dialect in Dialect::ALL {
        let bytes = write(&run.drawing, dialect).expect("written").bytes;
        let rules = rul::write(table, dialect.is_astm(), dialect != Dialect::Clo);
        let back = rul::read(&rules, "nest.rul").expect("rules");
        assert_eq!((&back.sizes, back.rules.len()), (&table.sizes, table.rules.len()));
        // Every size is drawn again.
        for (size, _) in sizes {
            let (first, second) = (import(text.as_bytes(), "nest.dxf", size), import(&bytes, "again.dxf", size));
            let (a, b) = (first.pieces[0].outline.positions(), second.pieces[0].outline.positions());
            assert!(a.len() == b.len() && a.iter().zip(&b).all(|(p, q)| (p - q).norm() < 1e-6), "{dialect:?} {size}");
        }
        // The sample size alone with the rules gives the corners of every other size within 0.01 mm.
        let json = inspect(&bytes, "nest.dxf", Some(&rules)).expect("inspection").json;
        assert_eq!(json["size_run"], serde_json::json!(["36", "38", "40", "42"]));
        let name = json["pieces"][1]["name"].as_str().expect("name").to_owned();
        for (size, k) in sizes {
            let graded = json["graded_turn_points_mm"][&name][size].as_array().expect("graded").clone();
            for (x, y) in SEW {
                let at = (x * (1.0 + k / 300.0), y);
                let near = graded
                    .iter()
                    .any(|g| libm::hypot(g[0].as_f64().expect("x") - at.0, g[1].as_f64().expect("y") - at.1) <= 0.01);
                assert!(near, "{dialect:?} {size}: {at:?} not in {graded:?}");
            }
        }
    }
}

#[test]
fn marks_for_the_cutting_room_are_added_once() {
    let first = import(nest(&[("38", 0.0)]).as_bytes(), "all.dxf", "38");
    let mut bare = first.pieces[0].clone();
    bare.drill_holes.clear();
    let mut findings = Vec::new();
    let options = PieceOptions { mark_darts: true, ..PieceOptions::default() };
    let drawn = piece_drawing(&bare, options, &mut findings);
    // A wedge has one hole 10 mm from its apex and two notches, a fish-eye a hole at each end.
    assert_eq!((drawn.drill_holes.len(), drawn.notches.len()), (3, 4));
    assert!((drawn.drill_holes[0].at - toile_garment::Vec2::new(150.0, 510.0)).norm() < 1e-9);
    let again = piece_drawing(&first.pieces[0], options, &mut findings);
    assert_eq!(again.drill_holes.iter().filter(|d| (d.at.x - 150.0).abs() < 1.0).count(), 1);
}
