//! Runs the scenes of one case in one variant, and keeps what did not hold.

use crate::checks;
use crate::options::Options;
use crate::support::draped::Draped;
use crate::support::mesh::jitter::noise;
use crate::support::program::{self, Ended};
use crate::support::trial::Trial;
use std::path::Path;

/// How a run differs from the case as it is written.
#[derive(Clone, Debug, Default)]
pub struct Vary {
    pub accuracy: Option<String>,
    /// Number of the shaken start.
    pub jitter: Option<u64>,
}

impl Vary {
    /// `fine, start 3: `, or nothing.
    pub fn words(&self) -> String {
        let parts = [self.accuracy.clone(), self.jitter.map(|j| format!("start {j}"))];
        let parts: Vec<String> = parts.into_iter().flatten().collect();
        if parts.is_empty() { String::new() } else { format!("{}: ", parts.join(", ")) }
    }
}

/// Runs and what became of them.
#[derive(Clone, Copy, Debug, Default)]
pub struct Count {
    pub runs: usize,
    /// Ended with a result.
    pub accepted: usize,
    pub refused: usize,
    pub converged: usize,
    pub not_finite: usize,
    pub crossings: usize,
    /// Did not come to rest, or failed, and no finding says so.
    pub silent: usize,
}

impl Count {
    pub fn add(&mut self, o: &Self) {
        self.runs += o.runs;
        self.accepted += o.accepted;
        self.refused += o.refused;
        self.converged += o.converged;
        self.not_finite += o.not_finite;
        self.crossings += o.crossings;
        self.silent += o.silent;
    }
}

/// Start shaken by at most this share of the thickness.
const SHAKE: f64 = 0.1;

/// By how far start `seed` is shaken at place `number`, m.
fn shake(thickness: f64, seed: u64, number: u64) -> f64 {
    SHAKE * thickness * noise(seed * 1_000_003 + number)
}

pub struct Lab<'a> {
    id: String,
    options: &'a Options,
    vary: Vary,
    pub failures: Vec<String>,
    pub notes: Vec<String>,
    pub count: Count,
    /// CPU time, s.
    pub used: f64,
}

impl<'a> Lab<'a> {
    pub fn new(id: &str, options: &'a Options, vary: Vary) -> Self {
        let (failures, notes, count) = (Vec::new(), Vec::new(), Count::default());
        Self { id: id.to_owned(), options, vary, failures, notes, count, used: 0.0 }
    }

    /// Notes a failure unless it holds.
    pub fn expect(&mut self, holds: bool, words: impl Into<String>) {
        if !holds {
            self.failures.push(words.into());
        }
    }

    /// The figure must not be over the limit; no number is over every limit.
    pub fn below(&mut self, what: &str, figure: f64, limit: f64) {
        self.expect(figure <= limit, format!("{what} {figure:.4e}, at most {limit:.1e}"));
    }

    /// The figure must be this, give or take a share.
    pub fn near(&mut self, what: &str, figure: f64, wanted: f64, share: f64) {
        let off = (figure / wanted - 1.0).abs();
        self.expect(off <= share, format!("{what} {figure:.5e} instead of {wanted:.5e} ± {} %", share * 100.0));
    }

    pub fn note(&mut self, words: impl Into<String>) {
        self.notes.push(words.into());
    }

    /// The scene with its start shaken as the variant asks; held vertices stay.
    pub fn shaken(&self, trial: &Trial) -> Trial {
        self.vary.jitter.map_or_else(|| trial.clone(), |seed| Self::shaken_as(trial, seed))
    }

    /// The scene with its start shaken in the way that has this number.
    pub fn shaken_as(trial: &Trial, seed: u64) -> Trial {
        let mut trial = trial.clone();
        let thickness = trial.fabric.thickness;
        for (v, p) in trial.cloth.at.iter_mut().enumerate() {
            if !trial.pins.iter().any(|(pin, _)| *pin == v) {
                let n = |k: u64| shake(thickness, seed, 3 * v as u64 + k);
                *p += toile_garment::Vec3::new(n(0), n(1), n(2));
            }
        }
        trial
    }

    /// How exact the variant asks the program to be.
    pub fn accuracy(&self) -> Option<&str> {
        self.vary.accuracy.as_deref()
    }

    /// A way by which the variant shakes a start of this thickness, by number; nothing in the case as it is written.
    pub fn nudge(&self, thickness: f64, number: u64) -> f64 {
        self.vary.jitter.map_or(0.0, |seed| shake(thickness, seed, number))
    }

