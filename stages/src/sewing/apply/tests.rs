use super::*;
use crate::assemble::Assemble;
use crate::testing::{dart, line, one, piece, rectangle, run, seam, two_points, v};
use crate::triangulate::Triangulate;
use toile_formats::codes::DART_UNDECIDED;
use toile_formats::dxf::darts::UndecidedDart;
use toile_garment::Piece;
use toile_garment::Severity;
use toile_garment::SourceRef;
use toile_garment::dart::DartKind;
use toile_garment::notch::{Notch, NotchKind};
use toile_garment::outline::{LinePoint, PieceLine, PointKind};
use toile_garment::piece::PressedFold;
use toile_garment::sewing::{
    Around, CopySpec, DartSpec, EdgeNameSpec, EdgePlace, EdgeWay, FoldSpec, LayerSpec, PlaceSpec, Placement,
    PleatPress, RunSpec, SeamSpec,
};

fn edge(piece: &str, edge: &str) -> Vec<RunSpec> {
    vec![RunSpec::Edge { piece: piece.into(), edge: edge.into() }]
}

fn notch(x: f64, y: f64) -> Notch {
    Notch {
        kind: NotchKind::V,
        at: v(x, y),
        depth: 4e-3,
        width: 3e-3,
        angle: Some(0.0),
        on: "boundary".into(),
        name: None,
        source: None,
    }
}

fn parameter_errors(result: Result<(), StageError>) -> Vec<Diagnostic> {
    match result {
        Err(StageError::Parameter(e)) => e,
        other => panic!("expected errors of the plan, got {other:?}"),
    }
}

#[test]
fn a_mirrored_copy_is_counter_clockwise_and_keeps_its_marks() {
    let mut sleeve = piece(0, "sleeve", &[(0.0, 0.0, 't'), (100.0, 0.0, 't'), (80.0, 60.0, 't'), (0.0, 90.0, 't')]);
    sleeve.edges[1].name = Some("under".into());
    sleeve.notches = vec![notch(90.0, 30.0)];
    sleeve.grain = Some([v(10.0, 10.0), v(20.0, 50.0)]);
    sleeve.darts = vec![dart("d", DartKind::MarkedWedge, &[(40.0, 30.0)], [(30.0, 0.0), (50.0, 0.0)])];
    let mut garment = one(sleeve);
    let copy = CopySpec { piece: "Sleeve".into(), name: "sleeve-right".into(), mirror: true, source: None };
    let plan = SewingPlan { copies: vec![copy], ..SewingPlan::default() };
    apply(&mut garment, plan, &mut Report::default()).expect("plan");
    let [left, right] = garment.pieces.as_slice() else { panic!("two pieces") };
    assert_eq!((right.id, right.mirrored), (PieceId(1), true));
    assert!((right.outline.signed_area() - left.outline.signed_area()).abs() < 1e-15);
    assert_eq!(right.outline.points[0].at, v(0.0, 0.0));
    // Edge k of the drawn piece is edge n − 1 − k of its mirror image, with the same ends.
    for (k, e) in left.edges.iter().enumerate() {
        let image = &right.edges[3 - k];
        assert_eq!((image.index as usize, &image.name), (3 - k, &e.name));
        let at = |p: &Piece, i: u32| p.outline.points[i as usize].at;
        assert_eq!(at(right, image.from).x, -at(left, e.to).x);
        assert_eq!(at(right, image.to).y, at(left, e.from).y);
    }
    assert_eq!(right.notches[0].at, v(-90.0, 30.0));
    assert_eq!(right.notches[0].angle, Some(std::f64::consts::PI));
    assert!((right.warp().x + left.warp().x).abs() < 1e-15);
    assert_eq!(right.darts[0].mouth, [v(-50.0, 0.0), v(-30.0, 0.0)], "met in walking order again");
    assert_eq!(right.darts[0].legs[0], [v(-50.0, 0.0), v(-40.0, 30.0)]);
    // And it meshes.
    let (sewn, _) = run(&Triangulate, &Default::default(), garment).expect("mesh");
    let area = |i: usize| sewn.pieces[i].mesh.as_ref().expect("mesh").area();
    assert!((area(0) - area(1)).abs() < 1e-12);
}

