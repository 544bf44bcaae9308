//! The proposal of a whole garment.

use super::assignment::Assignment;
use super::atoms::Layout;
use super::confidence::margins;
use super::known::{Decisions, Known};
use super::mirror::{Mirror, maps};
use super::bands::bands;
use super::openings::{Closing, Sewn};
use super::pairs::{Pair, Pairs, Prior};
use super::seams::{ProposedSeam, closing_seam, seams};
use super::search::{Found, best};
use super::sleeves::{are_whole, sleeves};
use super::tuning::{self, PairWeights, SleeveWeights, WholeWeights};
use super::whole::Whole;
use crate::sewing::ring::nearest_on;
use crate::roles::Upright;
use crate::roles::outline::turned;
use crate::sewing::shapes::{Shapes, shapes};
use toile_garment::{Diagnostic, Garment, Vec2};

/// Knowledge from the names of pieces.
pub trait Names {
    /// Added to the score of sewing two pieces to each other.
    fn seam(&self, a: usize, b: usize, images: bool, length: f64) -> f64;
    /// Added to the score of sewing a piece to the lower edge of another.
    fn to_lower_edge(&self, piece: usize) -> f64;
    /// Is a piece set on an opening of another one: a sleeve or a collar on a bodice, a cuff on a sleeve?
    fn is_set_on(&self, piece: usize, other: usize) -> bool;
    /// Is a piece a sleeve?
    fn is_sleeve(&self, piece: usize) -> bool;
    /// Is a piece a sleeve that is set on another piece?
    fn is_sleeve_of(&self, piece: usize, other: usize) -> bool {
        self.is_sleeve(piece) && self.is_set_on(piece, other)
    }
    /// Does a piece lie elsewhere than on an arm?
    fn is_off_arm(&self, piece: usize) -> bool;
    /// Is a piece a sleeve by itself, sewn to a tube?
    fn is_whole_sleeve(&self, piece: usize) -> bool;
    /// Are two pieces the left and the right one of a pair?
    fn are_namesakes(&self, a: usize, b: usize) -> bool;
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

    fn is_sleeve(&self, _: usize) -> bool {
        false
    }

    fn is_off_arm(&self, _: usize) -> bool {
        false
    }

    fn is_whole_sleeve(&self, _: usize) -> bool {
        false
    }

    fn are_namesakes(&self, _: usize, _: usize) -> bool {
        false
    }
}

/// Knowledge beside the shapes: names, and decisions of a person.
struct Knowledge<'a> {
    names: &'a dyn Names,
    decisions: Decisions,
    /// Are the sleeves sewn on later?
    without_sleeves: bool,
    sleeve: SleeveWeights,
}

impl Knowledge<'_> {
    /// Is the seam of a pair found later: that of a sleeve to the trunk, or of a sleeve of one piece to itself?
    fn is_later(&self, layout: &Layout, pair: Pair) -> bool {
        let [p, q] = [pair.a, pair.b].map(|a| layout.panels[layout.atoms[a].panel].piece);
        let is_set_in = |p: usize, q: usize| self.names.is_sleeve(p) && self.names.is_off_arm(q);
        let are_single = self.names.is_whole_sleeve(p) && self.names.is_whole_sleeve(q);
        self.without_sleeves && (is_set_in(p, q) || is_set_in(q, p) || are_single)
    }
}

impl Prior for Knowledge<'_> {
    fn score(&self, layout: &Layout, pair: Pair, images: bool) -> f64 {
        let (a, b) = (&layout.atoms[pair.a], &layout.atoms[pair.b]);
        let piece = |panel: usize| layout.panels[panel].piece;
        let mut sum = self.names.seam(piece(a.panel), piece(b.panel), images, a.length.min(b.length));
        for (x, y) in [(a, b), (b, a)] {
            sum += if y.is_low() { self.names.to_lower_edge(piece(x.panel)) } else { 0.0 };
        }
        let is_set_on = self.names.is_set_on(piece(a.panel), piece(b.panel))
            || self.names.is_set_on(piece(b.panel), piece(a.panel));
        let gather = libm::log(a.length / b.length).abs();
        let is_unlikely = gather > tuning::SET_ON_GATHER || a.length.min(b.length) < tuning::SET_ON_LEAST;
        sum += if is_set_on && is_unlikely { tuning::TOO_GATHERED } else { 0.0 };
        sum += if self.is_later(layout, pair) { self.sleeve.apart } else { 0.0 };
        sum + self.decisions.score(pair)
    }
}

