//! Writing OBJ: plain meshes, and the garment with a group for each piece.

use std::fmt::Write as _;
use toile_garment::garment::UpAxis;
use toile_garment::text::shown;
use toile_garment::{Garment, Vec3};

/// Why a garment cannot be written as OBJ.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GarmentObjError {
    /// No mesh, or no positions in 3D.
    #[error("the garment has no {0} yet")]
    Missing(&'static str),
    /// A position that is NaN or infinite.
    #[error("vertex {vertex} of piece `{piece}` is not a finite point")]
    NotFinite {
        /// Piece name.
        piece: String,
        /// Vertex in the piece.
        vertex: usize,
    },
}

/// Text of a mesh, line by line.
#[derive(Default)]
pub struct MeshText {
    text: String,
    vertices: usize,
    texture_vertices: usize,
}

impl MeshText {
    /// A comment line.
    pub fn comment(&mut self, words: &str) {
        let _ = writeln!(self.text, "# {}", words.replace(['\n', '\r'], " "));
    }

    /// Adds a group. Indices count from 0 inside the group. Numbers are written so that they read back bit-equal.
    pub fn group(&mut self, name: &str, positions: &[Vec3], uv: Option<&[[f64; 2]]>, triangles: &[[u32; 3]]) {
        if !name.is_empty() {
            let _ = writeln!(self.text, "g {}", shown(name, &[]).replace('#', "_"));
        }
        for p in positions {
            // −0 becomes 0: equal numbers give equal bytes.
            let _ = writeln!(self.text, "v {} {} {}", p.x + 0.0, p.y + 0.0, p.z + 0.0);
        }
        for [u, v] in uv.unwrap_or_default() {
            let _ = writeln!(self.text, "vt {} {}", u + 0.0, v + 0.0);
        }
        for t in triangles {
            self.text.push('f');
            for i in t {
                let _ = write!(self.text, " {}", self.vertices + *i as usize + 1);
                if uv.is_some() {
                    let _ = write!(self.text, "/{}", self.texture_vertices + *i as usize + 1);
                }
            }
            self.text.push('\n');
        }
        self.vertices += positions.len();
        self.texture_vertices += uv.map_or(0, <[_]>::len);
    }

    /// The whole text.
    #[must_use]
    pub fn finish(self) -> String {
        self.text
    }
}

/// A single mesh as OBJ text.
#[must_use]
pub fn write_mesh(name: &str, positions: &[Vec3], triangles: &[[u32; 3]]) -> String {
    let mut text = MeshText::default();
    text.group(name, positions, None, triangles);
    text.finish()
}

/// The garment: pieces one after the other, each in the vertex order of its mesh, `vt` in metres of cloth where the
/// piece has a flat layout. Positions are the drape, else the sewn or imported shape.
///
/// # Errors
/// See [`GarmentObjError`].
pub fn write_garment(garment: &Garment, up: UpAxis) -> Result<String, GarmentObjError> {
    let shape =
        garment.drape.as_ref().or(garment.stitched.as_ref()).ok_or(GarmentObjError::Missing("positions in 3D"))?;
    let mut text = MeshText::default();
    for (i, piece) in garment.pieces.iter().enumerate() {
        let mesh = piece.mesh.as_ref().ok_or(GarmentObjError::Missing("mesh"))?;
        let positions = shape.positions.get(i).ok_or(GarmentObjError::Missing("positions in 3D"))?;
        if let Some(vertex) = positions.iter().position(|p| !p.iter().all(|x| x.is_finite())) {
            return Err(GarmentObjError::NotFinite { piece: piece.name.clone(), vertex });
        }
        let turned: Vec<Vec3> = positions.iter().map(|p| up.to_file(*p)).collect();
        let uv = cloth_uv(garment, i);
        text.group(&piece.name, &turned, uv.as_deref(), &mesh.triangles);
    }
    Ok(text.finish())
}

fn cloth_uv(garment: &Garment, piece: usize) -> Option<Vec<[f64; 2]>> {
    let mesh = garment.pieces.get(piece)?.mesh.as_ref()?;
    if mesh.rest_corners.is_some() {
        return None;
    }
    let texture = garment.textures.as_ref().and_then(|t| t.pieces.get(piece)).map(|t| &t.uv_cloth);
    match texture {
        Some(uv) if uv.len() == mesh.rest.len() => Some(uv.clone()),
        _ => Some(mesh.rest.iter().map(|r| [r.x, r.y]).collect()),
    }
}
