//! A first closed surface of a field: marching tetrahedra on a regular grid over x ≥ 0.
//!
//! Tetrahedra (six a cube, Kuhn) have no ambiguous case, so the surface is always manifold.

use super::net::Net;
use std::collections::BTreeMap;
use toile_garment::Vec3;

/// A regular grid of nodes; its first plane lies at x = 0.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    /// Lowest corner.
    pub low: Vec3,
    /// Distance of nodes, metres.
    pub step: f64,
    /// Nodes along x, y and z.
    pub nodes: [usize; 3],
}

impl Grid {
    fn index(&self, [i, j, k]: [usize; 3]) -> usize {
        i + self.nodes[0] * (j + self.nodes[1] * k)
    }

    fn place(&self, [i, j, k]: [usize; 3]) -> Vec3 {
        #[allow(clippy::cast_precision_loss)]
        let offset = Vec3::new(i as f64, j as f64, k as f64) * self.step;
        self.low + offset
    }
}

/// The six tetrahedra of a cube: paths from corner 0 to corner 7 along the axes in every order.
const TETRAHEDRA: [[usize; 4]; 6] =
    [[0, 1, 3, 7], [0, 1, 5, 7], [0, 2, 3, 7], [0, 2, 6, 7], [0, 4, 5, 7], [0, 4, 6, 7]];

/// The surface where `field` is zero (negative inside), open along x = 0.
pub fn polygonise(grid: Grid, field: impl Fn(Vec3) -> f64) -> Net {
    let mut values = Vec::with_capacity(grid.nodes.iter().product());
    for k in 0..grid.nodes[2] {
        for j in 0..grid.nodes[1] {
            for i in 0..grid.nodes[0] {
                values.push(field(grid.place([i, j, k])));
            }
        }
    }
    let mut surface =
        Surface { grid, values, crossings: BTreeMap::new(), positions: Vec::new(), triangles: Vec::new() };
    let cells = grid.nodes.map(|n| n.saturating_sub(1));
    for k in 0..cells[2] {
        for j in 0..cells[1] {
            for i in 0..cells[0] {
                surface.cube([i, j, k]);
            }
        }
    }
    Net::new(surface.positions, surface.triangles)
}

/// A grid node: its number and place.
type Node = (usize, Vec3);

struct Surface {
    grid: Grid,
    values: Vec<f64>,
    crossings: BTreeMap<(usize, usize), u32>,
    positions: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
}

impl Surface {
    fn cube(&mut self, [i, j, k]: [usize; 3]) {
        let corners: [Node; 8] = std::array::from_fn(|c| {
            let at = [i + (c & 1), j + ((c >> 1) & 1), k + (c >> 2)];
            (self.grid.index(at), self.grid.place(at))
        });
        let inside = corners.iter().filter(|c| self.values[c.0] < 0.0).count();
        if inside == 0 || inside == 8 {
            return;
        }
        for four in TETRAHEDRA {
            self.tetrahedron(four.map(|c| corners[c]));
        }
    }

    fn tetrahedron(&mut self, nodes: [Node; 4]) {
        let (inside, outside): (Vec<Node>, Vec<Node>) = nodes.into_iter().partition(|n| self.values[n.0] < 0.0);
        match (&inside[..], &outside[..]) {
            ([a], [p, q, r]) | ([p, q, r], [a]) => {
                let corners = [self.crossing(*a, *p), self.crossing(*a, *q), self.crossing(*a, *r)];
                self.triangle(corners, &inside, &outside);
            }
            ([a, b], [p, q]) => {
                let (ap, aq) = (self.crossing(*a, *p), self.crossing(*a, *q));
                let (bp, bq) = (self.crossing(*b, *p), self.crossing(*b, *q));
                self.triangle([ap, aq, bp], &inside, &outside);
                self.triangle([bp, aq, bq], &inside, &outside);
            }
            _ => {}
        }
    }

    fn crossing(&mut self, a: Node, b: Node) -> u32 {
        let (a, b) = if a.0 < b.0 { (a, b) } else { (b, a) };
        let (va, vb) = (self.values[a.0], self.values[b.0]);
        let next = u32::try_from(self.positions.len()).unwrap_or(u32::MAX);
        let id = *self.crossings.entry((a.0, b.0)).or_insert(next);
        if id == next {
            // Kept off the nodes so that no triangle is without area.
            let share = (va / (va - vb)).clamp(0.05, 0.95);
            self.positions.push(a.1 + (b.1 - a.1) * share);
        }
        id
    }

    fn triangle(&mut self, [a, b, c]: [u32; 3], inside: &[Node], outside: &[Node]) {
        let mean = |nodes: &[Node]| {
            nodes.iter().map(|n| n.1).sum::<Vec3>() / f64::from(u32::try_from(nodes.len()).unwrap_or(1))
        };
        let [pa, pb, pc] = [a, b, c].map(|v| self.positions[v as usize]);
        let outwards = (pb - pa).cross(&(pc - pa)).dot(&(mean(outside) - mean(inside))) > 0.0;
        self.triangles.push(if outwards { [a, b, c] } else { [a, c, b] });
    }
}
