//! Bytes to faithful models to the garment document: one module per file format.

#[macro_use]
#[path = "../garment/src/code_list.rs"]
mod code_list;

pub mod allowance;
pub mod body;
pub mod codes;
pub mod dxf;
pub mod encoding;
pub mod fabric;
pub mod garment_file;
pub mod garmentcode;
pub mod gltf;
pub mod measures;
pub mod normals;
pub mod obj;
pub mod picture;
pub mod plot;
pub mod report;
pub mod rul;
#[cfg(test)]
mod sample;
mod schema;
pub mod sewing;
pub mod svg;
pub mod texture;
mod toml_text;
