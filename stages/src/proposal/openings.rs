//! Openings that are closed by one piece: a sleeve closes an armhole, a collar a neckline, a cuff the end of a sleeve.
//!
//! The search sews stretches between marks to each other, one to one. Where one side lacks a mark, or a band goes all
//! round an opening, its stretches stay open. The names then tell what is set on where, and the surface tells the rest:
//! both sides of such a seam lie on one opening, or the band is as long as the opening.

use super::assignment::Assignment;
use super::atoms::{Layout, Panel};
use super::propose::Names;
use super::tuning::OpeningWeights;

/// Stretches that are sewn to each other as a whole.
#[derive(Clone, Debug, PartialEq)]
pub struct Closing {
    /// Atoms of one side, walked forward.
    pub a: Vec<usize>,
    /// Atoms of the other side, walked backward, in the order in which they meet side a.
    pub b: Vec<usize>,
}

/// The closings of a garment whose other seams are found, and those other seams.
///
/// A band that was sewn on in parts is sewn on as a whole. Pieces with atoms that a person sewed (`is_given`) stay as
/// they are.
pub fn closings(
    layout: &Layout,
    of: &Assignment,
    names: &dyn Names,
    is_given: impl Fn(usize) -> bool,
) -> (Vec<Closing>, Assignment) {
    let mut of = of.clone();
    let mut found: Vec<Closing> = Vec::new();
    for panel in layout.panels.iter().filter(|p| !p.atoms.clone().any(&is_given)) {
        let without = of.without(panel.atoms.clone());
        let search = Openings { layout, of: &without, names, weights: OpeningWeights::default() };
        let around = search.closed_by_band(panel, &of, &found);
        if !around.is_empty() {
            of = without;
        }
        found.extend(around);
    }
    let is_used = |o: &[usize]| o.iter().any(|a| found.iter().any(|c| c.has(*a)));
    let search = Openings { layout, of: &of, names, weights: OpeningWeights::default() };
    let openings = search.openings();
    let two_sided: Vec<Closing> =
        openings.iter().filter(|o| !is_used(o)).filter_map(|o| search.closed_by_sides(o)).collect();
    found.extend(two_sided);
    (found, of)
}

impl Closing {
    /// Is an atom on one of its sides?
    pub fn has(&self, atom: usize) -> bool {
        self.a.contains(&atom) || self.b.contains(&atom)
    }
}

struct Openings<'a> {
    layout: &'a Layout,
    of: &'a Assignment,
    names: &'a dyn Names,
    weights: OpeningWeights,
}

