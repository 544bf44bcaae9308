//! One run of the grid: the chain up to its drape, in a folder of its own; a run that is through is not done again.

use super::carried::carried;
use super::choose::tuning;
use super::codes;
use super::grid::Setting;
use crate::codes::WRITE_FAILED;
use crate::engine::{
    self, Exit, Gate, Memory, RunOptions, RunRecord, Stop, is_unchanged, read_limited, run_ready, write_whole,
};
use crate::halt::Halt;
use crate::load::{self, Request};
use crate::pipeline::{Pipeline, cut_behind_drape, knob, turned_by};
use crate::progress::{Teller, Voice};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toile_formats::gltf;
use toile_garment::garment::{Certificate, Rests};
use toile_garment::provenance::InputRecord;
use toile_garment::{Diagnostic, Garment, Report, Severity};
use toile_stage_api::{Meaning, Registry, StageError};

/// File of the figures of a run, beside its garment.
const RESULT_NAME: &str = "result.json";
/// The draped garment.
const GARMENT_NAME: &str = "garment.glb";
/// The key of a garment that was carried.
const KEY_NAME: &str = "key";
/// Limits for reading these back.
const MAX_RESULT: u64 = 4 << 20;
const MAX_GARMENT: u64 = 1 << 30;

/// A run that is through.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Done {
    /// Its place in the grid.
    pub setting: Setting,
    /// Digest of program version, seed and the full parameters of every stage.
    pub key: String,
    /// Files that the run read.
    pub inputs: Vec<InputRecord>,
    /// How it ended, in a word.
    pub status: String,
    /// Why it has no drape.
    pub failure: Option<String>,
    /// Wall time up to the drape, s.
    pub seconds: f64,
    /// Time of all threads, s; wall time where the system does not tell.
    pub cpu_seconds: f64,
    /// The part of it that the drape took, s.
    #[serde(default)]
    pub drape_cpu_seconds: f64,
    /// Largest resident memory, MB, where the system tells.
    pub peak_mb: Option<f64>,
    /// Triangles of all pieces.
    pub triangles: usize,
    /// Certificate of the drape.
    pub certificate: Option<Certificate>,
}

/// A result with the garment it left.
pub struct Ran {
    /// Figures.
    pub done: Done,
    /// The garment; `None` when the run failed.
    pub garment: Option<Garment>,
    /// Was it there already?
    pub resumed: bool,
    /// How far apart rests from shaken starts lie, where it was measured.
    pub scatter: Option<Rests>,
    /// The garment after the finest drape was carried onto its mesh and came to rest there.
    pub carried: Option<Garment>,
}

/// The data that all runs of a study share.
#[derive(Clone)]
pub struct Bench<'a> {
    /// The pipeline and what it may do.
    pub request: Request,
    /// Folder of the study.
    pub out: PathBuf,
    /// Threads.
    pub threads: usize,
    /// Do finished runs again?
    pub force: bool,
    /// How progress is told. Silent runs leave their findings to whom they halt for.
    pub voice: Voice,
    /// Stop.
    pub stop: &'a Arc<Stop>,
}

