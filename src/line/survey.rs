//! Looking at every job of a line before anything runs: its mistakes, its content, its cost.

use super::{Job, Line};
use crate::engine::{Allow, Content, Exit, FileRead, Gate, Stop};
use crate::load::{self, Request};
use rayon::prelude::*;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;
use toile_garment::{Diagnostic, Report, Severity, SourceRef};
use toile_stage_api::Registry;

/// The rights of all jobs of a line, as the command line gives them.
#[derive(Clone, Debug, Default)]
pub struct Rights {
    /// Further folders that pipelines may read.
    pub allow_read: Vec<PathBuf>,
    /// Plugins that pipelines may run.
    pub allow_run: Vec<String>,
}

/// A job that can run, as it is foreseen.
#[derive(Clone, Debug)]
pub struct Planned {
    /// Key of its content: jobs with one key give the same outputs.
    pub key: String,
    /// Files that it reads or looks for.
    pub reads: Vec<FileRead>,
    /// Names of its outputs.
    pub outputs: Vec<String>,
    /// Line, seed and stages with their parameters.
    pub chain: Value,
    /// Foreseen CPU time, s.
    pub seconds: f64,
    /// Foreseen memory, MB.
    pub mb: f64,
}

/// Findings and plan of one job.
pub struct Surveyed {
    /// Findings.
    pub findings: Vec<Diagnostic>,
    /// How its run would end already now.
    pub exit: Exit,
    /// The plan; `None` for a job with mistakes.
    pub planned: Option<Planned>,
}

/// All jobs, in their order.
pub struct Survey {
    /// One for each job.
    pub jobs: Vec<Surveyed>,
}

impl Line {
    /// The request that opens the pipeline of a job.
    #[must_use]
    pub fn request(&self, job: &Job, rights: &Rights) -> Request {
        Request {
            file: self.folder.join(&job.pipeline),
            set: job.sets.iter().map(|s| s.text.clone()).collect(),
            base: self.folder.clone(),
            allow_read: rights.allow_read.clone(),
            allow_run: rights.allow_run.iter().cloned().collect(),
            ..Request::default()
        }
    }
}

/// Looks at all jobs. Nothing works; files are read as far as `check` reads them.
pub fn survey(line: &Line, rights: &Rights, stop: &Arc<Stop>, registry: &mut Registry) -> Survey {
    // Plugins are connected once for each pipeline; then the jobs share the registry.
    let mut connected: Vec<&PathBuf> = Vec::new();
    for job in &line.jobs {
        if !connected.contains(&&job.pipeline) {
            connected.push(&job.pipeline);
            drop(load::load(&line.request(job, rights), stop, registry));
        }
    }
    let registry: &Registry = registry;
    let look = |job: &Job| if stop.asked() { stopped() } else { look(line, job, rights, stop, registry) };
    Survey { jobs: line.jobs.par_iter().map(look).collect() }
}

fn stopped() -> Surveyed {
    Surveyed { findings: Vec::new(), exit: Exit::Stopped, planned: None }
}

fn look(line: &Line, job: &Job, rights: &Rights, stop: &Arc<Stop>, registry: &Registry) -> Surveyed {
    let loaded = load::reload(&line.request(job, rights), registry);
    let mut exit = loaded.exit();
    let mut findings = loaded.report.findings;
    let mut planned = None;
    if let (Some(pipeline), Some(gate)) = (&loaded.pipeline, &loaded.gate) {
        let content = Content::of(pipeline, gate, stop);
        let is_new = |f: &&Diagnostic| !findings.iter().any(|k| k.code == f.code && k.message == f.message);
        let new: Vec<Diagnostic> = content.foresight.findings.iter().filter(is_new).cloned().collect();
        findings.extend(new);
        exit = if exit == Exit::Good { content.foresight.exit } else { exit };
        if let Some(over) = line.file.limits.refuse(&content.foresight, Allow::Line).filter(|_| exit == Exit::Good) {
            findings.push(over);
            exit = Exit::System;
        }
        let paths = pipeline.steps.iter().flat_map(|s| &s.paths).filter(|p| p.is_output());
        planned = (exit == Exit::Good).then(|| Planned {
            key: content.key(pipeline),
            outputs: paths.map(|p| p.text.replacen("{out}/", "", 1)).collect(),
            chain: crate::engine::chain(pipeline),
            seconds: content.foresight.seconds(),
            mb: content.foresight.mb(),
            reads: content.reads,
        });
    }
    findings.retain(|f| f.severity != Severity::Info);
    findings.iter_mut().for_each(|f| to_line(f, line, job));
    Surveyed { findings, exit, planned }
}

