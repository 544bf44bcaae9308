//! Lists of what of the cloth is near the body, and how near it was when they were made: what has not moved since by what
//! it is too far away need not be looked at.

use crate::Vec3;
use crate::collision::body::Body;
use crate::collision::broad_phase::body_distance_bound::Far;
use crate::collision::broad_phase::bvh::Aabb;
use crate::collision::broad_phase::proximity_list::{Beside, DOWN, Side};
use crate::collision::narrow_phase::candidates::{Gap, Moving, Owned, Way, swept};
use crate::collision::narrow_phase::distance::{point_triangle, point_triangle_gap, segment_gap, segments};

/// What is beside a triangle is kept for moves of this share of an edge, unless steps are longer than this share.
const MARGIN: f64 = 0.12;
const QUICK: f64 = 0.3;
/// Square of the sine below which two edges count as parallel.
const PARALLEL: f64 = 1e-3;

/// Cloth and body near each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pair<const N: usize> {
    /// Of the cloth first.
    pub vertices: [u32; N],
    /// How far they were apart when the list was made, or less, m.
    apart: f32,
    /// Are they nearly parallel edges? Their nearest places jump from end to end then, and the cloth's vertices push all the
    /// same; so they only stop each other.
    along: bool,
}

impl<const N: usize> Pair<N> {
    fn new(vertices: [u32; N], apart: f64) -> Self {
        // A smaller distance only lets more be looked at.
        #[allow(clippy::cast_possible_truncation)]
        Self { vertices, apart: (DOWN * apart) as f32, along: false }
    }

    /// The least distance that its first vertices, of the cloth, leave with what each has moved, m, where that is over `reach`.
    #[inline]
    pub fn farther(&self, cloth: usize, moved: &[f64], reach: f64) -> Option<f64> {
        let most = self.vertices[..cloth].iter().fold(0.0, |m: f64, v| m.max(moved[*v as usize]));
        Some(f64::from(self.apart) - most).filter(|least| *least > reach)
    }
}

/// Pairs of cloth and body.
#[derive(Clone, Debug, Default)]
pub(crate) struct Against {
    /// Cloth vertex, body triangle.
    pub points: Vec<Pair<2>>,
    /// Ends of a cloth edge, ends of a body edge.
    pub edges: Vec<Pair<4>>,
    /// Cloth triangle corners, body vertex.
    pub faces: Vec<Pair<4>>,
    /// Where the cloth was when these were listed.
    from: Vec<Vec3>,
    far: Far,
    beside: Beside,
}

impl Owned {
    /// From one end of an edge to the other.
    #[inline]
    pub(crate) fn run(&self, k: usize) -> Vec3 {
        self.at[(k + 1) % 3] - self.at[k]
    }

    /// Between an edge of it and another.
    pub(crate) fn edge_gap(&self, i: usize, other: [&Vec3; 2]) -> f64 {
        segment_gap([&self.at[i], &self.at[(i + 1) % 3]], other)
    }
}

#[inline]
fn point_in(b: &Aabb, p: &Vec3) -> bool {
    b.meets(&Aabb::of_one(p))
}

fn parallel(u: &Vec3, v: &Vec3) -> bool {
    u.cross(v).norm_squared() < PARALLEL * (u.norm_squared() * v.norm_squared())
}

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
    fn new(moving: Moving, lengths: [f64; 3], reach: f64) -> Self {
        Self {
            bounds: moving.swept(reach),
            edges: [0, 1, 2].map(|k| swept(&moving.owned.edge_box(k), &moving.edge_move(k), reach)),
            normal: crate::unit_normal(moving.owned.at).unwrap_or_else(Vec3::zeros),
            lengths,
            longest: lengths[0].max(lengths[1]).max(lengths[2]),
            moving,
            reach,
        }
    }

    #[inline]
    fn owned(&self) -> &Owned {
        &self.moving.owned
    }

    /// Do these places lie on one side of the face's plane, farther than it reaches on its way?
    #[inline]
    fn passes(&self, places: &[&Vec3]) -> bool {
        let (far, at) = (self.reach + self.longest, &self.owned().at[0]);
        let height = |p: &Vec3| self.normal.dot(&(p - at));
        places.iter().all(|p| height(p) > far) || places.iter().all(|p| height(p) < -far)
    }
}