    /// The scene must be accepted, and all that holds for every run must hold; gives what came out.
    pub fn settles(&mut self, trial: &Trial) -> Result<Draped, String> {
        let shaken = self.shaken(trial);
        self.settles_as_is(&shaken)
    }

    /// The same without a shaken start.
    pub fn settles_as_is(&mut self, trial: &Trial) -> Result<Draped, String> {
        let run = self.run(trial, &[])?;
        self.judge(trial, &run)
    }

    /// Accepted, or refused with this code.
    pub fn settles_or_refuses(&mut self, trial: &Trial, code: &str) -> Result<Option<Draped>, String> {
        let shaken = self.shaken(trial);
        let run = self.run(&shaken, &[])?;
        if run.code > 1 {
            self.refusal(&run, code);
            return Ok(None);
        }
        self.judge(&shaken, &run).map(Some)
    }

    /// The scene must be refused: exit code, code of the finding.
    pub fn refuses(&mut self, trial: &Trial, exit: u8, code: &str) -> Result<(), String> {
        let run = self.run(trial, &[])?;
        self.expect(run.code == exit, format!("{code}: exit code {} instead of {exit}: {}", run.code, words(&run)));
        self.refusal(&run, code);
        Ok(())
    }

    /// Runs a scene; gives what the program left.
    pub fn run(&mut self, trial: &Trial, more: &[&str]) -> Result<Ended, String> {
        let own = trial.drape.iter().any(|k| k.starts_with("accuracy"));
        let accuracy =
            self.vary.accuracy.iter().filter(|_| !own).map(|a| format!("accuracy = \"{a}\"")).collect::<Vec<_>>();
        self.program(more, |folder| trial.write(folder, &accuracy))
    }

    /// Runs the program in a folder that `write` fills.
    pub fn program(
        &mut self,
        more: &[&str],
        write: impl FnOnce(&Path) -> std::io::Result<()>,
    ) -> Result<Ended, String> {
        self.count.runs += 1;
        let temporary = tempfile::tempdir().map_err(|e| e.to_string())?;
        let folder = match &self.options.common.keep {
            Some(keep) => {
                let variant = self.vary.words().replace([':', ' ', ','], "");
                keep.join(&self.id).join(format!("{variant}{}", self.count.runs))
            }
            None => temporary.path().to_path_buf(),
        };
        std::fs::create_dir_all(&folder).and_then(|()| write(&folder)).map_err(|e| e.to_string())?;
        let run = program::run(&folder, self.options.common.cap - self.used, more);
        self.used += run.cpu;
        if run.code == 130 {
            self.count.accepted += 1;
            return Err(format!("no end within {:.0} CPU s", self.options.common.cap));
        }
        Ok(run)
    }

    /// The checks that hold for every accepted run.
    pub fn judge(&mut self, trial: &Trial, run: &Ended) -> Result<Draped, String> {
        if run.code > 1 {
            self.count.silent += usize::from(run.findings().next().is_none());
            self.count.accepted += 1;
            return Err(format!("exit code {}: {}", run.code, words(run)));
        }
        let draped = Draped::read(run)?;
        let accuracy =
            trial.drape.iter().find_map(|k| k.strip_prefix("accuracy = ")).map(|a| a.trim_matches('"').to_owned());
        let accuracy = accuracy.or_else(|| self.vary.accuracy.clone());
        let found = checks::universal(trial, run, &draped, accuracy.as_deref());
        self.count.accepted += 1;
        self.count.converged += usize::from(draped.settled);
        self.count.not_finite += usize::from(!found.finite);
        self.count.crossings += found.crossings;
        self.count.silent += usize::from(found.silent);
        self.failures.extend(found.failures);
        Ok(draped)
    }

    /// A refusal names its reason, the place and the remedy.
    pub fn refusal(&mut self, run: &Ended, code: &str) {
        self.count.refused += 1;
        let Some(finding) = run.findings().find(|f| f["code"] == code) else {
            return self.failures.push(format!("no finding `{code}` but: {}", words(run)));
        };
        let message = finding["message"].as_str().unwrap_or_default();
        let placed = finding["source"]["file"].is_string() || message.contains("near (");
        self.expect(placed, format!("`{code}` names no place: {message}"));
        let remedy = finding["hint"].as_str().is_some_and(|h| !h.is_empty());
        self.expect(remedy, format!("`{code}` names no remedy: {message}"));
    }
}

/// The last finding, or what the program said.
fn words(run: &Ended) -> String {
    let last = run.findings().filter(|f| f["severity"] == "error").last();
    last.map_or_else(|| run.said.clone(), |f| format!("[{}] {}", f["code"].as_str().unwrap_or(""), f["message"]))
}
