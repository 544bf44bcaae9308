//! A person's earlier decisions: seams that are given, and pieces whose open edges stay open.

use super::atoms::{Atom, Layout};
use super::pairs::Pair;
use super::seams::ProposedSeam;
use super::tuning::DecisionWeights;
use crate::roles::PiecePoint;
use crate::sewing::ring::{arcs, nearest_on};

/// Decisions of a person, as points that meet.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Known {
    /// Points that are sewn to each other.
    pub given: Vec<[PiecePoint; 2]>,
    /// The seams that sew them, as a person wrote them.
    pub written: Vec<ProposedSeam>,
    /// Pieces that a person decided on, by number. No seam between two of them is new.
    pub decided: Vec<usize>,
}

/// Decisions, for the atoms of one layout.
pub struct Decisions {
    given: Vec<Vec<Option<usize>>>,
    is_decided: Vec<bool>,
    weights: DecisionWeights,
}

impl Decisions {
    /// For one layout.
    pub fn new(layout: &Layout, known: &Known) -> Self {
        let is_decided = layout.atoms.iter().map(|a| known.decided.contains(&layout.panels[a.panel].piece)).collect();
        Self { given: met(layout, &known.given), is_decided, weights: DecisionWeights::default() }
    }

    /// Is a part of an atom sewn already?
    pub fn is_given(&self, atom: usize) -> bool {
        !self.given[atom].is_empty()
    }

    /// Are all these atoms on pieces that a person decided on?
    pub fn are_decided<'a>(&self, mut atoms: impl Iterator<Item = &'a usize>) -> bool {
        atoms.all(|a| self.is_decided[*a])
    }

    /// Added to the score of a pair.
    pub fn score(&self, pair: Pair) -> f64 {
        let points = || self.given[pair.a].iter().map(|b| *b == Some(pair.b));
        let more = self.given[pair.b].iter().filter(|a| **a != Some(pair.a)).count();
        let (given, all) = (points().filter(|m| *m).count(), points().count() + more);
        match all {
            0 if self.are_decided([pair.a, pair.b].iter()) => self.weights.against,
            0 => 0.0,
            n if 2 * given > n => self.weights.given,
            _ => self.weights.against,
        }
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
