//! Culling by a monotone map: one convex flat piece that is still spread out does not meet itself.
//!
//! Let f be the map of the piece into a plane and J its derivative, with J + Jᵀ ≥ 2 c everywhere on a convex piece.
//! Integrating J along the line between two places a and b gives (f(b) − f(a))·(b − a) ≥ c |b − a|². So nothing comes
//! nearer than c times its distance in the cloth. J is linear in a step, so its two ends bound the whole step.

use crate::collision::tuning::{SPREAD_SHEET_BOUND, SPREAD_SHEET_CULLING};
use crate::scene::topology::Topology;
use crate::{Scene, Vec3};
use std::f64::consts::PI;

/// Rounding allowed in sums of angles, rad.
const ROUNDING_OF_ANGLE_SUMS: f64 = 1e-6;

#[derive(Debug)]
pub(crate) struct FlatSheet {
    /// For each triangle, the factors of its corners in the derivatives along the two axes of the cloth, 1/m.
    factors: Vec<[[f64; 2]; 3]>,
    /// For each vertex, the sums of these factors over all triangles, 1/m.
    sums: Vec<[f64; 2]>,
    /// Coordinates of each vertex along the two axes of the plane, at the beginning and the end of the step, m.
    seen: Vec<[f64; 4]>,
}

impl FlatSheet {
    /// Makes the test for one convex flat piece; `None` for any other cloth.
    pub fn new(scene: &Scene, topology: &Topology) -> Option<Self> {
        let one = !scene.triangles.is_empty() && scene.stitches.is_empty();
        (SPREAD_SHEET_CULLING.is_on() && one && is_flat(scene) && is_convex_disc(scene, topology)).then(|| {
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

    /// Is the piece spread out along the whole step?
    pub fn is_spread(&mut self, x: &[Vec3], step: &[Vec3], faces: &[[u32; 3]]) -> bool {
        let Some([u, v]) = self.plane(x) else { return false };
        self.seen.clear();
        self.seen.extend(x.iter().zip(step).map(|(p, d)| {
            let end = p + d;
            [p.dot(&u), p.dot(&v), end.dot(&u), end.dot(&v)]
        }));
        let bound = SPREAD_SHEET_BOUND.get();
        self.factors.iter().zip(faces).all(|(g, t)| {
            let [a, b] = derivatives(g, &t.map(|v| self.seen[v as usize]));
            [0, 2].into_iter().all(|k| {
                let (p, q, r) = (a[k] - bound, b[k + 1] - bound, 0.5 * (a[k + 1] + b[k]));
                p >= 0.0 && q >= 0.0 && p * q >= r * r
            })
        })
    }

    /// The images of the cloth's two axes in the plane nearest to the piece, turned with it.
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

/// Derivatives of four coordinates along the two axes of the cloth.
#[inline]
fn derivatives(g: &[[f64; 2]; 3], seen: &[[f64; 4]; 3]) -> [[f64; 4]; 2] {
    let mut along = [[0.0; 4]; 2];
    for k in 0..4 {
        along[0][k] = g[0][0] * seen[0][k] + g[1][0] * seen[1][k] + g[2][0] * seen[2][k];
        along[1][k] = g[0][1] * seen[0][k] + g[1][1] * seen[1][k] + g[2][1] * seen[2][k];
    }
    along
}

/// Does every vertex have one place in the cloth, and is every triangle turned the same way?
fn is_flat(scene: &Scene) -> bool {
    let mut place: Vec<Option<[f64; 2]>> = vec![None; scene.positions.len()];
    scene.triangles.iter().all(|t| {
        let same = t.vertices.iter().zip(&t.rest).all(|(v, p)| *place[*v as usize].get_or_insert(*p) == *p);
        same && t.area() > 0.0
    })
}

/// Is the cloth a disc whose border nowhere turns inwards? Every inner vertex must have a full turn of cloth around
/// it.
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
            0 => *r == 0.0 || (r - 2.0 * PI).abs() <= ROUNDING_OF_ANGLE_SUMS,
            2 => *r <= PI + ROUNDING_OF_ANGLE_SUMS,
            _ => false,
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Element;

    /// A strip of squares along x, each cut in two, bent down by `bend` from one to the next, rad.
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
        let mut sheet = FlatSheet::new(scene, &topology)?;
        Some(sheet.is_spread(&scene.positions, step, &topology.faces))
    }

    #[test]
    fn a_strip_is_spread_until_it_bends_too_far() {
        let still = vec![Vec3::zeros(); 14];
        assert_eq!(spread(&strip(6, 0.0), &still), Some(true));
        assert_eq!(spread(&strip(6, 0.15), &still), Some(true));
        assert_eq!(spread(&strip(6, 0.5), &still), Some(false));
        // Turned as a whole, in its plane and out of it, the strip is as spread out as before.
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
