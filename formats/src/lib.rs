//! Bytes to faithful models to the garment document: one module per file format.
pub mod body;
pub mod fabric;
pub mod gltf;
pub mod obj;
#[cfg(test)]
mod sample;
pub mod sewing;
pub mod texture;
mod toml_text;
