//! Supernodal Cholesky factor in single precision. It only steers the descent; the state is in double precision.
//!
//! The kernels of libraries choose their order of summation by the processor. The same input must give the same bytes
//! everywhere, so the kernels are written here.
//!
//! Large systems fall into two halves that share only the nodes above both. Updates of the second half are summed aside
//! first, in the same way by one thread as by two.

use crate::Vec3;
use crate::linear::dense::STRIP_ROWS;
use crate::linear::eliminate::{Eliminate, Workspace};
use crate::linear::fork_join::fork_join;
use crate::linear::huge_pages::HugePageBuffer;
use crate::linear::pattern::Pattern;
use crate::linear::separator_halves::{PartView, SeparatorHalves};
use crate::linear::substitute::{Substitute, Way};
use crate::linear::symbolic::{EliminationOrder, Symbolic};
use crate::linear::system::{Block, System};
use crate::linear::tuning::PARALLEL_SOLVE_SCALARS_MIN;
use pulp::Arch;
use std::ops::Range;
use std::sync::atomic::AtomicBool;

/// Value in place of a zero of a factor whose system has the size of one: 2⁻⁶⁰.
const ZERO_SUBSTITUTE: f32 = 1.0 / (1u64 << 60) as f32;

/// A factorised block matrix.
#[derive(Default)]
pub(crate) struct Factor {
    pattern: Pattern,
    symbolic: Symbolic,
    /// Order of the pattern before the present one: full and surrogate second derivatives take turns.
    previous_order: EliminationOrder,
    values: HugePageBuffer,
    /// Right-hand side, and then the solution, in the order of elimination.
    right: Vec<f32>,
    /// Updates of the right-hand side above the halves by the second half.
    second_update: Vec<f32>,
    /// Work arrays of the elimination, for each half.
    workspaces: [Workspace; 2],
    /// Work arrays of the solves, for each half.
    locals: [Vec<f32>; 2],
    arch: Arch,
    threads: usize,
    /// CPU seconds of the second thread since they were last taken.
    second_thread_seconds: f64,
    /// Power of two by which the system is divided. It has the size of the largest value, so that similar systems have
    /// the same factor.
    size: f64,
    /// Symbolic analyses so far.
    pub analyses: u32,
    /// Numerical factorisations so far.
    pub factors: u32,
}

impl Factor {
    /// An empty factor that `threads` threads will work on; two are of use.
    pub fn by(threads: usize) -> Self {
        Self { threads, ..Self::default() }
    }

    /// Takes in a system plus `shift` on the diagonal.
    ///
    /// Returns `false` when there is no memory for its factor.
    pub fn take_in(&mut self, system: &System, shift: &[f64]) -> bool {
        if self.pattern != system.pattern {
            self.analyse(&system.pattern);
            if self.pattern != system.pattern {
                return false;
            }
        }
        self.fill(system, shift);
        true
    }

