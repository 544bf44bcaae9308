//! Hand-built pieces and a way to run stages on them, for the tests of this package.

use std::sync::atomic::AtomicBool;
use toile_garment::body::{Body, BodySegment};
use toile_garment::dart::{Dart, DartEvidence, DartKind};
use toile_garment::fabric::{Fabric, StretchLaw};
use toile_garment::notch::{Notch, NotchKind};
use toile_garment::outline::{LinePoint, OutlineEdge, PieceLine, PointKind};
use toile_garment::seam::{Seam, SeamKind, SeamSide, Stitch};
use toile_garment::sewing::{RunSpec, RunWay, SeamSpec};
use toile_garment::{Garment, Piece, PieceId, Report, SeamId, Vec2};
use toile_stage_api::{Stage, StageContext, StageError};

/// Runs a stage.
pub fn run<S: Stage>(stage: &S, params: &S::Params, garment: Garment) -> Result<(Garment, Report), StageError> {
    let (garment, report) = lend(|cx| stage.run(params, garment, cx));
    Ok((garment?, report))
}

/// Lends what the engine lends to a stage; gives the findings too.
pub fn lend<T>(work: impl FnOnce(&mut StageContext<'_>) -> T) -> (T, Report) {
    let mut report = Report::default();
    let cancel = AtomicBool::new(false);
    let done = work(&mut StageContext {
        report: &mut report,
        progress: &mut (),
        files: &mut (),
        cancel: &cancel,
        seed: 0,
        threads: 1,
    });
    (done, report)
}

/// A point in millimetres.
pub fn v(x: f64, y: f64) -> Vec2 {
    Vec2::new(x * 1e-3, y * 1e-3)
}

/// A piece through points in mm; `c` marks curve points. Edges lie between the others.
pub fn piece(id: usize, name: &str, points: &[(f64, f64, char)]) -> Piece {
    let kind = |c: char| if c == 'c' { PointKind::Curve } else { PointKind::Turn };
    let line: Vec<LinePoint> = points.iter().map(|(x, y, c)| LinePoint { at: v(*x, *y), kind: kind(*c) }).collect();
    let corners: Vec<u32> = (0..line.len()).filter(|i| line[*i].kind == PointKind::Turn).map(|i| i as u32).collect();
    let edges = (0..corners.len())
        .map(|k| OutlineEdge { index: k as u32, name: None, from: corners[k], to: corners[(k + 1) % corners.len()] })
        .collect();
    let outline = PieceLine { points: line, closed: true, ..PieceLine::default() };
    Piece { id: PieceId::from(id), name: name.into(), outline, edges, ..Piece::default() }
}

/// A slit notch on the boundary, at a place in mm.
pub fn notch(x: f64, y: f64) -> Notch {
    Notch {
        kind: NotchKind::Slit,
        at: v(x, y),
        depth: 4e-3,
        width: 0.0,
        angle: None,
        on: "boundary".into(),
        name: None,
        source: None,
    }
}

/// A rectangle with its corner at the origin, mm.
pub fn rectangle(id: usize, name: &str, w: f64, h: f64) -> Piece {
    piece(id, name, &[(0.0, 0.0, 't'), (w, 0.0, 't'), (w, h, 't'), (0.0, h, 't')])
}

/// A dart with straight legs, mm.
pub fn dart(name: &str, kind: DartKind, apexes: &[(f64, f64)], mouth: [(f64, f64); 2]) -> Dart {
    let mouth = mouth.map(|(x, y)| v(x, y));
    let apexes: Vec<Vec2> = apexes.iter().map(|(x, y)| v(*x, *y)).collect();
    let legs = match kind {
        DartKind::FishEye => mouth.map(|m| vec![apexes[0], m, apexes[1]]),
        _ => mouth.map(|m| vec![m, apexes[0]]),
    };
    Dart {
        name: name.into(),
        kind,
        evidence: DartEvidence::Declared,
        apexes,
        mouth,
        legs,
        line: "cut".into(),
        depth: None,
        mesh: None,
        source: None,
    }
}

/// An open line, mm.
pub fn line(points: &[(f64, f64)]) -> PieceLine {
    let points = points.iter().map(|(x, y)| LinePoint { at: v(*x, *y), kind: PointKind::Plain }).collect();
    PieceLine { points, ..PieceLine::default() }
}

/// A garment of one piece.
pub fn one(piece: Piece) -> Garment {
    Garment { pieces: vec![piece], ..Garment::default() }
}

/// A run by two points, mm.
pub fn two_points(piece: &str, from: (f64, f64), to: (f64, f64)) -> RunSpec {
    RunSpec::Points { piece: piece.into(), from: v(from.0, from.1), to: v(to.0, to.1), way: RunWay::Short }
}

/// A seam without more.
pub fn seam(name: &str, a: Vec<RunSpec>, b: Vec<RunSpec>) -> SeamSpec {
    SeamSpec { name: name.into(), a, b, reverse: None, ease: None, gather: None, proposed: None, source: None }
}

/// A sewn seam that is only its stitches.
pub fn sewn(name: &str, stitches: Vec<Stitch>) -> Seam {
    let (a, b) = (SeamSide::default(), SeamSide::default());
    let (id, kind) = (SeamId::default(), SeamKind::Seam);
    Seam { id, name: name.into(), kind, a, b, ease: 0.0, gather: None, stitches, source: None }
}

/// A fabric of the same stretch both ways without friction in bending; SI units.
pub fn cloth(areal_mass: f64, stretch: f64, shear: f64, bending: [f64; 2]) -> Fabric {
    Fabric {
        name: "test".to_owned(),
        areal_mass,
        thickness: 3e-4,
        friction: 0.3,
        springs: None,
        stretch_warp: StretchLaw::Linear { stiffness: stretch },
        stretch_weft: StretchLaw::Linear { stiffness: stretch },
        poisson: 0.0,
        shear,
        bend_warp: bending[0],
        bend_weft: bending[1],
        shear_curve: None,
        bend_bias: None,
        bend_curve_warp: None,
        bend_curve_weft: None,
        bend_hysteresis: None,
        rest_curvature_warp: None,
        rest_curvature_weft: None,
        bend_holds_friction: false,
        strain_limit_warp: 0.5,
        strain_limit_weft: 0.5,
        strain_limit_bias: None,
        look: None,
        sources: std::collections::BTreeMap::new(),
    }
}

/// A body without a mesh: round segments by name, start, end and radius, m.
pub fn body_of(segments: &[(&str, [f64; 3], [f64; 3], f64)]) -> Body {
    let segment = |(name, from, to, r): &(&str, [f64; 3], [f64; 3], f64)| {
        let segment = BodySegment { from: (*from).into(), to: (*to).into(), half_width: *r, half_depth: *r };
        ((*name).to_owned(), segment)
    };
    Body { segments: segments.iter().map(segment).collect(), ..Body::default() }
}
