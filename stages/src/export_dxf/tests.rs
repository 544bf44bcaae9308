use super::*;
use std::sync::atomic::AtomicBool;
use toile_formats::dxf::{self, ReadOptions};
use toile_garment::dart::{Dart, DartEvidence, DartKind, DartMesh};
use toile_garment::flat::{Flat, FlatPiece, StrainMap};
use toile_garment::mesh::{ChainKind, MeshChain, PieceMesh};
use toile_garment::notch::{Notch, NotchKind};
use toile_garment::outline::{LinePoint, PieceLine, PointKind};
use toile_garment::piece::DrillHole;
use toile_garment::provenance::StageRecord;
use toile_garment::sewing::{CopySpec, DartSpec, PleatPress, SewingPlan};
use toile_garment::{PieceId, Report, Vec2};
use toile_stage_api::{FileError, Files};

fn mm(x: f64, y: f64) -> Vec2 {
    Vec2::new(x, y) * 1e-3
}

fn closed(points: &[Vec2]) -> PieceLine {
    let points = points.iter().map(|at| LinePoint { at: *at, kind: PointKind::Turn }).collect();
    PieceLine { points, closed: true, ..PieceLine::default() }
}

/// Mesh vertices: four corners, the mouth and the apex of a wedge at the top.
fn rest() -> Vec<Vec2> {
    [(0., 0.), (200., 0.), (200., 200.), (110., 200.), (100., 100.), (90., 200.), (0., 200.)]
        .map(|(x, y)| mm(x, y))
        .into()
}

/// A square of 200 mm with a wedge dart, a bulge of the lower edge finer than the mesh, and 10 mm of allowance that
/// runs straight over the mouth.
fn piece() -> Piece {
    let v = rest();
    let mut outline = closed(&[v[0], mm(100.0, -2.0), v[1], v[2], v[3], v[4], v[5], v[6]]);
    outline.points[1].kind = PointKind::Curve;
    let mesh = PieceMesh {
        rest: v.clone(),
        triangles: vec![[0, 1, 4], [1, 2, 3], [1, 3, 4], [0, 4, 5], [0, 5, 6]],
        chains: vec![MeshChain { kind: ChainKind::Outline, index: 0, vertices: (0..7).collect(), closed: true }],
        outline_vertex: vec![Some(0), None, Some(1), Some(2), Some(3), Some(4), Some(5), Some(6)],
        rest_corners: None,
    };
    let dart = Dart {
        name: "dart-1".into(),
        kind: DartKind::Wedge,
        evidence: DartEvidence::BoundaryWedge,
        apexes: vec![v[4]],
        mouth: [v[3], v[5]],
        legs: [vec![v[3], v[4]], vec![v[5], v[4]]],
        line: "sew".into(),
        depth: None,
        mesh: Some(DartMesh { legs: [vec![3, 4], vec![5, 4]] }),
        source: None,
    };
    let notch = Notch {
        kind: NotchKind::Slit,
        at: mm(210.0, 150.0),
        depth: 5e-3,
        width: 0.0,
        angle: Some(std::f64::consts::PI),
        on: "boundary".into(),
        name: None,
        source: None,
    };
    let cut =
        [(-10., -10.), (210., -10.), (210., 210.), (110., 210.), (90., 210.), (-10., 210.)].map(|(x, y)| mm(x, y));
    Piece {
        name: "FRONT".into(),
        outline,
        cut_line: Some(closed(&cut)),
        notches: vec![notch],
        drill_holes: vec![DrillHole { at: mm(150.0, 120.0), diameter: None, source: None }],
        grain: Some([mm(50.0, 40.0), mm(50.0, 80.0)]),
        internal_lines: vec![PieceLine { closed: false, ..closed(&[mm(20.0, 20.0), mm(60.0, 20.0)]) }],
        darts: vec![dart],
        mesh: Some(mesh),
        ..Piece::default()
    }
}

