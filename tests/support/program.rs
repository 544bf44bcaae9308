//! The program run in this process on a folder, within a limit of CPU time.

use serde_json::Value;
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use toile::engine::Stop;

/// The end of a run.
pub struct Ended {
    pub code: u8,
    /// The messages for people.
    pub said: String,
    /// CPU time, s.
    pub cpu: f64,
    /// `run.json`; null where there is none.
    pub record: Value,
    /// Files of the output folder.
    outputs: BTreeMap<String, Vec<u8>>,
}

impl Ended {
    /// Findings of `run.json`, errors and warnings.
    pub fn findings(&self) -> impl Iterator<Item = &Value> {
        self.record["findings"].as_array().into_iter().flatten()
    }

    pub fn output(&self, name: &str) -> Option<&[u8]> {
        self.outputs.get(name).map(Vec::as_slice)
    }

    /// Outputs by name, `run.json` apart: times stand in it.
    pub fn outputs(&self) -> impl Iterator<Item = (&String, &Vec<u8>)> {
        self.outputs.iter().filter(|(name, _)| *name != "run.json")
    }
}

/// Runs `pipeline.toml` of the folder; asks it to stop when the CPU time is used up.
pub fn run(folder: &Path, cap: f64, more: &[&str]) -> Ended {
    let mut arguments: Vec<OsString> = vec!["toile".into(), "run".into(), folder.join("pipeline.toml").into()];
    arguments.extend(["--out".into(), folder.join("out").into(), "--quiet".into(), "--force".into()]);
    arguments.extend(more.iter().map(OsString::from));
    let (stop, done) = (Stop::new(), AtomicBool::new(false));
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let start = cpu_seconds();
    let code = std::thread::scope(|scope| {
        scope.spawn(|| {
            while !done.load(Ordering::Relaxed) {
                if cpu_seconds() - start > cap {
                    stop.ask();
                }
                std::thread::park_timeout(Duration::from_millis(100));
            }
        });
        let code = toile::cli::run_from(arguments, toile_stages::builtin(), &stop, &mut out, &mut err);
        done.store(true, Ordering::Relaxed);
        code
    });
    let outputs = files(&folder.join("out"));
    let record = outputs.get("run.json").and_then(|b| serde_json::from_slice(b).ok());
    Ended {
        code,
        said: String::from_utf8_lossy(&err).trim().replace('\n', " "),
        cpu: cpu_seconds() - start,
        record: record.unwrap_or(Value::Null),
        outputs,
    }
}

fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    entries.filter_map(|e| Some((e.file_name().into_string().ok()?, std::fs::read(e.path()).ok()?))).collect()
}

/// CPU time of this process, s; wall time where the system does not tell.
pub fn cpu_seconds() -> f64 {
    let read = || {
        let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
        let fields: Vec<&str> = stat.rsplit(')').next()?.split_whitespace().collect();
        let ticks = |i: usize| fields.get(i)?.parse::<f64>().ok();
        Some((ticks(11)? + ticks(12)?) / 100.0)
    };
    static START: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
    read().unwrap_or_else(|| START.get_or_init(std::time::Instant::now).elapsed().as_secs_f64())
}
