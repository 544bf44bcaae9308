//! Results of the jobs of a line: verdict, figures and cost of each.

use super::document::GateRule;
use super::run::Ran;
use super::{Job, Line};
use crate::engine::{Exit, output_below, read_limited};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

/// Name of the results in the folder of a line.
pub const RESULTS_NAME: &str = "line.json";
/// Largest report that is read, bytes.
const MAX_REPORT: u64 = 64 << 20;

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

    /// How the line ends: the largest exit code of a job.
    #[must_use]
    pub fn exit(&self) -> Exit {
        let all = [Exit::Gate, Exit::Usage, Exit::Input, Exit::Unstable, Exit::System, Exit::Stopped];
        let worst = self.jobs.iter().map(|j| j.exit_code).max().unwrap_or(0);
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

fn fill(row: &mut Row, record: &Value, folder: &Path, gates: &[GateRule]) {
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
    let outputs = || record["outputs"].as_array().into_iter().flatten().filter_map(|o| o["path"].as_str());
    row.shown = outputs().filter(|p| p.ends_with(".png") || p.ends_with(".html")).map(str::to_owned).collect();
    row.figures = certificate(&record["certificate"]);
    row.figures.extend(outputs().filter(|p| p.ends_with(".json")).flat_map(|p| measures(folder, p)));
    if record["exit_code"] == 0 || record["exit_code"] == 1 {
        let over: Vec<String> = gates.iter().filter_map(|gate| over(gate, &row.figures)).collect();
        if !over.is_empty() && row.exit_code == 0 {
            row.exit_code = Exit::Gate.code();
            row.status = "gate-failed".to_owned();
        }
        row.why.extend(over);
    }
}

/// Numbers of the certificate; true is 1.
fn certificate(certificate: &Value) -> BTreeMap<String, f64> {
    let number = |value: &Value| value.as_f64().or_else(|| value.as_bool().map(|b| f64::from(u8::from(b))));
    let figures = certificate.as_object().into_iter().flatten();
    figures.filter_map(|(key, value)| Some((key.clone(), number(value)?))).collect()
}

/// Measures of a report, mm.
fn measures(folder: &Path, name: &str) -> Vec<(String, f64)> {
    let read = || {
        let path = folder.join(output_below(Path::new(name)).ok()?);
        let report: Value = serde_json::from_slice(&read_limited(&path, &path, MAX_REPORT).ok()?).ok()?;
        (report["kind"] == "toile-report").then_some(report)
    };
    let Some(report) = read() else { return Vec::new() };
    let measure = |m: &Value| {
        let name = [&m["name"], &m["on"], &m["method"]].map(|v| v.as_str().unwrap_or_default()).join(".");
        Some((name, m["mm"].as_f64()?))
    };
    report["measures"].as_array().into_iter().flatten().filter_map(measure).collect()
}

/// Why a gate does not hold.
fn over(gate: &GateRule, figures: &BTreeMap<String, f64>) -> Option<String> {
    let name = &gate.figure;
    let Some(value) = figures.get(name) else {
        return Some(format!("the gate `{name}` has nothing to look at: the job has no such figure"));
    };
    if let Some(min) = gate.min.filter(|min| value < min) {
        return Some(format!("`{name}` is {value}, at least {min} is asked"));
    }
    gate.max.filter(|max| value > max).map(|max| format!("`{name}` is {value}, at most {max} is allowed"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gate_looks_at_its_figure_and_misses_none() {
        let figures = BTreeMap::from([("hip_girth.drape.tape".to_owned(), 1030.0)]);
        let gate = |figure: &str, min, max| GateRule { figure: figure.to_owned(), min, max };
        assert_eq!(over(&gate("hip_girth.drape.tape", Some(1000.0), Some(1040.0)), &figures), None);
        let low = over(&gate("hip_girth.drape.tape", Some(1031.0), None), &figures).expect("too small");
        assert_eq!(low, "`hip_girth.drape.tape` is 1030, at least 1031 is asked");
        assert!(over(&gate("strain_max", None, Some(0.1)), &figures).expect("missing").contains("no such figure"));
    }
}
