//! Dense kernels in single precision, for matrices stored by columns.
//!
//! Every sum runs in one stated order, and each product is fused into it with one rounding. The result is therefore the
//! same on every machine, whatever the width of its registers.

use pulp::Simd;

/// Rows of the tile that is summed in registers, and columns of a block of a panel.
pub(crate) const STRIP_ROWS: usize = 16;
/// Entries below this become zero.
///
/// Far from the diagonal entries fade below the smallest normal numbers, with which a sum costs a hundred times as
/// much.
const UNDERFLOW_LIMIT: f32 = 1e-30;

/// Finished columns of a matrix, in strips of `STRIP_ROWS` rows; each strip has its columns one after the other.
#[derive(Debug, Default)]
pub(crate) struct PackedColumns {
    values: Vec<f32>,
    depth: usize,
}

impl PackedColumns {
    /// Makes room for `width` columns of `height` rows. Numbers not written yet are not read for a result.
    #[inline(always)]
    fn prepare(&mut self, height: usize, width: usize) {
        self.depth = width;
        let length = height.div_ceil(STRIP_ROWS) * STRIP_ROWS * width;
        if self.values.len() < length {
            self.values.reserve_exact(length - self.values.len());
            self.values.resize(length, 0.0);
        }
    }

    #[inline(always)]
    fn strip(&self, p: usize, depth: usize) -> &[[f32; STRIP_ROWS]] {
        &self.values[p * STRIP_ROWS * self.depth..(p + 1) * STRIP_ROWS * self.depth].as_chunks().0[..depth]
    }

    #[inline(always)]
    fn line(&mut self, p: usize, k: usize) -> &mut [f32; STRIP_ROWS] {
        let at = (p * self.depth + k) * STRIP_ROWS;
        let line = self.values[at..at + STRIP_ROWS].first_chunk_mut();
        line.unwrap_or_else(|| unreachable!("a line of {STRIP_ROWS} has {STRIP_ROWS} entries"))
    }
}

/// Sums over the first `depth` columns of products of the rows of strip `p` (`V` registers) with `W` rows that start at
/// `first`, which must be a multiple of `W`, a divisor of `STRIP_ROWS`.
#[inline(always)]
fn tile<S: Simd, const V: usize, const W: usize>(
    simd: S,
    pack: &PackedColumns,
    depth: usize,
    p: usize,
    first: usize,
) -> [[S::f32s; V]; W] {
    let mut sum = [[simd.splat_f32s(0.0); V]; W];
    let shift = first % STRIP_ROWS;
    for (l, r) in pack.strip(p, depth).iter().zip(pack.strip(first / STRIP_ROWS, depth)) {
        let l: &[S::f32s; V] = registers::<S, V>(simd, l);
        let r: &[f32; W] = r[shift..].first_chunk().unwrap_or(&[0.0; W]);
        for w in 0..W {
            let r = simd.splat_f32s(r[w]);
            for v in 0..V {
                sum[w][v] = simd.mul_add_f32s(l[v], r, sum[w][v]);
            }
        }
    }
    sum
}

/// The `V` registers that a line of numbers fills.
#[inline(always)]
pub(crate) fn registers<S: Simd, const V: usize>(_: S, line: &[f32; STRIP_ROWS]) -> &[S::f32s; V] {
    let found = S::as_simd_f32s(line).0.first_chunk();
    found.unwrap_or_else(|| unreachable!("{V} registers hold a line"))
}

/// The `V` registers that a line of numbers fills, to be changed.
#[inline(always)]
pub(crate) fn registers_mut<S: Simd, const V: usize>(_: S, line: &mut [f32; STRIP_ROWS]) -> &mut [S::f32s; V] {
    let found = S::as_mut_simd_f32s(line).0.first_chunk_mut();
    found.unwrap_or_else(|| unreachable!("{V} registers hold a line"))
}

/// The line of numbers in `V` registers.
#[inline(always)]
pub(crate) fn line<S: Simd, const V: usize>(simd: S, sum: &[S::f32s; V]) -> [f32; STRIP_ROWS] {
    let mut line = [0.0; STRIP_ROWS];
    *registers_mut::<S, V>(simd, &mut line) = *sum;
    line
}

/// Products of the packed rows `first..first + W` with all rows from their strip on.
///
/// They are stored by columns of `height` rows, which must be whole strips.
#[inline(always)]
pub(crate) fn products<S: Simd, const V: usize, const W: usize>(
    simd: S,
    pack: &PackedColumns,
    first: usize,
    height: usize,
    out: &mut [f32],
) {
    for p in first / STRIP_ROWS..height / STRIP_ROWS {
        let sums = tile::<S, V, W>(simd, pack, pack.depth, p, first);
        for (column, sum) in out.chunks_exact_mut(height).zip(&sums) {
            column.as_chunks_mut().0[p] = line::<S, V>(simd, sum);
        }
    }
}

/// Cholesky factor of the first `width` columns of a matrix with `height` rows, in place, with an inverted diagonal.
///
/// Returns `false` when a pivot is not positive. The columns are kept in `pack` as well.
#[inline(always)]
pub(crate) fn factor_panel<S: Simd, const V: usize, const W: usize>(
    simd: S,
    l: &mut [f32],
    height: usize,
    width: usize,
    pack: &mut PackedColumns,
) -> bool {
    pack.prepare(height, width);
    for j0 in (0..width).step_by(STRIP_ROWS) {
        let j1 = (j0 + STRIP_ROWS).min(width);
        if j0 > 0 {
            take_out::<S, V, W>(simd, l, height, j0, j1, pack);
        }
        let Some(corner) = factor_corner(l, height, j0, j1 - j0) else { return false };
        for p in j0 / STRIP_ROWS..height.div_ceil(STRIP_ROWS) {
            solve_strip::<S, V>(simd, l, height, (j0, j1 - j0), p, &corner, pack);
        }
        for (j, line) in corner.iter().enumerate().take(j1 - j0) {
            l[(j0 + j) * height + j0 + j] = line[j];
        }
    }
    true
}