#[test]
fn names_are_found_without_case_and_missed_names_are_suggested() {
    let mut garment = Garment {
        pieces: vec![rectangle(0, "FRONT", 100.0, 200.0), rectangle(1, "BACK", 100.0, 200.0)],
        ..Garment::default()
    };
    let name = EdgeNameSpec { run: edge("front", "1").remove(0), name: "side".into(), source: None };
    let plan = SewingPlan {
        edge_names: vec![name],
        seams: vec![seam("side", edge("front", "Side"), edge("back", "3"))],
        ..SewingPlan::default()
    };
    apply(&mut garment, plan, &mut Report::default()).expect("plan");
    assert_eq!(garment.pieces[0].edges[1].name.as_deref(), Some("side"));
    let RunSpec::Edge { piece, .. } = &garment.plan.seams[0].a[0] else { panic!("edge") };
    assert_eq!(piece, "FRONT", "later stages find the piece by equality");

    let plan = SewingPlan {
        seams: vec![
            seam("x", edge("frnot", "1"), edge("back", "3")),
            seam("y", edge("front", "sied"), edge("back", "9")),
        ],
        ..SewingPlan::default()
    };
    let errors = parameter_errors(apply(&mut garment.clone(), plan, &mut Report::default()));
    assert_eq!(errors[0].code, "piece-unknown");
    assert!(errors[0].hint.as_deref().is_some_and(|h| h.contains("`FRONT`")));
    let plan = SewingPlan { seams: vec![seam("y", edge("front", "sied"), edge("back", "9"))], ..SewingPlan::default() };
    let errors = parameter_errors(apply(&mut garment, plan, &mut Report::default()));
    assert_eq!(errors.len(), 2);
    assert!(errors[0].hint.as_deref().is_some_and(|h| h.contains("`side`")));
    assert!(errors[1].hint.as_deref().is_some_and(|h| h.contains("0 to 3")));
}

#[test]
fn left_out_pieces_are_gone_and_renumbered() {
    let mut lining = rectangle(1, "pocket", 50.0, 50.0);
    lining.material = Some("Lining".into());
    let pieces = vec![rectangle(0, "fusing", 50.0, 50.0), lining, rectangle(2, "front", 50.0, 50.0)];
    let mut garment = Garment { pieces, ..Garment::default() };
    let plan = SewingPlan { leave_out: vec!["LINING".into(), "Fusing".into()], ..SewingPlan::default() };
    let mut report = Report::default();
    apply(&mut garment, plan, &mut report).expect("plan");
    let told: Vec<_> = report.findings.iter().map(|f| (f.code.as_str(), f.message.as_str())).collect();
    assert_eq!(told, [("pieces-left-out", "left out of the garment: `fusing`, `pocket`")]);
    assert_eq!(garment.pieces.len(), 1);
    assert_eq!((garment.pieces[0].id, garment.pieces[0].name.as_str()), (PieceId(0), "front"));
    let plan = SewingPlan { leave_out: vec!["fornt".into()], ..SewingPlan::default() };
    assert_eq!(parameter_errors(apply(&mut garment, plan, &mut Report::default()))[0].code, "piece-unknown");
}

#[test]
fn a_left_out_piece_that_is_sewn_and_a_name_of_two_seams_are_told() {
    let pieces = vec![rectangle(0, "front", 50.0, 50.0), rectangle(1, "back", 50.0, 50.0)];
    let garment = Garment { pieces, ..Garment::default() };
    let seams = || vec![seam("side", edge("front", "1"), edge("back", "3"))];
    let plan = SewingPlan { leave_out: vec!["BACK".into()], seams: seams(), ..SewingPlan::default() };
    let errors = parameter_errors(apply(&mut garment.clone(), plan, &mut Report::default()));
    assert_eq!((errors.len(), errors[0].message.as_str()), (1, "piece `back` is left out of the garment"));
    let other = seam("side", edge("front", "3"), edge("back", "1"));
    let plan = SewingPlan { seams: [seams(), vec![other]].concat(), ..SewingPlan::default() };
    let mut report = Report::default();
    apply(&mut garment.clone(), plan, &mut report).expect("plan");
    assert_eq!(report.findings.iter().map(|f| f.code.as_str()).collect::<Vec<_>>(), ["seam-name-repeats"]);
}

/// A skirt with a wedge that a godet is sewn into.
fn godet(seams: Vec<SeamSpec>) -> (Garment, Report) {
    let mut skirt = piece(
        0,
        "skirt",
        &[
            (0.0, 0.0, 't'),
            (180.0, 0.0, 't'),
            (200.0, 150.0, 't'),
            (220.0, 0.0, 't'),
            (400.0, 0.0, 't'),
            (400.0, 500.0, 't'),
            (0.0, 500.0, 't'),
        ],
    );
    skirt.darts = vec![dart("dart-1", DartKind::Wedge, &[(200.0, 150.0)], [(180.0, 0.0), (220.0, 0.0)])];
    let insert = piece(1, "godet", &[(0.0, 0.0, 't'), (100.0, 0.0, 't'), (50.0, 142.7, 't')]);
    let mut garment = Garment { pieces: vec![skirt, insert], ..Garment::default() };
    let mut report = Report::default();
    apply(&mut garment, SewingPlan { seams, ..SewingPlan::default() }, &mut report).expect("plan");
    (garment, report)
}

