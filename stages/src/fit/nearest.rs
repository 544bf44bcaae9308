//! The nearest point of a surface: a binary tree of boxes over its triangles.

use super::surface::Surface;
use toile_garment::Vec3;

/// Triangles in a leaf.
const LEAF: usize = 4;

/// A tree over the triangles of a surface.
pub struct Nearest<'s> {
    surface: &'s Surface,
    order: Vec<u32>,
    nodes: Vec<Node>,
}

struct Node {
    low: Vec3,
    high: Vec3,
    /// A leaf holds `order[from..to]`; an inner node its two children.
    kind: Kind,
}

enum Kind {
    Leaf(usize, usize),
    Inner(usize, usize),
}

impl<'s> Nearest<'s> {
    /// Builds the tree.
    #[must_use]
    pub fn new(surface: &'s Surface) -> Self {
        let order = (0..surface.triangles.len() as u32).collect();
        let mut tree = Self { surface, order, nodes: Vec::new() };
        if !tree.order.is_empty() {
            tree.grow(0, tree.order.len());
        }
        tree
    }

    fn grow(&mut self, from: usize, to: usize) -> usize {
        let (low, high) = self.bounds(from, to);
        let number = self.nodes.len();
        self.nodes.push(Node { low, high, kind: Kind::Leaf(from, to) });
        if to - from > LEAF {
            let axis = (high - low).imax();
            let surface = self.surface;
            let middle = |t: &u32| surface.corners(*t as usize).iter().map(|p| p[axis]).sum::<f64>();
            self.order[from..to].sort_by(|a, b| middle(a).total_cmp(&middle(b)));
            let half = from + (to - from) / 2;
            let left = self.grow(from, half);
            let right = self.grow(half, to);
            self.nodes[number].kind = Kind::Inner(left, right);
        }
        number
    }

    fn bounds(&self, from: usize, to: usize) -> (Vec3, Vec3) {
        let corners = self.order[from..to].iter().flat_map(|t| self.surface.corners(*t as usize));
        let start = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
        corners.fold(start, |(low, high), p| (low.inf(&p), high.sup(&p)))
    }

    /// Distance from a point to the surface, metres; infinite when there is none.
    #[must_use]
    pub fn distance(&self, p: &Vec3) -> f64 {
        let mut best = f64::INFINITY;
        if !self.nodes.is_empty() {
            self.search(0, p, &mut best);
        }
        best.sqrt()
    }

    fn search(&self, number: usize, p: &Vec3, best: &mut f64) {
        match self.nodes[number].kind {
            Kind::Leaf(from, to) => {
                for t in &self.order[from..to] {
                    let q = closest(p, self.surface.corners(*t as usize));
                    *best = best.min((p - q).norm_squared());
                }
            }
            Kind::Inner(left, right) => {
                let mut both = [left, right].map(|n| (self.gap(n, p), n));
                both.sort_by(|a, b| a.0.total_cmp(&b.0));
                for (gap, child) in both {
                    if gap < *best {
                        self.search(child, p, best);
                    }
                }
            }
        }
    }

    /// Squared distance to a node's box.
    fn gap(&self, number: usize, p: &Vec3) -> f64 {
        let node = &self.nodes[number];
        (p - p.sup(&node.low).inf(&node.high)).norm_squared()
    }
}

/// The point of a triangle nearest to `p`: its foot inside, else the nearest of the three edges.
pub(crate) fn closest(p: &Vec3, [a, b, c]: [Vec3; 3]) -> Vec3 {
    let normal = (b - a).cross(&(c - a));
    let size = normal.norm_squared();
    if size > 0.0 {
        let inside = |from: &Vec3, to: &Vec3| normal.dot(&(to - from).cross(&(p - from))) >= 0.0;
        if inside(&a, &b) && inside(&b, &c) && inside(&c, &a) {
            return p - normal * (normal.dot(&(p - a)) / size);
        }
    }
    let on_edges = [(a, b), (b, c), (c, a)].map(|(from, to)| on_edge(p, &from, &to));
    let distance = |q: &Vec3| (p - q).norm_squared();
    on_edges.into_iter().min_by(|x, y| distance(x).total_cmp(&distance(y))).unwrap_or(a)
}

fn on_edge(p: &Vec3, a: &Vec3, b: &Vec3) -> Vec3 {
    let along = b - a;
    let length = along.norm_squared();
    if length > 0.0 { a + along * ((p - a).dot(&along) / length).clamp(0.0, 1.0) } else { *a }
}

#[cfg(test)]
mod tests {
    use super::super::surface::tests::tube;
    use super::*;

    #[test]
    fn agrees_with_looking_at_every_triangle() {
        let surface = tube(17, 6, 0.2, 0.5);
        let tree = Nearest::new(&surface);
        for k in 0..60 {
            let t = f64::from(k);
            let p = Vec3::new(0.4 * libm::sin(t), 0.7 * libm::sin(1.7 * t), 0.4 * libm::cos(2.3 * t));
            let all = (0..surface.triangles.len()).map(|i| (p - closest(&p, surface.corners(i))).norm());
            assert_eq!(tree.distance(&p), all.fold(f64::INFINITY, f64::min));
        }
        assert_eq!(Nearest::new(&Surface::default()).distance(&Vec3::zeros()), f64::INFINITY);
    }

    #[test]
    fn finds_foot_edge_and_corner() {
        let t = [Vec3::zeros(), Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0)];
        assert_eq!(closest(&Vec3::new(0.2, 0.2, 3.0), t), Vec3::new(0.2, 0.2, 0.0));
        assert_eq!(closest(&Vec3::new(0.5, -2.0, 0.0), t), Vec3::new(0.5, 0.0, 0.0));
        assert_eq!(closest(&Vec3::new(-1.0, -1.0, 0.0), t), Vec3::zeros());
    }
}
