//! Wavefront OBJ: bodies, cloth meshes, and the draped garment.
//!
//! `tobj` reads bodies ([`read_geometry`]). Cloth of `import-mesh` comes from a scan of ours ([`read`]), as its vertex
//! order, texture vertices and groups are a contract. A test and a fuzz target hold both readings against each other.

pub(crate) mod codes;
mod geometry;
mod inspect;
mod polygon;
mod scan;
#[cfg(test)]
mod tests;
mod write;

use crate::codes::FILE_TOO_LARGE;
use std::collections::BTreeMap;
use toile_garment::{Diagnostic, SourceRef, Vec3};

pub use geometry::read_geometry;
pub use inspect::inspect;
pub use write::{GarmentObjError, MeshText, write_garment, write_mesh};

/// Largest OBJ file, bytes.
pub const MAX_BYTES: usize = 256 << 20;
/// Most vertices, texture vertices or triangles.
pub const MAX_ITEMS: usize = 5_000_000;
/// Most corners of one face.
pub const MAX_POLYGON: usize = 10_000;
/// Largest coordinate, metres.
pub const MAX_COORDINATE: f64 = 1e9;

/// Triangles that follow a `g` or `o` line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ObjGroup {
    /// Name as written.
    pub name: String,
    /// Index of its first triangle.
    pub first: usize,
}

/// An OBJ file: vertices in file order, faces cut into triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ObjMesh {
    /// `v` lines in file order, in the file's own axes and units.
    pub positions: Vec<Vec3>,
    /// `vt` lines in file order.
    pub texcoords: Vec<[f64; 2]>,
    /// Triangles, by vertex, in file order.
    pub triangles: Vec<[u32; 3]>,
    /// The same triangles by texture vertex, when every corner has one.
    pub uv_triangles: Option<Vec<[u32; 3]>>,
    /// Groups and objects.
    pub groups: Vec<ObjGroup>,
    /// Material names in order of first use.
    pub materials: Vec<String>,
    /// `f` lines.
    pub faces: usize,
    /// Faces with more than three corners.
    pub polygons: usize,
    /// Lines that carry nothing for us, by keyword.
    pub ignored: BTreeMap<String, u64>,
    /// Notes and warnings.
    pub findings: Vec<Diagnostic>,
}

impl ObjMesh {
    /// Lowest and highest corner of the box around all vertices.
    #[must_use]
    pub fn bounds(&self) -> Option<[Vec3; 2]> {
        let first = *self.positions.first()?;
        Some(self.positions.iter().fold([first, first], |[lo, hi], p| [lo.inf(p), hi.sup(p)]))
    }
}

/// Reads an OBJ file. `file` is its name for messages.
///
/// # Errors
/// The first twenty mistakes, each with its line, and a count of the others.
pub fn read(bytes: &[u8], file: &str) -> Result<ObjMesh, Vec<Diagnostic>> {
    if bytes.len() > MAX_BYTES {
        let message = format!("the file has {} bytes, over the limit of {MAX_BYTES}", bytes.len());
        return Err(vec![Diagnostic::error(FILE_TOO_LARGE, message).at(SourceRef::file(file))]);
    }
    polygon::mesh(scan::scan(bytes, file)?, file).map_err(|d| vec![*d])
}
