//! Lists of primitives that are near each other, kept until the motion since their making uses up the slack.

use super::beside::Beside;
use super::body::Body;
use super::closest::{heights, point_triangle, point_triangle_gap, segment_gap, segments};
use super::tree::{Aabb, least, meet_moving, most};
use crate::Vec3;
use crate::topology::Topology;

/// Vertex–triangle and edge–edge pairs; vertex numbers throughout.
#[derive(Clone, Debug, Default)]
pub(crate) struct Near {
    /// Vertex, triangle corners (cloth).
    pub points: Vec<[u32; 4]>,
    /// Ends of two cloth edges.
    pub edges: Vec<[u32; 4]>,
    /// Cloth vertex, body triangle.
    pub body_points: Vec<[u32; 2]>,
    /// Ends of a cloth edge, ends of a body edge.
    pub body_edges: Vec<[u32; 4]>,
    /// Are they nearly parallel? Their nearest places jump from end to end then, and the cloth's vertices push all the same; so
    /// they only stop each other.
    body_along: Vec<bool>,
    /// Cloth triangle corners, body vertex.
    pub body_faces: Vec<[u32; 4]>,
    beside: Beside,
}

/// What one face brings to its pairs: its corners, and the vertices and edges it owns.
pub(super) struct Owned {
    pub(super) corners: [u32; 3],
    pub(super) at: [Vec3; 3],
    bits: u8,
}

impl Owned {
    #[inline]
    fn of(t: &Topology, f: u32, x: &[Vec3]) -> Self {
        let corners = t.faces[f as usize];
        Self { corners, at: crate::pick3(x, &corners), bits: t.owned[f as usize] }
    }

    #[inline]
    pub(super) fn owns_vertex(&self, k: usize) -> bool {
        self.bits & (1 << k) != 0
    }

    #[inline]
    pub(super) fn owns_edge(&self, k: usize) -> bool {
        self.bits & (8 << k) != 0
    }

    #[inline]
    pub(super) fn edge(&self, k: usize) -> [u32; 2] {
        [self.corners[k], self.corners[(k + 1) % 3]]
    }

    /// From one end of an edge to the other.
    #[inline]
    fn run(&self, k: usize) -> Vec3 {
        self.at[(k + 1) % 3] - self.at[k]
    }

    #[inline]
    pub(super) fn edge_box(&self, k: usize) -> Aabb {
        Aabb::of_two(&self.at[k], &self.at[(k + 1) % 3])
    }

    /// The box of the whole face, grown.
    #[inline]
    pub(super) fn bounds(&self, reach: f64) -> Aabb {
        Aabb::of_three(&self.at).grown(reach)
    }
}

#[inline]
fn point_in(b: &Aabb, p: &Vec3) -> bool {
    b.meets(&Aabb { low: *p, high: *p })
}

/// A face on its way: corners, boxes of its vertices' and edges' places and moves.
pub(super) struct Moving {
    pub(super) owned: Owned,
    pub(super) by: [Vec3; 3],
}

impl Moving {
    #[inline]
    pub(super) fn of(t: &Topology, f: u32, x: &[Vec3], step: &[Vec3]) -> Self {
        let owned = Owned::of(t, f, x);
        let by = crate::pick3(step, &owned.corners);
        Self { owned, by }
    }

    #[inline]
    pub(super) fn edge_move(&self, k: usize) -> Aabb {
        Aabb::of_two(&self.by[k], &self.by[(k + 1) % 3])
    }

    /// Where the face gets to, grown.
    #[inline]
    fn swept(&self, reach: f64) -> Aabb {
        swept(&Aabb::of_three(&self.owned.at), &Aabb::of_three(&self.by), reach)
    }
}

