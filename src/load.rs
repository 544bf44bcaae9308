//! From a file name to a checked chain: what `run`, `check` and `plan` have in common.

mod accuracy;
pub(crate) mod codes;
mod overruled;

use crate::codes::FILE_MISSING;
use crate::engine::{Exit, Gate, Stop, check_paths, clean, read_limited};
use crate::external;
use crate::pipeline::{self, Document, MAX_BYTES, Pipeline, SourceText, Tuning};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toile_garment::{Diagnostic, Report, SourceRef};
use toile_stage_api::{FileError, Meaning, Registry};
use toile_stages::text::text;

/// Which pipeline, and what it may do.
#[derive(Clone, Debug, Default)]
pub struct Request {
    /// Pipeline file.
    pub file: PathBuf,
    /// Overrides.
    pub set: Vec<String>,
    /// Folder from which relative paths of overrides and of `allow_read` start; empty for the working folder.
    pub base: PathBuf,
    /// Further folders it may read.
    pub allow_read: Vec<PathBuf>,
    /// Plugins it may run.
    pub allow_run: BTreeSet<String>,
    /// Settings that trade accuracy for time, instead of those of the pipeline.
    pub tuning: Tuning,
    /// How often the rest is sought again, instead of what the pipeline says.
    pub repeats: Option<u32>,
    /// Accuracy wanted, instead of that of the pipeline's head.
    pub accuracy: Option<String>,
}

/// A chain with what was found. It may run only if the report has no error.
pub struct Loaded<'r> {
    /// The text of the pipeline file, if it could be read.
    pub source: Option<SourceText>,
    /// The chain, as far as it could be read.
    pub pipeline: Option<Pipeline<'r>>,
    /// The way to its inputs.
    pub gate: Option<Gate>,
    /// Findings.
    pub report: Report,
}

impl Loaded<'_> {
    /// Name and text of the pipeline file, to show findings in.
    #[must_use]
    pub fn text(&self) -> Option<(&str, &str)> {
        self.source.as_ref().map(|s| (s.file(), s.text()))
    }

    /// How the program ends with these findings. A file that is no pipeline at all is a matter of usage.
    #[must_use]
    pub fn exit(&self) -> Exit {
        if self.source.is_none() { Exit::Usage } else { Exit::of_findings(&self.report.findings) }
    }
}

/// Opens a pipeline and checks everything that needs no work; all mistakes are in the report.
pub fn load<'r>(request: &Request, stop: &Arc<Stop>, registry: &'r mut Registry) -> Loaded<'r> {
    match open(request) {
        Ok(source) => check(source, request, |document, report| {
            external::connect(document, &folder_of(&request.file), &request.allow_run, stop, registry, report);
            registry
        }),
        Err(findings) => Loaded { source: None, pipeline: None, gate: None, report: Report { findings } },
    }
}

/// The same for a pipeline whose plugins are connected already: many requests may share one registry.
pub fn reload<'r>(request: &Request, registry: &'r Registry) -> Loaded<'r> {
    match open(request) {
        Ok(source) => check(source, request, |_, _| registry),
        Err(findings) => Loaded { source: None, pipeline: None, gate: None, report: Report { findings } },
    }
}

/// Reads a file that a person writes. What is wrong goes to the report.
pub(crate) fn read_text(path: &Path, report: &mut Report) -> Option<SourceText> {
    let name = clean(path);
    let at = || SourceRef::file(name.clone());
    let bytes = match read_limited(path, path, MAX_BYTES) {
        Ok(bytes) => bytes,
        Err(error) => {
            report.findings.extend(crate::engine::of_file_error(&error).0.into_iter().map(|f| f.at(at())));
            return None;
        }
    };
    match text(&name, &bytes) {
        Ok(text) => Some(SourceText::new(name, text, Vec::new())),
        Err(finding) => {
            report.push(finding);
            None
        }
    }
}

fn open(request: &Request) -> Result<SourceText, Vec<Diagnostic>> {
    let name = clean(&request.file);
    let at = |d: Diagnostic| vec![d.at(SourceRef::file(name.clone()))];
    if !request.file.is_file() {
        return Err(at(Diagnostic::error(FILE_MISSING, format!("there is no pipeline file `{name}`"))));
    }
    let bytes = read_limited(&request.file, &request.file, MAX_BYTES)
        .map_err(|e| crate::engine::of_file_error(&e).0.into_iter().flat_map(&at).collect::<Vec<_>>())?;
    let text = text(&name, &bytes).map_err(|finding| vec![finding])?;
    Ok(SourceText::new(name, text, request.set.clone()))
}

fn check<'r>(
    source: SourceText,
    request: &Request,
    connect: impl FnOnce(&Document<'_>, &mut Report) -> &'r Registry,
) -> Loaded<'r> {
    let mut report = Report::default();
    let Some(mut document) = pipeline::parse(&source, &mut report) else {
        return Loaded { source: Some(source), pipeline: None, gate: None, report };
    };
    let registry = connect(&document, &mut report);
    let mut tuning = if request.tuning.is_empty() {
        accuracy::tuning(&document, request, registry, &mut report)
    } else {
        request.tuning.clone()
    };
    tuning.extend(request.repeats.map(|n| (Meaning::Repeats, n.to_string())));
    pipeline::tune(&mut document, registry, &tuning);
    if let Some(study) = accuracy::study_beside(request) {
        pipeline::offer(&mut document, registry, Meaning::Study, &study);
    }
    let mut pipeline = pipeline::link(&document, registry, &mut report);
    pipeline.beside = accuracy::looked_for(&document, request);
    overruled::tell(&pipeline, &tuning, request, &mut report);
    pipeline.contents = external::contents(&document, &folder_of(&request.file), &request.allow_run);
    let repeats = |s: &pipeline::Step<'_>| pipeline::knob(s.ready.knobs(), Meaning::Repeats).is_some();
    if request.repeats.is_some() && !pipeline.steps.iter().any(repeats) {
        let message = "--repeats was given, and no stage of this chain can be repeated";
        report.push(Diagnostic::error(codes::REPEATS_NO_STAGE, message).hint("`drape` can"));
    }
    let gate = match gate(request, &pipeline) {
        Ok(gate) => {
            check_paths(&pipeline.steps, &gate, &mut report);
            Some(gate)
        }
        Err(error) => {
            let (findings, _) = crate::engine::of_file_error(&error);
            report.findings.extend(findings);
            None
        }
    };
    sort_by_place(&mut report);
    Loaded { source: Some(source), pipeline: Some(pipeline), gate, report }
}

fn gate(request: &Request, pipeline: &Pipeline<'_>) -> Result<Gate, FileError> {
    let from_base = |dir: &PathBuf| request.base.join(dir);
    let allow: Vec<PathBuf> = request.allow_read.iter().map(from_base).collect();
    let mounts = pipeline.mounts.iter().map(|(name, dir)| (name.clone(), from_base(dir))).collect();
    Gate::new(&folder_of(&request.file), &allow, &mounts)
}

/// The reader meets the mistakes in the order of the file, whatever step found them.
fn sort_by_place(report: &mut Report) {
    report.findings.sort_by_key(|f| f.source.as_ref().map(|s| (s.line.is_none(), s.line, s.column)));
}

fn folder_of(file: &Path) -> PathBuf {
    let folder = file.parent().filter(|p| !p.as_os_str().is_empty());
    let folder = folder.map_or_else(|| PathBuf::from("."), Path::to_path_buf);
    folder.canonicalize().unwrap_or(folder)
}
