//! Parts that a level plane cuts out of a surface: the trunk, sleeves, legs.

use super::surface::Surface;
use crate::body::hull;
use crate::joined::Joined;
use std::collections::BTreeMap;
use toile_garment::{Vec2, Vec3};

/// A part of a surface that a level plane cuts, seen from above: x to the wearer's left, y to the front.
#[derive(Clone, Debug, PartialEq)]
pub struct Ring {
    /// Numbers of the triangles that are cut, ascending.
    pub triangles: Vec<usize>,
    /// Ends of the cut through each of these triangles, metres.
    pub cuts: Vec<[Vec2; 2]>,
    /// Does it run around without an end?
    pub closed: bool,
    hull: Vec<Vec2>,
}

/// A triangle that is cut, the numbers of its two edges that are, and the ends of the cut.
type Segment = (usize, [usize; 2], [Vec2; 2]);

/// The parts that a height cuts out of a surface.
#[must_use]
pub fn rings(surface: &Surface, height: f64) -> Vec<Ring> {
    let mut number: BTreeMap<[u32; 2], usize> = BTreeMap::new();
    let mut segments: Vec<Segment> = Vec::new();
    for (triangle, corners) in surface.triangles.iter().enumerate() {
        let mut ends = (0..3).filter_map(|k| {
            let (a, b) = (corners[k].min(corners[(k + 1) % 3]), corners[k].max(corners[(k + 1) % 3]));
            let at = crossing(surface.points[a as usize], surface.points[b as usize], height)?;
            Some(([a, b], at))
        });
        if let (Some(from), Some(to)) = (ends.next(), ends.next()) {
            let keys = [from.0, to.0].map(|edge| {
                let next = number.len();
                *number.entry(edge).or_insert(next)
            });
            segments.push((triangle, keys, [from.1, to.1]));
        }
    }
    let mut joined = Joined::new(number.len());
    let mut met = vec![0; number.len()];
    for (_, [a, b], _) in &segments {
        joined.join(*a, *b);
        met[*a] += 1;
        met[*b] += 1;
    }
    let mut parts: BTreeMap<usize, Vec<&Segment>> = BTreeMap::new();
    for segment in &segments {
        parts.entry(joined.root(segment.1[0])).or_default().push(segment);
    }
    parts.values().map(|part| ring(part, &met)).collect()
}

fn ring(part: &[&Segment], met: &[usize]) -> Ring {
    let cuts: Vec<[Vec2; 2]> = part.iter().map(|s| s.2).collect();
    Ring {
        triangles: part.iter().map(|s| s.0).collect(),
        closed: part.iter().flat_map(|s| s.1).all(|e| met[e] == 2),
        hull: hull(cuts.iter().flatten().copied().collect()),
        cuts,
    }
}

fn crossing(a: Vec3, b: Vec3, height: f64) -> Option<Vec2> {
    let t = (height - a.y) / (b.y - a.y);
    ((a.y < height) != (b.y < height)).then(|| Vec2::new(a.x + t * (b.x - a.x), a.z + t * (b.z - a.z)))
}

impl Ring {
    /// Length along the surface, every fold included, metres.
    #[must_use]
    pub fn along(&self) -> f64 {
        self.cuts.iter().map(|[a, b]| (b - a).norm()).sum()
    }

    /// Length of a tape laid around it, which bridges hollows, metres.
    #[must_use]
    pub fn tape(&self) -> f64 {
        let next = self.hull.iter().skip(1).chain(self.hull.first());
        self.hull.iter().zip(next).map(|(a, b)| (b - a).norm()).sum()
    }

    /// Does the tape run around this point?
    #[must_use]
    pub fn holds(&self, p: Vec2) -> bool {
        let next = self.hull.iter().skip(1).chain(self.hull.first());
        self.hull.len() > 2 && self.hull.iter().zip(next).all(|(a, b)| (b - a).perp(&(p - a)) >= 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::super::surface::tests::tube;
    use super::*;

    #[test]
    fn two_tubes_are_two_rings_and_a_slit_tube_is_open() {
        let mut both = tube(360, 4, 0.1, 1.0);
        let first = both.points.len() as u32;
        let other = tube(360, 4, 0.05, 1.0);
        both.points.extend(other.points.iter().map(|p| p + Vec3::new(0.5, 0.0, 0.0)));
        both.triangles.extend(other.triangles.iter().map(|t| t.map(|v| v + first)));
        let found = rings(&both, 0.4);
        assert_eq!(found.len(), 2);
        let trunk = found.iter().find(|r| r.holds(Vec2::new(0.02, -0.03))).expect("trunk");
        for girth in [trunk.along(), trunk.tape()] {
            assert!((girth - std::f64::consts::TAU * 0.1).abs() < 1e-4, "{girth}");
        }
        assert!(found.iter().all(|r| r.closed) && !trunk.holds(Vec2::new(0.5, 0.0)));
        let mut slit = tube(360, 4, 0.1, 1.0);
        slit.triangles.retain(|t| !t.contains(&0) && !t.contains(&360) && !t.contains(&720));
        assert!(rings(&slit, 0.4).iter().all(|r| !r.closed));
    }
}
