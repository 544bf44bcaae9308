//! What of a body at rest is beside each vertex and each triangle of the cloth, kept with its distances while the cloth stays
//! near where it was asked: a walk through the body's tree costs more than all else that is asked of most.

use crate::Vec3;
use crate::collision::body::Body;
use crate::collision::broad_phase::bvh::Aabb;
use crate::collision::narrow_phase::candidates::Owned;
use crate::collision::narrow_phase::distance::{plane_gap, point_triangle_gap};

/// Rounds a distance to single precision, not up.
pub(crate) const DOWN: f64 = 1.0 - 1e-6;

/// Times what is asked for, beyond which a list holds so much else that a new one is cheaper, if it is longer than this.
const TOO_WIDE: f64 = 3.0;
const SHORT: usize = 8;

/// What is beside a vertex or a triangle.
#[derive(Clone, Debug)]
struct Held<const N: usize, T> {
    at: [Vec3; N],
    /// All nearer than this are held, m.
    limit: f64,
    /// In the order of the body's tree, and what they were away, m, or less.
    list: Vec<(T, f32)>,
}

/// What of a body may meet a triangle of the cloth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Side {
    /// This vertex the face.
    Corner(u32),
    /// The edge between these vertices that edge of the triangle.
    Edge(u8, [u32; 2]),
}

impl<const N: usize, T: Copy> Held<N, T> {
    fn nothing() -> Box<Self> {
        Box::new(Self { at: [Vec3::zeros(); N], limit: 0.0, list: Vec::new() })
    }

    /// How far each corner has moved since the list was made, m, if that still holds for what is nearer than `reach`.
    fn moved(&self, x: &[Vec3; N], reach: f64) -> Option<[f64; N]> {
        let moved: [f64; N] = std::array::from_fn(|k| (self.at[k] - x[k]).norm());
        // No list made beyond numbers holds.
        let near = moved.iter().all(|m| m + reach <= self.limit);
        let narrow = self.limit <= TOO_WIDE * reach || self.list.len() <= SHORT;
        let holds = self.limit > 0.0 && near && narrow;
        holds.then_some(moved)
    }

    fn start(&mut self, x: &[Vec3; N], limit: f64) {
        (self.at, self.limit) = (*x, limit);
        self.list.clear();
    }

    /// Takes what is so far away, if that counts.
    fn hold(&mut self, what: T, away: f64) {
        if away <= self.limit {
            // A smaller distance only lets more be asked.
            #[allow(clippy::cast_possible_truncation)]
            self.list.push((what, (DOWN * away) as f32));
        }
    }
}

/// Candidates of the cloth's vertices and triangles; of those that never were near the body there is nothing.
#[derive(Clone, Debug, Default)]
pub(crate) struct Beside {
    points: Vec<Option<Box<Held<1, u32>>>>,
    faces: Vec<Option<Box<Held<3, Side>>>>,
}

impl Beside {
    /// For so many vertices and triangles of the cloth.
    pub fn cover(&mut self, vertices: usize, faces: usize) {
        self.points.resize(vertices, None);
        self.faces.resize(faces, None);
    }

    /// Triangles that may be nearer than `reach` to vertex `v` at `x`, and maybe others; those within `margin` more are kept.
    pub fn point<'a>(
        &'a mut self,
        v: u32,
        x: &Vec3,
        reach: f64,
        margin: f64,
        body: &Body,
    ) -> impl Iterator<Item = u32> + use<'a> {
        let (held, x) = (self.points[v as usize].get_or_insert_with(Held::nothing), [*x]);
        let [moved] = held.moved(&x, reach).unwrap_or_else(|| {
            held.start(&x, reach + margin);
            held.fill(body);
            [0.0]
        });
        let limit = reach + moved;
        held.list.iter().filter(move |(_, d)| f64::from(*d) <= limit).map(|(g, _)| *g)
    }

    /// What presses of the body and may come nearer than `reach` to what the cloth's triangle `f` owns, of which no corner goes
    /// farther than `by`; and maybe other such.
    pub fn face<'a>(
        &'a mut self,
        f: u32,
        cloth: &Owned,
        [reach, margin]: [f64; 2],
        by: &'a [f64; 3],
        body: &Body,
    ) -> impl Iterator<Item = Side> + use<'a> {
        let held = self.faces[f as usize].get_or_insert_with(Held::nothing);
        let longest = by[0].max(by[1]).max(by[2]);
        let moved = held.moved(&cloth.at, reach + longest).unwrap_or_else(|| {
            held.start(&cloth.at, reach + longest + margin);
            held.fill(cloth, body);
            [0.0; 3]
        });
        // Since the list was made, and in the step.
        let gone: [f64; 3] = std::array::from_fn(|k| moved[k] + by[k]);
        let most = gone[0].max(gone[1]).max(gone[2]);
        let may = move |s: &Side| match s {
            Side::Corner(_) => most,
            Side::Edge(i, _) => gone[usize::from(*i)].max(gone[(usize::from(*i) + 1) % 3]),
        };
        held.list.iter().filter(move |(s, d)| f64::from(*d) <= reach + may(s)).map(|(s, _)| *s)
    }
}

impl Owned {
    /// Of a body's face at rest: what cloth can press on.
    #[inline]
    fn of_body(body: &Body, g: u32) -> Self {
        let corners = body.topology.faces[g as usize];
        Self { corners, at: crate::pick3(&body.positions, &corners), bits: body.sides.of(g) }
    }
}

