//! Cholesky factor through `faer`: single precision (it only steers the descent, the state is double), one thread, so
//! that the result does not depend on the number of threads.

use super::hessian::Pattern;
use crate::Vec3;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::perm::PermRef;
use faer::sparse::linalg::amd;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side};
use nalgebra::Matrix3;

/// A factorised block matrix.
#[derive(Default)]
pub(crate) struct Factor {
    pattern: Pattern,
    symbolic: Option<SymbolicCholesky<u32>>,
    column: Vec<u32>,
    row: Vec<u32>,
    matrix: Vec<f32>,
    values: Vec<f32>,
    work: Option<MemBuffer>,
    right: Vec<f32>,
    pub analyses: u32,
    pub factors: u32,
}

impl Factor {
    /// Factorises `values` on `pattern` plus `shift` on the diagonal; `false` when it is not positive definite (or the
    /// memory for it is not there).
    pub fn factorise(&mut self, pattern: &Pattern, values: &[Matrix3<f64>], shift: &[f64]) -> bool {
        if (self.symbolic.is_none() || self.pattern != *pattern) && !self.analyse(pattern) {
            return false;
        }
        self.fill(pattern, values, shift);
        self.factors += 1;
        let Some(symbolic) = &self.symbolic else { return false };
        let Some(work) = &mut self.work else { return false };
        let Ok(structure) = structure(&self.column, &self.row) else { return false };
        let matrix = SparseColMatRef::new(structure, &self.matrix);
        let plain = LltRegularization { dynamic_regularization_delta: 0.0, dynamic_regularization_epsilon: 0.0 };
        let stack = MemStack::new(work);
        let done = symbolic.factorize_numeric_llt(
            &mut self.values,
            matrix,
            Side::Lower,
            plain,
            Par::Seq,
            stack,
            Default::default(),
        );
        done.is_ok() && self.values.iter().all(|v| v.is_finite())
    }

    fn analyse(&mut self, pattern: &Pattern) -> bool {
        self.pattern = pattern.clone();
        self.analyses += 1;
        scalar_structure(pattern, &mut self.column, &mut self.row);
        self.matrix = vec![0.0; self.row.len()];
        let Some((forward, backward)) = order(pattern) else { return false };
        let Ok(structure) = structure(&self.column, &self.row) else { return false };
        let n = 3 * pattern.unknowns();
        let order = PermRef::new_checked(&forward, &backward, n);
        let params = CholeskySymbolicParams::default();
        self.symbolic =
            factorize_symbolic_cholesky(structure, Side::Lower, SymmetricOrdering::Custom(order), params).ok();
        let Some(symbolic) = &self.symbolic else { return false };
        self.values = vec![0.0; symbolic.len_val()];
        let need = symbolic
            .factorize_numeric_llt_scratch::<f32>(Par::Seq, Default::default())
            .or(symbolic.solve_in_place_scratch::<f32>(1, Par::Seq));
        self.work = MemBuffer::try_new(need).ok();
        self.right = vec![0.0; n];
        self.work.is_some()
    }

    /// Rounds the blocks into the scalar columns.
    #[allow(clippy::cast_possible_truncation)]
    fn fill(&mut self, pattern: &Pattern, values: &[Matrix3<f64>], shift: &[f64]) {
        let mut at = 0;
        for (j, shift) in shift.iter().enumerate() {
            let blocks = pattern.start[j] as usize..pattern.start[j + 1] as usize;
            for c in 0..3 {
                for k in blocks.clone() {
                    let first = if k == blocks.start { c } else { 0 };
                    for r in first..3 {
                        let mut v = values[k][(r, c)];
                        if k == blocks.start && r == c {
                            v += shift;
                        }
                        self.matrix[at] = v as f32;
                        at += 1;
                    }
                }
            }
        }
    }