/// Takes the finished columns `..j0` out of the columns `j0..j1`.
#[inline(always)]
fn take_out<S: Simd, const V: usize, const W: usize>(
    simd: S,
    l: &mut [f32],
    height: usize,
    j0: usize,
    j1: usize,
    pack: &PackedColumns,
) {
    for p in j0 / STRIP_ROWS..height.div_ceil(STRIP_ROWS) {
        let rows = STRIP_ROWS.min(height - p * STRIP_ROWS);
        for j in (j0..j1).step_by(W) {
            for (w, sum) in tile::<S, V, W>(simd, pack, j0, p, j).iter().enumerate().take(j1 - j) {
                let sum = line::<S, V>(simd, sum);
                let from = &mut l[(j + w) * height + p * STRIP_ROWS..][..rows];
                match from.first_chunk_mut::<STRIP_ROWS>() {
                    Some(line) => line.iter_mut().zip(&sum).for_each(|(c, s)| *c -= s),
                    None => from.iter_mut().zip(&sum).for_each(|(c, s)| *c -= s),
                }
            }
        }
    }
}

/// Factor of a diagonal block, as `corner[column][row]`; its diagonal has the inverse roots of the pivots.
#[inline(always)]
fn factor_corner(l: &[f32], height: usize, j0: usize, n: usize) -> Option<[[f32; STRIP_ROWS]; STRIP_ROWS]> {
    let mut a = [[0.0f32; STRIP_ROWS]; STRIP_ROWS];
    for (j, column) in a.iter_mut().enumerate().take(n) {
        column[j..n].copy_from_slice(&l[(j0 + j) * height + j0 + j..][..n - j]);
    }
    for j in 0..n {
        let pivot = a[j][j];
        if !(pivot.is_finite() && pivot > 0.0) {
            return None;
        }
        let scale = 1.0 / pivot.sqrt();
        a[j].iter_mut().skip(j + 1).for_each(|v| *v *= scale);
        a[j][j] = scale;
        let done = a[j];
        for k in j + 1..n {
            for i in k..n {
                a[k][i] = (-done[k]).mul_add(done[i], a[k][i]);
            }
        }
    }
    Some(a)
}

/// Solves one strip of rows for the `n` columns from `j0` on, and packs it.
#[inline(always)]
fn solve_strip<S: Simd, const V: usize>(
    simd: S,
    l: &mut [f32],
    height: usize,
    (j0, n): (usize, usize),
    p: usize,
    corner: &[[f32; STRIP_ROWS]; STRIP_ROWS],
    pack: &mut PackedColumns,
) {
    let rows = STRIP_ROWS.min(height - p * STRIP_ROWS);
    let mut x = [[0.0f32; STRIP_ROWS]; STRIP_ROWS];
    for (j, x) in x.iter_mut().enumerate().take(n) {
        let from = &l[(j0 + j) * height + p * STRIP_ROWS..][..rows];
        match from.first_chunk() {
            Some(line) => *x = *line,
            None => x[..rows].copy_from_slice(from),
        }
    }
    for j in 0..n {
        let mut done = x[j];
        for v in &mut done {
            *v *= corner[j][j];
            *v = if v.abs() < UNDERFLOW_LIMIT { 0.0 } else { *v };
        }
        x[j] = done;
        let done: &[S::f32s; V] = registers::<S, V>(simd, &done);
        for k in j + 1..n {
            let c = simd.splat_f32s(-corner[j][k]);
            let x = registers_mut::<S, V>(simd, &mut x[k]);
            for v in 0..V {
                x[v] = simd.mul_add_f32s(c, done[v], x[v]);
            }
        }
    }
    for (j, x) in x.iter().enumerate().take(n) {
        let to = &mut l[(j0 + j) * height + p * STRIP_ROWS..][..rows];
        match to.first_chunk_mut() {
            Some(line) => *line = *x,
            None => to.copy_from_slice(&x[..rows]),
        }
        *pack.line(p, j0 + j) = *x;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A factor times its transpose gives the matrix back, at sizes on both sides of every block size.
    #[test]
    fn a_panel_times_its_transpose_is_the_matrix() {
        for n in [1, 3, 7, 16, 24, 25, 50, 61] {
            let entry = |i: usize, j: usize| if i == j { n as f32 } else { 1.0 / (1.0 + i.abs_diff(j) as f32) };
            let mut l: Vec<f32> = (0..n * n).map(|k| entry(k % n, k / n)).collect();
            assert!(factor_panel::<_, 16, 8>(pulp::Scalar, &mut l, n, n, &mut PackedColumns::default()));
            (0..n).for_each(|k| l[k * n + k] = 1.0 / l[k * n + k]);
            for j in 0..n {
                for i in j..n {
                    let sum: f32 = (0..=j).map(|k| l[k * n + i] * l[k * n + j]).sum();
                    assert!((sum - entry(i, j)).abs() < 2e-6 * n as f32, "{n}: {i} {j} {sum}");
                }
            }
        }
    }

    #[test]
    fn a_negative_pivot_is_reported() {
        assert!(!factor_panel::<_, 16, 4>(
            pulp::Scalar,
            &mut [1.0, 2.0, 2.0, 1.0],
            2,
            2,
            &mut PackedColumns::default()
        ));
    }
}
