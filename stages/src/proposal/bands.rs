//! Bands that close an opening: a collar a neckline, a cuff the end of a sleeve.
//!
//! The search sews stretches between marks to each other, one to one. Where a band goes all round an opening without
//! marks, its stretches stay open. The names then tell what is set on where. The opening that the band fits is taken.

use super::assignment::Assignment;
use super::atoms::{Layout, Panel};
use super::openings::{Closing, Sewn};
use super::propose::{Names, Rim};
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
    let weights = BandWeights::default();
    let (mut bare, mut found) = (of.clone(), closed.to_vec());
    let is_free = |p: &&Panel| !names.is_sleeve(p.piece) && !p.atoms.clone().any(&is_given);
    let sewn = Bands { sewn: Sewn { layout, of, closed }, names, weights: weights.clone() };
    let astray: Vec<(&Panel, Band)> =
        layout.panels.iter().filter(is_free).filter_map(|p| Some((p, sewn.astray(p, of)?))).collect();
    // A band that is sewn to a wrong place bars the place of another one. So all of them are taken off first.
    astray.iter().for_each(|(panel, _)| bare = bare.without(panel.atoms.clone()));
    let mut left = Vec::new();
    for (panel, band) in &astray {
        let sewn = Sewn { layout, of: &bare, closed: &found };
        let around = Bands { sewn, names, weights: weights.clone() }.closed_by(panel, band);
        if around.is_empty() {
            left.push(panel);
        }
        found.extend(around);
    }
    for panel in left {
        bare.restore(of, panel.atoms.clone(), |a| found.iter().any(|c| c.has(a)));
    }
    (found, bare)
}

/// The pieces of bands that go all around an opening alone, and have the shape for it.
pub fn whole_bands(layout: &Layout, names: &dyn Names) -> Vec<usize> {
    let of = Assignment::empty(layout.atoms.len());
    let sewn = Sewn { layout, of: &of, closed: &[] };
    let bands = Bands { sewn, names, weights: BandWeights::default() };
    let is_whole = |p: &&Panel| names.is_whole_band(p.piece) && bands.astray(p, &of).is_some();
    layout.panels.iter().filter(is_whole).map(|p| p.piece).collect()
}

/// Is a panel a band whose long sides are at least so long, metres?
pub fn is_band(layout: &Layout, names: &dyn Names, panel: &Panel, least: f64) -> bool {
    let of = Assignment::empty(layout.atoms.len());
    let sewn = Sewn { layout, of: &of, closed: &[] };
    let sides = Bands { sewn, names, weights: BandWeights::default() }.sides_of_band(panel);
    sides.is_some_and(|[first, ..]| sewn.length(&first) > least)
}

/// The sides of a band.
struct Band {
    /// The side that is sewn on where nothing speaks for the other, and its end.
    first: Vec<usize>,
    end: Vec<usize>,
    long: Vec<usize>,
    other_end: Vec<usize>,
}

struct Bands<'a> {
    sewn: Sewn<'a>,
    names: &'a dyn Names,
    weights: BandWeights,
}

