//! No rubber look: the over-elongation correction after the step (paper §2.2, after Kang et al. 2000), for the yarns
//! through every triangle: warp, weft or bias longer than the limit is brought back by moving the corners; held ones stay.

use crate::{Element, Scene, Vec3};

/// Triangles are looked at again after this many steps; those near the limit at every step.
const INTERVAL: u32 = 16;
/// Share of the allowed elongation from which a triangle is watched.
const NEAR: f64 = 0.8;
const SWEEPS: usize = 6;
/// Share of the limit that is corrected to: a few sweeps a step leave a little over, which must stay inside.
const TARGET: f64 = 0.95;
/// Sweeps for the balance of a state at rest.
const SETTLING: usize = 500;
/// Of the bias along warp and along weft.
const HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;

struct Yarn {
    vertices: [u32; 3],
    /// Gradient weights of the direction, 1/m.
    weights: [f64; 3],
    /// Largest stretch (1 = rest).
    limit: f64,
}

pub(crate) struct StrainLimit {
    yarns: Vec<Yarn>,
    watched: Vec<u32>,
    since: u32,
    pub corrected: u64,
    pub most_watched: usize,
}

/// The line along a direction of the cloth, (weft, warp).
fn yarn(e: &Element, along: [f64; 2], limit: f64) -> Yarn {
    let weights = e.gradients().map(|g| g[0] * along[0] + g[1] * along[1]);
    Yarn { vertices: e.vertices, weights, limit: 1.0 + TARGET * limit }
}

impl Yarn {
    #[inline]
    fn stretch(&self, x: &[Vec3]) -> (Vec3, f64) {
        let [a, b, c] = crate::pick3(x, &self.vertices);
        let d = a * self.weights[0] + b * self.weights[1] + c * self.weights[2];
        (d, d.norm())
    }
}

impl StrainLimit {
    /// `None` when no fabric has a limit.
    pub fn new(scene: &Scene) -> Option<Self> {
        let mut yarns = Vec::new();
        for e in &scene.triangles {
            let [warp, weft, bias] = scene.materials[e.material as usize].strain_limit;
            let along = [([1.0, 0.0], weft), ([0.0, 1.0], warp), ([HALF, HALF], bias), ([HALF, -HALF], bias)];
            yarns.extend(along.iter().filter(|(_, l)| l.is_finite()).map(|(along, limit)| yarn(e, *along, *limit)));
        }
        let none = yarns.is_empty();
        (!none).then_some(Self { yarns, watched: Vec::new(), since: INTERVAL, corrected: 0, most_watched: 0 })
    }

    /// Corrects the new positions and the velocities with them.
    pub fn apply(&mut self, x: &mut [Vec3], v: &mut [Vec3], inverse_mass: &[f64], dt: f64) {
        self.since += 1;
        if self.since >= INTERVAL {
            self.since = 0;
            self.watched.clear();
            for (i, y) in (0u32..).zip(&self.yarns) {
                let near = 1.0 + NEAR * (y.limit - 1.0);
                if y.stretch(x).0.norm_squared() > near * near {
                    self.watched.push(i);
                }
            }
            self.most_watched = self.most_watched.max(self.watched.len());
        }
        for sweep in 0..SWEEPS {
            if !self.sweep(sweep % 2 == 1, x, v, inverse_mass, dt) {
                break;
            }
        }
    }

    /// As [`Self::apply`] for a state at rest at `from`: a triangle at (or, by the last sweep's rest, slightly over)
    /// its limit may stay as it is but not grow, and the sweeps go on until nothing changes.
    pub fn settle(&mut self, from: &[Vec3], x: &mut [Vec3], v: &mut [Vec3], inverse_mass: &[f64], dt: f64) {
        let limits: Vec<f64> = self.yarns.iter().map(|y| y.limit).collect();
        for y in &mut self.yarns {
            y.limit = y.limit.max(y.stretch(from).1);
        }
        self.since = INTERVAL;
        self.apply(x, v, inverse_mass, dt);
        for sweep in 0..SETTLING {
            if !self.sweep(sweep % 2 == 1, x, v, inverse_mass, dt) {
                break;
            }
        }
        for (y, l) in self.yarns.iter_mut().zip(limits) {
            y.limit = l;
        }
    }

    /// One pass over the watched triangles, forwards or backwards so that a correction travels both ways. Was anything
    /// corrected?
    fn sweep(&mut self, backwards: bool, x: &mut [Vec3], v: &mut [Vec3], inverse_mass: &[f64], dt: f64) -> bool {
        let mut any = false;
        for k in 0..self.watched.len() {
            let k = if backwards { self.watched.len() - 1 - k } else { k };
            let y = &self.yarns[self.watched[k] as usize];
            let (d, stretch) = y.stretch(x);
            if stretch <= y.limit {
                continue;
            }
            let mobility: f64 =
                (0..3).map(|k| y.weights[k] * y.weights[k] * inverse_mass[y.vertices[k] as usize]).sum();
            if mobility <= 0.0 {
                continue;
            }
            any = true;
            self.corrected += 1;
            let back = d * ((y.limit - stretch) / (stretch * mobility));
            for k in 0..3 {
                let i = y.vertices[k] as usize;
                let move_by = back * (y.weights[k] * inverse_mass[i]);
                x[i] += move_by;
                v[i] += move_by / dt;
            }
        }
        any
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Material;

    /// Sheared by a tenth: one bias direction is 5 % longer, warp and weft are not.
    #[test]
    fn a_triangle_too_long_on_the_bias_is_brought_back() {
        let rest = [[0.0, 0.0], [0.1, 0.0], [0.0, 0.1]];
        let mut material = Material::isotropic(0.15, 500.0, 0.3, 1e-5);
        material.strain_limit[2] = 0.02;
        let scene = Scene {
            triangles: vec![Element { vertices: [0, 1, 2], rest, material: 0 }].into_iter().collect(),
            materials: vec![material],
            ..Scene::default()
        };
        let mut limit = StrainLimit::new(&scene).expect("a limit");
        let mut x: Vec<Vec3> = rest.map(|[u, v]| Vec3::new(u + 0.1 * v, v, 0.0)).into();
        limit.apply(&mut x, &mut [Vec3::zeros(); 3], &[1.0; 3], 1e-3);
        let bias = ((x[1] + x[2] - x[0] * 2.0) / (0.1 * 2f64.sqrt())).norm() - 1.0;
        assert!((0.018..0.02).contains(&bias), "{bias}");
    }
}
