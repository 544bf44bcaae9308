//! Edge flips until every edge inside is a Delaunay edge.

use super::area;
use std::collections::BTreeMap;

pub fn flip(rest: &[[f64; 2]], triangles: &mut [[usize; 3]]) {
    // Each pass looks at every edge once; the meshes here need a handful.
    for _ in 0..50 {
        if !pass(rest, triangles) {
            return;
        }
    }
}

fn pass(rest: &[[f64; 2]], triangles: &mut [[usize; 3]]) -> bool {
    let mut owner: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    for (t, corners) in triangles.iter().enumerate() {
        for k in 0..3 {
            owner.insert((corners[k], corners[(k + 1) % 3]), t);
        }
    }
    let mut touched = vec![false; triangles.len()];
    let mut changed = false;
    for (&(a, b), &t) in &owner {
        let Some(&s) = owner.get(&(b, a)).filter(|_| a < b) else { continue };
        if touched[t] || touched[s] {
            continue;
        }
        let third = |i: usize| triangles[i].into_iter().find(|v| *v != a && *v != b).expect("a third corner");
        let (c, d) = (third(t), third(s));
        let [one, two] = [[a, d, c], [d, b, c]];
        let convex = area(rest, &one) > 0.0 && area(rest, &two) > 0.0;
        if convex && angle(rest, a, c, b) + angle(rest, a, d, b) > std::f64::consts::PI + 1e-9 {
            (triangles[t], triangles[s]) = (one, two);
            (touched[t], touched[s]) = (true, true);
            changed = true;
        }
    }
    changed
}

/// Angle at `at` in the corner a–at–b.
fn angle(rest: &[[f64; 2]], a: usize, at: usize, b: usize) -> f64 {
    let to = |i: usize| [rest[i][0] - rest[at][0], rest[i][1] - rest[at][1]];
    let (p, q) = (to(a), to(b));
    libm::atan2((p[0] * q[1] - p[1] * q[0]).abs(), p[0] * q[0] + p[1] * q[1])
}
