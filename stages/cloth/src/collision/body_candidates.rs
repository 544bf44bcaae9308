//! Candidate pairs of cloth and body, with their distances when they were listed.
//!
//! A pair whose distance has not been used up by motion since then need not be computed.

use crate::Vec3;
use crate::collision::body::Body;
use crate::collision::broad_phase::aabb::Aabb;
use crate::collision::broad_phase::proximity_list::{BodyFeature, ProximityLists, ROUND_DOWN};
use crate::collision::narrow_phase::candidates::{FaceFeatures, LinearMotion, MovingFace, PairGeometry, swept};
use crate::collision::narrow_phase::distance::{point_triangle, point_triangle_gap, segment_gap, segments};
use crate::collision::tuning::{
    PAIR_DISTANCE_BOUNDS, PARALLEL_EDGE_SINE_SQUARED, PARALLEL_EDGES_ONLY_STOP, PROXIMITY_LIST_MARGIN,
    PROXIMITY_LIST_STEP_LIMIT,
};

/// A candidate pair of cloth and body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BodyPair<const N: usize> {
    /// Vertices of the cloth, then those of the body (a triangle of the body by its index).
    pub vertices: [u32; N],
    /// Distance when the pair was listed, or a lower bound of it, m.
    distance: f32,
    /// The pair consists of nearly parallel edges. Their nearest places jump from end to end, and the vertices of the
    /// cloth push all the same. So such edges only stop each other.
    is_parallel: bool,
}

impl<const N: usize> BodyPair<N> {
    fn new(vertices: [u32; N], distance: f64) -> Self {
        // A smaller distance only lets more pairs be computed.
        #[allow(clippy::cast_possible_truncation)]
        Self { vertices, distance: (ROUND_DOWN * distance) as f32, is_parallel: false }
    }

    /// A lower bound of the distance after the first `cloth` vertices have moved, m; `None` where it is within
    /// `reach`.
    #[inline]
    pub fn distance_beyond(&self, cloth: usize, moved: &[f64], reach: f64) -> Option<f64> {
        if !PAIR_DISTANCE_BOUNDS.is_on() {
            return None;
        }
        let most = self.vertices[..cloth].iter().fold(0.0, |m: f64, v| m.max(moved[*v as usize]));
        Some(f64::from(self.distance) - most).filter(|least| *least > reach)
    }
}

/// Candidate pairs of cloth and body.
#[derive(Clone, Debug, Default)]
pub(crate) struct BodyCandidates {
    /// A cloth vertex and a body triangle.
    pub points: Vec<BodyPair<2>>,
    /// The ends of a cloth edge and the ends of a body edge.
    pub edges: Vec<BodyPair<4>>,
    /// The corners of a cloth triangle and a body vertex.
    pub faces: Vec<BodyPair<4>>,
    /// Positions of the cloth when the pairs were listed.
    listed_positions: Vec<Vec3>,
    proximity: ProximityLists,
}

impl FaceFeatures {
    /// The vector along edge `k`, m.
    #[inline]
    pub(crate) fn edge_vector(&self, k: usize) -> Vec3 {
        self.at[(k + 1) % 3] - self.at[k]
    }

    /// Distance between edge `i` and another edge, m.
    pub(crate) fn edge_gap(&self, i: usize, other: [&Vec3; 2]) -> f64 {
        segment_gap([&self.at[i], &self.at[(i + 1) % 3]], other)
    }
}

#[inline]
fn point_in(b: &Aabb, p: &Vec3) -> bool {
    b.meets(&Aabb::of_one(p))
}

/// Do edges along these vectors count as parallel?
fn are_parallel(u: &Vec3, v: &Vec3) -> bool {
    PARALLEL_EDGES_ONLY_STOP.is_on()
        && u.cross(v).norm_squared() < PARALLEL_EDGE_SINE_SQUARED.get() * (u.norm_squared() * v.norm_squared())
}

/// The length of a vector, m. It is infinite where the vector is not a number, so that such a vertex meets everything.
#[inline]
fn length(v: &Vec3) -> f64 {
    let length = v.norm();
    if length.is_nan() { f64::INFINITY } else { length }
}

/// A moving cloth face and the region in which it may meet a body.
struct FaceNeighbourhood {
    moving: MovingFace,
    /// The box that the face sweeps, grown by the reach.
    bounds: Aabb,
    edges: [Aabb; 3],
    /// Unit normal of the face, or zero.
    normal: Vec3,
    /// Lengths of the moves of the vertices, m.
    lengths: [f64; 3],
    longest: f64,
    reach: f64,
}

impl FaceNeighbourhood {
    fn new(moving: MovingFace, lengths: [f64; 3], reach: f64) -> Self {
        Self {
            bounds: moving.swept(reach),
            edges: [0, 1, 2].map(|k| swept(&moving.face.edge_box(k), &moving.edge_move(k), reach)),
            normal: crate::unit_normal(moving.face.at).unwrap_or_else(Vec3::zeros),
            lengths,
            longest: lengths[0].max(lengths[1]).max(lengths[2]),
            moving,
            reach,
        }
    }

