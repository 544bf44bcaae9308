//! Rest places of the corners of the cloth, and barycentric weights in them.
//!
//! A corner lies in the plane of its piece. Cloth whose rest shape is curved, as an imported mesh, has no plane. Its
//! corners lie where they are in space at the start, once their strain is taken out.

use crate::hierarchy::tuning::{
    ANCHOR_OUTSIDE_MAX, CURVED_EDGE_SHARE, REST_CORNER_TOLERANCE, REST_SHAPE_ROUNDS, REST_SHAPE_STRAIN_LEFT,
    REST_SHAPE_STRAIN_MAX,
};
use crate::{Element, Scene, Vec3};

/// Rest places of the corners of every triangle, m; `true` beside them for those of a curved rest shape.
pub(crate) fn corners(scene: &Scene) -> (Vec<[Vec3; 3]>, bool) {
    if curved(scene)
        && let Some(x) = unstrained(scene)
    {
        return (scene.triangles.iter().map(|t| crate::pick3(&x, &t.vertices)).collect(), true);
    }
    (scene.triangles.iter().map(|t| t.rest.map(flat)).collect(), false)
}

/// Places near the start at which every edge has its rest length, m; `None` where there are none.
///
/// Edges are corrected one by one, and both ends move alike.
fn unstrained(scene: &Scene) -> Option<Vec<Vec3>> {
    let side = |t: &Element, k: usize| (t.vertices[k] as usize, t.vertices[(k + 1) % 3] as usize, t.rest_length(k));
    let sides: Vec<_> = scene.triangles.iter().flat_map(|t| [0, 1, 2].map(|k| side(t, k))).collect();
    let mut x = scene.positions.clone();
    let left = REST_SHAPE_STRAIN_LEFT.get();
    for _ in 0..REST_SHAPE_ROUNDS.get() {
        let mut worst: f64 = 0.0;
        for &(a, b, rest) in &sides {
            let edge = x[b] - x[a];
            if (edge.norm_squared() - rest * rest).abs() <= 2.0 * left * rest * rest {
                continue;
            }
            let length = edge.norm();
            if length == 0.0 {
                return None;
            }
            worst = worst.max((length - rest).abs() / rest);
            let half = edge * (0.5 * (length - rest) / length);
            x[a] += half;
            x[b] -= half;
        }
        if worst <= REST_SHAPE_STRAIN_MAX.get() {
            return Some(x);
        }
    }
    None
}

/// A place in the plane of a piece, in space.
fn flat(p: [f64; 2]) -> Vec3 {
    Vec3::new(p[0], p[1], 0.0)
}

/// Returns `true` if most neighbouring triangles have no common plane.
fn curved(scene: &Scene) -> bool {
    let rest = |i: usize| flat(scene.triangles[i / 3].rest[i % 3]);
    let (mut apart, mut all) = (0usize, 0usize);
    for same in triangle_sides(scene).chunk_by(|p, q| (p.0, p.1) == (q.0, q.1)) {
        let [p, q, ..] = same else { continue };
        all += 1;
        apart += usize::from(!(is_same_place(&rest(p.2), &rest(q.2)) && is_same_place(&rest(p.3), &rest(q.3))));
    }
    apart as f64 > CURVED_EDGE_SHARE.get() * all as f64
}

/// Sides of all triangles, those of one edge together.
///
/// A side has the ends of its edge, the smaller one first, and the corners (3 × triangle + k) there.
pub(crate) fn triangle_sides(scene: &Scene) -> Vec<(u32, u32, usize, usize)> {
    let mut sides = Vec::with_capacity(3 * scene.triangles.len());
    for (f, t) in scene.triangles.iter().enumerate() {
        for k in 0..3 {
            let (a, b) = (t.vertices[k], t.vertices[(k + 1) % 3]);
            let (i, j) = (3 * f + k, 3 * f + (k + 1) % 3);
            sides.push(if a < b { (a, b, i, j) } else { (b, a, j, i) });
        }
    }
    sides.sort_unstable();
    sides
}

/// Returns `true` if two rest places are the same.
pub(crate) fn is_same_place(p: &Vec3, q: &Vec3) -> bool {
    (p - q).amax() < REST_CORNER_TOLERANCE.get()
}

/// The rest corners of a triangle of a curved rest shape, in the axes of the cloth.
///
/// `old` is a triangle with rest places `at` whose axes are taken over.
pub(crate) fn in_cloth_axes(new: &[Vec3; 3], at: &[Vec3; 3], old: &Element) -> [[f64; 2]; 3] {
    let normal = (new[1] - new[0]).cross(&(new[2] - new[0])).normalize();
    let weft = weft(at, &old.rest);
    let x = (weft - normal * normal.dot(&weft)).normalize();
    let y = normal.cross(&x) * old.area().signum();
    new.map(|p| [(p - new[0]).dot(&x), (p - new[0]).dot(&y)])
}

/// Direction in space of the first axis of the cloth.
fn weft(at: &[Vec3; 3], rest: &[[f64; 2]; 3]) -> Vec3 {
    let (e, f) = (at[1] - at[0], at[2] - at[0]);
    let sub = |k: usize| [rest[k][0] - rest[0][0], rest[k][1] - rest[0][1]];
    let (a, b) = (sub(1), sub(2));
    let double = a[0] * b[1] - a[1] * b[0];
    (e * b[1] - f * a[1]) / double
}

/// Barycentric weights of a place in a triangle, clamped to a little outside it.
pub(crate) fn weights([a, b, c]: &[Vec3; 3], p: &Vec3) -> [f64; 3] {
    let outside = ANCHOR_OUTSIDE_MAX.get();
    let normal = (b - a).cross(&(c - a));
    let part = |q: &Vec3, r: &Vec3| (q - p).cross(&(r - p)).dot(&normal) / normal.norm_squared();
    let w = [part(b, c), part(c, a)].map(|w| w.clamp(-outside, 1.0 + outside));
    [w[0], w[1], 1.0 - w[0] - w[1]]
}
