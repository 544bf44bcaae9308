//! How every stretch is cut into edges: alike for all that are sewn to one another.
//!
//! The stretches of a seam group share one list of cuts, as shares of their length. It is even, but for ends beside
//! something short: there the edges grow from its size, or the triangles between would be needles.

use super::curve::{Curve, CurveKind};
use super::net::{Net, Stretch};

/// No edge turns by more than this over its length (60°).
const MAX_TURN: f64 = std::f64::consts::FRAC_PI_3;
/// An edge may be this much longer than its neighbour …
const RATIO: f64 = 1.6;
/// … and grows by this share of the way from it.
const GROWTH: f64 = 0.5;

/// Cuts by piece, curve, stretch.
#[derive(Clone, Debug, PartialEq)]
pub struct Counts {
    /// Group of every stretch, and whether it runs against the group's sense.
    group: Vec<Vec<Vec<(usize, bool)>>>,
    /// Per group: where its edges start, from 0, as shares of the length.
    cuts: Vec<Vec<f64>>,
}

impl Counts {
    /// Where the edges of a stretch start, from 0, as shares of its length.
    pub fn cuts(&self, at: (usize, usize), stretch: usize) -> Vec<f64> {
        let (g, against) = self.group[at.0][at.1][stretch];
        let cuts = &self.cuts[g];
        if against {
            std::iter::once(0.0).chain(cuts[1..].iter().rev().map(|t| 1.0 - t)).collect()
        } else {
            cuts.clone()
        }
    }

    /// Halves the edges of a stretch and of all it is sewn to.
    pub fn halve(&mut self, at: (usize, usize), stretch: usize) {
        let (g, _) = self.group[at.0][at.1][stretch];
        let ends: Vec<f64> = self.cuts[g].iter().copied().skip(1).chain([1.0]).collect();
        self.cuts[g] = self.cuts[g].iter().zip(ends).flat_map(|(a, b)| [*a, 0.5 * (a + b)]).collect();
    }

    /// Group of a stretch, to halve each once.
    pub fn group(&self, at: (usize, usize), stretch: usize) -> usize {
        self.group[at.0][at.1][stretch].0
    }

    /// Edges in all.
    pub fn total(&self) -> usize {
        self.group.iter().flatten().flatten().map(|(g, _)| self.cuts[*g].len()).sum()
    }
}

/// Groups of stretches with the sense in which each runs.
struct Groups {
    parent: Vec<usize>,
    against: Vec<bool>,
    /// Groups that contain a stretch in both senses.
    both: Vec<bool>,
}

impl Groups {
    fn new(n: usize) -> Self {
        Self { parent: (0..n).collect(), against: vec![false; n], both: vec![false; n] }
    }

    fn root(&self, mut i: usize) -> (usize, bool) {
        let mut against = false;
        while self.parent[i] != i {
            against ^= self.against[i];
            i = self.parent[i];
        }
        (i, against)
    }

    fn join(&mut self, a: usize, b: usize, same: bool) {
        let ((x, fx), (y, fy)) = (self.root(a), self.root(b));
        let against = fx ^ fy ^ !same;
        if x == y {
            self.both[x] |= against;
            return;
        }
        let (low, high) = (x.min(y), x.max(y));
        self.parent[high] = low;
        self.against[high] = against;
        self.both[low] |= self.both[high];
    }
}

/// Cuts for an edge length.
pub fn counts(net: &Net, h: f64) -> Counts {
    let (ids, n) = number(net);
    let id = |((p, k), s): Stretch| ids[p][k] + s;
    let mut groups = Groups::new(n);
    for link in &net.links {
        for ([a, b], same) in link.pairs(&net.curves) {
            groups.join(id(a), id(b), same);
        }
    }
    let group: Vec<Vec<Vec<(usize, bool)>>> = net
        .curves
        .iter()
        .enumerate()
        .map(|(p, piece)| {
            let of = |k: usize, c: &Curve| (0..c.stretches()).map(|s| groups.root(ids[p][k] + s)).collect();
            piece.iter().enumerate().map(|(k, c)| of(k, c)).collect()
        })
        .collect();
    let mut count = vec![1_usize; n];
    each(net, |(p, k), s, c| {
        let (g, _) = group[p][k][s];
        count[g] = count[g].max(wanted(c, s, h));
    });
    let ends = short_ends(net, &group, &count, &groups.both);
    let cuts = count.iter().zip(&ends).map(|(n, e)| graded(*n, *e)).collect();
    Counts { group, cuts }
}