    #[inline]
    fn face(&self) -> &FaceFeatures {
        &self.moving.face
    }

    /// Do these places lie on one side of the face's plane, beyond its reach during the motion?
    #[inline]
    fn excludes(&self, places: &[&Vec3]) -> bool {
        let (far, at) = (self.reach + self.longest, &self.face().at[0]);
        let height = |p: &Vec3| self.normal.dot(&(p - at));
        places.iter().all(|p| height(p) > far) || places.iter().all(|p| height(p) < -far)
    }
}

impl BodyCandidates {
    /// Removes all pairs.
    pub fn remove_all(&mut self) {
        self.points.clear();
        self.edges.clear();
        self.faces.clear();
    }

    /// Are there no pairs?
    pub fn is_empty(&self) -> bool {
        self.points.is_empty() && self.edges.is_empty() && self.faces.is_empty()
    }

    /// Adds a vertex of the cloth and a triangle of the body with a lower bound of their distance, m.
    pub(crate) fn add_point(&mut self, v: u32, g: u32, distance: f64) {
        self.points.push(BodyPair::new([v, g], distance));
    }

    /// Adds edge `i` of a cloth face and an edge of the body along the vector `direction`.
    pub(crate) fn add_edge(&mut self, a: &FaceFeatures, i: usize, q: [u32; 2], direction: &Vec3, distance: f64) {
        let p = a.edge(i);
        let is_parallel = are_parallel(&a.edge_vector(i), direction);
        self.edges.push(BodyPair { is_parallel, ..BodyPair::new([p[0], p[1], q[0], q[1]], distance) });
    }

    /// Adds a cloth face and a vertex of the body.
    pub(crate) fn add_face(&mut self, a: &FaceFeatures, w: u32, distance: f64) {
        let [p, q, r] = a.corners;
        self.faces.push(BodyPair::new([p, q, r, w], distance));
    }

    /// Lists the pairs that come nearer than `feature_reach` along a motion, and pairs of a cloth vertex nearer than
    /// `vertex_reach`, m.
    ///
    /// `edge` is the mean edge of the cloth, m.
    pub fn list(&mut self, motion: &LinearMotion<'_>, body: &Body, [feature_reach, vertex_reach]: [f64; 2], edge: f64) {
        self.remove_all();
        let mut proximity = std::mem::take(&mut self.proximity);
        let step_lengths: Vec<f64> = motion.step.iter().map(length).collect();
        self.listed_positions.clear();
        self.listed_positions.extend_from_slice(motion.x);
        let margin = if motion.longest > PROXIMITY_LIST_STEP_LIMIT.get() * edge {
            0.0
        } else {
            PROXIMITY_LIST_MARGIN.get() * edge
        };
        proximity.resize(motion.x.len(), motion.topology.faces.len());
        for f in (0u32..).take(motion.topology.faces.len()) {
            let moving = MovingFace::of(motion.topology, f, motion.x, motion.step);
            let (a, l) = (&moving.face, moving.face.corners.map(|v| step_lengths[v as usize]));
            let distance = body.bounds.gap(&Aabb::of_three(&a.at)) - l[0].max(l[1]).max(l[2]);
            if distance > vertex_reach {
                continue;
            }
            for k in (0..3).filter(|k| a.owns_vertex(*k)) {
                self.list_vertex(&moving, k, [vertex_reach, margin, l[k]], &mut proximity, body);
            }
            if distance <= feature_reach {
                let mut proximity = proximity.face(f, a, [feature_reach, margin], &l, body).peekable();
                // Most faces have no feature of the body beside them.
                if proximity.peek().is_some() {
                    let face = FaceNeighbourhood::new(moving, l, feature_reach);
                    proximity.for_each(|feature| self.add_feature(&face, feature, body));
                }
            }
        }
        self.proximity = proximity;
    }

    /// Adds the triangles of the body that come near vertex `k` of a moving face.
    ///
    /// The array holds the reach, the margin of the proximity list and the length of the vertex's move, m.
    fn list_vertex(
        &mut self,
        a: &MovingFace,
        k: usize,
        [vertex_reach, margin, l]: [f64; 3],
        proximity: &mut ProximityLists,
        body: &Body,
    ) {
        let (v, p, d) = (a.face.corners[k], &a.face.at[k], &a.by[k]);
        let place = swept(&Aabb::of_one(p), &Aabb::of_one(d), vertex_reach);
        if !body.bounds.meets(&place) {
            return;
        }
        for g in proximity.point(v, p, vertex_reach + l, margin, body).filter(|g| place.meets(&body.boxes[*g as usize]))
        {
            let distance = body.point_gap(p, g);
            if distance <= vertex_reach + l {
                self.add_point(v, g, distance);
            }
        }
    }