/// An edge that is sewn to nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Bare {
    /// Index of the piece in the garment.
    pub piece: usize,
    /// Number of the edge on which it lies.
    pub edge: u32,
    /// Length, metres.
    pub length: f64,
}

/// All that is proposed for a garment.
#[derive(Clone, Debug, Default)]
pub struct Proposal {
    /// Seams.
    pub seams: Vec<ProposedSeam>,
    /// For every seam: does the sewing file have it, or a part of it, already?
    pub given: Vec<bool>,
    /// Edges that are sewn to nothing.
    pub bare: Vec<Bare>,
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
    let layout = Layout::new(garment, &shapes, &garment.plan.leave_out);
    let decisions = Decisions::new(&layout, known);
    let task = Task { garment, shapes: &shapes, layout: &layout, names, known };
    let Some(sewn) = task.sewn(&decisions) else { return Ok(Proposal { layout, ..Proposal::default() }) };
    let Searched { assignment, mut seams, closings } = sewn;
    let (closings, left) = bands(&layout, &assignment, names, |a| decisions.is_given(a), &closings);
    let is_closed = |a: usize| closings.iter().any(|c| c.has(a));
    seams.retain(|s| s.atoms.iter().all(|[a, b]| left.partner(*a) == Some(*b)));
    seams.extend(closings.iter().map(|c| closing_seam(garment, &shapes, &layout, c)));
    let bare = bare(garment, &layout, |a| left.partner(a).is_none() && !is_closed(a));
    let is_given = |s: &ProposedSeam| s.atoms.iter().flatten().any(|a| decisions.is_given(*a));
    seams.retain(|s| is_given(s) || !decisions.are_decided(s.atoms.iter().flatten()));
    let given = seams.iter().map(is_given).collect();
    Ok(Proposal { seams, given, bare, layout })
}

/// Sleeves of a garment.
const SLEEVES: usize = 2;

/// What a search found.
struct Searched {
    assignment: Assignment,
    seams: Vec<ProposedSeam>,
    closings: Vec<Closing>,
}

impl Searched {
    fn cloth<'a>(&'a self, layout: &'a Layout) -> Sewn<'a> {
        Sewn { layout, of: &self.assignment }
    }
}

/// A garment to be sewn.
struct Task<'a> {
    garment: &'a Garment,
    shapes: &'a Shapes,
    layout: &'a Layout,
    names: &'a dyn Names,
    known: &'a Known,
}

