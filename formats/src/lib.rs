//! Bytes to faithful models to the garment document: one module per file format.
pub mod report;
pub mod sewing;
pub mod svg;
