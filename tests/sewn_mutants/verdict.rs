//! One run of the program on a project, and what must hold of it.

use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Longest run.
const SLOW: Duration = Duration::from_secs(60);
/// Time that the program is given: some copies ask for a mesh a thousand times as fine.
const MAX_SECONDS: &str = "5";
/// The record of a run.
const RECORD: &str = "run.json";
/// Exit codes of a run that ended by itself: good, gate, usage or bad input, unstable, system.
const CODES: std::ops::RangeInclusive<i32> = 0..=5;

/// How a run ended.
#[derive(Debug)]
pub struct Ended {
    pub exit: i32,
    pub reached_stitch: bool,
    /// The faults that should never be.
    pub fault: Option<String>,
    codes: BTreeSet<String>,
}

/// Runs the pipeline of a folder into its `out`, over what lies there of the run before.
pub fn run(program: &Path, folder: &Path) -> Ended {
    let (errors, out) = (folder.join("errors"), folder.join("out"));
    let before = std::fs::read(out.join(RECORD)).ok();
    let told = std::fs::File::create(&errors).expect("file");
    let words =
        ["run", "pipeline.toml", "--out", "out", "--force", "--quiet", "--threads", "1", "--max-seconds", MAX_SECONDS];
    let mut child = Command::new(program)
        .args(words)
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(told)
        .spawn()
        .expect("the program");
    let exit = wait(&mut child);
    let said = String::from_utf8_lossy(&std::fs::read(&errors).expect("errors")).into_owned();
    // Times stand in a record, so one of this run differs. A run that is refused before its chain writes none.
    let record = std::fs::read(out.join(RECORD)).ok().filter(|bytes| Some(bytes) != before.as_ref());
    let record = record.map(|bytes| serde_json::from_slice::<Value>(&bytes));
    let stages = record.as_ref().and_then(|r| r.as_ref().ok()?["stages"].as_array()).into_iter().flatten();
    let reached_stitch = stages.into_iter().any(|s| s["use"] == "stitch");
    let fault = fault(exit, &said, record.as_ref(), &out);
    let codes = said.lines().filter_map(|l| Some(l.strip_prefix("error[")?.split(']').next()?.to_owned())).collect();
    Ended { exit: exit.unwrap_or(-1), reached_stitch, fault, codes }
}

fn wait(child: &mut Child) -> Option<i32> {
    let began = Instant::now();
    while began.elapsed() < SLOW {
        if let Some(status) = child.try_wait().expect("the program") {
            return status.code().or(Some(-1));
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().expect("the program");
    child.wait().expect("the program");
    None
}

fn fault(exit: Option<i32>, said: &str, record: Option<&serde_json::Result<Value>>, out: &Path) -> Option<String> {
    let Some(exit) = exit else { return Some(format!("no end within {SLOW:?}")) };
    if said.contains("panicked at") || said.contains("internal-error") || said.contains("overflowed its stack") {
        return Some(format!("panic: {}", said.trim()));
    }
    if !CODES.contains(&exit) {
        return Some(format!("killed: {}", said.trim()));
    }
    if exit != 0 && !said.contains("error[") {
        return Some(format!("refused without a word: {}", said.trim()));
    }
    let record = match record {
        Some(Ok(record)) => record,
        Some(Err(error)) => return Some(format!("half a record: {error}")),
        None => return (exit == 0).then(|| "no record".to_owned()),
    };
    files_fault(exit, record, out)
}

/// The files of the folder against what the record says.
fn files_fault(exit: i32, record: &Value, out: &Path) -> Option<String> {
    let told: BTreeMap<String, String> = record["outputs"]
        .as_array()
        .into_iter()
        .flatten()
        .map(|o| [&o["path"], &o["blake3"]].map(|v| v.as_str().unwrap_or("").to_owned()))
        .map(|[path, digest]| (path, digest))
        .collect();
    let names = std::fs::read_dir(out).into_iter().flatten().flatten();
    let there: BTreeMap<String, String> = names
        .filter(|e| e.file_name() != RECORD)
        .map(|e| {
            let bytes = std::fs::read(e.path()).unwrap_or_default();
            (e.file_name().to_string_lossy().into_owned(), blake3::hash(&bytes).to_hex().to_string())
        })
        .collect();
    if told != there {
        return Some(format!("exit {exit}: the record tells {:?}, there are {:?}", told.keys(), there.keys()));
    }
    // A damaged pipeline may have lost its exports.
    let stages = record["stages"].as_array().into_iter().flatten();
    let exports = stages.filter(|s| s["use"].as_str().is_some_and(|u| u.starts_with("export-"))).count();
    if exit == 0 && there.len() < exports {
        return Some(format!("good without its outputs: {:?}", there.keys()));
    }
    let text = std::fs::read_to_string(out.join("sewn.obj")).unwrap_or_default();
    (text.contains("NaN") || text.contains("inf")).then(|| "a place that is no number".to_owned())
}

/// Counts of a campaign.
#[derive(Default)]
pub struct Tally {
    pub all: usize,
    pub reached_stitch: usize,
    pub faults: usize,
    exits: BTreeMap<i32, usize>,
    /// The count of those that reached `stitch`.
    sewn_exits: BTreeMap<i32, usize>,
    codes: BTreeMap<String, usize>,
}

impl Tally {
    pub fn add(&mut self, ended: &Ended) {
        self.all += 1;
        self.reached_stitch += usize::from(ended.reached_stitch);
        self.faults += usize::from(ended.fault.is_some());
        *self.exits.entry(ended.exit).or_default() += 1;
        if ended.reached_stitch {
            *self.sewn_exits.entry(ended.exit).or_default() += 1;
        }
        for code in &ended.codes {
            *self.codes.entry(code.clone()).or_default() += 1;
        }
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} mutants, {} reached `stitch`, {} faults; ", self.all, self.reached_stitch, self.faults)?;
        write!(f, "exits {:?}, of those in `stitch` {:?}; codes {:?}", self.exits, self.sewn_exits, self.codes)
    }
}
