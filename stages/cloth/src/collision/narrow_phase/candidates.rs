//! Candidate pairs of cloth primitives, kept until motion uses up the slack of the list.

use crate::Vec3;
use crate::collision::broad_phase::aabb::{Aabb, lower_corner, meet_moving, upper_corner};
use crate::collision::narrow_phase::distance::{point_triangle, segments};
use crate::scene::topology::Topology;

/// Candidate pairs of cloth with cloth, by vertex numbers.
#[derive(Clone, Debug, Default)]
pub(crate) struct ClothCandidates {
    /// A vertex and the three corners of a triangle.
    pub points: Vec<[u32; 4]>,
    /// The ends of two edges.
    pub edges: Vec<[u32; 4]>,
}

/// A face with its corners and the vertices and edges that it owns. Every vertex and edge has one owner.
pub(crate) struct FaceFeatures {
    pub(crate) corners: [u32; 3],
    pub(crate) at: [Vec3; 3],
    pub(crate) bits: u8,
}

impl FaceFeatures {
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

    /// The box of the face, grown by `reach`, m.
    #[inline]
    pub(crate) fn bounds(&self, reach: f64) -> Aabb {
        Aabb::of_three(&self.at).grown(reach)
    }
}

/// A face and the displacements of its corners.
pub(crate) struct MovingFace {
    pub(crate) face: FaceFeatures,
    pub(crate) by: [Vec3; 3],
}

impl MovingFace {
    #[inline]
    pub(crate) fn of(t: &Topology, f: u32, x: &[Vec3], step: &[Vec3]) -> Self {
        let face = FaceFeatures::of(t, f, x);
        let by = crate::pick3(step, &face.corners);
        Self { face, by }
    }

    #[inline]
    pub(crate) fn edge_move(&self, k: usize) -> Aabb {
        Aabb::of_two(&self.by[k], &self.by[(k + 1) % 3])
    }

    /// The box that the face sweeps, grown by `reach`, m.
    #[inline]
    pub(crate) fn swept(&self, reach: f64) -> Aabb {
        swept(&Aabb::of_three(&self.face.at), &Aabb::of_three(&self.by), reach)
    }
}

/// The box that a box sweeps along a step, grown by `reach`, m.
#[inline]
pub(crate) fn swept(b: &Aabb, d: &Aabb, reach: f64) -> Aabb {
    let zero = Vec3::zeros();
    Aabb { low: b.low + lower_corner(&d.low, &zero), high: b.high + upper_corner(&d.high, &zero) }.grown(reach)
}

/// Features that two triangles own and that share no vertex with the other triangle. Most neighbours have none.
struct UnsharedFeatures {
    points: u8,
    edges: u16,
}

