//! Small angles that smoothing cannot cure: a vertex too few or too many near short edges and in narrow strips.

use super::cdt::lowest_first;
use super::lattice::distance;
use super::patch::Patch;
use super::regular::{Filled, smoothed};
use super::smooth::{Fans, cross, least_angle};
use toile_garment::Vec2;

/// Triangles above this are left alone. The mesh promises 30°.
const GOOD_ENOUGH: f64 = 34.0 / 180.0 * std::f64::consts::PI;
/// Passes over the mesh, at most.
const ROUNDS: usize = 8;
/// A patch must lose this share of what is wrong with it.
const GAIN_LEAST: f64 = 0.01;
/// Passes of smoothing after a change: towards centroids, each number in turn, and then towards wide angles.
const CENTROID_PASSES: [usize; 2] = [2, 0];
const ANGLE_PASSES: usize = 4;

/// Adds and takes away inner vertices around bad triangles where that helps. The first `fixed` vertices lie on the drawn
/// `edges` (lower vertex first, in order). Triangles at `sharp` vertices, where lines meet at a small angle, are left alone.
pub fn repair(edges: &[[u32; 2]], fixed: usize, sharp: &[u32], mut mesh: Filled) -> Filled {
    // Vertices around which something has changed since they were last looked at.
    let mut open = vec![true; mesh.0.len()];
    for _ in 0..ROUNDS {
        let fans = Fans::new(mesh.0.len(), &mesh.1);
        let mut gone = vec![false; mesh.1.len()];
        let (mut new, mut next_open) = (Vec::new(), vec![false; mesh.0.len()]);
        for (_, bad) in bad_triangles(&mesh, sharp) {
            if !mesh.1[bad as usize].iter().any(|v| open[*v as usize]) {
                continue;
            }
            let patch = Patch::around(&mesh, &fans, edges, fixed, bad);
            let is_free = !patch.taken.iter().any(|t| gone[*t as usize]);
            let mended = if is_free { mend(&patch, sharp, bad) } else { None };
            if let Some(mended) = mended {
                patch.taken.iter().for_each(|t| gone[*t as usize] = true);
                new.extend(put_back(&patch, mended, &mut mesh.0));
                next_open.resize(mesh.0.len(), true);
            } else if is_free {
                continue;
            }
            patch.vertices.iter().for_each(|v| next_open[*v as usize] = true);
        }
        if new.is_empty() {
            break;
        }
        let stay = mesh.1.iter().zip(&gone).filter(|(_, gone)| !**gone).map(|(t, _)| *t);
        mesh.1 = stay.chain(new).collect();
        open = next_open;
    }
    without_unused(fixed, mesh)
}

/// How far a triangle's least angle is below what is good enough, rad; 0 at sharp vertices.
fn lack(points: &[Vec2], t: [u32; 3], is_sharp: impl Fn(u32) -> bool) -> f64 {
    let [a, b, c] = t.map(|v| points[v as usize]);
    if t.into_iter().any(is_sharp) { 0.0 } else { (GOOD_ENOUGH - least_angle(a, b, c)).max(0.0) }
}

/// Bad triangles by their number, worst first, with what they lack.
fn bad_triangles(mesh: &Filled, sharp: &[u32]) -> Vec<(f64, u32)> {
    let is_sharp = |v: u32| sharp.binary_search(&v).is_ok();
    let lacks = mesh.1.iter().map(|t| lack(&mesh.0, *t, is_sharp));
    let mut out: Vec<(f64, u32)> = lacks.zip(0..).filter(|(lack, _)| *lack > 0.0).collect();
    out.sort_by(|x, y| y.0.total_cmp(&x.0).then(x.1.cmp(&y.1)));
    out
}

/// The best of all changes of a patch around a bad triangle, if one is better than none.
fn mend(patch: &Patch, sharp: &[u32], bad: u32) -> Option<Filled> {
    let is_sharp = |v: u32| (v as usize) < patch.fixed && sharp.binary_search(&patch.vertices[v as usize]).is_ok();
    let squared = |x: f64| x * x;
    let wrong = |m: &Filled| m.1.iter().map(|t| squared(lack(&m.0, *t, is_sharp))).sum::<f64>();
    let middle = patch.taken.binary_search(&bad).ok()?;
    let tries = changes(patch, patch.mesh.1[middle]);
    let mut best = (wrong(&patch.mesh) * (1.0 - GAIN_LEAST), None);
    for (points, centroids) in tries.into_iter().flat_map(|p| CENTROID_PASSES.map(|n| (p.clone(), n))) {
        let again = |points: &[Vec2]| patch.triangulate(points);
        let Ok(triangles) = again(&points) else { continue };
        let Ok(next) = smoothed(patch.fixed, (points, triangles), centroids, ANGLE_PASSES, again) else { continue };
        let left = wrong(&next);
        if left < best.0 {
            best = (left, Some(next));
        }
    }
    best.1
}

