//! Second derivatives of triangles side by side, as [`crate::energy::coupled::lanes`] has their forces: what asks no table is worked out for
//! several at once, and every triangle's sums are its own, so their number changes no bit.

use crate::Vec3;
use crate::energy::coupled::{Coupled, Triangle, pulling, tangent};
use crate::linear::hessian::Hessian;
use nalgebra::Matrix3;
use pulp::{Simd, WithSimd};

/// Triangles in a block.
const N: usize = 8;

type Row = [f64; N];
/// By row and column, or by strain and axis.
type Square = [[Row; 3]; 3];

/// Corners of the blocks of a triangle, in the order in which they are added.
const PAIRS: [[usize; 2]; 6] = [[0, 0], [1, 0], [1, 1], [2, 0], [2, 1], [2, 2]];

// A named type, because only such a one is compiled for the widest registers as a whole.
pub(crate) struct Stiff<'a> {
    pub of: &'a Coupled,
    pub x: &'a [Vec3],
    /// Without what may be negative.
    pub convex: bool,
    pub into: &'a mut Hessian,
}

impl WithSimd for Stiff<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let (mut slate, mut vertices, mut count) = (Slate::default(), [[0; 3]; N], 0);
        for (t, w) in self.of.shapes() {
            slate.take(count, &t, &w, self.of, self.x, self.convex);
            vertices[count] = t.vertices;
            count += 1;
            if count == N {
                slate.derive();
                slate.add(&vertices, self.into);
                count = 0;
            }
        }
        if count > 0 {
            slate.derive();
            slate.add(&vertices[..count], self.into);
        }
    }
}

/// What is worked out for a block.
#[derive(Default)]
struct Slate {
    area: Row,
    /// Shape gradients, by corner.
    w: [[Row; 2]; 3],
    /// Stress, and its derivative by the strain.
    stress: [Row; 3],
    law: Square,
    /// How the places change along weft and warp, by axis.
    along: [[Row; 3]; 2],
    /// Derivatives of the three strains by the place of each corner, and of the stress.
    strains: [Square; 3],
    pulls: [Square; 3],
    /// By pair.
    blocks: [Square; 6],
}

// By index throughout: what is not one plain loop over the lanes is not made for wide registers.
#[allow(clippy::needless_range_loop)]
impl Slate {
    /// What of a triangle asks tables.
    #[inline(always)]
    fn take(&mut self, l: usize, t: &Triangle, w: &[[f64; 2]; 3], of: &Coupled, x: &[Vec3], convex: bool) {
        let (stress, law) = tangent(&t.green(&t.edges(x)), &of.fabrics[t.fabric as usize], convex);
        let stress = if convex { pulling(&stress) } else { stress };
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
                    for l in 0..N {
                        block[r][c][l] = a[0][r][l] * b[0][c][l] + a[1][r][l] * b[1][c][l] + a[2][r][l] * b[2][c][l];
                    }
                }
            }
            let ([p, q], [u, v], s) = (&self.w[i], &self.w[j], &self.stress);
            for l in 0..N {
                let lean = self.area[l]
                    * (p[l] * (s[0][l] * u[l] + s[2][l] * v[l]) + q[l] * (s[2][l] * u[l] + s[1][l] * v[l]));
                for k in 0..3 {
                    block[k][k][l] += lean;
                }
            }
        }
    }

    /// By one axis of the place of a corner.
    #[inline(always)]
    fn derive_along(&mut self, k: usize, axis: usize) {
        for l in 0..N {
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
