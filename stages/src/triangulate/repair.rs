//! Small angles that smoothing cannot cure: a vertex too few or too many near short edges and in narrow strips.

use super::crossing::Segment;
use super::lattice::distance;
use super::layout::Layout;
use super::regular::{FillError, Filled, cloth, smoothed};
use super::smooth::least_angle;
use toile_garment::Vec2;

/// Triangles above this are left alone.
const GOOD_ENOUGH: f64 = 36.0 / 180.0 * std::f64::consts::PI;
const ROUNDS: usize = 8;
/// Meshes of more triangles get fewer rounds.
const LARGE: usize = 50_000;
/// In meshes of fewer triangles the worst one is also tried alone.
const SINGLE_TRIES: usize = 10_000;

/// Adds and takes away inner vertices at bad triangles while that helps.
///
/// # Errors
/// As filling.
pub fn repair(layout: &Layout, edges: &[[u32; 2]], sharp: &[u32], mut mesh: Filled) -> Result<Filled, FillError> {
    let fixed = layout.points.len();
    let rounds = if mesh.1.len() < LARGE { ROUNDS } else { ROUNDS / 4 };
    for _ in 0..rounds {
        let bad = bad(&mesh, sharp);
        let Some(before) = bad.first().map(|b| b.0) else { break };
        let mut tries = vec![with_more(&mesh, &bad, layout), with_fewer(&mesh, &bad, fixed)];
        if mesh.1.len() < SINGLE_TRIES {
            tries.push(with_more(&mesh, &bad[..1], layout));
            tries.extend(with_each(&mesh, bad[0].1, layout).into_iter().map(Some));
            tries.extend(without_each(&mesh, bad[0].1, fixed).into_iter().map(Some));
        }
        let mut best: Option<(f64, usize, Filled)> = None;
        for (points, centroids) in tries.into_iter().flatten().flat_map(|p| [(p.clone(), 2), (p, 0)]) {
            let triangles = cloth(&points, edges, layout)?;
            let next = smoothed(layout, edges, (points, triangles), centroids, 4)?;
            let left = self::bad(&next, sharp);
            let worst = left.first().map_or(GOOD_ENOUGH, |b| b.0);
            let better = best.as_ref().is_none_or(|(w, n, _)| worst > w + 1e-3 || worst > w - 1e-3 && left.len() < *n);
            let helps = worst > before + 1e-3 || worst > before - 1e-3 && left.len() < bad.len();
            if helps && better {
                best = Some((worst, left.len(), next));
            }
        }
        match best {
            Some((_, _, next)) => mesh = next,
            None => break,
        }
    }
    Ok(mesh)
}

/// Bad triangles away from drawn angles, worst first: least angle and triangle.
fn bad(mesh: &Filled, sharp: &[u32]) -> Vec<(f64, [u32; 3])> {
    let (points, triangles) = mesh;
    let mut out: Vec<(f64, [u32; 3])> = triangles
        .iter()
        .filter(|t| !t.iter().any(|v| sharp.binary_search(v).is_ok()))
        .map(|t| {
            let [a, b, c] = t.map(|v| points[v as usize]);
            (least_angle(a, b, c), *t)
        })
        .filter(|(angle, _)| *angle < GOOD_ENOUGH)
        .collect();
    out.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
    out
}

/// The circumcentres of bad triangles, where there is room.
fn with_more(mesh: &Filled, bad: &[(f64, [u32; 3])], layout: &Layout) -> Option<Vec<Vec2>> {
    let mut points = mesh.0.clone();
    let before = points.len();
    let lines = layout.segments(|_| true);
    for (_, t) in bad.iter().take(200) {
        let [a, b, c] = t.map(|v| mesh.0[v as usize]);
        if let Some(p) = circumcentre(a, b, c)
            && has_room(mesh, &points, &lines, *t, p)
        {
            points.push(p);
        }
    }
    (points.len() > before).then_some(points)
}

/// Is there room for a point that mends a triangle?
fn has_room(mesh: &Filled, points: &[Vec2], lines: &[Segment], t: [u32; 3], p: Vec2) -> bool {
    let [a, b, c] = t.map(|v| mesh.0[v as usize]);
    let shortest = (b - a).norm().min((c - b).norm()).min((a - c).norm());
    let far = points.iter().all(|q| (q - p).norm() > 0.55 * shortest);
    let clear = lines.iter().all(|s| distance(s.a, s.b, p) > 0.25 * (s.b - s.a).norm().min(shortest * 2.0));
    far && clear && holds(mesh, p)
}

/// With one more vertex at the middle of an edge of a triangle, or beyond it, each in turn.
fn with_each(mesh: &Filled, t: [u32; 3], layout: &Layout) -> Vec<Vec<Vec2>> {
    let lines = layout.segments(|_| true);
    let [a, b, c] = t.map(|v| mesh.0[v as usize]);
    let room = |p: &Vec2| has_room(mesh, &mesh.0, &lines, t, *p);
    let more = |p: Vec2| mesh.0.iter().copied().chain([p]).collect();
    let through = |v: Vec2, p: Vec2, q: Vec2| [1.0, 1.7].map(|f| v + ((p + q) * 0.5 - v) * f);
    [through(c, a, b), through(a, b, c), through(b, c, a)].into_iter().flatten().filter(room).map(more).collect()
}

/// Is the point in the cloth? On an edge counts.
fn holds(mesh: &Filled, p: Vec2) -> bool {
    use super::smooth::cross;
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

/// Without the inner vertex of every bad triangle that lies nearest to its shortest edge's end.
fn with_fewer(mesh: &Filled, bad: &[(f64, [u32; 3])], fixed: usize) -> Option<Vec<Vec2>> {
    let mut gone: Vec<u32> = Vec::new();
    for (_, t) in bad.iter().take(200) {
        if t.iter().any(|v| gone.contains(v)) {
            continue;
        }
        let edges = [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
        let length = |e: &[u32; 2]| (mesh.0[e[0] as usize] - mesh.0[e[1] as usize]).norm();
        let shortest = edges.iter().min_by(|x, y| length(x).total_cmp(&length(y)))?;
        gone.extend(shortest.iter().chain(t).copied().find(|v| *v as usize >= fixed));
    }
    let points: Vec<Vec2> =
        mesh.0.iter().enumerate().filter(|(i, _)| !gone.contains(&(*i as u32))).map(|(_, p)| *p).collect();
    (points.len() < mesh.0.len()).then_some(points)
}

/// Without one of the inner vertices of a triangle, each in turn.
fn without_each(mesh: &Filled, t: [u32; 3], fixed: usize) -> Vec<Vec<Vec2>> {
    let without = |gone: usize| mesh.0.iter().enumerate().filter(|(i, _)| *i != gone).map(|(_, p)| *p).collect();
    t.into_iter().map(|v| v as usize).filter(|v| *v >= fixed).map(without).collect()
}
