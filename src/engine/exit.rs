//! Exit codes: whose fault it was.

use super::codes;
use super::gate::clean;
use crate::codes::{FILE_MISSING, PATH_REFUSED, WRITE_FAILED};
use crate::pipeline::nearest;
use std::path::Path;
use toile_formats::codes::FILE_TOO_LARGE;
use toile_garment::{Code, Diagnostic};
use toile_stage_api::{FileError, StageError};

/// How a run ended; the number is the exit code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// Good.
    Good = 0,
    /// It ran, but a gate of the certificate failed.
    Gate = 1,
    /// Usage or configuration.
    Usage = 2,
    /// An input file is wrong.
    Input = 3,
    /// It did not converge or became unstable.
    Unstable = 4,
    /// Disk, memory, rights; also a mistake of the program itself, which no user can mend.
    System = 5,
    /// Stopped by the user.
    Stopped = 130,
}

impl Exit {
    /// The number.
    #[must_use]
    pub fn code(self) -> u8 {
        self as u8
    }

    /// One word for `run.json`.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Good => "good",
            Self::Gate => "gate-failed",
            Self::Usage => "usage",
            Self::Input => "input",
            Self::Unstable => "unstable",
            Self::System => "system",
            Self::Stopped => "stopped",
        }
    }

    /// The code of a set of configuration errors: files that are missing or too large are the input's fault, all
    /// else is the configuration's.
    #[must_use]
    pub fn of_findings(findings: &[Diagnostic]) -> Self {
        let errors = || findings.iter().filter(|f| f.severity == toile_garment::Severity::Error);
        let is_input = |f: &Diagnostic| f.code == FILE_MISSING || f.code == FILE_TOO_LARGE;
        if errors().next().is_none() {
            Self::Good
        } else if errors().all(is_input) {
            Self::Input
        } else {
            Self::Usage
        }
    }
}

/// Findings and exit code of a stage's failure.
#[must_use]
pub fn of_stage_error(error: StageError) -> (Vec<Diagnostic>, Exit) {
    let one = |code: Code, message: String, exit| (vec![Diagnostic::error(code, message)], exit);
    match error {
        StageError::Input(findings) => (findings, Exit::Input),
        StageError::Parameter(findings) => (findings, Exit::Usage),
        StageError::Unsupported(_) => one(codes::UNSUPPORTED, error.to_string(), Exit::Input),
        StageError::Limit(text) => one(codes::LIMIT, text, Exit::Input),
        StageError::Unstable(text) => one(codes::UNSTABLE, text, Exit::Unstable),
        StageError::File(error) => of_file_error(&error),
        StageError::Several(errors) => {
            let mut all = errors.into_iter().map(of_stage_error);
            let (mut findings, exit) = all.next().unwrap_or((Vec::new(), Exit::System));
            findings.extend(all.flat_map(|(more, _)| more));
            (findings, exit)
        }
        StageError::Cancelled => (Vec::new(), Exit::Stopped),
        other => one(codes::INTERNAL_ERROR, other.to_string(), Exit::System),
    }
}

/// Findings and exit code of a file that could not be read or written.
#[must_use]
pub fn of_file_error(error: &FileError) -> (Vec<Diagnostic>, Exit) {
    let (code, exit) = match error {
        FileError::Refused { .. } => (PATH_REFUSED, Exit::Usage),
        FileError::Missing { .. } => (FILE_MISSING, Exit::Input),
        FileError::TooLarge { .. } => (FILE_TOO_LARGE, Exit::Input),
        FileError::Memory { .. } => (codes::OVER_LIMIT, Exit::System),
        _ => (WRITE_FAILED, Exit::System),
    };
    let finding = Diagnostic::error(code, error.to_string());
    let remedy = match error {
        FileError::Missing { path, .. } => beside(Path::new(path)),
        _ => None,
    };
    (vec![remedy.into_iter().fold(finding, Diagnostic::hint)], exit)
}

/// Files that are named beside a missing one at most.
const NAMED: usize = 6;

/// The remedy for a missing file: the nearest name in its folder, else the files there that end as it does.
fn beside(path: &Path) -> Option<String> {
    let name = path.file_name()?.to_str()?;
    let folder = path.parent().filter(|f| !f.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let entries = std::fs::read_dir(folder).ok()?.flatten();
    let mut names: Vec<String> = entries.filter_map(|e| e.file_name().into_string().ok()).collect();
    names.sort();
    if let Some(near) = nearest(name, names.iter().map(String::as_str)).filter(|near| *near != name) {
        return Some(format!("did you mean `{}`?", clean(&folder.join(near))));
    }
    let ending = |name: &str| Some(Path::new(name).extension()?.to_string_lossy().to_lowercase());
    let alike = names.iter().filter(|n| ending(n).is_some() && ending(n) == ending(name)).take(NAMED);
    let alike: Vec<String> = alike.map(|n| format!("`{}`", clean(Path::new(n)))).collect();
    (!alike.is_empty()).then(|| format!("in this folder there are {}", alike.join(", ")))
}