#[test]
fn a_godet_wedge_is_no_dart() {
    let seams = vec![
        seam(
            "g1",
            vec![two_points("skirt", (180.0, 0.0), (200.0, 150.0))],
            vec![two_points("godet", (0.0, 0.0), (50.0, 142.7))],
        ),
        seam(
            "g2",
            vec![two_points("skirt", (220.0, 0.0), (200.0, 150.0))],
            vec![two_points("godet", (100.0, 0.0), (50.0, 142.7))],
        ),
    ];
    let (garment, report) = godet(seams);
    assert!(garment.pieces[0].darts.is_empty());
    assert_eq!(report.findings[0].code, "wedge-is-no-dart");
    assert_eq!(report.count(Severity::Warning), 0);
    let (garment, _) = run(&Triangulate, &Default::default(), garment).expect("mesh");
    let (garment, _) = run(&Assemble, &Default::default(), garment).expect("seams");
    assert_eq!(garment.seams.len(), 2);
    // The whole intake as one run says the same.
    let one_run = seam(
        "g",
        vec![two_points("skirt", (180.0, 0.0), (220.0, 0.0))],
        vec![
            RunSpec::Edge { piece: "godet".into(), edge: "2".into() },
            RunSpec::Edge { piece: "godet".into(), edge: "1".into() },
        ],
    );
    assert!(godet(vec![one_run]).0.pieces[0].darts.is_empty());
}

#[test]
fn a_seam_that_repeats_a_dart_is_left_to_the_dart() {
    let legs = seam(
        "dart",
        vec![two_points("skirt", (180.0, 0.0), (200.0, 150.0))],
        vec![two_points("skirt", (220.0, 0.0), (200.0, 150.0))],
    );
    let (garment, report) = godet(vec![legs]);
    assert_eq!((garment.pieces[0].darts.len(), garment.plan.seams.len()), (1, 0));
    assert_eq!(report.findings[0].code, "seam-is-dart");
}

/// A pleat on the upper edge of a rectangle of 300 × 400 mm, 40 mm deep, with lines of 200 mm.
fn pleat(press: Option<PleatPress>, sewn: Option<f64>) -> DartSpec {
    DartSpec {
        piece: "front".into(),
        name: Some("pleat".into()),
        apexes: vec![v(120.0, 200.0), v(200.0, 200.0)],
        mouth: [v(120.0, 400.0), v(200.0, 400.0)],
        kind: Some(DartKind::Pleat),
        press,
        sewn,
        source: None,
    }
}

#[test]
fn pressed_pleats_fold_at_their_lines_and_between() {
    let folded = |press, sewn| {
        let mut garment = one(rectangle(0, "front", 300.0, 400.0));
        let plan = SewingPlan { darts: vec![pleat(press, sewn)], ..SewingPlan::default() };
        apply(&mut garment, plan, &mut Report::default()).expect("plan");
        garment.pieces.remove(0)
    };
    let places = |p: &Piece| {
        let of = |f: &PressedFold| ((f.line[0].x * 1e3).round(), (f.angle.to_degrees()).round());
        p.folds.iter().map(of).collect::<Vec<_>>()
    };
    let knife = folded(Some(PleatPress::Knife), Some(0.05));
    assert_eq!(places(&knife), [(120.0, 180.0), (160.0, -180.0)]);
    // Both legs are sewn for 50 mm; the rest of the outer fold, and the inner one, are lines of their own.
    assert!((knife.darts[0].leg_length(0) - 0.05).abs() < 1e-9);
    assert_eq!(knife.internal_lines.len(), 2);
    assert!((knife.internal_lines[0].points[0].at - v(120.0, 350.0)).norm() < 1e-9);
    let boxed = folded(Some(PleatPress::Box), Some(0.0));
    assert_eq!(places(&boxed), [(120.0, -180.0), (140.0, 180.0), (180.0, 180.0), (200.0, -180.0)]);
    assert_eq!((boxed.darts[0].legs[0].len(), boxed.internal_lines.len()), (1, 4));
    let inverted = folded(Some(PleatPress::Inverted), None);
    assert_eq!(places(&inverted), [(120.0, 180.0), (140.0, -180.0), (180.0, -180.0), (200.0, 180.0)]);
    assert_eq!(inverted.internal_lines.len(), 2, "its legs are sewn down to their ends");
    assert!(folded(None, None).folds.is_empty());
}

/// A line that is drawn a little beside a fold is the fold, and folds of a curved edge end on it.
#[test]
fn folds_of_a_pleat_lie_on_their_lines_and_on_the_outline() {
    let mut front = rectangle(0, "front", 300.0, 400.0);
    let drawn = line(&[(160.2, 200.0), (160.2, 398.0)]);
    front.internal_lines = vec![drawn];
    let top = front.outline.points.iter().position(|p| p.at == v(0.0, 400.0)).expect("corner");
    let curve = [(200.0, 400.0), (160.0, 398.0), (120.0, 400.0)];
    let points = curve.map(|(x, y)| LinePoint { at: v(x, y), kind: PointKind::Plain });
    front.outline.points.splice(top..top, points);
    let mut garment = one(front);
    let plan = SewingPlan { darts: vec![pleat(Some(PleatPress::Knife), Some(0.0))], ..SewingPlan::default() };
    apply(&mut garment, plan, &mut Report::default()).expect("plan");
    let piece = &garment.pieces[0];
    let inner = &piece.folds[1].line;
    assert!((inner[0] - v(160.0, 398.0)).norm() < 1e-4, "{inner:?}");
    let lines: Vec<_> = piece.internal_lines.iter().map(PieceLine::positions).collect();
    assert!(
        piece.folds.iter().all(|f| lines.iter().any(|l| l.iter().rev().eq(f.line.iter()) || *l == f.line)),
        "{lines:?}"
    );
    assert_eq!(lines.len(), 2, "the drawn line is the inner fold");
}

