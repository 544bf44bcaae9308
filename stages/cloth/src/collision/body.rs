//! The body, and parry3d's tree over it. The only place where f64 and parry's f32 meet: parry finds candidates (boxes grown
//! by the rounding), all distances that decide are computed in f64 from the original positions.

use crate::collision::body_motion::Travel;
use crate::collision::broad_phase::bvh::Aabb;
use crate::collision::broad_phase::distance_grid::Clearance;
use crate::collision::culling::convex_features::Sides;
use crate::collision::narrow_phase::distance::{point_triangle, point_triangle_gap};
use crate::scene::topology::Topology;
use crate::{BodyMesh, Scene, Vec3};
use parry3d::bounding_volume::Aabb as FlatAabb;
use parry3d::math::Vector as Flat;
use parry3d::partitioning::{Bvh, BvhBuildStrategy};
use std::sync::Arc;

/// Part of a body around a place in which the nearest place on it is looked for first; it is doubled until there is one.
const SMALL: f64 = 1e-3;

#[derive(Clone)]
pub(crate) struct Body {
    tree: Arc<Bvh>,
    pub positions: Arc<Vec<Vec3>>,
    pub topology: Arc<Topology>,
    /// What of it cloth is held off by.
    pub sides: Sides,
    /// For each side of each face, the face in which its plane goes on (`flat.rs`); empty where no plane does.
    pub planes: Arc<Vec<[u32; 3]>>,
    pub bounds: Aabb,
    /// Of every triangle where it was at first.
    pub boxes: Arc<Vec<Aabb>>,
    /// Lower bounds of the distance to it, while it is at rest.
    pub clearance: Arc<Clearance>,
    /// How it moves; none for a body at rest.
    pub travel: Option<Travel>,
    /// Rounding of the largest coordinate to f32, m.
    rounding: f64,
    /// How far around a place the nearest one is looked for first, m.
    small: f64,
}

fn flat(v: &Vec3) -> Flat {
    // Rounding to f32 is allowed for by growing every query box.
    #[allow(clippy::cast_possible_truncation)]
    Flat::new(v.x as f32, v.y as f32, v.z as f32)
}

impl Body {
    /// The body of a scene at rest, prepared once for all scenes that share it; `None` for a body without triangles.
    pub fn of_scene(scene: &Scene) -> Option<Self> {
        scene.body.as_ref().and_then(|b| b.prepared(Self::new))
    }

    /// `None` for a body without triangles.
    pub fn new(mesh: &BodyMesh) -> Option<Self> {
        let live: Vec<[u32; 3]> = mesh.triangles.iter().filter(|t| has_area(&mesh.positions, t)).copied().collect();
        if live.is_empty() {
            return None;
        }
        let bounds = Aabb::of(&live.iter().flatten().map(|v| mesh.positions[*v as usize]).collect::<Vec<_>>());
        let topology = Topology::new(mesh.positions.len(), live);
        let boxes: Vec<Aabb> =
            topology.faces.iter().map(|t| Aabb::of_three(&crate::pick3(&mesh.positions, t))).collect();
        let leaf = |b: &Aabb| FlatAabb::new(flat(&b.low), flat(&b.high));
        let tree = Bvh::from_iter(BvhBuildStrategy::Binned, boxes.iter().map(leaf).enumerate());
        let size = bounds.low.amax().max(bounds.high.amax());
        let flat_edges = crate::collision::culling::coplanar_faces::edges(&mesh.positions, &topology);
        let sides = Sides::new(&mesh.positions, &topology, &flat_edges);
        let planes = crate::collision::culling::coplanar_faces::across(&topology, &flat_edges);
        let clearance = Clearance::new(&mesh.positions, &topology.faces, &bounds);
        Some(Self {
            tree: Arc::new(tree),
            positions: Arc::new(mesh.positions.clone()),
            topology: Arc::new(topology),
            sides,
            planes: Arc::new(planes),
            bounds,
            boxes: Arc::new(boxes),
            clearance: Arc::new(clearance),
            travel: None,
            rounding: size * 2.4e-7,
            small: SMALL * (bounds.high - bounds.low).norm(),
        })
    }

    /// As it holds off coarser cloth of such edges and gap (m): by less of what lies close together.
    pub fn held_off(mut self, cloth: [f64; 2]) -> Self {
        self.sides.thin(&self.positions, &self.topology, cloth);
        self
    }

    /// May anything of it be in this box?
    #[inline]
    pub fn may_meet(&self, b: &Aabb) -> bool {
        self.clear_of(b) <= 0.0
    }

