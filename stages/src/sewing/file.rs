//! The sewing file as a stage is given it.

use super::codes;
use std::path::Path;
use toile_garment::sewing::SewingPlan;
use toile_garment::{Diagnostic, SourceRef};
use toile_stage_api::{StageContext, StageError};

/// Reads a sewing file.
///
/// # Errors
/// It is not there, no text, or wrong.
pub fn file(path: &Path, cx: &mut StageContext<'_>) -> Result<SewingPlan, StageError> {
    let name = path.to_string_lossy().into_owned();
    let bytes = cx.files.read(path)?;
    let text = String::from_utf8(bytes).map_err(|_| {
        let text = format!("the sewing file `{name}` is not UTF-8 text");
        StageError::parameter(Diagnostic::error(codes::SEWING_FILE, text).at(SourceRef::file(name.clone())))
    })?;
    toile_formats::sewing::read(&text, &name).map_err(StageError::Parameter)
}