#[test]
fn folds_are_drawn_on_their_pieces_and_on_mirrored_copies() {
    let fold = |piece: &str| FoldSpec {
        piece: piece.into(),
        name: "hem".into(),
        line: vec![v(0.0, 40.0), v(300.0, 40.0)],
        angle: 3.0,
        source: None,
    };
    let copy = CopySpec { piece: "front".into(), name: "other".into(), mirror: true, source: None };
    let mut garment = one(rectangle(0, "front", 300.0, 400.0));
    let plan = SewingPlan { folds: vec![fold("front")], copies: vec![copy], ..SewingPlan::default() };
    apply(&mut garment, plan, &mut Report::default()).expect("plan");
    let [front, other] = [&garment.pieces[0], &garment.pieces[1]];
    assert_eq!((front.internal_lines.len(), front.folds[0].line.clone()), (1, vec![v(0.0, 40.0), v(300.0, 40.0)]));
    assert_eq!((other.folds[0].line.clone(), other.folds[0].angle), (vec![v(-0.0, 40.0), v(-300.0, 40.0)], 3.0));
    let mut garment = one(rectangle(0, "front", 300.0, 400.0));
    let plan = SewingPlan { folds: vec![fold("back")], ..SewingPlan::default() };
    assert_eq!(parameter_errors(apply(&mut garment, plan, &mut Report::default()))[0].code, "piece-unknown");
}

#[test]
fn darts_are_declared_overruled_and_denied() {
    let spec = |kind, apexes: &[(f64, f64)], mouth: [(f64, f64); 2]| DartSpec {
        piece: "front".into(),
        name: None,
        apexes: apexes.iter().map(|(x, y)| v(*x, *y)).collect(),
        mouth: mouth.map(|(x, y)| v(x, y)),
        kind,
        press: None,
        sewn: None,
        source: None,
    };
    let mut front = rectangle(0, "front", 300.0, 400.0);
    front.internal_lines = vec![
        line(&[(110.0, 0.0), (103.0, 60.0), (100.0, 120.0), (97.0, 60.0), (90.0, 0.0)]),
        PieceLine { closed: true, ..line(&[(200.0, 100.0), (209.0, 175.0), (200.0, 250.0), (191.0, 175.0)]) },
        line(&[(20.0, 300.0), (60.0, 300.0)]),
    ];
    front.darts = vec![dart("found", DartKind::MarkedWedge, &[(250.0, 100.0)], [(240.0, 0.0), (260.0, 0.0)])];
    let darts = vec![
        spec(Some(DartKind::Wedge), &[(100.0, 120.0)], [(110.0, 0.0), (90.0, 0.0)]),
        spec(Some(DartKind::FishEye), &[(200.0, 100.0), (200.0, 250.0)], [(191.0, 175.0), (209.0, 175.0)]),
        spec(None, &[], [(240.0, 0.0), (260.0, 0.0)]),
    ];
    let mut garment = one(front);
    apply(&mut garment, SewingPlan { darts, ..SewingPlan::default() }, &mut Report::default()).expect("plan");
    let front = &garment.pieces[0];
    let [wedge, fish] = front.darts.as_slice() else { panic!("two darts: {:?}", front.darts) };
    assert_eq!(wedge.kind, DartKind::MarkedWedge);
    assert_eq!(wedge.mouth[0], v(90.0, 0.0), "the mouth met first comes first");
    assert_eq!(wedge.legs[0], [v(90.0, 0.0), v(97.0, 60.0), v(100.0, 120.0)], "the line gives the leg");
    assert_eq!(fish.legs[0], [v(200.0, 100.0), v(191.0, 175.0), v(200.0, 250.0)]);
    assert_eq!(front.internal_lines.len(), 3, "pocket line and the two legs of the denied dart");
    let (garment, _) = run(&Triangulate, &Default::default(), garment).expect("mesh");
    for d in &garment.pieces[0].darts {
        let legs = &d.mesh.as_ref().expect("dart mesh").legs;
        assert_eq!(legs[0].len(), legs[1].len());
    }
}

