//! What the sewing file means for the pieces: copies, edge names, declared darts, and seams resolved to outline runs.
//!
//! `triangulate` and `assemble` both ask here, so that the vertices the first lays down are the vertices the second sews.

mod apply;
mod file;
mod lookup;
pub mod resolve;
pub mod ring;
pub mod shapes;
pub mod turned;

pub use apply::apply;
pub use file::file;