    /// Solves for one right-hand side, in place.
    #[allow(clippy::cast_possible_truncation)]
    pub fn solve(&mut self, b: &mut [Vec3]) {
        let (Some(symbolic), Some(work)) = (&self.symbolic, &mut self.work) else { return };
        for (r, v) in self.right.chunks_exact_mut(3).zip(b.iter()) {
            for k in 0..3 {
                r[k] = v[k] as f32;
            }
        }
        let n = self.right.len();
        let right = MatMut::from_column_major_slice_mut(&mut self.right, n, 1);
        LltRef::new(symbolic, &self.values).solve_in_place_with_conj(Conj::No, right, Par::Seq, MemStack::new(work));
        for (r, v) in self.right.chunks_exact(3).zip(b.iter_mut()) {
            *v = Vec3::new(f64::from(r[0]), f64::from(r[1]), f64::from(r[2]));
        }
    }
}

fn structure<'a>(column: &'a [u32], row: &'a [u32]) -> Result<SymbolicSparseColMatRef<'a, u32>, ()> {
    let n = column.len().saturating_sub(1);
    if n == 0 { Err(()) } else { Ok(SymbolicSparseColMatRef::new_checked(n, n, column, None, row)) }
}

fn scalar_structure(pattern: &Pattern, column: &mut Vec<u32>, row: &mut Vec<u32>) {
    column.clear();
    row.clear();
    for j in 0..pattern.unknowns() {
        let blocks = pattern.start[j] as usize..pattern.start[j + 1] as usize;
        for c in 0..3u32 {
            column.push(u32::try_from(row.len()).unwrap_or(u32::MAX));
            for k in blocks.clone() {
                let first = if k == blocks.start { c } else { 0 };
                row.extend((first..3).map(|r| 3 * pattern.rows[k] + r));
            }
        }
    }
    column.push(u32::try_from(row.len()).unwrap_or(u32::MAX));
}

/// A fill-reducing order (approximate minimum degree) of the vertices, three scalars each.
fn order(pattern: &Pattern) -> Option<(Vec<u32>, Vec<u32>)> {
    let n = pattern.unknowns();
    let lower = SymbolicSparseColMatRef::new_checked(n, n, &pattern.start, None, &pattern.rows);
    let (mut forward, mut backward) = (vec![0u32; n], vec![0u32; n]);
    let mut work = MemBuffer::try_new(amd::order_maybe_unsorted_scratch::<u32>(n, pattern.rows.len())).ok()?;
    amd::order_maybe_unsorted(&mut forward, &mut backward, lower, amd::Control::default(), MemStack::new(&mut work))
        .ok()?;
    let thrice = |v: &[u32]| v.iter().flat_map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect::<Vec<u32>>();
    let wide = thrice(&forward);
    let mut back = vec![0u32; 3 * n];
    for (i, p) in (0u32..).zip(&wide) {
        back[*p as usize] = i;
    }
    Some((wide, back))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chain of blocks with a known solution.
    #[test]
    fn solves_a_chain_of_blocks() {
        let n = 7;
        let pattern = Pattern::new(n, (1..7).map(|i| [i - 1, i]).collect());
        let off = Matrix3::new(-1.0, 0.2, 0.0, 0.1, -1.5, 0.3, 0.0, 0.4, -0.5);
        let values: Vec<Matrix3<f64>> = (0..n)
            .flat_map(|j| {
                let mine = pattern.start[j] as usize..pattern.start[j + 1] as usize;
                mine.map(|k| if pattern.rows[k] as usize == j { Matrix3::identity() * 5.0 } else { off })
                    .collect::<Vec<_>>()
            })
            .collect();
        let x: Vec<Vec3> = (0..n).map(|i| Vec3::new(i as f64, 1.0 - i as f64, 0.5)).collect();
        let mut b: Vec<Vec3> = x.iter().map(|v| v * 6.0).collect();
        for i in 1..n {
            b[i] += off * x[i - 1];
            b[i - 1] += off.transpose() * x[i];
        }
        let mut factor = Factor::default();
        assert!(factor.factorise(&pattern, &values, &[1.0; 7]));
        factor.solve(&mut b);
        for (p, q) in x.iter().zip(&b) {
            assert!((p - q).norm() < 1e-5, "{p} {q}");
        }
        assert!(!factor.factorise(&pattern, &values, &[-6.0; 7]));
        assert_eq!(factor.analyses, 1);
    }
}
