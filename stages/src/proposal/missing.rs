//! Marks that one side of a seam lacks: the place at which two pieces meet that are sewn to each other first.
//!
//! A yoke and the back below it make one edge together, and the front beside them has no mark where they meet. So the
//! search could sew the front to one of them only.

use super::atoms::{Joint, Layout};
use super::profile::{apart, reversed};
use super::tuning;
use std::f64::consts::PI;

/// Places at which outlines are to be cut: the number of the panel, and metres of arc.
pub fn missing_marks(layout: &Layout) -> Vec<(usize, f64)> {
    let n = layout.atoms.len();
    let flat = (0..n).flat_map(|a| (0..n).map(move |b| [a, b])).filter(|[a, b]| is_flat(layout, *a, *b));
    let mut found: Vec<(usize, f64)> = flat.filter_map(|[a, b]| opposite(layout, a, b)).collect();
    found.sort_by(|x, y| x.0.cmp(&y.0).then(x.1.total_cmp(&y.1)));
    found.dedup_by(|x, y| x.0 == y.0 && (x.1 - y.1).abs() < tuning::SAME_MARK);
    found
}

/// Are two whole edges surely sewn to each other, so that their pieces lie flat beside the seam and make one edge where
/// the first one ends? No other edge is as long as they are, but for their mirror images.
fn is_flat(layout: &Layout, a: usize, b: usize) -> bool {
    let (x, y) = (&layout.atoms[a], &layout.atoms[b]);
    let ends = [x.joint, layout.end_joint(a), y.joint, layout.end_joint(b)];
    let is_whole = x.panel != y.panel && ends.iter().all(Joint::is_corner);
    let is_even = |l: f64| libm::log(l / x.length).abs() < tuning::EXACTLY;
    let angle = layout.end_joint(a).angle + y.joint.angle;
    is_whole
        && is_even(y.length)
        && (angle - PI).abs() < tuning::CORNER_SUM
        && apart(&x.profile, &reversed(&y.profile)) < tuning::FLAT_SEAM
        && layout.atoms.iter().filter(|o| is_even(o.length)).all(|o| is_copy(layout, o.panel, [x.panel, y.panel]))
}

/// Is an edge the short side of a strip such as a yoke?
fn is_strip(layout: &Layout, a: usize) -> bool {
    let atom = &layout.atoms[a];
    atom.joint.is_corner() && layout.end_joint(a).is_corner() && tuning::STRIP.contains(&atom.length)
}

/// Is a panel one of two others, or a copy of one?
fn is_copy(layout: &Layout, panel: usize, of: [usize; 2]) -> bool {
    let length = |p: usize| layout.panels[p].perimeter;
    of.iter().any(|p| (length(panel) / length(*p) - 1.0).abs() < tuning::SAME_PIECE)
}

/// The stretch that lies opposite to both pieces beyond the end of a flat seam, and the place on it where they meet.
fn opposite(layout: &Layout, a: usize, b: usize) -> Option<(usize, f64)> {
    let atoms = &layout.atoms;
    let (first, second) = (&atoms[atoms[a].next], &atoms[atoms[b].before]);
    let both = first.length + second.length;
    let own = [first.panel, second.panel];
    let is_other = |panel: usize| !is_copy(layout, panel, own);
    // The strip reaches a corner of the other side, which runs up like the strip.
    let begins = |k: usize| is_strip(layout, atoms[a].next) && atoms[k].joint.is_corner();
    let ends = |k: usize| is_strip(layout, atoms[b].before) && layout.end_joint(k).is_corner();
    let is_beside = |k: usize| !atoms[k].is_across() && (begins(k) || ends(k));
    let is_long = |k: usize| (atoms[k].length - both).abs() < tuning::SIDE_BY_SIDE;
    let fits = |k: &usize| is_other(atoms[*k].panel) && is_beside(*k) && is_long(*k);
    // What is sewn to one edge as a whole needs no mark.
    let has_partner = |k: &usize| {
        let is_even = |l: f64| libm::log(l / atoms[*k].length).abs() < tuning::EXACTLY;
        atoms.iter().any(|o| !is_copy(layout, o.panel, [atoms[*k].panel; 2]) && is_even(o.length))
    };
    let off = |k: &usize| (atoms[*k].length - both).abs();
    let best = (0..atoms.len()).filter(fits).filter(|k| !has_partner(k));
    let k = best.min_by(|i, j| off(i).total_cmp(&off(j)))?;
    Some((atoms[k].panel, atoms[k].from + first.length * atoms[k].length / both))
}
