//! Tests whether two triangles cross, by exact signs and without tolerance.

use crate::Vec3;
use nalgebra::Vector2;

type Triangle = [Vec3; 3];

fn sign3(a: &Vec3, b: &Vec3, c: &Vec3, d: &Vec3) -> i8 {
    // For flat cloth in a plane normal to an axis the exact sum would take long.
    if (0..3).any(|k| a[k] == d[k] && b[k] == d[k] && c[k] == d[k]) {
        return 0;
    }
    let p = |v: &Vec3| robust::Coord3D { x: v.x, y: v.y, z: v.z };
    sign(robust::orient3d(p(a), p(b), p(c), p(d)))
}

fn sign2(a: &Vector2<f64>, b: &Vector2<f64>, c: &Vector2<f64>) -> i8 {
    let p = |v: &Vector2<f64>| robust::Coord { x: v.x, y: v.y };
    sign(robust::orient2d(p(a), p(b), p(c)))
}

fn sign(v: f64) -> i8 {
    i8::from(v > 0.0) - i8::from(v < 0.0)
}

/// How a segment meets a triangle.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Intersection {
    No,
    Touches,
    Crosses,
    InPlane,
}

fn segment_triangle(p: &Vec3, q: &Vec3, t: &Triangle) -> Intersection {
    let (sp, sq) = (sign3(&t[0], &t[1], &t[2], p), sign3(&t[0], &t[1], &t[2], q));
    if sp == 0 && sq == 0 {
        return Intersection::InPlane;
    }
    if sp * sq > 0 {
        return Intersection::No;
    }
    let s = [0, 1, 2].map(|k| sign3(p, q, &t[k], &t[(k + 1) % 3]));
    if !(s.iter().all(|v| *v >= 0) || s.iter().all(|v| *v <= 0)) {
        return Intersection::No;
    }
    if s.iter().all(|v| *v != 0) && sp * sq < 0 { Intersection::Crosses } else { Intersection::Touches }
}

/// Does a segment have a point in common with a triangle, or lie in its plane?
pub(crate) fn segment_meets(p: &Vec3, q: &Vec3, t: &Triangle) -> bool {
    segment_triangle(p, q, t) != Intersection::No
}

/// Do two triangles of one plane share area?
fn overlap_in_plane(a: &Triangle, b: &Triangle) -> bool {
    let n = (a[1] - a[0]).cross(&(a[2] - a[0]));
    let drop = n.iamax();
    let flat = |t: &Triangle| t.map(|v| Vector2::new(v[(drop + 1) % 3], v[(drop + 2) % 3]));
    let (p, q) = (flat(a), flat(b));
    let separated = |x: &[Vector2<f64>; 3], y: &[Vector2<f64>; 3]| {
        let area = sign2(&x[0], &x[1], &x[2]);
        area == 0 || (0..3).any(|e| y.iter().all(|v| sign2(&x[e], &x[(e + 1) % 3], v) * area <= 0))
    };
    !separated(&p, &q) && !separated(&q, &p)
}

/// Signs of the corners of `t` relative to the plane of `plane`.
fn signs(t: &Triangle, plane: &Triangle) -> [i8; 3] {
    t.map(|v| sign3(&plane[0], &plane[1], &plane[2], &v))
}

/// The triangle rotated so that corner 0 is alone on its side, and the sign of that side.
fn lonely_first(t: &Triangle, s: &[i8; 3]) -> (Triangle, i8) {
    let (pos, neg) = (s.iter().filter(|v| **v > 0).count(), s.iter().filter(|v| **v < 0).count());
    let want = if pos <= neg { 1 } else { -1 };
    let k = s.iter().position(|v| *v == want).unwrap_or(0);
    ([t[k], t[(k + 1) % 3], t[(k + 2) % 3]], want)
}

/// Do triangles without a common vertex pass through each other, or overlap in one plane?
pub(crate) fn disjoint_triangles_cross(a: &Triangle, b: &Triangle) -> bool {
    let sa = signs(a, b);
    let one_side = |s: &[i8; 3]| s.iter().all(|v| *v > 0) || s.iter().all(|v| *v < 0);
    if one_side(&sa) {
        return false;
    }
    let sb = signs(b, a);
    if one_side(&sb) {
        return false;
    }
    if sa == [0; 3] && sb == [0; 3] {
        return overlap_in_plane(a, b);
    }
    let both = |s: &[i8; 3]| s.contains(&1) && s.contains(&-1);
    if !both(&sa) || !both(&sb) {
        return false;
    }
    let (mut p, wa) = lonely_first(a, &sa);
    let (mut q, wb) = lonely_first(b, &sb);
    if wa < 0 {
        q.swap(1, 2);
    }
    if wb < 0 {
        p.swap(1, 2);
    }
    sign3(&p[0], &p[1], &q[0], &q[1]) < 0 && sign3(&p[0], &p[2], &q[2], &q[0]) < 0
}

/// Does the far edge of a triangle pass through another triangle that shares corner 0?
pub(crate) fn corner_triangles_cross(a: &Triangle, b: &Triangle) -> bool {
    let x = segment_triangle(&a[1], &a[2], b);
    let y = segment_triangle(&b[1], &b[2], a);
    x == Intersection::Crosses
        || y == Intersection::Crosses
        || (x == Intersection::InPlane && y == Intersection::InPlane && overlap_in_plane(a, b))
}

/// Are two triangles that share the edge 0–1 folded flat onto each other?
pub(crate) fn edge_triangles_fold(a: &Triangle, b: &Triangle) -> bool {
    sign3(&a[0], &a[1], &a[2], &b[2]) == 0 && overlap_in_plane(a, b)
}
