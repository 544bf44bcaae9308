//! Looking ahead: a walk along the chain that asks every stage what it will need, from the files alone.

use super::exit::{Exit, of_stage_error};
use super::files::TracedFiles;
use super::gate::Gate;
use super::stop::Stop;
use crate::pipeline::{Pipeline, Step};
use std::panic::{AssertUnwindSafe, catch_unwind};
use toile_garment::{Diagnostic, Report, Severity};
use toile_stage_api::{Cost, Forecast, StageContext, StageError};

/// Memory of the program, its libraries and a pattern, MB.
const PROGRAM_MB: f64 = 13.0;
/// Memory of a body with its search tree, MB for 1000 triangles: the bodies of `samples/` have about 12,000.
const BODY_MB_PER_THOUSAND: f64 = 0.85;

/// The forecast of a whole chain.
pub struct Foresight {
    /// Mesh and effects.
    pub forecast: Forecast,
    /// One for each stage of the chain, with the memory of the whole program; `None` where nothing can be said.
    pub stages: Vec<Option<Cost>>,
    /// Mistakes in the files.
    pub findings: Vec<Diagnostic>,
    /// Notes and warnings of the stages, which a run tells again.
    pub notes: Vec<Diagnostic>,
    /// How a run would end already now.
    pub exit: Exit,
}

impl Foresight {
    /// CPU seconds of all stages that can be foreseen.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        self.stages.iter().flatten().map(|e| e.seconds).sum()
    }

    /// Memory of the program in the stage that takes most, MB.
    #[must_use]
    pub fn mb(&self) -> f64 {
        self.stages.iter().flatten().map(|e| e.mb).fold(0.0, f64::max)
    }

    /// Adds the next stage. Memory that was needed once stays with the program.
    fn add(&mut self, cost: Option<Cost>) {
        let body = self.forecast.garment.body.as_ref().map_or(0, |b| b.triangles.len()) as f64 * 1e-3;
        let whole = |c: Cost| Cost { mb: (PROGRAM_MB + c.mb + BODY_MB_PER_THOUSAND * body).max(self.mb()), ..c };
        let whole = cost.map(whole);
        self.stages.push(whole);
    }

    /// The first failure decides how the program ends.
    fn fail(&mut self, findings: impl Iterator<Item = Diagnostic>, exit: Exit) {
        for finding in findings {
            if !self.findings.contains(&finding) {
                self.findings.push(finding);
            }
        }
        if self.exit == Exit::Good {
            self.exit = exit;
        }
    }
}

/// Reads pattern, fabrics and body, and nothing else; no stage works.
#[must_use]
pub fn foresee(pipeline: &Pipeline<'_>, gate: &Gate, stop: &Stop) -> Foresight {
    look_ahead(pipeline, &mut TracedFiles::new(gate), stop)
}

/// The same with files that remember what was looked for.
pub(super) fn look_ahead(pipeline: &Pipeline<'_>, files: &mut TracedFiles<'_>, stop: &Stop) -> Foresight {
    let mut seen = Foresight {
        forecast: Forecast::default(),
        stages: Vec::new(),
        findings: Vec::new(),
        notes: Vec::new(),
        exit: Exit::Good,
    };
    let mut report = Report::default();
    for step in &pipeline.steps {
        let mut cx = StageContext {
            report: &mut report,
            progress: &mut (),
            files: &mut *files,
            cancel: stop.flag(),
            seed: pipeline.seed,
            threads: 1,
        };
        seen.forecast.garment.provenance.stages.push(step.record());
        match ask(step, &mut seen.forecast, &mut cx) {
            Ok(cost) => seen.add(cost),
            // The other stages are asked all the same, so that all mistakes are found at once.
            Err(error) => {
                seen.add(None);
                let (findings, exit) = of_stage_error(error);
                let at = |f: Diagnostic| if f.source.is_none() { f.at(step.place.clone()) } else { f };
                seen.fail(findings.into_iter().map(at), exit);
            }
        }
    }
    let is_error = |f: &Diagnostic| f.severity == Severity::Error;
    let (errors, notes): (Vec<_>, Vec<_>) = report.findings.into_iter().partition(is_error);
    if !errors.is_empty() {
        seen.fail(errors.into_iter(), Exit::Input);
    }
    seen.notes = notes;
    seen
}

/// Asks a stage; a panic in it is a mistake of the program, as in a run.
fn ask(step: &Step<'_>, forecast: &mut Forecast, cx: &mut StageContext<'_>) -> Result<Option<Cost>, StageError> {
    let asked = catch_unwind(AssertUnwindSafe(|| step.ready.forecast(forecast, cx)));
    asked.unwrap_or_else(|panic| Err(StageError::Internal(super::panic_text(panic.as_ref()))))
}
