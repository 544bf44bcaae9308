//! Failures of a stage, sorted by whose fault it is. The engine adds the stage's name, the command line the exit code.

use crate::context::FileError;
use toile_garment::Diagnostic;

/// Why a stage could not finish.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StageError {
    /// An input file is wrong: exit code 3. One or more errors with place and remedy.
    #[error("{}", join(.0))]
    Input(Vec<Diagnostic>),
    /// A parameter or the sewing file is wrong: exit code 2.
    #[error("{}", join(.0))]
    Parameter(Vec<Diagnostic>),
    /// The program cannot do this yet: exit code 3.
    #[error("not supported: {0}")]
    Unsupported(String),
    /// A limit on size or count: exit code 3.
    #[error("{0}")]
    Limit(String),
    /// It did not converge or became unstable: exit code 4.
    #[error("{0}")]
    Unstable(String),
    /// Disk, memory, rights: exit code 5.
    #[error(transparent)]
    File(#[from] FileError),
    /// The user stopped it: exit code 130.
    #[error("stopped")]
    Cancelled,
    /// A mistake of the program itself.
    #[error("internal error: {0}; please report it")]
    Internal(String),
}

impl StageError {
    /// One wrong input.
    #[must_use]
    pub fn input(finding: Diagnostic) -> Self {
        Self::Input(vec![finding])
    }

    /// One wrong parameter.
    #[must_use]
    pub fn parameter(finding: Diagnostic) -> Self {
        Self::Parameter(vec![finding])
    }
}

fn join(findings: &[Diagnostic]) -> String {
    findings.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}
