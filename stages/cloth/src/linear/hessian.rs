//! A Hessian that is being put together: the lower triangle by columns, one 3 × 3 block per pair of coupled vertices.
//!
//! Blocks of springs are multiples of the identity and the same everywhere, so they are kept as one number each. They
//! are six of ten blocks of a cloth.

use crate::Vec3;
use crate::linear::pattern::{IsotropicBlocks, Pattern};
use crate::linear::system::System;
use nalgebra::Matrix3;
use std::sync::Arc;

/// The number of a vertex that is no unknown.
pub(crate) const FIXED: u32 = u32::MAX;

/// Blocks addressed by vertex; vertices that are no unknowns are skipped.
#[derive(Clone, Debug)]
pub(crate) struct Hessian {
    /// Unknown of every vertex, or [`FIXED`].
    pub unknown: Vec<u32>,
    /// Couplings whose blocks are of any kind. Every diagonal is one of them.
    pub pattern: Pattern,
    /// Their blocks, N/m, the part of the springs included.
    pub values: Vec<Matrix3<f64>>,
    /// Blocks of the springs, on all couplings. They hold where `pattern` has no place.
    pub springs: IsotropicBlocks,
    /// Factors of the springs before any was scaled or stiffened, N/m.
    constant: Arc<Vec<f64>>,
    /// Blocks outside `pattern` (contacts): (column, row, block).
    pub extra: Vec<(u32, u32, Matrix3<f64>)>,
}

/// The lower triangle's (column, row) of a pair of vertices that are two unknowns.
fn lower_pair(unknown: &[u32], pair: [u32; 2]) -> Option<[u32; 2]> {
    let [a, b] = pair.map(|v| unknown[v as usize]);
    (a != FIXED && b != FIXED && a != b).then(|| [a.min(b), a.max(b)])
}

impl Hessian {
    /// The matrix of `n` unknowns with springs (ends, N/m), and a pattern over coupled pairs of vertices for other blocks.
    pub fn new(
        unknown: Vec<u32>,
        n: usize,
        mut pairs: Vec<[u32; 2]>,
        each_spring: impl Fn(&mut dyn FnMut([u32; 2], f64)),
    ) -> Self {
        let lower = |pair: [u32; 2]| lower_pair(&unknown, pair);
        let pattern = Pattern::new(n, pairs.iter().copied().filter_map(lower).collect());
        each_spring(&mut |ends, _| pairs.push(ends));
        let all = Pattern::new(n, pairs.into_iter().filter_map(lower).collect());
        let mut factors = vec![0.0; all.rows.len()];
        each_spring(&mut |ends, k| {
            for u in ends.map(|v| unknown[v as usize]).into_iter().filter(|u| *u != FIXED) {
                factors[all.start[u as usize] as usize] += k;
            }
            if let Some(place) = lower(ends).and_then(|[column, row]| all.find(column, row)) {
                factors[place] -= k;
            }
        });
        let constant = Arc::new(factors);
        let springs = IsotropicBlocks { pattern: all, factors: constant.clone() };
        Self { unknown, pattern, values: Vec::new(), springs, constant, extra: Vec::new() }
    }

    /// Starts anew with the springs alone.
    pub fn reset(&mut self) {
        self.springs.factors = self.constant.clone();
        self.extra.clear();
        self.values.clear();
        self.values.reserve_exact(self.pattern.rows.len());
        let IsotropicBlocks { pattern: all, factors } = &self.springs;
        for column in 0..self.pattern.unknowns() {
            let mut places = all.places(column);
            for row in &self.pattern.rows[self.pattern.places(column)] {
                let factor = places.find(|k| all.rows[*k] == *row).map_or(0.0, |k| factors[k]);
                self.values.push(Matrix3::from_diagonal_element(factor));
            }
        }
    }

    /// Adds a block for (vertex `i`, vertex `j`), i ≠ j; the mirrored block follows from symmetry.
    #[inline]
    pub fn couple(&mut self, i: u32, j: u32, block: &Matrix3<f64>) {
        let (a, b) = (self.unknown[i as usize], self.unknown[j as usize]);
        if a == FIXED || b == FIXED {
            return;
        }
        if a == b {
            self.values[self.pattern.start[a as usize] as usize] += block + block.transpose();
            return;
        }
        // Stored as block(row, column), row > column.
        let (column, row, m) = if a > b { (b, a, *block) } else { (a, b, block.transpose()) };
        match self.pattern.find(column, row) {
            Some(k) => self.values[k] += m,
            None => self.extra.push((column, row, m)),
        }
    }

