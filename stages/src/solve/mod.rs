//! Between garment words and the solver's plain arrays: the one place where both are known.

pub mod body_parts;
pub(crate) mod codes;
mod effects;
mod fabric;
pub mod level_cut;
pub mod lines;
pub mod place;
pub mod ranges;
pub mod scene;
pub mod watch;

pub use effects::effects;
pub use fabric::material;
pub use place::failure_in;
pub use scene::{Layout, layer_of, scene};
pub use watch::{Follow, MESH_ANEW, failure};