#[test]
fn notches_against_the_direction_show_both_readings() {
    let mut front = rectangle(0, "front", 100.0, 300.0);
    let mut back = rectangle(1, "back", 100.0, 300.0);
    front.notches = vec![notch(100.0, 80.0)];
    back.notches = vec![notch(0.0, 220.0)];
    let mut garment = Garment { pieces: vec![front, back], ..Garment::default() };
    let mut side = seam("side", edge("front", "1"), edge("back", "3"));
    let plan = |side: &SeamSpec| SewingPlan { seams: vec![side.clone()], ..SewingPlan::default() };
    let errors = parameter_errors(apply(&mut garment, plan(&side), &mut Report::default()));
    assert_eq!(errors[0].code, "seam-direction-ambiguous");
    assert!(
        errors[0].message.contains("One reading") && errors[0].message.contains("The other"),
        "{}",
        errors[0].message
    );
    side.reverse = Some(false);
    apply(&mut garment, plan(&side), &mut Report::default()).expect("stated");
}

#[test]
fn the_neck_of_two_pieces_needs_its_direction() {
    let pieces = vec![
        rectangle(0, "front", 100.0, 100.0),
        rectangle(1, "back", 100.0, 100.0),
        rectangle(2, "band", 200.0, 30.0),
    ];
    let mut garment = Garment { pieces, ..Garment::default() };
    let both = [edge("front", "2"), edge("back", "2")].concat();
    let plan = SewingPlan { seams: vec![seam("neck", both.clone(), edge("band", "0"))], ..SewingPlan::default() };
    let errors = parameter_errors(apply(&mut garment, plan, &mut Report::default()));
    assert_eq!(errors[0].code, "seam-direction-ambiguous");
    // A shoulder that joins the end of the first to the start of the second settles it.
    let shoulder = seam("shoulder", edge("front", "3"), edge("back", "1"));
    let turned = both.iter().rev().cloned().collect();
    let mut starts = |list: Vec<RunSpec>, reverse: Option<bool>| {
        let neck = SeamSpec { reverse, ..seam("neck", list, edge("band", "0")) };
        let plan = SewingPlan { seams: vec![shoulder.clone(), neck], ..SewingPlan::default() };
        garment.plan = SewingPlan::default();
        apply(&mut garment, plan, &mut Report::default()).expect("settled by the shoulder");
        let shapes = shapes(&garment).expect("shapes");
        let found = find(&garment, &shapes);
        let found = placed(found).expect("found");
        found[1].a.spans.iter().map(|s| (s.piece.index(), s.forward)).collect::<Vec<_>>()
    };
    assert_eq!(starts(both.clone(), None), [(0, true), (1, true)]);
    // The list written the other way round is the same seam, walked the other way.
    assert_eq!(starts(turned, None), [(1, false), (0, false)]);
    assert_eq!(starts(both, Some(true)), [(0, true), (1, true)]);
}

/// A skirt front with a needle of 3 × 190 mm in its waist that the reader left undecided, cut or drawn as lines, and
/// the band that is sewn to it.
fn needle(marked: bool, seams: Vec<SeamSpec>, darts: Vec<DartSpec>) -> (Garment, Report) {
    let mut points = vec![(0.0, 0.0, 't'), (300.0, 0.0, 't'), (300.0, 600.0, 't'), (151.5, 600.0, 't')];
    points.extend((!marked).then_some((150.0, 410.0, 't')));
    points.extend([(148.5, 600.0, 't'), (0.0, 600.0, 't')]);
    let mut front = piece(0, "front", &points);
    if marked {
        front.internal_lines = vec![line(&[(151.5, 600.0), (150.0, 410.0), (148.5, 600.0)])];
    }
    let mut garment = Garment { pieces: vec![front, rectangle(1, "band", 297.0, 40.0)], ..Garment::default() };
    let spec = DartSpec {
        piece: "front".into(),
        name: None,
        apexes: vec![v(150.0, 410.0)],
        mouth: [v(151.5, 600.0), v(148.5, 600.0)],
        kind: Some(DartKind::Wedge),
        press: None,
        sewn: None,
        source: None,
    };
    let undecided = vec![UndecidedDart { spec, finding: Diagnostic::warning(DART_UNDECIDED, "a wedge") }];
    let mut report = Report::default();
    let plan = SewingPlan { seams, darts, ..SewingPlan::default() };
    apply_deciding(&mut garment, plan, undecided, &mut report).expect("plan");
    (garment, report)
}

/// Seams of the waist that end at both mouth points and go on at one point of the band.
fn waist() -> Vec<SeamSpec> {
    let (left, right) =
        (two_points("front", (148.5, 600.0), (0.0, 600.0)), two_points("front", (300.0, 600.0), (151.5, 600.0)));
    vec![
        seam("left", vec![left], vec![two_points("band", (148.5, 0.0), (0.0, 0.0))]),
        seam("right", vec![right], vec![two_points("band", (297.0, 0.0), (148.5, 0.0))]),
    ]
}

fn codes(report: &Report) -> Vec<&str> {
    report.findings.iter().map(|f| f.code.as_str()).collect()
}