    /// Adds a block to the diagonal block of a vertex.
    #[inline]
    pub fn add(&mut self, i: u32, block: &Matrix3<f64>) {
        let a = self.unknown[i as usize];
        if a != FIXED {
            self.values[self.pattern.start[a as usize] as usize] += block;
        }
    }

    /// Adds `(w ⊗ w) ⊗ block` over some vertices with their weights w.
    #[inline]
    pub fn spread(&mut self, vertices: &[u32], weights: &[f64], block: &Matrix3<f64>) {
        for i in 0..vertices.len() {
            if weights[i] == 0.0 {
                continue;
            }
            self.add(vertices[i], &(block * (weights[i] * weights[i])));
            for j in 0..i {
                if weights[j] != 0.0 {
                    self.couple(vertices[i], vertices[j], &(block * (weights[i] * weights[j])));
                }
            }
        }
    }

    /// Adds a `share` of the stiffness of every coupling in all directions (stretch-isotropic regularisation).
    ///
    /// A stretched edge may turn without cost at first order, but not over a finite step. With a share of 1 the stretch
    /// stiffness is that of the Laplacian of projective dynamics (Liu et al. 2017).
    pub fn add_isotropic_stiffness(&mut self, share: f64) {
        let IsotropicBlocks { pattern: all, factors } = &mut self.springs;
        let factors = Arc::make_mut(factors);
        for column in 0..self.pattern.unknowns() {
            let first = self.pattern.start[column] as usize;
            let mut own = self.pattern.places(column).skip(1).peekable();
            for k in all.places(column).skip(1) {
                let row = all.rows[k];
                let place = own.next_if(|p| self.pattern.rows[*p] == row);
                let block = place.map_or_else(|| Matrix3::from_diagonal_element(factors[k]), |p| self.values[p]);
                let stiffness = share * (-block.trace()).max(0.0);
                match place {
                    Some(p) => self.values[p] += Matrix3::identity() * -stiffness,
                    None => factors[k] -= stiffness,
                }
                for diagonal in [first, self.pattern.start[row as usize] as usize] {
                    self.values[diagonal] += Matrix3::identity() * stiffness;
                }
            }
        }
    }

    /// Multiplies all blocks by a number.
    pub fn scale(&mut self, by: f64) {
        Arc::make_mut(&mut self.springs.factors).iter_mut().for_each(|k| *k *= by);
        self.values.iter_mut().for_each(|v| *v *= by);
        self.extra.iter_mut().for_each(|e| e.2 *= by);
    }

    /// The matrix with the extra blocks worked in. Sums are ordered, so they are the same in every run.
    ///
    /// The values are taken out; the matrix must be reset afterwards.
    pub fn merged(&mut self) -> System {
        let has_extra = !self.extra.is_empty();
        let (pattern, values) = self.merged_blocks();
        System::new(self.springs.clone(), pattern, values, has_extra)
    }

    /// Pattern and values of the blocks of any kind, the extra ones worked in.
    fn merged_blocks(&mut self) -> (Pattern, Vec<Matrix3<f64>>) {
        let mut values = std::mem::take(&mut self.values);
        let extra = self.summed();
        if extra.is_empty() {
            return (self.pattern.clone(), values);
        }
        // The columns are moved from the last to the first, so that none is overwritten.
        let (mut from, mut to) = (values.len(), values.len() + extra.len());
        values.reserve_exact(extra.len());
        values.resize(to, Matrix3::zeros());
        let (mut start, mut rows) = (self.pattern.start.to_vec(), Vec::with_capacity(to));
        rows.extend_from_slice(&self.pattern.rows);
        rows.resize(to, 0);
        let mut left = extra.as_slice();
        for column in (0..self.pattern.unknowns()).rev() {
            start[column + 1] = u32::try_from(to).unwrap_or(u32::MAX);
            let first = self.pattern.start[column] as usize;
            while let Some((e, others)) = left.split_last().filter(|(e, _)| e.0 as usize == column) {
                if from > first && rows[from - 1] > e.1 {
                    (from, to) = (from - 1, to - 1);
                    (rows[to], values[to]) = (rows[from], values[from]);
                } else {
                    (to, left) = (to - 1, others);
                    (rows[to], values[to]) = (e.1, e.2);
                }
            }
            let rest = from - first;
            rows.copy_within(first..from, to - rest);
            values.copy_within(first..from, to - rest);
            (from, to) = (first, to - rest);
        }
        (Pattern { start: start.into(), rows: rows.into() }, values)
    }

