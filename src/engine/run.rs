//! Runs a checked chain.

use super::cache::{Cache, CacheOptions, Entry};
use super::codes;
use super::content::program;
use super::exit::{Exit, of_file_error, of_stage_error};
use super::failure;
use super::files::{FileRead, RunFiles};
use super::gate::{Gate, output_below, refused};
use super::meter::{Meter, peak_mb};
use super::outputs::{Outputs, Plan, RECORD_NAME};
use super::preflight::planned_outputs;
use super::preview::{self, PREVIEW_NAME, Preview};
use super::record::{GarmentCounts, OutputRecord, RunIdentity, RunRecord, StageRun};
use super::same::known_inputs;
use super::stop::Stop;
use crate::pipeline::{Pipeline, Step};
use crate::progress::Teller;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toile_formats::report::{Language, verdict};
use toile_garment::garment::EffectRecord;
use toile_garment::provenance::InputRecord;
use toile_garment::{Diagnostic, Garment, Report};
use toile_stage_api::{StageContext, StageError};

/// The caller's wishes for a run.
#[derive(Clone, Debug)]
pub struct RunOptions {
    /// Output folder.
    pub out: PathBuf,
    /// Show the garment on the way, in a file of its own?
    pub preview: bool,
    /// Replace files that are there?
    pub force: bool,
    /// Threads.
    pub threads: usize,
    /// Further folders for outputs.
    pub allow_write: Vec<PathBuf>,
    /// Overrides, for the record.
    pub set: Vec<String>,
    /// Accuracy that was asked for, for the record.
    pub accuracy: Option<String>,
    /// Repeats that were asked for, for the record.
    pub repeats: Option<u32>,
    /// Name and bytes of the pipeline file, for the record.
    pub pipeline_file: (String, Vec<u8>),
    /// Key of the content that was foreseen, and the files that it counts.
    pub foreseen: Option<(String, Vec<FileRead>)>,
    /// Where results of stages are kept.
    pub cache: Option<CacheOptions>,
}

/// The result of a run.
pub struct Outcome {
    /// How it ended.
    pub exit: Exit,
    /// Its record; `None` when it was refused before it began.
    pub record: Option<RunRecord>,
    /// Findings of the whole run.
    pub findings: Vec<Diagnostic>,
    /// The garment as far as it got.
    pub garment: Garment,
}

/// Runs the chain. Outputs appear only if every stage did its work; `run.json` is written in any case.
pub fn run(
    pipeline: &Pipeline<'_>,
    gate: Gate,
    options: &RunOptions,
    stop: &Arc<Stop>,
    teller: &mut Teller,
    report: Report,
) -> Outcome {
    let mut planned = planned_outputs(&pipeline.steps);
    if options.preview {
        // Found now, and not when the work is done.
        let same = |p: &&PathBuf| {
            output_below(p).is_ok_and(|below| below.to_string_lossy().eq_ignore_ascii_case(PREVIEW_NAME))
        };
        if let Some(taken) = planned.iter().find(same) {
            let error = refused(taken, "the preview has this name; give the output another, or run without --preview");
            return refuse(&error, report, teller);
        }
        planned.push(PathBuf::from(PREVIEW_NAME));
    }
    let plan = Plan {
        allow_write: options.allow_write.clone(),
        outputs: planned,
        inputs: known_inputs(pipeline, &gate, Path::new(&options.pipeline_file.0)),
        force: options.force,
    };
    let outputs = match Outputs::open(&options.out, &plan, Arc::clone(stop)) {
        Ok(outputs) => outputs,
        Err(error) => return refuse(&error, report, teller),
    };
    let mut report = report;
    report.findings.extend(outputs.changed().iter().map(|name| kept(name)));
    if options.preview {
        teller.show_in(Preview::new(outputs.root().join(PREVIEW_NAME)));
    }
    failure::sweep(outputs.root());
    preview::sweep(outputs.root(), &plan.inputs);
    let mut files = RunFiles::new(gate, outputs);
    for path in &pipeline.beside {
        // One that cannot be read chose nothing, and that is told.
        drop(toile_stage_api::Files::read_optional(&mut files, path));
    }
    let mut run = Run::new(pipeline, options, files, stop, teller, report);
    let exit = run.chain(pipeline);
    run.finish(exit)
}

fn refuse(error: &toile_stage_api::FileError, mut report: Report, teller: &mut Teller) -> Outcome {
    let (findings, exit) = of_file_error(error);
    teller.findings(&findings);
    report.findings.extend(findings);
    Outcome { exit, record: None, findings: report.findings, garment: Garment::default() }
}

