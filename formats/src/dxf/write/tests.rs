use super::*;
use toile_garment::notch::NotchKind;
use toile_garment::outline::PointKind;
use toile_garment::piece::Quantity;
use toile_garment::{Piece, Vec2};

/// One entity as a plain reader sees it.
#[derive(Debug)]
struct Entity {
    kind: String,
    codes: Vec<(u16, String)>,
}

impl Entity {
    fn text(&self, code: u16) -> Option<&str> {
        self.codes.iter().find(|(c, _)| *c == code).map(|(_, v)| v.as_str())
    }

    fn at(&self) -> Vec2 {
        let real = |code| self.text(code).map_or(f64::NAN, |v| v.parse().expect("number"));
        Vec2::new(real(10), real(20))
    }
}

fn read(bytes: &[u8]) -> Vec<Entity> {
    assert!(bytes.is_ascii());
    let text = std::str::from_utf8(bytes).expect("ascii");
    assert_eq!(text.matches('\n').count(), text.matches("\r\n").count());
    let lines: Vec<_> = text.split_terminator("\r\n").collect();
    assert_eq!(lines.len() % 2, 0);
    let mut out: Vec<Entity> = Vec::new();
    for pair in lines.chunks(2) {
        let code: u16 = pair[0].trim().parse().expect("code");
        match out.last_mut() {
            Some(last) if code != 0 => last.codes.push((code, pair[1].to_owned())),
            _ => out.push(Entity { kind: pair[1].to_owned(), codes: Vec::new() }),
        }
    }
    out
}

fn census(entities: &[Entity], kind: &str, layer: &str) -> usize {
    entities.iter().filter(|e| e.kind == kind && e.text(8) == Some(layer)).count()
}

fn closed(points: &[(f64, f64)]) -> DrawLine {
    let points = points.iter().map(|(x, y)| DrawPoint { at: Vec2::new(*x, *y), kind: PointKind::Turn }).collect();
    DrawLine { points, closed: true, dense: None }
}

fn piece() -> PieceDrawing {
    let mut boundary = closed(&[(0.0, 0.0), (100.0, 0.0), (104.0, 100.0), (100.0, 200.0), (0.0, 200.0)]);
    boundary.points[2].kind = PointKind::Curve;
    boundary.dense = Some(
        [(0.0, 0.0), (100.0, 0.0), (103.0, 50.0), (104.0, 100.0), (103.0, 150.0), (100.0, 200.0), (0.0, 200.0)]
            .map(|(x, y)| Vec2::new(x, y))
            .into(),
    );
    let slit = DrawNotch {
        kind: NotchKind::Slit,
        at: Vec2::new(50.0, 0.0),
        depth: 5.0,
        width: 2.0,
        angle: Some(90.0),
        on: NotchLine::Cut,
    };
    PieceDrawing {
        name: "FRONT".into(),
        size: Some("38".into()),
        cut: CutNotes { quantity: Quantity { plain: 1, mirrored: 1 }, ..CutNotes::default() },
        boundary,
        sew_line: Some(closed(&[(10.0, 10.0), (90.0, 10.0), (90.0, 190.0), (10.0, 190.0)])),
        internal: vec![DrawLine { closed: false, ..closed(&[(20.0, 20.0), (80.0, 20.0)]) }],
        cutouts: vec![closed(&[(40.0, 40.0), (60.0, 40.0), (50.0, 60.0)])],
        notches: vec![slit, DrawNotch { kind: NotchKind::Castle, width: 4.0, angle: None, ..slit }],
        drill_holes: vec![DrawDrill { at: Vec2::new(50.0, 100.0), diameter: Some(3.0) }],
        grain: Some([Vec2::new(50.0, 30.0), Vec2::new(50.0, 170.0)]),
        ..PieceDrawing::default()
    }
}

fn drawing(pieces: Vec<PieceDrawing>) -> Drawing {
    let style = StyleText { name: "TEST".into(), sample_size: Some("38".into()), ..StyleText::default() };
    Drawing { style, pieces }
}

