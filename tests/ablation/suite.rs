//! The cases of the suite, and their runs.

use crate::options::Options;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// A case: a pipeline, or one of the other harnesses.
pub struct Case {
    pub name: String,
    kind: Kind,
}

enum Kind {
    Pipeline(PathBuf),
    /// Name of a test target.
    Harness(&'static str),
}

/// The figures of a case.
#[derive(Clone, Debug, Default)]
pub struct Figures {
    pub passed: bool,
    /// CPU time of `stitch`, s.
    pub sewing: Option<f64>,
    /// CPU time of `drape`, s.
    pub draping: Option<f64>,
    /// Elastic energy of the result, J.
    pub energy: Option<f64>,
}

/// All cases that the options ask for, in a fixed order.
pub fn cases(options: &Options) -> Vec<Case> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut all: Vec<Case> = ["long-skirt", "fitted-bodice", "t-shirt"]
        .map(|line| Case { name: line.into(), kind: Kind::Pipeline(root.join(format!("pipelines/{line}/v1.toml"))) })
        .into();
    for folder in &options.projects {
        let inside = std::fs::read_dir(folder).into_iter().flatten().filter_map(|e| Some(e.ok()?.path()));
        let mut projects: Vec<PathBuf> = inside.filter(|p| p.join("pipeline.toml").is_file()).collect();
        projects.sort();
        all.extend(projects.into_iter().map(|p| Case {
            name: p.file_name().map_or_else(String::new, |n| n.to_string_lossy().into_owned()),
            kind: Kind::Pipeline(p.join("pipeline.toml")),
        }));
    }
    if options.harnesses {
        all.extend(["validation", "stability"].map(|name| Case { name: name.into(), kind: Kind::Harness(name) }));
    }
    all.retain(|c| c.name.contains(&options.cases));
    all
}

/// Runs all cases with the text of an experiment file, as many side by side as the options say.
pub fn run(cases: &[Case], experiment: &str, options: &Options) -> Vec<Figures> {
    let next = AtomicUsize::new(0);
    let results = Mutex::new(vec![Figures::default(); cases.len()]);
    let work = || {
        while let Some((i, case)) = Some(next.fetch_add(1, Ordering::Relaxed)).and_then(|i| Some((i, cases.get(i)?))) {
            let figures = case.run(experiment, options);
            if let Ok(mut results) = results.lock() {
                results[i] = figures;
            }
        }
    };
    std::thread::scope(|scope| (0..options.jobs.max(1)).for_each(|_| drop(scope.spawn(work))));
    results.into_inner().unwrap_or_default()
}

impl Case {
    /// Runs the case with the text of an experiment file.
    fn run(&self, experiment: &str, options: &Options) -> Figures {
        let Ok(folder) = tempfile::tempdir() else { return Figures::default() };
        let file = folder.path().join("experiment.toml");
        if std::fs::write(&file, experiment).is_err() {
            return Figures::default();
        }
        let mut command = match &self.kind {
            Kind::Pipeline(pipeline) => {
                let mut c = Command::new(env!("CARGO_BIN_EXE_toile"));
                c.arg("run").arg(pipeline).arg("--out").arg(folder.path().join("out")).args([
                    "--quiet",
                    "--threads",
                    "1",
                ]);
                if let Some(beside) = pipeline.parent().and_then(Path::parent) {
                    c.arg("--allow-read").arg(beside);
                }
                c
            }
            Kind::Harness(name) => {
                let mut c = Command::new(env!("CARGO"));
                c.args(["test", "--release", "--features", "experiments", "--test", name]);
                c
            }
        };
        command.env(toile_stages::experiment::VARIABLE, &file).stdout(Stdio::null()).stderr(Stdio::null());
        let passed = ends_well(&mut command, options.limit);
        let record = std::fs::read(folder.path().join("out/run.json")).ok();
        let record: Value = record.and_then(|r| serde_json::from_slice(&r).ok()).unwrap_or_default();
        let seconds = |stage: &str| {
            let all = record["stages"].as_array().into_iter().flatten().filter(|s| s["use"] == stage);
            let times: Vec<f64> = all.filter_map(|s| s["cpu_seconds"].as_f64()).collect();
            (!times.is_empty()).then(|| times.iter().sum())
        };
        Figures {
            passed,
            sewing: seconds("stitch"),
            draping: seconds("drape"),
            energy: record["certificate"]["energy_J"].as_f64(),
        }
    }
}

/// Does a command end with exit code 0 within the time?
fn ends_well(command: &mut Command, limit: f64) -> bool {
    let Ok(mut child) = command.spawn() else { return false };
    let end = Instant::now() + Duration::from_secs_f64(limit);
    loop {
        match child.try_wait() {
            Ok(Some(status)) => return status.success(),
            Ok(None) if Instant::now() < end => std::thread::sleep(Duration::from_millis(50)),
            _ => {
                let _ = child.kill();
                let _ = child.wait();
                return false;
            }
        }
    }
}
