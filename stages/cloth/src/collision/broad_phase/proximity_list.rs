//! Proximity lists (Verlet lists) of a body at rest: its features beside each vertex and triangle of the cloth.
//!
//! Lists are kept with their distances while the cloth stays near the place they were made for, because a walk
//! through the body's tree is the most expensive query.

use crate::Vec3;
use crate::collision::body::Body;
use crate::collision::broad_phase::aabb::Aabb;
use crate::collision::narrow_phase::candidates::FaceFeatures;
use crate::collision::narrow_phase::distance::{plane_gap, point_triangle_gap};
use crate::collision::tuning::{PROXIMITY_LIST_EXCESS, PROXIMITY_LISTS, SHORT_PROXIMITY_LIST};

/// Factor that rounds a distance to single precision, never upwards.
pub(crate) const ROUND_DOWN: f64 = 1.0 - 1e-6;

/// The features beside a vertex or a triangle.
#[derive(Clone, Debug)]
struct ProximityList<const N: usize, T> {
    /// Corners of the cloth when the list was made.
    at: [Vec3; N],
    /// Radius of the list, m: it holds every feature nearer than this.
    radius: f64,
    /// Features in the order of the body's tree, and lower bounds of their distances, m.
    features: Vec<(T, f32)>,
}

/// A feature of the body that may meet a triangle of the cloth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum BodyFeature {
    /// A vertex of the body, against the face.
    Corner(u32),
    /// An edge of the body between these vertices, against that edge of the triangle.
    Edge(u8, [u32; 2]),
}

impl<const N: usize, T: Copy> ProximityList<N, T> {
    /// A list that is not valid anywhere.
    fn empty() -> Box<Self> {
        Box::new(Self { at: [Vec3::zeros(); N], radius: 0.0, features: Vec::new() })
    }

    /// Distance of each corner from its position when the list was made, m; `None` if the list is not valid for
    /// `reach`.
    fn moved(&self, x: &[Vec3; N], reach: f64) -> Option<[f64; N]> {
        let moved: [f64; N] = std::array::from_fn(|k| (self.at[k] - x[k]).norm());
        // A list made for positions that are not numbers is never valid.
        let near = moved.iter().all(|m| m + reach <= self.radius);
        let narrow =
            self.radius <= PROXIMITY_LIST_EXCESS.get() * reach || self.features.len() <= SHORT_PROXIMITY_LIST.get();
        let is_valid = PROXIMITY_LISTS.is_on() && self.radius > 0.0 && near && narrow;
        is_valid.then_some(moved)
    }

    /// Empties the list, for new corners and a new radius, m.
    fn restart(&mut self, x: &[Vec3; N], radius: f64) {
        (self.at, self.radius) = (*x, radius);
        self.features.clear();
    }

    /// Adds a feature at a distance, m, if it is within the radius.
    fn add(&mut self, feature: T, distance: f64) {
        if distance <= self.radius {
            // A smaller distance only lets more features be tested.
            #[allow(clippy::cast_possible_truncation)]
            self.features.push((feature, (ROUND_DOWN * distance) as f32));
        }
    }
}

/// Proximity lists of the vertices and triangles of the cloth. Parts that never were near the body have none.
#[derive(Clone, Debug, Default)]
pub(crate) struct ProximityLists {
    /// Triangles of the body beside each vertex of the cloth.
    points: Vec<Option<Box<ProximityList<1, u32>>>>,
    /// Features of the body beside each triangle of the cloth.
    faces: Vec<Option<Box<ProximityList<3, BodyFeature>>>>,
}

impl ProximityLists {
    /// Makes room for these numbers of vertices and triangles.
    pub fn resize(&mut self, vertices: usize, faces: usize) {
        self.points.resize(vertices, None);
        self.faces.resize(faces, None);
    }

