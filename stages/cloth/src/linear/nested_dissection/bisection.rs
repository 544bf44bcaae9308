//! Parting a graph in two sides and a few vertices between them: of the graph with neighbours joined in pairs first, as
//! often as there are many, then told apart again; improved at every size by moves (Karypis and Kumar, A fast and high
//! quality multilevel scheme for partitioning irregular graphs, 1998; Fiduccia and Mattheyses 1982).

use crate::linear::nested_dissection::graph::{Graph, NONE, number};
use std::collections::BinaryHeap;

pub(crate) const FIRST: u8 = 0;
pub(crate) const SECOND: u8 = 1;
pub(crate) const BETWEEN: u8 = 2;

/// Vertices that are parted without joining any before.
const FEW: usize = 60;
/// Joining goes on while it leaves less than so many of ten.
const FEWER: usize = 9;
/// Largest share of the weight that may lie on one side, as a fraction.
const UNEVEN: (u32, u32) = (2, 3);
/// Starts that are tried where few are parted.
const STARTS: u32 = 6;
/// Rounds of moves, and moves in a row without gain after which a round ends.
const ROUNDS: usize = 4;
const IDLE: usize = 200;
/// From so many vertices on two ways to join them are tried: 50,000 unknowns of cloth then take a tenth fewer sums.
const MANY: usize = 1_000;

/// The side of every vertex, in the better of two ways where there are many.
pub(crate) fn part(graph: &Graph) -> Vec<u8> {
    let first = part_in(graph, 0);
    if graph.len() <= MANY {
        return first;
    }
    let second = part_in(graph, 1);
    if price(graph, &second) < price(graph, &first) { second } else { first }
}

/// What lies between, dearer by a twelfth where one side is twice the other.
fn price(graph: &Graph, sides: &[u8]) -> u64 {
    let weights = weights(graph, sides).map(u64::from);
    weights[2] * (4 * u64::from(graph.total()) + weights[0].abs_diff(weights[1]))
}

/// The side of every vertex: of the graph with its vertices joined first, in one way of several, then better and better told
/// apart.
fn part_in(graph: &Graph, way: u32) -> Vec<u8> {
    if graph.len() > FEW {
        let most = (3 * graph.total() / (2 * number(FEW))).max(2);
        let (fewer, joint) = graph.joined(most, way);
        if 10 * fewer.len() < FEWER * graph.len() {
            let sides = if way == 0 { part(&fewer) } else { part_in(&fewer, way) };
            let sides = joint.iter().map(|j| sides[*j as usize]).collect();
            return Parting::new(graph, sides).improved();
        }
    }
    first(graph)
}

/// The best of several ways to grow one half.
fn first(graph: &Graph) -> Vec<u8> {
    let n = number(graph.len());
    let mut best: Option<((u32, u32), Vec<u8>)> = None;
    for k in 0..STARTS {
        let mut seen = vec![false; graph.len()];
        let front = graph.front(k * n / STARTS, &mut seen);
        let mut seen = vec![false; graph.len()];
        let front = graph.front(front.last().copied().unwrap_or(0), &mut seen);
        let sides = Parting::new(graph, halved(graph, &front)).improved();
        let worth = worth(graph, &sides);
        if best.as_ref().is_none_or(|b| worth < b.0) {
            best = Some((worth, sides));
        }
    }
    best.map_or_else(Vec::new, |b| b.1)
}

/// Weight on each side and between.
fn weights(graph: &Graph, sides: &[u8]) -> [u32; 3] {
    let mut weights = [0u32; 3];
    sides.iter().zip(&graph.weight).for_each(|(s, w)| weights[usize::from(*s)] += w);
    weights
}

/// Weight between the sides, and by how much one outweighs the other.
fn worth(graph: &Graph, sides: &[u8]) -> (u32, u32) {
    let weights = weights(graph, sides);
    (weights[2], weights[0].abs_diff(weights[1]))
}

/// The nearer half on the first side; of the other, what touches it lies between.
fn halved(graph: &Graph, front: &[u32]) -> Vec<u8> {
    let mut sides = vec![SECOND; graph.len()];
    let (half, mut sum) = (graph.total() / 2, 0);
    for v in front {
        sum += graph.weight[*v as usize];
        if sum > half {
            break;
        }
        sides[*v as usize] = FIRST;
    }
    for v in 0..graph.len() {
        if sides[v] == SECOND && graph.around(number(v)).iter().any(|w| sides[*w as usize] == FIRST) {
            sides[v] = BETWEEN;
        }
    }
    sides
}

struct Parting<'a> {
    graph: &'a Graph,
    sides: Vec<u8>,
    weights: [u32; 3],
    most: u32,
    offers: [BinaryHeap<(i64, u32)>; 2],
    /// The last gain offered for each vertex and side.
    gains: [Vec<i64>; 2],
    moved: Vec<bool>,
    /// Whose side changed in this round, and what it was.
    log: Vec<(u32, u8)>,
}