impl Against {
    pub fn clear(&mut self) {
        self.points.clear();
        self.edges.clear();
        self.faces.clear();
    }

    pub fn is_empty(&self) -> bool {
        self.points.is_empty() && self.edges.is_empty() && self.faces.is_empty()
    }

    /// A vertex of the cloth and a triangle of the body, so far apart or farther.
    pub(crate) fn add_point(&mut self, v: u32, g: u32, apart: f64) {
        self.points.push(Pair::new([v, g], apart));
    }

    /// Edge `i` of the cloth's face and an edge of the body, which runs so.
    pub(crate) fn add_edge(&mut self, a: &Owned, i: usize, q: [u32; 2], run: &Vec3, apart: f64) {
        let p = a.edge(i);
        let along = parallel(&a.run(i), run);
        self.edges.push(Pair { along, ..Pair::new([p[0], p[1], q[0], q[1]], apart) });
    }

    /// The cloth's face and a vertex of the body.
    pub(crate) fn add_face(&mut self, a: &Owned, w: u32, apart: f64) {
        let [p, q, r] = a.corners;
        self.faces.push(Pair::new([p, q, r, w], apart));
    }

    /// Pairs that come nearer than `reach` along a step, vertices of the cloth those nearer than `wide`; edges of the cloth
    /// are `edge` long.
    pub fn fill(&mut self, way: &Way<'_>, body: &Body, [reach, wide]: [f64; 2], edge: f64) {
        self.clear();
        let (mut far, mut beside) = (std::mem::take(&mut self.far), std::mem::take(&mut self.beside));
        far.take(way, &self.from);
        self.from.clear();
        self.from.extend_from_slice(way.x);
        let margin = if way.longest > QUICK * edge { 0.0 } else { MARGIN * edge };
        beside.cover(way.x.len(), way.topology.faces.len());
        for f in (0u32..).take(way.topology.faces.len()) {
            let stays = far.stays(f, way, wide, body);
            if stays > wide {
                continue;
            }
            let moving = Moving::of(way.topology, f, way.x, way.step);
            let (a, l) = (&moving.owned, moving.owned.corners.map(|v| far.goes[v as usize]));
            for k in (0..3).filter(|k| a.owns_vertex(*k)) {
                self.fill_point(&moving, k, [wide, margin, l[k]], &mut beside, body);
            }
            if stays <= reach {
                let mut beside = beside.face(f, a, [reach, margin], &l, body).peekable();
                // Most faces have nothing beside them.
                if beside.peek().is_some() {
                    let face = Reaching::new(moving, l, reach);
                    beside.for_each(|side| self.add_side(&face, side, body));
                }
            }
        }
        (self.far, self.beside) = (far, beside);
    }

    /// A vertex of the face on its way, so long, and the triangles that it comes nearer to than so far.
    fn fill_point(&mut self, a: &Moving, k: usize, [wide, margin, l]: [f64; 3], beside: &mut Beside, body: &Body) {
        let (v, p, d) = (a.owned.corners[k], &a.owned.at[k], &a.by[k]);
        let place = swept(&Aabb::of_one(p), &Aabb::of_one(d), wide);
        if !body.may_meet(&place) {
            return;
        }
        for g in beside.point(v, p, wide + l, margin, body).filter(|g| place.meets(&body.boxes[*g as usize])) {
            let apart = body.point_gap(p, g);
            if apart <= wide + l {
                self.add_point(v, g, apart);
            }
        }
    }

