//! Files that a person writes, as text.

use crate::codes::TEXT_NOT_UTF8;
use std::path::Path;
use toile_garment::{Diagnostic, SourceRef};
use toile_stage_api::StageError;

/// The bytes of a file as text.
///
/// # Errors
/// They are no UTF-8.
pub fn utf8(path: &Path, bytes: &[u8]) -> Result<String, StageError> {
    let name = path.to_string_lossy();
    let no_text = |e: std::str::Utf8Error| {
        let message = format!("{name} is not UTF-8 text: byte {} is wrong", e.valid_up_to());
        let finding = Diagnostic::error(TEXT_NOT_UTF8, message).at(SourceRef::file(&*name));
        StageError::input(finding.hint("save it as UTF-8"))
    };
    std::str::from_utf8(bytes).map(str::to_owned).map_err(no_text)
}
