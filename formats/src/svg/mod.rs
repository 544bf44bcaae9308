//! Drawings as SVG text: patterns with numbered edges, flattened pieces over the originals.
//!
//! All lengths are millimetres, written with fixed decimals so that the same garment gives the same bytes.

pub mod canvas;
mod flat;
mod labels;
pub(crate) mod pattern;
mod spots;

pub use flat::{flat_piece, flat_sheet};
pub(crate) use labels::letters;
pub use pattern::{inward_normal, pattern, pattern_in, pickable};
pub use spots::Spot;
