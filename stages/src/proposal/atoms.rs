//! Outlines cut into atoms: stretches between corners, notches and the mouths of darts.
//!
//! A seam of a garment joins atoms to atoms. The legs of a dart belong to no atom: the atoms on both sides of its mouth
//! are neighbours, and the corner between them is measured with the dart closed.

use super::profile::{Profile, bow, heading, profile, turn, wrapped};
use super::tuning;
use crate::sewing::marks::on_rings;
use crate::sewing::ring::{Gap, Ring};
use crate::sewing::shapes::{PieceShape, Shapes};
use std::f64::consts::PI;
use std::ops::Range;
use toile_garment::{Garment, Piece, Vec2};

/// The mark between two atoms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// A corner of the outline.
    Corner,
    /// A notch.
    Notch,
    /// The mouth of a dart.
    Dart,
}

impl Atom {
    /// Does it run along the warp?
    pub fn is_along(&self) -> bool {
        self.along[0].abs() > 0.8
    }

    /// Does it run across the warp?
    pub fn is_across(&self) -> bool {
        self.along[0].abs() < 0.5
    }

    /// Is it a lower edge? Such an edge runs from left to right with the cloth above it, across the warp.
    pub fn is_low(&self) -> bool {
        self.is_across() && self.along[1] < 0.0
    }
}

/// The place between two atoms that follow one another.
#[derive(Clone, Copy, Debug)]
pub struct Joint {
    /// Kind.
    pub mark: Mark,
    /// Angle of the cloth there, radians; of both sides of a closed dart together.
    pub angle: f64,
    /// Does a notch stand there?
    pub is_notched: bool,
}

/// A stretch of outline that is sewn as a whole.
#[derive(Clone, Debug)]
pub struct Atom {
    /// Panel.
    pub panel: usize,
    /// Start on the ring, metres of arc.
    pub from: f64,
    /// End on the ring, counter-clockwise from the start.
    pub to: f64,
    /// Points from start to end.
    pub points: Vec<Vec2>,
    /// Length, metres.
    pub length: f64,
    /// The joint at its start.
    pub joint: Joint,
    /// The atom after it.
    pub next: usize,
    /// The atom before it.
    pub before: usize,
    /// Course.
    pub profile: Profile,
    /// True where it is straight.
    pub straight: bool,
    /// Cosine and sine of its chord against the warp: (1, 0) runs with it.
    pub along: [f64; 2],
}

/// A piece with its atoms.
#[derive(Clone, Debug)]
pub struct Panel {
    /// Index of the piece in the garment.
    pub piece: usize,
    /// Its atoms, counter-clockwise.
    pub atoms: Range<usize>,
    /// Unit warp direction.
    pub warp: Vec2,
    /// Length of the outline, metres.
    pub perimeter: f64,
    /// Width over length of the cloth: small for bands.
    pub slenderness: f64,
}

/// All pieces, cut.
#[derive(Clone, Debug, Default)]
pub struct Layout {
    /// Panels.
    pub panels: Vec<Panel>,
    /// Atoms of all panels.
    pub atoms: Vec<Atom>,
}

impl Layout {
    /// Cuts the outlines of a garment. Pieces in `left_out` get no panel.
    pub fn new(garment: &Garment, shapes: &Shapes, left_out: &[String]) -> Self {
        let mut out = Self::default();
        for (index, (piece, shape)) in garment.pieces.iter().zip(shapes).enumerate() {
            if left_out.iter().any(|n| n.eq_ignore_ascii_case(&piece.name)) || shape.rings.is_empty() {
                continue;
            }
            out.add(index, piece, shape);
        }
        out
    }

    fn add(&mut self, index: usize, piece: &Piece, shape: &PieceShape) {
        let (ring, first, panel) = (&shape.rings[0], self.atoms.len(), self.panels.len());
        let cuts = cuts(piece, shape);
        let n = cuts.len();
        let warp = piece.warp();
        for k in 0..n {
            let (here, after) = (&cuts[k], &cuts[(k + 1) % n]);
            let points = walk(ring, here.start, after.end);
            let length = points.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
            let course = profile(&points);
            self.atoms.push(Atom {
                panel,
                from: here.start,
                to: after.end,
                length,
                joint: joint(ring, here),
                next: first + (k + 1) % n,
                before: first + (k + n - 1) % n,
                straight: bow(&course) < tuning::STRAIGHT,
                along: along(&points, warp),
                profile: course,
                points,
            });
        }
        let area = piece.outline.signed_area().abs();
        let perimeter = ring.total();
        let slenderness = 4.0 * area / (perimeter * perimeter).max(1e-12);
        let atoms = first..self.atoms.len();
        self.panels.push(Panel { piece: index, atoms, warp, perimeter, slenderness });
    }

