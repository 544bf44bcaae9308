//! How many edges every stretch gets: one count for all that are sewn to one another.

use super::curve::CurveKind;
use super::net::Net;

/// No edge turns by more than this over its length (60°).
const MAX_TURN: f64 = std::f64::consts::FRAC_PI_3;

/// Counts by piece, curve, stretch.
#[derive(Clone, Debug, PartialEq)]
pub struct Counts {
    group: Vec<Vec<Vec<usize>>>,
    count: Vec<usize>,
}

impl Counts {
    /// Edges of a stretch.
    pub fn of(&self, at: (usize, usize), stretch: usize) -> usize {
        self.count[self.group[at.0][at.1][stretch]]
    }

    /// Doubles the count of a stretch and of all it is sewn to.
    pub fn double(&mut self, at: (usize, usize), stretch: usize) {
        let g = self.group[at.0][at.1][stretch];
        self.count[g] = self.count[g].saturating_mul(2);
    }

    /// Group of a stretch, to double each once.
    pub fn group(&self, at: (usize, usize), stretch: usize) -> usize {
        self.group[at.0][at.1][stretch]
    }

    /// Edges in all.
    pub fn total(&self) -> usize {
        self.group.iter().flatten().flatten().map(|g| self.count[*g]).sum()
    }
}

/// Counts for an edge length.
pub fn counts(net: &Net, h: f64) -> Counts {
    let mut group = Vec::new();
    let mut n = 0;
    for piece in &net.curves {
        let mut curves = Vec::new();
        for c in piece {
            curves.push((n..n + c.stretches()).collect::<Vec<_>>());
            n += c.stretches();
        }
        group.push(curves);
    }
    let mut parent: Vec<usize> = (0..n).collect();
    for link in &net.links {
        for [(a, i), (b, k)] in link.pairs(&net.curves) {
            let (x, y) = (root(&mut parent, group[a.0][a.1][i]), root(&mut parent, group[b.0][b.1][k]));
            let (low, high) = (x.min(y), x.max(y));
            parent[high] = low;
        }
    }
    for g in group.iter_mut().flatten().flatten() {
        *g = root(&mut parent, *g);
    }
    let mut count = vec![1; n];
    for (p, piece) in net.curves.iter().enumerate() {
        for (k, c) in piece.iter().enumerate() {
            for s in 0..c.stretches() {
                let g = group[p][k][s];
                count[g] = count[g].max(wanted(c, s, h));
            }
        }
    }
    Counts { group, count }
}

/// What one stretch asks for.
fn wanted(c: &super::curve::Curve, s: usize, h: f64) -> usize {
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

fn root(parent: &mut [usize], mut i: usize) -> usize {
    while parent[i] != i {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    i
}
