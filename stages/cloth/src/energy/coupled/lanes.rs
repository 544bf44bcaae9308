//! Forces of several triangles at once, in vector registers as wide as the machine has.
//!
//! Every triangle has its own sums, so the width of the registers changes no bit.

use crate::Vec3;
use crate::energy::coupled::triangle::{
    SHEAR_SERIES_SINE_MAX, SHEAR_STRETCH_MIN, Triangle, series_angle, stress_and_energy,
};
use crate::energy::law::Fabric;
use crate::energy::strain_limit::Bias;
use pulp::{Arch, Simd, WithSimd};
use std::array::from_fn;

/// Triangles in a block.
const LANES: usize = 32;

type Row = [f64; LANES];

/// One triangle per lane; lanes beyond the last triangle hold a point without area.
struct Block {
    vertices: [[u32; 3]; LANES],
    fabric: [u32; LANES],
    area: Row,
    half: [Row; 3],
    inverse: [[Row; 3]; 3],
}

/// All triangles in blocks.
pub(crate) struct TriangleBlocks {
    blocks: Vec<Block>,
    triangles: usize,
    arch: Arch,
}

impl TriangleBlocks {
    pub fn new(triangles: &[Triangle]) -> Self {
        let blocks = triangles.chunks(LANES).map(Block::new).collect();
        Self { blocks, triangles: triangles.len(), arch: Arch::new() }
    }

    /// The vector instruction set of the machine.
    pub fn arch(&self) -> Arch {
        self.arch
    }

    pub fn triangles(&self) -> impl Iterator<Item = Triangle> + '_ {
        self.blocks.iter().flat_map(|b| (0..LANES).map(|lane| b.triangle(lane))).take(self.triangles)
    }

    /// Adds the forces, N, and returns the energy, J.
    pub fn evaluate(&self, fabrics: &[Fabric], x: &[Vec3], f: &mut [Vec3]) -> f64 {
        self.arch.dispatch(Evaluate { lanes: self, fabrics, x, f })
    }
}

/// The evaluation of all blocks. It is a named type, because only such a type is compiled for the widest registers.
struct Evaluate<'a> {
    lanes: &'a TriangleBlocks,
    fabrics: &'a [Fabric],
    x: &'a [Vec3],
    f: &'a mut [Vec3],
}

impl WithSimd for Evaluate<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> f64 {
        let mut state = BlockState::default();
        let mut energy = 0.0;
        for (k, block) in self.lanes.blocks.iter().enumerate() {
            block.strain(self.x, &mut state);
            block.evaluate_laws(self.fabrics, &mut state);
            block.stress(self.fabrics, &mut state);
            let count = LANES.min(self.lanes.triangles - k * LANES);
            energy = block.pull(&mut state, self.f, energy, count);
        }
        energy
    }
}

/// State of a block of triangles.
#[derive(Default)]
struct BlockState {
    /// Edge vectors, by edge and axis, m.
    edges: [[Row; 3]; 3],
    green: [Row; 3],
    /// Strain along weft and warp.
    strain: [Row; 2],
    /// Inverse of the stretch along weft and warp.
    inverse: [Row; 2],
    sine: Row,
    /// Tensions, then the stress conjugate to the Green strain, N/m.
    stress: [Row; 3],
    shear: Row,
    /// Green strain from which the bias locks.
    locks: Row,
    /// Energy per area, J/m².
    energy: Row,
    /// Force of each edge, by axis, N.
    pulls: [[Row; 3]; 3],
}

impl BlockState {
    /// Returns `true` for a lane that is neither sheared far nor nearly collapsed nor locked on the bias.
    #[inline(always)]
    fn is_regular(&self, l: usize) -> bool {
        let green = [self.green[0][l], self.green[1][l], self.green[2][l]];
        (self.sine[l].abs() < SHEAR_SERIES_SINE_MAX)
            & (self.strain[0][l].min(self.strain[1][l]) > SHEAR_STRETCH_MIN - 1.0)
            & (Bias::largest(green) <= self.locks[l])
    }
}

