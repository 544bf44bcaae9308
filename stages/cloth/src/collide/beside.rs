//! Which triangles of a body at rest are beside each vertex and each triangle of the cloth, kept with their distances while
//! the cloth stays near where it was asked: a walk through the body's tree costs more than all else that is asked of most.

use super::body::Body;
use super::closest::{plane_gap, point_triangle_gap};
use super::tree::Aabb;
use crate::Vec3;

/// Rounds a distance to single precision, not up.
pub(super) const DOWN: f64 = 1.0 - 1e-6;

/// What is beside a vertex or a triangle.
#[derive(Clone, Debug)]
struct Held<const N: usize> {
    at: [Vec3; N],
    /// All nearer than this are held, m.
    limit: f64,
    /// Triangles of the body in the order of its tree, and what they are away at least, m.
    list: Vec<(u32, f32)>,
}

impl<const N: usize> Held<N> {
    fn nothing() -> Box<Self> {
        Box::new(Self { at: [Vec3::zeros(); N], limit: 0.0, list: Vec::new() })
    }

    /// Those that may be nearer than `reach`, and maybe others; how far it was since the list was made, given.
    fn within(&self, moved: f64, reach: f64) -> impl Iterator<Item = u32> + use<'_, N> {
        let limit = reach + moved;
        self.list.iter().filter(move |(_, d)| f64::from(*d) <= limit).map(|(g, _)| *g)
    }

    /// The longest way of a corner since the list was made, m.
    fn moved(&self, x: &[Vec3; N]) -> f64 {
        crate::farthest(&self.at, x)
    }

    /// How far it was since the list was made, if that still holds.
    fn holds(&self, x: &[Vec3; N], reach: f64) -> Option<f64> {
        let moved = self.moved(x);
        (self.limit > 0.0 && moved + reach <= self.limit).then_some(moved)
    }

    /// `away`: distance of a triangle of the body from here, or less.
    fn fill(&mut self, x: &[Vec3; N], limit: f64, body: &Body, away: impl Fn(u32) -> f64) {
        (self.at, self.limit) = (*x, limit);
        self.list.clear();
        body.candidates(&Aabb::of(x).grown(limit), |g| {
            let d = away(g);
            if d <= limit {
                // A smaller distance only lets more be asked.
                #[allow(clippy::cast_possible_truncation)]
                self.list.push((g, (DOWN * d) as f32));
            }
        });
    }
}

/// Candidates of the cloth's vertices and triangles; of those that never were near the body there is nothing.
#[derive(Clone, Debug, Default)]
pub(crate) struct Beside {
    points: Vec<Option<Box<Held<1>>>>,
    faces: Vec<Option<Box<Held<3>>>>,
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
        let moved = held.holds(&x, reach).unwrap_or_else(|| {
            held.fill(&x, reach + margin, body, |g| body.point_gap(&x[0], g));
            0.0
        });
        held.within(moved, reach)
    }

    /// The same for triangle `f` with its corners at `x`, of what has sides that press.
    pub fn face<'a>(
        &'a mut self,
        f: u32,
        x: &[Vec3; 3],
        reach: f64,
        margin: f64,
        body: &Body,
    ) -> impl Iterator<Item = u32> + use<'a> {
        let held = self.faces[f as usize].get_or_insert_with(Held::nothing);
        let moved = held.holds(x, reach).unwrap_or_else(|| {
            let (bounds, normal) = (Aabb::of_three(x), crate::unit_normal(*x).unwrap_or_else(Vec3::zeros));
            held.fill(x, reach + margin, body, |g| {
                if body.sides[g as usize] == 0 {
                    return f64::INFINITY;
                }
                let t = body.triangle(g);
                bounds.gap(&body.boxes[g as usize]).max(plane_gap(&x[0], &normal, &t)).max(beside_ball(x, &t))
            });
            0.0
        });
        held.within(moved, reach)
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

    /// Wherever a triangle wanders, what is kept holds all that is near, in the order of the tree.
    #[test]
    fn nothing_near_is_missed_on_a_long_way() {
        let (body, mut beside) = (ball(), Beside::default());
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
            let kept: Vec<u32> = beside.face(0, &x, reach, 0.01, &body).collect();
            let corner = |g: &u32| x.iter().any(|p| body.point_gap(p, *g) <= reach);
            let wanted: Vec<u32> = near.iter().copied().filter(corner).collect();
            let of_kept: Vec<u32> = kept.iter().copied().filter(|g| wanted.contains(g)).collect();
            assert_eq!(of_kept, wanted);
        }
    }
}
