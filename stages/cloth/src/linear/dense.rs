//! Dense kernels in single precision, matrices by columns. Every sum runs in one stated order and no multiplication is
//! fused with an addition, so the width of the machine's registers cannot show in the result.

/// Rows and columns of the tile that is summed in registers.
const TALL: usize = 16;
const WIDE: usize = 4;
/// Columns of a panel.
const PANEL: usize = 16;
/// Taken for zero: far from the diagonal entries fade below the smallest full numbers, where a sum costs a hundred times
/// as much.
const NOTHING: f32 = 1e-30;
/// Columns packed at a time.
const DEPTH: usize = 128;

/// Rows of a matrix, `TALL` by `TALL`, each with its columns one after the other; filled up with zeros.
#[derive(Debug, Default)]
pub(crate) struct Pack {
    values: Vec<f32>,
    depth: usize,
}

impl Pack {
    #[inline(always)]
    fn fill(&mut self, a: &[f32], height: usize, depth: usize, gap: usize) {
        self.depth = depth;
        self.values.clear();
        self.values.resize(height.div_ceil(TALL) * TALL * depth, 0.0);
        for (p, strip) in self.values.chunks_exact_mut(TALL * depth).enumerate() {
            let first = p * TALL;
            let rows = TALL.min(height - first);
            for (k, line) in strip.chunks_exact_mut(TALL).enumerate() {
                line[..rows].copy_from_slice(&a[k * gap + first..][..rows]);
            }
        }
    }

    #[inline(always)]
    fn strip(&self, p: usize) -> &[[f32; TALL]] {
        self.values[p * TALL * self.depth..(p + 1) * TALL * self.depth].as_chunks().0
    }
}

/// `c −= a aᵀ` for the lower triangle of the first `width` columns of `c`: `a` has `depth` columns of `height` rows, its
/// columns `gap` apart, and column `j` of `c` belongs to row `j` of `a`. What stands above the diagonal of `c` is left
/// undefined.
#[inline(always)]
pub(crate) fn subtract_square(
    c: &mut [f32],
    stride: usize,
    a: &[f32],
    (height, depth, gap): (usize, usize, usize),
    width: usize,
    pack: &mut Pack,
) {
    let mut k = 0;
    while k < depth {
        let part = DEPTH.min(depth - k);
        pack.fill(&a[k * gap..], height, part, gap);
        let mut i = 0;
        while i < height {
            let mut j = 0;
            while j < width.min(i + TALL) {
                let sum = tile(pack.strip(i / TALL), pack.strip(j / TALL), j % TALL);
                let rows = TALL.min(height - i);
                for (w, s) in sum.iter().enumerate().take(width - j) {
                    for (c, s) in c[(j + w) * stride + i..][..rows].iter_mut().zip(s) {
                        *c -= s;
                    }
                }
                j += WIDE;
            }
            i += TALL;
        }
        k += part;
    }
}

#[inline(always)]
fn tile(left: &[[f32; TALL]], right: &[[f32; TALL]], shift: usize) -> [[f32; TALL]; WIDE] {
    let mut sum = [[0.0f32; TALL]; WIDE];
    for (l, r) in left.iter().zip(right) {
        let r: &[f32; WIDE] = r[shift..].first_chunk().unwrap_or(&[0.0; WIDE]);
        for w in 0..WIDE {
            for t in 0..TALL {
                sum[w][t] += l[t] * r[w];
            }
        }
    }
    sum
}

/// Cholesky factor of the first `width` columns of a matrix with `height` rows, in place; `false` when a pivot is not
/// positive.
#[inline(always)]
pub(crate) fn factor_panel(l: &mut [f32], height: usize, width: usize, pack: &mut Pack) -> bool {
    let mut j0 = 0;
    while j0 < width {
        let j1 = (j0 + PANEL).min(width);
        for j in j0..j1 {
            if !finish_column(l, height, j0, j) {
                return false;
            }
        }
        let (done, rest) = l.split_at_mut(j1 * height);
        if j1 < width {
            let below = (height - j1, j1 - j0, height);
            subtract_square(&mut rest[j1..], height, &done[j0 * height + j1..], below, width - j1, pack);
        }
        j0 = j1;
    }
    true
}

/// Takes columns `first..j` out of column `j` and divides it by its root.
#[inline(always)]
fn finish_column(l: &mut [f32], height: usize, first: usize, j: usize) -> bool {
    let (done, rest) = l.split_at_mut(j * height);
    let mine = &mut rest[j..height];
    for column in done[first * height..].chunks_exact(height) {
        let b = column[j];
        for (m, c) in mine.iter_mut().zip(&column[j..]) {
            *m -= b * c;
        }
    }
    let pivot = mine[0];
    if !(pivot.is_finite() && pivot > 0.0) {
        return false;
    }
    let scale = 1.0 / pivot.sqrt();
    mine[0] = pivot.sqrt();
    for m in &mut mine[1..] {
        *m *= scale;
        if m.abs() < NOTHING {
            *m = 0.0;
        }
    }
    true
}

/// Solves `L y = x` for the columns of one panel and takes them out of the rows below: `x` has `height` entries.
#[inline(always)]
pub(crate) fn solve_lower(l: &[f32], x: &mut [f32], width: usize) {
    let height = x.len();
    for (j, column) in l.chunks_exact(height).enumerate().take(width) {
        let v = x[j] / column[j];
        x[j] = v;
        for (x, c) in x[j + 1..].iter_mut().zip(&column[j + 1..]) {
            *x -= v * c;
        }
    }
}

/// Solves `Lᵀ y = x` for the columns of one panel, the rows below being known.
#[inline(always)]
pub(crate) fn solve_upper(l: &[f32], x: &mut [f32], width: usize) {
    let height = x.len();
    for (j, column) in l.chunks_exact(height).enumerate().take(width).rev() {
        x[j] = (x[j] - product(&column[j + 1..], &x[j + 1..])) / column[j];
    }
}

/// Sum of products in `TALL` lanes, then the lanes in order.
#[inline(always)]
fn product(a: &[f32], b: &[f32]) -> f32 {
    let mut lanes = [0.0f32; TALL];
    let (a, rest_a) = a.as_chunks::<TALL>();
    let (b, rest_b) = b.as_chunks::<TALL>();
    for (a, b) in a.iter().zip(b) {
        for k in 0..TALL {
            lanes[k] += a[k] * b[k];
        }
    }
    for (lane, (a, b)) in lanes.iter_mut().zip(rest_a.iter().zip(rest_b)) {
        *lane += a * b;
    }
    lanes.iter().sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Factor times its transpose gives the matrix back, at sizes on both sides of every block size.
    #[test]
    fn a_panel_times_its_transpose_is_the_matrix() {
        for n in [1, 3, 7, 16, 24, 25, 50, 61] {
            let entry = |i: usize, j: usize| if i == j { n as f32 } else { 1.0 / (1.0 + i.abs_diff(j) as f32) };
            let mut l: Vec<f32> = (0..n * n).map(|k| entry(k % n, k / n)).collect();
            assert!(factor_panel(&mut l, n, n, &mut Pack::default()));
            for j in 0..n {
                for i in j..n {
                    let sum: f32 = (0..=j).map(|k| l[k * n + i] * l[k * n + j]).sum();
                    assert!((sum - entry(i, j)).abs() < 2e-6 * n as f32, "{n}: {i} {j} {sum}");
                }
            }
        }
    }

    #[test]
    fn a_negative_pivot_is_said() {
        assert!(!factor_panel(&mut [1.0, 2.0, 2.0, 1.0], 2, 2, &mut Pack::default()));
    }
}
