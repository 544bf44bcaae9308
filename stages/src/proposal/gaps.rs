//! Gaps: openings that one edge and several others would close.
//!
//! The seams that were found leave openings. Where an opening is bordered by the edge of one piece and by edges of others
//! that are together as long, in the ratio of the seams beside it, they are sewn to each other. The marks of each side
//! are carried to the other one.

use super::assignment::Assignment;
use super::atoms::Layout;
use super::carried::Carried;
use super::mirror::Mirror;
use super::pairs::Pair;
use super::tuning;

/// An opening, parted into two sides that may be sewn to each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Gap {
    /// Atoms of one piece, in their order.
    one: Vec<usize>,
    /// All other atoms of the opening, in the order in which they are met walking on.
    others: Vec<usize>,
    /// Are the others a ring of their own, which the one goes round?
    is_ring: bool,
}

/// The gaps of a garment.
pub fn gaps(layout: &Layout, of: &Assignment) -> Vec<Gap> {
    let openings = openings(layout, of);
    let mut out: Vec<Gap> = openings.iter().filter_map(|opening| gap(layout, of, opening)).collect();
    out.extend(openings.iter().filter_map(|opening| band(layout, of, opening)));
    out
}

/// The long edge of a band that fits all round an opening of other pieces. The band begins at a seam.
fn band(layout: &Layout, of: &Assignment, opening: &[usize]) -> Option<Gap> {
    let atoms = &layout.atoms;
    let total: f64 = opening.iter().map(|a| atoms[*a].length).sum();
    let low: f64 = opening.iter().filter(|a| atoms[**a].is_low()).map(|a| atoms[*a].length).sum();
    let begin = opening.iter().position(|a| of.partner(atoms[*a].before).is_some())?;
    let fits = |a: usize| {
        let (atom, panel) = (&atoms[a], &layout.panels[atoms[a].panel]);
        let stretch = libm::log(total / atom.length);
        let is_band = panel.slenderness < tuning::BAND && atom.length > tuning::BAND_EDGE * panel.perimeter;
        let is_other = opening.iter().all(|o| atoms[*o].panel != atom.panel);
        let is_turned = (2.0 * low > total) != atom.is_low();
        let is_free = of.partner(a).is_none() && is_band && is_other && is_turned;
        (is_free && tuning::BAND_STRETCH.contains(&stretch)).then_some((stretch.abs(), a))
    };
    let (_, band) = (0..atoms.len()).filter_map(fits).min_by(|x, y| x.0.total_cmp(&y.0))?;
    let others = opening[begin..].iter().chain(&opening[..begin]).copied().collect();
    Some(Gap { one: vec![band], others, is_ring: true })
}

/// Free atoms round every opening, each once, in walking order.
fn openings(layout: &Layout, of: &Assignment) -> Vec<Vec<usize>> {
    let mut seen = vec![false; layout.atoms.len()];
    let mut out = Vec::new();
    for first in 0..layout.atoms.len() {
        if seen[first] || of.partner(first).is_some() {
            continue;
        }
        let mut opening = vec![first];
        seen[first] = true;
        let mut here = first;
        while let Some(next) = next_free(layout, of, here).filter(|n| !seen[*n]) {
            seen[next] = true;
            opening.push(next);
            here = next;
        }
        if next_free(layout, of, here) == Some(first) {
            out.push(opening);
        }
    }
    out
}

/// The free atom after a free one, round the corners and seams between them. None where a piece lies turned over.
fn next_free(layout: &Layout, of: &Assignment, atom: usize) -> Option<usize> {
    let mut here = layout.atoms[atom].next;
    for _ in 0..layout.atoms.len() {
        match of.partner(here) {
            None => return Some(here),
            Some(partner) if of.is_opposite(here) => here = layout.atoms[partner].next,
            Some(_) => return None,
        }
    }
    None
}

/// The split of an opening that fits best.
fn gap(layout: &Layout, of: &Assignment, opening: &[usize]) -> Option<Gap> {
    let n = opening.len();
    let panel = |a: usize| layout.atoms[a].panel;
    if !(3..=tuning::GAP_ATOMS).contains(&n) {
        return None;
    }
    let mut best: Option<(f64, Gap)> = None;
    for start in 0..n {
        for count in 1..n {
            let at = |k: usize| opening[(start + k) % n];
            let gap = Gap { one: (0..count).map(at).collect(), others: (count..n).map(at).collect(), is_ring: false };
            let is_whole = gap.one.iter().all(|a| panel(*a) == panel(gap.one[0]))
                && gap.others.iter().all(|a| panel(*a) != panel(gap.one[0]));
            let Some(off) = is_whole.then(|| off(layout, of, &gap)).flatten() else { continue };
            if off < tuning::GAP_RATIO && best.as_ref().is_none_or(|(o, _)| off < *o) {
                best = Some((off, gap));
            }
        }
    }
    best.map(|(_, gap)| gap)
}