#[test]
fn seams_that_close_a_needle_make_it_a_dart() {
    let one_seam = seam(
        "waist",
        waist().iter().rev().flat_map(|s| s.a.clone()).collect(),
        vec![two_points("band", (297.0, 0.0), (0.0, 0.0))],
    );
    for marked in [false, true] {
        for seams in [waist(), vec![one_seam.clone()]] {
            let (garment, report) = needle(marked, seams, Vec::new());
            assert_eq!(codes(&report), ["dart-by-seams"], "marked {marked}");
            assert_eq!(garment.pieces[0].darts.len(), 1);
            assert!(garment.pieces[0].internal_lines.is_empty(), "its lines are legs now");
            let (garment, _) = run(&Triangulate, &Default::default(), garment).expect("mesh");
            let (garment, _) = run(&Assemble, &Default::default(), garment).expect("seams");
            // The cloth of the needle is gone: half of 3 × 190 mm.
            let area = garment.pieces[0].mesh.as_ref().expect("mesh").area();
            assert!((area - (0.18 - 0.5 * 3e-3 * 0.19)).abs() < 1e-9, "marked {marked}: {area}");
        }
    }
    // The legs sewn to each other are the dart itself.
    let legs = seam(
        "legs",
        vec![two_points("front", (151.5, 600.0), (150.0, 410.0))],
        vec![two_points("front", (148.5, 600.0), (150.0, 410.0))],
    );
    let (garment, report) = needle(false, vec![legs], Vec::new());
    assert_eq!(codes(&report), ["dart-by-seams", "seam-is-dart"]);
    assert_eq!(garment.pieces[0].darts.len(), 1);
}

#[test]
fn a_needle_that_no_seam_closes_is_told_unless_the_file_says_what_it_is() {
    let (garment, report) = needle(false, waist()[..1].to_vec(), Vec::new());
    assert_eq!((codes(&report), garment.pieces[0].darts.len()), (vec!["dart-undecided"], 0));
    // Two seams that end at its mouth and go to places apart leave it open.
    let mut apart = waist();
    apart[1].b = vec![two_points("band", (297.0, 0.0), (151.5, 0.0))];
    assert_eq!(codes(&needle(false, apart, Vec::new()).1), ["dart-undecided"]);
    // A leg that is sewn to another piece is no dart's.
    let taken = seam(
        "godet",
        vec![two_points("front", (151.5, 600.0), (150.0, 410.0))],
        vec![two_points("band", (0.0, 0.0), (190.0, 0.0))],
    );
    let (garment, report) = needle(false, vec![taken], Vec::new());
    assert_eq!((codes(&report), garment.pieces[0].darts.len()), (vec![], 0));
    for (kind, count) in [(Some(DartKind::Wedge), 1), (None, 0)] {
        let mouth = [v(148.5, 600.0), v(151.5, 600.0)];
        let apexes = vec![v(150.0, 410.0)];
        let spec = DartSpec { piece: "Front".into(), apexes, mouth, kind, ..pleat(None, None) };
        let (garment, report) = needle(false, Vec::new(), vec![spec]);
        assert_eq!((codes(&report), garment.pieces[0].darts.len()), (vec![], count), "{kind:?}");
    }
}

#[test]
fn a_needle_that_nobody_found_is_an_error_with_its_place_and_its_lines() {
    let mut garment = needle(true, Vec::new(), Vec::new()).0;
    garment.plan.seams = waist();
    let (garment, _) = run(&Triangulate, &Default::default(), garment).expect("mesh");
    let Err(StageError::Input(errors)) = run(&Assemble, &Default::default(), garment) else { panic!("an error") };
    assert_eq!(errors.len(), 1);
    assert_eq!(errors[0].code, "seams-close-cloth");
    assert!(errors[0].message.contains("piece `front`") && errors[0].message.contains("3.0 mm apart"), "{errors:?}");
    let hint = errors[0].hint.as_deref().expect("hint");
    assert!(hint.contains("apex = [\"150.000 mm\", \"410.000 mm\"]"), "{hint}");
    assert!(hint.contains("[\"148.500 mm\", \"600.000 mm\"]") && hint.contains("[\"151.500 mm\""), "{hint}");
}

/// A part of an edge, with places such as `notch 1` as a sewing file has them.
fn part(piece: &str, edge: &str, from: EdgePlace, to: EdgePlace) -> RunSpec {
    RunSpec::Part { piece: piece.into(), edge: edge.into(), from, to }
}

const fn at(way: EdgeWay) -> EdgePlace {
    EdgePlace { way, from_end: false }
}

const fn before_end(way: EdgeWay) -> EdgePlace {
    EdgePlace { way, from_end: true }
}

/// A piece 200 mm high whose right edge, number 1, has notches at 60 and 150 mm. Its mirrored copy is `twin`.
fn notched() -> Garment {
    let mut front = rectangle(0, "front", 100.0, 200.0);
    front.notches = vec![notch(100.0, 60.0), notch(100.0, 150.0)];
    let copy = CopySpec { piece: "front".into(), name: "twin".into(), mirror: true, source: None };
    let mut garment = one(front);
    let run = part("front", "1", at(EdgeWay::Notch(1)), before_end(EdgeWay::Share(0.0)));
    let slit = EdgeNameSpec { run, name: "slit".into(), source: None };
    let plan = SewingPlan { copies: vec![copy], edge_names: vec![slit], ..SewingPlan::default() };
    apply(&mut garment, plan, &mut Report::default()).expect("plan");
    garment
}

