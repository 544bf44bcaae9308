//! A garment from a file, whichever form it has: a GLB of this program, also edited, or a garment document.

use crate::codes::GARMENT_FILE;
use crate::gltf::{self, codes::SHAPE_EDITED};
use toile_garment::{Diagnostic, Garment, Report, SourceRef, bundle};

/// Reads a GLB or a garment document. `file` is its name for messages.
///
/// # Errors
/// When it is neither, or damaged.
pub fn read(bytes: &[u8], file: &str, report: &mut Report) -> Result<Garment, Diagnostic> {
    let wrong = |message: String| Diagnostic::error(GARMENT_FILE, message).at(SourceRef::file(file.to_owned()));
    let body = bytes.trim_ascii_start();
    if body.starts_with(b"glTF") {
        let read = gltf::read_garment_with_findings(bytes).map_err(|e| gltf::refused(&e, file))?;
        report.findings.extend(read.findings);
        return Ok(read.garment);
    }
    if body.starts_with(b"{") {
        let read = document(bytes).map_err(wrong)?;
        if read.is_edited {
            let message =
                "the positions of this document were edited after its certificate was given, which is left out";
            report.push(Diagnostic::info(SHAPE_EDITED, message.to_owned()).at(SourceRef::file(file.to_owned())));
        }
        return Ok(read.garment);
    }
    Err(wrong(format!("`{file}` is no garment file"))
        .hint("give a GLB that `export-gltf` wrote, or a garment document"))
}

/// Reads the 3D shape of a GLB into the garment of another file, `document`: an editor that saves a GLB again may leave
/// its document out. Both files come with their names for messages.
///
/// # Errors
/// When either is not what it should be, or the shape belongs to another garment.
pub fn read_by_document(
    (bytes, file): (&[u8], &str),
    (document, original): (&[u8], &str),
    report: &mut Report,
) -> Result<Garment, Diagnostic> {
    if !bytes.trim_ascii_start().starts_with(b"glTF") {
        let message = format!("`{file}` is no GLB, so no document of another file belongs to it");
        return Err(Diagnostic::error(GARMENT_FILE, message).at(SourceRef::file(file.to_owned())));
    }
    let garment = stored(document, original)?;
    let read = gltf::read_shape_of(garment, bytes).map_err(|e| gltf::refused(&e, file))?;
    report.findings.extend(read.findings);
    Ok(read.garment)
}

/// The garment of a document, or the one stored in a GLB without regard to its shape now.
fn stored(bytes: &[u8], file: &str) -> Result<Garment, Diagnostic> {
    if bytes.trim_ascii_start().starts_with(b"glTF") {
        return gltf::read_stored_garment(bytes).map_err(|e| gltf::refused(&e, file));
    }
    read(bytes, file, &mut Report::default())
}

/// Reads a garment document.
///
/// # Errors
/// The reason in words.
pub fn document(bytes: &[u8]) -> Result<bundle::Read, String> {
    let text = std::str::from_utf8(bytes).map_err(|e| format!("no UTF-8 text: {e}"))?;
    bundle::read(text).map_err(|e| e.to_string())
}
