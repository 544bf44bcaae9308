//! One stage without a pipeline.

use super::gate::clean;
use super::stop::Stop;
use crate::codes::NEEDS_NOT_GIVEN;
use crate::progress::Teller;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toile_garment::{Diagnostic, Garment, Report};
use toile_stage_api::{FileError, Files, ReadyStage, Registry, StageContext, StageError};
use toml::de::ValueDeserializer;

/// Runs one stage with its parameters as a TOML value. It reads what `files` was given alone; what it writes stays in memory.
///
/// # Errors
/// Those of the stage, and of its parameters.
pub fn run_alone(
    registry: &Registry,
    (name, params): (&str, &str),
    garment: Garment,
    stop: &Arc<Stop>,
    report: &mut Report,
    files: &mut Memory,
) -> Result<Garment, StageError> {
    let stage = registry.get(name).ok_or_else(|| StageError::Unsupported(format!("there is no stage `{name}`")))?;
    let wrong = |message: &str| StageError::parameter(crate::pipeline::refused_value(message));
    let params = ValueDeserializer::parse(params).map_err(|e| wrong(e.message()))?;
    let ready = stage.configure(params).map_err(|e| wrong(e.message()))?;
    if let Some(need) = ready.info().needs.iter().find(|n| !garment.has(**n)) {
        let message = format!("the garment holds no {}, which `{name}` needs", crate::pipeline::word(*need));
        return Err(StageError::input(Diagnostic::error(NEEDS_NOT_GIVEN, message)));
    }
    let threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    run_ready(ready.as_ref(), garment, (stop, threads), report, files)
}

/// Runs a stage that has its parameters, as [`run_alone`] does, on this many threads.
///
/// # Errors
/// Those of the stage.
pub fn run_ready(
    stage: &dyn ReadyStage,
    garment: Garment,
    (stop, threads): (&Arc<Stop>, usize),
    report: &mut Report,
    files: &mut Memory,
) -> Result<Garment, StageError> {
    let seed = garment.provenance.seed;
    let progress = &mut Teller::silent();
    stage.run(garment, &mut StageContext { report, progress, files, cancel: stop.flag(), seed, threads })
}

/// Keeps what a stage writes; lets it read what it was given alone.
#[derive(Default)]
pub struct Memory {
    given: BTreeMap<PathBuf, Vec<u8>>,
    written: BTreeMap<PathBuf, Vec<u8>>,
}

impl Memory {
    /// Gives a stage a file to read.
    pub fn give(&mut self, name: &str, bytes: Vec<u8>) {
        self.given.insert(PathBuf::from(name), bytes);
    }

    /// Takes out a file that was written as `{out}/NAME`.
    ///
    /// # Errors
    /// When the stage wrote none of that name.
    pub fn take(&mut self, name: &str) -> Result<Vec<u8>, StageError> {
        let bytes = self.written.remove(Path::new(&format!("{{out}}/{name}")));
        bytes.ok_or_else(|| StageError::Internal(format!("no `{name}` was written")))
    }
}

impl Files for Memory {
    fn read(&mut self, path: &Path) -> Result<Vec<u8>, FileError> {
        if let Some(bytes) = self.given.get(path) {
            return Ok(bytes.clone());
        }
        let reason = "this command works from the file it was given alone".to_owned();
        Err(FileError::Refused { path: clean(path), reason })
    }

    fn read_optional(&mut self, path: &Path) -> Result<Option<Vec<u8>>, FileError> {
        Ok(self.given.get(path).cloned())
    }

    fn write(&mut self, path: &Path, bytes: &[u8]) -> Result<(), FileError> {
        self.written.insert(path.to_path_buf(), bytes.to_vec());
        Ok(())
    }
}