impl Bands<'_> {
    /// A band that may go around an opening, and of which no long side is sewn there yet by the partners `before`.
    fn astray(&self, panel: &Panel, before: &Assignment) -> Option<Band> {
        let [first, end, long, other_end] = self.sides_of_band(panel)?;
        let has_place = |p: &Panel| self.names.goes_around(panel.piece, p.piece).is_some();
        let is_on = [&first, &long].iter().any(|side| self.is_sewn_whole(panel.piece, side, before));
        let is_astray = !is_on && self.sewn.layout.panels.iter().any(has_place);
        is_astray.then_some(Band { first, end, long, other_end })
    }

    /// Sews a band around an opening, and its ends to each other.
    fn closed_by(&self, panel: &Panel, band: &Band) -> Vec<Closing> {
        let piece = panel.piece;
        let openings = self.sewn.openings();
        let fits = openings.iter().filter_map(|o| {
            let rim = self.rim(panel, o, &openings)?;
            let edge = self.edge(band, rim);
            let [usual, spread] = self.weights.usual(rim, self.names.is_waistband(piece));
            let off = (self.sewn.length(edge) / self.sewn.length(o) - usual).abs();
            // Left goes to left, where names tell the sides.
            let is_across = o.iter().any(|a| self.names.seam(piece, self.sewn.piece(*a), false, 0.0) < 0.0);
            (off < spread).then_some((is_across, off, o, rim))
        });
        let best = fits.min_by(|p, q| p.0.cmp(&q.0).then(p.1.total_cmp(&q.1)));
        let Some((_, _, opening, rim)) = best else { return Vec::new() };
        let edge = self.edge(band, rim).clone();
        // Cloth is often gathered to a waistband.
        let is_waist = self.names.is_waistband(piece);
        let is_high = self.sewn.length(&band.end) > self.weights.collar_height * self.sewn.length(&edge);
        let is_collar = rim == Rim::Upper && !is_waist && is_high;
        let opens = rim == Rim::Upper && (is_waist || is_collar);
        let front = opens.then(|| self.front_middle(opening)).flatten();
        let (start, lead) = front.unwrap_or_else(|| (self.joint_of_pieces(opening), 0.0));
        let n = opening.len();
        let around: Vec<usize> = (0..n).map(|k| opening[(start + k) % n]).collect();
        let backward = |atoms: &[usize]| atoms.iter().rev().copied().collect::<Vec<usize>>();
        let confidence = self.weights.confidence;
        let ring = Closing { a: around, b: backward(&edge), lead, confidence };
        // A collar stands open in front.
        let ends = Closing { a: band.end.clone(), b: backward(&band.other_end), lead: 0.0, confidence };
        if front.is_some() && is_collar { vec![ring] } else { vec![ring, ends] }
    }

    /// The rim that an opening is for a band; `None` where it goes around others.
    fn rim(&self, panel: &Panel, opening: &[usize], openings: &[Vec<usize>]) -> Option<Rim> {
        let rim = |a: &usize| self.names.goes_around(panel.piece, self.sewn.piece(*a));
        // The tops of raglan sleeves are a part of the neckline.
        let is_upper = |a: &usize| rim(a) == Some(Rim::Upper) || self.names.is_sleeve(self.sewn.piece(*a));
        if opening.iter().any(|a| rim(a) == Some(Rim::Upper)) {
            let is_single = !self.has_twin(panel);
            let is_place = opening.iter().all(is_upper) && !self.is_low(opening);
            return (is_place && !(is_single && self.is_one_of_pair(opening, openings))).then_some(Rim::Upper);
        }
        let is_end = opening.iter().all(|a| rim(a) == Some(Rim::Lower));
        (is_end && self.is_low(opening)).then_some(Rim::Lower)
    }

    /// The long side of a band that is sewn to a rim: the lower one where the band stands above it.
    fn edge<'b>(&self, band: &'b Band, rim: Rim) -> &'b Vec<usize> {
        let (first, long) = (self.is_low(&band.first), self.is_low(&band.long));
        let is_other = if rim == Rim::Upper { long && !first } else { first && !long };
        if is_other { &band.long } else { &band.first }
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
        let meet = |k: usize| piece(k) != piece(k + n - 1) && self.names.are_namesakes(piece(k), piece(k + n - 1));
        let fronts = (0..n).filter(|k| is_front(*k) && is_front(k + n - 1)).map(|k| (k, 0.0));
        // Where the front is whole, a skirt opens between the halves of its back.
        let ends = fronts.chain((0..n).filter(|k| meet(*k)).map(|k| (k, 0.0)));
        let halves = (0..n).filter(|k| is_front(*k)).map(|k| (k, 0.5 * length(k)));
        ends.chain(halves).find(|(k, lead)| !joints.is_empty() && is_middle(starts[*k] + lead))
    }

    /// Is a side sewn all along, to stretches that a band goes around, and as long as itself? Cloth is gathered to a
    /// waistband.
    fn is_sewn_whole(&self, band: usize, side: &[usize], by: &Assignment) -> bool {
        let Some(partners) = side.iter().map(|a| by.partner(*a)).collect::<Option<Vec<usize>>>() else { return false };
        let is_place = partners.iter().all(|a| self.names.goes_around(band, self.sewn.piece(*a)).is_some());
        let ratio = libm::log(self.sewn.length(&partners) / self.sewn.length(side));
        is_place && (self.names.is_waistband(band) || ratio.abs() < self.weights.band_ends)
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
        // A rib that is folded double is high, and its name tells it.
        let least = if self.names.is_whole_band(panel.piece) { 1.0 } else { self.weights.band_least };
        (is_even && self.sewn.length(&a).min(self.sewn.length(&c)) > least * short).then_some([a, b, c, d])
    }
}
