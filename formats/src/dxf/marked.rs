//! Darts drawn inside: legs on layer 8 with their ends on the boundary, lenses, and notches with a drill hole.

use super::chain::Path;
use super::darts::{DrawnDart, Form, wedge_test};
use super::geom::{self, PointIndex};
use super::limits;
use super::outline::Outline;
use toile_garment::Vec2;

/// Ends of marked legs lie on the outline within this, mm.
const ON_OUTLINE: f64 = 1.0;
/// Two legs share their apex within this, mm.
const SAME_APEX: f64 = 0.2;
/// Least angle of a marked dart, degrees: it is drawn on purpose, so narrow ones count.
const LEAST_ANGLE: f64 = 2.0;
/// The path of a leg over its chord, at most.
const CURVED: f64 = 1.15;

/// Marked darts among internal lines. Legs that run over an allowance to the cut line are cut off at the sew line.
#[must_use]
pub fn marked(internal: &[Path], outline: &Outline, cut: Option<&[Vec2]>) -> Vec<DrawnDart> {
    let line = outline.positions();
    let work = outline.work_positions();
    let on = |p: Vec2| geom::distance(p, &work, true).min(geom::distance(p, &line, true)) <= ON_OUTLINE;
    let mut found = Vec::new();
    let mut single: Vec<(Vec<Vec2>, &Path)> = Vec::new();
    let most = 2000.min(limits::DART_TESTS / (line.len() + work.len()).max(1));
    for path in internal.iter().take(most) {
        let points = match cut {
            Some(cut) if !path.closed => trimmed(&path.positions(), &line, cut),
            _ => opened(path, &on),
        };
        if points.len() < 2 {
            continue;
        }
        let ends = [on(points[0]), on(points[points.len() - 1])];
        match ends {
            [true, true] if points.len() >= 3 => found.extend(bent(&points, path, &work)),
            [true, false] => single.push((points, path)),
            [false, true] => single.push((points.into_iter().rev().collect(), path)),
            _ => {}
        }
    }
    let apex = |p: &[Vec2]| p[p.len() - 1];
    let index = PointIndex::new(SAME_APEX, single.iter().enumerate().map(|(i, (p, _))| (apex(p), i)));
    for (i, (points, path)) in single.iter().enumerate() {
        let partner = index.near(apex(points), SAME_APEX).into_iter().map(|(_, j)| j).find(|j| *j > i);
        if let Some(j) = partner {
            let ids = path.ids.iter().chain(&single[j].1.ids).copied().collect();
            found.extend(dart([points.clone(), single[j].0.clone()], path.line, ids, &work));
        }
    }
    found
}

/// A line whose ends lie beyond the sew line, cut off where it crosses.
fn trimmed(points: &[Vec2], sewn: &[Vec2], cut: &[Vec2]) -> Vec<Vec2> {
    let mut line = points.to_vec();
    for _ in 0..2 {
        line.reverse();
        let Some(end) = line.last().copied() else { return line };
        if geom::inside(end, sewn) || geom::distance(end, sewn, true) <= ON_OUTLINE {
            continue;
        }
        // Past the cut line too: some writers draw legs a little longer.
        let near = geom::inside(end, cut) || geom::distance(end, cut, true) <= 25.0;
        let inner = line.iter().rposition(|p| geom::inside(*p, sewn));
        if let Some(i) = inner.filter(|_| near) {
            let crossing = (0..sewn.len())
                .filter_map(|k| geom::meet(line[i], line[i + 1], sewn[k], sewn[(k + 1) % sewn.len()]))
                .min_by(|a, b| (a - line[i]).norm().total_cmp(&(b - line[i]).norm()));
            if let Some(p) = crossing {
                line.truncate(i + 1);
                line.push(p);
            }
        }
    }
    line
}

/// A closed triangle whose side lies along the outline is the same as its two legs.
fn opened(path: &Path, on: &dyn Fn(Vec2) -> bool) -> Vec<Vec2> {
    let mut points = path.positions();
    let n = points.len();
    if path.closed && n >= 3 {
        let along = (0..n).find(|i| on(points[*i]) && on(points[(i + 1) % n]));
        match along {
            Some(i) => points.rotate_left((i + 1) % n),
            None => return Vec::new(),
        }
    }
    points
}

/// One line: leg, apex, leg. The apex is its sharpest vertex.
fn bent(points: &[Vec2], path: &Path, outline: &[Vec2]) -> Option<DrawnDart> {
    let turn = |i: usize| geom::turn(points[i - 1], points[i], points[i + 1]).abs();
    let apex = (1..points.len() - 1).max_by(|a, b| turn(*a).total_cmp(&turn(*b)))?;
    let mut second = points[apex..].to_vec();
    second.reverse();
    dart([points[..=apex].to_vec(), second], path.line, path.ids.clone(), outline)
}

