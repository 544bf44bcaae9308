//! The report: one set of tables, as JSON, as drawing and as one self-contained HTML page.
//!
//! Millimetres, square centimetres, percent and degrees with fixed decimals; no clock, no machine facts.

mod html;
mod json;
mod stats;
mod tables;

pub use html::html;
pub use json::json;
pub use tables::{Cell, Table, tables};

use crate::svg;
use toile_garment::Garment;

/// The drawing of the report: flattened pieces over the originals, or the pattern where nothing was flattened.
#[must_use]
pub fn drawing(garment: &Garment) -> String {
    svg::flat_sheet(garment).unwrap_or_else(|| svg::pattern(&garment.pieces, &garment.style))
}
