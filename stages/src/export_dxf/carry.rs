//! How marks ride on moved lines and triangles.

use toile_garment::Vec2;
use toile_garment::mesh::PieceMesh;

/// A segment before and after, as a similarity of the plane.
#[derive(Clone, Copy, Debug)]
pub struct Ride {
    from: [Vec2; 2],
    to: [Vec2; 2],
}

impl Ride {
    /// `None` when the segment has no length.
    pub fn new(from: [Vec2; 2], to: [Vec2; 2]) -> Option<Self> {
        ((from[1] - from[0]).norm_squared() > 1e-18).then_some(Self { from, to })
    }

    /// The image of a point under the similarity that takes the segment to its image.
    pub fn apply(&self, p: Vec2) -> Vec2 {
        let (a, b, d) = (self.from[1] - self.from[0], self.to[1] - self.to[0], p - self.from[0]);
        let n = a.norm_squared();
        // d / a and then times b, as complex numbers.
        let q = Vec2::new((d.x * a.x + d.y * a.y) / n, (d.y * a.x - d.x * a.y) / n);
        self.to[0] + Vec2::new(q.x * b.x - q.y * b.y, q.x * b.y + q.y * b.x)
    }

    /// Squared distance of a point from the segment before.
    pub fn distance2(&self, p: Vec2) -> f64 {
        let d = self.from[1] - self.from[0];
        let t = ((p - self.from[0]).dot(&d) / d.norm_squared()).clamp(0.0, 1.0);
        (self.from[0] + d * t - p).norm_squared()
    }
}

/// Carries a point by the nearest of these segments.
pub fn by_nearest(rides: &[Ride], p: Vec2) -> Option<Vec2> {
    let nearest = rides.iter().min_by(|a, b| a.distance2(p).total_cmp(&b.distance2(p)))?;
    Some(nearest.apply(p))
}

/// The segments of a chain of mesh vertices.
pub fn chain_rides(mesh: &PieceMesh, flat: &[Vec2], vertices: &[u32], closed: bool) -> Vec<Ride> {
    let at = |v: u32| Some((*mesh.rest.get(v as usize)?, *flat.get(v as usize)?));
    let n = vertices.len();
    let count = if closed { n } else { n.saturating_sub(1) };
    let ends = vertices.iter().zip(vertices.iter().cycle().skip(1)).take(count);
    ends.filter_map(|(a, b)| {
        let ((a, c), (b, d)) = (at(*a)?, at(*b)?);
        Ride::new([a, b], [c, d])
    })
    .collect()
}

/// Carries a point of the cloth by the triangle that holds it; a point beside the cloth by the nearest triangle.
pub fn by_triangle(mesh: &PieceMesh, flat: &[Vec2], p: Vec2) -> Option<Vec2> {
    let mut best: Option<(f64, Vec2)> = None;
    for t in &mesh.triangles {
        let corners = t.map(|v| Some((*mesh.rest.get(v as usize)?, *flat.get(v as usize)?)));
        let [Some(a), Some(b), Some(c)] = corners else { continue };
        let cross = |u: Vec2, v: Vec2| u.x * v.y - u.y * v.x;
        let (e, f, d) = (b.0 - a.0, c.0 - a.0, p - a.0);
        let area = cross(e, f);
        if area.abs() < 1e-18 {
            continue;
        }
        let (s, t) = (cross(d, f) / area, cross(e, d) / area);
        // How far outside, in barycentric terms scaled to metres.
        let outside = (-s).max(-t).max(s + t - 1.0).max(0.0) * libm::sqrt(area.abs());
        if best.is_none_or(|(d, _)| outside < d) {
            best = Some((outside, a.1 + (b.1 - a.1) * s + (c.1 - a.1) * t));
        }
        if outside == 0.0 {
            break;
        }
    }
    best.map(|(_, at)| at)
}
