//! `transfer`: moves a draped garment from its body to another one, so that `flatten` gives the pattern for that body.
//!
//! Every part of the body has a chart: an axis and, at every height, the outline that a tape around it has.
//! A point of cloth keeps its distance from this outline, its direction from the axis, and its place between the
//! landmarks. So the garment keeps its ease. Such a transfer that keeps the design is that of Brouet, Sheffer,
//! Boissieux, Cani, "Design preserving garment transfer", 2012, with a map of the body in place of an optimisation.

mod body_map;
mod chart;
mod heights;
mod stage;
#[cfg(test)]
mod tests;

pub use body_map::BodyMap;
pub use heights::LEVELS;
pub(crate) use stage::CODES;
pub use stage::{Transfer, TransferParams, transferred};
