//! The proposal of a whole garment.

use super::assignment::Assignment;
use super::atoms::Layout;
use super::bands::{bands, whole_bands};
use super::known::{Decisions, Known};
use super::layout::marked;
use super::likely::Likely;
use super::mirror::is_own_image;
use super::openings::{Closing, Sewn};
use super::seams::{ProposedSeam, closing_seam};
use super::task::{Made, Task};
use crate::sewing::ring::nearest_on;
use crate::sewing::shapes::shapes;
use toile_garment::{Diagnostic, Garment, Vec2};

/// Knowledge from the names of pieces.
pub trait Names {
    /// Added to the score of sewing two pieces to each other.
    fn seam(&self, a: usize, b: usize, images: bool, length: f64) -> f64;
    /// Added to the score of sewing a piece to the lower edge of another.
    fn to_lower_edge(&self, piece: usize) -> f64;
    /// Is a piece set on an opening of another one: a sleeve or a collar on a bodice, a cuff on a sleeve?
    fn is_set_on(&self, piece: usize, other: usize) -> bool;
    /// Is a piece a front?
    fn faces_front(&self, piece: usize) -> bool;
    /// Is a piece a waistband?
    fn is_waistband(&self, piece: usize) -> bool;
    /// May a piece hang from a waistband?
    fn hangs_from_waistband(&self, piece: usize) -> bool;
    /// Is a piece a band that goes all around an opening alone?
    fn is_whole_band(&self, _piece: usize) -> bool {
        false
    }
    /// May a band hang on the lower edge of another piece: a cuff on a sleeve, a hem band on a bodice?
    fn ends(&self, _band: usize, _other: usize) -> bool {
        false
    }
    /// The edge of another piece around which a band may go.
    fn goes_around(&self, band: usize, other: usize) -> Option<Rim> {
        if self.ends(band, other) {
            return Some(Rim::Lower);
        }
        let is_upper = self.is_set_on(band, other) || self.is_waistband(band) && self.hangs_from_waistband(other);
        is_upper.then_some(Rim::Upper)
    }
    /// Is a piece a sleeve?
    fn is_sleeve(&self, piece: usize) -> bool;
    /// Is a piece one of a leg?
    fn is_leg(&self, _piece: usize) -> bool {
        false
    }
    /// Is a piece a sleeve that is set on another piece?
    fn is_sleeve_of(&self, piece: usize, other: usize) -> bool {
        self.is_sleeve(piece) && self.is_set_on(piece, other)
    }
    /// Does a piece lie elsewhere than on an arm?
    fn is_off_arm(&self, piece: usize) -> bool;
    /// Does a piece fall over another one, as a collar over its stand?
    fn falls_over(&self, _piece: usize, _other: usize) -> bool {
        false
    }
    /// Does the name of a piece tell what it is?
    fn is_told(&self, _piece: usize) -> bool {
        false
    }
    /// Is a piece a collar, a stand or a hood?
    fn is_at_neck(&self, _piece: usize) -> bool {
        false
    }
    /// Are two pieces the left and the right one of a pair?
    fn are_namesakes(&self, a: usize, b: usize) -> bool;
}

/// The edge of a garment around which a band goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rim {
    /// A neckline, or a waist from which something hangs.
    Upper,
    /// The end of a sleeve or a leg, or the hem of a bodice.
    Lower,
}

/// Names that say nothing.
pub struct Nameless;

impl Names for Nameless {
    fn seam(&self, _: usize, _: usize, _: bool, _: f64) -> f64 {
        0.0
    }

    fn to_lower_edge(&self, _: usize) -> f64 {
        0.0
    }

    fn is_set_on(&self, _: usize, _: usize) -> bool {
        false
    }

    fn faces_front(&self, _: usize) -> bool {
        false
    }

    fn is_waistband(&self, _: usize) -> bool {
        false
    }

    fn hangs_from_waistband(&self, _: usize) -> bool {
        false
    }

    fn is_sleeve(&self, _: usize) -> bool {
        false
    }

    fn is_off_arm(&self, _: usize) -> bool {
        false
    }

    fn are_namesakes(&self, _: usize, _: usize) -> bool {
        false
    }
}

/// An edge that is sewn to nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Bare {
    /// Index of the piece in the garment.
    pub piece: usize,
    /// Number of the edge on which it lies.
    pub edge: u32,
    /// Its middle on the piece.
    pub middle: Vec2,
    /// Length, metres.
    pub length: f64,
}

/// All that is proposed for a garment.
#[derive(Clone, Debug, Default)]
pub struct Proposal {
    /// Seams.
    pub seams: Vec<ProposedSeam>,
    /// For every seam: is it one of the sewing file? Those come first, as they were written.
    pub given: Vec<bool>,
    /// Edges that are sewn to nothing.
    pub bare: Vec<Bare>,
    /// Openings of the sewn garment, such as the neck or the hem: the edges around each, in their order.
    pub openings: Vec<Vec<Bare>>,
    /// The outlines, cut.
    pub layout: Layout,
}

