//! Files as the stages see them.

use super::gate::{Gate, clean};
use super::memory::too_little_for_file;
use super::outputs::Outputs;
use std::io::Read as _;
use std::path::Path;
use toile_garment::provenance::InputRecord;
use toile_stage_api::{FileError, Files};

/// Largest input, bytes.
pub const MAX_INPUT: u64 = 256 << 20;

/// Reads through the gate, writes into the output folder, remembers what was read.
pub struct RunFiles {
    gate: Gate,
    outputs: Outputs,
    inputs: Vec<InputRecord>,
}

impl RunFiles {
    /// Files of one run.
    #[must_use]
    pub fn new(gate: Gate, outputs: Outputs) -> Self {
        Self { gate, outputs, inputs: Vec::new() }
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

    fn note_input(&mut self, path: String, bytes: &[u8]) {
        let record = InputRecord { path, blake3: blake3::hash(bytes).to_hex().to_string() };
        if !self.inputs.contains(&record) {
            self.inputs.push(record);
        }
    }

    fn read_real(&mut self, given: &Path, real: &Path) -> Result<Vec<u8>, FileError> {
        self.outputs.note_input(given, real)?;
        let bytes = read_limited(given, real, MAX_INPUT)?;
        self.note_input(Gate::shown(given), &bytes);
        Ok(bytes)
    }
}

/// Reads through the gate and writes nothing: for looking ahead.
pub struct ReadFiles<'g>(pub &'g Gate);

impl Files for ReadFiles<'_> {
    fn read(&mut self, path: &Path) -> Result<Vec<u8>, FileError> {
        read_limited(path, &self.0.input(path)?, MAX_INPUT)
    }

    fn read_optional(&mut self, path: &Path) -> Result<Option<Vec<u8>>, FileError> {
        let real = self.0.optional_input(path)?;
        real.map(|real| read_limited(path, &real, MAX_INPUT)).transpose()
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
            None => Ok(None),
        }
    }

    fn write(&mut self, path: &Path, bytes: &[u8]) -> Result<(), FileError> {
        self.outputs.stage(path, bytes)
    }
}