    /// Triangles that may be nearer than `reach` to vertex `v` at `x`, m, and perhaps others. A new list holds those
    /// within `margin` more.
    pub fn point<'a>(
        &'a mut self,
        v: u32,
        x: &Vec3,
        reach: f64,
        margin: f64,
        body: &Body,
    ) -> impl Iterator<Item = u32> + use<'a> {
        let (list, x) = (self.points[v as usize].get_or_insert_with(ProximityList::empty), [*x]);
        let [moved] = list.moved(&x, reach).unwrap_or_else(|| {
            list.restart(&x, reach + margin);
            list.fill(body, body.met.ignored_by([v]));
            [0.0]
        });
        let radius = reach + moved;
        list.features.iter().filter(move |(_, d)| f64::from(*d) <= radius).map(|(g, _)| *g)
    }

    /// Features of the body that may come nearer than `reach` to features of the cloth triangle `f`, m, and perhaps
    /// others.
    ///
    /// `by` holds the lengths of the moves of the corners, m. A new list holds features within `margin` more, m.
    pub fn face<'a>(
        &'a mut self,
        f: u32,
        cloth: &FaceFeatures,
        [reach, margin]: [f64; 2],
        by: &'a [f64; 3],
        body: &Body,
    ) -> impl Iterator<Item = BodyFeature> + use<'a> {
        let list = self.faces[f as usize].get_or_insert_with(ProximityList::empty);
        let longest = by[0].max(by[1]).max(by[2]);
        let moved = list.moved(&cloth.at, reach + longest).unwrap_or_else(|| {
            list.restart(&cloth.at, reach + longest + margin);
            list.fill(cloth, body);
            [0.0; 3]
        });
        // The moves since the list was made, and in the step.
        let gone: [f64; 3] = std::array::from_fn(|k| moved[k] + by[k]);
        let most = gone[0].max(gone[1]).max(gone[2]);
        let may = move |s: &BodyFeature| match s {
            BodyFeature::Corner(_) => most,
            BodyFeature::Edge(i, _) => gone[usize::from(*i)].max(gone[(usize::from(*i) + 1) % 3]),
        };
        list.features.iter().filter(move |(s, d)| f64::from(*d) <= reach + may(s)).map(|(s, _)| *s)
    }
}

impl FaceFeatures {
    /// The features of a face of a body at rest that cloth can press on.
    #[inline]
    fn of_body(body: &Body, g: u32) -> Self {
        let corners = body.topology.faces[g as usize];
        Self { corners, at: crate::pick3(&body.positions, &corners), bits: body.features.of(g) }
    }
}

impl ProximityList<1, u32> {
    /// Fills the list, without the parts of the body that are ignored.
    fn fill(&mut self, body: &Body, ignored: u32) {
        let (place, x) = (Aabb::of_one(&self.at[0]), self.at[0]);
        body.candidates(&place.grown(self.radius), |g| {
            if body.met.is_met(g, ignored) && place.gap(&body.boxes[g as usize]) <= self.radius {
                self.add(g, body.point_gap(&x, g));
            }
        });
    }
}

impl ProximityList<3, BodyFeature> {
    /// Fills the list.
    fn fill(&mut self, cloth: &FaceFeatures, body: &Body) {
        let x = &cloth.at;
        let (bounds, normal) = (Aabb::of_three(x), crate::unit_normal(*x).unwrap_or_else(Vec3::zeros));
        let ignored_by_face = body.met.ignored_by_face(&cloth.corners);
        let ignored_by_edges = [0, 1, 2].map(|i| body.met.ignored_by(cloth.edge(i)));
        body.candidates(&bounds.grown(self.radius), |g| {
            if body.features.of(g) == 0 || bounds.gap(&body.boxes[g as usize]) > self.radius {
                return;
            }
            let b = &FaceFeatures::of_body(body, g);
            let is_beyond =
                plane_gap(&x[0], &normal, &b.at) > self.radius || distance_from_ball(x, &b.at) > self.radius;
            if !is_beyond && body.met.is_met(g, ignored_by_face) {
                self.add_corners(cloth, b);
            }
            if !is_beyond {
                self.add_edges(cloth, b, ignored_by_edges.map(|ignored| body.met.is_met(g, ignored)));
            }
        });
    }

    /// Adds the vertices that a face of the body owns.
    fn add_corners(&mut self, cloth: &FaceFeatures, b: &FaceFeatures) {
        for k in (0..3).filter(|k| b.owns_vertex(*k)) {
            self.add(BodyFeature::Corner(b.corners[k]), point_triangle_gap(&b.at[k], cloth.at.each_ref()));
        }
    }

    /// Adds the edges that a face of the body owns, against those edges of the cloth triangle that meet it.
    fn add_edges(&mut self, cloth: &FaceFeatures, b: &FaceFeatures, meets: [bool; 3]) {
        for j in (0..3).filter(|j| b.owns_edge(*j)) {
            for i in (0u8..3).filter(|i| meets[usize::from(*i)] && cloth.owns_edge(usize::from(*i))) {
                let distance = cloth.edge_gap(usize::from(i), [&b.at[j], &b.at[(j + 1) % 3]]);
                self.add(BodyFeature::Edge(i, b.edge(j)), distance);
            }
        }
    }
}

