//! The file of a product line: styles, sizes, fabrics and other choices as a matrix, with limits and gates.
//!
//! ```toml
//! toile = 1
//! [line]
//! name = "spring"
//! [[style]]
//! name     = "skirt"
//! pipeline = "long-skirt/v1.toml"
//! [matrix]
//! size   = ["36", "38"]
//! fabric = ["wool-suiting", "linen-plain"]
//! ```
//!
//! Every style is sewn in every combination of the choices. Such a combination is a job: one folder, one `toile run`.
//! A list in `[matrix]` sets the input of its name. A table gives names to choices that set more:
//! `setting.coarse = { triangulate.triangles = 400 }`.
//!
//! `[[exclude]]` leaves out jobs by their choices, and `[[include]]` adds single jobs.

pub(crate) mod codes;
mod document;
mod done;
mod expand;
mod lock;
mod only;
pub mod page;
mod results;
mod run;
mod schema;
mod survey;
mod thumbnail;
mod value;

pub use document::{Axis, Choice, Include, LineFile, Rule, Style};
pub use done::was_run;
pub use expand::{Job, expand};
pub use lock::Lock;
pub use only::only;
pub use results::{RESULTS_NAME, Results, Row};
pub use run::{Order, Ran, arguments};
pub use schema::schema;
pub use survey::{Planned, Rights, Survey, Surveyed, survey};
pub use thumbnail::draw;
pub use value::Set;
pub(crate) use value::sets;

use crate::load::read_text;
use crate::pipeline::SourceText;
use std::path::{Path, PathBuf};
use toile_garment::Report;

/// A product line as its file says, with its jobs.
pub struct Line {
    /// The text, for places.
    pub source: SourceText,
    /// Folder of the file: paths in it start there.
    pub folder: PathBuf,
    /// The file.
    pub file: LineFile,
    /// The jobs, in the order of the file.
    pub jobs: Vec<Job>,
}

/// A line with what was found in its file.
pub struct Opened {
    /// The line; `None` if the file cannot be read at all.
    pub line: Option<Line>,
    /// Mistakes.
    pub report: Report,
}

/// Reads the file of a product line. All mistakes are in the report.
#[must_use]
pub fn open(path: &Path) -> Opened {
    let mut report = Report::default();
    let line = read_text(path, &mut report).and_then(|source| {
        let file = document::parse(&source, &mut report)?;
        let jobs = expand(&file, &source, &mut report);
        let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
        Some(Line { source, folder, file, jobs })
    });
    Opened { line, report }
}
