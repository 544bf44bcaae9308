//! The report: one set of tables, as JSON, as drawing and as one self-contained HTML page.
//!
//! Millimetres, square centimetres, percent and degrees with fixed decimals; no clock, no machine facts. The page holds
//! a model of the garment in 3D and a small viewer (`page/`), and pictures that stand where the viewer cannot run.

pub mod accuracy;
mod catalogue;
mod checks;
mod chinese;
mod first;
mod fit;
mod html;
mod json;
mod live;
mod motion;
mod notches;
mod pages;
mod places;
mod standard;
mod stats;
mod tables;
mod translated;
mod verdict;
pub mod viewer;
mod words;

pub use chinese::findings as findings_in_chinese;
pub use fit::{Balance, Fit, FreeEdge, Length, Level, Measure, PieceSize, Point};
pub use html::html;
pub use json::json;
pub use live::model;
pub(crate) use notches::pick_name;
pub use tables::{Cell, Table, tables};
pub use verdict::{Verdict, verdict};
pub use words::{Language, Phrase};

use crate::svg;
use toile_garment::Garment;

/// The drawing of the report: flattened pieces over the originals, or the pattern where nothing was flattened.
#[must_use]
pub fn drawing(garment: &Garment, language: Language) -> String {
    svg::flat_sheet(garment, language).unwrap_or_else(|| svg::pattern_in(&garment.pieces, &garment.style, language))
}
