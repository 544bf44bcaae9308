//! Which triangles are cloth: the boundary parts them into regions, and the fill rule decides each region.

use super::layout::Layout;
use super::lyon::covers;
use super::smooth::cross;
use crate::sewing::ring::SAME;
use std::collections::BTreeSet;
use toile_garment::Vec2;

/// Keeps the triangles in the regions that the fill rule calls cloth.
///
/// # Errors
/// The boundary edges of every region that would be cloth and not cloth: the boundary touches itself.
pub fn cloth(points: &[Vec2], triangles: &[[u32; 3]], layout: &Layout) -> Result<Vec<[u32; 3]>, Vec<[u32; 2]>> {
    let boundary = layout.boundary();
    let regions = Regions::new(triangles, &boundary);
    let rings = layout.rings();
    let rings = || rings.iter().map(Vec::as_slice);
    let decided = regions.witnesses(points, triangles).into_iter().map(|p| p.map(|p| covers(rings(), p))).collect();
    let is_cloth = regions.with_hairs(&boundary, decided);
    let wrong = regions.wrong(&boundary, &is_cloth);
    if wrong.is_empty() {
        let marked = triangles.iter().zip(&regions.of);
        Ok(marked.filter(|(_, region)| is_cloth[**region as usize]).map(|(t, _)| *t).collect())
    } else {
        Err(wrong)
    }
}

/// Keeps the triangles in the regions to the left of a boundary.
pub fn left_of(triangles: &[[u32; 3]], boundary: &[[u32; 2]]) -> Vec<[u32; 3]> {
    let regions = Regions::new(triangles, boundary);
    let is_left = regions.with_hairs(boundary, vec![None; regions.count as usize]);
    let marked = triangles.iter().zip(&regions.of);
    marked.filter(|(_, region)| is_left[**region as usize]).map(|(t, _)| *t).collect()
}

/// Triangles that hang together without crossing the boundary.
struct Regions {
    /// Directed sides of the triangles, sorted, with their triangle.
    sides: Vec<([u32; 2], u32)>,
    /// Region of every triangle.
    of: Vec<u32>,
    count: u32,
}

impl Regions {
    fn new(triangles: &[[u32; 3]], boundary: &[[u32; 2]]) -> Self {
        let walls: BTreeSet<[u32; 2]> = boundary.iter().copied().collect();
        let mut sides: Vec<([u32; 2], u32)> = Vec::with_capacity(triangles.len() * 3);
        for (i, t) in triangles.iter().enumerate() {
            for k in 0..3 {
                sides.push(([t[k], t[(k + 1) % 3]], i as u32));
            }
        }
        sides.sort_unstable();
        let mut out = Self { sides, of: vec![u32::MAX; triangles.len()], count: 0 };
        for first in 0..triangles.len() {
            if out.of[first] == u32::MAX {
                out.flood(first, triangles, &walls);
                out.count += 1;
            }
        }
        out
    }

    fn flood(&mut self, first: usize, triangles: &[[u32; 3]], walls: &BTreeSet<[u32; 2]>) {
        self.of[first] = self.count;
        let mut queue = vec![first];
        while let Some(i) = queue.pop() {
            let t = triangles[i];
            for k in 0..3 {
                let (a, b) = (t[k], t[(k + 1) % 3]);
                if walls.contains(&[a, b]) || walls.contains(&[b, a]) {
                    continue;
                }
                let Some(next) = self.left_of([b, a]).filter(|next| self.of[*next] == u32::MAX) else { continue };
                self.of[next] = self.count;
                queue.push(next);
            }
        }
    }

    /// The triangle on the left of a directed side.
    fn left_of(&self, side: [u32; 2]) -> Option<usize> {
        let at = self.sides.partition_point(|(e, _)| *e < side);
        self.sides.get(at).filter(|(e, _)| *e == side).map(|(_, t)| *t as usize)
    }

    /// The middle of every region's largest triangle; none where the region is a hair, too thin for `f32`.
    fn witnesses(&self, points: &[Vec2], triangles: &[[u32; 3]]) -> Vec<Option<Vec2>> {
        let mut best = vec![(f64::NEG_INFINITY, None); self.count as usize];
        for (t, region) in triangles.iter().zip(&self.of) {
            let [a, b, c] = t.map(|v| points[v as usize]);
            let (double, best) = (cross(a, b, c), &mut best[*region as usize]);
            if double > best.0 {
                let longest = (b - a).norm().max((c - b).norm()).max((a - c).norm());
                *best = (double, (double > 3.0 * SAME * longest).then(|| (a + b + c) / 3.0));
            }
        }
        best.into_iter().map(|(_, p)| p).collect()
    }

    /// Adds the regions that are hairs: they lie on the side of the boundary on which they were drawn.
    fn with_hairs(&self, boundary: &[[u32; 2]], mut decided: Vec<Option<bool>>) -> Vec<bool> {
        for (side, cloth) in boundary.iter().flat_map(|edge| sides(*edge)) {
            if let Some(t) = self.left_of(side) {
                decided[self.of[t] as usize].get_or_insert(cloth);
            }
        }
        decided.into_iter().map(|cloth| cloth.unwrap_or(false)).collect()
    }

    /// The boundary of all regions that have the cloth on the wrong side of one of their edges.
    fn wrong(&self, boundary: &[[u32; 2]], is_cloth: &[bool]) -> Vec<[u32; 2]> {
        let region = |side: [u32; 2]| self.left_of(side).map(|t| self.of[t]);
        let all = || boundary.iter().flat_map(|edge| sides(*edge));
        let bad: BTreeSet<u32> =
            all().filter_map(|(side, cloth)| region(side).filter(|r| is_cloth[*r as usize] != cloth)).collect();
        if bad.is_empty() {
            return Vec::new();
        }
        all().filter(|(side, _)| region(*side).is_some_and(|r| bad.contains(&r))).map(|(side, _)| side).collect()
    }
}

/// Both sides of a directed boundary edge, and whether cloth lies to the left of them.
fn sides([a, b]: [u32; 2]) -> [([u32; 2], bool); 2] {
    [([a, b], true), ([b, a], false)]
}
