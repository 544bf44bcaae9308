//! The correction of over-elongation after a step (§2.2 of the paper, after Kang et al. 2000).
//!
//! Every triangle has yarns along warp, weft and both bias directions. A yarn that is longer than the limit of its
//! fabric is brought back by moving the corners of the triangle; held corners stay.
//!
//! For comparison there is the inverse correction of Provot, *Deformation Constraints in a Mass-Spring Model to Describe
//! Rigid Cloth Behavior*, 1995. It brings springs on mesh edges back, in one pass in their order.

use crate::explicit::tuning::{
    ELONGATION_PASSES, ELONGATION_PASSES_AT_REST, ELONGATION_TARGET_SHARE, ELONGATION_WATCH_SHARE,
    ELONGATION_WATCH_STEPS,
};
use crate::{Element, ElongationCorrection, Scene, Vec3};
use std::collections::BTreeSet;

/// Component of a bias direction along warp and along weft: cos 45°.
const BIAS_COMPONENT: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// One direction of the cloth in a triangle, and its limit.
struct Yarn {
    vertices: [u32; 3],
    /// Gradient weights of the direction, 1/m.
    weights: [f64; 3],
    /// Largest stretch (1 is rest).
    limit: f64,
}

/// The correction of a cloth: its limited yarns, and those that are near their limits.
pub(crate) struct OverElongation {
    yarns: Vec<Yarn>,
    /// Name of what is corrected, for the report.
    pub what: &'static str,
    /// Passes over the yarns after a step, at most.
    passes: usize,
    /// Yarns near their limits, by number.
    near_limit: Vec<u32>,
    /// Steps since all yarns were tested.
    steps_since_test: u32,
    /// Corrections so far.
    pub corrected: u64,
    /// Largest number of yarns that were watched at once.
    pub most_near_limit: usize,
}

/// The yarn of a triangle along a direction (weft, warp) of unit length, with its allowed elongation.
fn yarn(e: &Element, along: [f64; 2], elongation: f64) -> Yarn {
    let weights = e.gradients().map(|g| g[0] * along[0] + g[1] * along[1]);
    Yarn { vertices: e.vertices, weights, limit: 1.0 + ELONGATION_TARGET_SHARE.get() * elongation }
}

/// The yarns of all triangles along warp, weft and bias.
fn yarns(scene: &Scene) -> Vec<Yarn> {
    let of_triangle = |e: &Element| {
        let [warp, weft, bias] = scene.materials[e.material as usize].strain_limit;
        let along = [
            ([1.0, 0.0], weft),
            ([0.0, 1.0], warp),
            ([BIAS_COMPONENT, BIAS_COMPONENT], bias),
            ([BIAS_COMPONENT, -BIAS_COMPONENT], bias),
        ];
        along.into_iter().filter(|(_, l)| l.is_finite()).map(|(along, limit)| yarn(e, along, limit)).collect::<Vec<_>>()
    };
    scene.triangles.iter().flat_map(of_triangle).collect()
}

/// The springs on all mesh edges. The limit of a spring between warp and weft follows an ellipse.
fn springs(scene: &Scene) -> Vec<Yarn> {
    let (mut all, mut seen) = (Vec::new(), BTreeSet::new());
    for e in &scene.triangles {
        let [warp, weft, _] = scene.materials[e.material as usize].strain_limit;
        for [i, k] in [[0, 1], [1, 2], [2, 0]] {
            let (a, b) = (e.vertices[i], e.vertices[k]);
            let [u, v] = [e.rest[k][0] - e.rest[i][0], e.rest[k][1] - e.rest[i][1]];
            let (length, inverse_limit) = (libm::hypot(u, v), libm::hypot(u / weft, v / warp));
            if inverse_limit > 0.0 && seen.insert((a.min(b), a.max(b))) {
                let limit = 1.0 + ELONGATION_TARGET_SHARE.get() * length / inverse_limit;
                all.push(Yarn { vertices: [a, b, b], weights: [-1.0 / length, 1.0 / length, 0.0], limit });
            }
        }
    }
    all
}

impl Yarn {
    /// The deformed direction, and its length: the stretch.
    #[inline]
    fn stretch(&self, x: &[Vec3]) -> (Vec3, f64) {
        let [a, b, c] = crate::pick3(x, &self.vertices);
        let d = a * self.weights[0] + b * self.weights[1] + c * self.weights[2];
        (d, d.norm())
    }
}

impl OverElongation {
    /// The correction of a scene; `None` when no fabric has a limit.
    pub fn new(scene: &Scene, correction: ElongationCorrection) -> Option<Self> {
        let (yarns, passes, what) = match correction {
            ElongationCorrection::Kang => (yarns(scene), ELONGATION_PASSES.get(), "yarn directions of triangles"),
            ElongationCorrection::Provot => (springs(scene), 1, "springs"),
        };
        let none = yarns.is_empty();
        (!none).then_some(Self {
            yarns,
            what,
            passes,
            near_limit: Vec::new(),
            steps_since_test: ELONGATION_WATCH_STEPS.get(),
            corrected: 0,
            most_near_limit: 0,
        })
    }