/// Heights of both ends of a run, mm.
fn ends(garment: &Garment, run: &RunSpec) -> Result<[f64; 2], Diagnostic> {
    let shapes = shapes(garment).expect("shapes");
    let found = crate::sewing::lookup::run(garment, &shapes, run, None)?;
    assert!(!found.stated && found.forward);
    let ring = &shapes[found.piece.index()].rings[found.ring];
    Ok([found.from, found.to].map(|s| (ring.at(s).y * 1e6).round() / 1e3))
}

#[test]
fn a_part_of_an_edge_lies_between_its_places() {
    let garment = notched();
    let cases = [
        (at(EdgeWay::Share(0.0)), at(EdgeWay::Share(0.5)), [0.0, 100.0]),
        (at(EdgeWay::Notch(1)), at(EdgeWay::Notch(2)), [60.0, 150.0]),
        (before_end(EdgeWay::Notch(1)), before_end(EdgeWay::Share(0.0)), [150.0, 200.0]),
        (before_end(EdgeWay::Length(0.03)), at(EdgeWay::Length(0.01)), [10.0, 170.0]),
    ];
    for (from, to, want) in cases {
        assert_eq!(ends(&garment, &part("front", "1", from, to)).expect("found"), want);
    }
}

#[test]
fn a_named_part_of_an_edge_is_on_the_mirrored_copy_too() {
    let garment = notched();
    let named = |piece: &str| RunSpec::Edge { piece: piece.into(), edge: "slit".into() };
    assert_eq!(ends(&garment, &named("front")).expect("found"), [60.0, 200.0]);
    // The outline of the copy is walked the other way, so the edge comes down there.
    assert_eq!(ends(&garment, &named("twin")).expect("found"), [200.0, 60.0]);
}

#[test]
fn a_place_beyond_an_edge_is_told_with_length_and_notches() {
    let garment = notched();
    for way in [EdgeWay::Length(0.2001), EdgeWay::Notch(3)] {
        let found = ends(&garment, &part("front", "1", at(way), before_end(EdgeWay::Share(0.0)))).expect_err("beyond");
        let hint = found.hint.clone().expect("hint");
        assert_eq!(found.code, codes::EDGE_PLACE_UNKNOWN);
        assert_eq!(hint, "it is 200.0 mm long; its notches are at 60.0 mm, 150.0 mm from its start");
    }
    let same = ends(&garment, &part("front", "1", at(EdgeWay::Length(0.06)), at(EdgeWay::Notch(1))));
    assert_eq!(same.expect_err("no length").code, codes::RUN_WITHOUT_LENGTH);
}

fn in_line(line: u64) -> Option<SourceRef> {
    Some(SourceRef::file("s.toml").at_line(line))
}

/// Codes, lines and messages of what is wrong with a plan for a rectangle of 300 × 400 mm called `front`.
fn wrong(plan: SewingPlan) -> Vec<(String, Option<u64>, String)> {
    let errors = parameter_errors(apply(&mut one(rectangle(0, "front", 300.0, 400.0)), plan, &mut Report::default()));
    errors.into_iter().map(|e| (e.code, e.source.and_then(|s| s.line), e.message)).collect()
}

#[test]
fn two_tables_of_one_piece_or_dart_are_refused_with_both_places() {
    let place = |piece: &str, line| PlaceSpec {
        piece: piece.into(),
        placement: Placement::Around(Around { segment: "torso".into(), ..Around::default() }),
        ignores: None,
        source: in_line(line),
    };
    let layer = |order, line| LayerSpec { pieces: vec!["Front".into()], order, source: in_line(line) };
    let dart = |name: &str, kind, line| DartSpec {
        name: Some(name.into()),
        kind,
        source: in_line(line),
        ..pleat(Some(PleatPress::Knife), None)
    };
    let elsewhere = |dart: DartSpec| DartSpec {
        mouth: [v(20.0, 400.0), v(60.0, 400.0)],
        apexes: vec![v(20.0, 200.0), v(60.0, 200.0)],
        ..dart
    };
    let pleated = Some(DartKind::Pleat);
    let none = SewingPlan::default;
    let plans = [
        (SewingPlan { places: vec![place("front", 5), place("FRONT", 9)], ..none() }, "second [[place]]"),
        (SewingPlan { layers: vec![layer(1, 5), layer(-1, 9)], ..none() }, "second [[layer]]"),
        (SewingPlan { darts: vec![dart("a", pleated, 5), dart("b", None, 9)], ..none() }, "declared and denied"),
        (SewingPlan { darts: vec![dart("a", pleated, 5), dart("b", pleated, 9)], ..none() }, "have one mouth"),
        (
            SewingPlan { darts: vec![dart("a", pleated, 5), elsewhere(dart("a", pleated, 9))], ..none() },
            "two darts called `a`",
        ),
    ];
    for (plan, words) in plans {
        let found = wrong(plan);
        assert_eq!((found.len(), found[0].0.as_str(), found[0].1), (1, "tables-contradict", Some(9)), "{found:?}");
        assert!(found[0].2.contains(words) && found[0].2.contains("line 5"), "{found:?}");
    }
    // What is said of a copy overrules what it has from its piece.
    let copy = CopySpec { piece: "front".into(), name: "other".into(), mirror: false, source: None };
    let denied = DartSpec { piece: "other".into(), ..dart("b", None, 9) };
    let plan = SewingPlan { copies: vec![copy], darts: vec![dart("a", pleated, 5), denied], ..none() };
    apply(&mut one(rectangle(0, "front", 300.0, 400.0)), plan, &mut Report::default()).expect("plan");
}