/// A lower bound of the distance between a triangle and the ball around another, m.
fn distance_from_ball(x: &[Vec3; 3], t: &[Vec3; 3]) -> f64 {
    let middle = (t[0] + t[1] + t[2]) / 3.0;
    let radius = t.iter().map(|p| (p - middle).norm_squared()).fold(0.0, f64::max).sqrt();
    point_triangle_gap(&middle, x.each_ref()) - radius
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BodyMesh;

    /// A ball of triangles with edges of some centimetres.
    fn ball() -> Body {
        let at = |i: u32, j: u32| {
            let (u, v) = (f64::from(i) * 0.3, f64::from(j) * 0.3 - 1.5);
            Vec3::new(libm::cos(u) * libm::cos(v), libm::sin(v), libm::sin(u) * libm::cos(v)) * 0.2
        };
        let positions = (0..22).flat_map(|i| (0..11).map(move |j| at(i, j))).collect();
        let cell = |i: u32, j: u32| {
            let a = 11 * i + j;
            [[a, a + 1, a + 11], [a + 1, a + 12, a + 11]]
        };
        let triangles = (0..21).flat_map(|i| (0..10).flat_map(move |j| cell(i, j))).collect();
        Body::new(&BodyMesh { positions, triangles }).expect("a body")
    }

    /// A solve that fails and returns to sound positions gets the same lists again.
    #[test]
    fn a_list_made_beyond_numbers_does_not_hold() {
        let (body, at) = (ball(), Vec3::new(0.21, 0.0, 0.0));
        let near = |ways: &[Vec3]| {
            let mut lists = ProximityLists::default();
            lists.resize(1, 0);
            ways.iter().map(|x| lists.point(0, x, 0.02, 0.01, &body).count()).last()
        };
        let lost = Vec3::repeat(f64::NAN);
        assert!(near(&[at]) > Some(0));
        assert_eq!(near(&[lost, at]), near(&[at]));
        assert_eq!(near(&[at, lost, at]), near(&[at]));
    }

    /// Wherever a triangle wanders, its lists hold every near feature, in the order of the tree.
    #[test]
    fn nothing_near_is_missed_on_a_long_way() {
        let (body, mut lists, mut found) = (ball(), ProximityLists::default(), 0);
        lists.resize(1, 1);
        for i in 0..400u32 {
            let t = f64::from(i) * 0.01;
            let at = Vec3::new(0.23 * libm::cos(t), 0.05 * libm::sin(3.0 * t), 0.23 * libm::sin(t));
            let x = [at, at + Vec3::new(0.02, 0.01, 0.0), at + Vec3::new(0.0, 0.02, 0.01 * libm::sin(7.0 * t))];
            let reach = 0.02 + 0.01 * libm::sin(5.0 * t);
            let mut near = Vec::new();
            body.candidates(&Aabb::of_three(&x).grown(reach), |g| near.push(g));
            let kept: Vec<u32> = lists.point(0, &at, reach, 0.01, &body).collect();
            let wanted: Vec<u32> = near.iter().copied().filter(|g| body.point_gap(&at, *g) <= reach).collect();
            let of_kept: Vec<u32> = kept.iter().copied().filter(|g| wanted.contains(g)).collect();
            assert_eq!(of_kept, wanted);
            let cloth = FaceFeatures { corners: [0, 1, 2], at: x, bits: 63 };
            let kept: Vec<BodyFeature> = lists.face(0, &cloth, [reach - 1e-3, 0.01], &[1e-3; 3], &body).collect();
            let near = |s: &BodyFeature| match s {
                BodyFeature::Corner(w) => point_triangle_gap(&body.positions[*w as usize], x.each_ref()) <= reach,
                BodyFeature::Edge(i, ends) => {
                    cloth.edge_gap(usize::from(*i), ends.map(|w| &body.positions[w as usize])) <= reach
                }
            };
            let of_kept: Vec<BodyFeature> = kept.into_iter().filter(near).collect();
            let mut wanted = Vec::new();
            body.candidates(&Aabb::of_three(&x).grown(reach), |g| {
                let b = FaceFeatures::of_body(&body, g);
                wanted.extend(
                    (0..3).filter(|k| b.owns_vertex(*k)).map(|k| BodyFeature::Corner(b.corners[k])).filter(near),
                );
                let edges = (0..3).filter(|j| b.owns_edge(*j));
                wanted.extend(edges.flat_map(|j| [0u8, 1, 2].map(|i| BodyFeature::Edge(i, b.edge(j)))).filter(near));
            });
            found += wanted.len();
            assert_eq!(of_kept, wanted);
        }
        assert!(found > 400, "{found}");
    }
}
