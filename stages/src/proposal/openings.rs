//! The openings of sewn cloth: free atoms in their order around each.

use super::assignment::Assignment;
use super::atoms::Layout;

/// Stretches that are sewn to each other as a whole.
#[derive(Clone, Debug, PartialEq)]
pub struct Closing {
    /// Atoms of one side, walked forward.
    pub a: Vec<usize>,
    /// Atoms of the other side, walked backward, in the order in which they meet side a.
    pub b: Vec<usize>,
    /// Length of the first atom of side a that is sewn last, metres.
    pub lead: f64,
    /// Likelihood that it is right, 0 to 1.
    pub confidence: f64,
}

impl Closing {
    /// Is an atom on one of its sides?
    pub fn has(&self, atom: usize) -> bool {
        self.a.contains(&atom) || self.b.contains(&atom)
    }
}

/// Cloth that is sewn by an assignment.
#[derive(Clone, Copy)]
pub struct Sewn<'a> {
    /// The outlines.
    pub layout: &'a Layout,
    /// The partners.
    pub of: &'a Assignment,
    /// Stretches that are sewn beside those.
    pub closed: &'a [Closing],
}

impl Sewn<'_> {
    /// The piece of an atom.
    pub fn piece(&self, atom: usize) -> usize {
        self.layout.panels[self.layout.atoms[atom].panel].piece
    }

    /// Length of several atoms together, metres.
    pub fn length(&self, atoms: &[usize]) -> f64 {
        atoms.iter().map(|a| self.layout.atoms[*a].length).sum()
    }

    /// The free atom after another one along the edge of the sewn cloth. `None` at a piece that lies turned over.
    fn after(&self, atom: usize) -> Option<usize> {
        let mut next = self.layout.atoms[atom].next;
        for _ in 0..self.layout.atoms.len() {
            let Some(partner) = self.of.partner(next).or_else(|| self.across_closing(next)) else {
                return (!self.is_closed(next)).then_some(next);
            };
            if self.of.partner(next).is_some() && !self.of.is_opposite(next) {
                return None;
            }
            next = self.layout.atoms[partner].next;
        }
        None
    }

    /// The atom whose end meets the start of an atom where a closing begins or ends.
    fn across_closing(&self, atom: usize) -> Option<usize> {
        self.closed.iter().find_map(|c| {
            let is_first = c.a.first() == Some(&atom);
            let is_last = c.b.last() == Some(&atom);
            if is_first { c.b.first() } else { c.a.last().filter(|_| is_last) }.copied()
        })
    }

    fn is_closed(&self, atom: usize) -> bool {
        self.closed.iter().any(|c| c.has(atom))
    }

    /// All openings.
    pub fn openings(&self) -> Vec<Vec<usize>> {
        let mut seen = vec![false; self.layout.atoms.len()];
        let mut out = Vec::new();
        for first in 0..seen.len() {
            if seen[first] || self.of.partner(first).is_some() || self.is_closed(first) {
                continue;
            }
            let (mut opening, mut here) = (Vec::new(), Some(first));
            while let Some(atom) = here.filter(|a| !seen[*a]) {
                seen[atom] = true;
                opening.push(atom);
                here = self.after(atom);
            }
            if here == Some(first) {
                out.push(opening);
            }
        }
        out
    }
}
