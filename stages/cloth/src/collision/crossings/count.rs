//! Counts of intersecting pairs of cloth triangles, and of cloth and body triangles.

use crate::Vec3;
use crate::collision::body::Body;
use crate::collision::broad_phase::aabb::Aabb;
use crate::collision::broad_phase::bvh::BoxTree;
use crate::collision::crossings::pair::{corner_triangles_cross, disjoint_triangles_cross, edge_triangles_fold};

/// The number of intersecting pairs, and the first of them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Crossings {
    pub count: usize,
    /// Triangle of the cloth and its partner in cloth or body. At most [`LISTED_CROSSINGS`] pairs are kept.
    pub pairs: Vec<[u32; 2]>,
}

const LISTED_CROSSINGS: usize = 10_000;

impl Crossings {
    fn add(&mut self, i: u32, j: u32) {
        self.count += 1;
        if self.pairs.len() < LISTED_CROSSINGS {
            self.pairs.push([i, j]);
        }
    }
}

fn degenerate(t: &[u32; 3], x: &[Vec3]) -> bool {
    let [a, b, c] = t.map(|v| x[v as usize]);
    (b - a).cross(&(c - a)).norm_squared() == 0.0
}

/// Counts the pairs of cloth triangles that cross.
///
/// Triangles without a common vertex cross, triangles with a common vertex pass through each other beside it, and
/// triangles with a common edge lie folded on each other. Vertices at bit-equal places count as common, as they do in
/// a file. Triangles on each other cross unless they have the same vertices (layers sewn to each other everywhere).
pub(crate) fn self_crossings(x: &[Vec3], faces: &[[u32; 3]]) -> Crossings {
    let same = places(x);
    let given = faces;
    let faces: Vec<[u32; 3]> = faces.iter().map(|t| t.map(|v| same[v as usize])).collect();
    let mut found = Crossings::default();
    BoxTree::new(x, &faces).meeting_pairs_at_rest(|i, j| {
        let (s, t) = (faces[i as usize], faces[j as usize]);
        let joined = || given[i as usize].iter().all(|v| given[j as usize].contains(v));
        if cross(x, s, t) && !joined() && !degenerate(&s, x) && !degenerate(&t, x) {
            found.add(i.min(j), i.max(j));
        }
    });
    found
}

/// For every vertex, the first vertex at the same place.
fn places(x: &[Vec3]) -> Vec<u32> {
    let key = |i: u32| x[i as usize];
    let mut order: Vec<u32> = (0..x.len()).map(|i| u32::try_from(i).unwrap_or(u32::MAX)).collect();
    let compare = |p: &u32, q: &u32| {
        let (a, b) = (key(*p), key(*q));
        // Here −0 and 0 are one place.
        (a.x + 0.0)
            .total_cmp(&(b.x + 0.0))
            .then((a.y + 0.0).total_cmp(&(b.y + 0.0)))
            .then((a.z + 0.0).total_cmp(&(b.z + 0.0)))
    };
    order.sort_unstable_by(|p, q| compare(p, q).then(p.cmp(q)));
    let mut same = vec![0; x.len()];
    let mut first = 0;
    for (k, v) in order.iter().enumerate() {
        if k > 0 && key(order[k - 1]) != key(*v) {
            first = k;
        }
        same[*v as usize] = order[first];
    }
    same
}

/// Do two triangles of cloth cross, or pass through or lie on each other beside their common vertices?
pub(crate) fn cross(x: &[Vec3], s: [u32; 3], t: [u32; 3]) -> bool {
    let common = s.iter().filter(|v| t.contains(v)).count();
    let at = |t: [u32; 3]| t.map(|v| x[v as usize]);
    match common {
        0 => disjoint_triangles_cross(&at(s), &at(t)),
        1 => {
            let turn = |t: [u32; 3], o: [u32; 3]| {
                let k = t.iter().position(|v| o.contains(v)).unwrap_or(0);
                [t[k], t[(k + 1) % 3], t[(k + 2) % 3]]
            };
            corner_triangles_cross(&at(turn(s, t)), &at(turn(t, s)))
        }
        2 => {
            let turn = |t: [u32; 3], o: [u32; 3]| {
                let k = t.iter().position(|v| !o.contains(v)).unwrap_or(0);
                let (a, b) = (t[(k + 1) % 3], t[(k + 2) % 3]);
                [a.min(b), a.max(b), t[k]]
            };
            edge_triangles_fold(&at(turn(s, t)), &at(turn(t, s)))
        }
        // The two triangles lie on each other.
        _ => true,
    }
}

