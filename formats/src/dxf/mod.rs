//! DXF-AAMA and DXF-ASTM pattern files.
pub mod write;