/// The points of a patch: as they are, with one more at a triangle, and without one of its inner vertices.
fn changes(patch: &Patch, t: [u32; 3]) -> Vec<Vec<Vec2>> {
    let points = &patch.mesh.0;
    let more = places(t.map(|v| points[v as usize])).into_iter().filter(|p| has_room(patch, t, *p));
    let with = |p: Vec2| points.iter().copied().chain([p]).collect();
    let without = |gone: usize| points.iter().enumerate().filter(|(i, _)| *i != gone).map(|(_, p)| *p).collect();
    let fewer = t.into_iter().map(|v| v as usize).filter(|v| *v >= patch.fixed);
    [points.clone()].into_iter().chain(more.map(with)).chain(fewer.map(without)).collect()
}

/// Where one more vertex may mend a triangle: its circumcentre, the middles of its edges, and beyond them.
fn places([a, b, c]: [Vec2; 3]) -> Vec<Vec2> {
    let through = |v: Vec2, p: Vec2, q: Vec2| [1.0, 1.7].map(|f| v + ((p + q) * 0.5 - v) * f);
    let edges = [through(c, a, b), through(a, b, c), through(b, c, a)];
    circumcentre(a, b, c).into_iter().chain(edges.into_iter().flatten()).collect()
}

/// Is there room for a point that mends a triangle?
fn has_room(patch: &Patch, t: [u32; 3], p: Vec2) -> bool {
    let points = &patch.mesh.0;
    let [a, b, c] = t.map(|v| points[v as usize]);
    let shortest = (b - a).norm().min((c - b).norm()).min((a - c).norm());
    let far = points.iter().all(|q| (q - p).norm() > 0.55 * shortest);
    let clear = patch.drawn().all(|s| distance(s.a, s.b, p) > 0.25 * (s.b - s.a).norm().min(shortest * 2.0));
    far && clear && holds(&patch.mesh, p)
}

/// Is the point in the cloth? On an edge counts.
fn holds(mesh: &Filled, p: Vec2) -> bool {
    let in_or_on = |a: Vec2, b: Vec2| cross(a, b, p) > -1e-9 * (b - a).norm_squared();
    mesh.1.iter().any(|t| {
        let [a, b, c] = t.map(|v| mesh.0[v as usize]);
        in_or_on(a, b) && in_or_on(b, c) && in_or_on(c, a)
    })
}

fn circumcentre(a: Vec2, b: Vec2, c: Vec2) -> Option<Vec2> {
    let (u, v) = (b - a, c - a);
    let d = 2.0 * (u.x * v.y - u.y * v.x);
    let p = Vec2::new(
        (v.y * u.norm_squared() - u.y * v.norm_squared()) / d,
        (u.x * v.norm_squared() - v.x * u.norm_squared()) / d,
    );
    (p.x.is_finite() && p.y.is_finite()).then(|| a + p)
}

/// Writes the points of a mended patch into the whole mesh, and gives its triangles there. More points come last; places
/// of fewer points are unused.
fn put_back(patch: &Patch, (points, triangles): Filled, whole: &mut Vec<Vec2>) -> Vec<[u32; 3]> {
    let known = patch.vertices.len();
    let number = |i: usize| patch.vertices.get(i).copied().unwrap_or((whole.len() + i - known) as u32);
    let numbers: Vec<u32> = (0..points.len().max(known)).map(number).collect();
    whole.extend(points.iter().skip(known));
    for (v, p) in numbers.iter().zip(&points) {
        whole[*v as usize] = *p;
    }
    triangles.into_iter().map(|t| t.map(|v| numbers[v as usize])).collect()
}

/// The mesh without inner vertices that no triangle uses, its triangles in order.
fn without_unused(fixed: usize, (points, triangles): Filled) -> Filled {
    let mut is_used: Vec<bool> = (0..points.len()).map(|v| v < fixed).collect();
    triangles.iter().flatten().for_each(|v| is_used[*v as usize] = true);
    let mut next = 0..;
    let numbers: Vec<u32> =
        is_used.iter().map(|used| if *used { next.next().unwrap_or(u32::MAX) } else { u32::MAX }).collect();
    let points = points.into_iter().zip(&is_used).filter(|(_, used)| **used).map(|(p, _)| p).collect();
    let mut triangles: Vec<[u32; 3]> =
        triangles.into_iter().map(|t| lowest_first(t.map(|v| numbers[v as usize]))).collect();
    triangles.sort_unstable();
    (points, triangles)
}
