//! The garment while it is worked on, for a viewer that reads its file again when it changes.

use super::files::read_limited;
use super::same::is_same;
use super::whole::write_whole;
use std::path::{Path, PathBuf};
use toile_garment::Garment;

/// Name of the preview in the output folder.
pub const PREVIEW_NAME: &str = "preview.glb";

/// Largest preview that is read, bytes.
const MAX_PREVIEW: u64 = 1 << 30;

/// Removes the preview that an earlier run left: it shows another garment. Another file of this name stays, and so does
/// one that this run reads.
pub fn sweep(folder: &Path, inputs: &[PathBuf]) {
    let path = folder.join(PREVIEW_NAME);
    let is_file = path.symlink_metadata().is_ok_and(|m| m.is_file());
    if !is_file || inputs.iter().any(|input| is_same(&path, input)) {
        return;
    }
    let garment = read_limited(&path, &path, MAX_PREVIEW).ok().map(|bytes| toile_formats::gltf::read_garment(&bytes));
    if garment.is_some_and(|read| read.is_ok()) {
        drop(std::fs::remove_file(path));
    }
}

/// A GLB that is replaced, whole, whenever there is something new to see. It is no output: it is there before the run
/// has ended well, and stays when it does not.
pub struct Preview {
    path: PathBuf,
}

impl Preview {
    /// A preview in this file.
    #[must_use]
    pub fn new(path: PathBuf) -> Self {
        Self { path }
    }

    /// Shows the garment.
    ///
    /// # Errors
    /// Why it cannot.
    pub fn show(&self, garment: &Garment) -> Result<(), String> {
        let glb = toile_formats::gltf::write_garment(garment).map_err(|e| e.to_string())?;
        write_whole(&self.path, &glb).map_err(|e| e.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_of_somebody_else_stays() {
        let dir = tempfile::tempdir().expect("folder");
        let path = dir.path().join(PREVIEW_NAME);
        std::fs::write(&path, "somebody's").expect("file");
        sweep(dir.path(), &[]);
        assert!(path.is_file(), "it is no preview");
        sweep(dir.path(), std::slice::from_ref(&path));
        assert!(path.is_file(), "it is read");
    }
}
