//! Bytes to faithful models to the garment document: one module per file format.
pub mod body;
pub mod fabric;
pub mod gltf;
pub mod obj;
pub mod sewing;
mod toml_text;
