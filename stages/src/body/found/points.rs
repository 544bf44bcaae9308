//! Places on outlines of a body.

use crate::body::section::{Section, sections};
use toile_garment::Vec3;
use toile_garment::body::Body;

/// Where an outline around the body crosses the plane between left and right: behind and before.
pub fn across(outline: &Section, middle: f64) -> Option<[Vec3; 2]> {
    let next = outline.points.iter().cycle().skip(1);
    let crossings = outline.points.iter().zip(next).filter(|(a, b)| (a.x < middle) != (b.x < middle));
    let places: Vec<Vec3> = crossings.map(|(a, b)| a + (b - a) * ((middle - a.x) / (b.x - a.x))).collect();
    let back = places.iter().copied().min_by(|a, b| a.z.total_cmp(&b.z))?;
    let front = places.iter().copied().max_by(|a, b| a.z.total_cmp(&b.z))?;
    Some([back, front])
}

/// The top of the body over a place between left and right, metres; `None` where there is nothing.
pub fn top(body: &Body, triangles: &[[u32; 3]], x: f64) -> Option<Vec3> {
    let loops = sections(&body.positions, triangles, Vec3::new(x, 0.0, 0.0), Vec3::x());
    loops.into_iter().flat_map(|s| s.points).max_by(|a, b| a.y.total_cmp(&b.y))
}
