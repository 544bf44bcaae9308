//! Runs the trials of one case and takes down its figures.

use super::case::{Row, Tolerance, judge};
use super::options::Options;
use crate::motion::Motion;
use crate::support::draped::Draped;
use crate::support::film::Film;
use crate::support::program::{self, Ended};
use crate::support::trial::Trial;
use std::path::PathBuf;
use toile_garment::Vec3;

/// Runs the trials of one case and takes down its figures.
pub struct Lab<'a> {
    name: String,
    options: &'a Options,
    pub rows: Vec<Row>,
    used: f64,
    since_row: f64,
    notes: Vec<String>,
    /// Largest of the runs behind the next figure.
    residual: f64,
    runs: usize,
}

impl<'a> Lab<'a> {
    pub fn new(name: &str, options: &'a Options) -> Self {
        let name = name.to_owned();
        Self { name, options, rows: Vec::new(), used: 0.0, since_row: 0.0, notes: Vec::new(), residual: 0.0, runs: 0 }
    }

    /// A figure of this case.
    pub fn figure(&mut self, target: impl Into<String>, measured: f64, expected: f64, tolerance: Tolerance) {
        let (error, verdict) = judge(measured, expected, tolerance);
        if self.residual > 0.1 {
            self.note(format!("residual {:.1e}", self.residual));
        }
        let (cpu, note) = (self.take_cpu(), self.notes.join("; "));
        self.notes.clear();
        self.residual = 0.0;
        let (case, target) = (self.name.clone(), target.into());
        self.rows.push(Row { case, target, measured: Some(measured), expected, error, tolerance, verdict, cpu, note });
    }

    pub fn note(&mut self, words: impl Into<String>) {
        let words = words.into();
        if !self.notes.contains(&words) {
            self.notes.push(words);
        }
    }

    pub fn take_cpu(&mut self) -> f64 {
        std::mem::take(&mut self.since_row)
    }

    /// `import-mesh` → `drape` → `export-obj`.
    pub fn drape(&mut self, trial: &Trial) -> Result<Draped, String> {
        let run = self.run(trial)?;
        let draped = Draped::read(&run)?;
        if !draped.settled {
            self.note("not settled");
        }
        self.residual = self.residual.max(draped.certificate["residual_rel"].as_f64().unwrap_or(0.0));
        Ok(draped)
    }

    /// `import-mesh` → `drape` → `animate`, whose frames are read.
    pub fn film(&mut self, trial: &Trial, motion: &Motion) -> Result<Film, String> {
        let model: Vec<String> = self.options.drape.iter().filter(|k| k.starts_with("model")).cloned().collect();
        let run = self.run(&motion.of(trial, &model))?;
        if let Some(found) = run.findings().find(|f| f["code"] == "motion-not-solved") {
            self.note(found["message"].as_str().unwrap_or_default());
        }
        Film::read(&run, motion.fps)
    }

    /// Does the motion run to its end without energy from nothing? An unstable one does not.
    pub fn stable(&mut self, trial: &Trial, motion: &Motion) -> Result<bool, String> {
        let run = self.end(&motion.of(trial, &[]))?;
        if run.code == 4 { Ok(false) } else { sound(run).map(|run| !gains_energy(&run)) }
    }

    /// Does the motion run to its end with every vertex within `room` (m) of its place in the first frame?
    pub fn bounded(&mut self, trial: &Trial, motion: &Motion, room: f64) -> Result<bool, String> {
        let run = self.end(&motion.of(trial, &[]))?;
        if run.code == 4 {
            return Ok(false);
        }
        let film = Film::read(&sound(run)?, motion.fps)?;
        let first = &film.shots[0];
        let near = |shot: &Vec<Vec3>| shot.iter().zip(first).all(|(p, q)| (p - q).norm() <= room);
        Ok(film.shots.iter().all(near))
    }

    fn run(&mut self, trial: &Trial) -> Result<Ended, String> {
        self.end(trial).and_then(sound)
    }

    fn end(&mut self, trial: &Trial) -> Result<Ended, String> {
        self.runs += 1;
        let temporary = tempfile::tempdir().map_err(|e| e.to_string())?;
        let folder: PathBuf = match &self.options.common.keep {
            Some(folder) => folder.join(&self.name).join(self.runs.to_string()),
            None => temporary.path().to_path_buf(),
        };
        trial.write(&folder, &self.options.drape).map_err(|e| e.to_string())?;
        let run = program::run(&folder, self.options.common.cap - self.used, &[]);
        self.used += run.cpu;
        self.since_row += run.cpu;
        if run.code == 130 {
            return Err(format!("did not settle within {:.0} CPU s", self.options.common.cap));
        }
        Ok(run)
    }
}

/// Is the energy gate of the motion's certificate passed over?
fn gains_energy(run: &Ended) -> bool {
    let motion = &run.record["motion"];
    let [gain, gate] = [&motion["energy_gain"], &motion["limits"]["energy_gain"]].map(serde_json::Value::as_f64);
    gain > gate
}

fn sound(run: Ended) -> Result<Ended, String> {
    if run.code > 1 {
        let finding = run.findings().last().map(|f| f["message"].to_string());
        return Err(format!("exit code {}: {}", run.code, finding.unwrap_or(run.said)));
    }
    Ok(run)
}
