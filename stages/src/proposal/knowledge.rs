//! Scores of pairs that do not come from shapes: from names, from a person's decisions, and from the order of sewing.

use super::atoms::Layout;
use super::hems::Hems;
use super::known::Decisions;
use super::legs::Legs;
use super::pairs::{Pair, Prior};
use super::propose::Names;
use super::tuning::{self, SleeveWeights};

/// How a search takes the sleeves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sleeves {
    /// They are sewn like all other pieces.
    WithTrunk,
    /// Each is one piece, and is sewn later.
    Single,
    /// Each has several pieces, which are sewn to each other. It is sewn to the trunk later.
    Halves,
}

/// Knowledge beside the shapes: names, and decisions of a person.
pub struct Knowledge<'a> {
    /// Names.
    pub names: &'a dyn Names,
    /// Decisions of a person.
    pub decisions: Decisions,
    /// Where legs may meet.
    pub legs: Legs,
    /// Edges that bands go around later.
    pub hems: Hems,
    /// How the sleeves are sewn.
    pub how: Sleeves,
    /// Pieces that are sewn later.
    pub later: &'a [usize],
    /// Weights for both.
    pub sleeve: SleeveWeights,
}

impl Knowledge<'_> {
    /// Is the seam of a pair found later: that of a band, of a sleeve to the trunk, or of a sleeve of one piece to itself?
    fn is_later(&self, layout: &Layout, pair: Pair) -> bool {
        let [p, q] = [pair.a, pair.b].map(|a| layout.panels[layout.atoms[a].panel].piece);
        let is_set_in = |p: usize, q: usize| self.names.is_sleeve(p) && self.names.is_off_arm(q);
        let are_sleeves = self.names.is_sleeve(p) && self.names.is_sleeve(q);
        let is_open = [pair.a, pair.b].iter().any(|a| self.hems.has(*a));
        if is_open || self.later.contains(&p) || self.later.contains(&q) {
            return true;
        }
        match self.how {
            Sleeves::WithTrunk => false,
            Sleeves::Single => is_set_in(p, q) || is_set_in(q, p) || are_sleeves,
            Sleeves::Halves => is_set_in(p, q) || is_set_in(q, p),
        }
    }
}

impl Prior for Knowledge<'_> {
    fn score(&self, layout: &Layout, pair: Pair, images: bool) -> f64 {
        let (a, b) = (&layout.atoms[pair.a], &layout.atoms[pair.b]);
        let piece = |panel: usize| layout.panels[panel].piece;
        let mut sum = self.names.seam(piece(a.panel), piece(b.panel), images, a.length.min(b.length));
        for (x, y) in [(a, b), (b, a)] {
            sum += if y.is_low() { self.names.to_lower_edge(piece(x.panel)) } else { 0.0 };
        }
        let is_set_on = self.names.is_set_on(piece(a.panel), piece(b.panel))
            || self.names.is_set_on(piece(b.panel), piece(a.panel));
        let gather = libm::log(a.length / b.length).abs();
        let is_unlikely = gather > tuning::SET_ON_GATHER || a.length.min(b.length) < tuning::SET_ON_LEAST;
        sum += if is_set_on && is_unlikely { tuning::TOO_GATHERED } else { 0.0 };
        sum += self.legs.score(layout, self.names, pair, images);
        sum += if self.is_later(layout, pair) { self.sleeve.apart } else { 0.0 };
        sum + self.decisions.score(pair)
    }
}
