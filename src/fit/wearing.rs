//! A pipeline run up to its end, with the garment kept.

use crate::engine::{self, Allow, Content, Exit, Limits, RunOptions, Stop};
use crate::halt::Halt;
use crate::load::{self, Loaded, Request};
use crate::pipeline::Pipeline;
use crate::progress::Teller;
use std::path::PathBuf;
use std::sync::Arc;
use toile_garment::{Diagnostic, Garment, Severity};
use toile_stage_api::Registry;

/// How runs are done.
pub struct Means<'a> {
    /// Threads.
    pub threads: usize,
    /// Stop.
    pub stop: &'a Arc<Stop>,
}

/// A garment on a body.
pub struct Worn {
    /// The garment.
    pub garment: Garment,
    /// Did its certificate pass?
    pub passed: bool,
    /// Warnings and errors of the run.
    pub findings: Vec<Diagnostic>,
}

impl Means<'_> {
    /// Runs a pipeline into a folder; `shorten` may cut the chain first.
    ///
    /// # Errors
    /// When the pipeline is wrong, or nothing was draped.
    pub fn wear(
        &self,
        request: &Request,
        out: PathBuf,
        registry: &mut Registry,
        shorten: impl FnOnce(&mut Pipeline<'_>) -> Result<(), Diagnostic>,
    ) -> Result<Worn, Halt> {
        let loaded = load::load(request, self.stop, registry);
        if loaded.report.has_errors() {
            return Err(Halt::of(loaded));
        }
        let Loaded { source: Some(source), pipeline: Some(mut pipeline), gate: Some(gate), report } = loaded else {
            return Err(Halt::of(loaded));
        };
        let text = (source.file().to_owned(), source.text().to_owned());
        shorten(&mut pipeline).map_err(Halt::usage)?;
        let content = Content::of(&pipeline, &gate, self.stop);
        if let Some(finding) = Limits::default().refuse(&content.foresight, Allow::Nowhere) {
            return Err(Halt::new(vec![finding], Exit::System));
        }
        let options = RunOptions {
            out,
            force: true,
            preview: false,
            threads: self.threads,
            allow_write: Vec::new(),
            set: request.set.clone(),
            accuracy: request.accuracy.clone(),
            repeats: request.repeats,
            pipeline_file: (text.0.clone(), text.1.clone().into_bytes()),
            foreseen: None,
            cache: None,
        };
        let outcome = engine::run(&pipeline, gate, &options, self.stop, &mut Teller::silent(), report);
        let findings = outcome.findings.into_iter().filter(|f| f.severity != Severity::Info).collect();
        match outcome.exit {
            Exit::Good | Exit::Gate => {
                Ok(Worn { garment: outcome.garment, passed: outcome.exit == Exit::Good, findings })
            }
            exit => Err(Halt { findings, source: Some(text), exit }),
        }
    }
}