/// An output of an earlier run that is no longer what that run wrote.
fn kept(name: &str) -> Diagnostic {
    let message = format!("`{name}` is an output of an earlier run that was changed since; it stays as it is");
    Diagnostic::warning(codes::EARLIER_OUTPUT_CHANGED, message)
        .hint("it does not belong to this run; move it elsewhere")
}

struct Run<'a> {
    record: RunRecord,
    report: Report,
    told: usize,
    /// In the record only: a changed comment must not change the document.
    pipeline_file: InputRecord,
    garment: Garment,
    files: RunFiles,
    stop: &'a Arc<Stop>,
    teller: &'a mut Teller,
    started: Meter,
    foreseen: Vec<FileRead>,
    cache: Option<Cache>,
}

impl<'a> Run<'a> {
    fn new(
        pipeline: &Pipeline<'_>,
        options: &RunOptions,
        files: RunFiles,
        stop: &'a Arc<Stop>,
        teller: &'a mut Teller,
        report: Report,
    ) -> Self {
        let identity = RunIdentity {
            toile: env!("CARGO_PKG_VERSION").to_owned(),
            program: program().to_owned(),
            key: options.foreseen.as_ref().map(|(key, _)| key.clone()),
            pipeline: format!("{} v{}", pipeline.line, pipeline.version),
        };
        let mut garment = Garment::default();
        garment.provenance.toile.clone_from(&identity.toile);
        garment.provenance.pipeline.clone_from(&identity.pipeline);
        garment.provenance.seed = pipeline.seed;
        let record = RunRecord {
            identity,
            status: Exit::Stopped.word(),
            exit_code: Exit::Stopped.code(),
            set: options.set.clone(),
            accuracy: options.accuracy.clone(),
            repeats: options.repeats,
            inputs: Vec::new(),
            seed: pipeline.seed,
            threads: options.threads,
            seconds: 0.0,
            programs: pipeline.contents.clone(),
            stages: Vec::new(),
            effects: Vec::new(),
            findings: Vec::new(),
            certificate: None,
            motion: None,
            garment: GarmentCounts::default(),
            outputs: Vec::new(),
        };
        let (path, bytes) = &options.pipeline_file;
        let pipeline_file = InputRecord { path: path.clone(), blake3: blake3::hash(bytes).to_hex().to_string() };
        let foreseen = options.foreseen.as_ref().map(|(_, reads)| reads.clone()).unwrap_or_default();
        let cache = options.cache.as_ref().map(Cache::open);
        let started = Meter::start();
        Self { record, report, told: 0, pipeline_file, garment, files, stop, teller, started, foreseen, cache }
    }

    fn chain(&mut self, pipeline: &Pipeline<'_>) -> Exit {
        let has_page = failure::has_page(&pipeline.steps);
        self.teller.keep_looks(has_page);
        for (number, step) in pipeline.steps.iter().enumerate() {
            if self.stop.asked() {
                return Exit::Stopped;
            }
            self.teller.stage_start(number + 1, pipeline.steps.len(), &step.id);
            self.remember();
            let before = has_page.then(|| self.garment.clone());
            let exit = self.step(step);
            let seconds = self.record.stages.last().map_or(0.0, |s| s.seconds);
            self.tell_findings();
            self.teller.stage_end(&step.id, seconds, exit.word());
            if exit != Exit::Good {
                self.show_failure(pipeline, before, exit);
                return exit;
            }
        }
        self.gate()
    }

    /// Shows the garment as it was last seen, else as it was before the stage that failed.
    fn show_failure(&mut self, pipeline: &Pipeline<'_>, before: Option<Garment>, exit: Exit) {
        let Some(garment) = self.teller.last_look().or(before) else { return };
        if matches!(exit, Exit::Input | Exit::Usage | Exit::Unstable) {
            let folder = self.files.outputs().root().to_path_buf();
            let files = &mut self.files;
            if let Some(page) = failure::write(&pipeline.steps, &garment, &self.report, &folder, files) {
                self.teller.note(&format!("the garment as far as it came: {}", page.display()));
            }
        }
    }

    /// Leaves word for the case that the program has to go without coming back here.
    fn remember(&mut self) {
        self.fill_record();
        let path = self.files.outputs().root().join(RECORD_NAME);
        self.stop.set_last_words(Some((path, self.record.to_text())));
    }