fn flat(positions: Vec<Vec2>) -> FlatPiece {
    FlatPiece {
        piece: PieceId(0),
        positions,
        area: [0.0; 3],
        edges: Vec::new(),
        darts: Vec::new(),
        grain_shift: 0.0,
        drape_strain: StrainMap::default(),
        flat_strain: StrainMap::default(),
        rounds: 0,
        last_motion: 0.0,
        curvature: 0.0,
        forced_strain: [0.0; 2],
    }
}

/// Every point of a piece.
fn points(piece: &Piece) -> Vec<Vec2> {
    let lines = std::iter::once(&piece.outline).chain(&piece.cut_line).chain(&piece.internal_lines);
    let mut out: Vec<_> = lines.flat_map(|l| l.positions()).collect();
    out.extend(piece.notches.iter().map(|n| n.at));
    out.extend(piece.drill_holes.iter().map(|d| d.at));
    out.extend(piece.grain.iter().flatten());
    out.extend(piece.darts.iter().flat_map(|d| d.apexes.iter().chain(&d.mouth).chain(d.legs.iter().flatten())));
    out
}

fn turned(p: Vec2, about: Vec2, degrees: f64) -> Vec2 {
    let (s, c) = libm::sincos(degrees.to_radians());
    let d = p - about;
    about + Vec2::new(c * d.x - s * d.y, s * d.x + c * d.y)
}

fn assert_near(a: f64, b: f64, what: &str) {
    assert!((a - b).abs() < 1e-9, "{what}: {a} against {b}");
}

#[test]
fn an_unmoved_piece_stays_as_it_is() {
    let piece = piece();
    let out = flat_piece(&piece, &flat(rest())).expect("moved");
    for (a, b) in points(&piece).iter().zip(points(&out)) {
        assert!((a - b).norm() < 1e-12, "{a} against {b}");
    }
}

#[test]
fn a_rigid_motion_moves_everything_alike() {
    let motion = |p: Vec2| turned(p, mm(30.0, 60.0), 25.0) + mm(400.0, -70.0);
    let piece = piece();
    let out = flat_piece(&piece, &flat(rest().into_iter().map(motion).collect())).expect("moved");
    for (a, b) in points(&piece).iter().zip(points(&out)) {
        assert!((motion(*a) - b).norm() < 1e-12, "{a}");
    }
    let angle = out.notches[0].angle.expect("angle");
    assert_near(angle, std::f64::consts::PI + 25.0_f64.to_radians(), "notch angle");
}

/// Distance of a point from the line through two others.
fn off(p: Vec2, a: Vec2, b: Vec2) -> f64 {
    let d = b - a;
    ((d.x * (p.y - a.y) - d.y * (p.x - a.x)) / d.norm()).abs()
}

#[test]
fn an_opened_dart_keeps_legs_and_allowance() {
    // The upper right of the cloth turns about the apex by 3°, away from the other leg.
    let apex = rest()[4];
    let mut to = rest();
    to[2] = turned(to[2], apex, -3.0);
    to[3] = turned(to[3], apex, -3.0);
    let out = flat_piece(&piece(), &flat(to.clone())).expect("moved");
    let dart = &out.darts[0];
    assert_near(dart.leg_length(0), dart.leg_length(1), "legs");
    let [a, b] = [dart.mouth[0] - apex, dart.mouth[1] - apex];
    let angle = libm::acos(a.dot(&b) / a.norm() / b.norm()).to_degrees();
    let before = 2.0 * libm::atan(0.1).to_degrees();
    assert_near(angle, before + 3.0, "dart angle");
    let at: Vec<_> = out.outline.positions();
    assert_eq!([at[3], at[4], at[5], at[6]], [to[2], to[3], to[4], to[5]]);
    // The bulge of the lower edge, which did not move.
    assert!((at[1] - mm(100.0, -2.0)).norm() < 1e-12);
    let cut = out.cut_line.as_ref().expect("cut line").positions();
    // The corner keeps 10 mm from both its sides; the turned part of the waist keeps 10 mm along its length.
    assert_near(off(cut[2], to[1], to[2]), 0.01, "corner, side");
    assert_near(off(cut[2], to[2], to[3]), 0.01, "corner, top");
    assert_near(off(cut[4], to[5], to[6]), 0.01, "left of the mouth");
    let notch = &out.notches[0];
    assert_near(off(notch.at, to[1], to[2]), 0.01, "notch");
    let along = to[2] - to[1];
    let inward = Vec2::new(libm::cos(notch.angle.expect("angle")), libm::sin(notch.angle.expect("angle")));
    assert_near(inward.dot(&along) / along.norm(), 0.0, "notch stands square");
}

