//! The garment while it is worked on, for a viewer that reads its file again when it changes.

use super::whole::write_whole;
use std::path::PathBuf;
use toile_garment::Garment;

/// Name of the preview in the output folder.
pub const PREVIEW_NAME: &str = "preview.glb";

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