    /// The joint at the end of an atom.
    pub fn end_joint(&self, atom: usize) -> Joint {
        self.atoms[self.atoms[atom].next].joint
    }
}

/// A place at which the outline is cut: one atom ends, the next starts, and a dart may lie between.
#[derive(Clone, Debug)]
struct Cut {
    end: f64,
    start: f64,
    mark: Mark,
    gap: Option<Gap>,
    is_notched: bool,
}

/// The cuts of an outline in walking order, each once.
fn cuts(piece: &Piece, shape: &PieceShape) -> Vec<Cut> {
    let ring = &shape.rings[0];
    let mut cuts: Vec<Cut> = ring
        .gaps
        .iter()
        .map(|g| Cut {
            end: ring.arc[g.from],
            start: ring.arc[g.to],
            mark: Mark::Dart,
            gap: Some(g.clone()),
            is_notched: false,
        })
        .collect();
    let ends = piece.edges.iter().filter_map(|e| ring.of_line.get(e.from as usize).copied().flatten());
    let corners = ends.map(|i| (ring.arc[i], Mark::Corner));
    let notches = on_rings(piece, shape).into_iter().filter(|(r, _)| *r == 0).map(|(_, s)| (s, Mark::Notch));
    for (s, mark) in corners.chain(notches) {
        let near = |t: f64| f64::min(ring.ahead(s, t), ring.ahead(t, s)) < tuning::SAME_MARK;
        let is_notched = mark == Mark::Notch;
        if let Some(known) = cuts.iter_mut().find(|c| near(c.end) || near(c.start)) {
            known.is_notched |= is_notched;
        } else if ring.gap_around(s).is_none() {
            cuts.push(Cut { end: s, start: s, mark, gap: None, is_notched });
        }
    }
    if cuts.is_empty() {
        cuts.push(Cut { end: 0.0, start: 0.0, mark: Mark::Corner, gap: None, is_notched: false });
    }
    cuts.sort_by(|a, b| a.end.total_cmp(&b.end));
    cuts
}

/// The points of a ring from one position to another; the whole ring where they are one.
fn walk(ring: &Ring, from: f64, to: f64) -> Vec<Vec2> {
    let length = match ring.ahead(from, to) {
        d if d > 0.0 => d,
        _ => ring.total(),
    };
    let mut inner: Vec<(f64, Vec2)> = ring
        .points
        .iter()
        .enumerate()
        .map(|(i, p)| (ring.ahead(from, ring.arc[i]), *p))
        .filter(|(d, _)| *d > 1e-7 && *d < length - 1e-7)
        .collect();
    inner.sort_by(|a, b| a.0.total_cmp(&b.0));
    let ends = (ring.at(from), ring.at(to));
    std::iter::once(ends.0).chain(inner.into_iter().map(|(_, p)| p)).chain([ends.1]).collect()
}

/// The joint at a cut. A corner that hardly turns marks a place on an edge, like a notch.
fn joint(ring: &Ring, cut: &Cut) -> Joint {
    let angle = corner(ring, cut);
    let is_flat = cut.mark == Mark::Corner && (angle - PI).abs() < tuning::FLAT_CORNER;
    Joint { mark: if is_flat { Mark::Notch } else { cut.mark }, angle, is_notched: cut.is_notched }
}

/// Angle of the cloth at a cut.
fn corner(ring: &Ring, cut: &Cut) -> f64 {
    let d = tuning::CORNER_REACH.min(0.1 * ring.total());
    let into = |s: f64| ring.at(s) - ring.at(s - d);
    let out = |s: f64| ring.at(s + d) - ring.at(s);
    match &cut.gap {
        Some(g) if g.apex.is_some() => {
            2.0 * PI - turn(into(cut.end), out(cut.end)) - turn(into(cut.start), out(cut.start))
        }
        _ => PI - turn(into(cut.end), out(cut.start)),
    }
}

/// Cosine and sine of the chord of an atom against the warp.
fn along(points: &[Vec2], warp: Vec2) -> [f64; 2] {
    let chord = points[points.len() - 1] - points[0];
    let angle = wrapped(heading(chord) - heading(warp));
    [libm::cos(angle), libm::sin(angle)]
}
