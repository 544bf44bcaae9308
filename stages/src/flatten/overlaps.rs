//! Places where the border of a flat piece crosses itself. No triangle is flipped, but two parts lie over each other.

use crate::triangulate::crossing::{Segment, meet, meetings};
use std::collections::BTreeMap;
use toile_garment::Vec2;
use toile_garment::mesh::PieceMesh;

/// More places than this are not told.
const MOST: usize = 100;

/// The places. Sides that meet in the stored piece, as both lips of a slit do, may meet in the flat one.
#[must_use]
pub fn find(mesh: &PieceMesh, flat: &[Vec2]) -> Vec<Vec2> {
    let border = border(&mesh.triangles);
    let segment = |x: &[Vec2], index: usize| {
        let [a, b] = border[index].map(|v| x[v as usize]);
        Segment { a, b, curve: 0, index }
    };
    let is_new = |s: &Segment, t: &Segment| {
        let [p, q] = [border[s.index], border[t.index]];
        let joined = p.iter().any(|v| q.contains(v));
        !joined && meet(&segment(&mesh.rest, s.index), &segment(&mesh.rest, t.index)).is_none()
    };
    let sides = (0..border.len()).map(|k| segment(flat, k)).collect();
    meetings(sides, is_new, MOST).map_or_else(|_| Vec::new(), |all| all.iter().map(|m| m.at).collect())
}

/// Sides of one triangle alone.
fn border(triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let mut count = BTreeMap::<[u32; 2], u32>::new();
    for [a, b, c] in triangles {
        for [p, q] in [[a, b], [b, c], [c, a]] {
            *count.entry([*p.min(q), *p.max(q)]).or_default() += 1;
        }
    }
    count.into_iter().filter(|(_, n)| *n == 1).map(|(side, _)| side).collect()
}