#[test]
fn astm_holds_every_entity_on_its_layer() {
    let written = write(&drawing(vec![piece()]), Dialect::Astm).expect("written");
    assert_eq!(written.findings, []);
    let e = read(&written.bytes);
    let polylines = |layer| census(&e, "POLYLINE", layer);
    assert_eq!(["1", "14", "8", "11", "84", "87"].map(polylines), [1; 6]);
    assert_eq!(["1", "14", "8", "11", "84", "87"].map(|l| census(&e, "VERTEX", l)), [5, 4, 2, 3, 7, 4]);
    assert_eq!(["2", "3", "4", "81", "13"].map(|l| census(&e, "POINT", l)), [4 + 4 + 2 + 3, 1, 1, 1, 1]);
    assert_eq!(["7", "5"].map(|l| census(&e, "LINE", l)), [1, 1]);
    let at = |kind: &str, layer: &str| {
        e.iter().filter(|e| e.kind == kind && e.text(8) == Some(layer)).map(Entity::at).collect::<Vec<_>>()
    };
    assert_eq!(Some(at("VERTEX", "84")), piece().boundary.dense);
    assert_eq!(at("VERTEX", "14"), piece().sew_line.expect("sew line").dense_points());
    assert_eq!((at("POINT", "3"), at("POINT", "13")), (vec![Vec2::new(104.0, 100.0)], vec![Vec2::new(50.0, 100.0)]));
    let texts: Vec<_> = e.iter().filter_map(|e| e.text(1)).collect();
    for text in ["Piece Name: FRONT", "Size: 38", "Quantity: 1,1", "Sample Size: 38", "Units: METRIC"] {
        assert!(texts.contains(&text), "{text} in {texts:?}");
    }
    assert!(texts.contains(&"ASTM/D13Proposal 1 Version: D 6673-04"));
    let slit = e.iter().find(|e| e.kind == "POINT" && e.text(8) == Some("4")).expect("slit");
    assert_eq!([30, 39, 50].map(|c| slit.text(c).expect("code")), ["5.0000", "0.0000", "90.0000"]);
    let header: Vec<_> = e.iter().take(4).map(|e| (e.kind.as_str(), e.text(2))).collect();
    assert_eq!(
        header,
        [("SECTION", Some("HEADER")), ("ENDSEC", None), ("SECTION", Some("BLOCKS")), ("BLOCK", Some("FRONT_38"))]
    );
}

#[test]
fn aama_has_no_layer_of_astm() {
    let written = write(&drawing(vec![piece()]), Dialect::Aama).expect("written");
    let e = read(&written.bytes);
    assert!(e.iter().filter_map(|e| e.text(8)).all(|l| l.parse::<u32>().expect("layer") < 80));
    assert_eq!(census(&e, "POINT", "4"), 2);
    let codes: Vec<_> = written.findings.iter().map(|f| f.code.as_str()).collect();
    // Its dense copy has one point beside each side of the curve point, so its chords are off the curve.
    assert_eq!(codes, ["curve-copy-lost", "quantity-without-sides", "notch-shape-lost"]);
    assert!(e.iter().any(|e| e.text(1) == Some("Quantity: 2")));
}

#[test]
fn clo_has_its_version_its_keys_and_group_250() {
    let written = write(&drawing(vec![piece()]), Dialect::Clo).expect("written");
    let e = read(&written.bytes);
    assert!(e[0].codes.contains(&(1, "AC1006".into())));
    assert!(e.iter().any(|e| e.text(1) == Some("PIECE NAME: FRONT")));
    let flags: Vec<_> = e.iter().filter(|e| e.kind == "POLYLINE").map(|e| (e.text(8), e.text(250))).collect();
    assert!(flags.contains(&(Some("1"), Some("2"))) && flags.contains(&(Some("8"), Some("0"))));
}

#[test]
fn names_fit_and_stay_apart() {
    let named = |name: &str, size: &str| PieceDrawing { name: name.into(), size: Some(size.into()), ..piece() };
    let long = "Vorderärmel links oben außen";
    let pieces =
        vec![named(long, "38"), named(long, "40"), named("Vorderaermel links oben innen", "38"), named("裙子", "38")];
    let written = write(&drawing(pieces), Dialect::Gerber).expect("written");
    let e = read(&written.bytes);
    let blocks: Vec<_> = e.iter().filter(|e| e.kind == "BLOCK").filter_map(|e| e.text(2)).collect();
    assert_eq!(blocks[3], "PIECE_38");
    let distinct: std::collections::BTreeSet<_> = blocks.iter().collect();
    assert_eq!(distinct.len(), 4);
    assert!(blocks.iter().all(|b| b.len() <= 20 && !b.contains(' ')));
    let names: Vec<_> = e.iter().filter_map(|e| e.text(1)?.strip_prefix("Piece Name: ")).collect();
    assert_eq!(names[0], names[1]);
    assert_ne!(names[0], names[2]);
    assert_eq!(written.findings.iter().filter(|f| f.code == "piece-name-changed").count(), 3);
    let inserts: Vec<_> = e.iter().filter(|e| e.kind == "INSERT").filter_map(|e| e.text(2)).collect();
    assert_eq!(inserts, blocks);
}

