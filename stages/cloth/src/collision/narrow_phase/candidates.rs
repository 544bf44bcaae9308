//! Lists of primitives that are near each other, kept until the motion since their making uses up the slack.

use crate::Vec3;
use crate::collision::broad_phase::bvh::{Aabb, least, meet_moving, most};
use crate::collision::narrow_phase::distance::{point_triangle, segments};
use crate::scene::topology::Topology;

/// Vertex–triangle and edge–edge pairs of cloth; vertex numbers throughout.
#[derive(Clone, Debug, Default)]
pub(crate) struct Near {
    /// Vertex, triangle corners (cloth).
    pub points: Vec<[u32; 4]>,
    /// Ends of two cloth edges.
    pub edges: Vec<[u32; 4]>,
}

/// What one face brings to its pairs: its corners, and the vertices and edges it owns.
pub(crate) struct Owned {
    pub(crate) corners: [u32; 3],
    pub(crate) at: [Vec3; 3],
    pub(crate) bits: u8,
}

impl Owned {
    #[inline]
    fn of(t: &Topology, f: u32, x: &[Vec3]) -> Self {
        let corners = t.faces[f as usize];
        Self { corners, at: crate::pick3(x, &corners), bits: t.owned[f as usize] }
    }

    #[inline]
    pub(crate) fn owns_vertex(&self, k: usize) -> bool {
        self.bits & (1 << k) != 0
    }

    #[inline]
    pub(crate) fn owns_edge(&self, k: usize) -> bool {
        self.bits & (8 << k) != 0
    }

    #[inline]
    pub(crate) fn edge(&self, k: usize) -> [u32; 2] {
        [self.corners[k], self.corners[(k + 1) % 3]]
    }

    #[inline]
    pub(crate) fn edge_box(&self, k: usize) -> Aabb {
        Aabb::of_two(&self.at[k], &self.at[(k + 1) % 3])
    }

    /// The box of the whole face, grown.
    #[inline]
    pub(crate) fn bounds(&self, reach: f64) -> Aabb {
        Aabb::of_three(&self.at).grown(reach)
    }
}

/// A face on its way: corners, boxes of its vertices' and edges' places and moves.
pub(crate) struct Moving {
    pub(crate) owned: Owned,
    pub(crate) by: [Vec3; 3],
}

impl Moving {
    #[inline]
    pub(crate) fn of(t: &Topology, f: u32, x: &[Vec3], step: &[Vec3]) -> Self {
        let owned = Owned::of(t, f, x);
        let by = crate::pick3(step, &owned.corners);
        Self { owned, by }
    }

    #[inline]
    pub(crate) fn edge_move(&self, k: usize) -> Aabb {
        Aabb::of_two(&self.by[k], &self.by[(k + 1) % 3])
    }

    /// Where the face gets to, grown.
    #[inline]
    pub(crate) fn swept(&self, reach: f64) -> Aabb {
        swept(&Aabb::of_three(&self.owned.at), &Aabb::of_three(&self.by), reach)
    }
}

/// Where a box gets to along a step, grown.
#[inline]
pub(crate) fn swept(b: &Aabb, d: &Aabb, reach: f64) -> Aabb {
    let zero = Vec3::zeros();
    Aabb { low: b.low + least(&d.low, &zero), high: b.high + most(&d.high, &zero) }.grown(reach)
}

/// What two triangles own that has no vertex in common with the other: a bit for every vertex of the first and of the second,
/// and for every pair of edges. Of most neighbours there is nothing.
struct Apart {
    points: u8,
    edges: u16,
}

impl Apart {
    #[inline]
    fn of(way: &Way<'_>, f: u32, g: u32) -> Self {
        let [a, b] = [f, g].map(|f| way.topology.faces[f as usize]);
        let [owned, others] = [f, g].map(|f| way.topology.owned[f as usize]);
        let (mut points, mut edges) = (owned & 7 | (others & 7) << 3, 0);
        // Of every corner of the first, the corners of the second that it is joined to.
        let mut joined = [0u8; 3];
        for i in 0..3 {
            for (j, w) in b.iter().enumerate() {
                if way.groups[a[i] as usize] == way.groups[*w as usize] {
                    joined[i] |= 1 << j;
                    points &= !(1 << i | 8 << j);
                }
            }
        }
        for i in (0..3).filter(|i| owned & (8 << i) != 0) {
            let ends = joined[i] | joined[(i + 1) % 3];
            // Bit j: edge j has a joined end.
            let joined = ends | ends >> 1 | (ends & 1) << 2;
            edges |= u16::from(others >> 3 & !joined & 7) << (3 * i);
        }
        Self { points, edges }
    }

