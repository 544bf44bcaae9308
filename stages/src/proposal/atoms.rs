//! Outlines cut into atoms: stretches between corners, notches and the mouths of darts.
//!
//! A seam of a garment joins atoms to atoms. The legs of a dart belong to no atom: the atoms on both sides of its mouth
//! are neighbours, and the corner between them is measured with the dart closed.

pub use super::cuts::Mark;
use super::cuts::{Cut, Outline};
use super::profile::{Profile, bow, heading, profile, wrapped};
use super::tuning;
use crate::sewing::ring::Ring;
use std::ops::Range;
use toile_garment::Vec2;
use toile_garment::dart::DartKind;

impl Atom {
    /// Does it run along the warp?
    pub fn is_along(&self) -> bool {
        self.along[0].abs() > 0.8
    }

    /// Does it run across the warp?
    pub fn is_across(&self) -> bool {
        self.along[0].abs() < 0.5
    }

    /// Steps between its points, those over pleats left out.
    pub fn steps(&self) -> impl Iterator<Item = Vec2> + '_ {
        self.parts.iter().flat_map(|p| p.points.windows(2).map(|w| w[1] - w[0]))
    }

    /// True for a lower edge. Such an edge runs from left to right with the cloth above it, across the warp.
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

impl Joint {
    /// True for a corner of the outline.
    pub fn is_corner(&self) -> bool {
        self.mark == Mark::Corner
    }
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
    /// Points from start to end, with those on both sides of every pleat.
    pub points: Vec<Vec2>,
    /// The stretches between pleats that it is made of.
    pub parts: Vec<Part>,
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

/// A stretch of outline without a pleat.
#[derive(Clone, Debug)]
pub struct Part {
    /// Start on the ring, metres of arc.
    pub from: f64,
    /// End on the ring, counter-clockwise from the start.
    pub to: f64,
    /// Points from start to end.
    pub points: Vec<Vec2>,
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
    /// The stretches between the cuts of outlines.
    pub fn of(outlines: &[Outline<'_>]) -> Self {
        let mut out = Self::default();
        outlines.iter().for_each(|o| out.add(o));
        out
    }

    fn add(&mut self, outline: &Outline<'_>) {
        let Outline { index, piece, ring, warp, cuts } = outline;
        let (index, first, panel) = (*index, self.atoms.len(), self.panels.len());
        let n = cuts.len();
        let warp = *warp;
        for k in 0..n {
            let (here, after) = (&cuts[k], &cuts[(k + 1) % n]);
            let parts = parts(ring, here.start, after.end);
            let points: Vec<Vec2> = parts.iter().flat_map(|p| p.points.iter().copied()).collect();
            let closed = closed(&parts);
            let length = closed.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
            let course = profile(&closed);
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
                parts,
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

/// The stretches between pleats from one position to another; the whole ring where they are one.
fn parts(ring: &Ring, from: f64, to: f64) -> Vec<Part> {
    let length = way(ring, from, to);
    let pleats = ring.gaps_between(from, length).into_iter().filter(|(.., gap)| gap.kind == DartKind::Pleat);
    let mouths = pleats.flat_map(|(_, _, gap)| [ring.arc[gap.from], ring.arc[gap.to]]);
    let ends: Vec<f64> = std::iter::once(from).chain(mouths).chain([to]).collect();
    ends.chunks(2).map(|e| Part { from: e[0], to: e[1], points: walk(ring, e[0], e[1]) }).collect()
}

/// The points of a line whose pleats are closed: every part begins where the one before it ends.
fn closed(parts: &[Part]) -> Vec<Vec2> {
    let mut out: Vec<Vec2> = Vec::new();
    for part in parts {
        let shift = out.last().map_or(Vec2::zeros(), |end| end - part.points[0]);
        let is_first = out.is_empty();
        out.extend(part.points.iter().skip(usize::from(!is_first)).map(|p| p + shift));
    }
    out
}

/// Length from one position to another; that of the whole ring where they are one.
fn way(ring: &Ring, from: f64, to: f64) -> f64 {
    match ring.ahead(from, to) {
        d if d > 0.0 => d,
        _ => ring.total(),
    }
}

/// The points of a ring from one position to another; the whole ring where they are one.
fn walk(ring: &Ring, from: f64, to: f64) -> Vec<Vec2> {
    let length = way(ring, from, to);
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
