//! `toile-bundle.json`: what a bundle holds, and what comes of it.

use crate::engine::OutputRecord;
use serde::{Deserialize, Serialize};

/// Name of the list in the bundle.
pub const MANIFEST_NAME: &str = "toile-bundle.json";
/// Version of the form.
pub(super) const FORM: u32 = 1;
/// Marks the folder of the bundle as a project's root: nothing outside it is read.
pub(super) const ROOT_MARK: &str = "toile.root";

/// The list.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// Version of this form.
    pub toile_bundle: u32,
    /// The program of the run: version and digest of its file.
    pub program: String,
    /// Key of the content of the run.
    pub key: Option<String>,
    /// Pipeline file, in the bundle.
    pub pipeline: String,
    /// Overrides; paths in them start at the folder of the bundle.
    pub set: Vec<String>,
    /// Accuracy of the command line.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub accuracy: Option<String>,
    /// Repeats of the command line.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub repeats: Option<u32>,
    /// Files, in the order of their paths.
    pub files: Vec<PackedFile>,
    /// Exit code of the run.
    pub exit_code: u8,
    /// Outputs of the run.
    pub outputs: Vec<OutputRecord>,
}

/// A file in a bundle.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct PackedFile {
    /// Path below the folder of the bundle, forward slashes.
    pub path: String,
    /// Size.
    pub bytes: u64,
    /// Hex digest.
    pub blake3: String,
    /// Does it belong to the program of a plugin?
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub program: bool,
}

impl Manifest {
    /// The list as JSON text.
    #[must_use]
    pub fn to_text(&self) -> String {
        toile_garment::text::json(&serde_json::to_string_pretty(self).unwrap_or_default()) + "\n"
    }
}