    /// The cloth's face against a vertex of the body, or an edge of it against an edge, if they come near on the way.
    fn add_side(&mut self, face: &Reaching, side: Side, body: &Body) {
        let (a, l) = (face.owned(), &face.lengths);
        match side {
            Side::Corner(w) => {
                let p = &body.positions[w as usize];
                if point_in(&face.bounds, p) && !face.passes(&[p]) {
                    let apart = point_triangle_gap(p, a.at.each_ref());
                    if apart <= face.reach + face.longest {
                        self.add_face(a, w, apart);
                    }
                }
            }
            Side::Edge(i, ends) => {
                let (i, [p, q]) = (usize::from(i), ends.map(|w| &body.positions[w as usize]));
                if face.edges[i].meets(&Aabb::of_two(p, q)) && !face.passes(&[p, q]) {
                    let apart = a.edge_gap(i, [p, q]);
                    if apart <= face.reach + l[i].max(l[(i + 1) % 3]) {
                        self.add_edge(a, i, ends, &(q - p), apart);
                    }
                }
            }
        }
    }

    /// How far each vertex is from where it was when the lists were made, m.
    pub fn moved(&self, x: &[Vec3], out: &mut Vec<f64>) {
        out.clear();
        out.resize(x.len(), 0.0);
        out.iter_mut().zip(x.iter().zip(&self.from)).for_each(|(m, (p, q))| *m = (p - q).norm());
    }

    /// The least distance of a vertex when the lists were made, m; infinite where none was near.
    pub fn nearest(&self) -> f64 {
        self.points.iter().fold(f64::INFINITY, |d, p| d.min(f64::from(p.apart)))
    }

    /// Cloth vertices (first) and body triangles (second), and the place on the body.
    pub fn point_gaps<'a>(&'a self, x: &'a [Vec3], body: &'a Body) -> impl Iterator<Item = (Gap, Vec3)> + 'a {
        self.points.iter().map(|p| p.point_gap(x, body))
    }

    /// Cloth edges (first two) and body edges (last two), and the place on the body.
    pub fn edge_gaps<'a>(&'a self, x: &'a [Vec3], body: &'a Body) -> impl Iterator<Item = (Gap, Vec3)> + 'a {
        self.edges.iter().map(|e| e.edge_gap(x, body))
    }

    /// Cloth triangles (first three) and body vertices (last), and the place on the body.
    pub fn face_gaps<'a>(&'a self, x: &'a [Vec3], body: &'a Body) -> impl Iterator<Item = (Gap, Vec3)> + 'a {
        self.faces.iter().map(|f| f.face_gap(x, body))
    }
}

impl Pair<2> {
    /// Of a vertex and a triangle, and the place on the body.
    #[inline]
    pub fn point_gap(&self, x: &[Vec3], body: &Body) -> (Gap, Vec3) {
        let [v, g] = self.vertices;
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
    }
}

impl Pair<4> {
    /// Of two edges, and the place on the body's.
    #[inline]
    pub fn edge_gap(&self, x: &[Vec3], body: &Body) -> (Gap, Vec3) {
        let [a, b, p, q] = self.vertices;
        let (xa, xb) = (x[a as usize], x[b as usize]);
        let (yp, yq) = (body.positions[p as usize], body.positions[q as usize]);
        let [s, t] = segments(&xa, &xb, &yp, &yq);
        let place = yp + (yq - yp) * t;
        let d = xa + (xb - xa) * s - place;
        (Gap { vertices: self.vertices, weights: [1.0 - s, s, 0.0, 0.0], d, aside: self.along }, place)
    }

    /// Of a triangle of the cloth and a corner of the body, which is the place.
    #[inline]
    pub fn face_gap(&self, x: &[Vec3], body: &Body) -> (Gap, Vec3) {
        let [a, b, c, w] = self.vertices;
        let place = body.positions[w as usize];
        let [xa, xb, xc] = crate::pick3(x, &[a, b, c]);
        let s = point_triangle(&place, &xa, &xb, &xc);
        let d = xa * s[0] + xb * s[1] + xc * s[2] - place;
        (Gap { vertices: self.vertices, weights: [s[0], s[1], s[2], 0.0], d, aside: false }, place)
    }
}