#[test]
fn a_flat_of_another_mesh_is_refused() {
    let fault = flat_piece(&piece(), &flat(vec![mm(0.0, 0.0)])).expect_err("refused");
    assert_eq!(fault.code, "flat-does-not-fit");
    let bare = Piece { mesh: None, ..piece() };
    assert!(flat_piece(&bare, &flat(rest())).is_err());
}

/// Files in memory.
#[derive(Default)]
struct Memory(Vec<(String, Vec<u8>)>);

impl Files for Memory {
    fn read(&mut self, path: &Path) -> Result<Vec<u8>, FileError> {
        let name = path.display().to_string();
        if name == "t-shirt.dxf" {
            return Ok(include_bytes!("../../../samples/patterns/t-shirt.aama.dxf").to_vec());
        }
        if name == "one-size.dxf" {
            let only = shirt("38");
            return Ok(draw(&only, &only.pieces, &ExportDxfParams::default()).expect("drawn").bytes);
        }
        Err(FileError::Missing { path: name, reason: "none here".into() })
    }
    fn read_optional(&mut self, _: &Path) -> Result<Option<Vec<u8>>, FileError> {
        Ok(None)
    }
    fn write(&mut self, path: &Path, bytes: &[u8]) -> Result<(), FileError> {
        self.0.push((path.display().to_string(), bytes.to_vec()));
        Ok(())
    }
}

fn run(garment: Garment, params: &ExportDxfParams) -> (Result<Garment, StageError>, Memory, Report) {
    let (mut report, mut files) = (Report::default(), Memory::default());
    let cancel = AtomicBool::new(false);
    let mut cx = StageContext {
        report: &mut report,
        progress: &mut (),
        files: &mut files,
        cancel: &cancel,
        seed: 0,
        threads: 1,
    };
    let result = ExportDxf.run(params, garment, &mut cx);
    (result, files, report)
}

#[test]
fn the_stage_writes_flat_pieces_and_the_pattern() {
    let mut garment = Garment { pieces: vec![piece()], size: Some("38".into()), ..Garment::default() };
    let (result, files, _) = run(garment.clone(), &ExportDxfParams::default());
    let error = result.expect_err("nothing flattened yet").to_string();
    assert!(error.contains("flat-missing") && files.0.is_empty());
    let pattern =
        ExportDxfParams { source: DxfSource::Pattern, file: "out/p.dxf".into(), ..ExportDxfParams::default() };
    let (result, files, report) = run(garment.clone(), &pattern);
    assert_eq!(result.expect("written"), garment);
    assert_eq!((files.0[0].0.as_str(), report.findings.len()), ("out/p.dxf", 0));
    // Flattened without any change it is the same pattern, byte for byte.
    garment.flat = Some(Flat { pieces: vec![flat(rest())], ..Flat::default() });
    let (result, same, _) = run(garment.clone(), &ExportDxfParams { source: DxfSource::Flat, ..pattern });
    assert!(result.is_ok() && same.0 == files.0);
}

