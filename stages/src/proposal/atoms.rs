//! Outlines cut into atoms: stretches between corners, notches and the mouths of darts.
//!
//! A seam of a garment joins atoms to atoms. The legs of a dart belong to no atom: the atoms on both sides of its mouth
//! are neighbours, and the corner between them is measured with the dart closed.

pub use super::cuts::Mark;
use super::cuts::{Cut, Outline, without_unpaired};
use super::profile::{Profile, bow, heading, profile, wrapped};
use super::tuning;
use crate::sewing::ring::Ring;
use crate::sewing::shapes::Shapes;
use std::ops::Range;
use toile_garment::{Garment, Piece, Vec2};

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
        let is_sewn = |piece: &Piece| !left_out.iter().any(|n| n.eq_ignore_ascii_case(&piece.name));
        let all = garment.pieces.iter().zip(shapes).enumerate();
        let sewn = all.filter(|(_, (piece, shape))| is_sewn(piece) && !shape.rings.is_empty());
        let mut outlines: Vec<Outline<'_>> =
            sewn.map(|(index, (piece, shape))| Outline::new(index, piece, shape)).collect();
        without_unpaired(&mut outlines);
        let mut out = Self::default();
        outlines.iter().for_each(|o| out.add(o));
        out
    }

    fn add(&mut self, outline: &Outline<'_>) {
        let Outline { index, piece, ring, cuts } = outline;
        let (index, first, panel) = (*index, self.atoms.len(), self.panels.len());
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
    let mark = if cut.is_flat_corner(ring) { Mark::Notch } else { cut.mark };
    Joint { mark, angle: cut.angle(ring), is_notched: cut.is_notched }
}

/// Cosine and sine of the chord of an atom against the warp.
fn along(points: &[Vec2], warp: Vec2) -> [f64; 2] {
    let chord = points[points.len() - 1] - points[0];
    let angle = wrapped(heading(chord) - heading(warp));
    [libm::cos(angle), libm::sin(angle)]
}
