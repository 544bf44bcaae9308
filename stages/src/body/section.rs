//! Sections of a mesh and the girth a tape gives on them.

use std::collections::{BTreeMap, BTreeSet};
use toile_garment::body::Body;
use toile_garment::{Vec2, Vec3};

/// An outline cut out of a mesh by a plane. It is open where the mesh is.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Its points in order, metres.
    pub points: Vec<Vec3>,
    closed: bool,
    across: [Vec3; 2],
}

/// All outlines where a plane cuts the mesh, open ones first.
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
    let reached: BTreeSet<(u32, u32)> = next.values().copied().collect();
    let open: Vec<(u32, u32)> = next.keys().filter(|edge| !reached.contains(edge)).copied().collect();
    let mut open = open.into_iter();
    while let Some(start) = open.next().or_else(|| next.first_key_value().map(|(edge, _)| *edge)) {
        let mut points = Vec::new();
        let mut at = start;
        while let Some(to) = next.remove(&at) {
            points.push(cut(at));
            at = to;
        }
        let closed = at == start;
        if !closed {
            points.push(cut(at));
        }
        loops.push(Section { points, closed, across });
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

    /// The part of the outline that lies within a distance of a plane between left and right.
    #[must_use]
    pub fn within(&self, middle: f64, half: f64) -> Self {
        let points = self.points.iter().filter(|p| (p.x - middle).abs() <= half).copied().collect();
        Self { points, closed: self.closed, across: self.across }
    }

    /// Distance between the ends of an open outline, metres; 0 for a closed one.
    #[must_use]
    pub fn gap(&self) -> f64 {
        match (self.closed, self.points.first(), self.points.last()) {
            (false, Some(a), Some(b)) => (b - a).norm(),
            _ => 0.0,
        }
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
#[must_use]
pub fn hull(mut points: Vec<Vec2>) -> Vec<Vec2> {
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
        let section = Section { points, closed: true, across: basis(Vec3::y()) };
        assert!((section.girth() - 4.0).abs() < 1e-12);
    }

    #[test]
    fn an_open_mesh_gives_open_outlines_with_their_gap() {
        // A square tube without its last wall.
        let corners = [(0.0, 0.0), (0.3, 0.0), (0.3, 0.4), (0.0, 0.4)];
        let positions: Vec<Vec3> = [0.0, 1.0].iter().flat_map(|y| corners.map(|(x, z)| Vec3::new(x, *y, z))).collect();
        let wall = |k: u32, next: u32| [[k, next + 4, next], [k, k + 4, next + 4]];
        let walls: Vec<[u32; 3]> = (0..3).flat_map(|k| wall(k, k + 1)).collect();
        let found = sections(&positions, &walls, Vec3::new(0.0, 0.5, 0.0), Vec3::y());
        assert_eq!(found.len(), 1);
        assert!((found[0].gap() - 0.4).abs() < 1e-12, "{}", found[0].gap());
        assert!((found[0].girth() - 1.4).abs() < 1e-12);
        let whole: Vec<[u32; 3]> = walls.into_iter().chain(wall(3, 0)).collect();
        let found = sections(&positions, &whole, Vec3::new(0.0, 0.5, 0.0), Vec3::y());
        assert_eq!((found.len(), found[0].gap()), (1, 0.0));
    }
}
