//! Findings: data, many per run, with fixed codes.

use crate::code::Code;
use crate::source::SourceRef;
use crate::text::short_numbers;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How bad a finding is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// Worth knowing: a rule was applied, a value was guessed with good evidence.
    Info,
    /// The run goes on, but a person should look.
    Warning,
    /// The run cannot give a right answer.
    Error,
}

/// One finding: what is wrong, where, and what to do about it.
///
/// Our own findings are made from a [`Code`]. Only what is read, such as a document or a line of another program, can
/// hold a code that no list of ours has.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Diagnostic {
    /// How bad it is.
    pub severity: Severity,
    /// Fixed code in kebab case that reads as what is wrong, e.g. `dart-legs-differ`.
    pub code: String,
    /// One sentence with names, numbers and units.
    pub message: String,
    /// Place in an input file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<SourceRef>,
    /// The remedy.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hint: Option<String>,
}

impl Diagnostic {
    /// A finding without place and remedy; add them with [`Self::at`] and [`Self::hint`].
    #[must_use]
    pub fn new(severity: Severity, code: Code, message: impl Into<String>) -> Self {
        Self {
            severity,
            code: code.name().to_owned(),
            message: short_numbers(message.into()),
            source: None,
            hint: None,
        }
    }

    /// An error.
    #[must_use]
    pub fn error(code: Code, message: impl Into<String>) -> Self {
        Self::new(Severity::Error, code, message)
    }

    /// A warning.
    #[must_use]
    pub fn warning(code: Code, message: impl Into<String>) -> Self {
        Self::new(Severity::Warning, code, message)
    }

    /// A note.
    #[must_use]
    pub fn info(code: Code, message: impl Into<String>) -> Self {
        Self::new(Severity::Info, code, message)
    }

    /// Adds the place.
    #[must_use]
    pub fn at(mut self, source: impl Into<Option<SourceRef>>) -> Self {
        self.source = source.into();
        self
    }

    /// The finding as a warning.
    #[must_use]
    pub fn softened(mut self) -> Self {
        self.severity = Severity::Warning;
        self
    }

    /// Adds the remedy.
    #[must_use]
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }
}

impl std::fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let word = match self.severity {
            Severity::Info => "note",
            Severity::Warning => "warning",
            Severity::Error => "error",
        };
        write!(f, "{word}[{}] {}", self.code, self.message)?;
        if let Some(source) = &self.source {
            write!(f, "\n  at {source}")?;
        }
        if let Some(hint) = &self.hint {
            write!(f, "\n  help: {hint}")?;
        }
        Ok(())
    }
}

/// Most places that a tally names.
const NAMED: usize = 5;

/// How many things of a list are in question, and which of them come first: a message stays one line whatever their
/// number.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    count: usize,
    first: Vec<usize>,
}

impl Tally {
    /// Takes one more, by its index in the list.
    pub fn add(&mut self, index: usize) {
        self.count += 1;
        if self.first.len() < NAMED {
            self.first.push(index + 1);
        }
    }

    /// How many there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }
}

/// The first by their numbers from 1: `3, 8`, and `…` after them where there are more.
impl std::fmt::Display for Tally {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let words: Vec<String> = self.first.iter().map(ToString::to_string).collect();
        let more = if self.count > NAMED { ", …" } else { "" };
        write!(f, "{}{more}", words.join(", "))
    }
}

/// The findings of a run, in the order they were made.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(transparent)]
pub struct Report {
    /// All findings.
    pub findings: Vec<Diagnostic>,
}

impl Report {
    /// Adds a finding.
    pub fn push(&mut self, finding: Diagnostic) {
        self.findings.push(finding);
    }

    /// Is there at least one error?
    #[must_use]
    pub fn has_errors(&self) -> bool {
        self.findings.iter().any(|f| f.severity == Severity::Error)
    }

    /// Number of findings of one severity.
    #[must_use]
    pub fn count(&self, severity: Severity) -> usize {
        self.findings.iter().filter(|f| f.severity == severity).count()
    }
}
