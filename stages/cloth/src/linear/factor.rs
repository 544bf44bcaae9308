//! Supernodal Cholesky factor in single precision: it only steers the descent, the state is double. Ours, because the
//! libraries' kernels choose their sums by the processor, and the same input must give the same bytes everywhere.
//!
//! Ng, Peyton: Block sparse Cholesky algorithms on advanced uniprocessor computers, SIAM J. Sci. Comput. 14 (1993), in
//! its right-looking form: a finished node is taken out of all nodes that own its rows at once.

use super::dense::{self, Pack, TALL};
use super::hessian::Pattern;
use super::sweep;
use super::symbolic::{Node, Symbolic};
use crate::Vec3;
use nalgebra::Matrix3;
use pulp::{Arch, Simd, WithSimd};

/// 2⁻⁶⁰.
const FLOOR: f32 = 1.0 / (1u64 << 60) as f32;

/// A factorised block matrix.
#[derive(Default)]
pub(crate) struct Factor {
    pattern: Pattern,
    symbolic: Symbolic,
    values: Vec<f32>,
    right: Vec<f32>,
    local: Vec<f32>,
    pack: Pack,
    sums: Vec<f32>,
    arch: Arch,
    /// A power of two by which the system is divided, of the size of its largest value: so similar systems have the same
    /// factor.
    size: f64,
    pub analyses: u32,
    pub factors: u32,
}

impl Factor {
    /// Factorises `values` on `pattern` plus `shift` on the diagonal; `false` when it is not positive definite (or the
    /// memory for it is not there).
    pub fn factorise(&mut self, pattern: &Pattern, values: &[Matrix3<f64>], shift: &[f64]) -> bool {
        if self.pattern != *pattern {
            self.analyse(pattern);
            if self.pattern != *pattern {
                return false;
            }
        }
        self.factors += 1;
        self.fill(values, shift);
        self.arch.dispatch(Eliminate {
            nodes: &self.symbolic.nodes,
            values: &mut self.values,
            pack: &mut self.pack,
            sums: &mut self.sums,
        })
    }

    /// Makes room for a factor of another pattern, if it can.
    fn analyse(&mut self, pattern: &Pattern) {
        // The old factor goes first: both would be the most that is ever held.
        (self.values, self.pattern) = (Vec::new(), Pattern::default());
        let old = std::mem::take(&mut self.symbolic);
        let Some(symbolic) = old.alike(pattern).or_else(|| Symbolic::new(pattern)) else { return };
        drop(old);
        self.analyses += 1;
        self.values = vec![0.0; symbolic.length + TALL];
        self.right = vec![0.0; 3 * pattern.unknowns()];
        self.pattern = pattern.clone();
        self.symbolic = symbolic;
    }

    /// Rounds the blocks into the columns they belong to.
    #[allow(clippy::cast_possible_truncation)]
    fn fill(&mut self, values: &[Matrix3<f64>], shift: &[f64]) {
        let diagonal = self.pattern.start.iter().filter_map(|k| values.get(*k as usize));
        let largest = diagonal.map(|m| m[(0, 0)].max(m[(1, 1)]).max(m[(2, 2)])).fold(0.0, f64::max);
        self.size = crate::power_of_two(largest);
        let (floor, scale) = (floor(values), 1.0 / self.size);
        for node in &self.symbolic.nodes {
            let panel = &mut self.values[node.start..][..node.height() * node.width()];
            for (column, scalars) in panel.chunks_exact_mut(node.height()).enumerate() {
                let low = floor[column % 3];
                scalars.as_chunks_mut().0.iter_mut().for_each(|rows| *rows = low);
            }
        }
        for (value, target) in values.iter().zip(&self.symbolic.targets) {
            for c in 0..3 {
                for r in 0..3 {
                    let v = if target.is_mirrored() { value[(c, r)] } else { value[(r, c)] };
                    self.values[target.scalar(r, c)] = (v * scale) as f32 + floor[c][r];
                }
            }
        }
        for (start, shift) in self.pattern.start.iter().zip(shift) {
            let target = self.symbolic.targets[*start as usize];
            let block = &values[*start as usize];
            for c in 0..3 {
                self.values[target.scalar(c, c)] = ((block[(c, c)] + shift) * scale) as f32;
            }
        }
    }

    /// Solves for one right-hand side, in place.
    #[allow(clippy::cast_possible_truncation)]
    pub fn solve(&mut self, b: &mut [Vec3]) {
        let scale = 1.0 / self.size;
        for (place, v) in self.symbolic.place.iter().zip(b.iter()) {
            for k in 0..3 {
                self.right[3 * *place as usize + k] = (v[k] * scale) as f32;
            }
        }
        let (nodes, values) = (&self.symbolic.nodes, &self.values);
        self.arch.dispatch(Solve { nodes, values, right: &mut self.right, local: &mut self.local });
        for (place, v) in self.symbolic.place.iter().zip(b.iter_mut()) {
            *v = Vec3::from_fn(|k, _| f64::from(self.right[3 * *place as usize + k]));
        }
    }
}

