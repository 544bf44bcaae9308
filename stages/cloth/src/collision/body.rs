//! The body, and the tree of parry3d over it.
//!
//! This is the only place where `f64` and the `f32` of parry3d meet. The tree finds candidates with boxes grown by
//! the rounding. All distances that decide are computed in `f64` from the original positions.

use crate::collision::body_motion::BodyMotion;
use crate::collision::broad_phase::aabb::Aabb;
use crate::collision::culling::convex_features::ConvexFeatures;
use crate::collision::culling::coplanar_faces::{coplanar_edges, coplanar_neighbours};
use crate::collision::narrow_phase::distance::{point_triangle, point_triangle_gap};
use crate::collision::tuning::NEAREST_PLACE_RADIUS;
use crate::scene::contact_filter::MetParts;
use crate::scene::topology::Topology;
use crate::{BodyMesh, Scene, Vec3};
use parry3d::bounding_volume::Aabb as RoundedAabb;
use parry3d::math::Vector as RoundedVector;
use parry3d::partitioning::{Bvh, BvhBuildStrategy};
use std::sync::Arc;

/// Bound of the rounding of a coordinate to `f32`, over the largest coordinate: twice the spacing of `f32` at 1.
const ROUNDING_TO_F32: f64 = 2.4e-7;

/// A body that cloth can touch.
#[derive(Clone)]
pub(crate) struct Body {
    tree: Arc<Bvh>,
    pub positions: Arc<Vec<Vec3>>,
    pub topology: Arc<Topology>,
    /// Corners and edges that cloth can press on.
    pub features: ConvexFeatures,
    /// For each side of each face, the coplanar face beyond it. Empty where no faces are coplanar.
    pub coplanar: Arc<Vec<[u32; 3]>>,
    pub bounds: Aabb,
    /// Boxes of the triangles at the positions given first.
    pub boxes: Arc<Vec<Aabb>>,
    /// The parts that the cloth meets.
    pub met: MetParts,
    /// The motion of the body; `None` for a body at rest.
    pub motion: Option<BodyMotion>,
    /// Bound of the rounding of coordinates to `f32`, m.
    rounding: f64,
    /// First radius of the search for the nearest place, m.
    first_radius: f64,
}

fn rounded(v: &Vec3) -> RoundedVector {
    // Every query box is grown by the rounding to `f32`.
    #[allow(clippy::cast_possible_truncation)]
    RoundedVector::new(v.x as f32, v.y as f32, v.z as f32)
}

impl Body {
    /// The body of a scene at rest, prepared once for all scenes that share it. `None` for a body without triangles.
    pub fn of_scene(scene: &Scene) -> Option<Self> {
        let mesh = scene.body.as_ref()?;
        let mut body = mesh.prepared(Self::new)?;
        let kept = mesh.triangles.iter().enumerate().filter(|(_, t)| has_area(&mesh.positions, t)).map(|(g, _)| g);
        body.met = MetParts::new(&scene.contact_filter, scene.triangles.iter().map(|t| t.vertices), kept);
        if scene.contact_filter.ignores_any() {
            let Self { features, topology, met, .. } = &mut body;
            features.open_borders(topology, |g| met.parts_of(g));
        }
        Some(body)
    }

    /// Prepares a body. `None` for a body without triangles.
    pub fn new(mesh: &BodyMesh) -> Option<Self> {
        let live: Vec<[u32; 3]> = mesh.triangles.iter().filter(|t| has_area(&mesh.positions, t)).copied().collect();
        if live.is_empty() {
            return None;
        }
        let bounds = Aabb::of(&live.iter().flatten().map(|v| mesh.positions[*v as usize]).collect::<Vec<_>>());
        let topology = Topology::new(mesh.positions.len(), live);
        let boxes: Vec<Aabb> =
            topology.faces.iter().map(|t| Aabb::of_three(&crate::pick3(&mesh.positions, t))).collect();
        let leaf = |b: &Aabb| RoundedAabb::new(rounded(&b.low), rounded(&b.high));
        let tree = Bvh::from_iter(BvhBuildStrategy::Binned, boxes.iter().map(leaf).enumerate());
        let size = bounds.low.amax().max(bounds.high.amax());
        let flat_edges = coplanar_edges(&mesh.positions, &topology);
        let features = ConvexFeatures::new(&mesh.positions, &topology, &flat_edges);
        let coplanar = coplanar_neighbours(&topology, &flat_edges);
        Some(Self {
            tree: Arc::new(tree),
            positions: Arc::new(mesh.positions.clone()),
            topology: Arc::new(topology),
            features,
            coplanar: Arc::new(coplanar),
            bounds,
            boxes: Arc::new(boxes),
            met: MetParts::default(),
            motion: None,
            rounding: size * ROUNDING_TO_F32,
            first_radius: NEAREST_PLACE_RADIUS.get() * (bounds.high - bounds.low).norm(),
        })
    }

    /// The body for coarser cloth with this mean edge and gap, m, with fewer of the corners that lie close together.
    pub fn decimated(mut self, cloth: [f64; 2]) -> Self {
        self.features.decimate(&self.positions, &self.topology, cloth);
        self
    }

    /// Triangles whose boxes may meet `bounds`.
    pub fn candidates(&self, bounds: &Aabb, mut emit: impl FnMut(u32)) {
        let b = bounds.grown(self.rounding);
        let query = RoundedAabb::new(rounded(&b.low), rounded(&b.high));
        for i in self.tree.intersect_aabb(&query) {
            emit(i);
        }
    }

    pub fn triangle(&self, i: u32) -> [Vec3; 3] {
        crate::pick3(&self.positions, &self.topology.faces[i as usize])
    }

