//! Where the second derivatives of an objective are worked out: on all couplings of the cloth, or on fewer.

use crate::Vec3;
use crate::energy::Energy;
use crate::energy::stitch_penalty::Seams;
use crate::linear::hessian::Hessian;
use nalgebra::Matrix3;

/// A matrix, and the values of what is quadratic.
pub(crate) struct Slate {
    pub hessian: Hessian,
    constant: Constant,
    pub rough: bool,
}

/// Blocks that stay the same.
enum Constant {
    /// As stiff in all directions, as bending is: a ninth of the memory.
    Even(Vec<f64>),
    Any(Vec<Matrix3<f64>>),
}

impl Constant {
    fn of(values: &[Matrix3<f64>]) -> Self {
        let even = |m: &Matrix3<f64>| *m == Matrix3::from_diagonal_element(m[(0, 0)]);
        if values.iter().all(even) {
            return Self::Even(values.iter().map(|m| m[(0, 0)]).collect());
        }
        Self::Any(values.to_vec())
    }
}

impl Slate {
    pub fn new(energies: &[Box<dyn Energy>], seams: Option<&Seams>, unknown: Vec<u32>, n: usize, rough: bool) -> Self {
        let mut pairs = Vec::new();
        energies.iter().for_each(|e| if rough { e.add_rough_pairs(&mut pairs) } else { e.add_pairs(&mut pairs) });
        seams.into_iter().for_each(|t| t.add_pairs(&mut pairs));
        let mut slate =
            Self { hessian: Hessian::new(unknown, n, pairs.into_iter()), constant: Constant::Any(Vec::new()), rough };
        // What is the same everywhere needs no place.
        energies.iter().filter(|e| e.quadratic()).for_each(|e| slate.add(e.as_ref(), &[], true));
        slate.constant = Constant::of(&slate.hessian.values);
        slate.hessian.values = Vec::new();
        slate
    }

    fn add(&mut self, energy: &dyn Energy, x: &[Vec3], convex: bool) {
        if self.rough {
            energy.add_rough_hessian(x, convex, &mut self.hessian);
        } else {
            energy.add_hessian(x, convex, &mut self.hessian);
        }
    }

    /// Only the cloth's.
    pub fn start(&mut self, energies: &[Box<dyn Energy>], x: &[Vec3], convex: bool) {
        match &self.constant {
            Constant::Even(k) => self.hessian.reset(k.iter().map(|k| Matrix3::from_diagonal_element(*k))),
            Constant::Any(values) => self.hessian.reset(values.iter().copied()),
        }
        energies.iter().filter(|e| !e.quadratic()).for_each(|e| self.add(e.as_ref(), x, convex));
    }
}
