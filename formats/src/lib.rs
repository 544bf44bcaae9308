//! Bytes to faithful models to the garment document: one module per file format.
pub mod dxf;
pub mod encoding;
pub mod rul;
pub mod sewing;
