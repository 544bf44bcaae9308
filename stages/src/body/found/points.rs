//! Where rays meet a mesh, and how its outline runs from the side.

use crate::body::section::sections;
use toile_garment::Vec3;
use toile_garment::body::Body;

/// The first place where a ray from outside meets the mesh.
pub fn hit(body: &Body, from: Vec3, along: Vec3) -> Option<Vec3> {
    let way = body.triangles.iter().filter_map(|t| {
        let [a, b, c] = t.map(|v| body.positions[v as usize]);
        let (u, v) = (b - a, c - a);
        let across = along.cross(&v);
        let size = u.dot(&across);
        if size == 0.0 {
            return None;
        }
        let s = (from - a).dot(&across) / size;
        let turned = (from - a).cross(&u);
        let r = along.dot(&turned) / size;
        let t = v.dot(&turned) / size;
        (s >= 0.0 && r >= 0.0 && s + r <= 1.0 && t >= 0.0).then_some(t)
    });
    way.min_by(f64::total_cmp).map(|t| from + along * t)
}

/// The top of the body over a place between left and right, metres; `None` where there is nothing.
pub fn top(body: &Body, triangles: &[[u32; 3]], x: f64) -> Option<Vec3> {
    let loops = sections(&body.positions, triangles, Vec3::new(x, 0.0, 0.0), Vec3::x());
    loops.into_iter().flat_map(|s| s.points).max_by(|a, b| a.y.total_cmp(&b.y))
}
