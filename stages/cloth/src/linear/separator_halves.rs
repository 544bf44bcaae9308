//! Two independent parts of the elimination tree, on which two threads may work, and the nodes above both.

use crate::linear::supernode::Node;
use crate::linear::tuning::HALVES_WORK_MAX;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Two cuts in the order of the nodes.
///
/// Nodes before the first cut are one half, those before the second cut the other half. Only the nodes from there on
/// take products of both. Without such halves both cuts are at the end.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct SeparatorHalves(pub [usize; 2]);

impl SeparatorHalves {
    /// All nodes in one half.
    pub fn none(nodes: &[Node]) -> Self {
        Self([nodes.len(); 2])
    }

    /// The halves with the least time when they are eliminated side by side.
    pub fn new(nodes: &[Node]) -> Self {
        let mut done = vec![0.0];
        for (k, n) in nodes.iter().enumerate() {
            done.push(done[k] + (n.height() * n.height() * n.width()) as f64);
        }
        let all = done[nodes.len()];
        let mut best = (HALVES_WORK_MAX.get() * all, Self::none(nodes));
        let mut above = BinaryHeap::new();
        for first in 1..nodes.len() {
            // The first ancestor of a node is below all its other ancestors.
            above.extend(nodes[first - 1].ancestors.first().map(|o| Reverse(o.node as usize)));
            while above.peek().is_some_and(|o| o.0 < first) {
                above.pop();
            }
            let second = above.peek().map_or(nodes.len(), |o| o.0);
            let left = done[first].max(done[second] - done[first]) + all - done[second];
            if left < best.0 {
                best = (left, Self([first, second]));
            }
        }
        best.1
    }

    /// Number of threads that have work, of the `threads` that there are.
    pub fn useful_threads(self, threads: usize) -> usize {
        if self.0[0] == self.0[1] { 1 } else { threads }
    }

    /// The numbers of all nodes, cut at the two places; `start` gives the place of the first number of a node.
    pub fn cut(self, start: impl Fn(usize) -> usize, numbers: &mut [f32]) -> [&mut [f32]; 3] {
        let (before, above) = numbers.split_at_mut(start(self.0[1]));
        let (first, second) = before.split_at_mut(start(self.0[0]));
        [first, second, above]
    }
}

/// The numbers that the nodes of one half work on: their own, and those of the nodes above.
pub(crate) struct PartView<'a> {
    /// Numbers of these nodes.
    pub own: &'a mut [f32],
    /// Place of the first of them among all numbers.
    pub first: usize,
    /// Numbers of the nodes above.
    pub above: &'a mut [f32],
    /// Place of the first of those among all numbers.
    pub from: usize,
}

impl PartView<'_> {
    /// The `length` numbers from a place on, which belong to one node.
    #[inline(always)]
    pub fn at(&mut self, place: usize, length: usize) -> &mut [f32] {
        if place < self.from {
            &mut self.own[place - self.first..][..length]
        } else {
            &mut self.above[place - self.from..][..length]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::hessian::grid_pairs;
    use crate::linear::pattern::Pattern;
    use crate::linear::symbolic::Symbolic;

    /// A sheet of squares, each vertex coupled with those around it and two lines away.
    fn sheet(side: u32) -> Symbolic {
        let pairs = grid_pairs(side, &[(0, 1), (1, 0), (1, 1), (0, 2), (2, 0)]);
        let pattern = Pattern::new((side * side) as usize, pairs);
        Symbolic::new(&pattern).unwrap_or_else(|| unreachable!("a sheet can be ordered"))
    }

    #[test]
    fn the_halves_of_a_sheet_are_independent_and_nearly_equal() {
        let nodes = sheet(70).nodes;
        let SeparatorHalves([first, second]) = SeparatorHalves::new(&nodes);
        assert!(0 < first && first < second && second < nodes.len());
        for n in &nodes[..first] {
            assert!(n.ancestors.iter().all(|o| (o.node as usize) < first || o.node as usize >= second));
        }
        let work = |part: &[Node]| part.iter().map(|n| (n.height() * n.height() * n.width()) as f64).sum::<f64>();
        let (one, other, all) = (work(&nodes[..first]), work(&nodes[first..second]), work(&nodes));
        assert!(one.max(other) < 0.6 * all && one.min(other) > 0.2 * all, "{one} {other} of {all}");
    }

    #[test]
    fn a_small_sheet_has_no_halves_worth_two_threads() {
        let nodes = sheet(4).nodes;
        assert_eq!(SeparatorHalves::new(&nodes), SeparatorHalves::none(&nodes));
    }
}
