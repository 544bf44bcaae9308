//! Files that a person writes, as text.

use crate::codes::TEXT_NOT_UTF8;
use std::path::Path;
use toile_garment::{Diagnostic, SourceRef};
use toile_stage_api::StageError;

/// The bytes of a file as text. `name` is the name of the file for messages.
///
/// # Errors
/// They are no UTF-8. The finding tells the first wrong byte.
pub fn text(name: &str, bytes: &[u8]) -> Result<String, Diagnostic> {
    std::str::from_utf8(bytes).map(str::to_owned).map_err(|e| {
        let message = format!("{name} is not UTF-8 text: byte {} is wrong", e.valid_up_to());
        Diagnostic::error(TEXT_NOT_UTF8, message).at(SourceRef::file(name)).hint("save it as UTF-8")
    })
}

/// The bytes of an input of a stage as text.
///
/// # Errors
/// See [`text`].
pub fn utf8(path: &Path, bytes: &[u8]) -> Result<String, StageError> {
    text(&path.to_string_lossy(), bytes).map_err(StageError::input)
}
