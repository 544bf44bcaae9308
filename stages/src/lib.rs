//! The built-in stages, one module each.
//!
//! The data's way: `import_dxf` (or `import_mesh`) → `triangulate` → `assemble` → `stitch` → `drape` (→ `animate`) →
//! `texture` → exports, `flatten`, report.

#[macro_use]
#[path = "../../formats/garment/src/code_list.rs"]
mod code_list;

pub mod allowance;
pub mod alter;
pub mod animate;
pub mod arrange;
pub mod assemble;
pub mod body;
pub mod builtin;
pub mod codes;
pub mod drape;
#[cfg(feature = "experiments")]
pub mod experiment;
pub mod export_dxf;
pub mod export_gltf;
pub mod export_obj;
pub mod export_picture;
pub mod export_print;
pub mod export_report;
pub mod fabric_check;
pub mod fabric_test;
pub mod fit;
pub mod flatten;
pub mod import_dxf;
pub mod import_garment;
pub mod import_garmentcode;
pub mod import_mesh;
pub mod joined;
pub mod proposal;
pub mod roles;
pub mod sewing;
mod solve;
pub mod stitch;
#[cfg(test)]
mod testing;
pub mod text;
pub mod texture;
pub mod transfer;
pub mod triangulate;

pub use builtin::builtin;