/// What stands in place of zeros, per pair of axes, far below what single precision can tell of a system of the size of
/// one: far from the pattern what fills in is soon too small to be a normal number, and those take the processor a hundred
/// times as long. None between axes that know nothing of each other, so that flat cloth stays flat.
fn floor(values: &[Matrix3<f64>]) -> [[f32; 3]; 3] {
    let mut coupled = Matrix3::<f64>::zeros();
    values.iter().for_each(|m| coupled += m.abs());
    let low = |c: usize, r: usize| if coupled[(r, c)] + coupled[(c, r)] > 0.0 { FLOOR } else { 0.0 };
    [0, 1, 2].map(|c| [low(c, 0), low(c, 1), low(c, 2)])
}

// What runs under the widest registers of the machine; named types, because only they are compiled for them as a whole.
struct Eliminate<'a> {
    nodes: &'a [Node],
    values: &'a mut [f32],
    pack: &'a mut Pack,
    sums: &'a mut Vec<f32>,
}

impl WithSimd for Eliminate<'_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> bool {
        // As many columns at a time as there are registers for.
        match S::F32_LANES {
            16 => self.by::<S, 1, 8>(simd),
            8 => self.by::<S, 2, 4>(simd),
            4 => self.by::<S, 4, 4>(simd),
            _ => self.by::<S, 16, 4>(simd),
        }
    }
}

impl Eliminate<'_> {
    /// All nodes in order; each takes its products out of the nodes that own its rows.
    #[inline(always)]
    fn by<S: Simd, const V: usize, const W: usize>(self, simd: S) -> bool {
        for node in self.nodes {
            let (height, width) = (node.height(), node.width());
            let panel = &mut self.values[node.start..node.start + height * width];
            if !dense::factor_panel::<S, V, W>(simd, panel, height, width, self.pack) {
                return false;
            }
            // While it is near; its products are made of the pack.
            sweep::lay_out(panel, height, width, self.sums);
            let tall = height.next_multiple_of(TALL);
            if self.sums.len() < W * tall {
                self.sums.resize(W * tall, 0.0);
            }
            let sums = &mut self.sums[..W * tall];
            for first in (width - width % W..height).step_by(W) {
                dense::products::<S, V, W>(simd, self.pack, first, tall, sums);
                for column in first.max(width)..(first + W).min(height) {
                    spread(node, self.nodes, column, &sums[(column - first) * tall..][..height], self.values);
                }
            }
        }
        true
    }
}

/// Takes one column of products out of the node that owns it.
#[inline(always)]
fn spread(node: &Node, nodes: &[Node], column: usize, sums: &[f32], values: &mut [f32]) {
    let Some(owner) = node.owners.iter().find(|o| column < o.to) else { return };
    let target = &nodes[owner.node as usize];
    let mut into = None;
    for run in &owner.runs {
        let (from, to, length) = (run.from as usize, run.to as usize, run.length as usize);
        if from + length <= column {
            continue;
        }
        let late = column.saturating_sub(from);
        let c = *into.get_or_insert(to + late);
        let (at, length) = (target.start + c * target.height() + to + late, length - late);
        for (v, s) in values[at..at + length].iter_mut().zip(&sums[from + late..][..length]) {
            *v -= s;
        }
    }
}

struct Solve<'a> {
    nodes: &'a [Node],
    values: &'a [f32],
    right: &'a mut [f32],
    local: &'a mut Vec<f32>,
}

impl WithSimd for Solve<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        match S::F32_LANES {
            16 => self.by::<S, 1>(simd),
            8 => self.by::<S, 2>(simd),
            4 => self.by::<S, 4>(simd),
            _ => self.by::<S, 16>(simd),
        }
    }
}

impl Solve<'_> {
    #[inline(always)]
    fn by<S: Simd, const V: usize>(self, simd: S) {
        for node in self.nodes {
            forward::<S, V>(simd, node, self.values, self.right, self.local);
        }
        for node in self.nodes.iter().rev() {
            backward::<S, V>(simd, node, self.values, self.right, self.local);
        }
    }
}

#[inline(always)]
fn forward<S: Simd, const V: usize>(simd: S, node: &Node, values: &[f32], right: &mut [f32], local: &mut Vec<f32>) {
    let (l, local) = gather(node, values, right, local);
    sweep::solve_lower::<S, V>(simd, l, local, node.width());
    scatter(node, right, local);
}

#[inline(always)]
fn backward<S: Simd, const V: usize>(simd: S, node: &Node, values: &[f32], right: &mut [f32], local: &mut Vec<f32>) {
    let (l, local) = gather(node, values, right, local);
    sweep::solve_upper::<S, V>(simd, l, local, node.width());
    let first = 3 * node.first as usize;
    right[first..first + node.width()].copy_from_slice(&local[..node.width()]);
}

