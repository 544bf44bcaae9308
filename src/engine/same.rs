//! Do two paths name one file? An output never replaces an input of the same run.

use super::gate::{Gate, refused};
use super::preflight::planned_inputs;
use crate::pipeline::Pipeline;
use std::path::{Path, PathBuf};
use toile_stage_api::FileError;

/// Does a path lead to the file with this real path?
#[must_use]
pub fn is_same(path: &Path, real: &Path) -> bool {
    path == real || path.canonicalize().is_ok_and(|p| p == real)
}

/// Refuses an output that is an input.
///
/// # Errors
/// [`FileError::Refused`] where they are one file.
pub fn refuse_input(output: &Path, inputs: &[PathBuf]) -> Result<(), FileError> {
    if inputs.iter().any(|input| is_same(output, input)) {
        let reason = "this run reads it, and an output never replaces an input; give the output another name or folder";
        return Err(refused(output, reason));
    }
    Ok(())
}

/// Real paths of the inputs that are known before the work: the pipeline file, programs of plugins, and what parameters
/// name.
#[must_use]
pub fn known_inputs(pipeline: &Pipeline<'_>, gate: &Gate, pipeline_file: &Path) -> Vec<PathBuf> {
    let beside = |name: &Path| gate.base().join(name).canonicalize().ok();
    let named = planned_inputs(&pipeline.steps).filter_map(|input| gate.input(Path::new(&input.text)).ok());
    let own = pipeline_file.canonicalize().ok().or_else(|| beside(Path::new(pipeline_file.file_name()?)));
    let programs = pipeline.programs.iter().filter_map(|p| beside(p)).filter(|p| p.is_file());
    own.into_iter().chain(programs).chain(named).collect()
}
