//! Fixtures of each deviation, written here tag by tag.

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

#[test]
fn plain_piece_without_any_warning() {
    let pattern = good(&wedge_file());
    assert_wedge(&pattern);
    assert_eq!(codes(&pattern.findings), [] as [&str; 0]);
    assert_eq!((pattern.ledger.count(ledger::Verdict::Refused), pattern.sizes.len()), (0, 1));
    let g = garment(&pattern);
    let piece = &g.pieces[0];
    assert_eq!((g.style.as_str(), g.size.as_deref(), piece.name.as_str()), ("TEST", Some("38"), "FRONT"));
    assert!((piece.outline.signed_area() - 0.1785).abs() < 1e-9, "counter-clockwise, metres");
    assert_eq!((piece.edges.len(), piece.darts.len()), (7, 1));
    let dart = &piece.darts[0];
    assert_eq!(dart.kind, DartKind::Wedge);
    // Legs run from the mouth to the apex on vertices of the outline, the first one met counter-clockwise.
    assert_eq!(dart.legs[0][0], toile_garment::Vec2::new(0.165, 0.6));
    let outline = piece.outline.positions();
    assert!(dart.legs.iter().flatten().all(|p| outline.contains(p)));
    assert_eq!(piece.grain.map(|g| (g[1] - g[0]).y), Some(0.45 - 0.15));
}

#[test]
fn text_forms_change_nothing() {
    let plain = wedge_file();
    let forms = [
        plain.replace('\n', "\r\n"),
        plain.replace('\n', "\r"),
        plain.replacen('\n', "\r\n", 40),
        format!("\u{FEFF}{plain}"),
        format!("999\na comment\n{plain}"),
        plain.replace("POLYLINE", "polyline").replace("SECTION", "Section").replace("VERTEX", "vertex"),
        plain.replacen("  8\n1\n", "  8\n1\n250\n2\n5000\nx\n155\ny\n", 3),
        plain.replace("HEADER\n", "HEADER\n  9\n$TDCREATE\n 40\n1e300\n"),
        plain.replace("  0\nSECTION\n  2\nHEADER\n  0\nENDSEC\n", ""),
        plain.replace("\n1\n", "\n  1 \n"),
    ];
    for form in forms {
        assert_wedge(&good(&form));
    }
}

#[test]
fn missing_end_mark_and_blank_lines_are_said() {
    let plain = wedge_file();
    let no_eof = good(&plain.replace("  0\nEOF\n", ""));
    assert_wedge(&no_eof);
    assert_eq!(codes(&no_eof.findings), ["eof-missing"]);
    let blank = good(&plain.replacen("  0\nVERTEX", "\n  0\nVERTEX", 1));
    assert_wedge(&blank);
    assert_eq!(codes(&blank.findings), ["blank-line"]);
    assert!(blank.findings[0].source.as_ref().is_some_and(|s| s.line.is_some()));
    let seqend = good(&plain.replacen("  0\nSEQEND\n", "", 1));
    assert_wedge(&seqend);
    assert_eq!(codes(&seqend.findings), ["polyline-without-seqend"]);
}

#[test]
fn a_cut_file_never_gives_a_shorter_piece() {
    let plain = wedge_file();
    let whole = good(&plain);
    let area = geom::area(&whole.pieces[0].boundary.positions());
    for cut in (0..plain.len()).step_by(7) {
        if let Ok(pattern) = read(&plain.as_bytes()[..cut], "t.dxf", &ReadOptions::default()) {
            assert_eq!(pattern.pieces.len(), 1, "cut at {cut}");
            assert_eq!(geom::area(&pattern.pieces[0].boundary.positions()), area, "cut at {cut}");
            assert!(pattern.findings.iter().any(|f| f.severity == Severity::Warning), "cut at {cut}");
        }
    }
}

#[test]
fn lost_lines_are_never_silent() {
    let plain = wedge_file();
    let lines: Vec<&str> = plain.lines().collect();
    let start = lines.iter().position(|l| *l == "POLYLINE").expect("polyline");
    let end = lines.iter().position(|l| *l == "SEQEND").expect("seqend");
    for lost in start..end {
        let rest: Vec<&str> = lines.iter().enumerate().filter(|(i, _)| *i != lost).map(|(_, l)| *l).collect();
        if let Ok(pattern) = read(rest.join("\n").as_bytes(), "t.dxf", &ReadOptions::default()) {
            panic!("line {} lost, and still {} vertices", lost + 1, pattern.pieces[0].boundary.drawn.len());
        }
    }
}

