//! Where the corners of the cloth lie at rest: in the plane of their piece, or, for cloth whose rest shape is curved and
//! so has no plane (an imported mesh), where they lie in space at the start.

use crate::{Element, Scene, Vec3};

/// Neighbours whose rest corners differ by more than this do not lie in one plane, m …
pub(super) const SAME: f64 = 1e-7;
/// … and with more than this share of such edges the cloth has no plane.
const CURVED: f64 = 0.5;
/// Largest strain of an edge at the start at which the start is the rest shape.
const AT_REST: f64 = 1e-3;

/// Rest places of the corners of every triangle.
pub(crate) fn corners(scene: &Scene) -> Vec<[Vec3; 3]> {
    let start = |t: &Element| crate::pick3(&scene.positions, &t.vertices);
    let unstrained = |t: &Element| {
        let x = start(t);
        (0..3).all(|k| {
            let l = t.rest_length(k);
            ((x[k] - x[(k + 1) % 3]).norm() - l).abs() <= AT_REST * l
        })
    };
    if curved(scene) && scene.triangles.iter().all(unstrained) {
        return scene.triangles.iter().map(start).collect();
    }
    scene.triangles.iter().map(|t| t.rest.map(|p| Vec3::new(p[0], p[1], 0.0))).collect()
}

/// Do most neighbours lie in planes of their own?
fn curved(scene: &Scene) -> bool {
    let mut sides: Vec<([u32; 2], [[f64; 2]; 2])> = Vec::with_capacity(3 * scene.triangles.len());
    for t in &scene.triangles {
        for k in 0..3 {
            let (i, j) = if t.vertices[k] < t.vertices[(k + 1) % 3] { (k, (k + 1) % 3) } else { ((k + 1) % 3, k) };
            sides.push(([t.vertices[i], t.vertices[j]], [t.rest[i], t.rest[j]]));
        }
    }
    sides.sort_by_key(|s| s.0);
    let (mut apart, mut all) = (0usize, 0usize);
    for s in sides.chunk_by(|p, q| p.0 == q.0).filter(|s| s.len() > 1) {
        let near = |k: usize| (0..2).all(|c| (s[0].1[k][c] - s[1].1[k][c]).abs() < SAME);
        all += 1;
        apart += usize::from(!(near(0) && near(1)));
    }
    apart as f64 > CURVED * all as f64
}

/// A triangle at rest places laid into the axes of the cloth, as the triangle `old` lay in them (its rest places `at`).
pub(crate) fn laid(new: &[Vec3; 3], at: &[Vec3; 3], old: &Element) -> [[f64; 2]; 3] {
    let flat = |t: &[Vec3; 3]| t.iter().all(|p| p.z == 0.0);
    if flat(new) && flat(at) {
        return new.map(|p| [p.x, p.y]);
    }
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

/// Barycentric weights of a place in a triangle, held to a little outside it.
pub(crate) fn weights([a, b, c]: &[Vec3; 3], p: &Vec3) -> [f64; 3] {
    const OUTSIDE: f64 = 0.5;
    let normal = (b - a).cross(&(c - a));
    let part = |q: &Vec3, r: &Vec3| (q - p).cross(&(r - p)).dot(&normal) / normal.norm_squared();
    let w = [part(b, c), part(c, a)].map(|w| w.clamp(-OUTSIDE, 1.0 + OUTSIDE));
    [w[0], w[1], 1.0 - w[0] - w[1]]
}