/// Where a box gets to along a step, grown.
#[inline]
fn swept(b: &Aabb, d: &Aabb, reach: f64) -> Aabb {
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

/// What is beside a triangle is kept for moves of this share of an edge, unless steps are longer than this share.
const MARGIN: f64 = 0.12;
const QUICK: f64 = 0.3;

/// A face on its way, and how far it reaches for a body.
struct Reaching {
    moving: Moving,
    /// Boxes of the face and its edges on the way and near it.
    bounds: Aabb,
    edges: [Aabb; 3],
    /// Of the face, of length one or none.
    normal: Vec3,
    /// Moves of the vertices, m.
    lengths: [f64; 3],
    longest: f64,
    reach: f64,
}

impl Reaching {
    fn new(moving: Moving, bounds: Aabb, lengths: [f64; 3], longest: f64, reach: f64) -> Self {
        Self {
            bounds,
            edges: [0, 1, 2].map(|k| swept(&moving.owned.edge_box(k), &moving.edge_move(k), reach)),
            normal: crate::unit_normal(moving.owned.at).unwrap_or_else(Vec3::zeros),
            lengths,
            longest,
            moving,
            reach,
        }
    }

    #[inline]
    fn owned(&self) -> &Owned {
        &self.moving.owned
    }

    /// Does what has these heights over the face's plane lie on one side of it, farther than it reaches on its way?
    #[inline]
    fn passes(&self, heights: &[f64]) -> bool {
        let far = self.reach + self.longest;
        heights.iter().all(|h| *h > far) || heights.iter().all(|h| *h < -far)
    }
}

/// Between an edge of one face and one of another.
fn edge_gap(a: &Owned, i: usize, b: &Owned, j: usize) -> f64 {
    segment_gap([&a.at[i], &a.at[(i + 1) % 3]], [&b.at[j], &b.at[(j + 1) % 3]])
}

/// Square of the sine below which two edges count as parallel.
const PARALLEL: f64 = 1e-3;

fn parallel(u: &Vec3, v: &Vec3) -> bool {
    u.cross(v).norm_squared() < PARALLEL * (u.norm_squared() * v.norm_squared())
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
                if meet_moving(&bounds.grown(reach), moves, &Aabb { low: p, high: p }, &Aabb { low: d, high: d }) {
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

    pub(super) fn clear_body(&mut self) {
        self.body_points.clear();
        self.body_edges.clear();
        self.body_along.clear();
        self.body_faces.clear();
    }

    /// Edge `i` of the cloth's face and edge `j` of the body's.
    pub(super) fn add_body_edge(&mut self, a: &Owned, i: usize, b: &Owned, j: usize) {
        let (p, q) = (a.edge(i), b.edge(j));
        self.body_edges.push([p[0], p[1], q[0], q[1]]);
        self.body_along.push(parallel(&a.run(i), &b.run(j)));
    }

    /// Cloth–body pairs that come nearer than `reach` along a step, vertices of the cloth those nearer than `wide`; edges of the
    /// cloth are `edge` long.
    pub fn fill_body(&mut self, way: &Way<'_>, body: &Body, [reach, wide]: [f64; 2], edge: f64) {
        self.clear_body();
        let margin = if way.longest > QUICK * edge { 0.0 } else { MARGIN * edge };
        let mut beside = std::mem::take(&mut self.beside);
        beside.cover(way.x.len(), way.topology.faces.len());
        for f in (0u32..).take(way.topology.faces.len()) {
            let moving = Moving::of(way.topology, f, way.x, way.step);
            let far = moving.swept(wide);
            if !body.may_meet(&far) {
                continue;
            }
            let (a, l) = (&moving.owned, moving.by.map(|d| d.norm()));
            for k in (0..3).filter(|k| a.owns_vertex(*k)) {
                let (v, p, d) = (a.corners[k], &a.at[k], &moving.by[k]);
                let place = swept(&Aabb { low: *p, high: *p }, &Aabb { low: *d, high: *d }, wide);
                if body.may_meet(&place) {
                    let beside = beside.point(v, p, wide + l[k], margin, body);
                    let far = |g: u32| body.point_gap(p, g) > wide + l[k];
                    let near = |g: &u32| place.meets(&body.boxes[*g as usize]) && !far(*g);
                    self.body_points.extend(beside.filter(near).map(|g| [v, g]));
                }
            }
            let bounds = moving.swept(reach);
            if body.may_meet(&bounds) {
                let longest = l[0].max(l[1]).max(l[2]);
                let mut beside = beside.face(f, &a.at, reach + longest, margin, body).peekable();
                // Most faces have nothing beside them.
                if beside.peek().is_some() {
                    let face = Reaching::new(moving, bounds, l, longest, reach);
                    beside.for_each(|g| self.add_body_sides(&face, g, body));
                }
            }
        }
        self.beside = beside;
    }

    /// The face itself against the corners of the body's, its edges against the edges.
    fn add_body_sides(&mut self, face: &Reaching, g: u32, body: &Body) {
        if !face.bounds.meets(&body.boxes[g as usize]) {
            return;
        }
        let b = &Owned::of(&body.topology, g, &body.positions);
        let height = heights(&face.owned().at[0], &face.normal, &b.at);
        if face.passes(&height) {
            return;
        }
        let (a, l) = (face.owned(), &face.lengths);
        for k in (0..3).filter(|k| b.owns_vertex(*k)) {
            let far = || point_triangle_gap(&b.at[k], a.at.each_ref()) > face.reach + face.longest;
            if !face.passes(&[height[k]]) && point_in(&face.bounds, &b.at[k]) && !far() {
                self.body_faces.push([a.corners[0], a.corners[1], a.corners[2], b.corners[k]]);
            }
        }
        for j in (0..3).filter(|j| b.owns_edge(*j)) {
            if face.passes(&[height[j], height[(j + 1) % 3]])
                || !body.pressing_edges[body.topology.face_edges[g as usize][j] as usize]
            {
                continue;
            }
            let bounds = b.edge_box(j);
            for i in (0..3).filter(|i| a.owns_edge(*i)) {
                let far = || edge_gap(a, i, b, j) > face.reach + l[i].max(l[(i + 1) % 3]);
                if face.edges[i].meets(&bounds) && !far() {
                    self.add_body_edge(a, i, b, j);
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

    /// Cloth vertices (first) and body triangles (second), and the place on the body.
    pub fn body_point_gaps<'a>(&'a self, x: &'a [Vec3], body: &'a Body) -> impl Iterator<Item = (Gap, Vec3)> + 'a {
        self.body_points.iter().map(|&[v, g]| {
            let [a, b, c] = body.triangle(g);
            let p = x[v as usize];
            let w = point_triangle(&p, &a, &b, &c);
            let place = a * w[0] + b * w[1] + c * w[2];
            let gap = Gap {
                vertices: [v, g, u32::MAX, u32::MAX],
                weights: [1.0, 0.0, 0.0, 0.0],
                d: p - place,
                aside: body.goes_on(g, &w, &p, &(p - place)),
            };
            (gap, place)
        })
    }

    /// Cloth edges (first two) and body edges (last two), and the place on the body.
    pub fn body_edge_gaps<'a>(&'a self, x: &'a [Vec3], body: &'a Body) -> impl Iterator<Item = (Gap, Vec3)> + 'a {
        self.body_edges.iter().zip(&self.body_along).map(|(&[a, b, p, q], along)| {
            let (xa, xb) = (x[a as usize], x[b as usize]);
            let (yp, yq) = (body.positions[p as usize], body.positions[q as usize]);
            let [s, t] = segments(&xa, &xb, &yp, &yq);
            let place = yp + (yq - yp) * t;
            let d = xa + (xb - xa) * s - place;
            (Gap { vertices: [a, b, p, q], weights: [1.0 - s, s, 0.0, 0.0], d, aside: *along }, place)
        })
    }

    /// Cloth triangles (first three) and body vertices (last), and the place on the body.
    pub fn body_face_gaps<'a>(&'a self, x: &'a [Vec3], body: &'a Body) -> impl Iterator<Item = (Gap, Vec3)> + 'a {
        self.body_faces.iter().map(|&[a, b, c, w]| {
            let place = body.positions[w as usize];
            let [xa, xb, xc] = crate::pick3(x, &[a, b, c]);
            let s = point_triangle(&place, &xa, &xb, &xc);
            let d = xa * s[0] + xb * s[1] + xc * s[2] - place;
            (Gap { vertices: [a, b, c, w], weights: [s[0], s[1], s[2], 0.0], d, aside: false }, place)
        })
    }
}
