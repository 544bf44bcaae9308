//! The decision on every wedge of a file: dart, undecided, or none, by the points of its evidence.
//!
//! The rest of the file adds to the evidence of the piece: an insert that fits between the legs, the habit of drilling
//! darts, the other sizes of the piece, and a sure sibling. Lenses are decided where they are found, and stay darts.

use super::codes;
use super::dart::{Denied, DrawnDart, Form};
use super::declare::declaration;
use super::insert::Inserts;
use super::thresholds::{
    COUNT_OF_HABIT, DIFFERENCE_OF_SIBLINGS, POINTS_OF_DART, POINTS_OF_DOUBT, POINTS_OF_INSERT, POINTS_OF_OTHER_SIZE,
    POINTS_OF_SIBLING, POINTS_OF_UNMARKED,
};
use crate::dxf::desk::Desk;
use crate::dxf::ledger::Verdict;
use crate::dxf::piece::{DrawnPiece, mm};
use std::collections::{BTreeMap, BTreeSet};
use toile_garment::Diagnostic;

const INSERT: &str = "another piece has a point with sides as long as its legs: an insert (godet) goes there";
const UNMARKED: &str =
    "the darts of this file have a drill hole at the apex and this wedge has neither that nor notches at its mouth";
const SIBLING: &str = "a dart of its size lies elsewhere";
const OTHER_SIZE: &str = "it is a dart in another size of its piece";
const NARROW: &str = "it is narrow and nothing marks it: a slit";

/// Decides on the wedges and marked darts of all pieces, and tells those that are no darts or undecided.
pub(in crate::dxf) fn decide(pieces: &mut [DrawnPiece], desk: &mut Desk<'_>) {
    weigh_by_file(pieces);
    weigh_sizes(pieces);
    weigh_siblings(pieces);
    for piece in pieces.iter_mut() {
        for dart in std::mem::take(&mut piece.darts) {
            if dart.form == Form::Lens || dart.is_sure() {
                piece.keep(dart, desk);
            } else if is_doubtful(&dart) {
                piece.doubts.undecided.push(dart);
            } else {
                piece.deny(&dart, desk);
            }
        }
        piece.tell_undecided(desk);
        piece.check_legs(desk);
    }
}

/// Adds the evidence of the other pieces: inserts, and the habit of drilling darts.
fn weigh_by_file(pieces: &mut [DrawnPiece]) {
    let (inserts, habit) = (Inserts::new(pieces), drills_its_darts(pieces));
    for i in 0..pieces.len() {
        let mut darts = std::mem::take(&mut pieces[i].darts);
        // Legs that are drawn as lines are marked already.
        for dart in darts.iter_mut().filter(|d| d.form == Form::Wedge) {
            if inserts.fit(dart, i, pieces) {
                dart.add(POINTS_OF_INSERT, INSERT);
            } else if habit && !pieces[i].is_drilled(dart) && !pieces[i].is_notched(dart) {
                dart.add(POINTS_OF_UNMARKED, UNMARKED);
            }
        }
        pieces[i].darts = darts;
    }
}

/// Tells whether the file marks its darts by drill holes. A habit needs more than one witness, and no fewer than speak
/// against it.
fn drills_its_darts(pieces: &[DrawnPiece]) -> bool {
    let (mut with, mut without) = (0_usize, 0_usize);
    for piece in pieces {
        for dart in piece.darts.iter().filter(|d| d.form != Form::Lens && d.is_sure()) {
            if piece.is_drilled(dart) { with += 1 } else { without += 1 }
        }
    }
    with >= COUNT_OF_HABIT && with >= without
}

/// Tells whether evidence leaves a dart undecided.
fn is_doubtful(dart: &DrawnDart) -> bool {
    (POINTS_OF_DOUBT..POINTS_OF_DART).contains(&dart.points())
}

/// A wedge in doubt, against which nothing speaks, is what it is in the other sizes of its piece.
fn weigh_sizes(pieces: &mut [DrawnPiece]) {
    let mut sure: BTreeMap<String, BTreeSet<(usize, usize)>> = BTreeMap::new();
    for piece in pieces.iter().filter(|p| p.size.is_some()) {
        let numbers = (0..piece.darts.len()).filter(|k| piece.darts[*k].is_sure());
        if let Some(name) = &piece.name {
            sure.entry(name.clone()).or_default().extend(numbers.map(|k| (k, piece.darts.len())));
        }
    }
    for piece in pieces.iter_mut().filter(|p| p.size.is_some()) {
        let Some(sure) = piece.name.as_ref().and_then(|name| sure.get(name)) else { continue };
        let count = piece.darts.len();
        for (k, dart) in piece.darts.iter_mut().enumerate() {
            if is_doubtful(dart) && dart.objection().is_none() && sure.contains(&(k, count)) {
                dart.add(POINTS_OF_OTHER_SIZE, OTHER_SIZE);
            }
        }
    }
}

/// A wedge in doubt has one point more if a sure dart of its size is like it or its mirror image.
fn weigh_siblings(pieces: &mut [DrawnPiece]) {
    if !pieces.iter().flat_map(|p| &p.darts).any(is_doubtful) {
        return;
    }
    let sure: Vec<(Option<String>, [f64; 3])> = pieces
        .iter()
        .flat_map(|p| p.darts.iter().filter(|d| d.is_sure()).map(|d| (p.size.clone(), measures(d))))
        .collect();
    for piece in pieces {
        let (darts, size) = (&mut piece.darts, &piece.size);
        for dart in darts.iter_mut().filter(|d| is_doubtful(d)) {
            let own = measures(dart);
            let alike = |(a, b): (&f64, &f64)| (a - b).abs() <= DIFFERENCE_OF_SIBLINGS * a.max(*b);
            if sure.iter().any(|(s, other)| s == size && own.iter().zip(other).all(alike)) {
                dart.add(POINTS_OF_SIBLING, SIBLING);
            }
        }
    }
}

/// Width, shorter and longer leg, mm: the same for a dart and its mirror image.
fn measures(dart: &DrawnDart) -> [f64; 3] {
    let (a, b) = (dart.leg_path(0), dart.leg_path(1));
    [dart.width(), a.min(b), a.max(b)]
}

impl DrawnPiece {
    fn keep(&mut self, dart: DrawnDart, desk: &mut Desk<'_>) {
        for id in &dart.ids {
            let rule = if dart.form == Form::Lens { "closed lens: fish-eye dart" } else { "legs of a marked dart" };
            desk.overrule(*id, Verdict::Interpreted, rule);
        }
        self.darts.push(dart);
    }

    /// A wedge with evidence against it is told; a sliver without any is only noted.
    fn deny(&mut self, dart: &DrawnDart, desk: &mut Desk<'_>) {
        let (at, form) = (dart.apexes[0], dart.form);
        let objection = dart.objection();
        let why = objection.unwrap_or(NARROW);
        self.doubts.denied.push(Denied { at, why, form });
        if objection.is_some() {
            let text = format!("the wedge at {} of `{}` was not taken as a dart: {why}", mm(at), self.label());
            let hint = format!("if it is a dart, write in the sewing file:\n{}", declaration(self.label(), dart));
            desk.say(Diagnostic::warning(codes::WEDGE_NOT_A_DART, text).hint(hint), &self.block, "1", dart.line);
        }
    }

    fn tell_undecided(&self, desk: &mut Desk<'_>) {
        for dart in &self.doubts.undecided {
            desk.say(self.undecided(self.label(), dart), &self.block, dart.form.layer(), dart.line);
        }
    }
}
