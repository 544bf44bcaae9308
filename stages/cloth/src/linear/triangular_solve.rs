//! Triangular solves with the columns of one panel. They take as long as the factor takes to be read, so it is laid in the
//! order in which they read it: by columns, several streams at a time, large factors came at a third of the memory's speed.
//! Sums run in the order of the columns and rows however they lie.

use crate::linear::dense::{TALL, line, registers, registers_mut};
use pulp::Simd;

/// Columns that are taken at a time.
const WIDE: usize = 4;

/// Lays the columns of a panel, one after the other, in the order of the solves: `WIDE` of them at a time, the corner on
/// the diagonal first, then by strips of `TALL` rows; what is above the diagonal is left out. `spare` is any room.
#[inline(always)]
pub(crate) fn lay_out(panel: &mut [f32], height: usize, width: usize, spare: &mut Vec<f32>) {
    let mut to = 0;
    for j in (0..width).step_by(WIDE) {
        let n = WIDE.min(width - j);
        spare.clear();
        spare.extend_from_slice(&panel[j * height..(j + n) * height]);
        let (strips, rest) = ((height - j - n) / TALL, (height - j - n) % TALL);
        let (corner, below) = panel[to..to + n * (height - j)].split_at_mut(n * n);
        let (whole, last) = below.split_at_mut(n * TALL * strips);
        for (c, column) in spare.chunks_exact(height).enumerate() {
            corner[c * n..][..n].copy_from_slice(&column[j..j + n]);
            let (lines, end) = column[j + n..].as_chunks::<TALL>();
            for (strip, line) in whole.as_chunks_mut().0.chunks_exact_mut(n).zip(lines) {
                strip[c] = *line;
            }
            last[c * rest..][..rest].copy_from_slice(end);
        }
        to += n * (height - j);
    }
}

/// Solves `L y = x` for the columns of one panel and takes them out of the rows below. Behind the panel in `l` and the
/// rows in `x` stand `TALL` numbers more, of which nothing is used; the diagonal of `l` is inverted.
#[inline(always)]
pub(crate) fn solve_lower<S: Simd, const V: usize>(simd: S, mut l: &[f32], x: &mut [f32], width: usize) {
    let height = x.len() - TALL;
    for j in (0..width).step_by(WIDE) {
        let n = WIDE.min(width - j);
        let (corner, columns) = l.split_at(n * n);
        let (top, below) = x[j..].split_at_mut(n);
        for (c, column) in corner.chunks_exact(n).enumerate() {
            top[c] *= column[c];
            for r in c + 1..n {
                top[r] = (-top[c]).mul_add(column[r], top[r]);
            }
        }
        let rows = height - j - n;
        match *top {
            [p, q, r, s] => take_all::<S, V, 4>(simd, [p, q, r, s], columns, rows, below),
            [p, q, r] => take_all::<S, V, 3>(simd, [p, q, r], columns, rows, below),
            [p, q] => take_all::<S, V, 2>(simd, [p, q], columns, rows, below),
            _ => take_all::<S, V, 1>(simd, [top[0]], columns, rows, below),
        }
        l = &columns[n * rows..];
    }
}

/// Takes multiples `y` of columns out of `x`, one after the other.
#[inline(always)]
fn take_all<S: Simd, const V: usize, const N: usize>(
    simd: S,
    y: [f32; N],
    columns: &[f32],
    rows: usize,
    x: &mut [f32],
) {
    let factors = y.map(|y| simd.splat_f32s(-y));
    let (strips, last) = columns.split_at(N * (rows - rows % TALL));
    let (x, rest) = x.split_at_mut(rows - rows % TALL);
    let take = |x: &mut [f32; TALL], n: usize, column: &[f32; TALL]| {
        let (x, c) = (registers_mut::<S, V>(simd, x), registers::<S, V>(simd, column));
        for v in 0..V {
            x[v] = simd.mul_add_f32s(factors[n], c[v], x[v]);
        }
    };
    for (x, strip) in x.as_chunks_mut().0.iter_mut().zip(strips.chunks_exact(N * TALL)) {
        strip.as_chunks().0.iter().enumerate().for_each(|(n, column)| take(x, n, column));
    }
    let rest = first_mut(rest);
    (0..N).for_each(|n| take(rest, n, first(&last[n * (rows % TALL)..])));
}

