//! Bytes to faithful models to the garment document: one module per file format.
pub mod fabric;
pub mod sewing;
mod toml_text;
