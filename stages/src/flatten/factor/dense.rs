//! Dense kernels in double precision, for a panel that is stored by columns.
//!
//! Every sum runs in one stated order, and each product is fused into it with one rounding.

use pulp::Simd;

/// Rows of the tile that is summed in registers.
pub const STRIP: usize = 8;
/// Columns of a block of a panel.
const BLOCK: usize = 8;

/// Sums over the first `depth` columns of products of the rows of strip `p` (`V` registers) with the `W` rows from
/// `first`.
#[inline(always)]
fn tile<S: Simd, const V: usize, const W: usize>(
    simd: S,
    panel: &[f64],
    stride: usize,
    depth: usize,
    p: usize,
    first: usize,
) -> [[S::f64s; V]; W] {
    let mut sum = [[simd.splat_f64s(0.0); V]; W];
    for column in panel.chunks_exact(stride).take(depth) {
        let (Some(l), Some(r)) = (column[p * STRIP..].first_chunk::<STRIP>(), column[first..].first_chunk::<W>())
        else {
            continue;
        };
        let Some(l) = S::as_simd_f64s(l).0.first_chunk::<V>() else { continue };
        for w in 0..W {
            let r = simd.splat_f64s(r[w]);
            for v in 0..V {
                sum[w][v] = simd.mul_add_f64s(l[v], r, sum[w][v]);
            }
        }
    }
    sum
}

/// Products over all `depth` columns of the `W` rows from `first` with all rows from their strip on, by columns of
/// `stride` rows. The row that the first column belongs to.
#[inline(always)]
pub fn products<S: Simd, const V: usize, const W: usize>(
    simd: S,
    panel: &[f64],
    stride: usize,
    depth: usize,
    first: usize,
    out: &mut [f64],
) -> usize {
    // Near the end of the panel, columns before `first` fill the registers.
    let first = first.min(stride - W);
    for p in first / STRIP..stride / STRIP {
        let sums = tile::<S, V, W>(simd, panel, stride, depth, p, first);
        for (column, sum) in out.chunks_exact_mut(stride).zip(&sums) {
            let into = S::as_mut_simd_f64s(&mut column[p * STRIP..(p + 1) * STRIP]).0;
            into.iter_mut().zip(sum).for_each(|(o, s)| *o = *s);
        }
    }
    first
}

/// Cholesky factor of the first `width` columns of a panel. `false` when a pivot is not positive.
#[inline(always)]
pub fn factor_panel<S: Simd, const V: usize, const W: usize>(
    simd: S,
    panel: &mut [f64],
    stride: usize,
    width: usize,
    sums: &mut [f64],
) -> bool {
    for from in (0..width).step_by(BLOCK) {
        let to = width.min(from + BLOCK);
        if from > 0 {
            for first in (from..to).step_by(W) {
                let begin = products::<S, V, W>(simd, panel, stride, from, first, sums);
                for c in first..to.min(first + W) {
                    let column = &mut panel[c * stride..][..stride];
                    let sum = &sums[(c - begin) * stride..][..stride];
                    column[from..].iter_mut().zip(&sum[from..]).for_each(|(v, s)| *v -= s);
                }
            }
        }
        if !factor_block(panel, stride, from, to) {
            return false;
        }
    }
    true
}

/// The columns `from..to`, from which all columns before them are taken out already.
#[inline(always)]
fn factor_block(panel: &mut [f64], stride: usize, from: usize, to: usize) -> bool {
    for c in from..to {
        let (before, column) = panel.split_at_mut(c * stride);
        let column = &mut column[..stride];
        for done in before[from * stride..].chunks_exact(stride) {
            let by = done[c];
            column[c..].iter_mut().zip(&done[c..]).for_each(|(v, d)| *v -= d * by);
        }
        let pivot = column[c];
        if !(pivot > 0.0 && pivot.is_finite()) {
            return false;
        }
        let root = pivot.sqrt();
        column[c..].iter_mut().for_each(|v| *v /= root);
    }
    true
}
