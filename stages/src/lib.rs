//! The built-in stages, one module each.
//!
//! The data's way: `import_dxf` (or `import_mesh`) → `triangulate` → `assemble` → `stitch` → `drape` → `texture` →
//! exports, `flatten`, report.

pub mod assemble;
pub mod builtin;
pub mod sewing;
#[cfg(test)]
mod testing;
pub mod triangulate;

pub use builtin::builtin;
