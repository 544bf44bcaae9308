//! Files as the stages see them.

use super::gate::{Gate, clean};
use super::memory::too_little_for_file;
use super::outputs::Outputs;
use serde::{Deserialize, Serialize};
use std::io::Read as _;
use std::path::{Path, PathBuf};
use toile_garment::provenance::InputRecord;
use toile_stage_api::{FileError, Files};

/// Largest input, bytes.
pub const MAX_INPUT: u64 = 256 << 20;

/// Reads through the gate, writes into the output folder, remembers what was read.
pub struct RunFiles {
    gate: Gate,
    outputs: Outputs,
    inputs: Vec<InputRecord>,
    /// Files that the stage now at work looked for.
    reads: Vec<FileRead>,
    /// Outputs that it wrote, where they are wanted.
    writes: Option<Vec<(PathBuf, Vec<u8>)>>,
}

impl RunFiles {
    /// Files of one run.
    #[must_use]
    pub fn new(gate: Gate, outputs: Outputs) -> Self {
        Self { gate, outputs, inputs: Vec::new(), reads: Vec::new(), writes: None }
    }

    /// Inputs in the order they were first read.
    #[must_use]
    pub fn inputs(&self) -> &[InputRecord] {
        &self.inputs
    }

    /// The output folder.
    #[must_use]
    pub fn outputs(&self) -> &Outputs {
        &self.outputs
    }

    /// The output folder, to commit.
    pub fn outputs_mut(&mut self) -> &mut Outputs {
        &mut self.outputs
    }

    /// A stage begins; `keep` says that its outputs are wanted afterwards.
    pub fn begin_stage(&mut self, keep: bool) {
        self.reads.clear();
        self.writes = keep.then(Vec::new);
    }

    /// The files that the stage looked for, and its outputs.
    pub fn end_stage(&mut self) -> (Vec<FileRead>, Vec<(PathBuf, Vec<u8>)>) {
        (std::mem::take(&mut self.reads), self.writes.take().unwrap_or_default())
    }

    /// The content of a file now, without reading it for a stage. `None` where it cannot be looked at.
    #[must_use]
    pub fn content(&self, path: &Path) -> Option<FileRead> {
        let real = self.gate.optional_input(path).ok()?;
        let bytes = real.map(|real| read_limited(path, &real, MAX_INPUT)).transpose().ok()?;
        Some(FileRead::of(path, bytes.as_deref()))
    }

    /// Takes files as read, whose contents are known.
    ///
    /// # Errors
    /// When an output of this run is to take the place of one.
    pub fn take_as_read(&mut self, reads: &[FileRead]) -> Result<(), FileError> {
        for read in reads {
            if let Some(real) = self.gate.optional_input(&read.path)? {
                self.outputs.note_input(&read.path, &real)?;
            }
        }
        reads.iter().for_each(|read| self.note_read(read.clone()));
        Ok(())
    }

    fn note_read(&mut self, read: FileRead) {
        if let Some(blake3) = &read.blake3 {
            let record = InputRecord { path: Gate::shown(&read.path), blake3: blake3.clone() };
            if !self.inputs.contains(&record) {
                self.inputs.push(record);
            }
        }
        if !self.reads.iter().any(|r| r.path == read.path) {
            self.reads.push(read);
        }
    }

    fn read_real(&mut self, given: &Path, real: &Path) -> Result<Vec<u8>, FileError> {
        self.outputs.note_input(given, real)?;
        let bytes = read_limited(given, real, MAX_INPUT)?;
        self.note_read(FileRead::of(given, Some(&bytes)));
        Ok(bytes)
    }
}

/// A file that was looked for, and its content.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FileRead {
    /// Path as the pipeline names it.
    pub path: PathBuf,
    /// blake3 of its bytes, hex; `None` where there is no such file.
    pub blake3: Option<String>,
}

impl FileRead {
    /// A file that may be absent, and its bytes.
    #[must_use]
    pub fn of(path: &Path, bytes: Option<&[u8]>) -> Self {
        Self { path: path.to_path_buf(), blake3: bytes.map(|b| blake3::hash(b).to_hex().to_string()) }
    }
}

/// Reads through the gate and writes nothing: for looking ahead. It remembers what was looked for.
pub struct TracedFiles<'g> {
    gate: &'g Gate,
    seen: Vec<FileRead>,
}

impl<'g> TracedFiles<'g> {
    /// Files behind a gate.
    #[must_use]
    pub fn new(gate: &'g Gate) -> Self {
        Self { gate, seen: Vec::new() }
    }

    /// Files that were looked for, in the order of the first time.
    #[must_use]
    pub fn into_seen(self) -> Vec<FileRead> {
        self.seen
    }

    fn note(&mut self, path: &Path, bytes: Option<&[u8]>) {
        if !self.seen.iter().any(|s| s.path == path) {
            self.seen.push(FileRead::of(path, bytes));
        }
    }
}

impl Files for TracedFiles<'_> {
    fn read(&mut self, path: &Path) -> Result<Vec<u8>, FileError> {
        let bytes = read_limited(path, &self.gate.input(path)?, MAX_INPUT)?;
        self.note(path, Some(&bytes));
        Ok(bytes)
    }

    fn read_optional(&mut self, path: &Path) -> Result<Option<Vec<u8>>, FileError> {
        let real = self.gate.optional_input(path)?;
        let bytes = real.map(|real| read_limited(path, &real, MAX_INPUT)).transpose()?;
        self.note(path, bytes.as_deref());
        Ok(bytes)
    }

    fn write(&mut self, path: &Path, _: &[u8]) -> Result<(), FileError> {
        Err(FileError::Write { path: clean(path), reason: "nothing is written while looking ahead".to_owned() })
    }
}

/// Reads a file whole, up to a limit; `given` is its name for messages.
///
/// # Errors
/// When it cannot be read or is larger.
pub fn read_limited(given: &Path, real: &Path, limit: u64) -> Result<Vec<u8>, FileError> {
    let missing = |e: std::io::Error| FileError::Missing { path: clean(given), reason: e.to_string() };
    let file = std::fs::File::open(real).map_err(missing)?;
    let size = file.metadata().map_err(missing)?.len();
    let too_large = |size| FileError::TooLarge { path: clean(given), size, limit };
    if size > limit {
        return Err(too_large(size));
    }
    if let Some([needed, free]) = too_little_for_file(size) {
        return Err(FileError::Memory { path: clean(given), needed, free });
    }
    let mut bytes = Vec::new();
    file.take(limit + 1).read_to_end(&mut bytes).map_err(missing)?;
    if bytes.len() as u64 > limit { Err(too_large(bytes.len() as u64)) } else { Ok(bytes) }
}

impl Files for RunFiles {
    fn read(&mut self, path: &Path) -> Result<Vec<u8>, FileError> {
        let real = self.gate.input(path)?;
        self.read_real(path, &real)
    }

    fn read_optional(&mut self, path: &Path) -> Result<Option<Vec<u8>>, FileError> {
        match self.gate.optional_input(path)? {
            Some(real) => self.read_real(path, &real).map(Some),
            None => {
                self.note_read(FileRead::of(path, None));
                Ok(None)
            }
        }
    }

    fn write(&mut self, path: &Path, bytes: &[u8]) -> Result<(), FileError> {
        self.outputs.stage(path, bytes)?;
        if let Some(writes) = &mut self.writes {
            writes.push((path.to_path_buf(), bytes.to_vec()));
        }
        Ok(())
    }
}
