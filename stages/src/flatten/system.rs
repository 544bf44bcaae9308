//! The sparse matrix of the solver: 2×2 blocks, lower triangle, one symbolic factor for all rounds.

use super::energy::Local;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side};
use nalgebra::Matrix2;
use toile_garment::Vec2;

/// A symmetric positive system over the vertices, with some coordinates held.
pub struct System {
    /// Start of each block column in `rows`; the first block of a column is its diagonal.
    block_start: Vec<usize>,
    /// Row vertex of every block.
    block_row: Vec<u32>,
    col_ptr: Vec<u32>,
    row_idx: Vec<u32>,
    held: Vec<[bool; 2]>,
    symbolic: SymbolicCholesky<u32>,
    /// Entries, lower triangle.
    values: Vec<f64>,
    /// Entries of the factor.
    factor: Vec<f64>,
    /// Right side, then the solution.
    pub rhs: Vec<Vec2>,
}

/// Why a system could not be set up or solved.
#[derive(Debug, thiserror::Error)]
pub enum SystemError {
    /// Too many vertices, or no memory for the factor.
    #[error("no memory for the factor of {0} vertices")]
    Memory(usize),
    /// Not positive definite: the mesh is broken.
    #[error("the system is not positive definite")]
    NotPositive,
}

impl System {
    /// A system whose terms couple the vertices of each group.
    ///
    /// # Errors
    /// When memory runs out.
    pub fn new<'a>(held: Vec<[bool; 2]>, groups: impl Iterator<Item = &'a [u32]>) -> Result<Self, SystemError> {
        let n = held.len();
        let dofs = u32::try_from(n).ok().and_then(|n| n.checked_mul(2)).ok_or(SystemError::Memory(n))?;
        let mut blocks: Vec<(u32, u32)> = (0..dofs / 2).map(|v| (v, v)).collect();
        for group in groups {
            for &a in group {
                blocks.extend(group.iter().filter(|b| **b > a).map(|b| (a, *b)));
            }
        }
        blocks.sort_unstable();
        blocks.dedup();
        let (block_start, block_row, col_ptr, row_idx) = pattern(n, &blocks)?;
        let matrix = SymbolicSparseColMatRef::new_checked(dofs as usize, dofs as usize, &col_ptr, None, &row_idx);
        // Entry by entry: kernels on blocks choose the order of their sums by the processor.
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SIMPLICIAL,
            ..CholeskySymbolicParams::default()
        };
        let symbolic = factorize_symbolic_cholesky(matrix, Side::Lower, SymmetricOrdering::Amd, params)
            .map_err(out_of_memory(n))?;
        let (values, factor) = (vec![0.0; row_idx.len()], vec![0.0; symbolic.len_val()]);
        let rhs = vec![Vec2::zeros(); n];
        Ok(Self { block_start, block_row, col_ptr, row_idx, held, symbolic, values, factor, rhs })
    }

    /// Forgets entries and right side.
    pub fn clear(&mut self) {
        self.values.fill(0.0);
        self.rhs.fill(Vec2::zeros());
    }

    /// Adds a term: its Hessian, and minus its gradient to the right side.
    pub fn add<const N: usize>(&mut self, v: &[u32; N], term: &Local<N>) {
        for i in 0..N {
            self.rhs[v[i] as usize] -= term.gradient[i];
            for j in 0..N {
                if v[i] >= v[j] {
                    self.add_block(v[i], v[j], &term.hessian[i][j]);
                }
            }
        }
    }

    fn add_block(&mut self, row: u32, col: u32, m: &Matrix2<f64>) {
        let c = col as usize;
        let (from, to) = (self.block_start[c], self.block_start[c + 1]);
        let Ok(k) = self.block_row[from..to].binary_search(&row) else { return };
        let (first, second) = (self.col_ptr[2 * c] as usize, self.col_ptr[2 * c + 1] as usize);
        let free = |r: usize, d: usize| !self.held[row as usize][r] && !self.held[c][d];
        let (f00, f10, f01, f11) = (free(0, 0), free(1, 0), free(0, 1), free(1, 1));
        let mut put = |at: usize, on: bool, value: f64| {
            if on {
                self.values[at] += value;
            }
        };
        put(first + 2 * k, f00, m.m11);
        put(first + 2 * k + 1, f10, m.m21);
        if k > 0 {
            put(second + 2 * k - 1, f01, m.m12);
        }
        put(second + 2 * k, f11, m.m22);
    }

    /// Factors the matrix that was added.
    ///
    /// # Errors
    /// When the matrix is not positive definite.
    pub fn factorize(&mut self) -> Result<(), SystemError> {
        let n = self.held.len();
        for (v, held) in self.held.iter().enumerate() {
            for (d, held) in held.iter().enumerate() {
                if *held {
                    self.values[self.col_ptr[2 * v + d] as usize] = 1.0;
                }
            }
        }
        let symbolic = SymbolicSparseColMatRef::new_checked(2 * n, 2 * n, &self.col_ptr, None, &self.row_idx);
        let matrix = SparseColMatRef::new(symbolic, self.values.as_slice());
        let mut memory =
            MemBuffer::try_new(self.symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default()))
                .map_err(|_| SystemError::Memory(n))?;
        self.symbolic
            .factorize_numeric_llt(
                &mut self.factor,
                matrix,
                Side::Lower,
                LltRegularization::default(),
                Par::Seq,
                MemStack::new(&mut memory),
                Default::default(),
            )
            .map_err(|_| SystemError::NotPositive)?;
        Ok(())
    }

    /// Solves with the factor; the solution stands in `rhs`, zero where a coordinate is held.
    ///
    /// # Errors
    /// When memory runs out.
    pub fn substitute(&mut self) -> Result<(), SystemError> {
        let n = self.held.len();
        for (p, held) in self.rhs.iter_mut().zip(&self.held) {
            for d in (0..2).filter(|d| held[*d]) {
                p[d] = 0.0;
            }
        }
        let llt: LltRef<'_, u32, f64> = LltRef::new(&self.symbolic, &self.factor);
        let mut x: Vec<f64> = self.rhs.iter().flat_map(|p| [p.x, p.y]).collect();
        let mut memory = MemBuffer::try_new(self.symbolic.solve_in_place_scratch::<f64>(1, Par::Seq))
            .map_err(|_| SystemError::Memory(n))?;
        llt.solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(&mut x, 2 * n, 1),
            Par::Seq,
            MemStack::new(&mut memory),
        );
        for (p, d) in self.rhs.iter_mut().zip(x.chunks_exact(2)) {
            *p = Vec2::new(d[0], d[1]);
        }
        Ok(())
    }
}

