//! The bench piece of the meshing study and hand-built garments.

use super::*;
use crate::assemble::Assemble;
use crate::testing::{dart, line, notch, one, piece, rectangle, run, seam, two_points, v};
use toile_garment::dart::DartKind;
use toile_garment::mesh::ChainKind;
use toile_garment::outline::{LinePoint, PieceLine, PointKind};
use toile_garment::piece::PressedFold;
use toile_garment::sewing::RunSpec;
use toile_garment::{PieceId, Report, SeamId};

fn mesh(garment: Garment, h_mm: f64) -> Result<(Garment, Report), StageError> {
    run(&Triangulate, &Params { edge_length: Some(Length(h_mm * 1e-3)), ..Params::default() }, garment)
}

fn arc(from: (f64, f64), to: (f64, f64), bulge: (f64, f64), n: usize) -> Vec<(f64, f64, char)> {
    (1..n)
        .map(|i| {
            let u = i as f64 / n as f64;
            let q = |a: f64, b: f64, c: f64| (1.0 - u) * (1.0 - u) * a + 2.0 * u * (1.0 - u) * b + u * u * c;
            (q(from.0, bulge.0, to.0), q(from.1, bulge.1, to.1), 'c')
        })
        .collect()
}

/// Half bodice 245 × 410 mm with curved armhole and neck, waist dart 28 × 150 (in the outline or marked), fish-eye
/// 18 × 150, pocket line, yoke line from the outline, round hole.
fn bodice(marked: bool) -> Piece {
    let mut points = vec![(0.0, 0.0, 't'), (70.0, 0.0, 't')];
    if !marked {
        points.push((84.0, 150.0, 't'));
    }
    points.extend([(98.0, 0.0, 't'), (245.0, 0.0, 't'), (245.0, 200.0, 't')]);
    points.extend(arc((245.0, 200.0), (190.0, 380.0), (185.0, 235.0), 60));
    points.extend([(190.0, 380.0, 't'), (75.0, 410.0, 't')]);
    points.extend(arc((75.0, 410.0), (0.0, 330.0), (70.0, 335.0), 50));
    points.push((0.0, 330.0, 't'));
    let mut out = piece(0, "bodice", &points);
    let kind = if marked { DartKind::MarkedWedge } else { DartKind::Wedge };
    out.darts = vec![
        dart("waist", kind, &[(84.0, 150.0)], [(70.0, 0.0), (98.0, 0.0)]),
        dart("back", DartKind::FishEye, &[(165.0, 40.0), (165.0, 190.0)], [(156.0, 115.0), (174.0, 115.0)]),
    ];
    fold(&mut out, vec![line(&[(30.0, 200.0), (60.0, 260.0), (110.0, 250.0)]), line(&[(0.0, 300.0), (120.0, 310.0)])]);
    let hole = (0..48).map(|i| {
        let (s, c) = libm::sincos(f64::from(i) / 48.0 * std::f64::consts::TAU);
        LinePoint { at: v(110.0 + 15.0 * c, 350.0 + 15.0 * s), kind: PointKind::Curve }
    });
    out.cutouts = vec![PieceLine { points: hole.collect(), closed: true, ..PieceLine::default() }];
    out
}

/// Folds a piece along lines that are drawn on it.
fn fold(piece: &mut Piece, lines: Vec<PieceLine>) {
    let pressed = |l: &PieceLine| PressedFold { name: "fold".into(), line: l.positions(), angle: 1.0, pleat: None };
    piece.folds = lines.iter().map(pressed).collect();
    piece.internal_lines = lines;
}

/// Edges of all chains that no triangle has.
fn missing(piece: &Piece) -> usize {
    let mesh = piece.mesh.as_ref().expect("mesh");
    let edges: Vec<[u32; 2]> = mesh
        .chains
        .iter()
        .flat_map(|c| {
            let last = c.vertices.len();
            let count = if c.closed { last } else { last - 1 };
            (0..count).map(|i| [c.vertices[i], c.vertices[(i + 1) % last]]).collect::<Vec<_>>()
        })
        .collect();
    regular::missing(&mesh.triangles, &edges).len()
}

/// Least angle and least shape figure q = 4√3 A / Σl², and mean q.
fn figures(piece: &Piece) -> (f64, f64, f64) {
    let mesh = piece.mesh.as_ref().expect("mesh");
    let (mut angle, mut least, mut sum): (f64, f64, f64) = (180.0, 1.0, 0.0);
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|i| mesh.rest[i as usize]);
        angle = angle.min(smooth::least_angle(a, b, c).to_degrees());
        let l2 = (b - a).norm_squared() + (c - b).norm_squared() + (a - c).norm_squared();
        let q = 2.0 * 3_f64.sqrt() * smooth::cross(a, b, c) / l2;
        least = least.min(q);
        sum += q;
    }
    (angle, least, sum / mesh.triangles.len() as f64)
}