#[test]
fn a_size_run_is_two_files() {
    for dialect in ["aama", "astm", "clo", "gerber", "optitex", "plain"] {
        let params = format!("file = \"out/run.dxf\"\nsize_run = \"t-shirt.dxf\"\ndialect = \"{dialect}\"");
        let params: ExportDxfParams = toml::from_str(&params).expect("params");
        let (result, files, report) = run(Garment::default(), &params);
        result.expect("written");
        assert!(!report.findings.iter().any(|f| f.code == "sizes-without-rules"), "{:?}", report.findings);
        let names: Vec<&str> = files.0.iter().map(|f| f.0.as_str()).collect();
        assert_eq!(names, ["out/run.dxf", "out/run.rul"]);
        let table = rul::read(&files.0[1].1, "run.rul").expect("rules");
        let pattern = dxf::read(&files.0[0].1, "run.dxf", &ReadOptions::default()).expect("pattern");
        assert_eq!((table.sizes, pattern.sizes.len()), (pattern.sizes.clone(), 3));
        assert!(table.rules.len() > 3 && pattern.pieces.iter().any(|p| !p.texts.rules.is_empty()));
    }
}

#[test]
fn a_size_run_is_read_as_the_garment_was_imported() {
    let width = |params: serde_json::Value| {
        let record = StageRecord { stage: "import-dxf".into(), id: "a".into(), revision: 1, params };
        let mut garment = Garment::default();
        garment.provenance.stages.push(record);
        let params = "file = \"out/run.dxf\"\nsize_run = \"t-shirt.dxf\"";
        let (result, files, _) = run(garment, &toml::from_str(params).expect("params"));
        result.expect("written");
        let pattern = dxf::read(&files.0[0].1, "run.dxf", &ReadOptions::default()).expect("pattern");
        let xs = pattern.pieces.iter().flat_map(|p| p.boundary.positions()).map(|p| p.x);
        (xs.fold(0.0, f64::max), pattern.pieces.len())
    };
    let plain = width(serde_json::json!({ "file": "t-shirt.dxf" }));
    let (in_cm, all) = width(serde_json::json!({ "file": "t-shirt.dxf", "units": "cm" }));
    assert!((in_cm / plain.0 - 10.0).abs() < 1e-3 && all == plain.1, "{in_cm} {plain:?}");
    let (_, sleeves) = width(serde_json::json!({ "file": "t-shirt.dxf", "pieces": ["SLEEVE"] }));
    assert_eq!(sleeves, 3, "one piece in three sizes");
    // Another file was imported: its parameters say nothing of this one.
    assert_eq!(width(serde_json::json!({ "file": "other.dxf", "units": "cm" })), plain);
}

#[test]
fn a_size_run_has_no_sewing_file() {
    let params = "file = \"run.dxf\"\nsize_run = \"t-shirt.dxf\"\nsewing = \"run.sewing.toml\"";
    let (result, files, _) = run(Garment::default(), &toml::from_str(params).expect("params"));
    assert!(result.expect_err("refused").to_string().contains("sizes-with-sewing") && files.0.is_empty());
}

/// The sample size graded by the rules that were written, and the size drawn: the largest distance of a ruled vertex.
fn off_the_drawn_size(pattern: &dxf::Pattern, table: &rul::RuleTable, size: &str) -> f64 {
    let of = |size: &str| pattern.pieces.iter().filter(|p| p.size.as_deref() == Some(size)).collect::<Vec<_>>();
    let mut worst = 0.0_f64;
    for (sample, drawn) in of(table.sample.as_deref().expect("sample")).into_iter().zip(of(size)) {
        let graded = dxf::grade::grade(sample, table, size).expect("graded");
        let there = drawn.boundary.positions();
        for (from, to) in sample.boundary.positions().iter().zip(graded.boundary.positions()) {
            if sample.texts.rules.iter().any(|r| (r.at - from).norm() < 0.02) {
                worst = there.iter().map(|q| (q - to).norm()).fold(f64::INFINITY, f64::min).max(worst);
            }
        }
    }
    worst
}

