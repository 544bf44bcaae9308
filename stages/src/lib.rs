//! The built-in stages, one module each.
//!
//! The data's way: `import_dxf` (or `import_mesh`) → `triangulate` → `assemble` → `stitch` → `drape` → `texture` →
//! exports, `flatten`, report.

pub mod builtin;
pub mod export_dxf;
pub mod sewing;

pub use builtin::builtin;