    #[inline]
    fn is_none(&self) -> bool {
        self.points == 0 && self.edges == 0
    }
}

/// The gap of a near pair.
pub(crate) struct Gap {
    pub vertices: [u32; 4],
    /// Shares of the vertices of the cloth.
    pub weights: [f64; 4],
    /// From the second primitive to the first.
    pub d: Vec3,
    /// Is it left to others to push here: to the next triangle where a plane goes on beyond an edge, to the vertices of edges
    /// that are parallel?
    pub aside: bool,
}

/// Places, and a step from them.
#[derive(Clone, Copy)]
pub(crate) struct Way<'a> {
    pub x: &'a [Vec3],
    pub step: &'a [Vec3],
    /// The longest move in it, m.
    pub longest: f64,
    pub topology: &'a Topology,
    /// Vertices of one group (stitched together) count as one.
    pub groups: &'a [u32],
}

impl<'a> Way<'a> {
    pub fn new(x: &'a [Vec3], step: &'a [Vec3], topology: &'a Topology, groups: &'a [u32]) -> Self {
        let longest = crate::longest(step);
        Self { x, step, longest, topology, groups }
    }
}

impl Near {
    pub fn clear_own(&mut self) {
        self.points.clear();
        self.edges.clear();
    }

    /// Adds what of two triangles comes nearer than `reach` along a way.
    pub fn add_own(&mut self, f: u32, g: u32, way: &Way<'_>, reach: f64) {
        let apart = Apart::of(way, f, g);
        if apart.is_none() {
            return;
        }
        let (a, b) = (Moving::of(way.topology, f, way.x, way.step), Moving::of(way.topology, g, way.x, way.step));
        let [(low, by), (high, on)] = [&a, &b].map(|m| (m.owned.bounds(0.0), Aabb::of_three(&m.by)));
        if !meet_moving(&low.grown(reach), &by, &high, &on) {
            return;
        }
        for (one, other, bounds, moves, bits) in
            [(&a, &b, &high, &on, apart.points), (&b, &a, &low, &by, apart.points >> 3)]
        {
            let c = other.owned.corners;
            for k in (0..3).filter(|k| bits & (1 << k) != 0) {
                let (p, d) = (one.owned.at[k], one.by[k]);
                if meet_moving(&bounds.grown(reach), moves, &Aabb::of_one(&p), &Aabb::of_one(&d)) {
                    self.points.push([one.owned.corners[k], c[0], c[1], c[2]]);
                }
            }
        }
        for i in (0..3).filter(|i| apart.edges & (7 << (3 * i)) != 0) {
            let (p, bounds, moves) = (a.owned.edge(i), a.owned.edge_box(i).grown(reach), a.edge_move(i));
            for j in (0..3).filter(|j| apart.edges & (1 << (3 * i + j)) != 0) {
                let q = b.owned.edge(j);
                if meet_moving(&bounds, &moves, &b.owned.edge_box(j), &b.edge_move(j)) {
                    self.edges.push([p[0], p[1], q[0], q[1]]);
                }
            }
        }
    }

    /// Cloth vertices and triangles: vertices, weights and the vector of the gap.
    pub fn point_gaps<'a>(&'a self, x: &'a [Vec3]) -> impl Iterator<Item = Gap> + 'a {
        self.points.iter().map(|vertices| {
            let [p, q, r, s] = crate::pick4(x, vertices);
            let w = point_triangle(&p, &q, &r, &s);
            let d = p - (q * w[0] + r * w[1] + s * w[2]);
            Gap { vertices: *vertices, weights: [1.0, -w[0], -w[1], -w[2]], d, aside: false }
        })
    }

    /// Cloth edges and edges.
    pub fn edge_gaps<'a>(&'a self, x: &'a [Vec3]) -> impl Iterator<Item = Gap> + 'a {
        self.edges.iter().map(|vertices| {
            let [p, q, r, s] = crate::pick4(x, vertices);
            let [t, u] = segments(&p, &q, &r, &s);
            let d = p + (q - p) * t - (r + (s - r) * u);
            Gap { vertices: *vertices, weights: [1.0 - t, t, u - 1.0, -u], d, aside: false }
        })
    }
}