/// The goals of the meshing study hold at 2k and 20k triangles, for the drawn and the marked dart.
#[test]
fn bench_piece_meets_the_goals() {
    for (triangles, q_mean) in [(2_000, 0.972), (20_000, 0.991)] {
        for marked in [false, true] {
            let params = Params { triangles: Some(triangles), ..Params::default() };
            let (garment, report) = run(&Triangulate, &params, one(bodice(marked))).expect("mesh");
            let p = &garment.pieces[0];
            let mesh = p.mesh.as_ref().expect("mesh");
            let t = mesh.triangles.len() as f64 / f64::from(triangles);
            assert!((0.88..1.08).contains(&t), "{triangles} wanted, {} made", mesh.triangles.len());
            let (angle, q_least, q) = figures(p);
            println!("T {} least angle {angle:.2} q {q_least:.3} / {q:.4}", mesh.triangles.len());
            assert!(angle >= 37.0, "{triangles}: least angle {angle}");
            assert!(q_least >= 0.74 && q >= q_mean, "{triangles}: q {q_least} {q}");
            assert_eq!(missing(p), 0);
            assert!(report.findings.is_empty(), "{:?}", report.findings);
            for d in &p.darts {
                let legs = &d.mesh.as_ref().expect("dart mesh").legs;
                assert_eq!(legs[0].len(), legs[1].len());
                assert!(legs[0].len() > 3);
                let at = |id: &u32| mesh.rest[*id as usize];
                for (leg, drawn) in legs.iter().zip(&d.legs) {
                    assert!((at(&leg[0]) - drawn[0]).norm() < 1e-6);
                    assert!((at(&leg[leg.len() - 1]) - drawn[drawn.len() - 1]).norm() < 1e-6);
                }
                assert_eq!(legs[0].last(), legs[1].last(), "the legs share the apex");
            }
            let lines = |kind| mesh.chains.iter().filter(|c| c.kind == kind).count();
            assert_eq!(
                (lines(ChainKind::DartLeg), lines(ChainKind::InternalLine), lines(ChainKind::Cutout)),
                (4, 2, 1)
            );
        }
    }
}

/// Both points of a fish-eye dart at its widest place are vertices at any edge length, so the mesh sews its whole width.
#[test]
fn a_fish_eye_dart_keeps_its_width() {
    for h in [8.0, 14.0, 20.0, 30.0, 45.0] {
        let piece = &mesh(one(bodice(false)), h).expect("mesh").0.pieces[0];
        let (rest, legs) =
            (&piece.mesh.as_ref().expect("mesh").rest, &piece.darts[1].mesh.as_ref().expect("legs").legs);
        let width = |k: usize| (rest[legs[0][k] as usize] - rest[legs[1][k] as usize]).norm();
        let widest = (0..legs[0].len()).map(width).fold(0.0, f64::max);
        assert!((widest - 18e-3).abs() < 1e-6, "{h} mm: {} mm", widest * 1e3);
    }
}

/// The yoke line starts on a vertex of the outline, and all ends and corners of the outline are vertices.
#[test]
fn lines_share_vertices() {
    let (garment, _) = mesh(one(bodice(false)), 12.0).expect("mesh");
    let p = &garment.pieces[0];
    let m = p.mesh.as_ref().expect("mesh");
    let yoke = m.chains.iter().find(|c| c.kind == ChainKind::InternalLine && c.index == 1).expect("yoke");
    assert!(m.outline().expect("outline").vertices.contains(&yoke.vertices[0]));
    for (point, id) in p.outline.points.iter().zip(&m.outline_vertex) {
        if point.kind == PointKind::Turn {
            let id = id.expect("a corner is a vertex");
            assert!((m.rest[id as usize] - point.at).norm() < 1e-6);
        }
    }
}

/// Chains walk the outline counter-clockwise, and the mesh area is that of the chains.
#[test]
fn area_is_that_of_the_sampled_outline() {
    for h in [5.0, 12.0, 30.0] {
        let (garment, _) = mesh(one(bodice(true)), h).expect("mesh");
        let p = &garment.pieces[0];
        let m = p.mesh.as_ref().expect("mesh");
        let area = |ids: &[u32]| lines::signed_area(&ids.iter().map(|v| m.rest[*v as usize]).collect::<Vec<_>>());
        let outer = area(&m.outline().expect("outline").vertices);
        assert!(outer > 0.0);
        let hole: f64 = m.chains.iter().filter(|c| c.kind == ChainKind::Cutout).map(|c| area(&c.vertices).abs()).sum();
        let legs = &p.darts[1].mesh.as_ref().expect("fish-eye").legs;
        let lens: Vec<u32> = legs[0].iter().chain(legs[1].iter().rev().skip(1)).copied().collect();
        let lens = area(&lens[..lens.len() - 1]).abs();
        assert!(((outer - hole - lens) / m.area() - 1.0).abs() < 1e-9);
        assert!(m.triangles.iter().all(|t| m.triangle_area(*t) > 0.0));
    }
}

#[test]
fn same_input_same_mesh() {
    let make = || mesh(one(bodice(false)), 9.0).expect("mesh").0;
    assert_eq!(make(), make());
}