#[test]
fn numbers_that_are_no_place_are_refused() {
    let mut bad = piece();
    bad.boundary.points[1].at.x = f64::NAN;
    let faults = write(&drawing(vec![bad, piece()]), Dialect::Astm).expect_err("refused");
    assert_eq!(faults[0].code, "coordinate-out-of-range");
    let empty = PieceDrawing { boundary: DrawLine::default(), ..piece() };
    assert_eq!(write(&drawing(vec![empty]), Dialect::Astm).expect_err("refused")[0].code, "boundary-too-short");
}

#[test]
fn no_negative_zero() {
    assert_eq!(tags::decimal(-0.000_01), "0.0000");
    assert_eq!(tags::decimal(-0.000_06), "-0.0001");
}

/// A symmetric piece about x = 0, metres.
fn symmetric() -> Piece {
    use toile_garment::outline::{LinePoint, PieceLine};
    let ring = |r: f64| {
        let at = [(-r, 0.0), (r, 0.0), (1.2 * r, 2.0), (-1.2 * r, 2.0)];
        let points = at.map(|(x, y)| LinePoint { at: Vec2::new(x, y) * 0.1, kind: PointKind::Turn }).into();
        PieceLine { points, closed: true, ..PieceLine::default() }
    };
    Piece {
        name: "BACK".into(),
        outline: ring(0.9),
        cut_line: Some(ring(1.0)),
        fold: Some([Vec2::new(0.0, 0.0), Vec2::new(0.0, 0.2)]),
        ..Piece::default()
    }
}

#[test]
fn half_piece_on_its_fold() {
    let mut findings = Vec::new();
    let drawn =
        piece_drawing(&symmetric(), PieceOptions { half_on_fold: true, ..PieceOptions::default() }, &mut findings);
    assert_eq!(findings, []);
    let at: Vec<_> = drawn.boundary.points.iter().map(|p| (p.at.x, p.at.y)).collect();
    assert_eq!(at, [(0.0, 200.0), (-120.0, 200.0), (-100.0, 0.0), (0.0, 0.0)]);
    let sew = drawn.sew_line.expect("sew line");
    assert!(!sew.closed && sew.points.len() == 4);
    assert_eq!(drawn.fold, Some([Vec2::new(0.0, 0.0), Vec2::new(0.0, 200.0)]));
    let mut skew = symmetric();
    skew.outline.points[0].at.x -= 0.01;
    let whole = piece_drawing(&skew, PieceOptions { half_on_fold: true, ..PieceOptions::default() }, &mut findings);
    assert_eq!((whole.boundary.points.len(), findings[0].code.as_str()), (4, "fold-not-symmetric"));
}

/// A run with its own curve point, which stands `sagitta` inside its chord. Between the ends are the points of a
/// parabola of the sagitta `beside`.
fn fine(sagitta: f64, beside: f64) -> PieceDrawing {
    use PointKind::{Curve, Plain, Turn};
    let point = |x: f64, y: f64, kind| DrawPoint { at: Vec2::new(x, y), kind };
    let curve = |i: i32| {
        let t = f64::from(i) / 10.0;
        if i == 0 {
            point(100.0 - sagitta, 50.0, Curve)
        } else {
            point(100.0 - beside * (1.0 - t * t), 50.0 + 50.0 * t, Plain)
        }
    };
    let mut points = vec![point(0.0, 0.0, Turn), point(100.0, 0.0, Turn)];
    points.extend((-9..10).map(curve));
    points.extend([point(100.0, 100.0, Turn), point(0.0, 100.0, Turn)]);
    PieceDrawing {
        name: "P".into(),
        boundary: DrawLine { points, closed: true, dense: None },
        ..PieceDrawing::default()
    }
}

#[test]
fn a_sparse_curve_goes_out_as_one_in_every_dialect() {
    let counts = |piece: PieceDrawing, dialect| {
        let written = write(&drawing(vec![piece]), dialect).expect("written");
        let e = read(&written.bytes);
        let told: Vec<String> = written.findings.into_iter().map(|f| f.code).collect();
        let of = |kind, layer| census(&e, kind, layer);
        ([of("VERTEX", "1"), of("VERTEX", "84"), of("POINT", "3"), of("POINT", "2")], told)
    };
    for dialect in Dialect::ALL {
        let copy = if dialect.has_dense() { 23 } else { 0 };
        // The smooth curve through three points is a parabola.
        let runs = if dialect == Dialect::Gerber { [9, 27, 1, 4] } else { [5, copy, 1, 4] };
        assert_eq!(counts(fine(8.0, 8.0), dialect), (runs, vec![]), "{dialect:?}");
        // 0.3 mm off: said where no copy holds the curve.
        let (vertices, told) = counts(fine(8.0, 7.7), dialect);
        assert_eq!(vertices, runs, "{dialect:?}");
        assert_eq!(told.contains(&"curve-copy-lost".to_owned()), !dialect.has_dense(), "{dialect:?} {told:?}");
        // Curve points that do not hold the shape: every vertex stays, as a polygon, and it is said.
        let (vertices, told) = counts(fine(-8.0, 8.0), dialect);
        assert_eq!((vertices[2], told), (0, vec!["curve-points-lost".to_owned()]), "{dialect:?}");
    }
}

