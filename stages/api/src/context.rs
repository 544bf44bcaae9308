//! The engine lends a running stage its files, its findings and its progress.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use toile_garment::{Garment, Report};

/// Why a file could not be read or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FileError {
    /// The path leaves the allowed folders, or is not a plain relative path.
    #[error("the path `{path}` is not allowed: {reason}")]
    Refused {
        /// The path as it was given.
        path: String,
        /// Why and what to do.
        reason: String,
    },
    /// There is no such file.
    #[error("cannot read `{path}`: {reason}")]
    Missing {
        /// The path as it was given.
        path: String,
        /// The system's words.
        reason: String,
    },
    /// The file is larger than the limit.
    #[error("`{path}` has {size} bytes, over the limit of {limit}")]
    TooLarge {
        /// The path as it was given.
        path: String,
        /// Its size.
        size: u64,
        /// The limit.
        limit: u64,
    },
    /// Reading the file needs more memory than this process can have.
    #[error("reading `{path}` needs about {needed:.0} MB of memory, and there are {free:.0} MB")]
    Memory {
        /// The path as it was given.
        path: String,
        /// Memory for reading and checking it, MB.
        needed: f64,
        /// Memory that is left, MB.
        free: f64,
    },
    /// Disk full, no rights, or it is there already and `--force` was not given.
    #[error("cannot write `{path}`: {reason}")]
    Write {
        /// The path as it was given.
        path: String,
        /// The system's words.
        reason: String,
    },
}

/// Files as a stage sees them: reads are digested, writes appear under their final name only when whole.
/// Relative inputs are relative to the pipeline file; `{out}` in outputs has been filled in by the engine.
pub trait Files {
    /// Reads an input whole.
    ///
    /// # Errors
    /// When the path is refused, missing or too large.
    fn read(&mut self, path: &Path) -> Result<Vec<u8>, FileError>;

    /// Reads an input that may be absent (`.rul` beside a DXF, the `.toml` beside a body).
    /// The name is matched without regard to case.
    ///
    /// # Errors
    /// When the path is refused or too large.
    fn read_optional(&mut self, path: &Path) -> Result<Option<Vec<u8>>, FileError>;

    /// Writes an output, atomically, at the latest when the run ends well.
    ///
    /// # Errors
    /// When the path is refused or the disk is.
    fn write(&mut self, path: &Path, bytes: &[u8]) -> Result<(), FileError>;
}

/// No files: nothing is there to be read, and what is written is dropped.
impl Files for () {
    fn read(&mut self, path: &Path) -> Result<Vec<u8>, FileError> {
        Err(FileError::Missing { path: path.display().to_string(), reason: "no files here".to_owned() })
    }

    fn read_optional(&mut self, _path: &Path) -> Result<Option<Vec<u8>>, FileError> {
        Ok(None)
    }

    fn write(&mut self, _path: &Path, _bytes: &[u8]) -> Result<(), FileError> {
        Ok(())
    }
}

/// Where a stage tells how far it is. Calls are cheap and may be many.
pub trait Progress {
    /// `done` of `total` (0 = unknown), and a few words, e.g. `residual 0.03, goal 0.01`.
    fn update(&mut self, done: u64, total: u64, words: &str);

    /// Does anyone want to see the garment on the way?
    fn looks(&self) -> bool {
        false
    }

    /// The garment as it is on the way, and a few words.
    fn look(&mut self, _garment: &Garment, _words: &str) {}
}

impl Progress for () {
    fn update(&mut self, _: u64, _: u64, _: &str) {}
}

/// Findings, progress and files that the engine lends to a running stage.
pub struct StageContext<'a> {
    /// Findings.
    pub report: &'a mut Report,
    /// Progress.
    pub progress: &'a mut dyn Progress,
    /// Files.
    pub files: &'a mut dyn Files,
    /// Set when the user asks to stop; look at it at least every 100 ms.
    pub cancel: &'a AtomicBool,
    /// Seed for anything random.
    pub seed: u64,
    /// Threads allowed. Results never depend on it.
    pub threads: usize,
}

impl StageContext<'_> {
    /// Did the user ask to stop?
    #[must_use]
    pub fn cancelled(&self) -> bool {
        self.cancel.load(Ordering::Relaxed)
    }
}