    fn step(&mut self, step: &Step<'_>) -> Exit {
        let info = step.ready.info();
        let params = step.ready.params();
        let before = self.report.findings.len();
        if !info.reads_outdated {
            self.garment.forget_outdated(&info.gives);
        }
        step.ready.check(&self.garment, &mut self.report);
        if self.errors_since(before) {
            return Exit::Input;
        }
        let checked = self.report.findings.len();
        self.garment.provenance.inputs = self.files.inputs().to_vec();
        self.garment.provenance.stages.push(step.record());
        let meter = Meter::start();
        let key = self.cache_key(step);
        let restored = key.as_deref().and_then(|key| self.restore(key));
        let cached = restored.is_some();
        let result = restored.unwrap_or_else(|| self.work(step));
        self.record.stages.push(StageRun {
            name: info.name.to_string(),
            id: step.id.clone(),
            revision: info.revision,
            params,
            seconds: meter.seconds(),
            cpu_seconds: meter.cpu_seconds(),
            peak_mb: peak_mb(),
            cached,
        });
        let exit = match result {
            Ok(garment) => self.take(garment, before),
            Err(error) => self.fail(step, error),
        };
        if let Some(key) = key.filter(|_| !cached && exit == Exit::Good && Cache::is_worth(meter.seconds())) {
            self.keep(&key, info.gives.is_empty(), checked);
        }
        if exit != Exit::Good && self.stop.asked() { Exit::Stopped } else { exit }
    }

    /// First key of a stage, where there is a cache.
    fn cache_key(&mut self, step: &Step<'_>) -> Option<String> {
        self.files.begin_stage(self.cache.is_some());
        self.cache.as_ref()?;
        let (info, params) = (step.ready.info(), step.ready.params());
        Cache::key(&info, &params, self.record.seed, &mut self.garment, &self.report.findings)
    }

    /// The result of a stage from the cache, with its outputs written and its files taken as read.
    fn restore(&mut self, key: &str) -> Option<Result<Garment, StageError>> {
        let files = &self.files;
        let entry = self.cache.as_mut()?.find(key, |path| files.content(path))?;
        self.files.take_as_read(&entry.reads).ok()?;
        for (path, bytes) in &entry.writes {
            if let Err(error) = toile_stage_api::Files::write(&mut self.files, path, bytes) {
                return Some(Err(error.into()));
            }
        }
        self.report.findings.extend(entry.findings);
        let provenance = std::mem::take(&mut self.garment.provenance);
        Some(Ok(Garment { provenance, ..entry.garment }))
    }

    /// Keeps the result of a stage, with the findings since `before`. One that gives something and writes files, too,
    /// may write its history: it is not kept.
    fn keep(&mut self, key: &str, is_tap: bool, before: usize) {
        let (reads, writes) = self.files.end_stage();
        let Some(cache) = self.cache.as_mut().filter(|_| is_tap || writes.is_empty()) else { return };
        let findings = self.report.findings[before..].to_vec();
        cache.keep(key, Entry { reads, garment: self.garment.clone(), findings, writes });
    }

    /// Tells what was wrong with the cache: at the end, so that it does not get into an output.
    fn close_cache(&mut self) {
        let Some((damaged, unwritten)) = self.cache.take().map(Cache::close) else { return };
        if damaged > 0 {
            let message = format!("{damaged} files of the cache were damaged; they were removed and not used");
            self.report.push(Diagnostic::warning(codes::CACHE_DAMAGED, message).hint("look at the disk of the cache"));
        }
        if let Some(reason) = unwritten {
            let message = format!("the cache could not be written: {reason}");
            let finding = Diagnostic::warning(codes::CACHE_NOT_WRITTEN, message);
            self.report.push(finding.hint("give --cache a folder with space and rights"));
        }
    }

    fn work(&mut self, step: &Step<'_>) -> Result<Garment, StageError> {
        let garment = std::mem::take(&mut self.garment);
        // A stage that moves the cloth may keep the certificate of the shape that it was given.
        let certificate = garment.certificate.clone();
        let drape = garment.drape.clone().filter(|_| certificate.is_some());
        let mut cx = StageContext {
            report: &mut self.report,
            progress: &mut *self.teller,
            files: &mut self.files,
            cancel: self.stop.flag(),
            seed: self.record.seed,
            threads: self.record.threads,
        };
        let guarded = catch_unwind(AssertUnwindSafe(|| step.ready.run(garment, &mut cx)));
        let result = guarded.unwrap_or_else(|panic| Err(StageError::Internal(super::panic_text(panic.as_ref()))));
        let info = step.ready.info();
        result.map(|mut garment| {
            if info.reads_outdated {
                garment.forget_outdated(&info.gives);
            }
            garment.forget_stale_certificate(drape.as_ref(), certificate.as_ref());
            garment
        })
    }

