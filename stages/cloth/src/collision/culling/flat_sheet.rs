//! One convex flat piece that is still spread out cannot meet itself: seen along one direction and turned back by one
//! angle, every triangle points the way it was cut.
//!
//! Let f be the piece's way into a plane and J its derivative. Where J + Jᵀ ≥ 2 c everywhere on a convex piece,
//! (f(b) − f(a))·(b − a) ≥ c |b − a|² for any two of its points (integrate J along the line between them), so nothing
//! comes nearer than c times its distance in the cloth. J is linear in a step, so its two ends bound all of it.

use crate::scene::topology::Topology;
use crate::{Scene, Vec3};
use std::f64::consts::PI;

/// Least c: what does not touch in the cloth stays further apart than any gap (`frame` in problem.rs).
const SPREAD: f64 = 0.5;
/// Rounding allowed in sums of angles, rad.
const ROUNDING: f64 = 1e-6;

#[derive(Debug)]
pub(crate) struct Sheet {
    /// Of every triangle, the factors of its corners in the derivatives along the cloth's two axes, 1/m.
    factors: Vec<[[f64; 2]; 3]>,
    /// Of every vertex, their sums over all triangles.
    sums: Vec<[f64; 2]>,
    /// Along the plane's two axes, where every vertex is and where it gets to.
    seen: Vec<[f64; 4]>,
}

impl Sheet {
    /// `None` where the cloth is not one convex flat piece.
    pub fn new(scene: &Scene, topology: &Topology) -> Option<Self> {
        let one = !scene.triangles.is_empty() && scene.stitches.is_empty();
        (one && is_flat(scene) && is_convex_disc(scene, topology)).then(|| {
            let factors: Vec<_> = scene.triangles.iter().map(crate::Element::gradients).collect();
            let mut sums = vec![[0.0; 2]; scene.positions.len()];
            for (g, t) in factors.iter().zip(&topology.faces) {
                for (v, g) in t.iter().zip(g) {
                    let sum: &mut [f64; 2] = &mut sums[*v as usize];
                    *sum = [sum[0] + g[0], sum[1] + g[1]];
                }
            }
            Self { factors, sums, seen: Vec::new() }
        })
    }

    /// Is the piece spread out all along a step?
    pub fn is_spread(&mut self, x: &[Vec3], step: &[Vec3], faces: &[[u32; 3]]) -> bool {
        let Some([u, v]) = self.plane(x) else { return false };
        self.seen.clear();
        self.seen.extend(x.iter().zip(step).map(|(p, d)| {
            let end = p + d;
            [p.dot(&u), p.dot(&v), end.dot(&u), end.dot(&v)]
        }));
        self.factors.iter().zip(faces).all(|(g, t)| {
            let [a, b] = derivatives(g, &t.map(|v| self.seen[v as usize]));
            [0, 2].into_iter().all(|k| {
                let (p, q, r) = (a[k] - SPREAD, b[k + 1] - SPREAD, 0.5 * (a[k + 1] + b[k]));
                p >= 0.0 && q >= 0.0 && p * q >= r * r
            })
        })
    }

    /// The plane the piece lies nearest to, turned with it: images of the cloth's two axes.
    fn plane(&self, x: &[Vec3]) -> Option<[Vec3; 2]> {
        let mut sum = [Vec3::zeros(); 2];
        for (g, p) in self.sums.iter().zip(x) {
            sum = [sum[0] + p * g[0], sum[1] + p * g[1]];
        }
        let n = sum[0].cross(&sum[1]).try_normalize(0.0)?;
        let u = (sum[0].try_normalize(0.0)? + sum[1].try_normalize(0.0)?.cross(&n)).try_normalize(0.0)?;
        Some([u, n.cross(&u)])
    }
}

/// Of four numbers, along the cloth's two axes.
#[inline]
fn derivatives(g: &[[f64; 2]; 3], seen: &[[f64; 4]; 3]) -> [[f64; 4]; 2] {
    let mut along = [[0.0; 4]; 2];
    for k in 0..4 {
        along[0][k] = g[0][0] * seen[0][k] + g[1][0] * seen[1][k] + g[2][0] * seen[2][k];
        along[1][k] = g[0][1] * seen[0][k] + g[1][1] * seen[1][k] + g[2][1] * seen[2][k];
    }
    along
}

