//! Looking ahead: what a chain will need, from its files alone.

use super::exit::{Exit, of_stage_error};
use super::files::ReadFiles;
use super::gate::Gate;
use super::stop::Stop;
use crate::pipeline::Pipeline;
use std::panic::{AssertUnwindSafe, catch_unwind};
use toile_garment::{Diagnostic, Report, Severity};
use toile_stage_api::{StageContext, StageError};
use toile_stages::outlook::{Expected, Outlook};

/// What was foreseen.
pub struct Foresight {
    /// Mesh and effects.
    pub outlook: Outlook,
    /// One for each stage of the chain; `None` where nothing can be said.
    pub stages: Vec<Option<Expected>>,
    /// What is wrong with the files.
    pub findings: Vec<Diagnostic>,
    /// How a run would end already now.
    pub exit: Exit,
}

impl Foresight {
    /// Seconds of all stages that can be foreseen.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        self.stages.iter().flatten().map(|e| e.seconds).sum()
    }

    /// Memory of the largest of them, MB.
    #[must_use]
    pub fn mb(&self) -> f64 {
        self.stages.iter().flatten().map(|e| e.mb).fold(0.0, f64::max)
    }
}

/// Reads pattern, fabrics and body, and nothing else; no stage works.
#[must_use]
pub fn foresee(pipeline: &Pipeline<'_>, gate: &Gate, stop: &Stop) -> Foresight {
    let mut seen =
        Foresight { outlook: Outlook::default(), stages: Vec::new(), findings: Vec::new(), exit: Exit::Good };
    let (mut report, mut files) = (Report::default(), ReadFiles(gate));
    for step in &pipeline.steps {
        let mut cx = StageContext {
            report: &mut report,
            progress: &mut (),
            files: &mut files,
            cancel: stop.flag(),
            seed: pipeline.seed,
            threads: 1,
        };
        let (name, params) = (step.ready.info().name, step.ready.params());
        let look = AssertUnwindSafe(|| seen.outlook.stage(&name, &params, &mut cx));
        let looked =
            catch_unwind(look).unwrap_or_else(|panic| Err(StageError::Internal(super::panic_text(panic.as_ref()))));
        match looked {
            Ok(expected) => seen.stages.push(expected),
            Err(error) => {
                let (findings, exit) = of_stage_error(error);
                let at = |f: Diagnostic| if f.source.is_none() { f.at(step.place.clone()) } else { f };
                seen.findings.extend(findings.into_iter().map(at));
                seen.exit = exit;
                return seen;
            }
        }
    }
    // Notes of the import are for the run; errors end it.
    seen.findings = report.findings.into_iter().filter(|f| f.severity == Severity::Error).collect();
    if !seen.findings.is_empty() {
        seen.exit = Exit::Input;
    }
    seen
}