#[test]
fn bad_numbers_are_refused_with_their_line() {
    let cases = [
        ("165,0", "decimal-comma"),
        ("nan", "bad-number"),
        ("inf", "bad-number"),
        ("1.0D+02", "bad-number"),
        ("0x10", "bad-number"),
        ("", "bad-number"),
        ("1e300", "number-out-of-range"),
    ];
    let plain = wedge_file();
    let line = plain.lines().position(|l| l == "165").expect("number") as u64 + 1;
    for (text, code) in cases {
        let e = bad(&plain.replacen("\n165\n", &format!("\n{text}\n"), 1));
        assert_eq!(codes(&e), [code], "{text}");
        assert_eq!(e[0].source.as_ref().and_then(|s| s.line), Some(line), "{text}");
    }
}

#[test]
fn damaged_structure_is_refused() {
    let plain = wedge_file();
    let cases = [
        (plain.replacen("  0\nVERTEX\n  8\n1\n 10\n165\n", " 10\n165\n", 1), "coordinate-twice"),
        (plain.replacen("\nVERTEX\n", "\nVERTfX\n", 1), "stray-vertex"),
        (plain.replacen(" 20\n500\n", "", 1), "coordinate-missing"),
        (plain.replacen("  0\nBLOCK\n", "", 1), "endblk-without-block"),
        (plain.replacen("\nSECTION\n  2\nBLOCKS", "\nSEXTION\n  2\nBLOCKS", 1), "outside-section"),
        ("hello\nworld\n".to_owned(), "not-dxf"),
        (String::new(), "file-empty"),
        ("AutoCAD Binary DXF\r\n\u{1a}\0".to_owned(), "binary-dxf"),
        ("0\nEOF\n".to_owned(), "not-dxf"),
        (format!("  1\n{}\n{plain}", "x".repeat(70_000)), "line-too-long"),
    ];
    for (text, code) in cases {
        let e = bad(&text);
        assert!(codes(&e).contains(&code), "{code}: {:?}", codes(&e));
    }
}

#[test]
fn outline_in_runs_reversed_and_open() {
    let runs = |gap: f64| {
        file(move |w| {
            w.polyline("1", false, &[(0.0, 0.0), (300.0, 0.0)])
                .polyline("1", false, &[(0.0, 600.0), (300.0, 600.0), (300.0, 0.0)])
                .polyline("1", false, &[(0.0, 600.0), (0.0, gap)])
        })
    };
    assert!((geom::area(&good(&runs(0.0)).pieces[0].boundary.positions()) - 180_000.0).abs() < 1e-6);
    let closed = good(&runs(0.4));
    assert_eq!(codes(&closed.findings), ["outline-gap-closed"]);
    let e = bad(&runs(30.0));
    assert_eq!(codes(&e), ["outline-open"]);
    assert!(e[0].message.contains("open") && e[0].message.contains("30.00 mm"), "{}", e[0].message);
    assert_eq!(e[0].source.as_ref().and_then(|s| s.block.clone()).as_deref(), Some("FRONT_38"));
}

#[test]
fn crossing_outline_names_the_place() {
    let e = bad(&file(|w| w.polyline("1", true, &[(0.0, 0.0), (300.0, 600.0), (300.0, 0.0), (0.0, 600.0)])));
    assert_eq!(codes(&e), ["outline-crosses-itself"]);
    assert!(e[0].message.contains("intersects itself at (150.0, 300.0) mm"));
    let flat = bad(&file(|w| w.polyline("1", true, &[(0.0, 0.0), (300.0, 0.0), (100.0, 0.0)])));
    assert_eq!(codes(&flat), ["outline-without-area"]);
}

