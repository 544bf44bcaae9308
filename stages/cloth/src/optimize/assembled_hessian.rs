//! The assembled Hessian of the objective: with the whole bending Hessian, or with a surrogate that couples fewer vertices.

use crate::Vec3;
use crate::energy::Energy;
use crate::energy::stitch_penalty::Seams;
use crate::linear::hessian::Hessian;

/// The Hessian in use, and the other one once it was used.
pub(crate) struct AssembledHessians {
    current: AssembledHessian,
    other: Option<AssembledHessian>,
    /// Do other terms of the energy couple the ends of the springs, as friction in bending does?
    springs_are_coupled: bool,
}

/// A sparse matrix with the springs of the whole bending Hessian or of the surrogate.
struct AssembledHessian {
    hessian: Hessian,
    surrogate: bool,
}

impl AssembledHessians {
    /// Starts with the whole Hessian of `n` unknowns; `index` gives the unknown of every vertex.
    pub fn new(
        cloth: &[Box<dyn Energy>],
        stitches: Option<&Seams>,
        springs_are_coupled: bool,
        index: &[u32],
        n: usize,
    ) -> Self {
        let current = AssembledHessian::new(cloth, stitches, springs_are_coupled, index.to_vec(), n, false);
        Self { current, other: None, springs_are_coupled }
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
        let make = || AssembledHessian::new(cloth, stitches, self.springs_are_coupled, index.to_vec(), n, surrogate);
        let next = self.other.take().unwrap_or_else(make);
        self.other = Some(std::mem::replace(&mut self.current, next));
    }

    pub fn is_surrogate(&self) -> bool {
        self.current.surrogate
    }

    /// The Hessian of the cloth at `x`, projected to be convex or as it is; the other terms are still to be added.
    pub fn of_cloth(&mut self, cloth: &[Box<dyn Energy>], x: &[Vec3], convex: bool) -> &mut Hessian {
        let hessian = &mut self.current.hessian;
        hessian.reset();
        cloth.iter().for_each(|e| e.add_hessian(x, convex, hessian));
        hessian
    }
}

impl AssembledHessian {
    fn new(
        cloth: &[Box<dyn Energy>],
        stitches: Option<&Seams>,
        springs_are_coupled: bool,
        index: Vec<u32>,
        n: usize,
        surrogate: bool,
    ) -> Self {
        let each_spring = |add: &mut dyn FnMut([u32; 2], f64)| {
            cloth.iter().for_each(|e| if surrogate { e.surrogate_springs(add) } else { e.springs(add) });
        };
        let mut pairs = Vec::new();
        cloth.iter().for_each(|e| e.add_pairs(&mut pairs));
        stitches.into_iter().for_each(|t| t.add_pairs(&mut pairs));
        if springs_are_coupled {
            each_spring(&mut |ends, _| pairs.push(ends));
        }
        Self { hessian: Hessian::new(index, n, pairs, each_spring), surrogate }
    }
}
