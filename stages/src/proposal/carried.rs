//! Marks that one side of a seam has and the other one lacks.
//!
//! A seam joins atoms one to one. Where a dart or a notch parts one side alone, its mark is carried to the other side,
//! which becomes two atoms there.

use super::atoms::{Atom, Layout, Mark, Panel};
use super::profile::{Profile, apart, heading, profile, reversed};
use super::tuning;
use std::f64::consts::PI;
use toile_garment::Vec2;

/// Places at which outlines are cut beside their own marks: metres of arc, for every piece of the garment.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Carried(Vec<Vec<f64>>);

impl Carried {
    /// The places on a piece.
    pub fn of(&self, piece: usize) -> &[f64] {
        self.0.get(piece).map_or(&[], Vec::as_slice)
    }

    /// Cuts an atom at a distance from its start, metres. Distances that are nearly those of its ends cut nothing.
    pub fn cut(&mut self, layout: &Layout, atom: usize, way: f64) {
        let atom = &layout.atoms[atom];
        if way < tuning::LEAST_PART || way > atom.length - tuning::LEAST_PART {
            return;
        }
        let Panel { piece, perimeter, .. } = layout.panels[atom.panel];
        self.0.resize_with(self.0.len().max(piece + 1), Vec::new);
        self.0[piece].push((atom.from + way).rem_euclid(perimeter));
    }

    /// Is nothing cut?
    pub fn is_empty(&self) -> bool {
        self.0.iter().all(Vec::is_empty)
    }
}

/// Atoms that follow one another on one piece without a corner between them, darts closed.
struct Chain {
    atoms: Vec<usize>,
    length: f64,
    course: Profile,
}

/// Carries the marks of edges that are parted by darts or notches to the plain edges that equal them.
pub fn parted(layout: &Layout) -> Carried {
    let mut out = Carried::default();
    for chain in chains(layout) {
        for a in (0..layout.atoms.len()).filter(|a| is_counterpart(layout, &chain, *a)) {
            let mut way = layout.atoms[a].length;
            for c in &chain.atoms[..chain.atoms.len() - 1] {
                way -= layout.atoms[*c].length;
                cut_equals(layout, a, way, &mut out);
            }
        }
    }
    out
}

/// Cuts an atom, and all as long as it at the place that would meet the cut: what was sewn whole can be sewn in parts.
fn cut_equals(layout: &Layout, a: usize, way: f64, out: &mut Carried) {
    let atom = &layout.atoms[a];
    for (b, other) in layout.atoms.iter().enumerate().filter(|(_, b)| is_equal(b.length, atom.length)) {
        let same_way = atom.along[0] * other.along[0] + atom.along[1] * other.along[1] > 0.0;
        let share = way / atom.length;
        out.cut(layout, b, if same_way { share } else { 1.0 - share } * other.length);
    }
}

fn is_equal(x: f64, y: f64) -> bool {
    libm::log(x / y).abs() < tuning::EQUAL_EDGES
}

fn chains(layout: &Layout) -> Vec<Chain> {
    let mut out = Vec::new();
    for first in 0..layout.atoms.len() {
        let mut atoms = vec![first];
        let mut points = layout.atoms[first].points.clone();
        for _ in 1..tuning::CHAIN_MOST {
            let next = layout.atoms[atoms[atoms.len() - 1]].next;
            let joint = layout.atoms[next].joint;
            if joint.mark == Mark::Corner || next == first {
                break;
            }
            go_on(&mut points, &layout.atoms[next]);
            atoms.push(next);
            let length = atoms.iter().map(|a| layout.atoms[*a].length).sum();
            out.push(Chain { atoms: atoms.clone(), length, course: profile(&points) });
        }
    }
    out
}

/// Lays an atom to the end of a course, the dart between them closed.
fn go_on(points: &mut Vec<Vec2>, atom: &Atom) {
    let (end, start) = (points[points.len() - 1], atom.points[0]);
    let before = end - points[points.len() - 2];
    let turn = heading(before) + (PI - atom.joint.angle) - heading(atom.points[1] - start);
    let (sin, cos) = if atom.joint.mark == Mark::Dart { libm::sincos(turn) } else { (0.0, 1.0) };
    points.extend(
        atom.points[1..]
            .iter()
            .map(|p| p - start)
            .map(|d| end + Vec2::new(cos * d.x - sin * d.y, sin * d.x + cos * d.y)),
    );
}

/// May an atom be sewn to a whole chain: as long, of a course that complements it, and the right way up?
fn is_counterpart(layout: &Layout, chain: &Chain, a: usize) -> bool {
    let atom = &layout.atoms[a];
    if chain.atoms.contains(&a) || !is_equal(atom.length, chain.length) {
        return false;
    }
    let parts = || chain.atoms.iter().map(|c| &layout.atoms[*c]);
    let along = atom.is_along() && parts().all(|p| p.is_along() && p.along[0] * atom.along[0] < 0.0);
    let across = atom.is_across() && parts().all(Atom::is_across);
    // The long edges of a band are equal, and are not sewn to each other.
    let is_itself = layout.atoms[chain.atoms[0]].panel == atom.panel;
    let is_band = layout.panels[atom.panel].slenderness < tuning::BAND;
    (if is_itself { along && !is_band } else { along || across })
        && apart(&atom.profile, &reversed(&chain.course)) < tuning::SAME_COURSE
}