/// First number of every curve's stretches, and how many there are.
fn number(net: &Net) -> (Vec<Vec<usize>>, usize) {
    let mut n = 0;
    let mut first = |c: &Curve| {
        let at = n;
        n += c.stretches();
        at
    };
    let ids = net.curves.iter().map(|piece| piece.iter().map(&mut first).collect()).collect();
    (ids, n)
}

fn each(net: &Net, mut act: impl FnMut((usize, usize), usize, &Curve)) {
    for (p, piece) in net.curves.iter().enumerate() {
        for (k, c) in piece.iter().enumerate() {
            for s in 0..c.stretches() {
                act((p, k), s, c);
            }
        }
    }
}

/// The request of one stretch.
fn wanted(c: &Curve, s: usize, h: f64) -> usize {
    let (_, length) = c.stretch(s);
    let by_length = (length / h).round().max(1.0);
    // Round corners need more, but never steps under a quarter of h.
    let by_turn = (c.turning(s) / MAX_TURN).ceil().min((4.0 * length / h).floor());
    let few = match (c.kind, c.stretches()) {
        (CurveKind::FishEye(_), _) => 2.0,
        (_, 1) if c.closed => 3.0,
        (_, 2) if c.closed => 2.0,
        _ => 1.0,
    };
    by_length.max(by_turn).max(few) as usize
}

/// Largest edge at both ends of every group beside short neighbours, as a share of the length.
fn short_ends(net: &Net, group: &[Vec<Vec<(usize, bool)>>], count: &[usize], both: &[bool]) -> Vec<[f64; 2]> {
    let mut out = vec![[f64::INFINITY; 2]; count.len()];
    each(net, |(p, k), s, c| {
        let n = c.stretches();
        let (g, against) = group[p][k][s];
        let (_, length) = c.stretch(s);
        let step = |x: usize| c.stretch(x).1 / count[group[p][k][x].0] as f64;
        let before = (s > 0 || c.closed).then(|| step((s + n - 1) % n));
        let after = (s + 1 < n || c.closed).then(|| step((s + 1) % n));
        for (end, neighbour) in [before, after].into_iter().enumerate() {
            let Some(limit) = neighbour.map(|x| RATIO * x / length) else { continue };
            let side = end ^ usize::from(against);
            out[g][side] = out[g][side].min(limit);
            if both[g] {
                out[g][1 - side] = out[g][1 - side].min(limit);
            }
        }
    });
    out
}

/// Shares at which edges start: even, or growing from short ends.
fn graded(n: usize, ends: [f64; 2]) -> Vec<f64> {
    let even = 1.0 / n as f64;
    if ends.iter().all(|e| *e >= even) {
        return (0..n).map(|j| j as f64 / n as f64).collect();
    }
    let size = |x: f64| even.min(ends[0] + GROWTH * x).min(ends[1] + GROWTH * (1.0 - x)).max(even / 64.0);
    let samples = 64 * n.min(100_000);
    let dx = 1.0 / samples as f64;
    let mut sum = vec![0.0; samples + 1];
    for i in 0..samples {
        sum[i + 1] = sum[i] + dx / size((i as f64 + 0.5) * dx);
    }
    let m = (sum[samples].round() as usize).max(n);
    let mut at = 0;
    (0..m)
        .map(|j| {
            let goal = sum[samples] * j as f64 / m as f64;
            while at + 1 < samples && sum[at + 1] <= goal {
                at += 1;
            }
            let within = (goal - sum[at]) / (sum[at + 1] - sum[at]);
            if j == 0 { 0.0 } else { (at as f64 + within.clamp(0.0, 1.0)) * dx }
        })
        .collect()
}
