//! Counting the intersecting pairs of a cloth, and of a cloth and a body.

use super::pair::{apart_cross, corner_cross, edge_fold};
use crate::Vec3;
use crate::collide::tree::{Aabb, Tree};

/// Intersecting pairs, the first few kept.
#[derive(Clone, Debug, Default)]
pub(crate) struct Crossings {
    pub count: usize,
    /// Triangle of the cloth and its partner (cloth or body), at most [`KEPT`].
    pub pairs: Vec<[u32; 2]>,
}

const KEPT: usize = 10_000;

impl Crossings {
    fn add(&mut self, i: u32, j: u32) {
        self.count += 1;
        if self.pairs.len() < KEPT {
            self.pairs.push([i, j]);
        }
    }
}

fn degenerate(t: &[u32; 3], x: &[Vec3]) -> bool {
    let [a, b, c] = t.map(|v| x[v as usize]);
    (b - a).cross(&(c - a)).norm_squared() == 0.0
}

/// Pairs of cloth triangles that cross (no common vertex), pass through each other beside a common vertex, or lie
/// folded on each other beside a common edge. Vertices at bit-equal places count as common, as they do in a file.
pub(crate) fn own(x: &[Vec3], faces: &[[u32; 3]]) -> Crossings {
    let same = places(x);
    let faces: Vec<[u32; 3]> = faces.iter().map(|t| t.map(|v| same[v as usize])).collect();
    let mut found = Crossings::default();
    Tree::new(x, &faces).own_pairs(|i, j| {
        let (s, t) = (faces[i as usize], faces[j as usize]);
        if cross(x, s, t) && !degenerate(&s, x) && !degenerate(&t, x) {
            found.add(i.min(j), i.max(j));
        }
    });
    found
}

/// For every vertex the first vertex at the same place.
fn places(x: &[Vec3]) -> Vec<u32> {
    let key = |i: u32| x[i as usize];
    let mut order: Vec<u32> = (0..x.len()).map(|i| u32::try_from(i).unwrap_or(u32::MAX)).collect();
    let compare = |p: &u32, q: &u32| {
        let (a, b) = (key(*p), key(*q));
        // −0 and 0 are one place.
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

fn cross(x: &[Vec3], s: [u32; 3], t: [u32; 3]) -> bool {
    let common = s.iter().filter(|v| t.contains(v)).count();
    let at = |t: [u32; 3]| t.map(|v| x[v as usize]);
    match common {
        0 => apart_cross(&at(s), &at(t)),
        1 => {
            let turn = |t: [u32; 3], o: [u32; 3]| {
                let k = t.iter().position(|v| o.contains(v)).unwrap_or(0);
                [t[k], t[(k + 1) % 3], t[(k + 2) % 3]]
            };
            corner_cross(&at(turn(s, t)), &at(turn(t, s)))
        }
        2 => {
            let turn = |t: [u32; 3], o: [u32; 3]| {
                let k = t.iter().position(|v| !o.contains(v)).unwrap_or(0);
                let (a, b) = (t[(k + 1) % 3], t[(k + 2) % 3]);
                [a.min(b), a.max(b), t[k]]
            };
            edge_fold(&at(turn(s, t)), &at(turn(t, s)))
        }
        _ => false,
    }
}

/// Pairs of a cloth and a body triangle that cross.
pub(crate) fn with_body(x: &[Vec3], faces: &[[u32; 3]], body: &[Vec3], body_faces: &[[u32; 3]]) -> Crossings {
    let tree = Tree::new(body, body_faces);
    let mut found = Crossings::default();
    for (i, t) in (0u32..).zip(faces) {
        let a = t.map(|v| x[v as usize]);
        tree.meeting(&Aabb::of(&a), |j| {
            let b = body_faces[j as usize].map(|v| body[v as usize]);
            if apart_cross(&a, &b) {
                found.add(i, j);
            }
        });
    }
    found
}
