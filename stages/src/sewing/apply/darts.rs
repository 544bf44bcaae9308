//! Declared darts: added, overruled, denied.

use super::folds;
use crate::codes::OUTLINE_TOO_SMALL;
use crate::roles::outline::Polygon;
use crate::sewing::codes;
use crate::sewing::lookup;
use crate::sewing::ring::Ring;
use crate::sewing::shapes::mm;
use toile_formats::dxf::darts::UndecidedDart;
use toile_garment::dart::{Dart, DartEvidence, DartKind, pleat_ends};
use toile_garment::outline::{LinePoint, PieceLine, PointKind};
use toile_garment::sewing::DartSpec;
use toile_garment::{Diagnostic, Garment, Piece, Report, Vec2};

/// A declared point is the found one within this distance.
const SAME_POINT: f64 = 2e-3;
/// An apex this far outside the outline is still taken to lie on it.
const OFF_CLOTH: f64 = 3e-3;
/// A line that ends this near to a dart's point gives its leg.
const ON_LINE: f64 = 1e-3;

/// Applies the `[[dart]]` tables of these pieces. A table that denies what the reader left undecided has nothing to do.
pub fn declare(
    garment: &mut Garment,
    wanted: impl Fn(&str) -> bool,
    undecided: &[UndecidedDart],
    report: &mut Report,
    errors: &mut Vec<Diagnostic>,
) {
    let specs: Vec<DartSpec> = garment.plan.darts.iter().filter(|d| wanted(&d.piece)).cloned().collect();
    for spec in &specs {
        if spec.kind.is_none() && undecided.iter().any(|u| is_declared(&u.spec, spec)) {
            continue;
        }
        match lookup::piece(garment, &spec.piece, spec.source.as_ref()) {
            Ok(id) => {
                let piece = &mut garment.pieces[id.index()];
                let wrong = off_cloth(piece, spec).or_else(|| sewn_beyond(piece, spec));
                match wrong {
                    Some(found) => errors.push(found.at(spec.source.clone())),
                    None => declare_one(piece, spec, report, errors),
                }
            }
            Err(e) => errors.push(e),
        }
    }
}

/// Does a table of the sewing file speak of this wedge?
pub fn is_declared(wedge: &DartSpec, spec: &DartSpec) -> bool {
    wedge.piece.eq_ignore_ascii_case(&spec.piece) && is_same((&wedge.mouth, &wedge.apexes), spec)
}

/// Applies one table.
pub fn declare_one(piece: &mut Piece, spec: &DartSpec, report: &mut Report, errors: &mut Vec<Diagnostic>) {
    let known = piece.darts.iter().position(|d| is_same((&d.mouth, &d.apexes), spec));
    let Some(kind) = spec.kind else {
        match known {
            Some(k) => deny(piece, k),
            None => report.push(
                Diagnostic::warning(
                    codes::DART_TO_DENY_NOT_FOUND,
                    format!("piece `{}` has no dart with its mouth at {}", piece.name, mm(spec.mouth[0])),
                )
                .at(spec.source.clone()),
            ),
        }
        return;
    };
    let old = known.map(|k| piece.darts.remove(k));
    let built = match kind {
        DartKind::FishEye => Ok(fish_eye(piece, spec, old.as_ref())),
        DartKind::Pleat => {
            let dart = pleat(spec);
            dart.legs.chunks(1).for_each(|leg| consume(piece, leg));
            Ok(dart)
        }
        DartKind::Wedge | DartKind::MarkedWedge => wedge(piece, spec, old.as_ref()),
    };
    match built {
        Ok(mut dart) => {
            dart.name = free_name(piece, spec, old.as_ref());
            if kind == DartKind::Pleat
                && let [Some(a), Some(b)] = pleat_ends(&spec.mouth, &spec.apexes)
            {
                folds::press(piece, spec, &dart.name, [a, b]);
            }
            piece.darts.push(dart);
        }
        Err(e) => errors.push(e.at(spec.source.clone())),
    }
}

/// An apex that lies outside the cloth. Legs may end on the outline.
fn off_cloth(piece: &Piece, spec: &DartSpec) -> Option<Diagnostic> {
    let outline = Polygon::of(piece);
    let ring = Ring::from_line(&piece.outline.positions());
    // An outline that is none is told where it is needed.
    let off = |p: &&Vec2| ring.points.len() > 2 && !outline.contains(**p) && ring.project(**p).1 > OFF_CLOTH;
    let apex = spec.kind.and_then(|_| spec.apexes.iter().find(off))?;
    let away = ring.project(*apex).1 * 1e3;
    let message = format!("piece `{}`: the apex {} lies {away:.1} mm outside the cloth", piece.name, mm(*apex));
    // A dart that is drawn the wrong way round points out of the cloth.
    let along = (spec.mouth[1] - spec.mouth[0]).try_normalize(1e-9).unwrap_or_default();
    let from = apex - spec.mouth[0];
    let inside = spec.mouth[0] + along * (2.0 * from.dot(&along)) - from;
    let hint = if outline.contains(inside) {
        format!("the dart points out of the cloth; turned inwards, its apex is at {}", mm(inside))
    } else {
        "give it in the coordinates of the piece, which `toile inspect --svg` draws".to_owned()
    };
    Some(Diagnostic::error(codes::DART_OFF_CLOTH, message).hint(hint))
}