impl Openings<'_> {
    fn is_free(&self, atom: usize) -> bool {
        self.of.partner(atom).is_none()
    }

    fn piece(&self, atom: usize) -> usize {
        self.layout.panels[self.layout.atoms[atom].panel].piece
    }

    fn length(&self, atoms: &[usize]) -> f64 {
        atoms.iter().map(|a| self.layout.atoms[*a].length).sum()
    }

    /// The free atom after another one along the edge of the sewn cloth. `None` at a piece that lies turned over.
    fn after(&self, atom: usize) -> Option<usize> {
        let mut next = self.layout.atoms[atom].next;
        for _ in 0..self.layout.atoms.len() {
            let Some(partner) = self.of.partner(next) else { return Some(next) };
            if !self.of.is_opposite(next) {
                return None;
            }
            next = self.layout.atoms[partner].next;
        }
        None
    }

    /// All openings: free atoms in their order around each.
    fn openings(&self) -> Vec<Vec<usize>> {
        let mut seen = vec![false; self.layout.atoms.len()];
        let mut out = Vec::new();
        for first in (0..seen.len()).filter(|a| self.is_free(*a)) {
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

    /// An opening of two sides, one on pieces that are set on the other.
    fn closed_by_sides(&self, opening: &[usize]) -> Option<Closing> {
        let is_set_on = |a: usize| opening.iter().any(|b| self.names.is_set_on(self.piece(a), self.piece(*b)));
        let set_on: Vec<bool> = opening.iter().map(|a| is_set_on(*a)).collect();
        let n = opening.len();
        let starts: Vec<usize> = (0..n).filter(|k| set_on[*k] && !set_on[(*k + n - 1) % n]).collect();
        let [start] = starts[..] else { return None };
        let turned: Vec<(usize, bool)> = (0..n).map(|k| (opening[(start + k) % n], set_on[(start + k) % n])).collect();
        let side = |which: bool| turned.iter().filter(|(_, s)| *s == which).map(|(a, _)| *a).collect::<Vec<_>>();
        let (mut on, base) = (side(true), side(false));
        let fits = self.weights.set_on_ratio.contains(&(self.length(&on) / self.length(&base)));
        on.reverse();
        fits.then_some(Closing { a: base, b: on })
    }

    /// Sews a band around an opening, and its ends to each other. A band of which a long side is sewn on by the partners
    /// `before`, and fits, is left as it is. Openings of `closed` are taken already.
    fn closed_by_band(&self, panel: &Panel, before: &Assignment, closed: &[Closing]) -> Vec<Closing> {
        let Some([first, end, long, other_end]) = self.sides_of_band(panel) else { return Vec::new() };
        if [&first, &long].iter().any(|side| self.is_sewn_whole(side, before)) {
            return Vec::new();
        }
        let piece = panel.piece;
        let edge = if self.is_low(&long) && !self.is_low(&first) { long } else { first };
        let off = |opening: &[usize]| (self.length(&edge) / self.length(opening) - self.weights.band_usual).abs();
        let is_place = |o: &[usize]| o.iter().all(|a| self.names.is_set_on(piece, self.piece(*a)));
        let is_open = |a: &usize| !self.layout.atoms[*a].is_low() && !closed.iter().any(|c| c.has(*a));
        let openings = self.openings();
        let places = openings.iter().map(Vec::as_slice).filter(|o| is_place(o) && o.iter().all(is_open));
        let best = places.min_by(|p, q| off(p).total_cmp(&off(q))).filter(|o| off(o) < self.weights.band_spread);
        let Some(opening) = best else { return Vec::new() };
        // The ends of the band meet where two pieces of the opening do.
        let n = opening.len();
        let start = (0..n).find(|k| self.piece(opening[*k]) != self.piece(opening[(*k + n - 1) % n])).unwrap_or(0);
        let around: Vec<usize> = (0..n).map(|k| opening[(start + k) % n]).collect();
        let backward = |atoms: Vec<usize>| atoms.into_iter().rev().collect::<Vec<usize>>();
        vec![Closing { a: around, b: backward(edge) }, Closing { a: end, b: backward(other_end) }]
    }

    /// Is a side sewn to stretches as long as itself?
    fn is_sewn_whole(&self, side: &[usize], by: &Assignment) -> bool {
        let partners: Option<Vec<usize>> = side.iter().map(|a| by.partner(*a)).collect();
        let ratio = partners.map(|p| self.length(&p) / self.length(side));
        ratio.is_some_and(|r| libm::log(r).abs() < self.weights.band_ends)
    }

    fn is_low(&self, atoms: &[usize]) -> bool {
        let low: f64 = atoms.iter().filter(|a| self.layout.atoms[**a].is_low()).map(|a| self.length(&[*a])).sum();
        2.0 * low > self.length(atoms)
    }

    /// The sides of a panel with four corners, of which two are long and two short: long, short, long, short.
    fn sides_of_band(&self, panel: &Panel) -> Option<[Vec<usize>; 4]> {
        let atoms: Vec<usize> = panel.atoms.clone().collect();
        let is_corner = |a: &usize| self.layout.atoms[*a].joint.angle < self.weights.corner_most;
        let n = atoms.len();
        let first = (0..n).find(|k| is_corner(&atoms[*k]))?;
        let mut sides: Vec<Vec<usize>> = Vec::new();
        for atom in (0..n).map(|k| atoms[(first + k) % n]) {
            match sides.last_mut() {
                Some(side) if !is_corner(&atom) => side.push(atom),
                _ => sides.push(vec![atom]),
            }
        }
        let [mut a, mut b, mut c, mut d]: [Vec<usize>; 4] = sides.try_into().ok()?;
        if self.length(&a) < self.length(&b) {
            (a, b, c, d) = (b, c, d, a);
        }
        let short = self.length(&b).max(self.length(&d));
        let is_even = libm::log(self.length(&b) / self.length(&d)).abs() < self.weights.band_ends;
        (is_even && self.length(&a).min(self.length(&c)) > self.weights.band_least * short).then_some([a, b, c, d])
    }
}
