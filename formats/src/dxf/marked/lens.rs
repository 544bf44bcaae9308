//! Fish-eye darts: closed lenses inside a piece.

use super::super::chain::Path;
use super::super::darts::{BLUNT, DrawnDart, Form};
use super::super::geom;
use super::super::limits;
use toile_garment::Vec2;

/// Length of a lens, mm.
pub(super) const LENS_LENGTH: std::ops::RangeInclusive<f64> = 40.0..=600.0;
/// Width of a lens, mm.
pub(super) const LENS_WIDTH: std::ops::RangeInclusive<f64> = 3.0..=100.0;
/// Widest angle at a tip of a lens, degrees.
const LENS_TIP: f64 = 75.0;

/// Fish-eye darts: closed lenses on layer 8 or 11, sharp at both ends, as long on one side as on the other.
#[must_use]
pub fn lenses(paths: &[Path], outline: &[Vec2]) -> Vec<DrawnDart> {
    let most = 2000.min(limits::DART_TESTS / outline.len().max(1));
    paths
        .iter()
        .take(most)
        .filter(|p| p.closed && p.points.len() >= 4 && p.points.len() <= 2000)
        .filter_map(|p| lens(p, outline))
        .collect()
}

fn lens(path: &Path, outline: &[Vec2]) -> Option<DrawnDart> {
    let mut points = path.positions();
    if geom::area(&points) < 0.0 {
        points.reverse();
    }
    let (i, j) = tips(&mut points)?;
    let n = points.len();
    let axis = points[j] - points[i];
    let length = axis.norm();
    let tip = |k: usize| tip_angle(&points, k);
    if !LENS_LENGTH.contains(&length) || tip(i) > LENS_TIP || tip(j) > LENS_TIP {
        return None;
    }
    let side = |from: usize, to: usize| (0..=(to + n - from) % n).map(|k| points[(from + k) % n]).collect::<Vec<_>>();
    let right = side(i, j);
    let mut left = side(j, i);
    left.reverse();
    let offset = |p: &Vec2| geom::cross(axis, p - points[i]) / length;
    let widest = |side: &[Vec2]| side.iter().copied().max_by(|a, b| offset(a).abs().total_cmp(&offset(b).abs()));
    let mouth = [widest(&right)?, widest(&left)?];
    let width = offset(&mouth[1]) - offset(&mouth[0]);
    let middle = |p: Vec2| (0.15..=0.85).contains(&((p - points[i]).dot(&axis) / (length * length)));
    let sides = [geom::length(&right, false), geom::length(&left, false)];
    let alike = (sides[0] - sides[1]).abs() <= 0.1 * sides[0].max(sides[1]);
    let shaped = LENS_WIDTH.contains(&width) && length >= 2.5 * width && alike && mouth.iter().all(|m| middle(*m));
    if !shaped || !points.iter().all(|p| geom::inside(*p, outline)) {
        return None;
    }
    Some(DrawnDart {
        form: Form::Lens,
        apexes: vec![points[i], points[j]],
        mouth,
        work: [right.clone(), left.clone()],
        open_lens: false,
        legs: [right, left],
        on: "internal",
        line: path.line,
        ids: path.ids.clone(),
        confidence: 0.0,
        evidence: Vec::new(),
    })
}

/// Angle inside at a vertex, degrees.
fn tip_angle(points: &[Vec2], k: usize) -> f64 {
    let n = points.len();
    180.0 - geom::turn(points[(k + n - 1) % n], points[k], points[(k + 1) % n]).to_degrees().abs()
}

/// The two tips of a lens. A tip drawn as two vertices side by side becomes one.
fn tips(points: &mut Vec<Vec2>) -> Option<(usize, usize)> {
    for _ in 0..2 {
        let (i, j) = farthest(points)?;
        let n = points.len();
        let twins = [i, j].into_iter().filter(|k| n > 4 && tip_angle(points, *k) > LENS_TIP);
        let twins = twins.flat_map(|k| [(k, (k + 1) % n), ((k + n - 1) % n, k)]);
        let Some((a, b)) = twins.into_iter().find(|(a, b)| is_blunt_tip(points, *a, *b)) else { return Some((i, j)) };
        points[a] = (points[a] + points[b]) * 0.5;
        points.remove(b);
    }
    farthest(points)
}

/// Are two vertices in a row a sharp tip together?
fn is_blunt_tip(points: &[Vec2], a: usize, b: usize) -> bool {
    let n = points.len();
    let middle = (points[a] + points[b]) * 0.5;
    let turn = geom::turn(points[(a + n - 1) % n], middle, points[(b + 1) % n]).to_degrees().abs();
    (points[a] - points[b]).norm() <= BLUNT && 180.0 - turn <= LENS_TIP
}

fn farthest(points: &[Vec2]) -> Option<(usize, usize)> {
    let stride = points.len() / 400 + 1;
    let mut best: Option<(f64, usize, usize)> = None;
    for i in (0..points.len()).step_by(stride) {
        for j in i + 1..points.len() {
            let d = (points[j] - points[i]).norm();
            if best.is_none_or(|b| d > b.0 + 1e-9) {
                best = Some((d, i, j));
            }
        }
    }
    best.map(|(_, i, j)| (i, j))
}

/// Why a lens is no fish-eye dart: a pocket lies across the grain or has one straight side.
#[must_use]
pub fn lens_doubt(lens: &DrawnDart, grain: Option<Vec2>, drills: &[Vec2]) -> Option<&'static str> {
    if lens.apexes.iter().any(|a| drills.iter().any(|d| (a - d).norm() <= 20.0)) {
        return None;
    }
    let axis = lens.apexes[1] - lens.apexes[0];
    let offset = |p: Vec2| (geom::cross(axis, p - lens.apexes[0]) / axis.norm()).abs();
    let (a, b) = (offset(lens.mouth[0]), offset(lens.mouth[1]));
    if a.min(b) < 0.2 * (a + b) {
        return Some("one of its sides is nearly straight: a pocket opening");
    }
    let across = grain.is_some_and(|g| axis.dot(&g).abs() < 0.5 * axis.norm() * g.norm());
    across.then_some("it lies across the grain and has no drill hole: a pocket opening")
}
