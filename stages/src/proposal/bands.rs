//! Bands that close an opening: a collar a neckline, a cuff the end of a sleeve.
//!
//! The search sews stretches between marks to each other, one to one. Where a band goes all round an opening without
//! marks, its stretches stay open. The names then tell what is set on where. The opening that the band fits is taken.

use super::assignment::Assignment;
use super::atoms::{Layout, Panel};
use super::openings::{Closing, Sewn};
use super::propose::Names;
use super::tuning::BandWeights;

/// The closings by bands, beside those of `closed`, and the seams that are left. A band that was sewn on in parts is
/// sewn on as a whole. Pieces with atoms that a person sewed (`is_given`) stay as they are.
pub fn bands(
    layout: &Layout,
    of: &Assignment,
    names: &dyn Names,
    is_given: impl Fn(usize) -> bool,
    closed: &[Closing],
) -> (Vec<Closing>, Assignment) {
    let mut of = of.clone();
    let mut found = closed.to_vec();
    let is_band = |p: &&Panel| !names.is_sleeve(p.piece) && !p.atoms.clone().any(&is_given);
    for panel in layout.panels.iter().filter(is_band) {
        let without = of.without(panel.atoms.clone());
        let sewn = Sewn { layout, of: &without, closed: &found };
        let around = Bands { sewn, names, weights: BandWeights::default() }.closed_by(panel, &of);
        if !around.is_empty() {
            of = without;
        }
        found.extend(around);
    }
    (found, of)
}

struct Bands<'a> {
    sewn: Sewn<'a>,
    names: &'a dyn Names,
    weights: BandWeights,
}

