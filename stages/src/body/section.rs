//! Sections of a mesh and the girth a tape gives on them.

use std::collections::BTreeMap;
use toile_garment::body::Body;
use toile_garment::{Vec2, Vec3};

/// A closed outline cut out of a mesh by a plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Its points in order, metres.
    pub points: Vec<Vec3>,
    across: [Vec3; 2],
}

/// All closed outlines where a plane cuts the mesh.
#[must_use]
pub fn sections(positions: &[Vec3], triangles: &[[u32; 3]], point: Vec3, normal: Vec3) -> Vec<Section> {
    let side = |v: u32| positions.get(v as usize).map_or(f64::NAN, |p| (p - point).dot(&normal));
    let mut next: BTreeMap<(u32, u32), (u32, u32)> = BTreeMap::new();
    for t in triangles {
        let mut ends = [None, None];
        for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
            match (side(a) < 0.0, side(b) < 0.0) {
                (true, false) => ends[0] = Some((a.min(b), a.max(b))),
                (false, true) => ends[1] = Some((a.min(b), a.max(b))),
                _ => {}
            }
        }
        if let [Some(from), Some(to)] = ends {
            next.insert(from, to);
        }
    }
    let across = basis(normal);
    let cut = |(a, b): (u32, u32)| {
        let (sa, sb) = (side(a), side(b));
        positions[a as usize] + (positions[b as usize] - positions[a as usize]) * (sa / (sa - sb))
    };
    let mut loops = Vec::new();
    while let Some((start, _)) = next.first_key_value() {
        let mut points = Vec::new();
        let mut at = *start;
        while let Some(to) = next.remove(&at) {
            points.push(cut(at));
            at = to;
        }
        loops.push(Section { points, across });
    }
    loops
}

/// Two unit vectors across a normal.
fn basis(normal: Vec3) -> [Vec3; 2] {
    let n = normal.normalize();
    let helper = if n.x.abs() < 0.9 { Vec3::x() } else { Vec3::z() };
    let u = (helper - n * n.dot(&helper)).normalize();
    [u, n.cross(&u)]
}

impl Section {
    /// The girth of a tape drawn tight: length of the convex hull's edge, metres.
    #[must_use]
    pub fn girth(&self) -> f64 {
        let hull =
            hull(self.points.iter().map(|p| Vec2::new(p.dot(&self.across[0]), p.dot(&self.across[1]))).collect());
        let turned = hull.iter().skip(1).chain(hull.first());
        hull.iter().zip(turned).map(|(a, b)| (b - a).norm()).sum()
    }

    /// Middle of the outline's bounding box, metres.
    #[must_use]
    pub fn centre(&self) -> Vec3 {
        let (low, high) = self.bounds();
        (low + high) * 0.5
    }

    /// Lowest and highest coordinates, metres.
    #[must_use]
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let far = Vec3::repeat(f64::INFINITY);
        self.points.iter().fold((far, -far), |(low, high), p| (low.inf(p), high.sup(p)))
    }
}

/// Convex hull, counter-clockwise (Andrew's monotone chain).
fn hull(mut points: Vec<Vec2>) -> Vec<Vec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let mut chain: Vec<Vec2> = Vec::new();
    let rising = points.iter();
    let falling = points.iter().rev().skip(1);
    let mut floor = 1;
    for (i, p) in rising.chain(falling).enumerate() {
        if i == points.len() {
            floor = chain.len();
        }
        while chain.len() > floor {
            let (a, b) = (chain[chain.len() - 2], chain[chain.len() - 1]);
            if (b - a).perp(&(p - a)) > 0.0 {
                break;
            }
            chain.pop();
        }
        chain.push(*p);
    }
    chain.pop();
    chain
}

/// The outline nearest to a point among those where a plane through it cuts the mesh.
#[must_use]
pub fn section_near(positions: &[Vec3], triangles: &[[u32; 3]], point: Vec3, normal: Vec3) -> Option<Section> {
    sections(positions, triangles, point, normal)
        .into_iter()
        .min_by(|a, b| (a.centre() - point).norm().total_cmp(&(b.centre() - point).norm()))
}

/// The horizontal outline of the torso at a height (of one leg under the crotch; with the arms above the armpits).
#[must_use]
pub fn section_at(body: &Body, height: f64) -> Option<Section> {
    section_near(&body.positions, &body.triangles, Vec3::new(0.0, height, 0.0), Vec3::y())
}

/// The girth a tape gives around the torso at a height, metres; zero where there is no body.
#[must_use]
pub fn girth_at(body: &Body, height: f64) -> f64 {
    section_at(body, height).map_or(0.0, |s| s.girth())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn girth_of_a_square_section_spans_its_dents() {
        let points = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.5, 0.4), (0.0, 1.0)];
        let points = points.map(|(x, z)| Vec3::new(x, 2.0, z)).to_vec();
        let section = Section { points, across: basis(Vec3::y()) };
        assert!((section.girth() - 4.0).abs() < 1e-12);
    }
}
