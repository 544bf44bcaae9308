//! A symmetric block matrix: the lower triangle by columns, one 3 × 3 block per pair of coupled vertices.

use crate::Vec3;
use nalgebra::Matrix3;
use std::sync::Arc;

/// The number of a vertex that is no unknown.
pub(crate) const FIXED: u32 = u32::MAX;

/// A sparse symmetric matrix of 3 × 3 blocks: the places of the blocks, and their values.
pub(crate) type System = (Pattern, Vec<Matrix3<f64>>);

/// The pairs of unknowns that are coupled: the rows of each column, the diagonal first, ascending.
///
/// A clone copies nothing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Pattern {
    /// Place of the first row of every column, and the number of all rows.
    pub start: Arc<Vec<u32>>,
    /// Rows of all columns.
    pub rows: Arc<Vec<u32>>,
}

impl Pattern {
    /// The pattern of `n` unknowns whose couplings are `pairs` (row > column, in any order).
    pub fn new(n: usize, mut pairs: Vec<[u32; 2]>) -> Self {
        pairs.sort_unstable();
        pairs.dedup();
        let mut start = Vec::with_capacity(n + 1);
        let mut rows = Vec::with_capacity(pairs.len() + n);
        let mut next = pairs.iter().peekable();
        for column in 0u32.. {
            start.push(u32::try_from(rows.len()).unwrap_or(u32::MAX));
            if column as usize == n {
                break;
            }
            rows.push(column);
            while let Some(p) = next.next_if(|p| p[0] == column) {
                rows.push(p[1]);
            }
        }
        Self { start: start.into(), rows: rows.into() }
    }

    /// Number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.start.len().saturating_sub(1)
    }

    /// Product of the symmetric matrix with these values and a vector.
    pub fn times(&self, values: &[Matrix3<f64>], v: &[Vec3]) -> Vec<Vec3> {
        let mut out = vec![Vec3::zeros(); v.len()];
        for (column, ends) in self.start.windows(2).enumerate() {
            let (first, end) = (ends[0] as usize, ends[1] as usize);
            out[column] += values[first] * v[column];
            for (row, block) in self.rows[first + 1..end].iter().zip(&values[first + 1..end]) {
                out[*row as usize] += block * v[column];
                out[column] += block.tr_mul(&v[*row as usize]);
            }
        }
        out
    }

    /// Place of a block; `None` outside the pattern.
    #[inline]
    pub fn find(&self, column: u32, row: u32) -> Option<usize> {
        let a = self.start[column as usize] as usize;
        let b = self.start[column as usize + 1] as usize;
        self.rows[a..b].binary_search(&row).ok().map(|k| a + k)
    }
}

/// Values on a pattern, addressed by vertex; vertices that are no unknowns are skipped.
#[derive(Clone, Debug)]
pub(crate) struct Hessian {
    /// Unknown of every vertex, or [`FIXED`].
    pub unknown: Vec<u32>,
    pub pattern: Pattern,
    /// Blocks of the pattern, N/m.
    pub values: Vec<Matrix3<f64>>,
    /// Blocks outside the pattern (contacts): (column, row, block).
    pub extra: Vec<(u32, u32, Matrix3<f64>)>,
}

impl Hessian {
    /// A zero matrix of `n` unknowns with a pattern over coupled pairs of vertices.
    pub fn new(unknown: Vec<u32>, n: usize, pairs: impl Iterator<Item = [u32; 2]>) -> Self {
        let known = pairs.filter_map(|p| {
            let [a, b] = p.map(|v| unknown[v as usize]);
            (a != FIXED && b != FIXED && a != b).then(|| [a.min(b), a.max(b)])
        });
        let pattern = Pattern::new(n, known.collect());
        let values = vec![Matrix3::zeros(); pattern.rows.len()];
        Self { unknown, pattern, values, extra: Vec::new() }
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
        for column in 0..self.pattern.unknowns() {
            let first = self.pattern.start[column] as usize;
            for k in first + 1..self.pattern.start[column + 1] as usize {
                let all = share * (-self.values[k].trace()).max(0.0);
                let row = self.pattern.rows[k] as usize;
                for (place, sign) in [(k, -1.0), (first, 1.0), (self.pattern.start[row] as usize, 1.0)] {
                    self.values[place] += Matrix3::identity() * (sign * all);
                }
            }
        }
    }

    /// Starts anew from given values.
    pub fn reset(&mut self, values: impl ExactSizeIterator<Item = Matrix3<f64>>) {
        self.values.clear();
        self.values.reserve_exact(values.len());
        self.values.extend(values);
        self.extra.clear();
    }

    /// Pattern and values with the extra blocks worked in. Sums are ordered, so they are the same in every run.
    ///
    /// The values are taken out; the matrix must be reset afterwards.
    pub fn merged(&mut self) -> (Pattern, Vec<Matrix3<f64>>) {
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

    /// The extra blocks in order, those of one place summed.
    fn summed(&mut self) -> Vec<(u32, u32, Matrix3<f64>)> {
        let mut extra = std::mem::take(&mut self.extra);
        extra.sort_by_key(|e| (e.0, e.1));
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

    /// A spring along x then resists in all directions, and its ends still move together without a force.
    #[test]
    fn isotropic_stiffness_acts_in_all_directions() {
        let mut h = Hessian::new(vec![0, 1, 2], 3, [[0, 1], [1, 2]].into_iter());
        let along = Matrix3::from_diagonal(&Vec3::new(100.0, 0.0, 0.0));
        h.spread(&[0, 1], &[1.0, -1.0], &along);
        h.add_isotropic_stiffness(0.1);
        let want = along + Matrix3::identity() * 10.0;
        assert_eq!(h.values, [want, -want, want, Matrix3::zeros(), Matrix3::zeros()]);
    }

    /// The extra blocks come between, before and after the couplings of the cloth, some of them twice.
    #[test]
    fn extra_blocks_take_their_places() {
        let of = |k: f64| Matrix3::from_diagonal_element(k);
        let mut h = Hessian::new(vec![0, 1, 2, 3, 4], 5, [[0, 2], [2, 3]].into_iter());
        h.values = (1..=7).map(|k| of(f64::from(k))).collect();
        for (i, j, k) in [(0, 3, 10.0), (1, 0, 20.0), (4, 3, 30.0), (3, 0, 40.0), (2, 4, 50.0)] {
            h.couple(i, j, &of(k));
        }
        let (pattern, values) = h.merged();
        assert_eq!(*pattern.start, [0, 4, 5, 8, 10, 11]);
        assert_eq!(*pattern.rows, [0, 1, 2, 3, 1, 2, 3, 4, 3, 4, 4]);
        let want = [1.0, 20.0, 2.0, 50.0, 3.0, 4.0, 5.0, 50.0, 6.0, 30.0, 7.0];
        assert_eq!(values, want.map(of));
        assert!(h.values.is_empty() && h.extra.is_empty());
    }
}