impl Bench<'_> {
    /// The bench on which every setting is draped again from so many shaken starts. It has a folder of its own.
    #[must_use]
    pub fn shaken(&self, starts: u32) -> Self {
        let request = Request { repeats: Some(starts), ..self.request.clone() };
        Self { request, out: self.out.join("starts"), ..self.clone() }
    }

    /// Folder of a run.
    #[must_use]
    pub fn folder(&self, setting: &Setting) -> PathBuf {
        self.out.join("runs").join(setting.name())
    }

    /// Runs one setting, or takes what an earlier study left.
    ///
    /// # Errors
    /// When the pipeline is wrong, the disk refuses, or the user stops.
    pub fn run(&self, setting: &Setting, registry: &mut Registry) -> Result<Ran, Halt> {
        let request = Request { tuning: tuning(setting), ..self.request.clone() };
        let (drape, _) = turned_by(registry, Meaning::Tolerance);
        let mut loaded = load::load(&request, self.stop, registry);
        let text = loaded.text().map(|(file, text)| (file.to_owned(), text.to_owned()));
        if loaded.report.has_errors() {
            let exit = loaded.exit();
            return Err(Halt { findings: loaded.report.findings, source: text, exit });
        }
        let (Some(mut pipeline), Some(gate)) = (loaded.pipeline.take(), loaded.gate.take()) else {
            return Err(Halt { findings: loaded.report.findings, source: text, exit: Exit::Usage });
        };
        let wrong = |finding| Halt { findings: vec![finding], source: text.clone(), exit: Exit::Usage };
        cut(&mut pipeline, &drape).map_err(wrong)?;
        varies(&pipeline, setting).map_err(wrong)?;
        let key = key(&pipeline);
        if !self.force
            && let Some(result) = self.resume(setting, &key, &gate)
        {
            return Ok(result);
        }
        self.work(setting, key, &pipeline, gate, text.unwrap_or_default())
    }

    /// Carries the finest drape onto the mesh of a run and lets it come to rest there, or takes what an earlier study left.
    /// `None` where it cannot come to rest.
    ///
    /// # Errors
    /// When the disk refuses, or the user stops.
    pub fn carry(&self, coarse: &Ran, finest: &Ran, registry: &mut Registry) -> Result<Option<Garment>, Halt> {
        let setting = coarse.done.setting;
        let folder = self.out.join("runs").join(setting.name() + "-carried");
        let read = |ran: &Ran| serde_json::json!([ran.done.key, ran.done.inputs]);
        let key = engine::digest(&serde_json::json!([read(coarse), read(finest)]));
        if !self.force
            && let Some(garment) = kept(&folder, &key)
        {
            return Ok(Some(garment));
        }
        // A garment that was read back has no body any more.
        let fresh = Self { force: true, ..self.clone() };
        let again = coarse.resumed.then(|| fresh.run(&setting, registry)).transpose()?;
        let start = again.as_ref().unwrap_or(coarse).garment.as_ref().zip(finest.garment.as_ref());
        let Some(start) = start.and_then(|(cloth, shape)| carried(cloth, shape)) else { return Ok(None) };
        let Some(draped) = self.drape(&setting, start, registry)? else { return Ok(None) };
        std::fs::create_dir_all(&folder).map_err(|e| refused(&folder, &e))?;
        store(&folder, Some(&draped), (KEY_NAME, &key))?;
        Ok(Some(draped))
    }

    /// Drapes a garment as the chain of a setting does. `None` where it does not come to rest.
    fn drape(&self, setting: &Setting, start: Garment, registry: &mut Registry) -> Result<Option<Garment>, Halt> {
        let request = Request { tuning: tuning(setting), ..self.request.clone() };
        let mut loaded = load::load(&request, self.stop, registry);
        let Some(mut pipeline) = loaded.pipeline.take() else { return Ok(None) };
        let drapes = cut_behind_drape(&mut pipeline);
        let Some(drape) = pipeline.steps.last().filter(|_| drapes) else { return Ok(None) };
        let (report, files) = (&mut Report::default(), &mut Memory::default());
        match run_ready(drape.ready.as_ref(), start, (self.stop, self.threads), report, files) {
            Err(StageError::Cancelled) => Err(Halt::new(Vec::new(), Exit::Stopped)),
            other => Ok(other.ok()),
        }
    }

    /// A result is taken only if settings, program version and every file it read are as they were.
    fn resume(&self, setting: &Setting, key: &str, gate: &Gate) -> Option<Ran> {
        let folder = self.folder(setting);
        let path = folder.join(RESULT_NAME);
        let done: Done = serde_json::from_slice(&read_limited(&path, &path, MAX_RESULT).ok()?).ok()?;
        if done.key != key || !done.inputs.iter().all(|input| is_unchanged(input, gate)) {
            return None;
        }
        let garment = match done.failure {
            Some(_) => None,
            None => Some(garment_in(&folder)?),
        };
        Some(Ran { done, garment, resumed: true, scatter: None, carried: None })
    }

    fn work(
        &self,
        setting: &Setting,
        key: String,
        pipeline: &Pipeline<'_>,
        gate: Gate,
        (file, text): (String, String),
    ) -> Result<Ran, Halt> {
        let options = RunOptions {
            out: self.folder(setting),
            force: true,
            preview: false,
            threads: self.threads,
            allow_write: Vec::new(),
            set: self.request.set.clone(),
            accuracy: self.request.accuracy.clone(),
            repeats: self.request.repeats,
            pipeline_file: (file, text.into_bytes()),
            foreseen: None,
            cache: None,
        };
        // A killed run must not be taken for the one before it.
        drop(std::fs::remove_file(options.out.join(RESULT_NAME)));
        let mut teller = Teller::new(self.voice, None);
        engine::reset_peak();
        let outcome = engine::run(pipeline, gate, &options, self.stop, &mut teller, Report::default());
        drop(teller);
        let Some(record) = outcome.record.filter(|_| goes_on(outcome.exit)) else {
            let findings = if self.voice == Voice::Silent { outcome.findings } else { Vec::new() };
            return Err(Halt { findings, source: None, exit: outcome.exit });
        };
        let draped = matches!(outcome.exit, Exit::Good | Exit::Gate);
        let failure = (!draped).then(|| first_error(&outcome.findings));
        let done = Done::of(*setting, key, &record, failure);
        let garment = draped.then_some(outcome.garment);
        let figures = serde_json::to_string_pretty(&done).map_err(|e| refused(&options.out, &e))?;
        store(&options.out, garment.as_ref(), (RESULT_NAME, &figures))?;
        Ok(Ran { done, garment, resumed: false, scatter: None, carried: None })
    }
}