/// A skirt with two waist darts on a waistband: the waist is one run that skips the darts.
#[test]
fn waistband_skips_the_darts() {
    for marked in [false, true] {
        let mut points = vec![(0.0, 0.0, 't'), (400.0, 0.0, 't'), (380.0, 500.0, 't')];
        for x in [270.0, 130.0] {
            points.push((x + 12.0, 500.0, 't'));
            if !marked {
                points.push((x, 380.0, 't'));
            }
            points.push((x - 12.0, 500.0, 't'));
        }
        points.push((20.0, 500.0, 't'));
        let mut skirt = piece(0, "skirt", &points);
        let kind = if marked { DartKind::MarkedWedge } else { DartKind::Wedge };
        let wedge = |name, x: f64| dart(name, kind, &[(x, 380.0)], [(x + 12.0, 500.0), (x - 12.0, 500.0)]);
        skirt.darts = vec![wedge("right", 270.0), wedge("left", 130.0)];
        let band = rectangle(1, "band", 312.0, 40.0);
        let mut garment = Garment { pieces: vec![skirt, band], ..Garment::default() };
        garment.plan.seams = vec![seam(
            "waist",
            vec![two_points("skirt", (20.0, 500.0), (380.0, 500.0))],
            vec![two_points("band", (0.0, 0.0), (312.0, 0.0))],
        )];
        let (garment, _) = mesh(garment, 12.0).expect("mesh");
        let (garment, _) = run(&Assemble, &Default::default(), garment).expect("seams");
        let waist = &garment.seams[0];
        assert_eq!(waist.id, SeamId(0));
        assert!((waist.a.length - 0.312).abs() < 1e-9 && waist.ease.abs() < 1e-9, "{}", waist.a.length);
        assert_eq!(waist.a.runs.len(), 3, "two darts cut the waist into three runs");
        // Every stitch joins places at equal distance along the seam; at a mouth two vertices meet one.
        let at = |s: &toile_garment::MeshVertex| {
            garment.pieces[s.piece.index()].mesh.as_ref().expect("mesh").rest[s.vertex as usize]
        };
        for s in &waist.stitches {
            let x = at(&s.a).x * 1e3;
            let passed = [142.0, 282.0].iter().filter(|m| x > **m - 0.01).count() as f64 * 24.0;
            assert!((x - passed - 20.0 - at(&s.b).x * 1e3).abs() < 1e-3, "{x}");
        }
        let edges =
            |side: &toile_garment::seam::SeamSide| side.runs.iter().map(|r| r.vertices.len() - 1).sum::<usize>();
        assert_eq!(edges(&waist.a), edges(&waist.b));
        assert_eq!(waist.stitches.len(), edges(&waist.a) + 3, "two mouths give one stitch more each");
        assert_eq!(garment.seams.len(), 3, "two darts are seams too");
    }
}

/// Matching notches meet, and the ease stays between them.
#[test]
fn notches_split_the_ease() {
    let mut a = rectangle(0, "front", 200.0, 300.0);
    let mut b = rectangle(1, "back", 200.0, 306.0);
    a.notches = vec![notch(200.0, 100.0)];
    b.notches = vec![notch(0.0, 106.0)];
    let mut garment = Garment { pieces: vec![a, b], ..Garment::default() };
    garment.plan.seams = vec![seam(
        "side",
        vec![RunSpec::Edge { piece: "front".into(), edge: "1".into() }],
        vec![RunSpec::Edge { piece: "back".into(), edge: "3".into() }],
    )];
    let (garment, _) = mesh(garment, 10.0).expect("mesh");
    let (garment, report) = run(&Assemble, &Default::default(), garment).expect("seams");
    let at = |s: &toile_garment::MeshVertex| {
        garment.pieces[s.piece.index()].mesh.as_ref().expect("mesh").rest[s.vertex as usize].y * 1e3
    };
    let side = &garment.seams[0];
    assert!((side.ease + 6e-3).abs() < 1e-9);
    for s in &side.stitches {
        let (ya, yb) = (at(&s.a), at(&s.b));
        // Below the notch 106 over 100, above it length for length.
        let expected = if ya <= 100.0 + 1e-6 { ya * 1.06 } else { ya + 6.0 };
        assert!((yb - expected).abs() < 1e-3, "{ya} meets {yb}");
    }
    assert!(report.findings.iter().any(|f| f.code == "seam-eased"));
}

#[test]
fn a_seam_between_edges_that_do_not_belong_together_names_free_edges_that_fit() {
    let pieces = vec![rectangle(0, "front", 200.0, 300.0), rectangle(1, "back", 200.0, 330.0)];
    let mut garment = Garment { pieces, ..Garment::default() };
    let edge = |piece: &str, edge: &str| vec![RunSpec::Edge { piece: piece.into(), edge: edge.into() }];
    garment.plan.seams =
        vec![seam("hem", edge("front", "0"), edge("back", "2")), seam("side", edge("front", "1"), edge("front", "2"))];
    let (garment, _) = mesh(garment, 12.0).expect("mesh");
    let Err(StageError::Parameter(errors)) = run(&Assemble, &Default::default(), garment) else { panic!("refused") };
    // The edges of the first seam are taken; 300 mm is the other side of the front alone.
    let hint = errors[0].hint.as_deref().unwrap_or_default();
    let fits = "to 300.0 mm fits `front.3` (300.0 mm); to 200.0 mm fits `back.0` (200.0 mm)";
    let declare = "; or if side a is gathered, write gather = 1.500";
    assert_eq!(hint, format!("{fits}{declare}"));
}