#[test]
fn a_fold_on_the_line_of_another_is_refused_with_both_places() {
    let fold = |name: &str, from: f64, to: f64, y: f64, line| FoldSpec {
        piece: "front".into(),
        name: name.into(),
        line: vec![v(from, y), v(to, y)],
        angle: 1.5,
        source: in_line(line),
    };
    let folds = |folds: Vec<FoldSpec>| SewingPlan { folds, ..SewingPlan::default() };
    for second in [fold("down", 0.0, 300.0, 40.0, 9), fold("down", 300.0, 200.0, 40.5, 9)] {
        let found = wrong(folds(vec![fold("up", 0.0, 300.0, 40.0, 5), second]));
        assert_eq!((found.len(), found[0].0.as_str(), found[0].1), (1, "tables-contradict", Some(9)), "{found:?}");
        assert!(found[0].2.contains("fold `up` (line 5)"), "{found:?}");
    }
    // On the fold of a pleat.
    let crease = FoldSpec { line: vec![v(160.0, 400.0), v(160.0, 0.0)], ..fold("crease", 0.0, 0.0, 0.0, 9) };
    let knife = DartSpec { source: in_line(5), ..pleat(Some(PleatPress::Knife), None) };
    let found = wrong(SewingPlan { darts: vec![knife], ..folds(vec![crease]) });
    assert!(found[0].2.contains("fold `pleat-2` (line 5)"), "{found:?}");
    // Beside each other and across each other they are two folds.
    let across = FoldSpec { line: vec![v(100.0, 0.0), v(100.0, 400.0)], ..fold("across", 0.0, 0.0, 0.0, 9) };
    let beside = fold("beside", 0.0, 300.0, 44.0, 9);
    let plan = folds(vec![fold("up", 0.0, 300.0, 40.0, 5), across, beside]);
    apply(&mut one(rectangle(0, "front", 300.0, 400.0)), plan, &mut Report::default()).expect("plan");
}

#[test]
fn a_pleat_beyond_its_lines_or_its_cloth_is_refused() {
    let darts = |dart: DartSpec| SewingPlan { darts: vec![dart], ..SewingPlan::default() };
    let sewn = DartSpec { source: in_line(7), ..pleat(None, Some(8.0)) };
    let found = wrong(darts(sewn));
    assert_eq!((found.len(), found[0].0.as_str(), found[0].1), (1, "pleat-sewn-beyond", Some(7)));
    assert!(found[0].2.contains("8000.0 mm") && found[0].2.contains("200.0 mm"), "{found:?}");
    let off = DartSpec { apexes: vec![v(120.0, -190.0), v(200.0, -190.0)], source: in_line(7), ..pleat(None, None) };
    let found = wrong(darts(off));
    assert_eq!((found.len(), found[0].0.as_str(), found[0].1), (1, "dart-off-cloth", Some(7)));
    assert!(found[0].2.contains("190.0 mm outside"), "{found:?}");
    // Lines that end on the lower edge.
    let hem = DartSpec { apexes: vec![v(120.0, 0.0), v(200.0, -0.5)], ..pleat(None, Some(0.4)) };
    apply(&mut one(rectangle(0, "front", 300.0, 400.0)), darts(hem), &mut Report::default()).expect("plan");
}

#[test]
fn wrong_names_in_layers_edges_and_leave_out_are_told_where_they_stand() {
    let none = SewingPlan::default;
    let layer = LayerSpec { pieces: vec!["frnot".into()], order: 1, source: in_line(9) };
    let edge_name = |piece: &str, number: &str| EdgeNameSpec {
        run: edge(piece, number).remove(0),
        name: "x".into(),
        source: in_line(9),
    };
    let plans = [
        SewingPlan { layers: vec![layer], ..none() },
        SewingPlan { edge_names: vec![edge_name("frnt", "0")], ..none() },
        SewingPlan { edge_names: vec![edge_name("front", "9")], ..none() },
        SewingPlan { leave_out: vec!["linnig".into()], leave_out_source: in_line(9), ..none() },
    ];
    for plan in plans {
        let found = wrong(plan);
        assert!(!found.is_empty() && found.iter().all(|f| f.1 == Some(9)), "{found:?}");
    }
}