/// Solves `Lᵀ y = x` for the columns of one panel, the rows below being known. As for [`solve_lower`], with zeros behind
/// the rows in `x`.
#[inline(always)]
pub(crate) fn solve_upper<S: Simd, const V: usize>(simd: S, l: &[f32], x: &mut [f32], width: usize) {
    let height = x.len() - TALL;
    let first = (width - 1) / WIDE * WIDE;
    let mut end = laid(height, width);
    for j in (0..=first).rev().step_by(WIDE) {
        let n = WIDE.min(width - j);
        let (top, below) = x[j..].split_at_mut(n);
        let rows = height - j - n;
        end -= n * (n + rows);
        let (corner, columns) = l[end..].split_at(n * n);
        let mut sums = [0.0; WIDE];
        match n {
            4 => sums = products_of::<S, V, 4>(simd, columns, rows, below),
            3 => sums[..3].copy_from_slice(&products_of::<S, V, 3>(simd, columns, rows, below)),
            2 => sums[..2].copy_from_slice(&products_of::<S, V, 2>(simd, columns, rows, below)),
            _ => sums[..1].copy_from_slice(&products_of::<S, V, 1>(simd, columns, rows, below)),
        }
        for c in (0..n).rev() {
            let column = &corner[c * n..][..n];
            let known = (c + 1..n).fold(sums[c], |sum, r| column[r].mul_add(top[r], sum));
            top[c] = (top[c] - known) * column[c];
        }
    }
}

/// Numbers in a panel that is laid out.
fn laid(height: usize, width: usize) -> usize {
    (0..width).step_by(WIDE).map(|j| WIDE.min(width - j) * (height - j)).sum()
}

/// Products of columns with `x`, each summed in lanes from the last rows to the first, then the lanes in order: panels are
/// read from the last to the first, so memory is read in one stream, and what the columns before this one solved comes last.
#[inline(always)]
fn products_of<S: Simd, const V: usize, const N: usize>(simd: S, columns: &[f32], rows: usize, x: &[f32]) -> [f32; N] {
    let mut lanes = [[simd.splat_f32s(0.0); V]; N];
    let mut add = |x: &[f32; TALL], n: usize, column: &[f32; TALL]| {
        let (x, c) = (registers::<S, V>(simd, x), registers::<S, V>(simd, column));
        for v in 0..V {
            lanes[n][v] = simd.mul_add_f32s(x[v], c[v], lanes[n][v]);
        }
    };
    let (strips, last) = columns.split_at(N * (rows - rows % TALL));
    let (x, rest) = x.split_at(rows - rows % TALL);
    (0..N).for_each(|n| add(first(rest), n, first(&last[n * (rows % TALL)..])));
    for (x, strip) in x.as_chunks().0.iter().zip(strips.chunks_exact(N * TALL)).rev() {
        strip.as_chunks().0.iter().enumerate().rev().for_each(|(n, column)| add(x, n, column));
    }
    lanes.map(|lanes| {
        let lanes = line::<S, V>(simd, &lanes);
        let half: [f32; 8] = std::array::from_fn(|t| lanes[t] + lanes[t + 8]);
        let quarter: [f32; 4] = std::array::from_fn(|t| half[t] + half[t + 4]);
        (quarter[0] + quarter[2]) + (quarter[1] + quarter[3])
    })
}

#[inline(always)]
fn first(numbers: &[f32]) -> &[f32; TALL] {
    numbers.first_chunk().unwrap_or_else(|| unreachable!("{TALL} numbers stand behind every panel"))
}

#[inline(always)]
fn first_mut(numbers: &mut [f32]) -> &mut [f32; TALL] {
    numbers.first_chunk_mut().unwrap_or_else(|| unreachable!("{TALL} numbers stand behind the rows"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Panels of every remainder of columns and rows, against the plain sums by columns.
    #[test]
    fn a_panel_that_is_laid_out_solves_as_its_columns_do() {
        for (height, width) in [(1, 1), (2, 2), (3, 3), (21, 5), (36, 4), (40, 9), (70, 22)] {
            let entry = |i: usize, j: usize| if i == j { 0.5 } else { 0.1 / (1.0 + i.abs_diff(j) as f32) };
            let columns: Vec<f32> = (0..width * height).map(|k| entry(k % height, k / height)).collect();
            let mut panel = [columns.clone(), vec![1e3; TALL]].concat();
            lay_out(&mut panel[..width * height], height, width, &mut Vec::new());
            let given: Vec<f32> = (0..height).map(|i| 1.0 - (i % 5) as f32).collect();
            let padded = || [given.clone(), vec![0.0; TALL]].concat();
            let (mut down, mut up) = (given.clone(), given.clone());
            for j in 0..width {
                down[j] *= columns[j * height + j];
                (j + 1..height).for_each(|i| down[i] -= columns[j * height + i] * down[j]);
            }
            for j in (0..width).rev() {
                let known: f32 = (j + 1..height).map(|i| columns[j * height + i] * up[i]).sum();
                up[j] = (up[j] - known) * columns[j * height + j];
            }
            let (mut lower, mut upper) = (padded(), padded());
            solve_lower::<_, 16>(pulp::Scalar, &panel, &mut lower, width);
            solve_upper::<_, 16>(pulp::Scalar, &panel, &mut upper, width);
            for i in 0..height {
                assert!((lower[i] - down[i]).abs() < 1e-6, "{height} × {width}: {i} {} {}", lower[i], down[i]);
                assert!((upper[i] - up[i]).abs() < 1e-6, "{height} × {width}: {i} {} {}", upper[i], up[i]);
            }
        }
    }
}
