//! The sparse matrix of the solver: 2 × 2 blocks, lower triangle, one symbolic factor for all rounds.

use super::energy::Local;
use super::factor::Factor;
use nalgebra::Matrix2;
use toile_garment::Vec2;

/// A symmetric positive system over the vertices, with some coordinates held.
pub struct System {
    /// Start of each column in `block_row`; the first block of a column is its diagonal.
    block_start: Vec<usize>,
    /// Row of every block.
    block_row: Vec<u32>,
    held: Vec<[bool; 2]>,
    /// Blocks, lower triangle.
    blocks: Vec<Matrix2<f64>>,
    factor: Factor,
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
        let mut block_start = vec![0usize; n + 1];
        blocks.iter().for_each(|(c, _)| block_start[*c as usize + 1] += 1);
        (0..n).for_each(|c| block_start[c + 1] += block_start[c]);
        let block_row: Vec<u32> = blocks.iter().map(|(_, r)| *r).collect();
        let factor = Factor::new(n, &block_start, &block_row).ok_or(SystemError::Memory(n))?;
        let blocks = vec![Matrix2::zeros(); block_row.len()];
        Ok(Self { block_start, block_row, held, blocks, factor, rhs: vec![Vec2::zeros(); n] })
    }

    /// Forgets entries and right side.
    pub fn clear(&mut self) {
        self.blocks.fill(Matrix2::zeros());
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
        let (from, to) = (self.block_start[col as usize], self.block_start[col as usize + 1]);
        if let Ok(k) = self.block_row[from..to].binary_search(&row) {
            self.blocks[from + k] += m;
        }
    }

    /// Factors the matrix that was added.
    ///
    /// # Errors
    /// When the matrix is not positive definite.
    pub fn factorize(&mut self) -> Result<(), SystemError> {
        self.hold();
        if self.factor.eliminate(&self.blocks) { Ok(()) } else { Err(SystemError::NotPositive) }
    }

    /// Cuts held coordinates off from all others.
    fn hold(&mut self) {
        for c in 0..self.held.len() {
            for k in self.block_start[c]..self.block_start[c + 1] {
                let (on, block) = (self.held[self.block_row[k] as usize], &mut self.blocks[k]);
                for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                    if on[i] || self.held[c][j] {
                        block[(i, j)] = f64::from(u8::from(k == self.block_start[c] && i == j));
                    }
                }
            }
        }
    }

    /// Solves with the factor; the solution stands in `rhs`, zero where a coordinate is held.
    pub fn substitute(&mut self) {
        for (p, held) in self.rhs.iter_mut().zip(&self.held) {
            for d in (0..2).filter(|d| held[*d]) {
                p[d] = 0.0;
            }
        }
        self.factor.solve(&mut self.rhs);
    }
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
        s.substitute();
        assert_eq!(s.rhs[0], Vec2::zeros());
        assert!((s.rhs[1] - Vec2::new(3.0, -3.0)).norm() < 1e-14);
        assert!((s.rhs[2] - Vec2::new(5.0, -5.0)).norm() < 1e-14);
    }
}
