//! What `study` and `compare` share: the chain that they run, and the folder that they write.

use super::args::PipelineArgs;
use crate::codes::{PATH_REFUSED, WRITE_FAILED};
use crate::engine::{Exit, Stop, clean, write_whole};
use crate::halt::Halt;
use crate::load;
use crate::pipeline::knob;
use std::path::Path;
use std::sync::Arc;
use toile_garment::Diagnostic;
use toile_stage_api::{Meaning, Registry};

/// The facts about the chain that are known before anything runs.
pub(super) struct Chain {
    /// Product line and version.
    pub name: String,
    /// The same as part of a file name.
    pub file_name: String,
    /// Does a stage set the length of mesh edges?
    pub has_mesh_stage: bool,
}

impl Chain {
    /// Reads the pipeline.
    ///
    /// # Errors
    /// When it is wrong.
    pub fn look(pipeline: &PipelineArgs, registry: &mut Registry, stop: &Arc<Stop>) -> Result<Self, Halt> {
        let loaded = load::load(&pipeline.request(), stop, registry);
        let exit = loaded.exit();
        let source = loaded.text().map(|(file, text)| (file.to_owned(), text.to_owned()));
        match loaded.pipeline {
            Some(pipeline) if exit == Exit::Good => Ok(Self {
                name: format!("{} v{}", pipeline.line, pipeline.version),
                file_name: format!("{}-v{}", pipeline.line, pipeline.version),
                has_mesh_stage: pipeline.steps.iter().any(|s| knob(s.ready.knobs(), Meaning::EdgeLength).is_some()),
            }),
            _ => Err(Halt { findings: loaded.report.findings, source, exit }),
        }
    }
}

/// A study or a comparison goes into its own folder, and into no other's. Its file has the key.
pub(super) fn check_folder(out: &Path, (file, key): (&str, &str), name: &str) -> Result<(), Diagnostic> {
    let path = out.join(file);
    let Ok(bytes) = std::fs::read(&path) else { return Ok(()) };
    let there: Option<serde_json::Value> = serde_json::from_slice(&bytes).ok();
    if there.is_some_and(|v| v.get(key).is_some() && v["pipeline"] == name) {
        return Ok(());
    }
    let message = format!("`{}` holds a `{file}` that is not of {name}", clean(out));
    Err(Diagnostic::error(PATH_REFUSED, message).hint("choose another folder with --out"))
}

/// Writes files of these names.
///
/// # Errors
/// When the disk refuses.
pub(super) fn write_files(out: &Path, names: &[&str], texts: &[String]) -> Result<(), Halt> {
    for (name, text) in names.iter().zip(texts) {
        write_whole(&out.join(name), text.as_bytes()).map_err(|e| {
            let message = format!("cannot write `{}`: {e}", clean(&out.join(name)));
            Halt::new(vec![Diagnostic::error(WRITE_FAILED, message)], Exit::System)
        })?;
    }
    Ok(())
}