#[test]
fn a_notch_beside_its_line_goes_onto_the_chord() {
    let mut piece = fine(8.0, 8.0);
    // On the curve, 2 mm beside the chord from (100, 0) to (92, 50).
    let at = Vec2::new(94.0, 25.0);
    let notch = DrawNotch { kind: NotchKind::Slit, at, depth: 5.0, width: 0.0, angle: None, on: NotchLine::Cut };
    piece.notches = vec![notch, DrawNotch { at: Vec2::new(60.0, 40.0), on: NotchLine::None, ..notch }];
    for dialect in Dialect::ALL {
        let e = read(&write(&drawing(vec![piece.clone()]), dialect).expect("written").bytes);
        let at: Vec<Vec2> = e.iter().filter(|e| e.kind == "POINT" && e.text(8) == Some("4")).map(Entity::at).collect();
        let off = crate::dxf::geom::point_segment(at[0], Vec2::new(100.0, 0.0), Vec2::new(92.0, 50.0)).0;
        assert!(off < 1e-4 && ((at[0] - notch.at).norm() - 1.975).abs() < 0.01, "{dialect:?}: {at:?}");
        assert_eq!(at[1], Vec2::new(60.0, 40.0));
    }
}

#[test]
fn inches_code_page_author_and_date() {
    let page = |name: &str| Some(crate::encoding::named(name).expect("code page"));
    let mut drawing = drawing(vec![PieceDrawing { name: "Ärmel".into(), ..piece() }]);
    (drawing.style.author, drawing.style.date) = ("Anna".into(), Some("27-11-2026".into()));
    for dialect in Dialect::ALL {
        let plain = write(&drawing, dialect).expect("written");
        let escaped = plain.findings.iter().filter(|f| f.code == "text-escaped").count();
        // The narrow dialect folds the letter, and says that.
        assert_eq!(escaped, usize::from(!dialect.is_narrow()), "{dialect:?}");
        for (name, bytes) in [("windows-1252", &b"\xC4rmel"[..]), ("utf-8", "Ärmel".as_bytes())] {
            let options = WriteOptions { inches: true, page: page(name) };
            let written = write_with(&drawing, dialect, options).expect("written");
            let held = written.bytes.windows(bytes.len()).any(|w| w == bytes);
            assert_eq!(held, !dialect.is_narrow(), "{dialect:?} {name}");
            assert!(!written.findings.iter().any(|f| f.code == "text-escaped"), "{dialect:?} {name}");
            let back = crate::dxf::read(&written.bytes, "t.dxf", &crate::dxf::ReadOptions::default()).expect("read");
            let again = &back.pieces[0];
            assert_eq!(again.label(), if dialect.is_narrow() { "Aermel" } else { "Ärmel" });
            assert_eq!((back.units.mm_per_unit, back.units.declared.as_deref()), (25.4, Some("ENGLISH")));
            for (node, point) in again.boundary.drawn.iter().zip(&piece().boundary.points) {
                assert!((node.at - point.at).norm() < 2e-5, "{dialect:?}: {} {}", node.at, point.at);
            }
            // A notch 5 mm deep, in inches.
            assert!((again.notches[0].depth - 5.0).abs() < 2e-5 && again.notches[0].angle.is_some());
            assert!(
                back.style_texts["author"].starts_with("Anna") && back.style_texts["creation date"] == "27-11-2026"
            );
        }
    }
    // Letters that a code page does not have are escaped, and said.
    drawing.pieces[0].name = "裙 Ä".into();
    let options = WriteOptions { inches: false, page: page("windows-1252") };
    let written = write_with(&drawing, Dialect::Astm, options).expect("written");
    assert!(written.bytes.windows(9).any(|w| w == b"\\U+88D9 \xC4"));
    assert_eq!(written.findings.iter().filter(|f| f.code == "text-escaped").count(), 1);
}
