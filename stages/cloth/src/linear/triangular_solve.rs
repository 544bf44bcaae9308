//! Blocked triangular solves with the columns of one panel.
//!
//! A solve takes as long as reading the factor. A panel is therefore stored in the order in which the solves read it.
//! Stored by columns, and read in several streams at a time, large factors came at a third of the memory's speed. Sums
//! run in the order of columns and rows, whatever the storage.

use crate::linear::dense::{STRIP_ROWS, line, registers, registers_mut};
use pulp::Simd;

/// Columns that are solved at a time.
const SOLVE_COLUMNS: usize = 4;

/// Stores the columns of a panel, which lie one after the other, in the order of the solves.
///
/// `SOLVE_COLUMNS` columns come at a time: the corner on the diagonal first, then strips of `STRIP_ROWS` rows. Entries
/// above the diagonal are left out. `spare` is a work array.
#[inline(always)]
pub(crate) fn store_for_solves(panel: &mut [f32], height: usize, width: usize, spare: &mut Vec<f32>) {
    let mut to = 0;
    for j in (0..width).step_by(SOLVE_COLUMNS) {
        let n = SOLVE_COLUMNS.min(width - j);
        spare.clear();
        spare.extend_from_slice(&panel[j * height..(j + n) * height]);
        let (strips, rest) = ((height - j - n) / STRIP_ROWS, (height - j - n) % STRIP_ROWS);
        let (corner, below) = panel[to..to + n * (height - j)].split_at_mut(n * n);
        let (whole, last) = below.split_at_mut(n * STRIP_ROWS * strips);
        for (c, column) in spare.chunks_exact(height).enumerate() {
            corner[c * n..][..n].copy_from_slice(&column[j..j + n]);
            let (lines, end) = column[j + n..].as_chunks::<STRIP_ROWS>();
            for (strip, line) in whole.as_chunks_mut().0.chunks_exact_mut(n).zip(lines) {
                strip[c] = *line;
            }
            last[c * rest..][..rest].copy_from_slice(end);
        }
        to += n * (height - j);
    }
}

/// Solves `L y = x` for the columns of one panel and takes them out of the rows below.
///
/// The panel in `l` and the rows in `x` are followed by `STRIP_ROWS` numbers that are not used. The diagonal of `l` is
/// inverted.
#[inline(always)]
pub(crate) fn solve_lower<S: Simd, const V: usize>(simd: S, mut l: &[f32], x: &mut [f32], width: usize) {
    let height = x.len() - STRIP_ROWS;
    for j in (0..width).step_by(SOLVE_COLUMNS) {
        let n = SOLVE_COLUMNS.min(width - j);
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
    let (strips, last) = columns.split_at(N * (rows - rows % STRIP_ROWS));
    let (x, rest) = x.split_at_mut(rows - rows % STRIP_ROWS);
    let take = |x: &mut [f32; STRIP_ROWS], n: usize, column: &[f32; STRIP_ROWS]| {
        let (x, c) = (registers_mut::<S, V>(simd, x), registers::<S, V>(simd, column));
        for v in 0..V {
            x[v] = simd.mul_add_f32s(factors[n], c[v], x[v]);
        }
    };
    for (x, strip) in x.as_chunks_mut().0.iter_mut().zip(strips.chunks_exact(N * STRIP_ROWS)) {
        strip.as_chunks().0.iter().enumerate().for_each(|(n, column)| take(x, n, column));
    }
    let rest = first_mut(rest);
    (0..N).for_each(|n| take(rest, n, first(&last[n * (rows % STRIP_ROWS)..])));
}

/// Solves `Lᵀ y = x` for the columns of one panel; the rows below are known.
///
/// The arguments are those of [`solve_lower`], with zeros behind the rows in `x`.
#[inline(always)]
pub(crate) fn solve_upper<S: Simd, const V: usize>(simd: S, l: &[f32], x: &mut [f32], width: usize) {
    let height = x.len() - STRIP_ROWS;
    let first = (width - 1) / SOLVE_COLUMNS * SOLVE_COLUMNS;
    let mut end = stored_length(height, width);
    for j in (0..=first).rev().step_by(SOLVE_COLUMNS) {
        let n = SOLVE_COLUMNS.min(width - j);
        let (top, below) = x[j..].split_at_mut(n);
        let rows = height - j - n;
        end -= n * (n + rows);
        let (corner, columns) = l[end..].split_at(n * n);
        let mut sums = [0.0; SOLVE_COLUMNS];
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

/// Number of scalars in a panel that is stored for the solves.
fn stored_length(height: usize, width: usize) -> usize {
    (0..width).step_by(SOLVE_COLUMNS).map(|j| SOLVE_COLUMNS.min(width - j) * (height - j)).sum()
}

/// Products of columns with `x`, each summed in lanes from the last rows to the first, and then over the lanes in
/// order.
///
/// Panels are read from the last row to the first, so that memory is read in one stream.
#[inline(always)]
fn products_of<S: Simd, const V: usize, const N: usize>(simd: S, columns: &[f32], rows: usize, x: &[f32]) -> [f32; N] {
    let mut lanes = [[simd.splat_f32s(0.0); V]; N];
    let mut add = |x: &[f32; STRIP_ROWS], n: usize, column: &[f32; STRIP_ROWS]| {
        let (x, c) = (registers::<S, V>(simd, x), registers::<S, V>(simd, column));
        for v in 0..V {
            lanes[n][v] = simd.mul_add_f32s(x[v], c[v], lanes[n][v]);
        }
    };
    let (strips, last) = columns.split_at(N * (rows - rows % STRIP_ROWS));
    let (x, rest) = x.split_at(rows - rows % STRIP_ROWS);
    (0..N).for_each(|n| add(first(rest), n, first(&last[n * (rows % STRIP_ROWS)..])));
    for (x, strip) in x.as_chunks().0.iter().zip(strips.chunks_exact(N * STRIP_ROWS)).rev() {
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
fn first(numbers: &[f32]) -> &[f32; STRIP_ROWS] {
    numbers.first_chunk().unwrap_or_else(|| unreachable!("{STRIP_ROWS} numbers stand behind every panel"))
}

#[inline(always)]
fn first_mut(numbers: &mut [f32]) -> &mut [f32; STRIP_ROWS] {
    numbers.first_chunk_mut().unwrap_or_else(|| unreachable!("{STRIP_ROWS} numbers stand behind the rows"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Panels of every remainder of columns and rows agree with plain sums by columns.
    #[test]
    fn a_stored_panel_solves_as_its_columns_do() {
        for (height, width) in [(1, 1), (2, 2), (3, 3), (21, 5), (36, 4), (40, 9), (70, 22)] {
            let entry = |i: usize, j: usize| if i == j { 0.5 } else { 0.1 / (1.0 + i.abs_diff(j) as f32) };
            let columns: Vec<f32> = (0..width * height).map(|k| entry(k % height, k / height)).collect();
            let mut panel = [columns.clone(), vec![1e3; STRIP_ROWS]].concat();
            store_for_solves(&mut panel[..width * height], height, width, &mut Vec::new());
            let given: Vec<f32> = (0..height).map(|i| 1.0 - (i % 5) as f32).collect();
            let padded = || [given.clone(), vec![0.0; STRIP_ROWS]].concat();
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
