//! The built-in stages, one module each.
//!
//! The data's way: `import_dxf` (or `import_mesh`) → `triangulate` → `assemble` → `stitch` → `drape` → `texture` →
//! exports, `flatten`, report.

pub mod builtin;
pub mod export_gltf;
pub mod export_obj;
pub mod import_mesh;
pub mod sewing;
pub mod texture;

pub use builtin::builtin;
