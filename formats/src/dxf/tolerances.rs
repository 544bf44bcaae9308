//! The distances and angles by which drawings are understood; every one can be set.

/// Tolerances of the reader.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerances {
    /// Gaps of an outline up to this are closed with a note, mm.
    pub gap: f64,
    /// An unmarked vertex that turns more is a corner, degrees.
    pub corner: f64,
    /// Chords keep this near the curve, mm.
    pub curve: f64,
    /// Loops up to this across, where a line crosses itself beside a corner, are cut off with a warning, mm.
    pub loops: f64,
}

impl Default for Tolerances {
    fn default() -> Self {
        Self { gap: 0.5, corner: 20.0, curve: 0.05, loops: 15.0 }
    }
}
