//! One run into a folder of its own, as `toile run` does it: what `test` and `bundle verify` have in common.

use crate::engine::{self, Allow, CacheOptions, Content, Exit, Limits, RECORD_NAME, RunOptions, Stop, read_record};
use crate::load::{self, Loaded, Request};
use crate::progress::Teller;
use serde_json::Value;
use std::path::PathBuf;
use std::sync::Arc;
use toile_garment::Diagnostic;
use toile_stage_api::Registry;

/// How runs are done.
#[derive(Clone, Debug)]
pub struct Means {
    /// Threads of each run.
    pub threads: usize,
    /// Runs that are foreseen to need more are refused.
    pub limits: Limits,
    /// Cache of stages.
    pub cache: Option<CacheOptions>,
}

/// How a run ended.
pub struct Ended {
    /// Exit code.
    pub exit: Exit,
    /// Findings.
    pub findings: Vec<Diagnostic>,
    /// Its record; `None` if it was refused before it began.
    pub record: Option<Value>,
}

/// Runs a pipeline into a folder. What an earlier run left there is replaced.
pub fn rerun(request: &Request, out: PathBuf, means: &Means, stop: &Arc<Stop>, registry: &mut Registry) -> Ended {
    let loaded = load::load(request, stop, registry);
    let exit = loaded.exit();
    let Loaded { source: Some(source), pipeline: Some(pipeline), gate: Some(gate), report } = loaded else {
        return Ended { exit, findings: loaded.report.findings, record: None };
    };
    if report.has_errors() {
        return Ended { exit, findings: report.findings, record: None };
    }
    let content = Content::of(&pipeline, &gate, stop);
    if let Some(finding) = means.limits.refuse(&content.foresight, Allow::Options) {
        return Ended { exit: Exit::System, findings: vec![finding], record: None };
    }
    let options = RunOptions {
        out: out.clone(),
        force: true,
        preview: false,
        threads: means.threads,
        allow_write: Vec::new(),
        set: request.set.clone(),
        accuracy: request.accuracy.clone(),
        repeats: request.repeats,
        pipeline_file: (source.file().to_owned(), source.text().as_bytes().to_vec()),
        foreseen: Some(content.into_foreseen(&pipeline)),
        cache: means.cache.clone(),
    };
    let outcome = engine::run(&pipeline, gate, &options, stop, &mut Teller::silent(), report);
    let record = outcome.record.and_then(|_| read_record(&out.join(RECORD_NAME)).ok());
    Ended { exit: outcome.exit, findings: outcome.findings, record }
}