impl<'a> Parting<'a> {
    fn new(graph: &'a Graph, sides: Vec<u8>) -> Self {
        let weights = weights(graph, &sides);
        let heaviest = graph.weight.iter().max().copied().unwrap_or(0);
        let most = (graph.total() / UNEVEN.1 * UNEVEN.0).max(graph.total() / 2 + heaviest);
        let n = graph.len();
        let gains = [vec![0; n], vec![0; n]];
        Self { graph, sides, weights, most, offers: Default::default(), gains, moved: vec![false; n], log: Vec::new() }
    }

    fn improved(mut self) -> Vec<u8> {
        for _ in 0..ROUNDS {
            if !self.round() {
                break;
            }
        }
        self.sides
    }

    /// What lies between, and by how much a side is too heavy or heavier than the other.
    fn worth(&self) -> (u32, u32, u32) {
        let larger = self.weights[0].max(self.weights[1]);
        (larger.saturating_sub(self.most), self.weights[2], self.weights[0].abs_diff(self.weights[1]))
    }

    /// By how much less lies between when `v` goes to a side.
    fn gain(&self, v: u32, to: u8) -> i64 {
        let drawn = self.graph.around(v).iter().filter(|w| self.sides[**w as usize] == 1 - to);
        i64::from(self.graph.weight[v as usize]) - drawn.map(|w| i64::from(self.graph.weight[*w as usize])).sum::<i64>()
    }

    fn offer(&mut self, v: u32) {
        for to in [FIRST, SECOND] {
            let gain = self.gain(v, to);
            self.offer_for(v, to, gain);
        }
    }

    fn offer_for(&mut self, v: u32, to: u8, gain: i64) {
        self.gains[usize::from(to)][v as usize] = gain;
        if !self.moved[v as usize] {
            self.offers[usize::from(to)].push((gain, NONE - v));
        }
    }

    /// Going to a side gains so much more for what lies between and touches `v`.
    fn gain_around(&mut self, v: u32, to: u8, more: i64) {
        let graph = self.graph;
        for u in graph.around(v) {
            if self.sides[*u as usize] == BETWEEN {
                self.offer_for(*u, to, self.gains[usize::from(to)][*u as usize] + more);
            }
        }
    }

    fn set(&mut self, v: u32, side: u8) {
        let before = std::mem::replace(&mut self.sides[v as usize], side);
        let weight = self.graph.weight[v as usize];
        self.weights[usize::from(before)] -= weight;
        self.weights[usize::from(side)] += weight;
        self.log.push((v, before));
    }

    /// Takes the best moves, also such that lose, until long none has won; back to the best there was. Says whether that is
    /// better than before.
    fn round(&mut self) -> bool {
        self.log.clear();
        self.moved.fill(false);
        self.offers.iter_mut().for_each(BinaryHeap::clear);
        for v in 0..number(self.graph.len()) {
            if self.sides[v as usize] == BETWEEN {
                self.offer(v);
            }
        }
        let before = self.worth();
        let (mut best, mut kept, mut idle) = (before, 0, 0);
        while let Some((v, to)) = self.best_offer().filter(|_| idle <= IDLE) {
            self.take(v, to);
            idle += 1;
            let worth = self.worth();
            if worth < best {
                (best, kept, idle) = (worth, self.log.len(), 0);
            }
        }
        while self.log.len() > kept {
            if let Some((v, side)) = self.log.pop() {
                self.set(v, side);
                self.log.pop();
            }
        }
        best < before
    }

    /// The move with the largest gain that leaves neither side too heavy.
    fn best_offer(&mut self) -> Option<(u32, u8)> {
        let mut best: Option<(i64, u32, u8)> = None;
        for to in [FIRST, SECOND] {
            let side = usize::from(to);
            while let Some((gain, key)) = self.offers[side].peek().copied() {
                let v = NONE - key;
                let stale =
                    self.sides[v as usize] != BETWEEN || self.moved[v as usize] || self.gains[side][v as usize] != gain;
                if stale || self.weights[side] + self.graph.weight[v as usize] > self.most.max(self.weights[1 - side]) {
                    self.offers[side].pop();
                    continue;
                }
                let lighter = self.weights[side] < self.weights[1 - side];
                if best.is_none_or(|b| gain > b.0 || (gain == b.0 && lighter)) {
                    best = Some((gain, v, to));
                }
                break;
            }
        }
        best.map(|(_, v, to)| (v, to))
    }

    /// Moves `v` to a side; what it touches on the other lies between from now on.
    fn take(&mut self, v: u32, to: u8) {
        let graph = self.graph;
        self.moved[v as usize] = true;
        self.set(v, to);
        self.gain_around(v, 1 - to, -i64::from(graph.weight[v as usize]));
        for w in graph.around(v) {
            if self.sides[*w as usize] == 1 - to {
                self.gain_around(*w, to, i64::from(graph.weight[*w as usize]));
                self.set(*w, BETWEEN);
                self.offer(*w);
            }
        }
    }
}