impl Task<'_> {
    /// The best garment. Sleeves that are one piece each, or whose caps are not sewn all round, are set in as a whole.
    fn sewn(&self, decisions: &Decisions) -> Option<Searched> {
        let (layout, names) = (self.layout, self.names);
        let pieces = || layout.panels.iter().map(|p| p.piece);
        let is_given = (0..layout.atoms.len()).any(|a| decisions.is_given(a));
        let has_single = pieces().any(|p| names.is_whole_sleeve(p));
        let found = self.search(&WholeWeights::default(), false)?;
        if is_given || (!has_single && are_whole(found.cloth(layout), names)) {
            return Some(found);
        }
        let up = turned(Vec2::y(), -Upright::of(&self.garment.pieces, &[]).turn);
        for weights in [WholeWeights::default(), WholeWeights::open_marks()] {
            let apart = self.search(&weights, true)?;
            let set_in = sleeves(apart.cloth(layout), names, up);
            if set_in.count == SLEEVES {
                return Some(Searched { closings: set_in.seams, ..apart });
            }
        }
        Some(found)
    }

    /// The best garment, its sleeves apart from the trunk if asked. `None` where nothing can be sewn.
    fn search(&self, weights: &WholeWeights, without_sleeves: bool) -> Option<Searched> {
        let (layout, names) = (self.layout, self.names);
        let decisions = Decisions::new(layout, self.known);
        let knowledge = Knowledge { names, decisions, without_sleeves, sleeve: SleeveWeights::default() };
        let scores = scores(layout, &knowledge);
        let apart: Vec<bool> = layout.panels.iter().map(|p| without_sleeves && names.is_sleeve(p.piece)).collect();
        let whole = |mirror, pairs| Whole::new(layout, mirror, pairs, weights).with_apart(apart.clone());
        let wholes: Vec<Whole<'_>> = scores.iter().map(|(mirror, pairs)| whole(mirror, pairs)).collect();
        let (map, mut found) = search_all(layout, &wholes)?;
        let margins = margins(layout, wholes.get(map)?, &mut found);
        let seams = seams(self.garment, self.shapes, layout, &margins);
        Some(Searched { assignment: found.assignment, seams, closings: Vec::new() })
    }
}

/// The maps of mirror images, and the scores of pairs under each.
fn scores(layout: &Layout, knowledge: &Knowledge<'_>) -> Vec<(Mirror, Pairs)> {
    let piece = |panel: usize| layout.panels[panel].piece;
    let maps = maps(layout, &|p, q| knowledge.names.are_namesakes(piece(p), piece(q)));
    let weights = PairWeights::default();
    let scored = |mirror: Mirror| {
        let pairs = Pairs::new(layout, &mirror, knowledge, &weights);
        (mirror, pairs)
    };
    maps.into_iter().map(scored).collect()
}

/// A short search on every map, a long one on the best: the number of the map, and what was found on it.
fn search_all(layout: &Layout, wholes: &[Whole<'_>]) -> Option<(usize, Found)> {
    let effort = if wholes.len() > 1 { tuning::SHORT } else { 1.0 };
    let short = |whole| best(layout, whole, effort);
    let mut tried: Vec<(usize, Found)> = wholes.iter().map(short).enumerate().collect();
    tried.sort_by(|a, b| b.1.score.total().total_cmp(&a.1.score.total()));
    tried.truncate(tuning::LONG_TRIES);
    let mut chosen: Option<(usize, Found)> = None;
    for (map, short) in tried {
        let long = best(layout, &wholes[map], 1.0);
        let found = if long.score.total() >= short.score.total() { long } else { short };
        if chosen.as_ref().is_none_or(|(_, c)| found.score.total() > c.score.total()) {
            chosen = Some((map, found));
        }
    }
    chosen
}

/// For every piece: is it its own mirror image? Pieces whose outlines cannot be sewn are not.
#[must_use]
pub fn own_images(garment: &Garment) -> Vec<bool> {
    let mut out = vec![false; garment.pieces.len()];
    let Ok(shapes) = shapes(garment) else { return out };
    let layout = Layout::new(garment, &shapes, &[]);
    for panel in &layout.panels {
        out[panel.piece] = super::mirror::is_own_image(&layout, panel);
    }
    out
}

/// Edges that are sewn to nothing.
fn bare(garment: &Garment, layout: &Layout, is_free: impl Fn(usize) -> bool) -> Vec<Bare> {
    let free = (0..layout.atoms.len()).filter(|a| is_free(*a));
    free.map(|a| {
        let atom = &layout.atoms[a];
        let piece = layout.panels[atom.panel].piece;
        let k = (atom.points.len() - 1) / 2;
        let middle = (atom.points[k] + atom.points[k + 1]) / 2.0;
        Bare { piece, edge: edge_of(garment, piece, middle), length: atom.length }
    })
    .collect()
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
