//! Edges inside a mesh are turned so that its triangles are as wide as they can be.
//!
//! lyon takes three vertices of one straight line for a triangle. It has no area, so its cloth has no stiffness.

use super::super::smooth::{cross, least_angle};
use std::collections::BTreeMap;
use toile_garment::Vec2;

/// Rounds over all edges; a draft needs about ten.
const ROUNDS: usize = 100;

/// Turns every edge between two triangles whose least angle grows so. Drawn `edges` stay.
pub fn widen(points: &[Vec2], edges: &[[u32; 2]], triangles: &mut [[u32; 3]]) {
    let mut drawn: Vec<[u32; 2]> = edges.iter().copied().map(in_order).collect();
    drawn.sort_unstable();
    for _ in 0..ROUNDS {
        let mut turned = vec![false; triangles.len()];
        for (edge, sides) in neighbours(triangles) {
            let [i, j] = sides[..] else { continue };
            if drawn.binary_search(&edge).is_ok() || turned[i] || turned[j] {
                continue;
            }
            if let Some(pair) = turn(points, edge, [triangles[i], triangles[j]]) {
                [triangles[i], triangles[j]] = pair;
                (turned[i], turned[j]) = (true, true);
            }
        }
        if !turned.contains(&true) {
            return;
        }
    }
}

/// The triangles at every edge.
fn neighbours(triangles: &[[u32; 3]]) -> BTreeMap<[u32; 2], Vec<usize>> {
    let mut out: BTreeMap<[u32; 2], Vec<usize>> = BTreeMap::new();
    for (i, t) in triangles.iter().enumerate() {
        for k in 0..3 {
            out.entry(in_order([t[k], t[(k + 1) % 3]])).or_default().push(i);
        }
    }
    out
}

fn in_order([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// Two triangles on the other diagonal, if both have area and the least angle is larger. The wider triangle tells the
/// sides of the edge, since three vertices of a straight line are wound by rounding.
fn turn(points: &[Vec2], edge: [u32; 2], pair: [[u32; 3]; 2]) -> Option<[[u32; 3]; 2]> {
    let double = |[a, b, c]: [u32; 3]| cross(points[a as usize], points[b as usize], points[c as usize]);
    let [wide, flat] = if double(pair[0]) < double(pair[1]) { [pair[1], pair[0]] } else { pair };
    let k = (0..3).find(|k| !edge.contains(&wide[*k]))?;
    let [p, a, b] = [0, 1, 2].map(|n| wide[(k + n) % 3]);
    let q = flat.into_iter().find(|v| !edge.contains(v))?;
    let other = [[p, a, q], [p, q, b]];
    let angle = |[a, b, c]: [u32; 3]| least_angle(points[a as usize], points[b as usize], points[c as usize]);
    let least = |pair: [[u32; 3]; 2]| angle(pair[0]).min(angle(pair[1]));
    (other.into_iter().all(|t| double(t) > 0.0) && least(other) > least(pair) + 1e-9).then_some(other)
}
