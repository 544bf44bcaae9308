//! Jobs that are done: the record in the folder of a job says so, and nothing that it names has changed.

use super::run::Ran;
use super::survey::Planned;
use crate::engine::{RECORD_NAME, output_below, read_record};
use serde_json::Value;
use std::path::Path;

/// Ends that another try would not change. A full disk, a limit or a stop may go away.
const FINAL: [&str; 5] = ["good", "gate-failed", "usage", "input", "unstable"];

/// The record of a job, if it has one.
#[must_use]
pub fn record(folder: &Path) -> Option<Value> {
    read_record(&folder.join(RECORD_NAME)).ok()
}

/// How the last run in the folder of a job ended, if it left a record.
#[must_use]
pub fn was_run(folder: &Path) -> Option<Ran> {
    let record = record(folder)?;
    let code = u8::try_from(record["exit_code"].as_u64()?).ok()?;
    Some(Ran { code, record: Some(record), kept: true })
}

/// Returns `true` if the folder holds the result of this content, whole.
#[must_use]
pub fn is_done(folder: &Path, planned: &Planned) -> bool {
    let Some(record) = record(folder) else { return false };
    let is_final = FINAL.iter().any(|word| record["status"] == *word);
    is_final && record["key"] == planned.key && outputs_are_whole(folder, &record)
}

fn outputs_are_whole(folder: &Path, record: &Value) -> bool {
    let is_whole = |output: &Value| {
        let below = output["path"].as_str().and_then(|p| output_below(Path::new(p)).ok());
        let file = below.and_then(|below| std::fs::File::open(folder.join(below)).ok());
        let mut hasher = blake3::Hasher::new();
        file.is_some_and(|f| hasher.update_reader(f).is_ok()) && output["blake3"] == hasher.finalize().to_hex().as_str()
    };
    record["outputs"].as_array().is_some_and(|outputs| outputs.iter().all(is_whole))
}