#[test]
fn a_side_that_is_longer_by_a_plausible_gather_is_offered_the_line_to_write() {
    let pieces = vec![rectangle(0, "skirt", 462.0, 500.0), rectangle(1, "band", 400.0, 40.0)];
    let mut garment = Garment { pieces, ..Garment::default() };
    let edge = |piece: &str, edge: &str| vec![RunSpec::Edge { piece: piece.into(), edge: edge.into() }];
    garment.plan.seams = vec![seam("waist", edge("skirt", "2"), edge("band", "0"))];
    let (garment, _) = mesh(garment, 20.0).expect("mesh");
    let Err(StageError::Parameter(errors)) = run(&Assemble, &Default::default(), garment) else { panic!("refused") };
    let hint = errors[0].hint.as_deref().unwrap_or_default();
    assert!(hint.contains("if side a is gathered, write gather = 1.155"), "{hint}");
    assert!(!hint.contains("no free edge"), "{hint}");
}

/// Lines drawn inside a piece that end on its outline beside the ends of a seam, on both sides of them, at corners of
/// the piece and between.
#[test]
fn a_line_that_ends_beside_the_end_of_a_seam_leaves_the_seam_its_counts() {
    for beside in [-6.0, -1.5, -0.5, -0.08, 0.0, 0.02, 0.08, 0.2, 0.5, 0.9, 1.5, 3.0, 6.0] {
        for edge_length in [8.0, 12.0, 25.0] {
            for whole in [true, false] {
                let [low, high] = if whole { [0.0, 300.0] } else { [80.0, 220.0] };
                let (from, to) = (f64::max(low + beside, 0.0), f64::min(high - beside, 300.0));
                let mut front = rectangle(0, "front", 200.0, 300.0);
                fold(&mut front, vec![line(&[(200.0, to), (120.0, 200.0), (200.0, from)])]);
                let pieces = vec![front, rectangle(1, "back", 200.0, 300.0)];
                let mut garment = Garment { pieces, ..Garment::default() };
                let side = |piece: &str, x: f64| vec![two_points(piece, (x, low), (x, high))];
                garment.plan.seams = vec![seam("side", side("front", 200.0), side("back", 0.0))];
                let sewn = mesh(garment, edge_length).map(|(garment, _)| run(&Assemble, &Default::default(), garment));
                let sewn = sewn.expect("mesh");
                assert!(sewn.is_ok(), "{beside} mm, edges of {edge_length} mm, {whole}: {:?}", sewn.err());
            }
        }
    }
}

#[test]
fn undeclared_difference_is_refused() {
    let pieces = vec![rectangle(0, "front", 200.0, 300.0), rectangle(1, "back", 200.0, 330.0)];
    let mut garment = Garment { pieces, ..Garment::default() };
    let edge = |piece: &str, edge: &str| vec![RunSpec::Edge { piece: piece.into(), edge: edge.into() }];
    garment.plan.seams = vec![seam("side", edge("front", "1"), edge("back", "3"))];
    let sewn = |garment: Garment| run(&Assemble, &Default::default(), mesh(garment, 12.0).expect("mesh").0);
    let Err(StageError::Parameter(errors)) = sewn(garment.clone()) else { panic!("refused") };
    assert_eq!(errors[0].code, "seam-lengths-differ");
    assert!(errors[0].message.contains("300.0 mm") && errors[0].message.contains("330.0 mm"), "{}", errors[0].message);
    garment.plan.seams[0].ease = Some(-0.030);
    assert!(sewn(garment.clone()).is_ok());
    garment.plan.seams[0].ease = None;
    garment.plan.seams[0].gather = Some(1.1);
    assert!(sewn(garment).is_ok());
}