/// A pleat that is to be sewn down beyond its lines.
fn sewn_beyond(piece: &Piece, spec: &DartSpec) -> Option<Diagnostic> {
    let lines = spec.mouth.iter().zip(pleat_ends(&spec.mouth, &spec.apexes));
    let shortest = lines.filter_map(|(from, to)| Some((to? - from).norm())).reduce(f64::min)?;
    let sewn = spec.sewn.filter(|sewn| *sewn > shortest + ON_LINE)?;
    let (sewn, shortest) = (sewn * 1e3, shortest * 1e3);
    let message = format!(
        "piece `{}`: a pleat is sewn down for {sewn:.1} mm, and its lines are {shortest:.1} mm long",
        piece.name
    );
    let hint =
        format!("write sewn = \"{shortest:.1} mm\" or less, or leave it out: the lines are sewn to their ends then");
    Some(Diagnostic::error(codes::PLEAT_SEWN_BEYOND, message).hint(hint))
}

fn is_same((drawn, apexes): (&[Vec2; 2], &[Vec2]), spec: &DartSpec) -> bool {
    let apex = !spec.apexes.is_empty() && spec.apexes.iter().all(|a| apexes.iter().any(|d| is_near(a, d)));
    is_one_mouth(drawn, &spec.mouth) || apex
}

/// Do two mouths have the same points, in either order?
pub fn is_one_mouth([a0, a1]: &[Vec2; 2], [b0, b1]: &[Vec2; 2]) -> bool {
    is_near(a0, b0) && is_near(a1, b1) || is_near(a0, b1) && is_near(a1, b0)
}

fn is_near(a: &Vec2, b: &Vec2) -> bool {
    (a - b).norm() < SAME_POINT
}

/// A denied dart is cloth: what marked it stays as lines.
fn deny(piece: &mut Piece, k: usize) {
    let dart = piece.darts.remove(k);
    if dart.kind == DartKind::Wedge {
        return;
    }
    for leg in dart.legs {
        let points = leg.into_iter().map(|at| LinePoint { at, kind: PointKind::Plain }).collect();
        piece.internal_lines.push(PieceLine { points, closed: false, name: None, source: dart.source.clone() });
    }
}

fn free_name(piece: &Piece, spec: &DartSpec, old: Option<&Dart>) -> String {
    let taken = |name: &str| piece.darts.iter().any(|d| d.name == name);
    let asked = spec.name.clone().or_else(|| old.map(|d| d.name.clone()));
    asked
        .filter(|n| !taken(n))
        .unwrap_or_else(|| (1..).map(|n| format!("dart-{n}")).find(|n| !taken(n)).unwrap_or_default())
}

fn dart(spec: &DartSpec, kind: DartKind, mouth: [Vec2; 2], legs: [Vec<Vec2>; 2], line: &str) -> Dart {
    Dart {
        name: String::new(),
        kind,
        evidence: DartEvidence::Declared,
        apexes: spec.apexes.clone(),
        mouth,
        legs,
        line: line.to_owned(),
        depth: None,
        mesh: None,
        source: spec.source.clone(),
    }
}

/// A wedge: in the outline where its apex is a point of it, else cut out of the cloth.
fn wedge(piece: &mut Piece, spec: &DartSpec, old: Option<&Dart>) -> Result<Dart, Diagnostic> {
    let apex = *spec
        .apexes
        .first()
        .ok_or_else(|| Diagnostic::error(codes::DART_WITHOUT_APEX, "a wedge dart needs an apex"))?;
    let ring = Ring::from_line(&piece.outline.positions());
    if ring.points.len() < 3 {
        return Err(Diagnostic::error(OUTLINE_TOO_SMALL, format!("piece `{}` has no outline", piece.name)));
    }
    let (s, distance) = ring.project(apex);
    if distance <= ON_LINE {
        let [m0, m1] = spec.mouth.map(|m| ring.project(m).0);
        let swap = ring.ahead(m0, s) > ring.ahead(m0, m1);
        let mouth = if swap { [spec.mouth[1], spec.mouth[0]] } else { spec.mouth };
        let [from, to] = mouth.map(|m| ring.project(m).0);
        let down = stretch(&ring, from, s);
        let mut up = stretch(&ring, s, to);
        up.reverse();
        return Ok(dart(spec, DartKind::Wedge, mouth, [down, up], "cut"));
    }
    let [m0, m1] = spec.mouth.map(|m| ring.project(m).0);
    let swap = ring.ahead(m0, m1) > ring.ahead(m1, m0);
    let mouth = if swap { [spec.mouth[1], spec.mouth[0]] } else { spec.mouth };
    let legs = mouth.map(|m| leg(piece, old, m, apex));
    consume(piece, &legs);
    Ok(dart(spec, DartKind::MarkedWedge, mouth, legs, "internal"))
}