impl Bands<'_> {
    /// Sews a band around an opening, and its ends to each other. A band of which a long side is sewn on by the partners
    /// `before`, and fits, is left as it is.
    fn closed_by(&self, panel: &Panel, before: &Assignment) -> Vec<Closing> {
        let Some([first, end, long, other_end]) = self.sides_of_band(panel) else { return Vec::new() };
        let piece = panel.piece;
        // Cloth is often gathered to a waistband.
        let any_ease = self.names.is_waistband(piece);
        if [&first, &long].iter().any(|side| self.is_sewn_whole(side, before, any_ease)) {
            return Vec::new();
        }
        let edge = if self.is_low(&long) && !self.is_low(&first) { long } else { first };
        let off =
            |opening: &[usize]| (self.sewn.length(&edge) / self.sewn.length(opening) - self.weights.band_usual).abs();
        // The tops of raglan sleeves are a part of the neckline.
        let is_around = |a: &usize| self.names.goes_around(piece, self.sewn.piece(*a));
        let is_place = |o: &[usize]| {
            o.iter().any(is_around) && o.iter().all(|a| is_around(a) || self.names.is_sleeve(self.sewn.piece(*a)))
        };
        let is_open = |a: &usize| !self.sewn.layout.atoms[*a].is_low();
        let openings = self.sewn.openings();
        let is_single = !self.has_twin(panel);
        let is_one_of_pair = |o: &[usize]| self.is_one_of_pair(o, &openings);
        let places = openings.iter().map(Vec::as_slice).filter(|o| is_place(o) && o.iter().all(is_open));
        let places = places.filter(|o| !(is_single && is_one_of_pair(o)));
        let best = places.min_by(|p, q| off(p).total_cmp(&off(q))).filter(|o| off(o) < self.weights.band_spread);
        let Some(opening) = best else { return Vec::new() };
        let is_collar = !any_ease && self.sewn.length(&end) > self.weights.collar_height * self.sewn.length(&edge);
        let front = (any_ease || is_collar).then(|| self.front_middle(opening)).flatten();
        let (start, lead) = front.unwrap_or_else(|| (self.joint_of_pieces(opening), 0.0));
        let n = opening.len();
        let around: Vec<usize> = (0..n).map(|k| opening[(start + k) % n]).collect();
        let backward = |atoms: Vec<usize>| atoms.into_iter().rev().collect::<Vec<usize>>();
        let confidence = self.weights.confidence;
        let ring = Closing { a: around, b: backward(edge), lead, confidence };
        // A collar stands open in front.
        let ends = Closing { a: end, b: backward(other_end), lead: 0.0, confidence };
        if front.is_some() && is_collar { vec![ring] } else { vec![ring, ends] }
    }

    /// Is there another piece of the same shape? One of the two is sewn on the left, and one on the right.
    fn has_twin(&self, panel: &Panel) -> bool {
        let is_alike = |p: &Panel| {
            (p.perimeter - panel.perimeter).abs() < self.weights.twin
                && (p.slenderness / panel.slenderness - 1.0).abs() < self.weights.band_ends
        };
        self.sewn.layout.panels.iter().filter(|p| is_alike(p)).count() > 1
    }

    /// Is an opening one of a pair, such as two armholes? Another one, open or closed by a band, is as long.
    fn is_one_of_pair(&self, opening: &[usize], openings: &[Vec<usize>]) -> bool {
        let is_other =
            |o: &&[usize]| *o != opening && (self.sewn.length(o) - self.sewn.length(opening)).abs() < self.weights.twin;
        let rings = self.sewn.closed.iter().map(|c| c.a.as_slice());
        openings.iter().map(Vec::as_slice).chain(rings).any(|o| is_other(&o))
    }

    /// The first atom of an opening before which two pieces meet.
    fn joint_of_pieces(&self, opening: &[usize]) -> usize {
        let n = opening.len();
        let meet = |k: &usize| self.sewn.piece(opening[*k]) != self.sewn.piece(opening[(*k + n - 1) % n]);
        (0..n).find(meet).unwrap_or(0)
    }

    /// The middle of the front on a symmetric opening: an atom, and the length of it that lies before the middle.
    fn front_middle(&self, opening: &[usize]) -> Option<(usize, f64)> {
        let n = opening.len();
        let length = |k: usize| self.sewn.length(&opening[k..=k]);
        let total = self.sewn.length(opening);
        let starts: Vec<f64> = (0..n).map(|k| self.sewn.length(&opening[..k])).collect();
        let piece = |k: usize| self.sewn.piece(opening[k % n]);
        let joints: Vec<f64> = (0..n).filter(|k| piece(*k) != piece(k + n - 1)).map(|k| starts[k]).collect();
        let apart = |x: f64, y: f64| (x - y).rem_euclid(total).min((y - x).rem_euclid(total));
        let has_joint = |at: f64| joints.iter().any(|j| apart(*j, at) < self.weights.symmetric);
        let is_middle = |at: f64| joints.iter().all(|j| has_joint(2.0 * at - j));
        let is_front = |k: usize| self.names.faces_front(piece(k));
        let ends = (0..n).filter(|k| is_front(*k) && is_front(k + n - 1)).map(|k| (k, 0.0));
        let halves = (0..n).filter(|k| is_front(*k)).map(|k| (k, 0.5 * length(k)));
        ends.chain(halves).find(|(k, lead)| !joints.is_empty() && is_middle(starts[*k] + lead))
    }

    /// Is a side sewn all along, and to stretches as long as itself, or with any ease?
    fn is_sewn_whole(&self, side: &[usize], by: &Assignment, any_ease: bool) -> bool {
        let partners: Option<Vec<usize>> = side.iter().map(|a| by.partner(*a)).collect();
        let ratio = partners.map(|p| self.sewn.length(&p) / self.sewn.length(side));
        ratio.is_some_and(|r| any_ease || libm::log(r).abs() < self.weights.band_ends)
    }

    fn is_low(&self, atoms: &[usize]) -> bool {
        let low: f64 =
            atoms.iter().filter(|a| self.sewn.layout.atoms[**a].is_low()).map(|a| self.sewn.length(&[*a])).sum();
        2.0 * low > self.sewn.length(atoms)
    }

    /// The sides of a panel with four corners, of which two are long and two short: long, short, long, short.
    fn sides_of_band(&self, panel: &Panel) -> Option<[Vec<usize>; 4]> {
        let atoms: Vec<usize> = panel.atoms.clone().collect();
        let is_corner = |a: &usize| self.sewn.layout.atoms[*a].joint.angle < self.weights.corner_most;
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
        if self.sewn.length(&a) < self.sewn.length(&b) {
            (a, b, c, d) = (b, c, d, a);
        }
        let short = self.sewn.length(&b).max(self.sewn.length(&d));
        let is_even = libm::log(self.sewn.length(&b) / self.sewn.length(&d)).abs() < self.weights.band_ends;
        (is_even && self.sewn.length(&a).min(self.sewn.length(&c)) > self.weights.band_least * short)
            .then_some([a, b, c, d])
    }
}