// All loops go by index, because only plain loops over the lanes are compiled for wide registers.
#[allow(clippy::needless_range_loop)]
impl Block {
    /// A block of at least one triangle, and at most as many as there are lanes.
    fn new(triangles: &[Triangle]) -> Self {
        let mut block = Self::at(triangles[0].vertices[0]);
        for (lane, t) in triangles.iter().enumerate() {
            block.vertices[lane] = t.vertices;
            block.fabric[lane] = t.fabric;
            block.area[lane] = t.area;
            for r in 0..3 {
                block.half[r][lane] = t.half[r];
                (0..3).for_each(|c| block.inverse[r][c][lane] = t.inverse[r][c]);
            }
        }
        block
    }

    /// A block of points without area.
    fn at(point: u32) -> Self {
        let zero = [0.0; LANES];
        Self { vertices: [[point; 3]; LANES], fabric: [0; LANES], area: zero, half: [zero; 3], inverse: [[zero; 3]; 3] }
    }

    fn triangle(&self, lane: usize) -> Triangle {
        Triangle {
            vertices: self.vertices[lane],
            fabric: self.fabric[lane],
            area: self.area[lane],
            half: from_fn(|k| self.half[k][lane]),
            inverse: from_fn(|r| from_fn(|c| self.inverse[r][c][lane])),
        }
    }

    /// Edges, and their stretch and shear.
    #[inline(always)]
    fn strain(&self, x: &[Vec3], s: &mut BlockState) {
        for (lane, v) in self.vertices.iter().enumerate() {
            let [a, b, c] = crate::pick3(x, v);
            for axis in 0..3 {
                s.edges[0][axis][lane] = b[axis] - a[axis];
                s.edges[1][axis][lane] = c[axis] - b[axis];
                s.edges[2][axis][lane] = a[axis] - c[axis];
            }
        }
        for l in 0..LANES {
            let mut q = [0.0; 3];
            for k in 0..3 {
                let [x, y, z] = [s.edges[k][0][l], s.edges[k][1][l], s.edges[k][2][l]];
                q[k] = 0.5 * (x * x + y * y + z * z) - self.half[k][l];
            }
            let mut green = [0.0; 3];
            for k in 0..3 {
                let m = &self.inverse[k];
                green[k] = m[0][l] * q[0] + m[1][l] * q[1] + m[2][l] * q[2];
                s.green[k][l] = green[k];
            }
            let (a, b) = ((1.0 + 2.0 * green[0]).max(0.0).sqrt(), (1.0 + 2.0 * green[1]).max(0.0).sqrt());
            let (ia, ib) = (1.0 / a.max(SHEAR_STRETCH_MIN), 1.0 / b.max(SHEAR_STRETCH_MIN));
            (s.strain[0][l], s.strain[1][l]) = (a - 1.0, b - 1.0);
            (s.inverse[0][l], s.inverse[1][l]) = (ia, ib);
            s.sine[l] = green[2] * ia * ib;
        }
    }

    /// Tensions and energies by the tables.
    #[inline(always)]
    fn evaluate_laws(&self, fabrics: &[Fabric], s: &mut BlockState) {
        for l in 0..LANES {
            let fabric = &fabrics[self.fabric[l] as usize];
            let (a, b) = (s.strain[0][l], s.strain[1][l]);
            let ((weft, e), (warp, g)) = (fabric.weft.tension_and_energy(a), fabric.warp.tension_and_energy(b));
            s.stress[0][l] = weft + fabric.cross * b;
            s.stress[1][l] = warp + fabric.cross * a;
            s.energy[l] = e + g + fabric.cross * a * b;
            s.shear[l] = fabric.shear;
            s.locks[l] = fabric.bias.from();
        }
    }

    #[inline(always)]
    fn stress(&self, fabrics: &[Fabric], s: &mut BlockState) {
        let mut all_regular = true;
        for l in 0..LANES {
            all_regular &= s.is_regular(l);
        }
        for l in 0..LANES {
            let (ia, ib, sine) = (s.inverse[0][l], s.inverse[1][l], s.sine[l]);
            let (gamma, slope) = series_angle(sine);
            let tau = s.shear[l] * gamma * slope;
            let lean = tau * sine;
            s.energy[l] += 0.5 * s.shear[l] * gamma * gamma;
            s.stress[0][l] = s.stress[0][l] * ia - lean * (ia * ia);
            s.stress[1][l] = s.stress[1][l] * ib - lean * (ib * ib);
            s.stress[2][l] = tau * (ia * ib);
        }
        if !all_regular {
            self.replace_irregular(fabrics, s);
        }
    }

