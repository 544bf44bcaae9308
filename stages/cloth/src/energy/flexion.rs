//! Flexion springs of the paper (class 3: the cloth's bending) as moment springs on the hinges between triangles
//! (docs/flexion.md): E = ½ k |u₂ + u₃|², u the unit vectors across the wings, so |u₂ + u₃| = 2 sin(θ/2).
//! The form is quadratic in the positions, so it cannot blow up, and needs lengths only, so it works across seams.

use super::Energy;
use crate::linear::hessian::Hessian;
use crate::topology::{Hinge, Topology};
use crate::{Element, Material, Scene, Settings, Vec3};

struct Moment {
    vertices: [u32; 4],
    /// Weights of the four vertices in u₂ + u₃, 1/m.
    weights: [f64; 4],
    /// N·m.
    stiffness: f64,
}

pub(crate) struct Flexion {
    moments: Vec<Moment>,
}

/// Foot of a wing's altitude on the edge (share of the way from end 0 to end 1), altitude and edge length.
fn wing(e: &Element, side: usize, reversed: bool) -> (f64, f64, f64) {
    let (a, b, c) = (e.rest[side], e.rest[(side + 1) % 3], e.rest[(side + 2) % 3]);
    let length = e.rest_length(side);
    let along = ((c[0] - a[0]) * (b[0] - a[0]) + (c[1] - a[1]) * (b[1] - a[1])) / (length * length);
    (if reversed { 1.0 - along } else { along }, 2.0 * e.area().abs() / length, length)
}

/// Bending rigidity of a material for a hinge whose edge lies at this angle to the weft, N·m. Bending across an edge
/// along the weft bends the warp.
fn rigidity(m: &Material, cos: f64, sin: f64) -> f64 {
    let (cc, ss) = (cos * cos, sin * sin);
    let twist = match m.bend_bias {
        Some(bias) => 4.0 * bias - m.bend_warp - m.bend_weft,
        None => 2.0 * (m.bend_warp * m.bend_weft).sqrt(),
    };
    (m.bend_warp * cc * cc + m.bend_weft * ss * ss + twist * cc * ss).max(0.0)
}

fn moment(h: &Hinge, scene: &Scene, factor: f64) -> Moment {
    let mut weights = [0.0; 4];
    let (mut bend, mut length, mut area) = (0.0, 0.0, 0.0);
    for w in 0..2 {
        let e = &scene.triangles[h.faces[w] as usize];
        let side = usize::from(h.sides[w]);
        let (along, altitude, l) = wing(e, side, e.vertices[side] != h.vertices[0]);
        weights[0] -= (1.0 - along) / altitude;
        weights[1] -= along / altitude;
        weights[2 + w] += 1.0 / altitude;
        let (a, b) = (e.rest[side], e.rest[(side + 1) % 3]);
        bend += 0.5 * rigidity(&scene.materials[e.material as usize], (b[0] - a[0]) / l, (b[1] - a[1]) / l);
        length += 0.5 * l;
        area += e.area().abs();
    }
    Moment { vertices: h.vertices, weights, stiffness: bend * length * length / (area * factor) }
}

impl Flexion {
    pub fn new(scene: &Scene, topology: &Topology, settings: &Settings) -> Self {
        let moments = topology.hinges.iter().map(|h| moment(h, scene, settings.bending_mesh_factor));
        Self { moments: moments.filter(|m| m.stiffness > 0.0).collect() }
    }
}

impl Moment {
    #[inline]
    fn fold(&self, x: &[Vec3]) -> Vec3 {
        let [a, b, c, d] = crate::pick4(x, &self.vertices);
        let w = &self.weights;
        a * w[0] + b * w[1] + c * w[2] + d * w[3]
    }

    /// Adds the forces of a fold.
    #[inline]
    fn push(&self, fold: &Vec3, f: &mut [Vec3]) {
        let u = fold * -self.stiffness;
        for k in 0..4 {
            f[self.vertices[k] as usize] += u * self.weights[k];
        }
    }
}

impl Energy for Flexion {
    fn add_forces(&self, x: &[Vec3], f: &mut [Vec3]) {
        self.moments.iter().for_each(|m| m.push(&m.fold(x), f));
    }

    fn energy(&self, x: &[Vec3]) -> f64 {
        self.moments.iter().map(|m| 0.5 * m.stiffness * m.fold(x).norm_squared()).sum()
    }

    fn evaluate(&self, x: &[Vec3], f: &mut [Vec3]) -> f64 {
        let mut energy = 0.0;
        for m in &self.moments {
            let fold = m.fold(x);
            energy += 0.5 * m.stiffness * fold.norm_squared();
            m.push(&fold, f);
        }
        energy
    }

    fn add_stiffness(&self, _: &[Vec3], k: &mut [f64]) {
        for m in &self.moments {
            let sum: f64 = m.weights.iter().map(|w| w.abs()).sum();
            for (v, w) in m.vertices.iter().zip(&m.weights) {
                k[*v as usize] += m.stiffness * w.abs() * sum;
            }
        }
    }

    fn add_pairs(&self, pairs: &mut Vec<[u32; 2]>) {
        self.moments.iter().for_each(|m| super::clique(&m.vertices, pairs));
    }

    fn add_hessian(&self, _: &[Vec3], _: bool, h: &mut Hessian) {
        for m in &self.moments {
            h.spread(&m.vertices, &m.weights, &(nalgebra::Matrix3::identity() * m.stiffness));
        }
    }

    fn quadratic(&self) -> bool {
        true
    }
}
