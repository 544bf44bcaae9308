//! Second derivatives of several triangles at once, in vector registers.
//!
//! Forces are in [`crate::energy::coupled::lanes`]. Every triangle has its own sums, so the number of lanes changes no
//! bit.

use crate::energy::coupled::lanes::TriangleBlocks;
use crate::energy::coupled::triangle::{Triangle, tangent, tensile_part};
use crate::energy::law::Fabric;
use crate::linear::hessian::Hessian;
use crate::{Element, Vec3};
use nalgebra::Matrix3;
use pulp::{Simd, WithSimd};

/// Triangles in a block.
const HESSIAN_LANES: usize = 8;

type Row = [f64; HESSIAN_LANES];
/// Values by row and column, or by strain and axis.
type Square = [[Row; 3]; 3];

/// Corners of the blocks of a triangle, in the order in which they are added.
const PAIRS: [[usize; 2]; 6] = [[0, 0], [1, 0], [1, 1], [2, 0], [2, 1], [2, 2]];

/// The assembly of the Hessian. It is a named type, because only such a type is compiled for the widest registers.
pub(crate) struct AssembleHessian<'a> {
    pub triangles: &'a TriangleBlocks,
    /// The elements of the scene, for their shape gradients.
    pub elements: &'a [Element],
    pub fabrics: &'a [Fabric],
    pub x: &'a [Vec3],
    /// Leaves out the terms that may be negative.
    pub convex: bool,
    pub into: &'a mut Hessian,
}

impl WithSimd for AssembleHessian<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let (mut state, mut vertices, mut count) = (BlockState::default(), [[0; 3]; HESSIAN_LANES], 0);
        for (t, w) in self.triangles.triangles().zip(self.elements.iter().map(Element::gradients)) {
            state.take(count, &t, &w, &self.fabrics[t.fabric as usize], self.x, self.convex);
            vertices[count] = t.vertices;
            count += 1;
            if count == HESSIAN_LANES {
                state.derive();
                state.add(&vertices, self.into);
                count = 0;
            }
        }
        if count > 0 {
            state.derive();
            state.add(&vertices[..count], self.into);
        }
    }
}

/// State of a block of triangles.
#[derive(Default)]
struct BlockState {
    area: Row,
    /// Shape gradients, by corner.
    w: [[Row; 2]; 3],
    /// Stress, and its derivative by the strain.
    stress: [Row; 3],
    law: Square,
    /// Deformed directions of weft and warp, by axis.
    along: [[Row; 3]; 2],
    /// Derivatives of the three strains by the place of each corner.
    strains: [Square; 3],
    /// Derivatives of the stress by the place of each corner, times the area.
    pulls: [Square; 3],
    /// Blocks of the Hessian, by pair of corners.
    blocks: [Square; 6],
}

// All loops go by index, because only plain loops over the lanes are compiled for wide registers.
#[allow(clippy::needless_range_loop)]
impl BlockState {
    /// Takes in a triangle: the part of the work that needs tables.
    #[inline(always)]
    fn take(&mut self, l: usize, t: &Triangle, w: &[[f64; 2]; 3], fabric: &Fabric, x: &[Vec3], convex: bool) {
        let (stress, law) = tangent(&t.green(&t.edges(x)), fabric, convex);
        let stress = if convex { tensile_part(&stress) } else { stress };
        let places = crate::pick3(x, &t.vertices);
        self.area[l] = t.area;
        for k in 0..3 {
            self.stress[k][l] = stress[k];
            (0..2).for_each(|c| self.w[k][c][l] = w[k][c]);
            (0..3).for_each(|c| self.law[k][c][l] = law[(k, c)]);
        }
        for c in 0..2 {
            let along = places[0] * w[0][c] + places[1] * w[1][c] + places[2] * w[2][c];
            (0..3).for_each(|axis| self.along[c][axis][l] = along[axis]);
        }
    }

    #[inline(always)]
    fn derive(&mut self) {
        for k in 0..3 {
            for axis in 0..3 {
                self.derive_along(k, axis);
            }
        }
        for (pair, [i, j]) in PAIRS.into_iter().enumerate() {
            let (block, a, b) = (&mut self.blocks[pair], &self.strains[i], &self.pulls[j]);
            for r in 0..3 {
                for c in 0..3 {
                    for l in 0..HESSIAN_LANES {
                        block[r][c][l] = a[0][r][l] * b[0][c][l] + a[1][r][l] * b[1][c][l] + a[2][r][l] * b[2][c][l];
                    }
                }
            }
            let ([p, q], [u, v], s) = (&self.w[i], &self.w[j], &self.stress);
            for l in 0..HESSIAN_LANES {
                let lean = self.area[l]
                    * (p[l] * (s[0][l] * u[l] + s[2][l] * v[l]) + q[l] * (s[2][l] * u[l] + s[1][l] * v[l]));
                for k in 0..3 {
                    block[k][k][l] += lean;
                }
            }
        }
    }

    /// Derivatives by one axis of the place of a corner.
    #[inline(always)]
    fn derive_along(&mut self, k: usize, axis: usize) {
        for l in 0..HESSIAN_LANES {
            let (weft, warp) = (self.along[0][axis][l], self.along[1][axis][l]);
            let (u, v) = (self.w[k][0][l], self.w[k][1][l]);
            let d = [weft * u, warp * v, warp * u + weft * v];
            for r in 0..3 {
                let law = &self.law[r];
                self.strains[k][r][axis][l] = d[r];
                self.pulls[k][r][axis][l] = (law[0][l] * d[0] + law[1][l] * d[1] + law[2][l] * d[2]) * self.area[l];
            }
        }
    }

    #[inline(always)]
    fn add(&self, vertices: &[[u32; 3]], into: &mut Hessian) {
        for (l, vertices) in vertices.iter().enumerate() {
            for (block, [i, j]) in self.blocks.iter().zip(PAIRS) {
                let block = Matrix3::from_fn(|r, c| block[r][c][l]);
                if i == j {
                    into.add(vertices[i], &block);
                } else {
                    into.couple(vertices[i], vertices[j], &block);
                }
            }
        }
    }
}