#[test]
fn a_size_run_gets_the_allowance_in_every_size() {
    for dialect in ["aama", "astm", "clo", "gerber", "optitex", "plain"] {
        let params = format!(
            "file = \"out/run.dxf\"\nsize_run = \"t-shirt.dxf\"\ndialect = \"{dialect}\"\nallowance.width = \"10 mm\""
        );
        let params: ExportDxfParams = toml::from_str(&params).expect("params");
        let (result, files, report) = run(Garment::default(), &params);
        result.expect("written");
        assert!(!report.findings.iter().any(|f| f.code == "sizes-without-rules"), "{:?}", report.findings);
        let table = rul::read(&files.0[1].1, "run.rul").expect("rules");
        let pattern = dxf::read(&files.0[0].1, "run.dxf", &ReadOptions::default()).expect("pattern");
        for size in &table.sizes {
            let (garment, _) = pattern.to_garment(Some(size), None).expect("size");
            for piece in &garment.pieces {
                // The sew line keeps 10 mm from the cut line, whose vertices lie on the chords of its own curve.
                let cut = piece.cut_line.as_ref().expect("cut line").positions();
                let sew = piece.outline.positions();
                let nearest = sew.iter().map(|p| dxf::geom::distance(*p, &cut, true)).fold(f64::INFINITY, f64::min);
                assert!((nearest - 0.01).abs() < 1e-5, "{dialect} {size} {}: {nearest}", piece.name);
            }
            let off = off_the_drawn_size(&pattern, &table, size);
            assert!(off <= 0.01, "{dialect} {size}: {off} mm");
        }
    }
}

#[test]
fn inches_code_page_author_and_date_are_written() {
    let mut named = piece();
    named.name = "ÄRMEL".into();
    let garment = Garment { pieces: vec![named], size: Some("38".into()), ..Garment::default() };
    let text =
        "source = \"pattern\"\nunits = \"inch\"\ncode_page = \"windows-1252\"\nauthor = \"Anna\"\ndate = \"1-2-2026\"";
    let params: ExportDxfParams = toml::from_str(text).expect("params");
    let (result, files, report) = run(garment.clone(), &params);
    assert!(result.is_ok() && report.findings.is_empty(), "{:?}", report.findings);
    let read = dxf::read(&files.0[0].1, "p.dxf", &ReadOptions::default()).expect("read");
    assert_eq!((read.units.mm_per_unit, read.pieces[0].label()), (25.4, "ÄRMEL"));
    assert_eq!(read.style_texts["creation date"], "1-2-2026");
    let wrong = ExportDxfParams { code_page: Some("klingon".into()), ..params.clone() };
    let (result, files, _) = run(garment.clone(), &wrong);
    assert!(result.expect_err("refused").to_string().contains("code-page-unknown") && files.0.is_empty());
    let escaped = ExportDxfParams { code_page: None, ..params };
    let (_, _, report) = run(garment, &escaped);
    assert_eq!(report.findings.iter().filter(|f| f.code == "text-escaped").count(), 1);
}

#[test]
fn a_size_run_in_inches_has_its_rules_in_inches() {
    let text = "file = \"out/run.dxf\"\nsize_run = \"t-shirt.dxf\"\nunits = \"inch\"";
    let (result, files, _) = run(Garment::default(), &toml::from_str(text).expect("params"));
    result.expect("written");
    let pattern = dxf::read(&files.0[0].1, "run.dxf", &ReadOptions::default()).expect("pattern");
    let table = rul::read(&files.0[1].1, "run.rul").expect("rules");
    assert_eq!((pattern.units.mm_per_unit, table.units.as_deref()), (25.4, Some("ENGLISH")));
    for size in &table.sizes {
        let off = off_the_drawn_size(&pattern, &table, size);
        assert!(off <= 0.01, "{size}: {off} mm");
    }
}

#[test]
fn parameters_are_strict() {
    let read = |text: &str| toml::from_str::<ExportDxfParams>(text);
    let params = read("dialect = \"clo\"\nsource = \"pattern\"").expect("params");
    assert_eq!((params.dialect, params.source), (DxfDialect::Clo, DxfSource::Pattern));
    assert_eq!(params.file, "{out}/pattern.dxf");
    assert!(read("dilect = \"clo\"").is_err() && read("dialect = \"lectra\"").is_err());
}

