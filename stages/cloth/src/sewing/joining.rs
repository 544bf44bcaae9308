//! Stitches that can be joined: their ends come to one point, and nothing crosses then.

use crate::collision::body::Body;
use crate::collision::crossings::count;
use crate::effects::{BODY_CONTACT, Facts, SELF_CONTACT};
use crate::scene::weld::groups;
use crate::{Scene, Settings, Vec3};
use std::collections::BTreeSet;

/// Largest number of rounds in which stitches are left open because their cloth crosses.
const ROUNDS_MOST: usize = 8;

/// The triangles that joined cloth must not cross.
pub(crate) struct Obstacles<'a> {
    /// Triangles of the cloth.
    pub faces: &'a [[u32; 3]],
    /// Does cloth meet cloth?
    pub has_self_contact: bool,
    pub body: Option<&'a Body>,
}

/// Pairs of triangles that cross: of cloth, and of cloth and body.
struct Crossings {
    cloth: BTreeSet<[u32; 2]>,
    body: BTreeSet<[u32; 2]>,
}

impl Obstacles<'_> {
    fn crossings(&self, x: &[Vec3]) -> Crossings {
        let cloth = if self.has_self_contact { count::self_crossings(x, self.faces).pairs } else { Vec::new() };
        let body = self.body.map(|b| count::body_crossings(x, self.faces, b).pairs).unwrap_or_default();
        Crossings { cloth: cloth.into_iter().collect(), body: body.into_iter().collect() }
    }
}

/// Joined cloth.
pub(crate) struct Joined {
    /// Places of the vertices, m.
    pub x: Vec<Vec3>,
    /// The stitches that were joined.
    pub stitches: Vec<[u32; 2]>,
}

/// Joins the stitches that are not wider than `gap_most`, m, each group at the mean of its places. Stitches whose cloth
/// crosses something then stay open. What crossed before does not count: the stitches are not its cause.
pub(crate) fn join(x: &[Vec3], stitches: &[[u32; 2]], gap_most: f64, near: &Obstacles<'_>) -> Joined {
    let is_near = |s: &&[u32; 2]| (x[s[0] as usize] - x[s[1] as usize]).norm() <= gap_most;
    let mut chosen: Vec<[u32; 2]> = stitches.iter().filter(is_near).copied().collect();
    if chosen.is_empty() {
        return Joined { x: x.to_vec(), stitches: chosen };
    }
    let before = near.crossings(x);
    for _ in 0..ROUNDS_MOST {
        let group = groups(x.len(), &chosen);
        let joined = at_means(x, &group);
        let crossing = crossing_vertices(&joined, &before, near);
        if crossing.is_empty() {
            return Joined { x: joined, stitches: chosen };
        }
        let given_up: BTreeSet<u32> = crossing.iter().map(|v| group[*v as usize]).collect();
        let count = chosen.len();
        chosen.retain(|s| !given_up.contains(&group[s[0] as usize]));
        if chosen.len() == count {
            break;
        }
    }
    Joined { x: x.to_vec(), stitches: Vec::new() }
}

/// The stitches of a scene that can be joined, of those that are not wider than `gap_most`, m, at `positions`, m.
#[must_use]
pub fn joinable_stitches(scene: &Scene, settings: &Settings, positions: &[Vec3], gap_most: f64) -> Vec<[u32; 2]> {
    if scene.stitches.is_empty() {
        return Vec::new();
    }
    let faces: Vec<[u32; 3]> = scene.triangles.iter().map(|t| t.vertices).collect();
    let facts = Facts::of_scene(scene, settings);
    let has_self_contact = SELF_CONTACT.is_on(&facts, settings);
    let body = if BODY_CONTACT.is_on(&facts, settings) { Body::of_scene(scene) } else { None };
    let near = Obstacles { faces: &faces, has_self_contact, body: body.as_ref() };
    join(positions, &scene.stitches, gap_most, &near).stitches
}

fn at_means(x: &[Vec3], group: &[u32]) -> Vec<Vec3> {
    let mut sums = vec![(Vec3::zeros(), 0.0); x.len()];
    for (x, g) in x.iter().zip(group) {
        let (sum, n) = &mut sums[*g as usize];
        (*sum, *n) = (*sum + x, *n + 1.0);
    }
    let mean = |g: u32| sums[g as usize].0 / sums[g as usize].1;
    x.iter().zip(group).map(|(x, g)| if sums[*g as usize].1 > 1.0 { mean(*g) } else { *x }).collect()
}

/// Vertices of the triangles that cross the body, or other cloth, that they did not cross before.
fn crossing_vertices(x: &[Vec3], before: &Crossings, near: &Obstacles<'_>) -> BTreeSet<u32> {
    let now = near.crossings(x);
    let cloth = now.cloth.difference(&before.cloth).flatten();
    let crossing = cloth.chain(now.body.difference(&before.body).map(|[cloth, _]| cloth));
    crossing.flat_map(|f| near.faces[*f as usize]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// There are two pairs of triangles, each with one above the other and a stitch at a corner. A fifth triangle lies
    /// between those of the second pair. Their stitch stays open, and the other one is joined in the middle.
    #[test]
    fn stitches_whose_cloth_would_cross_stay_open() {
        let triangle =
            |x: f64, apex: f64, z: f64| [[0.0, 0.0], [0.1, 0.0], [0.0, apex]].map(|[u, v]| Vec3::new(x + u, v, z));
        let pair = |x: f64| [triangle(x, 0.1, 0.0), triangle(x, -0.1, 0.004)].concat();
        let between = [[0.28, -0.02], [0.28, 0.02], [0.33, 0.02]].map(|[x, y]| Vec3::new(x, y, 0.0015));
        let x: Vec<Vec3> = [pair(0.0), pair(0.3), between.to_vec()].concat();
        let faces = [[0, 1, 2], [3, 4, 5], [6, 7, 8], [9, 10, 11], [12, 13, 14]];
        let stitches = [[0, 3], [6, 9]];
        let near = Obstacles { faces: &faces, has_self_contact: true, body: None };
        let joined = join(&x, &stitches, 0.005, &near);
        assert_eq!(joined.stitches, [[0, 3]]);
        assert_eq!(joined.x[0], joined.x[3]);
        assert!((joined.x[0].z - 0.002).abs() < 1e-15);
        assert_eq!((joined.x[6], joined.x[9]), (x[6], x[9]));
        // Cloth that may pass through cloth is joined everywhere, and a wide stitch never.
        let free = Obstacles { has_self_contact: false, ..near };
        assert_eq!(join(&x, &stitches, 0.005, &free).stitches.len(), 2);
        assert_eq!(join(&x, &stitches, 0.003, &free).stitches.len(), 0);
        // Without stitches the cloth stays as it is, and no crossing is looked for.
        assert_eq!(join(&x, &[], 0.005, &near).x, x);
    }
}
