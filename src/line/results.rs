//! Results of the jobs of a line: verdict, figures and cost of each.

use super::run::Ran;
use super::{Job, Line};
use crate::engine::Exit;
use crate::figures::{Bounds, of_record};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

/// Name of the results in the folder of a line.
pub const RESULTS_NAME: &str = "line.json";

/// The results of a line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Results {
    /// Program and version of this form.
    pub toile_line: u32,
    /// Name of the line.
    pub line: String,
    /// Jobs, in the order of the line.
    pub jobs: Vec<Row>,
}

/// One job.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Name, which is that of its folder below `jobs`.
    pub job: String,
    /// Style.
    pub style: String,
    /// Choice by axis.
    pub choices: BTreeMap<String, String>,
    /// How it ended, in a word; `missing` if it was never run.
    pub status: String,
    /// Exit code, gates of the line included.
    pub exit_code: u8,
    /// Why it did not pass; nothing for one that did.
    pub why: Vec<String>,
    /// Key of its content.
    pub key: Option<String>,
    /// Figures: those of the certificate, and measures in mm as NAME.on.method.
    pub figures: BTreeMap<String, f64>,
    /// Triangles of all pieces.
    pub triangles: u64,
    /// Wall time, s.
    pub seconds: f64,
    /// Time of all threads, s.
    pub cpu_seconds: f64,
    /// Largest resident memory, MB.
    pub peak_mb: f64,
    /// Stages that were taken from the cache.
    pub cached: usize,
    /// Pictures and pages, below the folder of the job.
    pub shown: Vec<String>,
    /// Is there a picture of it beside the page?
    pub pictured: bool,
}

impl Row {
    /// Did it pass?
    #[must_use]
    pub fn has_passed(&self) -> bool {
        self.exit_code == 0
    }
}

impl Results {
    /// Collects the results from the folders of the jobs.
    #[must_use]
    pub fn collect(line: &Line, ran: &[Option<Ran>], out: &Path) -> Self {
        let row = |(job, ran): (&Job, &Option<Ran>)| Row {
            pictured: out.join("pictures").join(format!("{}.png", job.name)).is_file(),
            ..row(line, job, ran.as_ref(), &out.join("jobs").join(&job.name))
        };
        Self { toile_line: 1, line: line.file.name.clone(), jobs: line.jobs.iter().zip(ran).map(row).collect() }
    }

    /// How the line ends: the largest exit code of the jobs that are judged.
    #[must_use]
    pub fn exit(&self, judged: &[usize]) -> Exit {
        let all = [Exit::Gate, Exit::Usage, Exit::Input, Exit::Unstable, Exit::System, Exit::Stopped];
        let worst = judged.iter().filter_map(|k| self.jobs.get(*k)).map(|j| j.exit_code).max().unwrap_or(0);
        all.into_iter().find(|e| e.code() == worst).unwrap_or(if worst == 0 { Exit::Good } else { Exit::System })
    }

    /// Number of jobs of each status.
    #[must_use]
    pub fn counts(&self) -> BTreeMap<&str, usize> {
        let mut counts = BTreeMap::new();
        for job in &self.jobs {
            *counts.entry(if job.has_passed() { "passed" } else { job.status.as_str() }).or_default() += 1;
        }
        counts
    }

    /// The results as JSON text.
    #[must_use]
    pub fn to_text(&self) -> String {
        toile_garment::text::json(&serde_json::to_string_pretty(self).unwrap_or_default()) + "\n"
    }
}

fn row(line: &Line, job: &Job, ran: Option<&Ran>, folder: &Path) -> Row {
    let mut row = Row {
        job: job.name.clone(),
        style: job.style.clone(),
        choices: job.choices.clone(),
        status: "missing".to_owned(),
        exit_code: ran.map_or(Exit::Stopped.code(), |r| r.code),
        ..Row::default()
    };
    match ran.and_then(|r| r.record.as_ref()) {
        Some(record) => fill(&mut row, record, folder, &line.file.gates),
        None if ran.is_some() => {
            row.status = "no-record".to_owned();
            row.why.push(format!("it left no record; see logs/{}.txt", job.name));
        }
        None => row.why.push("it was not run".to_owned()),
    }
    row
}

fn fill(row: &mut Row, record: &Value, folder: &Path, gates: &[Bounds]) {
    let number = |value: &Value| value.as_f64().unwrap_or(0.0);
    row.status = record["status"].as_str().unwrap_or("system").to_owned();
    row.key = record["key"].as_str().map(str::to_owned);
    row.triangles = record["garment"]["triangles"].as_u64().unwrap_or(0);
    row.seconds = number(&record["seconds"]);
    let stages = || record["stages"].as_array().into_iter().flatten();
    row.cpu_seconds = stages().map(|s| number(&s["cpu_seconds"])).sum();
    row.peak_mb = stages().map(|s| number(&s["peak_mb"])).fold(0.0, f64::max);
    row.cached = stages().filter(|s| s["cached"] == true).count();
    let errors = record["findings"].as_array().into_iter().flatten().filter(|f| f["severity"] == "error");
    row.why = errors.filter_map(|f| f["message"].as_str()).map(str::to_owned).collect();
    let outputs = record["outputs"].as_array().into_iter().flatten().filter_map(|o| o["path"].as_str());
    row.shown = outputs.filter(|p| p.ends_with(".png") || p.ends_with(".html")).map(str::to_owned).collect();
    row.figures = of_record(folder, record);
    if record["exit_code"] == 0 || record["exit_code"] == 1 {
        let over: Vec<String> = gates.iter().filter_map(|gate| gate.broken_by(&row.figures, "job")).collect();
        if !over.is_empty() && row.exit_code == 0 {
            row.exit_code = Exit::Gate.code();
            row.status = "gate-failed".to_owned();
        }
        row.why.extend(over);
    }
}
