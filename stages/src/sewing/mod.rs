//! The meaning of the sewing file for the pieces: copies, edge names, declared darts, and seams resolved to outline runs.
//!
//! `import-dxf` asks here to check a sewing file, `triangulate` to lay down vertices, `assemble` to sew them. All three
//! look at the document as it is then, and find the same: nothing that is derived is kept in it.

mod apply;
pub(crate) mod codes;
mod edge_part;
pub mod edges;
mod file;
pub(crate) mod lookup;
pub mod marks;
pub mod resolve;
pub mod ring;
pub mod sewn_points;
pub mod shapes;
pub mod turned;

pub use apply::{apply, apply_deciding, copies, darts, folds};
pub use file::{file, sound_tables};
pub(crate) use lookup::nearest;