#[test]
fn doubled_vertices_and_spikes_pass() {
    let doubled: Vec<(f64, f64)> = WEDGE.iter().flat_map(|p| [*p, *p]).chain([WEDGE[0]]).collect();
    assert_wedge(&good(&file(|w| w.polyline("1", true, &doubled).points("2", &WEDGE))));
    let mut spike = RECTANGLE.to_vec();
    spike.splice(2..2, [(300.0, 300.0), (290.0, 300.0), (300.0, 300.0)]);
    let piece = &good(&file(|w| w.polyline("1", true, &spike))).pieces[0];
    assert!((geom::area(&piece.boundary.positions()) - 180_000.0).abs() < 1e-6);
    assert!(piece.darts.is_empty());
}

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
    assert_eq!(codes(&recursive.findings), ["insert-not-expanded"]);
    let insert = |tail: &str| wedge_file().replace("\nINSERT\n", &format!("\nINSERT\n{tail}"));
    let turned = good(&insert(" 41\n2\n 42\n2\n 50\n90\n"));
    assert_wedge(&turned);
    assert_eq!(codes(&turned.findings), ["insert-transformed"]);
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
    assert!(pattern.pieces[0].grain.is_some() && pattern.pieces[1].grain.is_none());
}

#[test]
fn curves_of_later_releases() {
    // A square of 200 mm with a half circle on its right side, as LWPOLYLINE with a bulge.
    let light = Writer::default().pair(0, "LWPOLYLINE").pair(8, "1").pair(90, "4").pair(70, "1");
    let light = light.xy(0.0, 0.0).xy(200.0, 0.0).pair(42, "1").xy(200.0, 200.0).xy(0.0, 200.0).0;
    let pattern = good(&file(|w| Writer(w.0 + &light)));
    let area = geom::area(&pattern.pieces[0].boundary.positions());
    let exact = 40_000.0 + std::f64::consts::PI * 5000.0;
    assert!((area - exact).abs() / exact < 5e-4);
    assert_eq!((pattern.census.sent, pattern.census.agreed), (1, 1));
    assert_eq!(pattern.pieces[0].turn_points, 4);
    // The same from lines and an arc.
    let arc =
        Writer::default().pair(0, "ARC").pair(8, "1").xy(200.0, 100.0).pair(40, "100").pair(50, "-90").pair(51, "90").0;
    let parts = good(&file(|w| {
        let w = w.line("1", (200.0, 0.0), (0.0, 0.0)).line("1", (0.0, 200.0), (0.0, 0.0)).line(
            "1",
            (0.0, 200.0),
            (200.0, 200.0),
        );
        Writer(w.0 + &arc)
    }));
    assert!((geom::area(&parts.pieces[0].boundary.positions()) - area).abs() < 20.0);
    let short = light.replace(" 90\n4", " 90\n5");
    assert_eq!(codes(&bad(&file(|w| Writer(w.0 + &short))))[0], "vertex-count-differs");
}

#[test]
fn closed_spline_is_a_circle() {
    // Periodic cubic with 8 control points on a circle, opened to 11.
    let control: Vec<(f64, f64)> = (0..11)
        .map(|i| f64::from(i) * std::f64::consts::FRAC_PI_4)
        .map(|a| (300.0 + 100.0 * libm::cos(a), 100.0 * libm::sin(a)))
        .collect();
    let mut w = Writer::default()
        .pair(0, "SPLINE")
        .pair(8, "1")
        .pair(70, "11")
        .pair(71, "3")
        .pair(72, "15")
        .pair(73, "11")
        .pair(74, "0");
    for k in 0..15 {
        w = w.pair(40, &k.to_string());
    }
    w = control.iter().fold(w, |w, (x, y)| w.xy(*x, *y));
    let pattern = good(&file(|f| Writer(f.0 + &w.0)));
    let line = pattern.pieces[0].boundary.positions();
    let radii: Vec<f64> = line.iter().map(|p| (p - toile_garment::Vec2::new(300.0, 0.0)).norm()).collect();
    let (lo, hi) = radii.iter().fold((f64::MAX, 0.0_f64), |(l, h), r| (l.min(*r), h.max(*r)));
    assert!(hi - lo < 0.5, "{lo} to {hi}");
    assert_eq!(pattern.census.agreed, 1);
}

