//! Failures of a stage, sorted by whose fault it is. The engine adds the stage's name, the command line the exit code.

use crate::context::FileError;
use toile_garment::Diagnostic;

/// Why a stage could not finish.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StageError {
    /// An input file is wrong: exit code 3. One or more errors with place and remedy.
    #[error("{}", lines(.0))]
    Input(Vec<Diagnostic>),
    /// A parameter or the sewing file is wrong: exit code 2.
    #[error("{}", lines(.0))]
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
    /// Several at once; the first decides the exit code.
    #[error("{}", lines(.0))]
    Several(Vec<StageError>),
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

/// The errors of steps of which none keeps the others from being taken: all mistakes are told at once.
#[derive(Debug, Default)]
pub struct Errors(Vec<StageError>);

impl Errors {
    /// Keeps an error, or gives the result.
    pub fn keep<T>(&mut self, result: Result<T, impl Into<StageError>>) -> Option<T> {
        result.map_err(|error| self.0.push(error.into())).ok()
    }

    /// Keeps errors.
    pub fn extend(&mut self, errors: impl IntoIterator<Item = StageError>) {
        self.0.extend(errors);
    }

    /// Keeps wrong parameters, if there are any.
    pub fn parameters(&mut self, findings: Vec<Diagnostic>) {
        self.extend((!findings.is_empty()).then_some(StageError::Parameter(findings)));
    }

    /// Keeps wrong inputs, if there are any.
    pub fn inputs(&mut self, findings: Vec<Diagnostic>) {
        self.extend((!findings.is_empty()).then_some(StageError::Input(findings)));
    }

    /// Is nothing wrong so far?
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The result of the last step, if nothing was wrong before.
    ///
    /// # Errors
    /// All that were kept, and that of the last step.
    pub fn finish_with<T>(mut self, last: Result<T, StageError>) -> Result<T, StageError> {
        match last {
            Ok(result) => self.finish().map(|()| result),
            Err(error) if self.0.is_empty() => Err(error),
            Err(error) => {
                self.0.push(error);
                Err(StageError::Several(self.0))
            }
        }
    }

    /// The result of all steps.
    ///
    /// # Errors
    /// All that were kept, in their order.
    pub fn finish(mut self) -> Result<(), StageError> {
        match self.0.len() {
            0 => Ok(()),
            1 => Err(self.0.remove(0)),
            _ => Err(StageError::Several(self.0)),
        }
    }
}

fn lines(list: &[impl ToString]) -> String {
    list.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}