/// A front with a pressed pleat, and its mirrored copy.
fn pleated() -> Garment {
    let corners = [(10.0, 0.0, 't'), (210.0, 0.0, 't'), (210.0, 300.0, 't'), (10.0, 300.0, 't')];
    let plan = SewingPlan {
        darts: vec![DartSpec {
            piece: "FRONT".into(),
            name: Some("pleat-1".into()),
            apexes: vec![mm(90.0, 230.0), mm(120.0, 230.0)],
            mouth: [mm(90.0, 300.0), mm(120.0, 300.0)],
            kind: Some(DartKind::Pleat),
            press: Some(PleatPress::Knife),
            sewn: Some(0.04),
            source: None,
        }],
        copies: vec![CopySpec { piece: "FRONT".into(), name: "FRONT-R".into(), mirror: true, source: None }],
        ..SewingPlan::default()
    };
    let mut garment = Garment { pieces: vec![crate::testing::piece(0, "FRONT", &corners)], ..Garment::default() };
    crate::sewing::apply(&mut garment, plan, &mut Report::default()).expect("applied");
    for piece in &mut garment.pieces {
        piece.mesh = Some(PieceMesh {
            rest: piece.outline.positions(),
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            chains: vec![MeshChain { kind: ChainKind::Outline, index: 0, vertices: (0..4).collect(), closed: true }],
            outline_vertex: (0..4).map(Some).collect(),
            rest_corners: None,
        });
    }
    garment
}

/// The pieces as a reader of DXF finds them: lines, and nothing of darts and folds.
fn as_drawn(piece: &Piece) -> Piece {
    let legs = piece.darts.iter().flat_map(|d| d.legs.iter()).map(|leg| PieceLine { closed: false, ..closed(leg) });
    let internal_lines = piece.internal_lines.iter().cloned().chain(legs).collect();
    Piece { internal_lines, darts: Vec::new(), folds: Vec::new(), mesh: None, ..piece.clone() }
}

#[test]
fn pleats_of_copies_are_written_and_their_lines_go_with_them() {
    let mut garment = pleated();
    assert_eq!(garment.pieces.iter().map(|p| p.internal_lines.len()).collect::<Vec<_>>(), [2, 2]);
    let larger = |p: &Piece| p.outline.positions().iter().map(|x| x * 1.05).collect::<Vec<_>>();
    let flats = garment.pieces.iter().map(|p| FlatPiece { piece: p.id, ..flat(larger(p)) }).collect();
    garment.flat = Some(Flat { pieces: flats, ..Flat::default() });
    let pieces = flat_pieces(&garment).expect("moved");
    let plan = sewing::plan(&garment, &pieces);
    let mouths: Vec<(&str, Vec2)> = plan.darts.iter().map(|d| (d.piece.as_str(), d.mouth[0] / 1.05)).collect();
    assert_eq!(mouths.iter().map(|m| m.0).collect::<Vec<_>>(), ["FRONT", "FRONT-R"]);
    assert!((mouths[0].1 - mm(90.0, 300.0)).norm() < 1e-9 && (mouths[1].1 - mm(-90.0, 300.0)).norm() < 1e-9);
    let mut again = Garment { pieces: pieces.iter().map(as_drawn).collect(), ..Garment::default() };
    crate::sewing::apply(&mut again, plan, &mut Report::default()).expect("applied");
    for (piece, old) in again.pieces.iter().zip(&garment.pieces) {
        // Neither the old legs nor the old folds stand beside the new ones.
        assert_eq!((piece.darts.len(), piece.folds.len(), piece.internal_lines.len()), (1, 2, 2), "{}", piece.name);
        for (new, old) in piece.folds.iter().zip(&old.folds) {
            assert_eq!(new.angle, old.angle);
            assert!((new.line[0] / 1.05 - old.line[0]).norm() < 1e-9, "{}: {:?}", piece.name, new.line);
        }
    }
    // Before pieces are sewn the plan names copies, too.
    assert_eq!(sewing::unsewn(&garment).darts.len(), 2);
}

/// The sample T-shirt in a size.
fn shirt(size: &str) -> Garment {
    let bytes = include_bytes!("../../../samples/patterns/t-shirt.aama.dxf");
    let pattern = dxf::read(bytes, "t-shirt.dxf", &ReadOptions::default()).expect("pattern");
    pattern.to_garment(Some(size), None).expect("size").0
}