/// Pairs of a cloth triangle and a triangle of a body at rest that cross, in ascending order. Parts of the body that the
/// cloth ignores are left out.
pub(crate) fn body_crossings(x: &[Vec3], faces: &[[u32; 3]], body: &Body) -> Crossings {
    let (mut found, mut crossed) = (Crossings::default(), Vec::new());
    for (i, t) in (0u32..).zip(faces) {
        let a = t.map(|v| x[v as usize]);
        let bounds = Aabb::of_three(&a);
        if !bounds.meets(&body.bounds) {
            continue;
        }
        let ignored = body.met.ignored_by_face(t);
        body.candidates(&bounds, |k| {
            if body.met.is_met(k, ignored) && disjoint_triangles_cross(&a, &body.triangle(k)) {
                crossed.push(k);
            }
        });
        crossed.sort_unstable();
        crossed.drain(..).for_each(|k| found.add(i, k));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn v(x: f64, y: f64, z: f64) -> Vec3 {
        Vec3::new(x, y, z)
    }

    fn flat() -> Vec<Vec3> {
        vec![v(0.0, 0.0, 0.0), v(1.0, 0.0, 0.0), v(0.0, 1.0, 0.0)]
    }

    fn count(other: [Vec3; 3]) -> usize {
        let mut x = flat();
        x.extend(other);
        self_crossings(&x, &[[0, 1, 2], [3, 4, 5]]).count
    }

    #[test]
    fn a_triangle_through_another_counts_once_whatever_its_winding() {
        let t = [v(0.2, 0.2, -1.0), v(0.2, 0.2, 1.0), v(0.3, 0.2, 1.0)];
        for p in [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]] {
            assert_eq!(count(p.map(|i| t[i])), 1);
        }
    }

    #[test]
    fn apart_touching_and_just_through_are_told_apart() {
        let tip = |z: f64| [v(0.2, 0.2, z), v(0.2, 0.3, 1.0), v(0.3, 0.2, 1.0)];
        assert_eq!(count(tip(1e-300)), 0);
        assert_eq!(count(tip(0.0)), 0);
        assert_eq!(count(tip(-1e-300)), 1);
        // This one lies beside the triangle.
        assert_eq!(count([v(2.0, 2.0, -1.0), v(2.0, 2.0, 1.0), v(3.0, 2.0, 1.0)]), 0);
    }

    #[test]
    fn overlap_in_one_plane_counts_but_a_common_border_does_not() {
        assert_eq!(count([v(0.1, 0.1, 0.0), v(0.9, 0.1, 0.0), v(0.1, 0.9, 0.0)]), 1);
        assert_eq!(count([v(0.0, 0.0, 0.0), v(-1.0, 0.0, 0.0), v(0.0, -1.0, 0.0)]), 0);
    }

    #[test]
    fn a_far_edge_through_a_neighbour_counts() {
        let mut x = flat();
        x.extend([v(0.2, 0.2, -0.1), v(0.3, 0.3, 0.1)]);
        assert_eq!(self_crossings(&x, &[[0, 1, 2], [0, 3, 4]]).count, 1);
        x[3].z = 0.05;
        assert_eq!(self_crossings(&x, &[[0, 1, 2], [0, 3, 4]]).count, 0);
    }

    #[test]
    fn a_fold_flat_over_an_edge_counts() {
        let mut x = flat();
        x.push(v(0.5, 0.3, 0.0));
        assert_eq!(self_crossings(&x, &[[0, 1, 2], [1, 0, 3]]).count, 1);
        x[3].z = 1e-9;
        assert_eq!(self_crossings(&x, &[[0, 1, 2], [1, 0, 3]]).count, 0);
        x[3] = v(0.5, -0.3, 0.0);
        assert_eq!(self_crossings(&x, &[[0, 1, 2], [1, 0, 3]]).count, 0);
    }

    #[test]
    fn vertices_at_one_place_are_one() {
        // Two triangles of a seam whose vertices are doubled are neighbours, not a crossing.
        let mut x = flat();
        x.extend([v(0.0, -0.0, 0.0), v(1.0, 0.0, 0.0), v(0.5, -1.0, 0.3)]);
        assert_eq!(self_crossings(&x, &[[0, 1, 2], [3, 5, 4]]).count, 0);
    }

    #[test]
    fn triangles_on_each_other_count() {
        let x = flat();
        let double: Vec<Vec3> = x.iter().chain(&x).copied().collect();
        assert_eq!(self_crossings(&double, &[[0, 1, 2], [3, 4, 5]]).count, 1);
        assert_eq!(self_crossings(&double, &[[0, 1, 2], [4, 3, 5]]).count, 1);
        assert_eq!(self_crossings(&x, &[[0, 1, 2], [1, 2, 0]]).count, 0, "two layers sewn together");
    }

    #[test]
    fn a_body_pierced_by_cloth_is_counted() {
        let cloth = [v(0.2, 0.2, -1.0), v(0.2, 0.25, 1.0), v(0.25, 0.2, 1.0)];
        let body = Body::new(&crate::BodyMesh { positions: flat(), triangles: vec![[0, 1, 2]] }).expect("a body");
        let found = body_crossings(&cloth, &[[0, 1, 2]], &body);
        assert_eq!((found.count, found.pairs), (1, vec![[0, 0]]));
    }
}