/// Proposes the seams of a garment. Seams that a person gave are part of it. Between pieces that he or she decided on,
/// no other seam is.
///
/// # Errors
/// Outlines that cannot be sewn.
pub fn propose(garment: &Garment, names: &dyn Names, known: &Known) -> Result<Proposal, Vec<Diagnostic>> {
    let shapes = shapes(garment)?;
    let layout = marked(garment, &shapes, &garment.plan.leave_out);
    let decisions = Decisions::new(&layout, known);
    let likely = Likely::lower(garment, &layout, names);
    let task = Task { garment, shapes: &shapes, layout: &layout, names: &likely, known, later: Vec::new() };
    let written = known.written.clone();
    let Some((made, closings, left)) = with_bands(&task, &decisions) else {
        let given = vec![true; written.len()];
        return Ok(Proposal { seams: written, given, layout, ..Proposal::default() });
    };
    let mut seams = made.seams;
    let is_closed = |a: usize| closings.iter().any(|c| c.has(a));
    seams.retain(|s| s.atoms.iter().all(|[a, b]| left.partner(*a) == Some(*b)));
    seams.extend(closings.iter().map(|c| closing_seam(garment, &shapes, &layout, c)));
    let is_open = |a: usize| left.partner(a).is_none() && !is_closed(a) && !decisions.is_given(a);
    let bare_atom = |a: usize| bare(garment, &layout, a);
    let free = (0..layout.atoms.len()).filter(|a| is_open(*a)).map(bare_atom).collect();
    let openings = Sewn { layout: &layout, of: &left, closed: &closings }.openings();
    let openings = openings.iter().map(|atoms| atoms.iter().map(|a| bare_atom(*a)).collect()).collect();
    // What the sewing file has stands as it was written; the search only went on from there.
    let is_open = |s: &ProposedSeam| !s.atoms.iter().flatten().any(|a| decisions.is_given(*a));
    seams.retain(|s| is_open(s) && !decisions.are_decided(s.atoms.iter().flatten()));
    seams.iter_mut().filter(|s| is_fall(names, &layout, s)).for_each(ProposedSeam::turn_over);
    let given = [vec![true; written.len()], vec![false; seams.len()]].concat();
    let seams = [written, seams].concat();
    Ok(Proposal { seams, given, bare: free, openings, layout })
}

/// A garment, the stretches that are sewn as a whole, and the seams that are left beside them. Whole bands are sewn last,
/// around openings of the others: a rib is shorter than its edge, and its ends are as long as those of other ribs. A band
/// that finds no opening takes part in the search.
fn with_bands(task: &Task<'_>, decisions: &Decisions) -> Option<(Made, Vec<Closing>, Assignment)> {
    let (layout, names) = (task.layout, task.names);
    let is_given = |a: usize| decisions.is_given(a);
    let sewn = |later: Vec<usize>| {
        let made = Task { later, ..task.clone() }.made(decisions)?;
        let (closings, left) = bands(layout, &made.assignment, names, is_given, &made.closings);
        Some((made, closings, left))
    };
    let is_any_given = (0..layout.atoms.len()).any(is_given);
    let later = if is_any_given { Vec::new() } else { whole_bands(layout, names) };
    let first = sewn(later.clone())?;
    let is_placed = |p: &usize| {
        let panel = layout.panels.iter().find(|panel| panel.piece == *p);
        panel.is_some_and(|panel| panel.atoms.clone().any(|a| first.1.iter().any(|c| c.has(a))))
    };
    let placed: Vec<usize> = later.iter().copied().filter(is_placed).collect();
    if placed.len() == later.len() { Some(first) } else { sewn(placed) }
}

/// Is a seam that of a collar on its stand? Where both are their own mirror images, the collar is turned over as it is.
fn is_fall(names: &dyn Names, layout: &Layout, seam: &ProposedSeam) -> bool {
    let [a, b] = [&seam.a, &seam.b].map(|runs| runs[0].piece);
    let is_own = |p: usize| layout.panels.iter().any(|panel| panel.piece == p && is_own_image(layout, panel));
    !seam.fold_over && (names.falls_over(a, b) || names.falls_over(b, a)) && is_own(a) && is_own(b)
}

/// For every piece: is it its own mirror image? Pieces whose outlines cannot be sewn are not.
#[must_use]
pub fn own_images(garment: &Garment) -> Vec<bool> {
    let mut out = vec![false; garment.pieces.len()];
    let Ok(shapes) = shapes(garment) else { return out };
    let layout = marked(garment, &shapes, &[]);
    for panel in &layout.panels {
        out[panel.piece] = is_own_image(&layout, panel);
    }
    out
}

/// A stretch that is sewn to nothing.
fn bare(garment: &Garment, layout: &Layout, atom: usize) -> Bare {
    let atom = &layout.atoms[atom];
    let piece = layout.panels[atom.panel].piece;
    let k = (atom.points.len() - 1) / 2;
    let middle = (atom.points[k] + atom.points[k + 1]) / 2.0;
    Bare { piece, edge: edge_of(garment, piece, middle), middle, length: atom.length }
}

/// The number of the edge nearest to a point.
fn edge_of(garment: &Garment, piece: usize, p: Vec2) -> u32 {
    let piece = &garment.pieces[piece];
    let points = piece.outline.positions();
    let n = points.len();
    let off = |i: usize| nearest_on(&[points[i], points[(i + 1) % n]], &[0.0, 1.0], false, p).1;
    let nearest = (0..n).min_by(|i, j| off(*i).total_cmp(&off(*j))).unwrap_or(0);
    let ahead = |from: u32, to: usize| (to + n - from as usize) % n.max(1);
    let holds = |from: u32, to: u32| ahead(from, nearest) < ahead(from, to as usize).max(1);
    piece.edges.iter().find(|e| holds(e.from, e.to)).map_or(0, |e| e.index)
}