impl UnsharedFeatures {
    #[inline]
    fn of(motion: &LinearMotion<'_>, f: u32, g: u32) -> Self {
        let [a, b] = [f, g].map(|f| motion.topology.faces[f as usize]);
        let [owned, others] = [f, g].map(|f| motion.topology.owned[f as usize]);
        let (mut points, mut edges) = (owned & 7 | (others & 7) << 3, 0);
        // Bits of the corners of the second triangle that each corner of the first is joined to.
        let mut joined = [0u8; 3];
        for i in 0..3 {
            for (j, w) in b.iter().enumerate() {
                if motion.groups[a[i] as usize] == motion.groups[*w as usize] {
                    joined[i] |= 1 << j;
                    points &= !(1 << i | 8 << j);
                }
            }
        }
        for i in (0..3).filter(|i| owned & (8 << i) != 0) {
            let ends = joined[i] | joined[(i + 1) % 3];
            // Bit j says that edge j has a joined end.
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

/// Distance vector of a pair and its derivatives.
pub(crate) struct PairGeometry {
    pub vertices: [u32; 4],
    /// Derivatives of the separation with respect to the vertices of the cloth.
    pub weights: [f64; 4],
    /// Vector from the second primitive to the first, m.
    pub separation: Vec3,
    /// Another pair pushes here: the next triangle of a plane, or the vertices of nearly parallel edges.
    pub is_redundant: bool,
}

/// Vertex positions and a step from them, during which every vertex moves in a straight line.
#[derive(Clone, Copy)]
pub(crate) struct LinearMotion<'a> {
    pub x: &'a [Vec3],
    pub step: &'a [Vec3],
    /// Longest move in the step, m.
    pub longest: f64,
    pub topology: &'a Topology,
    /// The stitch group of every vertex. Vertices of one group count as one vertex.
    pub groups: &'a [u32],
}

impl<'a> LinearMotion<'a> {
    pub fn new(x: &'a [Vec3], step: &'a [Vec3], topology: &'a Topology, groups: &'a [u32]) -> Self {
        let longest = crate::longest(step);
        Self { x, step, longest, topology, groups }
    }
}

impl ClothCandidates {
    /// Removes all pairs.
    pub fn remove_all(&mut self) {
        self.points.clear();
        self.edges.clear();
    }

    /// Adds the features of two triangles that come nearer than `reach` along a motion, m.
    pub fn add_pair(&mut self, f: u32, g: u32, motion: &LinearMotion<'_>, reach: f64) {
        let unshared = UnsharedFeatures::of(motion, f, g);
        if unshared.is_none() {
            return;
        }
        let (a, b) = (
            MovingFace::of(motion.topology, f, motion.x, motion.step),
            MovingFace::of(motion.topology, g, motion.x, motion.step),
        );
        let [(low, by), (high, on)] = [&a, &b].map(|m| (m.face.bounds(0.0), Aabb::of_three(&m.by)));
        if !meet_moving(&low.grown(reach), &by, &high, &on) {
            return;
        }
        for (one, other, bounds, moves, bits) in
            [(&a, &b, &high, &on, unshared.points), (&b, &a, &low, &by, unshared.points >> 3)]
        {
            let c = other.face.corners;
            for k in (0..3).filter(|k| bits & (1 << k) != 0) {
                let (p, d) = (one.face.at[k], one.by[k]);
                if meet_moving(&bounds.grown(reach), moves, &Aabb::of_one(&p), &Aabb::of_one(&d)) {
                    self.points.push([one.face.corners[k], c[0], c[1], c[2]]);
                }
            }
        }
        for i in (0..3).filter(|i| unshared.edges & (7 << (3 * i)) != 0) {
            let (p, bounds, moves) = (a.face.edge(i), a.face.edge_box(i).grown(reach), a.edge_move(i));
            for j in (0..3).filter(|j| unshared.edges & (1 << (3 * i + j)) != 0) {
                let q = b.face.edge(j);
                if meet_moving(&bounds, &moves, &b.face.edge_box(j), &b.edge_move(j)) {
                    self.edges.push([p[0], p[1], q[0], q[1]]);
                }
            }
        }
    }

    /// Geometry of the pairs of a vertex and a triangle.
    pub fn point_gaps<'a>(&'a self, x: &'a [Vec3]) -> impl Iterator<Item = PairGeometry> + 'a {
        self.points.iter().map(|vertices| {
            let [p, q, r, s] = crate::pick4(x, vertices);
            let w = point_triangle(&p, &q, &r, &s);
            let d = p - (q * w[0] + r * w[1] + s * w[2]);
            PairGeometry {
                vertices: *vertices,
                weights: [1.0, -w[0], -w[1], -w[2]],
                separation: d,
                is_redundant: false,
            }
        })
    }

    /// Geometry of the pairs of two edges.
    pub fn edge_gaps<'a>(&'a self, x: &'a [Vec3]) -> impl Iterator<Item = PairGeometry> + 'a {
        self.edges.iter().map(|vertices| {
            let [p, q, r, s] = crate::pick4(x, vertices);
            let [t, u] = segments(&p, &q, &r, &s);
            let d = p + (q - p) * t - (r + (s - r) * u);
            PairGeometry { vertices: *vertices, weights: [1.0 - t, t, u - 1.0, -u], separation: d, is_redundant: false }
        })
    }
}
