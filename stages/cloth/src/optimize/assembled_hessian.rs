//! The assembled Hessian of the objective: with the whole bending Hessian, or with a surrogate that couples fewer vertices.

use crate::Vec3;
use crate::energy::Energy;
use crate::energy::stitch_penalty::Seams;
use crate::linear::hessian::Hessian;
use nalgebra::Matrix3;

/// The Hessian in use, and the other one once it was used.
pub(crate) struct AssembledHessians {
    current: AssembledHessian,
    other: Option<AssembledHessian>,
}

/// A sparse matrix, and the values of the energies that are quadratic.
struct AssembledHessian {
    hessian: Hessian,
    constant: ConstantBlocks,
    surrogate: bool,
}

/// Blocks that stay the same wherever the cloth is.
enum ConstantBlocks {
    /// Every block is a multiple of the identity, as those of bending are. This takes a ninth of the memory.
    Isotropic(Vec<f64>),
    /// Blocks of any kind.
    General(Vec<Matrix3<f64>>),
}

impl ConstantBlocks {
    fn new(values: &[Matrix3<f64>]) -> Self {
        let isotropic = |m: &Matrix3<f64>| *m == Matrix3::from_diagonal_element(m[(0, 0)]);
        if values.iter().all(isotropic) {
            return Self::Isotropic(values.iter().map(|m| m[(0, 0)]).collect());
        }
        Self::General(values.to_vec())
    }
}

impl AssembledHessians {
    /// Starts with the whole Hessian of `n` unknowns; `index` gives the unknown of every vertex.
    pub fn new(cloth: &[Box<dyn Energy>], stitches: Option<&Seams>, index: &[u32], n: usize) -> Self {
        Self { current: AssembledHessian::new(cloth, stitches, index.to_vec(), n, false), other: None }
    }

    /// Uses the surrogate or the whole Hessian from now on.
    pub fn choose(
        &mut self,
        surrogate: bool,
        cloth: &[Box<dyn Energy>],
        stitches: Option<&Seams>,
        index: &[u32],
        n: usize,
    ) {
        if surrogate == self.current.surrogate {
            return;
        }
        let make = || AssembledHessian::new(cloth, stitches, index.to_vec(), n, surrogate);
        let next = self.other.take().unwrap_or_else(make);
        self.other = Some(std::mem::replace(&mut self.current, next));
    }

    pub fn is_surrogate(&self) -> bool {
        self.current.surrogate
    }

    /// The Hessian of the cloth at `x`, projected to be convex or as it is; the other terms are still to be added.
    pub fn of_cloth(&mut self, cloth: &[Box<dyn Energy>], x: &[Vec3], convex: bool) -> &mut Hessian {
        self.current.reset(cloth, x, convex);
        &mut self.current.hessian
    }
}

impl AssembledHessian {
    fn new(cloth: &[Box<dyn Energy>], stitches: Option<&Seams>, index: Vec<u32>, n: usize, surrogate: bool) -> Self {
        let mut pairs = Vec::new();
        cloth.iter().for_each(|e| if surrogate { e.add_surrogate_pairs(&mut pairs) } else { e.add_pairs(&mut pairs) });
        stitches.into_iter().for_each(|t| t.add_pairs(&mut pairs));
        let hessian = Hessian::new(index, n, pairs.into_iter());
        let mut assembled = Self { hessian, constant: ConstantBlocks::General(Vec::new()), surrogate };
        // A quadratic energy has the same Hessian everywhere, so any place will do.
        cloth.iter().filter(|e| e.quadratic()).for_each(|e| assembled.add(e.as_ref(), &[], true));
        assembled.constant = ConstantBlocks::new(&assembled.hessian.values);
        assembled.hessian.values = Vec::new();
        assembled
    }

    fn add(&mut self, energy: &dyn Energy, x: &[Vec3], convex: bool) {
        if self.surrogate {
            energy.add_surrogate_hessian(x, convex, &mut self.hessian);
        } else {
            energy.add_hessian(x, convex, &mut self.hessian);
        }
    }

    fn reset(&mut self, cloth: &[Box<dyn Energy>], x: &[Vec3], convex: bool) {
        match &self.constant {
            ConstantBlocks::Isotropic(k) => {
                self.hessian.reset(k.iter().map(|k| Matrix3::from_diagonal_element(*k)));
            }
            ConstantBlocks::General(values) => self.hessian.reset(values.iter().copied()),
        }
        cloth.iter().filter(|e| !e.quadratic()).for_each(|e| self.add(e.as_ref(), x, convex));
    }
}
