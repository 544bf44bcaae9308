//! Bytes to faithful models to the garment document: one module per file format.
pub mod body;
pub mod dxf;
pub mod fabric;
pub mod obj;
pub mod encoding;
pub mod rul;
pub mod sewing;
mod toml_text;
