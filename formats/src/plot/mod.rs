//! The pattern at its true size, for printers, plotters and drawing programs: strokes and texts by layer, laid out on a
//! sheet of millimetres, written as SVG, as PDF in tiles, or as HPGL.

pub(crate) mod codes;
mod hpgl;
mod lay;
mod letters;
mod pdf;
mod strokes;
mod svg;
#[cfg(test)]
mod tests;

pub use hpgl::hpgl;
pub use lay::{Sheet, lay};
pub use letters::{Font, Letters, spell};
pub use pdf::{Paper, pdf};
pub use svg::svg;

use toile_garment::Vec2;

/// The kind of a stroke; each kind is a layer of the drawing and a pen of the plotter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Layer {
    /// Cut line.
    Cut,
    /// Sew line.
    Sew,
    /// Internal lines and cutouts.
    Internal,
    /// Legs of darts that the outline does not follow.
    Dart,
    /// Notches.
    Notch,
    /// Drill holes.
    Drill,
    /// Grain line, fold, stripe and plaid lines.
    Grain,
    /// Names, and the scale.
    Text,
}

impl Layer {
    /// All of them, in the order they are drawn.
    pub const ALL: [Self; 8] =
        [Self::Cut, Self::Sew, Self::Internal, Self::Dart, Self::Notch, Self::Drill, Self::Grain, Self::Text];

    /// Name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Cut => "cut",
            Self::Sew => "sew",
            Self::Internal => "internal",
            Self::Dart => "dart",
            Self::Notch => "notch",
            Self::Drill => "drill",
            Self::Grain => "grain",
            Self::Text => "text",
        }
    }

    /// Width of its line, mm.
    fn width(self) -> f64 {
        if self == Self::Cut { 0.5 } else { 0.25 }
    }

    /// Lengths of dashes and gaps, mm.
    fn dashes(self) -> &'static [f64] {
        match self {
            Self::Sew => &[4.0, 2.0],
            Self::Internal => &[8.0, 2.0, 1.0, 2.0],
            _ => &[],
        }
    }
}

/// A line of a layer, mm, y upwards.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// Layer.
    pub layer: Layer,
    /// Points.
    pub points: Vec<Vec2>,
    /// Joined at the ends?
    pub closed: bool,
}

/// A text, mm, centred at its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// Middle of its base line.
    pub at: Vec2,
    /// Height of its letters.
    pub height: f64,
    /// One line.
    pub text: String,
}
