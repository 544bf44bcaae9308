//! Golden cases of a house: pipelines with the figures, outputs and findings that they must give.
//!
//! ```toml
//! toile = 1
//! [[case]]
//! name     = "skirt-38"
//! pipeline = "skirt.toml"
//! set      = { size = "38" }
//! [case.figures]
//! strain_max               = { within = 0.01, max = 0.2 }
//! "hip_girth.drape.tape"   = { within = "2 mm" }
//! ```
//!
//! `toile test --bless --reason "…"` fills in the golden values, and `toile test` compares with them.

mod bless;
pub(crate) mod codes;
mod document;
mod find;
mod judge;
mod report;
mod run;
mod schema;

pub use bless::{Blessed, bless};
pub use document::{GoldenCase, GoldenFigure, GoldenHash, Like};
pub use find::{FILE_NAME, find};
pub use judge::{Difference, Verdict};
pub use report::{github, github_findings, junit, text, to_json};
pub use run::{Bench, Tested};
pub use schema::schema;

use crate::load::read_text;
use crate::pipeline::SourceText;
use std::path::{Path, PathBuf};
use toile_garment::Report;

/// A file of golden cases.
pub struct TestFile {
    /// Its path.
    pub path: PathBuf,
    /// The text, for places.
    pub source: SourceText,
    /// Folder of the file: paths in it start there.
    pub folder: PathBuf,
    /// The cases, in the order of the file.
    pub cases: Vec<GoldenCase>,
}

/// Reads a file of golden cases. All mistakes go to the report; `None` if it cannot be read at all.
pub fn open(path: &Path, report: &mut Report) -> Option<TestFile> {
    let source = read_text(path, report)?;
    let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
    let cases = document::parse(&source, &folder, report).unwrap_or_default();
    Some(TestFile { path: path.to_path_buf(), source, folder, cases })
}