/// A tube from one piece, a side over two pieces, a whole closed outline on a cutout.
#[test]
fn tubes_chains_and_loops() {
    let mut garment = one(rectangle(0, "leg", 300.0, 200.0));
    garment.plan.seams = vec![seam(
        "tube",
        vec![two_points("leg", (300.0, 0.0), (300.0, 200.0))],
        vec![two_points("leg", (0.0, 0.0), (0.0, 200.0))],
    )];
    let (sewn, report) = run(&Assemble, &Default::default(), mesh(garment, 12.0).expect("mesh").0).expect("tube");
    assert!(report.findings.is_empty(), "{:?}", report.findings);
    assert!(sewn.seams[0].stitches.iter().all(|s| s.a != s.b));

    let pieces = vec![
        rectangle(0, "left", 120.0, 200.0),
        rectangle(1, "right", 180.0, 200.0),
        rectangle(2, "band", 300.0, 30.0),
    ];
    let mut garment = Garment { pieces, ..Garment::default() };
    garment.plan.seams = vec![seam(
        "band",
        vec![two_points("left", (0.0, 200.0), (120.0, 200.0)), two_points("right", (0.0, 200.0), (180.0, 200.0))],
        vec![two_points("band", (0.0, 0.0), (300.0, 0.0))],
    )];
    let (sewn, _) = run(&Assemble, &Default::default(), mesh(garment, 12.0).expect("mesh").0).expect("band");
    let band = &sewn.seams[0];
    let rest = |s: &toile_garment::MeshVertex| {
        sewn.pieces[s.piece.index()].mesh.as_ref().expect("mesh").rest[s.vertex as usize]
    };
    assert!(
        band.stitches.iter().any(|s| (rest(&s.b).x - 0.120).abs() < 1e-6),
        "the join of the two pieces has a partner"
    );
    for s in &band.stitches {
        let offset = if s.a.piece == PieceId(1) { 0.120 } else { 0.0 };
        assert!((rest(&s.a).x + offset - rest(&s.b).x).abs() < 1e-6);
    }
}

#[test]
fn a_line_is_not_sewn_to_itself() {
    let mut garment = one(rectangle(0, "leg", 300.0, 200.0));
    garment.plan.seams = vec![seam(
        "fold",
        vec![two_points("leg", (0.0, 0.0), (0.0, 200.0))],
        vec![two_points("leg", (0.0, 200.0), (0.0, 0.0))],
    )];
    let Err(StageError::Parameter(errors)) = mesh(garment, 12.0) else { panic!("refused") };
    assert_eq!(errors[0].code, "seam-to-itself");
}

#[test]
fn bad_outlines_are_named_with_their_place() {
    let code = |p: Piece, h: f64| match mesh(one(p), h) {
        Err(StageError::Input(e) | StageError::Parameter(e)) => (e[0].code.clone(), e[0].message.clone()),
        Err(StageError::Limit(m)) => ("limit".to_owned(), m),
        other => panic!("{other:?}"),
    };
    let bow = piece(0, "bow", &[(0.0, 0.0, 't'), (100.0, 90.0, 't'), (100.0, 0.0, 't'), (0.0, 100.0, 't')]);
    let (c, m) = code(bow, 12.0);
    assert_eq!(c, "outline-crosses-itself");
    assert!(m.contains("`bow`") && m.contains("(52.6, 47.4) mm"), "{m}");
    let flat = piece(0, "flat", &[(0.0, 0.0, 't'), (50.0, 0.0, 't'), (100.0, 0.0, 't')]);
    assert_eq!(code(flat, 12.0).0, "outline-too-small");
    let dot = piece(0, "dot", &[(1.0, 1.0, 't'), (1.0, 1.0, 't'), (1.0, 1.0, 't')]);
    assert_eq!(code(dot, 12.0).0, "outline-too-small");
    assert_eq!(code(piece(0, "none", &[]), 12.0).0, "outline-too-small");
    assert_eq!(
        code(piece(0, "nan", &[(0.0, 0.0, 't'), (f64::NAN, 0.0, 't'), (1.0, 1.0, 't')]), 12.0).0,
        "coordinate-out-of-range"
    );
    assert_eq!(code(rectangle(0, "big", 1000.0, 1000.0), 0.05).0, "limit");
    assert_eq!(code(rectangle(0, "small", 30.0, 30.0), 150.0).0, "edge-length");
    assert_eq!(code(rectangle(0, "zero", 30.0, 30.0), 0.0).0, "edge-length");
    let mut hole = rectangle(0, "hole", 100.0, 100.0);
    hole.cutouts = vec![PieceLine { closed: true, ..line(&[(200.0, 0.0), (250.0, 0.0), (250.0, 50.0)]) }];
    assert_eq!(code(hole.clone(), 12.0).0, "hole-misplaced");
    hole.cutouts = vec![PieceLine { closed: true, ..line(&[(50.0, 50.0), (150.0, 50.0), (100.0, 80.0)]) }];
    assert_eq!(code(hole, 12.0).0, "lines-cross");
}

/// Hard but sound outlines: a hair spike, a strip thinner than any edge, half a degree, darts without intake.
#[test]
fn hard_outlines_are_meshed() {
    let ok = |p: Piece, h: f64| {
        let (g, _) = mesh(one(p), h).expect("mesh");
        assert_eq!(missing(&g.pieces[0]), 0);
        g.pieces[0].mesh.as_ref().expect("mesh").triangles.len()
    };
    ok(
        piece(
            0,
            "spike",
            &[
                (0.0, 0.0, 't'),
                (100.0, 0.0, 't'),
                (100.0, 50.0, 't'),
                (150.0, 50.005, 't'),
                (100.0, 50.01, 't'),
                (100.0, 100.0, 't'),
                (0.0, 100.0, 't'),
            ],
        ),
        10.0,
    );
    assert!(ok(rectangle(0, "strip", 300.0, 0.2), 10.0) >= 2);
    ok(piece(0, "sharp", &[(0.0, 0.0, 't'), (300.0, 0.0, 't'), (300.0, 2.6, 't')]), 5.0);
    let mut flat = rectangle(0, "flat", 200.0, 200.0);
    flat.darts = vec![dart("none", DartKind::MarkedWedge, &[(100.0, 100.0)], [(100.0, 0.0), (100.0, 0.0)])];
    ok(flat, 10.0);
    let wide: Vec<(f64, f64, char)> = vec![
        (0.0, 0.0, 't'),
        (20.0, 0.0, 't'),
        (100.0, 80.0, 't'),
        (180.0, 0.0, 't'),
        (200.0, 0.0, 't'),
        (200.0, 300.0, 't'),
        (0.0, 300.0, 't'),
    ];
    let mut wide = piece(0, "wide", &wide);
    wide.darts = vec![dart("wide", DartKind::Wedge, &[(100.0, 80.0)], [(20.0, 0.0), (180.0, 0.0)])];
    ok(wide, 10.0);
}

