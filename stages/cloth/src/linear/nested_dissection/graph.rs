//! Graphs of coupled unknowns with weights, and their coarsening by pairs of neighbours.

use crate::linear::pattern::Pattern;
use std::cmp::Reverse;

/// The number of no vertex.
pub(crate) const NONE: u32 = u32::MAX;

/// A graph with weights of vertices and edges.
///
/// The weight of a joined vertex is the number of unknowns in it; that of a joined edge is the number of its couplings.
#[derive(Debug, Default)]
pub(crate) struct Graph {
    /// Place of the first neighbour of every vertex, and the number of all neighbours.
    start: Vec<u32>,
    /// Neighbours of all vertices.
    ends: Vec<u32>,
    /// Weights of the edges to them.
    edge_weights: Vec<u32>,
    /// Weights of the vertices.
    pub weight: Vec<u32>,
}

impl Graph {
    /// The graph of a pattern, with weights of one.
    pub fn new(pattern: &Pattern) -> Self {
        let n = pattern.unknowns();
        let pairs = || {
            (0..n).flat_map(|c| {
                let rows = &pattern.rows[pattern.start[c] as usize + 1..pattern.start[c + 1] as usize];
                rows.iter().map(move |r| (c, *r as usize))
            })
        };
        let mut start = vec![0u32; n + 1];
        for (c, r) in pairs() {
            start[c + 1] += 1;
            start[r + 1] += 1;
        }
        for i in 0..n {
            start[i + 1] += start[i];
        }
        let mut at = start.clone();
        let mut ends = vec![0; start[n] as usize];
        for (c, r) in pairs() {
            for (a, b) in [(c, r), (r, c)] {
                ends[at[a] as usize] = number(b);
                at[a] += 1;
            }
        }
        Self { start, edge_weights: vec![1; ends.len()], ends, weight: vec![1; n] }
    }

    /// Number of vertices.
    pub fn len(&self) -> usize {
        self.weight.len()
    }

    /// Weight of all vertices.
    pub fn total(&self) -> u32 {
        self.weight.iter().sum()
    }

    fn range(&self, v: u32) -> std::ops::Range<usize> {
        self.start[v as usize] as usize..self.start[v as usize + 1] as usize
    }

    /// Neighbours of a vertex.
    #[inline]
    pub fn around(&self, v: u32) -> &[u32] {
        &self.ends[self.range(v)]
    }

    /// Neighbours of a vertex with the weights of the edges to them.
    fn weighted_edges(&self, v: u32) -> impl Iterator<Item = (u32, u32)> + '_ {
        let range = self.range(v);
        self.ends[range.clone()].iter().copied().zip(self.edge_weights[range].iter().copied())
    }

    /// The vertices that `v` reaches, the nearest first; they are marked in `seen`.
    pub fn reached_from(&self, v: u32, seen: &mut [bool]) -> Vec<u32> {
        let mut front = vec![v];
        seen[v as usize] = true;
        let mut next = 0;
        while let Some(v) = front.get(next).copied() {
            next += 1;
            for w in self.around(v) {
                if !std::mem::replace(&mut seen[*w as usize], true) {
                    front.push(*w);
                }
            }
        }
        front
    }

    /// The graph of some of the vertices alone, numbered as they are listed.
    pub fn of(&self, some: &[u32]) -> Self {
        let mut name = vec![NONE; self.len()];
        (0u32..).zip(some).for_each(|(k, v)| name[*v as usize] = k);
        let mut graph = Self { start: vec![0], ..Self::default() };
        for v in some {
            for (w, bond) in self.weighted_edges(*v).filter(|(w, _)| name[*w as usize] != NONE) {
                graph.ends.push(name[w as usize]);
                graph.edge_weights.push(bond);
            }
            graph.start.push(number(graph.ends.len()));
            graph.weight.push(self.weight[*v as usize]);
        }
        graph
    }

    /// The graph with neighbours joined in pairs along the heaviest edges, and the joint vertex of each vertex.
    ///
    /// No vertex becomes heavier than `most`. Vertices with as many neighbours come in an order that depends on `way`.
    pub fn coarsened(&self, most: u32, way: u32) -> (Self, Vec<u32>) {
        let mut joint = vec![NONE; self.len()];
        let mut pairs: Vec<[u32; 2]> = Vec::new();
        let mut queue: Vec<u32> = (0..number(self.len())).collect();
        queue.sort_by_key(|v| (self.around(*v).len(), (v + 7919 * way).wrapping_mul(2_654_435_761)));
        for v in queue {
            if joint[v as usize] != NONE {
                continue;
            }
            let own = self.weight[v as usize];
            let weight = |w: u32| self.weight[w as usize];
            let free = self.weighted_edges(v).filter(|(w, _)| joint[*w as usize] == NONE && own + weight(*w) <= most);
            let mate = free.max_by_key(|(w, bond)| (*bond, Reverse((weight(*w), *w)))).map_or(v, |(w, _)| w);
            joint[v as usize] = number(pairs.len());
            joint[mate as usize] = number(pairs.len());
            pairs.push([v, mate]);
        }
        (self.by_pairs(&pairs, &joint), joint)
    }

    /// The graph whose vertices are these pairs.
    fn by_pairs(&self, pairs: &[[u32; 2]], joint: &[u32]) -> Self {
        let mut graph = Self { start: vec![0], ..Self::default() };
        let mut place = vec![NONE; pairs.len()];
        for (own, [v, mate]) in (0u32..).zip(pairs) {
            let first = graph.ends.len();
            let both = if v == mate { &[*v][..] } else { &[*v, *mate] };
            for (w, bond) in both.iter().flat_map(|v| self.weighted_edges(*v)) {
                let to = joint[w as usize];
                let at = place[to as usize];
                if to == own {
                    continue;
                }
                if at != NONE && at as usize >= first {
                    graph.edge_weights[at as usize] += bond;
                } else {
                    place[to as usize] = number(graph.ends.len());
                    graph.ends.push(to);
                    graph.edge_weights.push(bond);
                }
            }
            graph.start.push(number(graph.ends.len()));
            graph.weight.push(both.iter().map(|v| self.weight[*v as usize]).sum());
        }
        graph
    }
}

/// A count in 32 bits; unknowns and couplings never exceed them.
pub(crate) fn number(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(NONE)
}