/// A finding about an override stands where the line says it.
fn to_line(finding: &mut Diagnostic, line: &Line, job: &Job) {
    let file = finding.source.as_ref().map_or("", |s| s.file.as_str());
    let missing =
        finding.source.is_none() || (file == line.folder.join(&job.pipeline).to_string_lossy() && is_whole(finding));
    let set = file.strip_prefix("--set ").and_then(|text| job.sets.iter().find(|s| s.text == text));
    if let Some(set) = set {
        finding.source = Some(line.source.place(&set.span));
    } else if missing {
        finding.source = Some(line.source.place(&job.span));
    }
}

/// Does a finding speak of a file as a whole?
fn is_whole(finding: &Diagnostic) -> bool {
    finding.source.as_ref().is_some_and(|s| s.line.is_none())
}

impl Survey {
    /// Findings of all jobs; what several jobs share is told once, with their number.
    #[must_use]
    pub fn findings(&self, line: &Line) -> Report {
        let mut order: Vec<(Diagnostic, Vec<&str>)> = Vec::new();
        let mut known: BTreeMap<String, usize> = BTreeMap::new();
        for (job, surveyed) in line.jobs.iter().zip(&self.jobs) {
            for finding in &surveyed.findings {
                let key = format!("{} {} {:?}", finding.code, finding.message, finding.source);
                let at = *known.entry(key).or_insert_with(|| {
                    order.push((finding.clone(), Vec::new()));
                    order.len() - 1
                });
                order[at].1.push(&job.name);
            }
        }
        let all = line.jobs.len();
        let told = |(mut finding, jobs): (Diagnostic, Vec<&str>)| {
            let who = match jobs.len() {
                1 => format!("in the job `{}`", jobs[0]),
                n if n == all => "in every job".to_owned(),
                n => format!("in {n} jobs, first `{}`", jobs[0]),
            };
            finding.message = format!("{} ({who})", finding.message);
            finding
        };
        let mut findings: Vec<Diagnostic> = order.into_iter().map(told).collect();
        let place = |s: &SourceRef| (s.file.clone(), s.line, s.column);
        findings.sort_by_key(|f| f.source.as_ref().map(place));
        Report { findings }
    }

    /// How the whole line would end already now: the exit code of the first job with mistakes.
    #[must_use]
    pub fn exit(&self) -> Exit {
        self.jobs.iter().map(|j| j.exit).find(|e| *e != Exit::Good).unwrap_or(Exit::Good)
    }
}

impl Planned {
    /// The plan of a job for programs.
    #[must_use]
    pub fn json(&self, line: &Line, job: &Job) -> Value {
        let reads = |r: &FileRead| json!({ "path": Gate::shown(&r.path), "blake3": r.blake3 });
        json!({
            "job": job.name,
            "style": job.style,
            "choices": job.choices,
            "pipeline": job.pipeline.to_string_lossy().replace('\\', "/"),
            "set": job.sets.iter().map(|s| &s.text).collect::<Vec<_>>(),
            "arguments": super::arguments(line, job),
            "key": self.key,
            "inputs": self.reads.iter().map(reads).collect::<Vec<_>>(),
            "stages": self.chain[2],
            "outputs": self.outputs,
            "expected": { "seconds": rounded(self.seconds), "mb": rounded(self.mb) },
        })
    }
}

/// An expectation has no more digits than this.
fn rounded(x: f64) -> f64 {
    (x * 1e3).round() / 1e3
}
