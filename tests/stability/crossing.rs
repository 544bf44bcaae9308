//! Crossings of the exported mesh, counted by other code than the program's: an edge of one triangle goes through the
//! inside of another, by exact signs. What lies flat on each other in one plane is left to the program's count.

use toile_garment::Vec3;

type Triangle = [Vec3; 3];

/// Pairs of triangles of one mesh that cross.
pub fn own(x: &[Vec3], triangles: &[[usize; 3]]) -> usize {
    let list: Vec<Triangle> = triangles.iter().map(|t| t.map(|v| x[v])).collect();
    let order = by_axis(&list, 0);
    let mut count = 0;
    for (k, i) in order.iter().enumerate() {
        let high = bound(&list[*i], 0).1;
        for j in order[k + 1..].iter().take_while(|j| bound(&list[**j], 0).0 <= high) {
            count += usize::from(near_by(&list[*i], &list[*j]) && cross(&list[*i], &list[*j]));
        }
    }
    count
}

/// Pairs of a triangle of the cloth and one of the body that cross.
pub fn with_body(x: &[Vec3], triangles: &[[usize; 3]], body: &[Vec3], faces: &[[usize; 3]]) -> usize {
    let cloth: Vec<Triangle> = triangles.iter().map(|t| t.map(|v| x[v])).collect();
    let solid: Vec<Triangle> = faces.iter().map(|t| t.map(|v| body[v])).collect();
    let widest = |k: usize| solid.iter().map(|b| bound(b, k)).map(|(l, h)| h - l).fold(0.0, f64::max);
    // Along the axis on which no face is long, few are near.
    let (axis, widest) = (0..3).map(|k| (k, widest(k))).min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0));
    let order = by_axis(&solid, axis);
    let mut count = 0;
    for a in &cloth {
        // No face that begins farther back reaches as far as here.
        let (low, high) = bound(a, axis);
        let first = order.partition_point(|j| bound(&solid[*j], axis).0 < low - widest * (1.0 + 1e-9));
        let near = order[first..].iter().map(|j| &solid[*j]).take_while(|b| bound(b, axis).0 <= high);
        count += near.filter(|b| near_by(a, b) && cross(a, b)).count();
    }
    count
}

/// Vertices inside a closed body, by the winding number.
pub fn inside(x: &[Vec3], body: &[Vec3], faces: &[[usize; 3]]) -> usize {
    let low = body.iter().fold(Vec3::repeat(f64::INFINITY), |l, p| l.inf(p));
    let high = body.iter().fold(Vec3::repeat(f64::NEG_INFINITY), |h, p| h.sup(p));
    let within = |p: &&Vec3| (0..3).all(|k| (low[k]..=high[k]).contains(&p[k]));
    x.iter().filter(within).filter(|p| winding(p, body, faces).abs() > 0.5).count()
}

fn winding(p: &Vec3, body: &[Vec3], faces: &[[usize; 3]]) -> f64 {
    let solid = |t: &[usize; 3]| {
        let [a, b, c] = t.map(|v| body[v] - p);
        let (la, lb, lc) = (a.norm(), b.norm(), c.norm());
        2.0 * libm::atan2(a.dot(&b.cross(&c)), la * lb * lc + a.dot(&b) * lc + b.dot(&c) * la + c.dot(&a) * lb)
    };
    faces.iter().map(solid).sum::<f64>() / (4.0 * std::f64::consts::PI)
}

fn by_axis(list: &[Triangle], k: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..list.len()).collect();
    order.sort_by(|i, j| bound(&list[*i], k).0.total_cmp(&bound(&list[*j], k).0));
    order
}

fn bound(t: &Triangle, k: usize) -> (f64, f64) {
    let c = t.map(|p| p[k]);
    (c[0].min(c[1]).min(c[2]), c[0].max(c[1]).max(c[2]))
}

fn near_by(a: &Triangle, b: &Triangle) -> bool {
    (0..3).all(|k| {
        let ((l, h), (m, i)) = (bound(a, k), bound(b, k));
        l <= i && m <= h
    })
}

/// Does an edge of one, away from common corners, go through the other?
fn cross(a: &Triangle, b: &Triangle) -> bool {
    pierces(a, b) || pierces(b, a)
}

fn pierces(a: &Triangle, b: &Triangle) -> bool {
    (0..3).any(|k| {
        let (p, q) = (a[k], a[(k + 1) % 3]);
        !b.contains(&p) && !b.contains(&q) && through(&p, &q, b)
    })
}

fn through(p: &Vec3, q: &Vec3, t: &Triangle) -> bool {
    let [a, b, c] = t;
    let (sp, sq) = (sign(a, b, c, p), sign(a, b, c, q));
    if sp * sq >= 0 {
        return false;
    }
    let s = [sign(p, q, a, b), sign(p, q, b, c), sign(p, q, c, a)];
    s == [1; 3] || s == [-1; 3]
}

fn sign(a: &Vec3, b: &Vec3, c: &Vec3, d: &Vec3) -> i8 {
    let p = |v: &Vec3| robust::Coord3D { x: v.x, y: v.y, z: v.z };
    let s = robust::orient3d(p(a), p(b), p(c), p(d));
    i8::from(s > 0.0) - i8::from(s < 0.0)
}