/// Has every vertex one place in the cloth, and is every triangle turned the same way?
fn is_flat(scene: &Scene) -> bool {
    let mut place: Vec<Option<[f64; 2]>> = vec![None; scene.positions.len()];
    scene.triangles.iter().all(|t| {
        let same = t.vertices.iter().zip(&t.rest).all(|(v, p)| *place[*v as usize].get_or_insert(*p) == *p);
        same && t.area() > 0.0
    })
}

/// A disc whose border nowhere turns inwards, with as much cloth around every other vertex as fits there.
fn is_convex_disc(scene: &Scene, topology: &Topology) -> bool {
    let mut sides = vec![0u8; topology.edges.len()];
    topology.face_edges.iter().flatten().for_each(|e| sides[*e as usize] = sides[*e as usize].saturating_add(1));
    let mut border = vec![0u8; scene.positions.len()];
    for (ends, _) in topology.edges.iter().zip(&sides).filter(|(_, n)| **n == 1) {
        ends.iter().for_each(|v| border[*v as usize] = border[*v as usize].saturating_add(1));
    }
    let mut round = vec![0.0; scene.positions.len()];
    for t in &scene.triangles {
        (0..3).for_each(|k| round[t.vertices[k] as usize] += t.rest_angle(k));
    }
    let used = round.iter().filter(|r| **r > 0.0).count();
    let disc = used + topology.faces.len() == topology.edges.len() + 1;
    disc && sides.iter().all(|n| *n <= 2)
        && round.iter().zip(&border).all(|(r, b)| match b {
            0 => *r == 0.0 || (r - 2.0 * PI).abs() <= ROUNDING,
            2 => *r <= PI + ROUNDING,
            _ => false,
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Element;

    /// A strip of squares along x, cut in two each, bent down by `bend` from one to the next.
    fn strip(n: u32, bend: f64) -> Scene {
        let mut scene = Scene::default();
        let (mut at, mut turned) = (Vec3::zeros(), 0.0);
        for i in 0..=n {
            scene.positions.extend([at, at + Vec3::new(0.0, 1.0, 0.0)]);
            at += Vec3::new(libm::cos(turned), 0.0, -libm::sin(turned));
            turned += bend;
            if i < n {
                let (p, x) = (2 * i, f64::from(i));
                let mut add = |vertices, rest| scene.triangles.push(Element { vertices, rest, material: 0 });
                add([p, p + 2, p + 3], [[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0]]);
                add([p, p + 3, p + 1], [[x, 0.0], [x + 1.0, 1.0], [x, 1.0]]);
            }
        }
        scene
    }

    fn spread(scene: &Scene, step: &[Vec3]) -> Option<bool> {
        let topology = Topology::of_elements(scene.positions.len(), &scene.triangles);
        let mut sheet = Sheet::new(scene, &topology)?;
        Some(sheet.is_spread(&scene.positions, step, &topology.faces))
    }

    #[test]
    fn a_strip_is_spread_until_it_bends_too_far() {
        let still = vec![Vec3::zeros(); 14];
        assert_eq!(spread(&strip(6, 0.0), &still), Some(true));
        assert_eq!(spread(&strip(6, 0.15), &still), Some(true));
        assert_eq!(spread(&strip(6, 0.5), &still), Some(false));
        // Turned as a whole, in its plane and out of it, it is as spread as before.
        let mut turned = strip(6, 0.15);
        turned.positions.iter_mut().for_each(|p| *p = Vec3::new(-p.y, p.z, -p.x));
        assert_eq!(spread(&turned, &still), Some(true));
        let over: Vec<Vec3> = strip(6, 0.0).positions.iter().map(|p| Vec3::new(-2.0 * p.x, 0.0, 0.0)).collect();
        assert_eq!(spread(&strip(6, 0.0), &over), Some(false), "a step that turns it over");
    }

    #[test]
    fn an_inward_corner_or_two_pieces_are_no_sheet() {
        let still = vec![Vec3::zeros(); 14];
        let mut notched = strip(6, 0.0);
        notched.triangles.remove(0);
        assert_eq!(spread(&notched, &still), None);
        let mut apart = strip(6, 0.0);
        apart.triangles.drain(4..6);
        assert_eq!(spread(&apart, &still), None);
    }
}