    /// Adds a vertex of the body against the face, or an edge of the body against one of its edges, if they come
    /// near.
    fn add_feature(&mut self, face: &FaceNeighbourhood, feature: BodyFeature, body: &Body) {
        let (a, l) = (face.face(), &face.lengths);
        match feature {
            BodyFeature::Corner(w) => {
                let p = &body.positions[w as usize];
                if point_in(&face.bounds, p) && !face.excludes(&[p]) {
                    let distance = point_triangle_gap(p, a.at.each_ref());
                    if distance <= face.reach + face.longest {
                        self.add_face(a, w, distance);
                    }
                }
            }
            BodyFeature::Edge(i, ends) => {
                let (i, [p, q]) = (usize::from(i), ends.map(|w| &body.positions[w as usize]));
                if face.edges[i].meets(&Aabb::of_two(p, q)) && !face.excludes(&[p, q]) {
                    let distance = a.edge_gap(i, [p, q]);
                    if distance <= face.reach + l[i].max(l[(i + 1) % 3]) {
                        self.add_edge(a, i, ends, &(q - p), distance);
                    }
                }
            }
        }
    }

    /// Writes the distance of each vertex from its position when the pairs were listed, m.
    pub fn displacements(&self, x: &[Vec3], out: &mut Vec<f64>) {
        out.clear();
        out.resize(x.len(), 0.0);
        out.iter_mut().zip(x.iter().zip(&self.listed_positions)).for_each(|(m, (p, q))| *m = (p - q).norm());
    }

    /// The smallest distance of a vertex when the pairs were listed, m; infinite without any.
    pub fn smallest_distance(&self) -> f64 {
        self.points.iter().fold(f64::INFINITY, |d, p| d.min(f64::from(p.distance)))
    }

    /// Geometry of the pairs of a cloth vertex and a body triangle, and their places on the body.
    pub fn point_gaps<'a>(&'a self, x: &'a [Vec3], body: &'a Body) -> impl Iterator<Item = (PairGeometry, Vec3)> + 'a {
        self.points.iter().map(|p| p.point_gap(x, body))
    }

    /// Geometry of the pairs of a cloth edge and a body edge, and their places on the body.
    pub fn edge_gaps<'a>(&'a self, x: &'a [Vec3], body: &'a Body) -> impl Iterator<Item = (PairGeometry, Vec3)> + 'a {
        self.edges.iter().map(|e| e.edge_gap(x, body))
    }

    /// Geometry of the pairs of a cloth triangle and a body vertex, and their places on the body.
    pub fn face_gaps<'a>(&'a self, x: &'a [Vec3], body: &'a Body) -> impl Iterator<Item = (PairGeometry, Vec3)> + 'a {
        self.faces.iter().map(|f| f.face_gap(x, body))
    }
}

impl BodyPair<2> {
    /// Geometry of a cloth vertex and a body triangle, and the place on the body.
    #[inline]
    pub fn point_gap(&self, x: &[Vec3], body: &Body) -> (PairGeometry, Vec3) {
        let [v, g] = self.vertices;
        let [a, b, c] = body.triangle(g);
        let p = x[v as usize];
        let w = point_triangle(&p, &a, &b, &c);
        let place = a * w[0] + b * w[1] + c * w[2];
        let gap = PairGeometry {
            vertices: [v, g, u32::MAX, u32::MAX],
            weights: [1.0, 0.0, 0.0, 0.0],
            separation: p - place,
            is_redundant: body.has_nearer_coplanar_face(g, &w, &p, &(p - place)),
        };
        (gap, place)
    }
}

impl BodyPair<4> {
    /// Geometry of a cloth edge and a body edge, and the place on the body.
    #[inline]
    pub fn edge_gap(&self, x: &[Vec3], body: &Body) -> (PairGeometry, Vec3) {
        let [a, b, p, q] = self.vertices;
        let (xa, xb) = (x[a as usize], x[b as usize]);
        let (yp, yq) = (body.positions[p as usize], body.positions[q as usize]);
        let [s, t] = segments(&xa, &xb, &yp, &yq);
        let place = yp + (yq - yp) * t;
        let d = xa + (xb - xa) * s - place;
        (
            PairGeometry {
                vertices: self.vertices,
                weights: [1.0 - s, s, 0.0, 0.0],
                separation: d,
                is_redundant: self.is_parallel,
            },
            place,
        )
    }

    /// Geometry of a cloth triangle and a body vertex, and the place of that vertex.
    #[inline]
    pub fn face_gap(&self, x: &[Vec3], body: &Body) -> (PairGeometry, Vec3) {
        let [a, b, c, w] = self.vertices;
        let place = body.positions[w as usize];
        let [xa, xb, xc] = crate::pick3(x, &[a, b, c]);
        let s = point_triangle(&place, &xa, &xb, &xc);
        let d = xa * s[0] + xb * s[1] + xc * s[2] - place;
        (
            PairGeometry {
                vertices: self.vertices,
                weights: [s[0], s[1], s[2], 0.0],
                separation: d,
                is_redundant: false,
            },
            place,
        )
    }
}
