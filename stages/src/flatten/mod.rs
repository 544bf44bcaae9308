//! The stage `flatten`: the 3D surface back to 2D pieces through the stored darts.
//!
//! Every piece is flattened on its own triangles: pieces and dart legs are separate vertex chains in the mesh, so
//! nothing has to be cut or searched. Lengths asked for come from [`wanted`], and flat positions from [`solve`].
//! Sewn edges are kept equal by [`sewn`]. [`held_lines`], [`pleats`] and [`dart_strain`] say what is locked, and [`lock`] holds it.
//! [`symmetry`] makes mirrored pieces one, [`align`] lays the pieces on their grain and [`figures`] measures.

mod advice;
pub mod align;
pub mod blur;
pub(crate) mod codes;
mod core;
pub mod dart_strain;
pub mod energy;
mod factor;
pub mod features;
pub mod figures;
mod findings;
pub mod held_lines;
mod json;
pub mod lock;
pub mod metric;
pub mod mirror;
pub mod overlaps;
mod params;
pub mod pleats;
pub mod point_location;
pub mod roughness;
mod seam_stations;
pub mod sewn;
pub mod solve;
pub mod source;
mod stage;
#[cfg(test)]
mod surfaces;
pub mod symmetry;
pub mod system;
mod tolerance;
mod verdict;
pub mod wanted;

pub use self::core::{Fit, Watch, fitted, flatten_garment};
pub use json::json;
pub use params::{FlattenParams, FlattenTolerance, LockKind, MetricChoice, SymmetryChoice};
pub use stage::Flatten;
pub use symmetry::is_symmetric;