    /// How far it is from all that is in this box, at least, m.
    #[inline]
    pub fn clear_of(&self, b: &Aabb) -> f64 {
        let middle = (b.low + b.high) * 0.5;
        let clear = self.clearance.at(&middle) - 0.5 * (b.high - b.low).norm();
        if b.meets(&self.bounds) { clear } else { clear.max(self.bounds.gap(b)) }
    }

    /// Triangles whose boxes may meet `bounds`.
    pub fn candidates(&self, bounds: &Aabb, mut emit: impl FnMut(u32)) {
        let b = bounds.grown(self.rounding);
        let query = FlatAabb::new(flat(&b.low), flat(&b.high));
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

    /// Nearest point within `reach` of `p`, and its distance.
    pub fn nearest(&self, p: &Vec3, reach: f64) -> Option<(Vec3, f64)> {
        let mut best: Option<(Vec3, f64)> = None;
        let mut r = self.small.min(reach);
        loop {
            self.candidates(&Aabb::of_one(p).grown(r), |i| {
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

    /// Is `p` in the box around it?
    pub fn may_contain(&self, p: &Vec3) -> bool {
        self.bounds.meets(&Aabb::of_one(p))
    }

    /// Is `p` inside? By the winding number, so that small holes do not matter.
    pub fn contains(&self, p: &Vec3) -> bool {
        if !self.may_contain(p) {
            return false;
        }
        let mut turns = Turns::default();
        self.topology.faces.iter().for_each(|t| turns.add(&t.map(|v| self.positions[v as usize] - p)));
        turns.whole != 0
    }
}

fn has_area(x: &[Vec3], t: &[u32; 3]) -> bool {
    let [a, b, c] = t.map(|v| x[v as usize]);
    (b - a).cross(&(c - a)).norm_squared() > 0.0
}

/// Half the solid angles of triangles seen from the origin, summed as a direction that turns on: more than half of what is all
/// around is there once it has passed the half turn, and no angle need be told.
struct Turns {
    direction: [f64; 2],
    /// Times it passed the half turn, one way less the other.
    whole: i64,
}

impl Default for Turns {
    fn default() -> Self {
        Self { direction: [1.0, 0.0], whole: 0 }
    }
}

impl Turns {
    /// Turns by half the signed solid angle of a triangle (Van Oosterom and Strackee 1983), less than half a turn.
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
        self.whole += i64::from(up(sin) && up(y) && !up(new[1])) - i64::from(!up(sin) && !up(y) && up(new[1]));
        self.direction = new;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of an octahedron without its first faces.
    fn octahedron(without: usize) -> Body {
        let positions = [1.0, -1.0].into_iter().flat_map(|s| [0, 1, 2].map(|k| Vec3::ith(k, s))).collect();
        let of = |x: u32, y: u32, z: u32| {
            if (x + y + z).is_multiple_of(2) { [3 * x, 1 + 3 * y, 2 + 3 * z] } else { [1 + 3 * y, 3 * x, 2 + 3 * z] }
        };
        let all = (0..8).map(|k| of(k & 1, k >> 1 & 1, k >> 2));
        Body::new(&BodyMesh { positions, triangles: all.skip(without).collect() }).expect("a body")
    }

    /// However far off, and only within reach.
    #[test]
    fn the_nearest_place_is_nearer_than_all_others() {
        let body = octahedron(0);
        for far in [1e-4, 0.003, 0.04, 0.5, 7.0] {
            let p = Vec3::new(0.5, 0.3, 0.2) + Vec3::repeat(far / 3.0_f64.sqrt());
            let (q, d) = body.nearest(&p, 10.0).expect("a place");
            assert!((d - far).abs() < 1e-12 && (q - Vec3::new(0.5, 0.3, 0.2)).norm() < 1e-12, "{far}: {q:?} {d}");
            assert_eq!(body.nearest(&p, 0.99 * far), None);
        }
    }

    #[test]
    fn more_than_half_of_what_is_all_around_is_inside() {
        let (middle, aside) = (Vec3::new(0.01, -0.02, 0.03), Vec3::new(0.3, 0.3, -0.35));
        for (without, inside) in [(0, true), (2, true), (3, true), (5, false), (6, false)] {
            assert_eq!(octahedron(without).contains(&middle), inside, "{without} faces open");
        }
        let whole = octahedron(0);
        assert!(
            whole.contains(&aside) && !whole.contains(&(aside * 1.2)) && !whole.contains(&Vec3::new(0.9, 0.9, 0.9))
        );
    }
}