/// 100,000 points on an outline, in seconds.
#[test]
fn many_points_are_no_trouble() {
    let round: Vec<(f64, f64, char)> = (0..100_000)
        .map(|i| {
            let (s, c) = libm::sincos(f64::from(i) * 1e-5 * std::f64::consts::TAU);
            (200.0 * c, 200.0 * s, 'c')
        })
        .collect();
    let mut p = piece(0, "round", &round);
    p.edges.clear();
    let (g, _) = mesh(one(p), 12.0).expect("mesh");
    let area = g.pieces[0].mesh.as_ref().expect("mesh").area();
    assert!((area / (std::f64::consts::PI * 0.04) - 1.0).abs() < 2e-3, "{area}");
}

#[test]
fn pleats_keep_their_cloth() {
    let mut p = rectangle(0, "skirt", 300.0, 400.0);
    let mut pleat = dart("pleat", DartKind::Pleat, &[(120.0, 300.0)], [(170.0, 400.0), (120.0, 400.0)]);
    pleat.legs = [vec![v(170.0, 400.0), v(170.0, 300.0)], vec![v(120.0, 400.0), v(120.0, 300.0)]];
    p.darts = vec![pleat];
    let mut garment = Garment { pieces: vec![p, rectangle(1, "band", 250.0, 40.0)], ..Garment::default() };
    garment.plan.seams = vec![seam(
        "waist",
        vec![two_points("skirt", (0.0, 400.0), (300.0, 400.0))],
        vec![two_points("band", (0.0, 0.0), (250.0, 0.0))],
    )];
    let (garment, _) = mesh(garment, 12.0).expect("mesh");
    let area = garment.pieces[0].mesh.as_ref().expect("mesh").area();
    assert!((area - 0.12).abs() < 1e-9, "{area}");
    let (garment, _) = run(&Assemble, &Default::default(), garment).expect("seams");
    assert!((garment.seams[0].a.length - 0.25).abs() < 1e-9);
    assert_eq!(garment.seams[1].a.runs[0].vertices.len(), garment.seams[1].b.runs[0].vertices.len());
    assert!(garment.seams[1].stitches.len() > 5);
}

/// lyon's draft covers the same area with the layout's own vertices.
#[test]
fn draft_mesher_covers_the_cloth() {
    let params = Params { mesher: Mesher::Lyon, ..Params::default() };
    let (garment, _) = run(&Triangulate, &params, one(bodice(false))).expect("draft");
    let (regular, _) = mesh(one(bodice(false)), 12.0).expect("mesh");
    let area = |g: &Garment| g.pieces[0].mesh.as_ref().expect("mesh").area();
    assert!((area(&garment) / area(&regular) - 1.0).abs() < 1e-6);
    let m = garment.pieces[0].mesh.as_ref().expect("mesh");
    assert!(m.triangles.iter().all(|t| m.triangle_area(*t) >= 0.0));
}

/// xorshift, seeded.
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Random outlines, lines, holes, darts and seams: an answer or named errors, never a panic.
#[test]
fn random_outlines_never_panic() {
    let mut dice = Dice(0x9E37_79B9_7F4A_7C15);
    let mut meshed = 0;
    for round in 0..600 {
        let n = 3 + (dice.next() * 9.0) as usize;
        let wild = dice.next() < 0.4;
        let mut spot = |i: usize| {
            let (s, c) = libm::sincos(i as f64 / n as f64 * std::f64::consts::TAU);
            let r = if wild { 400.0 * dice.next() - 100.0 } else { 60.0 + 80.0 * dice.next() };
            ((r * c).round(), (r * s).round(), if dice.next() < 0.3 { 'c' } else { 't' })
        };
        let points: Vec<_> = (0..n).map(&mut spot).collect();
        let mut p = piece(0, "random", &points);
        let mut place = || ((dice.next() * 300.0 - 150.0).round(), (dice.next() * 300.0 - 150.0).round());
        fold(&mut p, vec![line(&[place(), place(), place()]), line(&[place(), place()])]);
        if round % 3 == 0 {
            p.cutouts = vec![PieceLine { closed: true, ..line(&[place(), place(), place()]) }];
        }
        if round % 4 == 0 {
            let kind = [DartKind::Wedge, DartKind::MarkedWedge, DartKind::FishEye, DartKind::Pleat][round / 4 % 4];
            let at = |i: usize| (points[i % n].0, points[i % n].1);
            p.darts = vec![dart("d", kind, &[place(), place()], [at(round), at(round + 1)])];
        }
        let mut garment = Garment { pieces: vec![p, rectangle(1, "band", 200.0, 40.0)], ..Garment::default() };
        let edge = |piece: &str, edge: usize| RunSpec::Edge { piece: piece.into(), edge: edge.to_string() };
        garment.plan.seams = vec![seam("s", vec![edge("random", round % n)], vec![edge("band", round % 4)])];
        if let Ok((g, _)) = mesh(garment, 15.0) {
            meshed += 1;
            assert_eq!(missing(&g.pieces[0]), 0, "round {round}");
            let _ = run(&Assemble, &Default::default(), g);
        }
    }
    assert!(meshed > 120, "{meshed}");
}