/// How far the ratio of both sides is from the ratio of the seams beside the gap. None where nothing tells the ratio.
fn off(layout: &Layout, of: &Assignment, gap: &Gap) -> Option<f64> {
    let (first, last) = (gap.one[0], gap.one[gap.one.len() - 1]);
    let beside = [layout.atoms[first].before, layout.atoms[last].next];
    let ratio = |a: usize| Some(libm::log(layout.atoms[a].length / layout.atoms[of.partner(a)?].length));
    let known: Vec<f64> = beside.into_iter().filter_map(ratio).collect();
    let expected = known.iter().sum::<f64>() / known.len() as f64;
    let is_level = |a: &usize| layout.atoms[*a].is_across() && layout.atoms[*a].is_low();
    let is_hem = gap.one.iter().chain(&gap.others).all(is_level);
    (!known.is_empty() && !is_hem)
        .then(|| (libm::log(gap.lengths(layout)[0] / gap.lengths(layout)[1]) - expected).abs())
}

impl Gap {
    fn lengths(&self, layout: &Layout) -> [f64; 2] {
        [&self.one, &self.others].map(|list| list.iter().map(|a| layout.atoms[*a].length).sum())
    }

    /// Carries the marks of both sides to each other.
    pub fn carry(&self, layout: &Layout, out: &mut Carried) {
        let [one, others] = self.lengths(layout);
        let mut way = 0.0;
        for a in &self.one[..self.one.len() - 1] {
            way += layout.atoms[*a].length;
            cut(layout, &self.others, (1.0 - way / one) * others, out);
        }
        way = 0.0;
        for a in &self.others[..self.others.len() - 1] {
            way += layout.atoms[*a].length;
            cut(layout, &self.one, (1.0 - way / others) * one, out);
        }
    }

    /// The pairs that close the gap, in a layout in which its marks were carried.
    pub fn pairs(&self, layout: &Layout, cut: &Layout) -> Vec<Pair> {
        let parts = |list: &[usize]| -> Vec<usize> { list.iter().flat_map(|a| parts(layout, cut, *a)).collect() };
        let (one, mut others) = (parts(&self.one), parts(&self.others));
        others.reverse();
        if one.len() != others.len() {
            return Vec::new();
        }
        let ends = [cut.atoms[one[0]].before, cut.atoms[one[one.len() - 1]].next];
        let sewn = one.into_iter().zip(others);
        // A band that goes all round is closed to a ring.
        let join = (self.is_ring && ends[0] != ends[1]).then_some((ends[0], ends[1]));
        sewn.chain(join).map(|(a, b)| Pair { a: a.min(b), b: a.max(b), opposite: true }).collect()
    }
}

/// Cuts the atom that holds a distance from the start of a side.
fn cut(layout: &Layout, side: &[usize], mut way: f64, out: &mut Carried) {
    for a in side {
        let length = layout.atoms[*a].length;
        if way < length {
            return out.cut(layout, *a, way);
        }
        way -= length;
    }
}

/// The atoms that one became.
fn parts(layout: &Layout, cut: &Layout, atom: usize) -> Vec<usize> {
    let old = &layout.atoms[atom];
    let start = cut.panels[old.panel].atoms.clone().find(|b| cut.atoms[*b].from == old.from);
    let mut out: Vec<usize> = start.into_iter().collect();
    while let Some(last) = out.last().copied().filter(|b| cut.atoms[*b].to != old.to) {
        if out.len() > cut.atoms.len() {
            return Vec::new();
        }
        out.push(cut.atoms[last].next);
    }
    out
}

/// An assignment in a layout with more cuts. Atoms that were cut are free there.
pub fn carried_over(of: &Assignment, layout: &Layout, cut: &Layout, mirror: &Mirror) -> Assignment {
    let mut out = Assignment::empty(cut.atoms.len());
    for pair in of.pairs() {
        if let ([a], [b]) = (parts(layout, cut, pair.a).as_slice(), parts(layout, cut, pair.b).as_slice()) {
            let new = Pair { a: *a.min(b), b: *a.max(b), opposite: pair.opposite };
            if out.partner(new.a) != Some(new.b) {
                out.sew(new, mirror);
            }
        }
    }
    out
}
