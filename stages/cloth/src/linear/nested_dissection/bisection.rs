//! Multilevel bisection of a graph into two sides and a separator, a few vertices between them.
//!
//! The graph is coarsened by joining neighbours in pairs, as often as it is large. The bisection of the coarsest graph
//! is carried back, and refined at every size by moves of single vertices.
//!
//! Sources: Karypis and Kumar, A fast and high quality multilevel scheme for partitioning irregular graphs, 1998;
//! Fiduccia and Mattheyses 1982.

use crate::linear::nested_dissection::graph::{Graph, NONE, number};
use crate::linear::tuning::{
    BISECTION_COARSEST, BISECTION_STARTS, COARSENING_TENTHS, REFINEMENT_IDLE_MOVES, REFINEMENT_ROUNDS,
    TWO_COARSENINGS_MIN,
};
use std::collections::BinaryHeap;

/// Largest share of the weight that may lie on one side, as numerator and denominator.
const SIDE_WEIGHT_MAX: (u32, u32) = (2, 3);

/// The side of a vertex in a bisection.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    First,
    Second,
    /// Between the two sides.
    Separator,
}

impl Side {
    /// Both sides without the separator.
    const BOTH: [Self; 2] = [Self::First, Self::Second];

    #[inline]
    fn index(self) -> usize {
        self as usize
    }

    /// The other one of the two sides.
    #[inline]
    fn opposite(self) -> Self {
        match self {
            Self::First => Self::Second,
            Self::Second => Self::First,
            Self::Separator => Self::Separator,
        }
    }
}

/// The side of every vertex; a large graph is coarsened in two ways, and the better bisection counts.
pub(crate) fn bisect(graph: &Graph) -> Vec<Side> {
    let first = bisect_in(graph, 0);
    if graph.len() <= TWO_COARSENINGS_MIN.get() {
        return first;
    }
    let second = bisect_in(graph, 1);
    if cost(graph, &second) < cost(graph, &first) { second } else { first }
}

/// Cost of a bisection: the weight of the separator, a twelfth more where one side weighs twice the other.
fn cost(graph: &Graph, sides: &[Side]) -> u64 {
    let weights = weights(graph, sides).map(u64::from);
    weights[2] * (4 * u64::from(graph.total()) + weights[0].abs_diff(weights[1]))
}

/// The side of every vertex, by one of several ways of coarsening.
fn bisect_in(graph: &Graph, way: u32) -> Vec<Side> {
    let coarsest = BISECTION_COARSEST.get();
    if graph.len() > coarsest {
        let heaviest = (3 * graph.total() / (2 * number(coarsest))).max(2);
        let (coarse, joint) = graph.coarsened(heaviest, way);
        if 10 * coarse.len() < COARSENING_TENTHS.get() * graph.len() {
            let sides = if way == 0 { bisect(&coarse) } else { bisect_in(&coarse, way) };
            let sides = joint.iter().map(|j| sides[*j as usize]).collect();
            return Refinement::new(graph, sides).refined();
        }
    }
    bisect_coarsest(graph)
}

/// The best of several bisections that grow from different vertices.
fn bisect_coarsest(graph: &Graph) -> Vec<Side> {
    let n = number(graph.len());
    let mut best: Option<((u32, u32), Vec<Side>)> = None;
    let starts = BISECTION_STARTS.get();
    for k in 0..starts {
        let mut seen = vec![false; graph.len()];
        let front = graph.reached_from(k * n / starts, &mut seen);
        let mut seen = vec![false; graph.len()];
        let front = graph.reached_from(front.last().copied().unwrap_or(0), &mut seen);
        let sides = Refinement::new(graph, grown_half(graph, &front)).refined();
        let quality = quality(graph, &sides);
        if best.as_ref().is_none_or(|b| quality < b.0) {
            best = Some((quality, sides));
        }
    }
    best.map_or_else(Vec::new, |b| b.1)
}

/// Weights of the first side, the second side and the separator.
fn weights(graph: &Graph, sides: &[Side]) -> [u32; 3] {
    let mut weights = [0u32; 3];
    sides.iter().zip(&graph.weight).for_each(|(s, w)| weights[s.index()] += w);
    weights
}

/// Weight of the separator, and by how much one side outweighs the other; the least is best.
fn quality(graph: &Graph, sides: &[Side]) -> (u32, u32) {
    let weights = weights(graph, sides);
    (weights[2], weights[0].abs_diff(weights[1]))
}

/// The first half of the listed vertices as the first side; vertices of the other half that touch it are the separator.
fn grown_half(graph: &Graph, front: &[u32]) -> Vec<Side> {
    let mut sides = vec![Side::Second; graph.len()];
    let (half, mut sum) = (graph.total() / 2, 0);
    for v in front {
        sum += graph.weight[*v as usize];
        if sum > half {
            break;
        }
        sides[*v as usize] = Side::First;
    }
    for v in 0..graph.len() {
        if sides[v] == Side::Second && graph.around(number(v)).iter().any(|w| sides[*w as usize] == Side::First) {
            sides[v] = Side::Separator;
        }
    }
    sides
}

