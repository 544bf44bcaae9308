//! What a person decided before: seams that are given, and seams that were proposed and taken out.

use super::atoms::{Atom, Layout};
use super::pairs::Pair;
use super::tuning::DecisionWeights;
use crate::roles::PiecePoint;
use crate::sewing::ring::{arcs, nearest_on};

/// Decisions of a person, as points that meet.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Known {
    /// Points that are sewn to each other.
    pub given: Vec<[PiecePoint; 2]>,
    /// Points that a proposal sewed to each other, and a person does not.
    pub declined: Vec<[PiecePoint; 2]>,
}

/// Decisions, for the atoms of one layout.
pub struct Decisions {
    given: Vec<Vec<Option<usize>>>,
    declined: Vec<Vec<Option<usize>>>,
    weights: DecisionWeights,
}

impl Decisions {
    /// For one layout.
    pub fn new(layout: &Layout, known: &Known) -> Self {
        let met = |pairs: &[[PiecePoint; 2]]| met(layout, pairs);
        Self { given: met(&known.given), declined: met(&known.declined), weights: DecisionWeights::default() }
    }

    /// Is a part of an atom sewn already?
    pub fn is_given(&self, atom: usize) -> bool {
        !self.given[atom].is_empty()
    }

    /// Does a person leave an atom open, whose proposed seam he or she took out?
    pub fn is_left_open(&self, atom: usize) -> bool {
        !self.declined[atom].is_empty() && !self.is_given(atom)
    }

    /// Added to the score of a pair.
    pub fn score(&self, pair: Pair) -> f64 {
        let points = || self.given[pair.a].iter().map(|b| *b == Some(pair.b));
        let more = self.given[pair.b].iter().filter(|a| **a != Some(pair.a)).count();
        let (given, all) = (points().filter(|m| *m).count(), points().count() + more);
        let sewn = match all {
            0 => 0.0,
            n if 2 * given > n => self.weights.given,
            _ => self.weights.against,
        };
        let is_left_open = self.is_left_open(pair.a) || self.is_left_open(pair.b);
        sewn + if is_left_open { self.weights.against } else { 0.0 }
    }
}

/// For every atom, the atoms that its points meet.
fn met(layout: &Layout, pairs: &[[PiecePoint; 2]]) -> Vec<Vec<Option<usize>>> {
    let mut out = vec![Vec::new(); layout.atoms.len()];
    for pair in pairs {
        let [a, b] = pair.map(|p| (0..layout.atoms.len()).find(|a| holds(layout, &layout.atoms[*a], p)));
        for (here, there) in [(a, b), (b, a)] {
            if let Some(here) = here {
                out[here].push(there);
            }
        }
    }
    out
}

/// Does an atom hold a point between its ends?
fn holds(layout: &Layout, atom: &Atom, point: PiecePoint) -> bool {
    if layout.panels[atom.panel].piece != point.piece {
        return false;
    }
    let (way, off) = nearest_on(&atom.points, &arcs(&atom.points, false), false, point.at);
    let reach = DecisionWeights::REACH;
    off < reach && way > reach && way < atom.length - reach
}

/// Do two lists of points that meet tell the same seam? Most points of the first lie on the second.
#[must_use]
pub fn tell_the_same(of: &[[PiecePoint; 2]], others: &[[PiecePoint; 2]]) -> bool {
    let near = |p: PiecePoint, q: PiecePoint| p.piece == q.piece && (p.at - q.at).norm() < DecisionWeights::SAME_STITCH;
    let is_known = |[p, q]: &&[PiecePoint; 2]| {
        others.iter().any(|[r, s]| near(*p, *r) && near(*q, *s) || near(*p, *s) && near(*q, *r))
    };
    2 * of.iter().filter(is_known).count() > of.len()
}