/// A needle dart of 3 mm over 190 mm is cut out like any other: legs of equal counts, good triangles beside it.
#[test]
fn needle_darts_leave_good_triangles() {
    let mouth = [(151.5, 600.0), (148.5, 600.0)];
    for (marked, h) in [(false, 8.0), (false, 14.0), (false, 20.0), (true, 8.0), (true, 14.0), (true, 20.0)] {
        let mut points = vec![(0.0, 0.0, 't'), (300.0, 0.0, 't'), (300.0, 600.0, 't'), (151.5, 600.0, 't')];
        points.extend((!marked).then_some((150.0, 410.0, 't')));
        points.extend([(148.5, 600.0, 't'), (0.0, 600.0, 't')]);
        let mut front = piece(0, "front", &points);
        let kind = if marked { DartKind::MarkedWedge } else { DartKind::Wedge };
        front.darts = vec![dart("needle", kind, &[(150.0, 410.0)], mouth)];
        let (garment, report) = mesh(one(front), h).expect("mesh");
        assert!(report.findings.is_empty(), "{h} mm: {:?}", report.findings);
        let p = &garment.pieces[0];
        let m = p.mesh.as_ref().expect("mesh");
        assert!((m.area() - (0.18 - 0.5 * 3e-3 * 0.19)).abs() < 1e-9, "{h} mm: {}", m.area());
        let (angle, q, _) = figures(p);
        assert!(angle >= 30.0 && q >= 0.7, "marked {marked}, {h} mm: least angle {angle}, q {q}");
        let legs = &p.darts[0].mesh.as_ref().expect("dart mesh").legs;
        assert_eq!(legs[0].len(), legs[1].len());
        assert_eq!(legs[0].last(), legs[1].last(), "the legs share the apex");
        assert_eq!(missing(p), 0);
        let (garment, _) = run(&Assemble, &Default::default(), garment).expect("seams");
        assert_eq!(garment.seams[0].stitches.len(), legs_of(&garment)[0].len() - 1);
    }
}

fn legs_of(garment: &Garment) -> &[Vec<u32>; 2] {
    &garment.pieces[0].darts[0].mesh.as_ref().expect("dart mesh").legs
}

#[test]
fn seam_ends_a_hair_apart_give_both_sides_equal_counts() {
    // The left piece's side is sewn in two parts. One ends 1.5 µm before the other begins, as rounded numbers do.
    let hair = 1.5e-3;
    for [low, high] in [[0.0, hair], [-hair, 0.0], [-0.7 * hair, 0.6 * hair]] {
        let left = rectangle(0, "left", 200.0, 400.0);
        let right = [rectangle(1, "low", 200.0, 150.0), rectangle(2, "high", 200.0, 250.0)];
        let at = |piece: &str, from: (f64, f64), to: (f64, f64)| two_points(piece, from, to);
        let mut garment = Garment { pieces: vec![left], ..Garment::default() };
        garment.pieces.extend(right);
        garment.plan.seams = vec![
            seam(
                "low",
                vec![at("left", (200.0, 0.0), (200.0, 150.0 + low))],
                vec![at("low", (0.0, 0.0), (0.0, 150.0))],
            ),
            seam(
                "high",
                vec![at("left", (200.0, 150.0 + high), (200.0, 400.0))],
                vec![at("high", (0.0, 0.0), (0.0, 250.0))],
            ),
            seam("across", vec![at("low", (0.0, 150.0), (200.0, 150.0))], vec![at("high", (0.0, 0.0), (200.0, 0.0))]),
        ];
        let (meshed, _) = mesh(garment, 20.0).expect("mesh");
        let (sewn, _) = run(&Assemble, &Default::default(), meshed).expect("counts agree");
        let edges =
            |side: &toile_garment::seam::SeamSide| side.runs.iter().map(|r| r.vertices.len() - 1).sum::<usize>();
        assert!(sewn.seams.iter().all(|s| edges(&s.a) == edges(&s.b)));
        assert_eq!(sewn.seams.len(), 3);
    }
}