#[test]
fn half_piece_is_unfolded_with_all_that_is_on_it() {
    let half: Vec<(f64, f64)> =
        vec![(0.0, 0.0), (150.0, 0.0), (150.0, 600.0), (90.0, 600.0), (75.0, 500.0), (60.0, 600.0), (0.0, 600.0)];
    let text = file(|w| {
        let w = w.polyline("1", true, &half).points("2", &half).line("6", (0.0, 600.0), (0.0, 0.0));
        let w = w.pair(0, "POINT").pair(8, "4").xy(150.0, 200.0).pair(30, "5").pair(39, "0").pair(50, "180");
        let w = w.point("13", 75.0, 490.0).polyline("8", false, &[(20.0, 100.0), (80.0, 100.0)]);
        w.polyline("8", false, &[(20.0, 200.0), (80.0, 200.0)]).text_at("8", "NM", 20.0, 200.0)
    });
    let pattern = good(&text);
    assert!(pattern.pieces[0].fold.is_some());
    let g = garment(&pattern);
    let piece = &g.pieces[0];
    assert!((piece.outline.signed_area() - 2.0 * 0.0885).abs() < 1e-9);
    assert_eq!(
        (piece.darts.len(), piece.notches.len(), piece.drill_holes.len(), piece.internal_lines.len()),
        (2, 2, 2, 3)
    );
    let outline = piece.outline.positions();
    for dart in &piece.darts {
        assert!(dart.legs.iter().flatten().all(|p| outline.contains(p)), "legs are outline vertices");
        let (a, b) =
            (outline.iter().position(|p| *p == dart.legs[0][0]), outline.iter().position(|p| *p == dart.apexes[0]));
        let n = outline.len();
        assert_eq!((a.expect("mouth") + 1) % n, b.expect("apex"), "leg 0 comes first counter-clockwise");
    }
    // The mirrored notch points inwards: along +x on the left edge.
    let left = piece.notches.iter().find(|n| n.at.x < 0.0).expect("left notch");
    assert!((libm::cos(left.angle.expect("angle")) - 1.0).abs() < 1e-9);
    // The hem runs on over the fold: no corner there.
    let at_fold = piece.outline.points.iter().find(|p| p.at.norm() < 1e-9).expect("fold vertex");
    assert_ne!(at_fold.kind, toile_garment::outline::PointKind::Turn);
}

#[test]
fn sew_line_on_14_and_on_8() {
    let cut: [(f64, f64); 7] = [
        (-10.0, -10.0),
        (310.0, -10.0),
        (310.0, 610.0),
        (160.6, 610.0),
        (150.0, 550.0),
        (139.4, 610.0),
        (-10.0, 610.0),
    ];
    for layer in ["14", "8"] {
        let pattern = good(&file(|w| w.polyline("1", true, &cut).polyline(layer, true, &WEDGE)));
        let piece = &pattern.pieces[0];
        assert_eq!((piece.sew_lines, piece.internal.len(), piece.darts.len()), (1, 0, 1), "layer {layer}");
        assert_eq!(piece.darts[0].on, "sew");
        let g = garment(&pattern);
        assert!((g.pieces[0].outline.signed_area() - 0.1785).abs() < 1e-9);
        assert!(g.pieces[0].cut_line.as_ref().is_some_and(|c| c.signed_area() > 0.19));
    }
}

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
    let pattern = good(&text);
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
fn layers_can_be_remapped() {
    let text = file(|w| w.polyline("OUT", true, &WEDGE).point("13", 150.0, 490.0));
    let options = ReadOptions { layers: [("OUT".to_owned(), "1".to_owned())].into(), ..ReadOptions::default() };
    assert_wedge(&read(text.as_bytes(), "t.dxf", &options).expect("remapped"));
}

#[test]
fn names_cannot_carry_terminal_codes() {
    let text = wedge_file().replace("Piece Name: FRONT", "Piece Name: A\u{1b}[2JB");
    let name = good(&text).pieces[0].name.clone().expect("name");
    assert!(!name.chars().any(char::is_control), "{name:?}");
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

#[test]
fn gbk_names_are_read_and_said() {
    let text = wedge_file();
    let at = text.find("FRONT\n").expect("name");
    let mut bytes = text.as_bytes()[..at].to_vec();
    bytes.extend_from_slice(b"\xc7\xb0\xc6\xac");
    bytes.extend_from_slice(&text.as_bytes()[at + 5..]);
    let pattern = read(&bytes, "t.dxf", &ReadOptions::default()).expect("gbk");
    assert!(pattern.pieces[0].name.as_deref() == Some("前片") || pattern.pieces[0].block.starts_with("前片"));
    assert_eq!(codes(&pattern.findings)[0], "encoding-guessed");
}