impl Held<1, u32> {
    /// Holds all within the limit.
    fn fill(&mut self, body: &Body) {
        let (place, x) = (Aabb::of_one(&self.at[0]), self.at[0]);
        body.candidates(&place.grown(self.limit), |g| {
            if place.gap(&body.boxes[g as usize]) <= self.limit {
                self.hold(g, body.point_gap(&x, g));
            }
        });
    }
}

impl Held<3, Side> {
    /// Holds all within the limit.
    fn fill(&mut self, cloth: &Owned, body: &Body) {
        let x = &cloth.at;
        let (bounds, normal) = (Aabb::of_three(x), crate::unit_normal(*x).unwrap_or_else(Vec3::zeros));
        body.candidates(&bounds.grown(self.limit), |g| {
            if body.sides.of(g) == 0 || bounds.gap(&body.boxes[g as usize]) > self.limit {
                return;
            }
            let b = &Owned::of_body(body, g);
            let away = plane_gap(&x[0], &normal, &b.at) > self.limit || beside_ball(x, &b.at) > self.limit;
            if !away {
                self.hold_sides(cloth, b);
            }
        });
    }

    fn hold_sides(&mut self, cloth: &Owned, b: &Owned) {
        for k in (0..3).filter(|k| b.owns_vertex(*k)) {
            self.hold(Side::Corner(b.corners[k]), point_triangle_gap(&b.at[k], cloth.at.each_ref()));
        }
        for j in (0..3).filter(|j| b.owns_edge(*j)) {
            for i in (0u8..3).filter(|i| cloth.owns_edge(usize::from(*i))) {
                let away = cloth.edge_gap(usize::from(i), [&b.at[j], &b.at[(j + 1) % 3]]);
                self.hold(Side::Edge(i, b.edge(j)), away);
            }
        }
    }
}

/// How far a triangle stays from the ball around another; near the truth where that is small.
fn beside_ball(x: &[Vec3; 3], t: &[Vec3; 3]) -> f64 {
    let middle = (t[0] + t[1] + t[2]) / 3.0;
    let radius = t.iter().map(|p| (p - middle).norm_squared()).fold(0.0, f64::max).sqrt();
    point_triangle_gap(&middle, x.each_ref()) - radius
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BodyMesh;

    /// A ball of triangles of some centimetres.
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

    /// A run that goes wrong comes back to where it was sound.
    #[test]
    fn a_list_made_beyond_numbers_does_not_hold() {
        let (body, at) = (ball(), Vec3::new(0.21, 0.0, 0.0));
        let near = |ways: &[Vec3]| {
            let mut beside = Beside::default();
            beside.cover(1, 0);
            ways.iter().map(|x| beside.point(0, x, 0.02, 0.01, &body).count()).last()
        };
        let lost = Vec3::repeat(f64::NAN);
        assert!(near(&[at]) > Some(0));
        assert_eq!(near(&[lost, at]), near(&[at]));
        assert_eq!(near(&[at, lost, at]), near(&[at]));
    }

    /// Wherever a triangle wanders, what is kept holds all that is near, in the order of the tree.
    #[test]
    fn nothing_near_is_missed_on_a_long_way() {
        let (body, mut beside, mut found) = (ball(), Beside::default(), 0);
        beside.cover(1, 1);
        for i in 0..400u32 {
            let t = f64::from(i) * 0.01;
            let at = Vec3::new(0.23 * libm::cos(t), 0.05 * libm::sin(3.0 * t), 0.23 * libm::sin(t));
            let x = [at, at + Vec3::new(0.02, 0.01, 0.0), at + Vec3::new(0.0, 0.02, 0.01 * libm::sin(7.0 * t))];
            let reach = 0.02 + 0.01 * libm::sin(5.0 * t);
            let mut near = Vec::new();
            body.candidates(&Aabb::of_three(&x).grown(reach), |g| near.push(g));
            let kept: Vec<u32> = beside.point(0, &at, reach, 0.01, &body).collect();
            let wanted: Vec<u32> = near.iter().copied().filter(|g| body.point_gap(&at, *g) <= reach).collect();
            let of_kept: Vec<u32> = kept.iter().copied().filter(|g| wanted.contains(g)).collect();
            assert_eq!(of_kept, wanted);
            let cloth = Owned { corners: [0, 1, 2], at: x, bits: 63 };
            let kept: Vec<Side> = beside.face(0, &cloth, [reach - 1e-3, 0.01], &[1e-3; 3], &body).collect();
            let near = |s: &Side| match s {
                Side::Corner(w) => point_triangle_gap(&body.positions[*w as usize], x.each_ref()) <= reach,
                Side::Edge(i, ends) => {
                    cloth.edge_gap(usize::from(*i), ends.map(|w| &body.positions[w as usize])) <= reach
                }
            };
            let of_kept: Vec<Side> = kept.into_iter().filter(near).collect();
            let mut wanted = Vec::new();
            body.candidates(&Aabb::of_three(&x).grown(reach), |g| {
                let b = Owned::of_body(&body, g);
                wanted.extend((0..3).filter(|k| b.owns_vertex(*k)).map(|k| Side::Corner(b.corners[k])).filter(near));
                let edges = (0..3).filter(|j| b.owns_edge(*j));
                wanted.extend(edges.flat_map(|j| [0u8, 1, 2].map(|i| Side::Edge(i, b.edge(j)))).filter(near));
            });
            found += wanted.len();
            assert_eq!(of_kept, wanted);
        }
        assert!(found > 400, "{found}");
    }
}
