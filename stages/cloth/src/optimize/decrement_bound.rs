//! A lower bound of the Newton decrement without a factorisation, by conjugate gradients. It tells large cloth that is far from
//! rest, whose factorisation costs more than all coarser levels.

use crate::Vec3;
use crate::linear::system::System;
use crate::optimize::descent::Descent;
use crate::optimize::lbfgs::dot;
use crate::optimize::tuning::{BOUND_MARGIN, BOUND_STEPS};

impl Descent<'_> {
    /// Does a Newton step surely gain more than this share of the elastic energy, with contacts and friction as at their last
    /// refresh?
    pub fn surely_gains(&mut self, share: f64) -> bool {
        let mut system = self.assemble(true);
        system.add_to_diagonal(self.shift());
        let wanted = BOUND_MARGIN.get() * share * self.elastic_scale();
        0.5 * decrement_bound(&system, &self.f, 2.0 * wanted) > wanted
    }
}

/// A lower bound of fᵀ A⁻¹ f. Each step of conjugate gradients (Hestenes and Stiefel 1952) raises it; it is not raised further
/// once it is over `enough`. The blocks of the diagonal are the preconditioner.
fn decrement_bound(system: &System, f: &[Vec3], enough: f64) -> f64 {
    let blocks = system.diagonal().map(|m| m.try_inverse());
    let Some(inverse) = blocks.collect::<Option<Vec<_>>>() else { return 0.0 };
    let preconditioned = |r: &[Vec3]| -> Vec<Vec3> { inverse.iter().zip(r).map(|(m, r)| m * r).collect() };
    let mut r = f.to_vec();
    let mut p = preconditioned(&r);
    let (mut gamma, mut bound) = (dot(&r, &p), 0.0);
    for _ in 0..BOUND_STEPS.get() {
        let q = system.times(&p);
        let curvature = dot(&p, &q);
        if gamma <= 0.0 || curvature <= 0.0 || bound > enough {
            break;
        }
        let step = gamma / curvature;
        bound += step * gamma;
        r.iter_mut().zip(&q).for_each(|(r, q)| *r -= q * step);
        let z = preconditioned(&r);
        let next = dot(&r, &z);
        let turn = next / gamma;
        p.iter_mut().zip(&z).for_each(|(p, z)| *p = z + *p * turn);
        gamma = next;
    }
    bound
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::pattern::Pattern;
    use nalgebra::Matrix3;

    /// A chain of unit springs held at one end: the bound grows with the steps and never passes the truth.
    #[test]
    fn the_bound_rises_to_the_truth_and_not_beyond() {
        let n = 25u32;
        let pattern = Pattern::new(n as usize, (1..n).map(|k| [k - 1, k]).collect());
        let mut values = vec![Matrix3::zeros(); pattern.rows.len()];
        for k in 0..n {
            let at = pattern.start[k as usize] as usize;
            values[at] = Matrix3::from_diagonal_element(if k + 1 < n { 2.0 } else { 1.0 });
            if k + 1 < n {
                values[at + 1] = Matrix3::from_diagonal_element(-1.0);
            }
        }
        let system = System::of_blocks(pattern, values);
        let mut f = vec![Vec3::zeros(); n as usize];
        f[n as usize - 1] = Vec3::new(0.0, 2.0, 0.0);
        // A force of 2 at the end of 25 springs in a row.
        let truth = 4.0 * f64::from(n);
        let whole = decrement_bound(&system, &f, f64::INFINITY);
        assert!((whole / truth - 1.0).abs() < 1e-12, "{whole}");
        let part = decrement_bound(&system, &f, 0.3 * truth);
        assert!(part > 0.3 * truth && part < 0.9 * truth, "{part}");
    }
}