    /// Works out one by one the lanes that are sheared far, nearly collapsed or locked on the bias.
    fn replace_irregular(&self, fabrics: &[Fabric], s: &mut BlockState) {
        for l in 0..LANES {
            if s.is_regular(l) {
                continue;
            }
            let green = [s.green[0][l], s.green[1][l], s.green[2][l]];
            let (stress, energy) = stress_and_energy(&green, &fabrics[self.fabric[l] as usize]);
            (0..3).for_each(|k| s.stress[k][l] = stress[k]);
            s.energy[l] = energy;
        }
    }

    /// Adds the forces of the first `count`, and their energy to `energy`.
    #[inline(always)]
    fn pull(&self, s: &mut BlockState, f: &mut [Vec3], mut energy: f64, count: usize) -> f64 {
        for l in 0..LANES {
            for k in 0..3 {
                let m = &self.inverse;
                let sum = m[0][k][l] * s.stress[0][l] + m[1][k][l] * s.stress[1][l] + m[2][k][l] * s.stress[2][l];
                let pull = self.area[l] * sum;
                for axis in 0..3 {
                    s.pulls[k][axis][l] = s.edges[k][axis][l] * pull;
                }
            }
        }
        for l in 0..count {
            let [p, q, r] = [0, 1, 2].map(|k| Vec3::new(s.pulls[k][0][l], s.pulls[k][1][l], s.pulls[k][2][l]));
            let [a, b, c] = self.vertices[l];
            f[a as usize] += p - r;
            f[b as usize] += q - p;
            f[c as usize] += r - q;
            energy += self.area[l] * s.energy[l];
        }
        energy
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Curve, Element, Material, Settings};

    /// Triangles at rest, stretched, locked, sheared far and nearly collapsed, more of them than one block holds.
    #[test]
    fn side_by_side_triangles_pull_as_each_would_alone() {
        let mut material = Material::isotropic(0.1, 700.0, 0.2, 1e-5);
        material.warp = Curve::Exponential { k0: 700.0, beta: 20.0 };
        material.strain_limit = [f64::INFINITY, 0.3, 0.25];
        let fabrics = [Fabric::new(&material, &Settings::default())];
        let (mut triangles, mut x) = (Vec::new(), Vec::new());
        for k in 0..45u32 {
            let rest = [[0.0, 0.0], [0.01, 0.001], [0.002, 0.009]];
            let (long, lean) = (0.1 + 0.04 * f64::from(k % 30), 0.03 * f64::from(k));
            let vertices = [3 * k, 3 * k + 1, 3 * k + 2];
            triangles.push(Triangle::new(&Element { vertices, rest, material: 0 }));
            x.extend(rest.map(|[u, v]| Vec3::new(long * u + lean * v, 0.9 * v, 0.3 * u * v)));
        }
        let (mut f, mut alone) = (vec![Vec3::zeros(); x.len()], vec![Vec3::zeros(); x.len()]);
        let energy = TriangleBlocks::new(&triangles).evaluate(&fabrics, &x, &mut f);
        let mut sum = 0.0;
        for t in &triangles {
            let e = t.edges(&x);
            let (s, per_area) = stress_and_energy(&t.green(&e), &fabrics[0]);
            sum += t.area * per_area;
            for k in 0..3 {
                let m = &t.inverse;
                let pull = e[k] * (t.area * (m[0][k] * s[0] + m[1][k] * s[1] + m[2][k] * s[2]));
                alone[t.vertices[k] as usize] += pull;
                alone[t.vertices[(k + 1) % 3] as usize] -= pull;
            }
        }
        assert!((energy / sum - 1.0).abs() < 1e-12, "{energy} and {sum}");
        let most = crate::longest(&alone);
        assert!(crate::farthest(&f, &alone) < 1e-12 * most, "{} of {most}", crate::farthest(&f, &alone));
    }
}