/// Points of a ring from one position forward to another.
fn stretch(ring: &Ring, from: f64, to: f64) -> Vec<Vec2> {
    let d = ring.ahead(from, to);
    let mut inner: Vec<(f64, Vec2)> = ring
        .points
        .iter()
        .zip(&ring.arc)
        .map(|(p, s)| (ring.ahead(from, *s), *p))
        .filter(|(x, _)| *x > 1e-6 && *x < d - 1e-6)
        .collect();
    inner.sort_by(|a, b| a.0.total_cmp(&b.0));
    std::iter::once(ring.at(from)).chain(inner.into_iter().map(|(_, p)| p)).chain([ring.at(to)]).collect()
}

/// A leg: the found dart's, an internal line that joins both points, else straight.
fn leg(piece: &Piece, old: Option<&Dart>, mouth: Vec2, apex: Vec2) -> Vec<Vec2> {
    let old_legs = old.into_iter().flat_map(|d| d.legs.iter());
    let found = old_legs
        .cloned()
        .chain(piece.internal_lines.iter().map(PieceLine::positions))
        .find_map(|line| between(&line, mouth, apex));
    found.unwrap_or_else(|| vec![mouth, apex])
}

/// The part of a line from one point to another, its ends put on them.
fn between(line: &[Vec2], from: Vec2, to: Vec2) -> Option<Vec<Vec2>> {
    let at = |p: Vec2| line.iter().position(|q| (q - p).norm() < ON_LINE);
    let (i, k) = (at(from)?, at(to)?);
    let mut points = match i.cmp(&k) {
        std::cmp::Ordering::Less => line[i..=k].to_vec(),
        std::cmp::Ordering::Greater => line[k..=i].iter().rev().copied().collect(),
        std::cmp::Ordering::Equal => return None,
    };
    let last = points.len() - 1;
    (points[0], points[last]) = (from, to);
    Some(points)
}

/// Internal lines that became legs are lines no more.
fn consume(piece: &mut Piece, legs: &[Vec<Vec2>]) {
    let on_leg = |p: &LinePoint| legs.iter().flatten().any(|q| (q - p.at).norm() < ON_LINE);
    piece.internal_lines.retain(|line| line.points.is_empty() || !line.points.iter().all(on_leg));
}

fn fish_eye(piece: &mut Piece, spec: &DartSpec, old: Option<&Dart>) -> Dart {
    let ends = [spec.apexes[0], spec.apexes[1]];
    let legs = spec.mouth.map(|mouth| {
        let same = |d: &&Dart| d.kind == DartKind::FishEye;
        let candidates = old.filter(same).into_iter().flat_map(|d| d.legs.iter().cloned());
        let near = |leg: &Vec<Vec2>| leg.iter().any(|p| (p - mouth).norm() < SAME_POINT);
        let found = candidates.filter(near).find_map(|leg| between(&leg, ends[0], ends[1]));
        found.or_else(|| lens_half(piece, ends, mouth)).unwrap_or_else(|| vec![ends[0], mouth, ends[1]])
    });
    consume(piece, &legs);
    dart(spec, DartKind::FishEye, spec.mouth, legs, "internal")
}

/// Half of a closed internal line between its two tips, the half that passes the widest point.
fn lens_half(piece: &Piece, ends: [Vec2; 2], mouth: Vec2) -> Option<Vec<Vec2>> {
    piece.internal_lines.iter().filter(|l| l.closed).find_map(|line| {
        let points = line.positions();
        let n = points.len();
        let at = |p: Vec2| points.iter().position(|q| (q - p).norm() < ON_LINE);
        let (i, k) = (at(ends[0])?, at(ends[1])?);
        let forward: Vec<Vec2> = (0..=(k + n - i) % n).map(|x| points[(i + x) % n]).collect();
        let backward: Vec<Vec2> = (0..=(i + n - k) % n).map(|x| points[(i + n - x) % n]).collect();
        [forward, backward].into_iter().find(|half| half.iter().any(|p| (p - mouth).norm() < SAME_POINT))
    })
}

/// A pleat: its lines run from the mouth to their ends or as far as they are sewn, or it is held at the mouth only.
pub fn pleat(spec: &DartSpec) -> Dart {
    let ends = pleat_ends(&spec.mouth, &spec.apexes);
    let sewn = |from: Vec2, to: Vec2| match spec.sewn {
        Some(sewn) if sewn < ON_LINE => None,
        Some(sewn) => Some(from + (to - from) * (sewn / (to - from).norm()).min(1.0)),
        None => Some(to),
    };
    let leg = |i: usize| {
        let from = spec.mouth[i];
        std::iter::once(from).chain(ends[i].and_then(|to| sewn(from, to))).collect::<Vec<_>>()
    };
    let mut out = dart(spec, DartKind::Pleat, spec.mouth, [leg(0), leg(1)], "internal");
    out.depth = Some(0.5 * (spec.mouth[1] - spec.mouth[0]).norm());
    out
}