#[test]
fn fold_lines_that_hug_each_other_are_left_out_and_said() {
    // Two lines are the same curve, drawn through other points: whatever the sampling, their chords cross.
    let curve = |from: f64| -> Vec<(f64, f64)> {
        let at = |k: u32| from + 5.0 * f64::from(k);
        (0..40).map(|k| (at(k), 200.0 + 30.0 * libm::sin(at(k) / 60.0))).collect()
    };
    let mut front = rectangle(0, "front", 300.0, 400.0);
    fold(&mut front, vec![line(&curve(50.0)), line(&curve(52.5))]);
    let (meshed, report) = mesh(one(front), 20.0).expect("cloth is not refused for a line");
    let told: Vec<&str> = report.findings.iter().map(|f| f.code.as_str()).collect();
    assert!(told.contains(&"fold-line-too-close"), "{told:?}");
    let chains = &meshed.pieces[0].mesh.as_ref().expect("mesh").chains;
    let lines: Vec<u32> = chains.iter().filter(|c| c.kind == ChainKind::InternalLine).map(|c| c.index).collect();
    assert!(lines.len() < 2, "{lines:?}");
    assert_eq!(missing(&meshed.pieces[0]), 0);
}

#[test]
fn a_line_without_a_fold_does_not_change_the_mesh() {
    let plain = rectangle(0, "sleeve", 300.0, 400.0);
    let mut striped = plain.clone();
    // Three stripes 4 mm apart, a short line in the corner and one that runs along the outline.
    let stripe = |x: f64| line(&[(x, -20.0), (x, 420.0)]);
    let corner = line(&[(299.0, 3.0), (297.0, 0.0)]);
    striped.internal_lines =
        vec![stripe(100.0), stripe(104.0), stripe(108.0), corner, line(&[(0.5, 0.0), (2.0, 400.0)])];
    let [meshed, drawn] = [plain, striped].map(|p| mesh(one(p), 20.0).expect("mesh"));
    assert_eq!(meshed.0.pieces[0].mesh, drawn.0.pieces[0].mesh);
    assert!(drawn.1.findings.is_empty(), "{:?}", drawn.1.findings);
    assert_eq!(drawn.0.pieces[0].internal_lines.len(), 5, "the lines stay on the piece");
}

/// A patch pocket, 120 × 140 mm, sewn with three sides to a line on a front of 300 × 400 mm.
fn pocket() -> Garment {
    let around = RunSpec::Line {
        piece: "front".into(),
        line: [(90., 240.), (90., 100.), (210., 100.), (210., 240.)].map(|(x, y)| v(x, y)).to_vec(),
    };
    let edges = [3, 0, 1].map(|k| RunSpec::Edge { piece: "pocket".into(), edge: k.to_string() });
    let mut garment = Garment {
        pieces: vec![rectangle(0, "front", 300.0, 400.0), rectangle(1, "pocket", 120.0, 140.0)],
        ..Garment::default()
    };
    garment.plan.seams = vec![seam("pocket", vec![around], edges.to_vec())];
    garment
}

#[test]
fn a_patch_pocket_is_sewn_to_a_line_inside_a_piece() {
    let (garment, _) = mesh(pocket(), 25.0).expect("mesh");
    let front = garment.pieces[0].mesh.as_ref().expect("mesh");
    let line = front.chains.iter().find(|c| c.kind == ChainKind::SeamLine).expect("seam line");
    assert_eq!((missing(&garment.pieces[0]), line.closed), (0, false));
    let (sewn, report) = run(&Assemble, &Default::default(), garment).expect("sewn");
    assert!(report.findings.is_empty(), "{report:?}");
    let (seam, [front, pocket]) = (&sewn.seams[0], [0, 1].map(|k| sewn.pieces[k].mesh.as_ref().expect("mesh")));
    assert!((seam.a.length - 0.4).abs() < 1e-9 && (seam.b.length - 0.4).abs() < 1e-9);
    // The pocket lies 90 mm to the right and 100 mm up.
    for stitch in &seam.stitches {
        let [on, of] = [front.rest[stitch.a.vertex as usize], pocket.rest[stitch.b.vertex as usize]];
        assert!((on - of - v(90.0, 100.0)).norm() < 1e-6, "{on} {of}");
    }
}

#[test]
fn a_seam_line_on_the_edge_of_its_piece_or_of_no_length_is_refused() {
    let with = |points: &[(f64, f64)]| {
        let mut garment = pocket();
        let line = points.iter().map(|(x, y)| v(*x, *y)).collect();
        garment.plan.seams[0].a = vec![RunSpec::Line { piece: "front".into(), line }];
        let Err(error) = mesh(garment, 25.0) else { panic!("{points:?} is meshed") };
        let (StageError::Input(found) | StageError::Parameter(found)) = error else { panic!("{error:?}") };
        found[0].code.clone()
    };
    assert_eq!(with(&[(90.0, 240.0), (90.0, -20.0)]), "lines-cross");
    assert_eq!(with(&[(400.0, 240.0), (400.0, 100.0)]), "hole-misplaced");
    assert_eq!(with(&[(90.0, 240.0), (90.0, 240.0)]), "run-without-length");
}
