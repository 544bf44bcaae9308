//! Edge flips and inner vertices for the triangles of lyon.
//!
//! lyon makes a triangle of three vertices on one straight line. Such a triangle has no area, so its cloth has no
//! stiffness. Others reach across the whole piece, and cannot be laid around a body.

use super::super::smooth::{cross, least_angle};
use std::collections::{BTreeMap, BTreeSet};
use toile_garment::Vec2;

/// Largest number of rounds over all edges; a draft needs about ten.
const ROUNDS: usize = 100;

/// Largest number of rounds in which long edges are halved.
const HALVINGS: usize = 24;
/// An inner edge is halved while it is longer than so many edge lengths.
const LONG: f64 = 1.5;

/// Halves inner edges that are long beside the edge length `h`, m, and flips edges. Drawn `edges` stay.
pub fn refine(points: &mut Vec<Vec2>, edges: &[[u32; 2]], triangles: &mut Vec<[u32; 3]>, h: f64) {
    widen(points, edges, triangles);
    for _ in 0..HALVINGS {
        let before = points.len();
        halve(points, edges, triangles, LONG * h);
        if points.len() == before {
            return;
        }
        widen(points, edges, triangles);
    }
}

/// Halves inner edges that are longer than `most`, the longest first, and one at most of every triangle.
fn halve(points: &mut Vec<Vec2>, edges: &[[u32; 2]], triangles: &mut Vec<[u32; 3]>, most: f64) {
    let drawn: BTreeSet<[u32; 2]> = edges.iter().copied().map(in_order).collect();
    let length = |edge: &[u32; 2]| (points[edge[0] as usize] - points[edge[1] as usize]).norm();
    let mut long: Vec<(f64, [u32; 2], Vec<usize>)> = neighbours(triangles)
        .into_iter()
        .filter(|(edge, sides)| sides.len() == 2 && !drawn.contains(edge) && length(edge) > most)
        .map(|(edge, sides)| (length(&edge), edge, sides))
        .collect();
    long.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut halved = vec![false; triangles.len()];
    for (_, [a, b], sides) in long {
        if sides.iter().any(|i| halved[*i]) {
            continue;
        }
        let middle = points.len() as u32;
        points.push((points[a as usize] + points[b as usize]) * 0.5);
        for i in sides {
            halved[i] = true;
            let other = triangles[i].map(|v| if v == a { middle } else { v });
            triangles[i] = triangles[i].map(|v| if v == b { middle } else { v });
            triangles.push(other);
        }
    }
}

/// Flips every edge between two triangles whose least angle grows so. Drawn `edges` stay.
fn widen(points: &[Vec2], edges: &[[u32; 2]], triangles: &mut [[u32; 3]]) {
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
