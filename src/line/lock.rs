//! One program at a time works on the folder of a line.

use crate::codes::PATH_REFUSED;
use crate::engine::{clean, take_lock, temp_path};
use std::fs::File;
use std::path::{Path, PathBuf};
use toile_garment::Diagnostic;

/// The lock of a folder; it is free again when this is dropped, or the program dies.
pub struct Lock {
    path: PathBuf,
    _file: File,
}

impl Lock {
    /// Takes the lock.
    ///
    /// # Errors
    /// When another program has it, or the folder cannot be written.
    pub fn take(folder: &Path) -> Result<Self, Diagnostic> {
        let path = temp_path(folder, "lock");
        let refused = |why: &str| {
            let message = format!("cannot work in `{}`: {why}", clean(folder));
            Diagnostic::error(PATH_REFUSED, message).hint("wait, or choose another folder with --out")
        };
        match take_lock(&path) {
            Ok(crate::engine::Lock::Held(file)) => Ok(Self { path, _file: file }),
            Ok(crate::engine::Lock::Taken) => Err(refused("another line is run there")),
            Err(error) => Err(refused(&error.to_string())),
        }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // Removed while held, so that nobody removes the lock of a line that came after.
        drop(std::fs::remove_file(&self.path));
    }
}
