//! Is a start so far from rest that coarser cloth is to find the way? Told without a factor where it can: that of large cloth
//! costs more than all of its coarser levels.

use crate::Vec3;
use crate::linear::hessian::Pattern;
use crate::optimize::descent::Descent;
use crate::optimize::lbfgs::dot;
use nalgebra::Matrix3;

/// Steps of conjugate gradients after which only the factor can tell.
const MOST: usize = 30;
/// What a bound must be over what it is to prove: the factor is in single precision.
const SURELY: f64 = 1.05;

impl Descent<'_> {
    /// Does a Newton step surely win more than so much of what is stored, with contacts and friction as last told?
    pub fn surely_wins(&mut self, share: f64) -> bool {
        let (pattern, mut values) = self.assemble(true);
        let shift = self.shift();
        let diagonal = pattern.start.iter().zip(shift);
        diagonal.for_each(|(k, s)| values[*k as usize] += Matrix3::from_diagonal_element(s));
        let wanted = SURELY * share * self.scale();
        0.5 * least_win(&pattern, &values, &self.f, 2.0 * wanted) > wanted
    }
}

/// A lower bound of fᵀ A⁻¹ f, which each step of conjugate gradients (Hestenes and Stiefel 1952; preconditioned by the blocks of
/// the diagonal) raises; not raised further once it is over `enough`.
fn least_win(pattern: &Pattern, values: &[Matrix3<f64>], f: &[Vec3], enough: f64) -> f64 {
    let blocks = pattern.start.iter().take(f.len()).map(|k| values[*k as usize].try_inverse());
    let Some(inverse) = blocks.collect::<Option<Vec<_>>>() else { return 0.0 };
    let eased = |r: &[Vec3]| -> Vec<Vec3> { inverse.iter().zip(r).map(|(m, r)| m * r).collect() };
    let mut r = f.to_vec();
    let mut p = eased(&r);
    let (mut gamma, mut win) = (dot(&r, &p), 0.0);
    for _ in 0..MOST {
        let q = pattern.times(values, &p);
        let bend = dot(&p, &q);
        if gamma <= 0.0 || bend <= 0.0 || win > enough {
            break;
        }
        let step = gamma / bend;
        win += step * gamma;
        r.iter_mut().zip(&q).for_each(|(r, q)| *r -= q * step);
        let z = eased(&r);
        let next = dot(&r, &z);
        let turn = next / gamma;
        p.iter_mut().zip(&z).for_each(|(p, z)| *p = z + *p * turn);
        gamma = next;
    }
    win
}

#[cfg(test)]
mod tests {
    use super::*;

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
        let mut f = vec![Vec3::zeros(); n as usize];
        f[n as usize - 1] = Vec3::new(0.0, 2.0, 0.0);
        // A force of 2 at the end of 25 springs in a row.
        let truth = 4.0 * f64::from(n);
        let whole = least_win(&pattern, &values, &f, f64::INFINITY);
        assert!((whole / truth - 1.0).abs() < 1e-12, "{whole}");
        let part = least_win(&pattern, &values, &f, 0.3 * truth);
        assert!(part > 0.3 * truth && part < 0.9 * truth, "{part}");
    }
}
