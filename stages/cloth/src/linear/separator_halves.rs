//! Two parts of the tree of elimination that know nothing of each other, so that two threads may work on them, and what lies
//! above both.

use crate::linear::supernode::Node;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Part of all work that must be left at most, once two work side by side.
const WORTH: f64 = 0.8;

/// Nodes before the first place are one part, those before the second another; nobody but the nodes from there on takes products
/// of both. Without such parts both are the end.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Halves(pub [usize; 2]);

impl Halves {
    /// All nodes in one.
    pub fn none(nodes: &[Node]) -> Self {
        Self([nodes.len(); 2])
    }

    /// Those with the least work left when they are done side by side.
    pub fn new(nodes: &[Node]) -> Self {
        let mut done = vec![0.0];
        for (k, n) in nodes.iter().enumerate() {
            done.push(done[k] + (n.height() * n.height() * n.width()) as f64);
        }
        let all = done[nodes.len()];
        let mut best = (WORTH * all, Self::none(nodes));
        let mut above = BinaryHeap::new();
        for first in 1..nodes.len() {
            // The first owner of a node's rows owns or takes over what its other owners take.
            above.extend(nodes[first - 1].owners.first().map(|o| Reverse(o.node as usize)));
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

    /// How many of so many threads have work.
    pub fn hands(self, threads: usize) -> usize {
        if self.0[0] == self.0[1] { 1 } else { threads }
    }

    /// Numbers of which `start` tells where those of a node begin, cut at the two places.
    pub fn cut(self, start: impl Fn(usize) -> usize, numbers: &mut [f32]) -> [&mut [f32]; 3] {
        let (before, above) = numbers.split_at_mut(start(self.0[1]));
        let (first, second) = before.split_at_mut(start(self.0[0]));
        [first, second, above]
    }
}

/// Numbers that the nodes of one part of the tree work on: their own, and those of the nodes above.
pub(crate) struct Reach<'a> {
    pub own: &'a mut [f32],
    /// Place of the first of them among all.
    pub first: usize,
    pub above: &'a mut [f32],
    pub from: usize,
}

impl Reach<'_> {
    /// So many from a place on, which belong to one node.
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
    use crate::linear::hessian::{Pattern, grid_pairs};
    use crate::linear::symbolic::Symbolic;

    /// A sheet of squares, each vertex bound to those around it and two lines away.
    fn sheet(side: u32) -> Symbolic {
        let pairs = grid_pairs(side, &[(0, 1), (1, 0), (1, 1), (0, 2), (2, 0)]);
        let pattern = Pattern::new((side * side) as usize, pairs);
        Symbolic::new(&pattern).unwrap_or_else(|| unreachable!("a sheet can be ordered"))
    }

    #[test]
    fn the_halves_of_a_sheet_know_nothing_of_each_other_and_are_alike() {
        let nodes = sheet(70).nodes;
        let Halves([first, second]) = Halves::new(&nodes);
        assert!(0 < first && first < second && second < nodes.len());
        for n in &nodes[..first] {
            assert!(n.owners.iter().all(|o| (o.node as usize) < first || o.node as usize >= second));
        }
        let work = |part: &[Node]| part.iter().map(|n| (n.height() * n.height() * n.width()) as f64).sum::<f64>();
        let (one, other, all) = (work(&nodes[..first]), work(&nodes[first..second]), work(&nodes));
        assert!(one.max(other) < 0.6 * all && one.min(other) > 0.2 * all, "{one} {other} of {all}");
    }

    #[test]
    fn a_small_sheet_has_no_halves_worth_two_threads() {
        let nodes = sheet(4).nodes;
        assert_eq!(Halves::new(&nodes), Halves::none(&nodes));
    }
}