    fn take(&mut self, garment: Garment, before: usize) -> Exit {
        self.garment = garment;
        // Times belong into the record alone: in the document they would change its bytes from run to run.
        for effect in &mut self.garment.effects {
            let cost = std::mem::take(&mut effect.cpu_seconds);
            let known = self.record.effects.iter().position(|e| e.name == effect.name);
            let before = known.map_or(0.0, |i| self.record.effects.remove(i).cpu_seconds);
            self.record.effects.push(EffectRecord { cpu_seconds: before + cost, ..effect.clone() });
        }
        if self.errors_since(before) { Exit::Input } else { Exit::Good }
    }

    fn fail(&mut self, step: &Step<'_>, error: StageError) -> Exit {
        let (findings, exit) = of_stage_error(error);
        for mut finding in findings {
            finding.source = finding.source.or_else(|| Some(place_of(step, &finding.message)));
            self.report.push(finding);
        }
        exit
    }

    fn errors_since(&self, before: usize) -> bool {
        self.report.findings[before..].iter().any(|f| f.severity == toile_garment::Severity::Error)
    }

    fn tell_findings(&mut self) {
        self.teller.findings(&self.report.findings[self.told..]);
        self.told = self.report.findings.len();
    }

    fn gate(&mut self) -> Exit {
        if self.garment.certificate.as_ref().is_none_or(|c| c.passed) {
            return Exit::Good;
        }
        let why = verdict(&self.garment, &[], Language::English).why;
        let message = format!("the certificate did not pass: {}", why.trim_end_matches('.'));
        let hint = "the outputs are written for looking at; `limits` in run.json says what was asked";
        self.report.push(Diagnostic::error(codes::CERTIFICATE_FAILED, message).hint(hint));
        self.tell_findings();
        Exit::Gate
    }

    fn fill_record(&mut self) {
        self.record.inputs = vec![self.pipeline_file.clone()];
        self.record.inputs.extend_from_slice(self.files.inputs());
        let is_foreseen = |i: &InputRecord| self.foreseen.iter().any(|f| Gate::shown(&f.path) == i.path);
        if !self.files.inputs().iter().all(is_foreseen) {
            self.record.identity.key = None;
        }
        self.record.findings.clone_from(&self.report.findings);
        self.record.certificate.clone_from(&self.garment.certificate);
        self.record.motion = self.garment.animation.as_ref().and_then(|a| a.certificate.clone());
        self.record.garment = GarmentCounts::of(&self.garment);
        self.record.seconds = self.started.seconds();
    }

    fn finish(mut self, exit: Exit) -> Outcome {
        let mut exit = if exit == Exit::Good && self.stop.asked() { Exit::Stopped } else { exit };
        if let Some(reason) = self.stop.reason().filter(|_| exit == Exit::Stopped) {
            let hint = "`toile plan` shows what each stage takes; a coarser mesh takes less";
            self.report.push(Diagnostic::error(codes::OVER_LIMIT, reason).hint(hint));
            exit = Exit::System;
        }
        self.close_cache();
        self.tell_findings();
        self.fill_record();
        self.record.end(exit);
        let written = if matches!(exit, Exit::Good | Exit::Gate) {
            let list = self.files.outputs().list();
            self.record.outputs = list.into_iter().map(|(path, blake3)| OutputRecord { path, blake3 }).collect();
            self.files.outputs_mut().commit(self.record.to_text().as_bytes())
        } else {
            self.stop.set_last_words(None);
            self.files.outputs().write_record(self.record.to_text().as_bytes())
        };
        if let Err(error) = written {
            let (findings, worse) = of_file_error(&error);
            exit = if exit == Exit::Good || exit == Exit::Gate { worse } else { exit };
            findings.into_iter().for_each(|f| self.report.push(f));
            self.tell_findings();
            self.fill_record();
            self.record.outputs.clear();
            self.record.end(exit);
            self.stop.set_last_words(None);
            // It is said already that the disk refuses.
            drop(self.files.outputs().write_record(self.record.to_text().as_bytes()));
        }
        self.teller.run_end(exit.word(), self.record.seconds);
        Outcome { exit, record: Some(self.record), findings: self.report.findings, garment: self.garment }
    }
}

/// The parameter that a message speaks of, else the stage.
fn place_of(step: &Step<'_>, message: &str) -> toile_garment::SourceRef {
    let named = step.paths.iter().find(|p| message.contains(&format!("`{}`", p.text)));
    named.map_or_else(|| step.place.clone(), |p| p.place.clone())
}

/// Default output folder.
#[must_use]
pub fn default_out(pipeline: &Pipeline<'_>) -> PathBuf {
    Path::new("out").join(format!("{}-v{}", pipeline.line, pipeline.version))
}
