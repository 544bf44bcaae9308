//! Why a verb cannot go on.

use crate::engine::Exit;
use crate::load::Loaded;
use toile_garment::Diagnostic;

/// The words for a person, and the exit status of the program.
#[derive(Debug)]
pub struct Halt {
    /// Findings to show.
    pub findings: Vec<Diagnostic>,
    /// Name and text of the pipeline, to show them in.
    pub source: Option<(String, String)>,
    /// How the program ends.
    pub exit: Exit,
}

impl Halt {
    /// Without a pipeline.
    #[must_use]
    pub fn new(findings: Vec<Diagnostic>, exit: Exit) -> Self {
        Self { findings, source: None, exit }
    }

    /// A mistake in what was asked for.
    #[must_use]
    pub fn usage(finding: Diagnostic) -> Self {
        Self::new(vec![finding], Exit::Usage)
    }

    /// A pipeline that cannot run.
    #[must_use]
    pub fn of(loaded: Loaded<'_>) -> Self {
        let source = loaded.text().map(|(file, text)| (file.to_owned(), text.to_owned()));
        let exit = loaded.exit();
        Self { source, exit, findings: loaded.report.findings }
    }
}
