//! Seams that go on past a mark.
//!
//! The search sews stretches between marks one to one. Where one side has a mark and the other has none, as at the mouth
//! of a pocket, both stay open beyond the place before it. If all that is left of both sides, up to the next corner, is
//! equally long, the seam goes on.

use super::openings::{Closing, Sewn};
use super::tuning::{self, OnwardWeights};
use std::f64::consts::PI;

/// The stretches by which the seams of an assignment go on. No atom of `is_given` is among them.
pub fn onward(sewn: Sewn<'_>, is_given: impl Fn(usize) -> bool) -> Vec<Closing> {
    let weights = OnwardWeights::default();
    let mut found: Vec<Closing> = Vec::new();
    for pair in sewn.of.pairs().filter(|p| p.opposite) {
        for [first, second] in [[pair.a, pair.b], [pair.b, pair.a]] {
            let (a, b) = (left_over(sewn, first, true), left_over(sewn, second, false));
            let is_free = |atom: &usize| !is_given(*atom) && !found.iter().any(|c| c.has(*atom)) && !b.contains(atom);
            let lengths = [sewn.length(&a), sewn.length(&b)];
            let is_long = lengths.iter().all(|l| *l >= weights.least);
            let is_even = is_long && libm::log(lengths[0] / lengths[1]).abs() < weights.even;
            // One stretch against one has been weighed by the search.
            if a.len() + b.len() > 2 && is_even && a.iter().all(is_free) && b.iter().all(|atom| !is_given(*atom)) {
                found.push(Closing { a, b, lead: 0.0, confidence: weights.confidence });
            }
        }
    }
    found
}

/// The free atoms that follow an atom along the outline, forward or backward, up to the next corner.
fn left_over(sewn: Sewn<'_>, atom: usize, forward: bool) -> Vec<usize> {
    let atoms = &sewn.layout.atoms;
    let mut out = Vec::new();
    let mut here = atom;
    loop {
        let next = if forward { atoms[here].next } else { atoms[here].before };
        let joint = atoms[if forward { next } else { here }].joint;
        let is_corner = (joint.angle - PI).abs() > tuning::CLEAR_CORNER;
        if is_corner || sewn.of.partner(next).is_some() || out.contains(&next) {
            return out;
        }
        out.push(next);
        here = next;
    }
}
