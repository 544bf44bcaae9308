//! The dart as drawn, and the record of a look-alike that was denied.

use super::thresholds::{POINTS_OF_DART, POINTS_THAT_HALVE_DOUBT, RANGE_OF_CONFIDENCE};
use crate::dxf::geom;
use toile_garment::Vec2;

/// Tells what to do about a look-alike that was not taken, where no single dart can be written down.
pub(super) const DECLARE: &str =
    "if it is a dart, declare it in the sewing file: [[dart]] piece, apex, mouth, kind = \"wedge\"";

/// How a dart was drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Wedge in the outline.
    Wedge,
    /// Legs as internal lines, the outline runs over the mouth.
    Marked,
    /// Closed lens inside the piece.
    Lens,
}

/// A dart as drawn, mm.
#[derive(Clone, Debug)]
pub struct DrawnDart {
    /// Form.
    pub form: Form,
    /// One apex, two for a lens.
    pub apexes: Vec<Vec2>,
    /// Mouth, or widest points.
    pub mouth: [Vec2; 2],
    /// Legs as drawn.
    pub legs: [Vec<Vec2>; 2],
    /// Legs on the working line. Where a lens is open to the edge they go on to the edge.
    pub work: [Vec<Vec2>; 2],
    /// A lens whose lower tip is cut open to the edge: `mouth` and `legs` then end at its widest place.
    pub open_lens: bool,
    /// `cut`, `sew` or `internal`.
    pub on: &'static str,
    /// Line in the file.
    pub line: u64,
    /// Entities that are its legs (marked darts and lenses).
    pub ids: Vec<u32>,
    /// Evidence for it and against it.
    pub evidence: Vec<Evidence>,
}

/// One reason for a dart or against it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Evidence {
    /// Points for it; those against it are negative.
    pub points: i32,
    /// The reason.
    pub why: &'static str,
}

/// A look-alike that is no dart.
#[derive(Clone, Debug, PartialEq)]
pub struct Denied {
    /// Its apex, or the middle of a lens.
    pub at: Vec2,
    /// Why it is none.
    pub why: &'static str,
    /// The form it looks like.
    pub form: Form,
}

impl Form {
    /// The layer that findings name.
    pub(super) fn layer(self) -> &'static str {
        if self == Self::Marked { "8" } else { "1" }
    }
}

impl DrawnDart {
    /// Adds evidence.
    pub(super) fn add(&mut self, points: i32, why: &'static str) {
        self.evidence.push(Evidence { points, why });
    }

    /// Points of all evidence: what speaks for it less what speaks against it.
    #[must_use]
    pub fn points(&self) -> i32 {
        self.evidence.iter().map(|e| e.points).sum()
    }

    /// All reasons, for it and against it.
    #[must_use]
    pub fn reasons(&self) -> Vec<&'static str> {
        self.evidence.iter().map(|e| e.why).collect()
    }

    /// The last reason that speaks against it.
    pub(super) fn objection(&self) -> Option<&'static str> {
        self.evidence.iter().rev().find(|e| e.points < 0).map(|e| e.why)
    }

    /// Does its evidence make it a dart?
    pub(super) fn is_sure(&self) -> bool {
        self.points() >= POINTS_OF_DART
    }

    /// How sure it is a dart, 0 to 1: a few points halve the doubt.
    #[must_use]
    pub fn confidence(&self) -> f64 {
        let doubt = libm::exp2(-f64::from(self.points()) / POINTS_THAT_HALVE_DOUBT);
        (1.0 - doubt).clamp(*RANGE_OF_CONFIDENCE.start(), *RANGE_OF_CONFIDENCE.end())
    }

    /// Length of a leg along its path, mm.
    #[must_use]
    pub fn leg_path(&self, leg: usize) -> f64 {
        geom::length(if self.open_lens { &self.legs[leg] } else { &self.work[leg] }, false)
    }

    /// Straight length of a leg, mm.
    #[must_use]
    pub fn leg_chord(&self, leg: usize) -> f64 {
        match (self.legs[leg].first(), self.legs[leg].last()) {
            (Some(a), Some(b)) => (a - b).norm(),
            _ => 0.0,
        }
    }

    /// Middle of its mouth and apexes.
    #[must_use]
    pub fn middle(&self) -> Vec2 {
        (self.mouth[0] + self.mouth[1]) * 0.5
    }

    /// Width of the mouth, mm.
    #[must_use]
    pub fn width(&self) -> f64 {
        (self.mouth[1] - self.mouth[0]).norm()
    }
}
