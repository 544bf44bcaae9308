//! Fish-eye darts: closed lenses inside a piece.

use super::dart::{DrawnDart, Form};
use super::thresholds::{
    ANGLE_OF_LENS_TIP, COSINE_OF_POCKET, COUNT_OF_LENSES, COUNT_OF_STROKES, DIFFERENCE_OF_LENS_SIDES,
    DISTANCE_OF_LENS_DRILL, GAP_OF_STROKES, LENGTH_OF_LENS, PLACE_OF_LENS_WIDTH, SAMPLES_OF_LENS, SHARE_OF_FLAT_SIDE,
    SLIMNESS_OF_LENS, VERTICES_OF_LENS, WIDTH_OF_BLUNT_APEX, WIDTH_OF_LENS,
};
use crate::dxf::chain::{self, Path};
use crate::dxf::geom;
use crate::dxf::limits;
use toile_garment::Vec2;

/// Fish-eye darts: closed lenses on layer 8 or 11, sharp at both ends, as long on one side as on the other.
#[must_use]
pub fn lenses(paths: &[Path], outline: &[Vec2]) -> Vec<DrawnDart> {
    let most = COUNT_OF_LENSES.min(limits::DART_TESTS / outline.len().max(1));
    paths
        .iter()
        .take(most)
        .filter(|p| p.closed && p.points.len() >= 4 && p.points.len() <= VERTICES_OF_LENS)
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
    if !LENGTH_OF_LENS.contains(&length) || tip(i) > ANGLE_OF_LENS_TIP || tip(j) > ANGLE_OF_LENS_TIP {
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
    let middle = |p: Vec2| PLACE_OF_LENS_WIDTH.contains(&((p - points[i]).dot(&axis) / (length * length)));
    let sides = [geom::length(&right, false), geom::length(&left, false)];
    let alike = (sides[0] - sides[1]).abs() <= DIFFERENCE_OF_LENS_SIDES * sides[0].max(sides[1]);
    let shaped = WIDTH_OF_LENS.contains(&width)
        && length >= SLIMNESS_OF_LENS * width
        && alike
        && mouth.iter().all(|m| middle(*m));
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
        let twins = [i, j].into_iter().filter(|k| n > 4 && tip_angle(points, *k) > ANGLE_OF_LENS_TIP);
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
    (points[a] - points[b]).norm() <= WIDTH_OF_BLUNT_APEX && 180.0 - turn <= ANGLE_OF_LENS_TIP
}

fn farthest(points: &[Vec2]) -> Option<(usize, usize)> {
    let stride = points.len() / SAMPLES_OF_LENS + 1;
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
    if lens.apexes.iter().any(|a| drills.iter().any(|d| (a - d).norm() <= DISTANCE_OF_LENS_DRILL)) {
        return None;
    }
    let axis = lens.apexes[1] - lens.apexes[0];
    let offset = |p: Vec2| (geom::cross(axis, p - lens.apexes[0]) / axis.norm()).abs();
    let (a, b) = (offset(lens.mouth[0]), offset(lens.mouth[1]));
    if a.min(b) < SHARE_OF_FLAT_SIDE * (a + b) {
        return Some("one of its sides is nearly straight: a pocket opening");
    }
    let across = grain.is_some_and(|g| axis.dot(&g).abs() < COSINE_OF_POCKET * axis.norm() * g.norm());
    across.then_some("it lies across the grain and has no drill hole: a pocket opening")
}

/// Closed lines made of several open ones inside the piece: a lens of two or four strokes.
pub(super) fn closed_inside(paths: &[Path], found: &[DrawnDart], line: &[Vec2]) -> Vec<Path> {
    let free = |p: &&Path| {
        !p.closed
            && p.points.len() <= VERTICES_OF_LENS
            && !found.iter().any(|d| d.ids.iter().any(|id| p.ids.contains(id)))
            && [p.points[0].0, p.points[p.points.len() - 1].0].iter().all(|e| geom::inside(*e, line))
    };
    let most = COUNT_OF_LENSES.min(limits::DART_TESTS / line.len().max(1));
    let open: Vec<Path> = paths.iter().take(most).filter(free).take(COUNT_OF_STROKES).cloned().collect();
    if open.len() < 2 { Vec::new() } else { chain::chain(open, GAP_OF_STROKES).closed }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(points: &[(f64, f64)]) -> Path {
        let points = points.iter().map(|(x, y)| (Vec2::new(*x, *y), true)).collect();
        Path { ids: vec![7], line: 9, points, closed: true }
    }

    #[test]
    fn lens_but_not_a_welt_pocket() {
        let o = [(0.0, 0.0), (300.0, 0.0), (300.0, 600.0), (0.0, 600.0)].map(|(x, y)| Vec2::new(x, y));
        let eye = path(&[(150.0, 450.0), (162.0, 300.0), (150.0, 150.0), (138.0, 300.0)]);
        let darts = lenses(&[eye], &o);
        assert_eq!(darts.len(), 1);
        assert!((darts[0].width() - 24.0).abs() < 1e-9);
        assert_eq!(darts[0].apexes.len(), 2);
        let welt = path(&[(100.0, 300.0), (240.0, 300.0), (240.0, 312.0), (100.0, 312.0)]);
        assert!(lenses(&[welt], &o).is_empty());
    }
}