fn out_of_memory<E>(n: usize) -> impl Fn(E) -> SystemError {
    move |_| SystemError::Memory(n)
}

type Pattern = (Vec<usize>, Vec<u32>, Vec<u32>, Vec<u32>);

/// Block columns, and the compressed columns of single entries that they stand for.
fn pattern(n: usize, blocks: &[(u32, u32)]) -> Result<Pattern, SystemError> {
    let mut block_start = vec![0usize; n + 1];
    for (c, _) in blocks {
        block_start[*c as usize + 1] += 1;
    }
    for c in 0..n {
        block_start[c + 1] += block_start[c];
    }
    let block_row: Vec<u32> = blocks.iter().map(|(_, r)| *r).collect();
    let mut col_ptr = vec![0u32];
    let mut row_idx = Vec::with_capacity(4 * blocks.len());
    for c in 0..n {
        let rows = &block_row[block_start[c]..block_start[c + 1]];
        row_idx.extend(rows.iter().flat_map(|r| [2 * r, 2 * r + 1]));
        col_ptr.push(u32::try_from(row_idx.len()).map_err(|_| SystemError::Memory(n))?);
        row_idx.extend(rows.iter().flat_map(|r| [2 * r, 2 * r + 1]).skip(1));
        col_ptr.push(u32::try_from(row_idx.len()).map_err(|_| SystemError::Memory(n))?);
    }
    Ok((block_start, block_row, col_ptr, row_idx))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_a_small_chain_with_a_held_end() {
        // Two springs in a row, stiffness 2 and 3 in both directions, pulled by 6 at the end.
        let spring = |k: f64| {
            let m = Matrix2::identity() * k;
            Local { gradient: [Vec2::zeros(); 2], hessian: [[m, -m], [-m, m]] }
        };
        let mut s = System::new(vec![[true; 2], [false; 2], [false; 2]], [[0u32, 1].as_slice(), &[2, 1]].into_iter())
            .expect("system");
        s.clear();
        s.add(&[0, 1], &spring(2.0));
        s.add(&[2, 1], &spring(3.0));
        s.rhs[2] = Vec2::new(6.0, -6.0);
        s.factorize().expect("factor");
        s.substitute().expect("solve");
        assert_eq!(s.rhs[0], Vec2::zeros());
        assert!((s.rhs[1] - Vec2::new(3.0, -3.0)).norm() < 1e-14);
        assert!((s.rhs[2] - Vec2::new(5.0, -5.0)).norm() < 1e-14);
    }
}
