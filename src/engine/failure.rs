//! The page of a run that failed: the report on the garment as far as it came, so that a person can see where it ended.

use super::whole::write_whole;
use crate::pipeline::Step;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use toile_garment::{Garment, Report};
use toile_stage_api::{FileError, Files, StageContext};

/// Name of the page in the output folder. It is no output: it is there although the run failed.
pub const FAILURE_NAME: &str = "failure.html";

/// The stage that makes pages.
const REPORTS: &str = "export-report";

/// A mark that every page of a report has.
const MARK: &str = "data-toile-page";

/// Does a chain end with a page?
#[must_use]
pub fn has_page(steps: &[Step<'_>]) -> bool {
    steps.iter().any(|s| s.ready.info().name == REPORTS)
}

/// Removes the page that an earlier run left. Another file of this name stays.
pub fn sweep(folder: &Path) {
    let path = folder.join(FAILURE_NAME);
    if is_page(&path) {
        drop(std::fs::remove_file(path));
    }
}

fn is_page(path: &Path) -> bool {
    let is_file = path.symlink_metadata().is_ok_and(|m| m.is_file());
    is_file && std::fs::read(path).is_ok_and(|bytes| bytes.windows(MARK.len()).any(|w| w == MARK.as_bytes()))
}

/// Writes the page of a garment and the findings of its run. `None` where there is nothing to show, the chain has no
/// report, another file has the name, or the disk refuses: the run has failed already, and its record says why.
///
/// Files that the report asks for, such as points of measure, are read from `below`.
pub fn write(
    steps: &[Step<'_>],
    garment: &Garment,
    report: &Report,
    folder: &Path,
    below: &mut dyn Files,
) -> Option<PathBuf> {
    let step = steps.iter().find(|s| s.ready.info().name == REPORTS)?;
    let path = folder.join(FAILURE_NAME);
    if garment.pieces.is_empty() || path.symlink_metadata().is_ok() {
        return None;
    }
    let (mut files, mut report) = (Kept { below, written: Vec::new() }, report.clone());
    let mut cx = StageContext {
        report: &mut report,
        progress: &mut (),
        files: &mut files,
        cancel: &AtomicBool::new(false),
        seed: 0,
        threads: 1,
    };
    step.ready.run(garment.clone(), &mut cx).ok()?;
    let (_, page) = files.written.iter().find(|(name, _)| name.extension().is_some_and(|e| e == "html"))?;
    write_whole(&path, page).ok()?;
    Some(path)
}

/// Outputs in memory, over the files of the run.
struct Kept<'a> {
    below: &'a mut dyn Files,
    written: Vec<(PathBuf, Vec<u8>)>,
}

impl Files for Kept<'_> {
    fn read(&mut self, path: &Path) -> Result<Vec<u8>, FileError> {
        self.below.read(path)
    }

    fn read_optional(&mut self, path: &Path) -> Result<Option<Vec<u8>>, FileError> {
        self.below.read_optional(path)
    }

    fn write(&mut self, path: &Path, bytes: &[u8]) -> Result<(), FileError> {
        self.written.push((path.to_path_buf(), bytes.to_vec()));
        Ok(())
    }
}