/// Refinement of a bisection by moves of separator vertices to a side (Fiduccia and Mattheyses 1982).
struct Refinement<'a> {
    graph: &'a Graph,
    sides: Vec<Side>,
    weights: [u32; 3],
    /// Largest weight of a side.
    most: u32,
    /// Moves to each side by gain, with the vertex.
    offers: [BinaryHeap<(i64, u32)>; 2],
    /// The last gain offered for each vertex and side.
    gains: [Vec<i64>; 2],
    moved: Vec<bool>,
    /// Vertices whose side changed in this round, and their sides before.
    log: Vec<(u32, Side)>,
}

impl<'a> Refinement<'a> {
    fn new(graph: &'a Graph, sides: Vec<Side>) -> Self {
        let weights = weights(graph, &sides);
        let heaviest = graph.weight.iter().max().copied().unwrap_or(0);
        let most = (graph.total() / SIDE_WEIGHT_MAX.1 * SIDE_WEIGHT_MAX.0).max(graph.total() / 2 + heaviest);
        let n = graph.len();
        let gains = [vec![0; n], vec![0; n]];
        Self { graph, sides, weights, most, offers: Default::default(), gains, moved: vec![false; n], log: Vec::new() }
    }

    /// The sides after some rounds of moves.
    fn refined(mut self) -> Vec<Side> {
        for _ in 0..REFINEMENT_ROUNDS.get() {
            if !self.round() {
                break;
            }
        }
        self.sides
    }

    /// Excess weight of a side, weight of the separator, and difference of the sides; the least is best.
    fn quality(&self) -> (u32, u32, u32) {
        let larger = self.weights[0].max(self.weights[1]);
        (larger.saturating_sub(self.most), self.weights[2], self.weights[0].abs_diff(self.weights[1]))
    }

    /// The weight that the separator loses when `v` goes to a side.
    fn gain(&self, v: u32, to: Side) -> i64 {
        let drawn = self.graph.around(v).iter().filter(|w| self.sides[**w as usize] == to.opposite());
        i64::from(self.graph.weight[v as usize]) - drawn.map(|w| i64::from(self.graph.weight[*w as usize])).sum::<i64>()
    }

    /// Offers the moves of a separator vertex to both sides.
    fn offer(&mut self, v: u32) {
        for to in Side::BOTH {
            let gain = self.gain(v, to);
            self.offer_for(v, to, gain);
        }
    }

    /// Offers the move of a separator vertex to one side.
    fn offer_for(&mut self, v: u32, to: Side, gain: i64) {
        self.gains[to.index()][v as usize] = gain;
        if !self.moved[v as usize] {
            self.offers[to.index()].push((gain, NONE - v));
        }
    }

    /// Raises the gain of moves to a side for the separator vertices around `v`.
    fn gain_around(&mut self, v: u32, to: Side, more: i64) {
        let graph = self.graph;
        for u in graph.around(v) {
            if self.sides[*u as usize] == Side::Separator {
                self.offer_for(*u, to, self.gains[to.index()][*u as usize] + more);
            }
        }
    }

    /// Sets the side of a vertex and notes the change.
    fn set(&mut self, v: u32, side: Side) {
        let before = std::mem::replace(&mut self.sides[v as usize], side);
        let weight = self.graph.weight[v as usize];
        self.weights[before.index()] -= weight;
        self.weights[side.index()] += weight;
        self.log.push((v, before));
    }

    /// One round of moves. Returns `true` if the bisection is better than before.
    ///
    /// The best moves are taken, also such that lose, until none has gained for long. Then the best state is restored.
    fn round(&mut self) -> bool {
        self.log.clear();
        self.moved.fill(false);
        self.offers.iter_mut().for_each(BinaryHeap::clear);
        for v in 0..number(self.graph.len()) {
            if self.sides[v as usize] == Side::Separator {
                self.offer(v);
            }
        }
        let (before, most_idle) = (self.quality(), REFINEMENT_IDLE_MOVES.get());
        let (mut best, mut kept, mut idle) = (before, 0, 0);
        while let Some((v, to)) = self.best_offer().filter(|_| idle <= most_idle) {
            self.take(v, to);
            idle += 1;
            let quality = self.quality();
            if quality < best {
                (best, kept, idle) = (quality, self.log.len(), 0);
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
    fn best_offer(&mut self) -> Option<(u32, Side)> {
        let mut best: Option<(i64, u32, Side)> = None;
        for to in Side::BOTH {
            let side = to.index();
            while let Some((gain, key)) = self.offers[side].peek().copied() {
                let v = NONE - key;
                let stale = self.sides[v as usize] != Side::Separator
                    || self.moved[v as usize]
                    || self.gains[side][v as usize] != gain;
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

    /// Moves `v` to a side; vertices of the other side that it touches go to the separator.
    fn take(&mut self, v: u32, to: Side) {
        let graph = self.graph;
        self.moved[v as usize] = true;
        self.set(v, to);
        self.gain_around(v, to.opposite(), -i64::from(graph.weight[v as usize]));
        for w in graph.around(v) {
            if self.sides[*w as usize] == to.opposite() {
                self.gain_around(*w, to, i64::from(graph.weight[*w as usize]));
                self.set(*w, Side::Separator);
                self.offer(*w);
            }
        }
    }
}