/// Writes the garment of a run, then the file that says it is whole: who finds that file finds the garment.
fn store(folder: &Path, garment: Option<&Garment>, (name, text): (&str, &str)) -> Result<(), Halt> {
    if let Some(garment) = garment {
        let bytes = gltf::write_garment(garment).map_err(|e| refused(folder, &e))?;
        write_whole(&folder.join(GARMENT_NAME), &bytes).map_err(|e| refused(folder, &e))?;
    }
    write_whole(&folder.join(name), text.as_bytes()).map_err(|e| refused(folder, &e))
}

fn refused(folder: &Path, why: &dyn std::fmt::Display) -> Halt {
    let message = format!("cannot write the run into `{}`: {why}", engine::clean(folder));
    Halt::new(vec![Diagnostic::error(WRITE_FAILED, message)], Exit::System)
}

/// The garment of a folder.
fn garment_in(folder: &Path) -> Option<Garment> {
    let path = folder.join(GARMENT_NAME);
    gltf::read_garment(&read_limited(&path, &path, MAX_GARMENT).ok()?).ok()
}

/// The garment of a folder, if it was made under this key.
fn kept(folder: &Path, key: &str) -> Option<Garment> {
    let path = folder.join(KEY_NAME);
    let is_same = read_limited(&path, &path, MAX_RESULT).ok()? == key.as_bytes();
    if is_same { garment_in(folder) } else { None }
}

impl Done {
    fn of(setting: Setting, key: String, record: &RunRecord, failure: Option<String>) -> Self {
        let cpu: Option<f64> = record.stages.iter().map(|s| s.cpu_seconds).sum();
        let peaks = record.stages.iter().filter_map(|s| s.peak_mb);
        Self {
            setting,
            key,
            // The first is the pipeline file: its meaning is in the key.
            inputs: record.inputs.iter().skip(1).cloned().collect(),
            status: record.status.to_owned(),
            failure,
            seconds: record.seconds,
            cpu_seconds: cpu.unwrap_or(record.seconds),
            drape_cpu_seconds: record.stages.last().and_then(|s| s.cpu_seconds).unwrap_or_default(),
            peak_mb: peaks.fold(None, |most: Option<f64>, mb| Some(most.map_or(mb, |m| m.max(mb)))),
            triangles: record.garment.triangles,
            certificate: record.certificate.clone(),
        }
    }
}

/// Cuts the chain behind its drape. `drape` is the stage to tell of where there is none.
fn cut(pipeline: &mut Pipeline<'_>, drape: &str) -> Result<(), Diagnostic> {
    if cut_behind_drape(pipeline) {
        return Ok(());
    }
    let message = format!("`{}` drapes nothing: drapes are compared, and they need a stage `{drape}`", pipeline.line);
    let hint = format!("add `use = \"{drape}\"` to the chain");
    Err(Diagnostic::error(codes::STUDY_NO_DRAPE, message).hint(hint))
}

/// An override must not hold fast what the study varies: all its rows would be one. The last stage with a knob decides
/// what comes out.
fn varies(pipeline: &Pipeline<'_>, setting: &Setting) -> Result<(), Diagnostic> {
    for (meaning, value) in tuning(setting) {
        let mut steps = pipeline.steps.iter().rev();
        let Some((step, key)) = steps.find_map(|s| Some((s, &knob(s.ready.knobs(), meaning)?.key))) else { continue };
        let params = step.ready.params();
        let found = params.pointer(&format!("/{}", key.replace('.', "/")));
        let found = found.and_then(serde_json::Value::as_str).unwrap_or("");
        if found != value {
            let message = format!("`{}.{key}` is held at `{found}`, but this command varies it", step.id);
            return Err(Diagnostic::error(codes::STUDY_HELD, message).hint("leave out that --set"));
        }
    }
    Ok(())
}

fn key(pipeline: &Pipeline<'_>) -> String {
    engine::digest(&serde_json::json!([env!("CARGO_PKG_VERSION"), engine::chain(pipeline)]))
}

/// A setting that cannot be draped is a result too; a full disk or a stop is none.
fn goes_on(exit: Exit) -> bool {
    matches!(exit, Exit::Good | Exit::Gate | Exit::Usage | Exit::Input | Exit::Unstable)
}

fn first_error(findings: &[Diagnostic]) -> String {
    let error = findings.iter().find(|f| f.severity == Severity::Error);
    error.map_or_else(|| "it failed without saying why".to_owned(), |f| f.message.clone())
}