fn dart(mut legs: [Vec<Vec2>; 2], line: u64, ids: Vec<u32>, outline: &[Vec2]) -> Option<DrawnDart> {
    let apex = *legs[0].last()?;
    let (a, b) = (legs[0][0], legs[1][0]);
    wedge_test(apex, a, b, LEAST_ANGLE).ok()?;
    let straight = legs.iter().all(|l| geom::length(l, false) <= CURVED * (l[0] - l[l.len() - 1]).norm());
    if !straight || !geom::inside(apex, outline) || geom::distance(apex, outline, true) < 5.0 {
        return None;
    }
    // The leg met first on the counter-clockwise outline: seen from the apex the mouth runs clockwise.
    if geom::cross(a - apex, b - apex) < 0.0 {
        legs.reverse();
    }
    // Both legs end in one and the same point.
    if let Some(last) = legs[1].last_mut() {
        *last = apex;
    }
    if let Some(last) = legs[0].last_mut() {
        *last = apex;
    }
    let mouth = [legs[0][0], legs[1][0]];
    Some(DrawnDart {
        form: Form::Marked,
        apexes: vec![apex],
        mouth,
        work: legs.clone(),
        open_lens: false,
        legs,
        on: "internal",
        line,
        ids,
        confidence: 0.0,
        evidence: Vec::new(),
    })
}

/// Length of a lens, mm.
const LENS_LENGTH: std::ops::RangeInclusive<f64> = 40.0..=600.0;
/// Width of a lens, mm.
const LENS_WIDTH: std::ops::RangeInclusive<f64> = 3.0..=100.0;
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
    let n = points.len();
    let (i, j) = farthest(&points)?;
    let axis = points[j] - points[i];
    let length = axis.norm();
    let tip = |k: usize| 180.0 - geom::turn(points[(k + n - 1) % n], points[k], points[(k + 1) % n]).to_degrees().abs();
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

/// Three drill holes along the grain: both tips and one at the widest place, on the axis or beside it. Tip, middle, tip.
#[must_use]
pub fn threes(drills: &[Vec2], darts: &[DrawnDart], grain: Option<Vec2>) -> Vec<[Vec2; 3]> {
    let near = |p: &Vec2| darts.iter().any(|d| d.apexes.iter().chain(&d.mouth).any(|q| (p - q).norm() < 30.0));
    let free: Vec<Vec2> = drills.iter().copied().filter(|p| !near(p)).take(60).collect();
    // Only exactly three: among more holes there is no telling, and a row of buttons has more.
    let [a, b, c] = free.as_slice() else { return Vec::new() };
    let orders = [[*a, *b, *c], [*b, *a, *c], [*a, *c, *b]];
    let fits = |[s, m, t]: &[Vec2; 3]| {
        let axis = t - s;
        let length = axis.norm();
        let along = (m - s).dot(&axis) / (length * length).max(1e-9);
        let beside = (geom::cross(axis, m - s) / length.max(1e-9)).abs();
        let up = grain.is_none_or(|g| libm::atan2(geom::cross(axis, g).abs(), axis.dot(&g).abs()).to_degrees() <= 25.0);
        (80.0..=*LENS_LENGTH.end()).contains(&length) && (0.25..=0.75).contains(&along) && beside <= length / 8.0 && up
    };
    orders.into_iter().find(fits).into_iter().collect()
}

/// Four drill holes in the shape of a slim kite: its two tips first.
#[must_use]
pub fn kites(drills: &[Vec2], darts: &[DrawnDart]) -> Vec<[Vec2; 4]> {
    let near = |p: &Vec2| darts.iter().any(|d| d.apexes.iter().chain(&d.mouth).any(|q| (p - q).norm() < 30.0));
    let free: Vec<Vec2> = drills.iter().copied().filter(|p| !near(p)).take(60).collect();
    // Only exactly four: among more holes there is no telling.
    let [a, b, c, d] = free.as_slice() else { return Vec::new() };
    let orders =
        [[*a, *b, *c, *d], [*a, *c, *b, *d], [*a, *d, *b, *c], [*c, *d, *a, *b], [*b, *d, *a, *c], [*b, *c, *a, *d]];
    orders
        .into_iter()
        .find(|[s, t, p, q]| {
            let (axis, across) = (t - s, q - p);
            let (length, width) = (axis.norm(), across.norm());
            let along = |r: &Vec2| (r - s).dot(&axis) / (length * length);
            LENS_LENGTH.contains(&length)
                && LENS_WIDTH.contains(&width)
                && length >= 2.5 * width
                && axis.dot(&across).abs() <= 0.05 * length * width
                && (geom::cross(axis, (p + q) * 0.5 - s) / length).abs() <= 0.1 * width
                && [p, q].iter().all(|r| (0.2..=0.8).contains(&along(r)))
        })
        .into_iter()
        .collect()
}

