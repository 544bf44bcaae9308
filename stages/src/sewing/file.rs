//! The sewing file as a stage is given it.

use crate::text::utf8;
use std::path::Path;
use toile_garment::Diagnostic;
use toile_garment::sewing::SewingPlan;
use toile_stage_api::{StageContext, StageError};

/// Reads a sewing file.
///
/// # Errors
/// It is not there, no text, or wrong.
pub fn file(path: &Path, cx: &mut StageContext<'_>) -> Result<SewingPlan, StageError> {
    match sound_tables(path, cx)? {
        (Some(plan), errors) if errors.is_empty() => Ok(plan),
        (_, errors) => Err(StageError::Parameter(errors)),
    }
}

/// Those of its tables that are sound, and the mistakes of the others.
///
/// # Errors
/// It is not there, or no text.
pub fn sound_tables(
    path: &Path,
    cx: &mut StageContext<'_>,
) -> Result<(Option<SewingPlan>, Vec<Diagnostic>), StageError> {
    let name = path.to_string_lossy().into_owned();
    let bytes = cx.files.read(path)?;
    let text = utf8(path, &bytes)?;
    Ok(toile_formats::sewing::read_sound_tables(&text, &name))
}
