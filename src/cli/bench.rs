//! Parts that `study`, `compare` and `validate` share: the chain that they run, and the folder that they write.

use super::args::PipelineArgs;
use super::console::Console;
use crate::codes::PATH_REFUSED;
use crate::engine::{Exit, RECORD_NAME, Stop, clean, unwritten, write_whole};
use crate::halt::Halt;
use crate::line::RESULTS_NAME;
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

/// Results go into a folder of their own, and into no other's. Their file has the key `kind`, and under `subject` the name.
pub(super) fn check_folder(
    out: &Path,
    (file, kind, subject): (&str, &str, &str),
    name: &str,
) -> Result<(), Diagnostic> {
    if let Some(other) = [RECORD_NAME, RESULTS_NAME].iter().find(|name| out.join(name).exists()) {
        let message = format!("`{}` holds a `{other}`: it is the folder of another command", clean(out));
        return Err(Diagnostic::error(PATH_REFUSED, message).hint("choose another folder with --out"));
    }
    let path = out.join(file);
    let Ok(bytes) = std::fs::read(&path) else { return Ok(()) };
    let there: Option<serde_json::Value> = serde_json::from_slice(&bytes).ok();
    if there.is_some_and(|v| v.get(kind).is_some() && v[subject] == name) {
        return Ok(());
    }
    let message = format!("`{}` holds a `{file}` that is not of {name}", clean(out));
    Err(Diagnostic::error(PATH_REFUSED, message).hint("choose another folder with --out"))
}

/// Refuses the folder of an earlier result, which is there where its file is.
pub(super) fn is_new(out: &Path, file: &str, what: &str) -> Result<(), Diagnostic> {
    if !out.join(file).exists() {
        return Ok(());
    }
    let message = format!("`{}` holds an earlier {what}", clean(out));
    Err(Diagnostic::error(PATH_REFUSED, message).hint("replace it with --force, or choose another folder with --out"))
}

/// Writes files of these names into a folder, which is made where it is missing.
///
/// # Errors
/// When the disk refuses.
pub(super) fn write_files(out: &Path, names: &[&str], texts: &[String]) -> Result<(), Halt> {
    let refused = |path: &Path, e: &std::io::Error| Halt::new(vec![unwritten(path, e)], Exit::System);
    std::fs::create_dir_all(out).map_err(|e| refused(out, &e))?;
    for (name, text) in names.iter().zip(texts) {
        let path = out.join(name);
        write_whole(&path, text.as_bytes()).map_err(|e| refused(&path, &e))?;
    }
    Ok(())
}

/// The result on stdout, and the paths of the files on stderr.
pub(super) fn tell(said: &str, out: &Path, names: &[&str], console: &mut Console<'_>) {
    console.result(said);
    for name in names {
        console.say(&format!("{}\n", crate::render::safe(&out.join(name).to_string_lossy())));
    }
}