/// Two notches at a mouth and a drill hole near the apex: only a candidate, a person must say. The hole lies on the
/// axis of the mouth, and no other hole claims the same mouth.
#[must_use]
pub fn candidates(notches: &[Vec2], drills: &[Vec2], darts: &[DrawnDart]) -> Vec<(Vec2, [Vec2; 2])> {
    let mut found: Vec<(Vec2, [Vec2; 2])> = Vec::new();
    for drill in drills.iter().take(200) {
        let taken = darts.iter().any(|d| {
            let polygon: Vec<Vec2> = d.legs[0].iter().chain(d.legs[1].iter().rev()).copied().collect();
            d.apexes.iter().any(|a| (a - drill).norm() < 30.0) || geom::inside(*drill, &polygon)
        });
        if taken {
            continue;
        }
        let near: Vec<Vec2> =
            notches.iter().copied().filter(|p| (25.0..=400.0).contains(&(p - drill).norm())).take(200).collect();
        let pair =
            near.iter().enumerate().flat_map(|(i, a)| near[i + 1..].iter().map(move |b| (*a, *b))).find(|(a, b)| {
                let (u, v) = ((a - drill).norm(), (b - drill).norm());
                (u - v).abs() <= 0.02 * u.max(v) && wedge_test(*drill, *a, *b, 5.0).is_ok()
            });
        found.extend(pair.map(|(a, b)| (*drill, [a, b])));
    }
    let all = found.clone();
    found.retain(|(drill, mouth)| !all.iter().any(|(d, m)| d != drill && m.iter().any(|p| mouth.contains(p))));
    found
}

#[cfg(test)]
mod tests {
    use super::super::outline::Marks;
    use super::*;

    fn path(points: &[(f64, f64)], closed: bool) -> Path {
        let points = points.iter().map(|(x, y)| (Vec2::new(*x, *y), true)).collect();
        Path { ids: vec![7], line: 9, points, closed }
    }

    fn sheet() -> Outline {
        let mut o = Outline::new(path(&[(0.0, 0.0), (300.0, 0.0), (300.0, 600.0), (0.0, 600.0)], true));
        o.classify(&Marks::new(&[], &[], &Default::default()));
        o
    }

    #[test]
    fn bent_line_two_lines_and_triangle_are_one_dart() {
        let forms = [
            vec![path(&[(135.0, 600.0), (150.0, 500.0), (165.0, 600.0)], false)],
            vec![path(&[(150.0, 500.0), (135.0, 600.0)], false), path(&[(165.0, 600.0), (150.0, 500.1)], false)],
            vec![path(&[(165.0, 600.0), (135.0, 600.0), (150.0, 500.0)], true)],
        ];
        for form in forms {
            let darts = marked(&form, &sheet(), None);
            assert_eq!(darts.len(), 1, "{form:?}");
            assert!((darts[0].apexes[0] - Vec2::new(150.0, 500.0)).norm() <= 0.1 + 1e-9);
            assert_eq!(darts[0].mouth[0], Vec2::new(165.0, 600.0), "counter-clockwise first");
        }
    }

    #[test]
    fn lines_that_end_inside_are_no_darts() {
        assert!(marked(&[path(&[(135.0, 580.0), (150.0, 500.0), (165.0, 580.0)], false)], &sheet(), None).is_empty());
    }

    #[test]
    fn lens_but_not_a_welt_pocket() {
        let o = sheet().positions();
        let eye = path(&[(150.0, 450.0), (162.0, 300.0), (150.0, 150.0), (138.0, 300.0)], true);
        let darts = lenses(&[eye], &o);
        assert_eq!(darts.len(), 1);
        assert!((darts[0].width() - 24.0).abs() < 1e-9);
        assert_eq!(darts[0].apexes.len(), 2);
        let welt = path(&[(100.0, 300.0), (240.0, 300.0), (240.0, 312.0), (100.0, 312.0)], true);
        assert!(lenses(&[welt], &o).is_empty());
    }

    #[test]
    fn three_holes_along_the_grain() {
        let v = Vec2::new;
        let up = Some(v(0.0, 1.0));
        let eye = [v(150.0, 450.0), v(162.0, 300.0), v(150.0, 150.0)];
        assert_eq!(threes(&eye, &[], up), vec![eye]);
        assert_eq!(threes(&[eye[1], eye[0], eye[2]], &[], up).len(), 1, "in any order");
        assert_eq!(threes(&[eye[0], v(150.0, 290.0), eye[2]], &[], up).len(), 1, "on the axis");
        // Across the grain, a wide triangle, four holes: none.
        assert!(threes(&eye, &[], Some(v(1.0, 0.0))).is_empty());
        assert!(threes(&[eye[0], v(250.0, 300.0), eye[2]], &[], up).is_empty());
        assert!(threes(&[eye[0], eye[1], eye[2], v(10.0, 10.0)], &[], up).is_empty());
    }

    #[test]
    fn notches_and_drill_are_a_candidate() {
        let c = candidates(&[Vec2::new(135.0, 600.0), Vec2::new(165.0, 600.0)], &[Vec2::new(150.0, 510.0)], &[]);
        assert_eq!(c.len(), 1);
    }
}