    /// Corrects the new positions `x`, and the velocities with them.
    pub fn apply(&mut self, x: &mut [Vec3], v: &mut [Vec3], inverse_mass: &[f64], dt: f64) {
        self.steps_since_test += 1;
        if self.steps_since_test >= ELONGATION_WATCH_STEPS.get() {
            self.test_all(x);
        }
        self.pass_until_done(self.passes, x, v, inverse_mass, dt);
    }

    /// Corrects a state at rest at `from` until nothing changes.
    ///
    /// A yarn at its limit, or slightly over it by what the last passes left, may stay as it is but not grow.
    pub fn settle(&mut self, from: &[Vec3], x: &mut [Vec3], v: &mut [Vec3], inverse_mass: &[f64], dt: f64) {
        let limits: Vec<f64> = self.yarns.iter().map(|y| y.limit).collect();
        for y in &mut self.yarns {
            y.limit = y.limit.max(y.stretch(from).1);
        }
        self.steps_since_test = ELONGATION_WATCH_STEPS.get();
        self.apply(x, v, inverse_mass, dt);
        self.pass_until_done(ELONGATION_PASSES_AT_REST.get(), x, v, inverse_mass, dt);
        for (y, l) in self.yarns.iter_mut().zip(limits) {
            y.limit = l;
        }
    }

    /// Tests all yarns and keeps those that are near their limits.
    fn test_all(&mut self, x: &[Vec3]) {
        let share = ELONGATION_WATCH_SHARE.get();
        self.steps_since_test = 0;
        self.near_limit.clear();
        for (i, y) in (0u32..).zip(&self.yarns) {
            let near = 1.0 + share * (y.limit - 1.0);
            if y.stretch(x).0.norm_squared() > near * near {
                self.near_limit.push(i);
            }
        }
        self.most_near_limit = self.most_near_limit.max(self.near_limit.len());
    }

    /// Passes over the watched yarns, forwards and backwards in turn so that a correction travels both ways.
    fn pass_until_done(&mut self, passes: usize, x: &mut [Vec3], v: &mut [Vec3], inverse_mass: &[f64], dt: f64) {
        for pass in 0..passes {
            if !self.pass(pass % 2 == 1, x, v, inverse_mass, dt) {
                break;
            }
        }
    }

    /// One pass over the watched yarns. Returns `true` if any was corrected.
    fn pass(&mut self, backwards: bool, x: &mut [Vec3], v: &mut [Vec3], inverse_mass: &[f64], dt: f64) -> bool {
        let mut any = false;
        for k in 0..self.near_limit.len() {
            let k = if backwards { self.near_limit.len() - 1 - k } else { k };
            let y = &self.yarns[self.near_limit[k] as usize];
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

    /// The middle one of two springs in a row is free, and both are too long: the first is brought back, which makes the
    /// second longer, and it is brought back in its turn.
    #[test]
    fn springs_are_brought_back_one_after_the_other() {
        let rest = [[0.0, 0.0], [0.1, 0.0], [0.0, 0.1]];
        let mut material = Material::isotropic(0.15, 500.0, 0.3, 1e-5);
        material.strain_limit = [0.1, 0.1, f64::INFINITY];
        let scene = Scene {
            triangles: vec![Element { vertices: [0, 1, 2], rest, material: 0 }].into_iter().collect(),
            materials: vec![material],
            ..Scene::default()
        };
        let mut correction = OverElongation::new(&scene, ElongationCorrection::Provot).expect("a limit");
        assert_eq!(correction.yarns.len(), 3, "one spring on every edge");
        let mut x: Vec<Vec3> = rest.map(|[u, v]| Vec3::new(1.3 * u, v, 0.0)).into();
        correction.apply(&mut x, &mut [Vec3::zeros(); 3], &[0.0, 1.0, 0.0], 1e-3);
        let along = (x[1] - x[0]).norm() / 0.1;
        assert!(along <= 1.0 + 1e-9 + 0.1 * ELONGATION_TARGET_SHARE.get(), "{along}");
        assert_eq!((x[0], x[2]), (Vec3::zeros(), Vec3::new(0.0, 0.1, 0.0)), "held ends stay");
        assert!(correction.corrected >= 1);
    }

    /// A shear by a tenth makes one bias direction 5 % longer, but neither warp nor weft.
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
        let mut limit = OverElongation::new(&scene, ElongationCorrection::Kang).expect("a limit");
        let mut x: Vec<Vec3> = rest.map(|[u, v]| Vec3::new(u + 0.1 * v, v, 0.0)).into();
        limit.apply(&mut x, &mut [Vec3::zeros(); 3], &[1.0; 3], 1e-3);
        let bias = ((x[1] + x[2] - x[0] * 2.0) / (0.1 * 2f64.sqrt())).norm() - 1.0;
        assert!((0.018..0.02).contains(&bias), "{bias}");
    }
}