    /// Factorises the system taken in last. Returns `false` when it is not positive definite.
    pub fn eliminate(&mut self) -> bool {
        self.factors += 1;
        let Symbolic { nodes, halves, length, .. } = &self.symbolic;
        let start = |k: usize| nodes.get(k).map_or(*length, |n| n.start);
        let [a, b] = halves.0;
        let threads = halves.useful_threads(self.threads);
        let [own, second, above] = halves.cut(start, &mut self.values[..*length]);
        let ([workspace, spare], from) = (&mut self.workspaces, start(b));
        // This is not kept, because most memory is in use while the next system is put together.
        let second_update = &mut vec![0.0; above.len()];
        let (arch, failed) = (self.arch, AtomicBool::new(false));
        let go = |part: Range<usize>, values: PartView<'_>, workspace: &mut Workspace| {
            arch.dispatch(Eliminate { all: nodes, part, values, workspace, failed: &failed });
        };
        self.second_thread_seconds += fork_join(
            threads,
            || go(0..a, PartView { own, first: 0, above, from }, workspace),
            || go(a..b, PartView { own: second, first: start(a), above: second_update, from }, spare),
        );
        above.iter_mut().zip(&*second_update).for_each(|(v, s)| *v += s);
        go(b..nodes.len(), PartView { own: above, first: from, above: &mut [], from: *length }, workspace);
        !failed.into_inner()
    }

    /// Makes room for a factor of another pattern, if it can.
    fn analyse(&mut self, pattern: &Pattern) {
        // The old factor goes first, because both together would be the most memory that is ever held.
        (self.values, self.pattern) = (HugePageBuffer::default(), Pattern::default());
        let last = std::mem::take(&mut self.symbolic).order;
        let found = Symbolic::with_order_of(pattern, &last).or_else(|| {
            let previous = std::mem::replace(&mut self.previous_order, last);
            Symbolic::with_order_of(pattern, &previous).or_else(|| Symbolic::new(pattern))
        });
        let Some(symbolic) = found else { return };
        let Some(values) = HugePageBuffer::new(symbolic.length + STRIP_ROWS) else { return };
        self.analyses += 1;
        self.values = values;
        self.right = vec![0.0; 3 * pattern.unknowns()];
        self.pattern = pattern.clone();
        self.symbolic = symbolic;
    }

    /// Rounds the blocks into their columns of the factor.
    #[allow(clippy::cast_possible_truncation)]
    fn fill(&mut self, system: &System, shift: &[f64]) {
        let largest = system.diagonal().map(|m| m[(0, 0)].max(m[(1, 1)]).max(m[(2, 2)])).fold(0.0, f64::max);
        self.size = crate::power_of_two(largest);
        let (floor, scale) = (floor(system), 1.0 / self.size);
        let numbers = &mut *self.values;
        for node in &self.symbolic.nodes {
            let panel = &mut numbers[node.start..][..node.height() * node.width()];
            for (column, scalars) in panel.chunks_exact_mut(node.height()).enumerate() {
                let low = floor[column % 3];
                scalars.as_chunks_mut().0.iter_mut().for_each(|rows| *rows = low);
            }
        }
        system.blocks().zip(&self.symbolic.targets).for_each(|(block, target)| match block {
            Block::Isotropic(k) => {
                (0..3).for_each(|c| numbers[target.scalar(c, c)] = (k * scale) as f32 + floor[c][c]);
            }
            Block::General(value) => {
                for c in 0..3 {
                    for r in 0..3 {
                        let v = if target.is_mirrored() { value[(c, r)] } else { value[(r, c)] };
                        numbers[target.scalar(r, c)] = (v * scale) as f32 + floor[c][r];
                    }
                }
            }
        });
        for ((start, block), shift) in self.pattern.start.iter().zip(system.diagonal()).zip(shift) {
            let target = self.symbolic.targets[*start as usize];
            for c in 0..3 {
                numbers[target.scalar(c, c)] = ((block[(c, c)] + shift) * scale) as f32;
            }
        }
    }

    /// Solves for one right-hand side, in place.
    #[allow(clippy::cast_possible_truncation)]
    pub fn solve(&mut self, b: &mut [Vec3]) {
        let scale = 1.0 / self.size;
        for (place, v) in self.symbolic.order.place.iter().zip(b.iter()) {
            for k in 0..3 {
                self.right[3 * *place as usize + k] = (v[k] * scale) as f32;
            }
        }
        self.substitute();
        for (place, v) in self.symbolic.order.place.iter().zip(b.iter_mut()) {
            *v = Vec3::from_fn(|k, _| f64::from(self.right[3 * *place as usize + k]));
        }
    }

    /// Substitutes forwards and backwards in the right-hand side.
    fn substitute(&mut self) {
        let (nodes, values, SeparatorHalves([a, b])) = (&self.symbolic.nodes, &self.values, self.symbolic.halves);
        let all = self.right.len();
        let start = |k: usize| nodes.get(k).map_or(all, |n| 3 * n.first as usize);
        let [own, second, above] = self.symbolic.halves.cut(start, &mut self.right);
        let (second_update, from) = (&mut self.second_update, start(b));
        second_update.clear();
        second_update.resize(above.len(), 0.0);
        let (arch, threads) = (
            self.arch,
            if values.len() < PARALLEL_SOLVE_SCALARS_MIN.get() {
                1
            } else {
                self.symbolic.halves.useful_threads(self.threads)
            },
        );
        let go = |way: Way, part: Range<usize>, right: PartView<'_>, local: &mut Vec<f32>| {
            arch.dispatch(Substitute { way, nodes: &nodes[part], values, right, local });
        };
        let mut seconds = 0.0;
        let mut solve_halves =
            |way: Way, above: &mut [f32], second_update: &mut [f32], [local, spare]: &mut [Vec<f32>; 2]| {
                seconds += fork_join(
                    threads,
                    || go(way, 0..a, PartView { own, first: 0, above, from }, local),
                    || go(way, a..b, PartView { own: second, first: start(a), above: second_update, from }, spare),
                );
            };
        solve_halves(Way::Down, above, second_update, &mut self.locals);
        above.iter_mut().zip(&*second_update).for_each(|(v, s)| *v += s);
        for way in [Way::Down, Way::Up] {
            let right = PartView { own: above, first: from, above: &mut [], from: all };
            go(way, b..nodes.len(), right, &mut self.locals[0]);
        }
        second_update.copy_from_slice(above);
        solve_halves(Way::Up, above, second_update, &mut self.locals);
        self.second_thread_seconds += seconds;
    }

    /// CPU seconds of the second thread since the last call.
    pub fn take_second_thread_seconds(&mut self) -> f64 {
        std::mem::take(&mut self.second_thread_seconds)
    }
}