fn named<'g>(garment: &'g Garment, name: &str) -> &'g Piece {
    garment.pieces.iter().find(|p| p.name == name).expect("piece")
}

/// The garment that was written, in a size.
fn written_in(files: &Memory, size: &str) -> Garment {
    let pattern = dxf::read(&files.0[0].1, "run.dxf", &ReadOptions::default()).expect("pattern");
    pattern.to_garment(Some(size), None).expect("size").0
}

#[test]
fn a_change_in_one_size_is_carried_to_all_sizes() {
    // Unchanged pieces come back in every size as they were drawn.
    let text = "source = \"pattern\"\nfile = \"out/run.dxf\"\ngrade_from = \"t-shirt.dxf\"";
    for size in ["38", "40"] {
        let (result, files, report) = run(shirt(size), &toml::from_str(text).expect("params"));
        result.expect("written");
        assert!(report.findings.iter().all(|f| f.code == "sizes-carried"), "{:?}", report.findings);
        let table = rul::read(&files.0[1].1, "run.rul").expect("rules");
        assert_eq!((table.sizes.len(), table.sample.as_deref()), (3, Some(size)));
        for other in ["36", "38", "40"] {
            let there = written_in(&files, other);
            for piece in shirt(other).pieces {
                let line = named(&there, &piece.name).outline.positions();
                let off = piece.outline.points.iter().map(|p| dxf::geom::distance(p.at, &line, true));
                let off = off.fold(0.0, f64::max);
                assert!(off < 1e-4, "{size} to {other}, {}: {off}", piece.name);
            }
        }
    }
}

#[test]
fn a_piece_that_was_cut_apart_is_cut_apart_in_all_sizes() {
    let change = "[[change]]\ndo = \"cut\"\npiece = \"FRONT\"\nalong = [{ edge = \"1\", at = \"50 %\" }, { edge = \"7\", at = \"50 %\" }]\n\
                  into = { upper = \"YOKE\", lower = \"FRONT\" }\n";
    let before = shirt("38");
    let params: crate::alter::AlterParams = toml::from_str(change).expect("change");
    let (garment, _) = crate::testing::run(&crate::alter::Alter, &params, before.clone()).expect("cut");
    let text = "source = \"pattern\"\nfile = \"out/run.dxf\"\ngrade_from = \"t-shirt.dxf\"";
    let (result, files, report) = run(garment.clone(), &toml::from_str(text).expect("params"));
    result.expect("written");
    assert!(report.findings.iter().all(|f| f.code == "sizes-carried"), "{:?}", report.findings);
    for size in ["36", "40"] {
        let (there, whole) = (written_in(&files, size), shirt(size));
        let area = |g: &Garment, name: &str| named(g, name).outline.signed_area().abs();
        let [parts, drawn] = [area(&there, "YOKE") + area(&there, "FRONT"), area(&whole, "FRONT")];
        assert!((parts / drawn - 1.0).abs() < 1e-4, "{size}: {parts} {drawn}");
        assert!((area(&there, "YOKE") / area(&garment, "YOKE") - 1.0).abs() > 1e-3);
    }
}