    /// Distance of a place from a triangle, m.
    #[inline]
    pub fn point_gap(&self, p: &Vec3, i: u32) -> f64 {
        point_triangle_gap(p, self.triangle(i).each_ref())
    }

    /// The nearest point of the body within `reach` of `p`, m, and its distance, m, without the parts `ignored`.
    pub fn nearest(&self, p: &Vec3, reach: f64, ignored: u32) -> Option<(Vec3, f64)> {
        let mut best: Option<(Vec3, f64)> = None;
        let mut r = self.first_radius.min(reach);
        loop {
            self.candidates(&Aabb::of_one(p).grown(r), |i| {
                if !self.met.is_met(i, ignored) {
                    return;
                }
                let [a, b, c] = self.triangle(i);
                let w = point_triangle(p, &a, &b, &c);
                let q = a * w[0] + b * w[1] + c * w[2];
                let d = (p - q).norm();
                if best.is_none_or(|(_, e)| d < e) {
                    best = Some((q, d));
                }
            });
            match best {
                Some((_, d)) if d <= r => return best,
                _ if r >= reach => return best.filter(|(_, d)| *d <= reach),
                _ => r = (2.0 * r).min(reach),
            }
        }
    }

    /// Is `p` in the box around the body?
    pub fn may_contain(&self, p: &Vec3) -> bool {
        self.bounds.meets(&Aabb::of_one(p))
    }

    /// Is `p` inside the body without the parts `ignored`? The winding number decides, so that small holes do not matter.
    pub fn contains(&self, p: &Vec3, ignored: u32) -> bool {
        if !self.may_contain(p) {
            return false;
        }
        let mut turns = HalfTurnCount::default();
        for (_, t) in (0u32..).zip(&self.topology.faces).filter(|(g, _)| self.met.is_met(*g, ignored)) {
            turns.add(&t.map(|v| self.positions[v as usize] - p));
        }
        turns.passages != 0
    }
}

fn has_area(x: &[Vec3], t: &[u32; 3]) -> bool {
    let [a, b, c] = t.map(|v| x[v as usize]);
    (b - a).cross(&(c - a)).norm_squared() > 0.0
}

/// Sum of half the signed solid angles of triangles seen from the origin, as a turning unit vector.
///
/// The origin is inside where the sum passes the half turn: then more than half of all directions hit the surface. No
/// angle has to be computed.
struct HalfTurnCount {
    direction: [f64; 2],
    /// Number of passages of the half turn, one direction counted positive and the other negative.
    passages: i64,
}

impl Default for HalfTurnCount {
    fn default() -> Self {
        Self { direction: [1.0, 0.0], passages: 0 }
    }
}

impl HalfTurnCount {
    /// Adds half the signed solid angle of a triangle, which is less than half a turn (Van Oosterom and Strackee
    /// 1983).
    #[inline]
    fn add(&mut self, [a, b, c]: &[Vec3; 3]) {
        let (la, lb, lc) = (a.norm(), b.norm(), c.norm());
        let (num, den) = (a.dot(&b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
        let length = (num * num + den * den).sqrt();
        if length <= 0.0 {
            return;
        }
        let (cos, sin, [x, y]) = (den / length, num / length, self.direction);
        let new = [x * cos - y * sin, x * sin + y * cos];
        let up = |y: f64| y >= 0.0;
        self.passages += i64::from(up(sin) && up(y) && !up(new[1])) - i64::from(!up(sin) && !up(y) && up(new[1]));
        self.direction = new;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An octahedron without its first faces.
    fn octahedron(without: usize) -> Body {
        let positions = [1.0, -1.0].into_iter().flat_map(|s| [0, 1, 2].map(|k| Vec3::ith(k, s))).collect();
        let of = |x: u32, y: u32, z: u32| {
            if (x + y + z).is_multiple_of(2) { [3 * x, 1 + 3 * y, 2 + 3 * z] } else { [1 + 3 * y, 3 * x, 2 + 3 * z] }
        };
        let all = (0..8).map(|k| of(k & 1, k >> 1 & 1, k >> 2));
        Body::new(&BodyMesh { positions, triangles: all.skip(without).collect() }).expect("a body")
    }

    /// The nearest place is found at any distance, but only within reach.
    #[test]
    fn the_nearest_place_is_nearer_than_all_others() {
        let body = octahedron(0);
        for far in [1e-4, 0.003, 0.04, 0.5, 7.0] {
            let p = Vec3::new(0.5, 0.3, 0.2) + Vec3::repeat(far / 3.0_f64.sqrt());
            let (q, d) = body.nearest(&p, 10.0, 0).expect("a place");
            assert!((d - far).abs() < 1e-12 && (q - Vec3::new(0.5, 0.3, 0.2)).norm() < 1e-12, "{far}: {q:?} {d}");
            assert_eq!(body.nearest(&p, 0.99 * far, 0), None);
        }
    }

    #[test]
    fn more_than_half_of_what_is_all_around_is_inside() {
        let (middle, aside) = (Vec3::new(0.01, -0.02, 0.03), Vec3::new(0.3, 0.3, -0.35));
        for (without, inside) in [(0, true), (2, true), (3, true), (5, false), (6, false)] {
            assert_eq!(octahedron(without).contains(&middle, 0), inside, "{without} faces open");
        }
        let whole = octahedron(0);
        assert!(
            whole.contains(&aside, 0)
                && !whole.contains(&(aside * 1.2), 0)
                && !whole.contains(&Vec3::new(0.9, 0.9, 0.9), 0)
        );
    }
}