/// The values in place of zeros, per pair of axes, far below the rounding of a system of the size of one.
///
/// Fill-in far from the pattern is soon too small to be a normal number, and the processor takes a hundred times as
/// long for such numbers. Axes that are not coupled keep their zeros, so that flat cloth stays flat.
fn floor(system: &System) -> [[f32; 3]; 3] {
    let coupled = system.absolute_sums();
    let low = |c: usize, r: usize| if coupled[(r, c)] + coupled[(c, r)] > 0.0 { ZERO_SUBSTITUTE } else { 0.0 };
    [0, 1, 2].map(|c| [low(c, 0), low(c, 1), low(c, 2)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::hessian::grid_pairs;
    use nalgebra::Matrix3;

    /// A square grid of blocks, whose elimination has many supernodes; its solution, and the right-hand side for that.
    fn grid(side: u32) -> (System, Vec<Vec3>, Vec<Vec3>) {
        let n = (side * side) as usize;
        let pairs = grid_pairs(side, &[(0, 1), (1, 0)]);
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
        (System::of_blocks(pattern, values), x, b)
    }

    #[test]
    fn solves_a_grid_of_blocks() {
        let (system, x, mut b) = grid(13);
        let mut factor = Factor::default();
        assert!(factor.take_in(&system, &vec![1.0; x.len()]) && factor.eliminate());
        factor.solve(&mut b);
        for (p, q) in x.iter().zip(&b) {
            assert!((p - q).norm() < 2e-5, "{p} {q}");
        }
        assert!(factor.take_in(&system, &vec![-10.0; x.len()]) && !factor.eliminate());
        assert_eq!(factor.analyses, 1);
    }

    #[test]
    fn solves_uncoupled_unknowns() {
        for n in [1, 3] {
            let pattern = Pattern::new(n, Vec::new());
            let block = Matrix3::new(4.0, 1.0, 0.0, 1.0, 3.0, 0.5, 0.0, 0.5, 2.0);
            let x = Vec3::new(1.0, -2.0, 3.0);
            let mut b = vec![block * x + x; n];
            let system = System::of_blocks(pattern, vec![block; n]);
            let mut factor = Factor::default();
            assert!(factor.take_in(&system, &vec![1.0; n]) && factor.eliminate());
            factor.solve(&mut b);
            b.iter().for_each(|y| assert!((x - y).norm() < 1e-5, "{y}"));
        }
    }

    /// Bits of factor and solution of a grid.
    fn bits(side: u32, arch: Arch, threads: usize) -> (Vec<u32>, Vec<u64>) {
        let (system, x, mut b) = grid(side);
        let mut factor = Factor { arch, threads, ..Factor::default() };
        assert!(factor.take_in(&system, &vec![1.0; b.len()]) && factor.eliminate());
        factor.solve(&mut b);
        x.iter().zip(&b).for_each(|(p, q)| assert!((p - q).norm() < 1e-4, "{p} {q}"));
        (factor.values.iter().map(|v| v.to_bits()).collect(), b.iter().flatten().map(|v| v.to_bits()).collect())
    }

    /// Factor and solution may not differ by a bit, whatever registers a processor has.
    #[test]
    fn every_width_of_registers_gives_the_same_bits() {
        let narrow = bits(13, Arch::Scalar, 1);
        for arch in wider() {
            assert!(bits(13, arch, 1) == narrow, "{arch:?} and single numbers differ");
        }
    }

    #[test]
    fn halves_side_by_side_give_the_same_bits_as_one_after_the_other() {
        let one = bits(60, Arch::new(), 1);
        for threads in [2, 5] {
            assert!(bits(60, Arch::new(), threads) == one, "{threads} threads");
        }
    }

    #[test]
    fn an_indefinite_system_is_reported_by_either_half() {
        let (system, x, _) = grid(60);
        let mut factor = Factor::by(2);
        for v in [0, x.len() / 2, x.len() - 1] {
            let mut shift = vec![1.0; x.len()];
            shift[v] = -20.0;
            assert!(factor.take_in(&system, &shift) && !factor.eliminate(), "{v}");
        }
        assert!(factor.take_in(&system, &vec![1.0; x.len()]) && factor.eliminate());
    }

    /// All vector instruction sets of this processor.
    fn wider() -> Vec<Arch> {
        #[cfg(target_arch = "x86_64")]
        let second = [pulp::x86::V3::try_new().map(Arch::V3), pulp::x86::V4::try_new().map(Arch::V4)];
        #[cfg(not(target_arch = "x86_64"))]
        let second = [Some(Arch::new())];
        second.into_iter().flatten().collect()
    }
}