#[inline(always)]
fn gather<'a>(node: &Node, values: &'a [f32], right: &[f32], local: &'a mut Vec<f32>) -> (&'a [f32], &'a mut [f32]) {
    let (first, width, length) = (3 * node.first as usize, node.width(), node.height() + TALL);
    if local.len() < length {
        local.resize(length, 0.0);
    }
    let local = &mut local[..length];
    local[node.height()..].fill(0.0);
    local[..width].copy_from_slice(&right[first..first + width]);
    let vertices = right.as_chunks::<3>().0;
    for (row, part) in node.rows.iter().zip(local[width..].as_chunks_mut().0) {
        *part = vertices[*row as usize];
    }
    (&values[node.start..node.start + node.height() * width + TALL], local)
}

#[inline(always)]
fn scatter(node: &Node, right: &mut [f32], local: &[f32]) {
    let first = 3 * node.first as usize;
    right[first..first + node.width()].copy_from_slice(&local[..node.width()]);
    let vertices = right.as_chunks_mut::<3>().0;
    for (row, part) in node.rows.iter().zip(local[node.width()..].as_chunks().0) {
        vertices[*row as usize] = *part;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A grid of blocks, whose elimination has many supernodes; its solution, and the right-hand side for that.
    fn grid() -> (Pattern, Vec<Matrix3<f64>>, Vec<Vec3>, Vec<Vec3>) {
        let side = 13u32;
        let n = (side * side) as usize;
        let at = |r: u32, c: u32| r * side + c;
        let mut pairs = Vec::new();
        for r in 0..side {
            for c in 0..side {
                pairs.extend((c + 1 < side).then(|| [at(r, c), at(r, c + 1)]));
                pairs.extend((r + 1 < side).then(|| [at(r, c), at(r + 1, c)]));
            }
        }
        let pattern = Pattern::new(n, pairs.clone());
        let off = Matrix3::new(-1.0, 0.2, 0.0, 0.1, -1.5, 0.3, 0.0, 0.4, -0.5);
        let mut values = vec![off; pattern.rows.len()];
        (0..n).for_each(|j| values[pattern.start[j] as usize] = Matrix3::identity() * 9.0);
        let x: Vec<Vec3> = (0..n).map(|i| Vec3::new((i % 7) as f64, 1.0 - (i % 5) as f64, 0.5)).collect();
        let mut b: Vec<Vec3> = x.iter().map(|v| v * 10.0).collect();
        for [j, i] in pairs.iter().map(|p| p.map(|v| v as usize)) {
            b[i] += off * x[j];
            b[j] += off.transpose() * x[i];
        }
        (pattern, values, x, b)
    }

    #[test]
    fn solves_a_grid_of_blocks() {
        let (pattern, values, x, mut b) = grid();
        let mut factor = Factor::default();
        assert!(factor.factorise(&pattern, &values, &vec![1.0; x.len()]));
        factor.solve(&mut b);
        for (p, q) in x.iter().zip(&b) {
            assert!((p - q).norm() < 2e-5, "{p} {q}");
        }
        assert!(!factor.factorise(&pattern, &values, &vec![-10.0; x.len()]));
        assert_eq!(factor.analyses, 1);
    }

    #[test]
    fn solves_unknowns_that_know_nothing_of_each_other() {
        for n in [1, 3] {
            let pattern = Pattern::new(n, Vec::new());
            let block = Matrix3::new(4.0, 1.0, 0.0, 1.0, 3.0, 0.5, 0.0, 0.5, 2.0);
            let x = Vec3::new(1.0, -2.0, 3.0);
            let mut b = vec![block * x + x; n];
            let mut factor = Factor::default();
            assert!(factor.factorise(&pattern, &vec![block; n], &vec![1.0; n]));
            factor.solve(&mut b);
            b.iter().for_each(|y| assert!((x - y).norm() < 1e-5, "{y}"));
        }
    }

    /// Whatever registers a processor has, not a bit of factor and solution may differ.
    #[test]
    fn every_width_of_registers_gives_the_same_bits() {
        let (pattern, values, _, b) = grid();
        let bits = |arch: Arch| {
            let (mut factor, mut x) = (Factor { arch, ..Factor::default() }, b.clone());
            assert!(factor.factorise(&pattern, &values, &vec![1.0; b.len()]));
            factor.solve(&mut x);
            let solution: Vec<u64> = x.iter().flatten().map(|v| v.to_bits()).collect();
            (factor.values.iter().map(|v| v.to_bits()).collect::<Vec<u32>>(), solution)
        };
        let narrow = bits(Arch::Scalar);
        for arch in wider() {
            assert!(bits(arch) == narrow, "{arch:?} and single numbers differ");
        }
    }

    /// All that this processor can do beyond single numbers.
    fn wider() -> Vec<Arch> {
        #[cfg(target_arch = "x86_64")]
        let others = [pulp::x86::V3::try_new().map(Arch::V3), pulp::x86::V4::try_new().map(Arch::V4)];
        #[cfg(not(target_arch = "x86_64"))]
        let others = [Some(Arch::new())];
        others.into_iter().flatten().collect()
    }
}
