//! GLB: the garment for looking at, with the whole document inside.
//!
//! `write` makes it, `read` gives the garment back from the GLB alone, even after somebody moved its vertices.
//! Files of others are checked by `container` and `check` before the `gltf` crate sees them: it panics on some.

mod check;
pub(crate) mod codes;
mod container;
mod document;
mod extra;
mod geometry;
mod inspect;
mod material;
mod motion;
mod moving;
mod pack;
mod read;
mod squeeze;
mod surface;
#[cfg(test)]
mod tests;
mod track;
mod variants;
mod view;
mod wishes;
mod write;

use crate::codes::GARMENT_FILE;
pub use inspect::inspect;
pub use moving::{Moving, read_moving};
pub use read::{ReadGarment, read_garment, read_garment_with_findings, read_shape_of, read_stored_garment};
pub use view::{ViewPiece, write_view};
pub use wishes::{Carried, Wishes};
pub use write::{WriteError, write_garment, write_garment_with};

use toile_garment::{Diagnostic, SourceRef};

const NO_DOCUMENT_HELP: &str = "editors such as Blender leave the document out; name the GLB that was edited, or its \
    garment document: `--document ORIGINAL.glb` of `toile flatten`, `document` of `import-garment`";

/// A refused GLB as a finding; `file` is its name.
#[must_use]
pub fn refused(error: &ReadError, file: &str) -> Diagnostic {
    let code = match error {
        ReadError::Container(_) | ReadError::Damaged(_) => codes::GLB_DAMAGED,
        _ => GARMENT_FILE,
    };
    let finding = Diagnostic::error(code, error.to_string()).at(SourceRef::file(file));
    match error {
        ReadError::NoDocument => finding.hint(NO_DOCUMENT_HELP),
        _ => finding,
    }
}

/// Largest GLB that is read, bytes.
pub const MAX_BYTES: usize = 512 << 20;

/// Why a GLB was refused.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// Not a GLB, or cut off, or with lengths that cannot be.
    #[error("this is no sound GLB: {0}")]
    Container(String),
    /// Its JSON breaks the format or a limit.
    #[error("the glTF inside is damaged: {0}")]
    Damaged(String),
    /// It is sound, but not one of ours.
    #[error("the GLB holds no garment document (extras.toile of the asset)")]
    NoDocument,
    /// The garment document inside cannot be read.
    #[error("the garment document in the GLB cannot be read: {0}")]
    Document(String),
    /// The 3D shape cannot be matched with the document.
    #[error("{0}")]
    Geometry(String),
}
