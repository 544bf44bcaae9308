//! Measured shear: what the cloth carries over the straight line of its shear stiffness (docs/curves.md).

use crate::energy::Energy;
use crate::energy::coupled::triangle::{SHEAR_STRETCH_MIN, Triangle, angle, strain};
use crate::energy::law::Law;
use crate::linear::hessian::Hessian;
use crate::{Element, Scene, Settings, Vec3};

/// A triangle of a fabric with a measured curve.
struct Sheared {
    triangle: Triangle,
    /// Shape gradients.
    gradients: [[f64; 2]; 3],
}

/// All triangles of fabrics with a measured curve of shear.
pub(crate) struct ShearCurve {
    triangles: Vec<Sheared>,
    /// Law of every material.
    laws: Vec<Option<Law>>,
}

/// The shear of a triangle at some places.
struct Lean {
    /// Shear angle, rad.
    angle: f64,
    /// Derivative of the angle by the sine.
    slope: f64,
    edges: [Vec3; 3],
    /// Derivative of the angle by half the square of each edge, 1/m².
    by_edge: [f64; 3],
}

impl Lean {
    fn new(t: &Triangle, x: &[Vec3]) -> Self {
        let edges = t.edges(x);
        let s = strain(&t.green(&edges));
        let (angle, slope) = angle(s.sine);
        let [am, bm] = s.stretch.map(|stretch| stretch.max(SHEAR_STRETCH_MIN));
        let by_stretch = |stretch: f64| if stretch > SHEAR_STRETCH_MIN { -s.sine / (stretch * stretch) } else { 0.0 };
        let by_green = [by_stretch(s.stretch[0]), by_stretch(s.stretch[1]), 1.0 / (am * bm)];
        let by_edge = [0, 1, 2].map(|k| slope * (0..3).map(|r| t.inverse[r][k] * by_green[r]).sum::<f64>());
        Self { angle, slope, edges, by_edge }
    }

    /// Derivative of the angle by the place of each corner, 1/m.
    fn gradient(&self) -> [Vec3; 3] {
        [0, 1, 2].map(|k: usize| {
            let before = (k + 2) % 3;
            self.edges[before] * self.by_edge[before] - self.edges[k] * self.by_edge[k]
        })
    }
}

impl ShearCurve {
    /// `None` where no fabric has a measured curve of shear.
    pub fn new(scene: &Scene, settings: &Settings) -> Option<Self> {
        let law = |curve| Law::above_least_slope(curve, settings.curve_cap());
        let laws: Vec<Option<Law>> = scene.materials.iter().map(|m| m.shear_curve.as_ref().and_then(law)).collect();
        if laws.iter().all(Option::is_none) {
            return None;
        }
        let with_curve = scene.triangles.iter().filter(|e| laws[e.material as usize].is_some());
        let sheared = |e: &Element| Sheared { triangle: Triangle::new(e), gradients: e.gradients() };
        Some(Self { triangles: with_curve.map(sheared).collect(), laws })
    }

    /// All triangles with their laws and their shear.
    fn at<'a>(&'a self, x: &'a [Vec3]) -> impl Iterator<Item = (&'a Sheared, &'a Law, Lean)> + 'a {
        self.triangles.iter().filter_map(|s| {
            let law = self.laws[s.triangle.fabric as usize].as_ref()?;
            Some((s, law, Lean::new(&s.triangle, x)))
        })
    }
}

impl Energy for ShearCurve {
    fn add_forces(&self, x: &[Vec3], f: &mut [Vec3]) {
        self.evaluate(x, f);
    }

    fn energy(&self, x: &[Vec3]) -> f64 {
        self.at(x).map(|(s, law, lean)| s.triangle.area * law.odd(lean.angle).1).sum()
    }

    fn evaluate(&self, x: &[Vec3], f: &mut [Vec3]) -> f64 {
        let mut energy = 0.0;
        for (s, law, lean) in self.at(x) {
            let (force, stored) = law.odd(lean.angle);
            for (v, gradient) in s.triangle.vertices.iter().zip(lean.gradient()) {
                f[*v as usize] -= gradient * (s.triangle.area * force);
            }
            energy += s.triangle.area * stored;
        }
        energy
    }

    fn add_stiffness(&self, x: &[Vec3], k: &mut [f64]) {
        for (s, law, lean) in self.at(x) {
            let shear = law.tangent(lean.angle.abs()) * lean.slope * lean.slope;
            let rate = Triangle::rate(&s.gradients, 0.0, 0.0, 0.0, shear);
            for v in s.triangle.vertices {
                k[v as usize] += s.triangle.area / 3.0 * rate;
            }
        }
    }

    fn add_pairs(&self, pairs: &mut Vec<[u32; 2]>) {
        self.triangles.iter().for_each(|s| crate::energy::clique(&s.triangle.vertices, pairs));
    }

    /// The part that is never negative: slope of the curve times the square of the gradient.
    fn add_hessian(&self, x: &[Vec3], _convex: bool, h: &mut Hessian) {
        for (s, law, lean) in self.at(x) {
            let (gradient, vertices) = (lean.gradient(), s.triangle.vertices);
            let stiff = s.triangle.area * law.slope(lean.angle.abs());
            for i in 0..3 {
                h.add(vertices[i], &(gradient[i] * gradient[i].transpose() * stiff));
                for j in 0..i {
                    h.couple(vertices[i], vertices[j], &(gradient[i] * gradient[j].transpose() * stiff));
                }
            }
        }
    }
}