#[test]
fn what_cannot_be_carried_to_other_sizes_is_told() {
    let params = |pattern: &str| {
        let text = format!("source = \"pattern\"\nfile = \"out/run.dxf\"\ngrade_from = \"{pattern}\"");
        toml::from_str::<ExportDxfParams>(&text).expect("params")
    };
    // A pattern of one size, and a size that the pattern has not.
    let unknown = Garment { size: Some("99".into()), ..shirt("38") };
    for (garment, pattern, sizes) in [(shirt("38"), "one-size.dxf", "38"), (unknown, "t-shirt.dxf", "36, 38, 40")] {
        let (result, files, _) = run(garment, &params(pattern));
        let Err(StageError::Input(wrong)) = result else { panic!("{result:?}") };
        assert_eq!((wrong.len(), wrong[0].code.as_str()), (1, "sizes-not-carried"));
        assert!(wrong[0].message.ends_with(&format!("its sizes are: {sizes}")), "{}", wrong[0].message);
        assert!(files.0.is_empty());
    }
    // A corner that was moved off the outline, and a piece that is none of the pattern.
    let mut changed = shirt("38");
    let front = changed.pieces.iter().position(|p| p.name == "FRONT").expect("front");
    let corner = changed.pieces[front].outline.points.iter_mut().find(|p| p.kind == PointKind::Turn).expect("corner");
    corner.at += (corner.at - mm(0.0, 300.0)).normalize() * 0.03;
    let far = |piece: &mut Piece| piece.outline.points.iter_mut().for_each(|p| p.at.x += 2.0);
    let strange = changed.pieces.iter_mut().find(|p| p.name != "FRONT").expect("another piece");
    far(strange);
    let strange = strange.name.clone();
    let (result, files, report) = run(changed, &params("t-shirt.dxf"));
    result.expect("written");
    let told: Vec<&str> =
        report.findings.iter().filter(|f| f.code == "sizes-not-carried").map(|f| f.message.as_str()).collect();
    assert_eq!(told.len(), 2, "{told:?}");
    assert!(told.iter().any(|t| t.starts_with(&format!("`{strange}` lies on no piece of the pattern"))), "{told:?}");
    assert!(told.iter().any(|t| t.starts_with("1 corner(s) of `FRONT` are new")), "{told:?}");
    // What has no growth is the same in all sizes, and the rest still grows.
    let [small, large] = ["36", "40"].map(|size| written_in(&files, size));
    let area = |g: &Garment, name: &str| named(g, name).outline.signed_area().abs();
    assert!((area(&small, &strange) / area(&large, &strange) - 1.0).abs() < 1e-9);
    assert!(area(&large, "FRONT") / area(&small, "FRONT") > 1.02);
}

#[test]
fn a_straight_edge_that_became_a_curve_is_written_as_one() {
    let corners = [(0.0, 0.0, 't'), (200.0, 0.0, 't'), (200.0, 100.0, 't'), (0.0, 100.0, 't')];
    let mut piece = crate::testing::piece(0, "FRONT", &corners);
    let rest: Vec<Vec2> = piece.outline.positions().into_iter().chain([mm(100.0, 0.0)]).collect();
    piece.mesh = Some(PieceMesh {
        rest: rest.clone(),
        triangles: vec![[0, 4, 3], [4, 2, 3], [4, 1, 2]],
        chains: vec![MeshChain { kind: ChainKind::Outline, index: 0, vertices: vec![0, 4, 1, 2, 3], closed: true }],
        outline_vertex: (0..4).map(Some).collect(),
        rest_corners: None,
    });
    // The middle of the lower edge hangs down by 3 mm, or by less than a straight edge may.
    let written = |bow: f64| {
        let to = rest[..4].iter().copied().chain([mm(100.0, -bow)]).collect();
        let flat = Flat { pieces: vec![flat(to)], ..Flat::default() };
        let garment = Garment { pieces: vec![piece.clone()], flat: Some(flat), ..Garment::default() };
        let drawn = finer::finer(&garment);
        (flat_pieces(&drawn).expect("moved").remove(0), drawn.pieces[0].clone())
    };
    let (curved, drawn) = written(3.0);
    assert_eq!((curved.outline.points.len(), drawn.outline.points.len()), (5, 5));
    assert_eq!(curved.outline.points[1], LinePoint { at: mm(100.0, -3.0), kind: PointKind::Curve });
    let ends = |p: &Piece| p.edges.iter().map(|e| [e.from, e.to]).collect::<Vec<_>>();
    let later = |end: u32| if end == 0 { 0 } else { end + 1 };
    assert_eq!(ends(&drawn), ends(&piece).iter().map(|e| e.map(later)).collect::<Vec<_>>());
    assert_eq!(written(0.05).0.outline.points.len(), 4);
}
