//! The stage `flatten`: the 3D surface back to 2D pieces through the stored darts.
//!
//! Every piece is flattened on its own triangles: pieces and dart legs are separate vertex chains in the mesh, so
//! nothing has to be cut or searched. The lengths asked for come from [`metric`], [`solve`] finds the flat positions,
//! [`sewn`] keeps sewn edges equal, [`align`] lays the piece on its grain and [`figures`] measures.

pub mod align;
pub(crate) mod codes;
mod core;
pub mod energy;
pub mod features;
pub mod figures;
mod findings;
mod json;
pub mod metric;
mod params;
pub mod sewn;
pub mod solve;
mod stage;
#[cfg(test)]
mod surfaces;
pub mod system;

pub use self::core::flatten_garment;
pub use json::json;
pub use params::{FlattenParams, MetricChoice};
pub use stage::Flatten;
