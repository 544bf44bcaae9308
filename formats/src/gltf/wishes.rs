//! The wishes for a GLB.

use crate::picture::Field;

/// The garment document in the GLB.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Carried {
    /// Packed: small, read by this program.
    #[default]
    Packed,
    /// JSON text, for programs that read it themselves.
    Plain,
    /// No document: the pattern stays at home, and the GLB cannot be flattened.
    Nothing,
}

/// The wishes for a GLB. What is not wished costs nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wishes<'f> {
    /// The garment document.
    pub document: Carried,
    /// A node `body` with the body's mesh.
    pub body: bool,
    /// For every piece a node `PIECE wrong side`: the cloth as thick as its fabric, with its edges.
    pub thickness: bool,
    /// A node `seams` with lines: seams, darts and free edges.
    pub lines: bool,
    /// Texture coordinates in repeats of the bitmap, for viewers without `KHR_texture_transform`.
    pub repeats: bool,
    /// Vertices and triangles packed after `EXT_meshopt_compression`.
    pub squeezed: bool,
    /// A quantity as colours of the vertices, instead of the cloth.
    pub field: Option<&'f Field>,
}