    /// The extra blocks in order, those of one place summed, with the spring that is there.
    fn summed(&mut self) -> Vec<(u32, u32, Matrix3<f64>)> {
        let mut extra = std::mem::take(&mut self.extra);
        extra.sort_by_key(|e| (e.0, e.1));
        let IsotropicBlocks { pattern: all, factors } = &self.springs;
        for first in extra.chunk_by_mut(|p, q| (p.0, p.1) == (q.0, q.1)).map(|same| &mut same[0]) {
            if let Some(k) = all.find(first.0, first.1) {
                first.2 = Matrix3::from_diagonal_element(factors[k]) + first.2;
            }
        }
        extra.dedup_by(|next, first| {
            let same = (next.0, next.1) == (first.0, first.1);
            if same {
                first.2 += next.2;
            }
            same
        });
        extra
    }
}

/// Copies the part of the unknowns out of a field over all vertices.
pub(crate) fn gather(unknown: &[u32], field: &[Vec3], out: &mut [Vec3]) {
    for (u, v) in unknown.iter().zip(field) {
        if *u != FIXED {
            out[*u as usize] = *v;
        }
    }
}

/// A field over all vertices from the part of the unknowns, times `factor`; held vertices have zero.
pub(crate) fn scattered(unknown: &[u32], part: &[Vec3], factor: f64) -> Vec<Vec3> {
    unknown.iter().map(|u| if *u == FIXED { Vec3::zeros() } else { part[*u as usize] * factor }).collect()
}

/// Couplings of a square grid: of every knot with those `reach` lines and columns further on.
#[cfg(test)]
pub(crate) fn grid_pairs(side: u32, reach: &[(u32, u32)]) -> Vec<[u32; 2]> {
    let mut pairs = Vec::new();
    for (r, c) in (0..side).flat_map(|r| (0..side).map(move |c| (r, c))) {
        for (dr, dc) in reach {
            if r + dr < side && c + dc < side {
                pairs.push([r * side + c, (r + dr) * side + c + dc]);
            }
        }
    }
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::system::Block;

    /// A spring along x then resists in all directions, and its ends still move together without a force.
    #[test]
    fn isotropic_stiffness_acts_in_all_directions() {
        let mut h = Hessian::new(vec![0, 1, 2], 3, vec![[0, 1], [1, 2]], |_| {});
        h.reset();
        let along = Matrix3::from_diagonal(&Vec3::new(100.0, 0.0, 0.0));
        h.spread(&[0, 1], &[1.0, -1.0], &along);
        h.add_isotropic_stiffness(0.1);
        let want = along + Matrix3::identity() * 10.0;
        assert_eq!(h.values, [want, -want, want, Matrix3::zeros(), Matrix3::zeros()]);
    }

    /// The extra blocks come between, before and after the couplings of the cloth, some of them twice, and one of them
    /// where a spring is.
    #[test]
    fn extra_blocks_take_their_places() {
        let of = |k: f64| Matrix3::from_diagonal_element(k);
        let springs = |add: &mut dyn FnMut([u32; 2], f64)| [([0, 4], 7.0), ([1, 4], 5.0)].map(|(e, k)| add(e, k));
        let mut h = Hessian::new(vec![0, 1, 2, 3, 4], 5, vec![[0, 2], [2, 3]], |add| _ = springs(add));
        h.reset();
        h.values.iter_mut().zip(1..).for_each(|(v, k)| *v += of(f64::from(k)));
        for (i, j, k) in [(0, 3, 10.0), (1, 0, 20.0), (4, 3, 30.0), (3, 0, 40.0), (2, 4, 50.0), (4, 1, 60.0)] {
            h.couple(i, j, &of(k));
        }
        let system = h.merged();
        assert_eq!(*system.pattern.start, [0, 5, 7, 10, 12, 13]);
        assert_eq!(*system.pattern.rows, [0, 1, 2, 3, 4, 1, 4, 2, 3, 4, 3, 4, 4]);
        let want = [8.0, 20.0, 2.0, 50.0, -7.0, 8.0, 55.0, 4.0, 5.0, 50.0, 6.0, 30.0, 19.0];
        assert_eq!(system.blocks().map(Block::matrix).collect::<Vec<_>>(), want.map(of));
        assert!(h.values.is_empty() && h.extra.is_empty());
    }
}
