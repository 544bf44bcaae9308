//! The outputs of an earlier run in the same folder: they are gone before the work of a new one begins.
//!
//! A run that fails must not lie beside the results of last week. While outputs go or take their names, their record
//! stands under a name of its own. So the next run finds all of them, also when this one is killed.

use super::gate::output_below;
use super::outputs::{RECORD_NAME, write_error};
use super::same::is_same;
use super::whole::temp_path;
use serde_json::Value;
use std::path::{Path, PathBuf};
use toile_stage_api::FileError;

/// Largest record that is read, bytes.
const MAX_RECORD: u64 = 256 << 20;

/// Name of a record whose outputs are about to go, or to take their names. No sweep removes it.
pub(super) fn pending_record(root: &Path) -> PathBuf {
    temp_path(root, "outputs")
}

/// The record of an earlier run.
pub(super) struct Earlier {
    outputs: Vec<(String, String)>,
}

impl Earlier {
    /// Reads a record; `None` where there is none, or the file of this name is none of ours.
    pub(super) fn read(path: &Path) -> Option<Self> {
        let bytes = super::files::read_limited(path, path, MAX_RECORD).ok()?;
        let record: Value = serde_json::from_slice(&bytes).ok()?;
        record.get("toile")?;
        let text = |entry: &Value, key| entry.get(key).and_then(Value::as_str).map(str::to_owned);
        let outputs = record.get("outputs")?.as_array()?.iter();
        Some(Self { outputs: outputs.filter_map(|o| Some((text(o, "path")?, text(o, "blake3")?))).collect() })
    }

    /// Did that run write anything?
    pub(super) fn is_empty(&self) -> bool {
        self.outputs.is_empty()
    }

    /// Outputs below the folder that are still there.
    pub(super) fn still_there(&self, root: &Path) -> Vec<String> {
        let is_there = |shown: &&String| output_below(Path::new(shown)).is_ok_and(|below| root.join(below).is_file());
        self.outputs.iter().map(|(shown, _)| shown).filter(is_there).cloned().collect()
    }

    /// Removes the outputs of a folder's earlier runs, those among `targets` too, and their records. The record of a
    /// run that was killed tells what that run had still to remove or to write. What was changed since, or is an input
    /// of the new run, stays. Gives the names of what was changed.
    ///
    /// # Errors
    /// When the disk refuses.
    pub(super) fn retire_all(root: &Path, targets: &[PathBuf], inputs: &[PathBuf]) -> Result<Vec<String>, FileError> {
        let record = root.join(RECORD_NAME);
        let mut changed = Self::retire_pending(root, targets, inputs)?;
        if Self::read(&record).is_some() {
            // The result is no longer whole from here on, so no record may say that it is.
            std::fs::rename(&record, pending_record(root)).map_err(|e| write_error(&record, &e))?;
            changed.extend(Self::retire_pending(root, targets, inputs)?);
        }
        Ok(changed)
    }

    /// Removes the outputs that the pending record names, and then that record.
    fn retire_pending(root: &Path, targets: &[PathBuf], inputs: &[PathBuf]) -> Result<Vec<String>, FileError> {
        let pending = pending_record(root);
        let Some(earlier) = Self::read(&pending) else { return Ok(Vec::new()) };
        let changed = earlier.remove_outputs(root, targets, inputs)?;
        remove(&pending)?;
        Ok(changed)
    }

    fn remove_outputs(&self, root: &Path, targets: &[PathBuf], inputs: &[PathBuf]) -> Result<Vec<String>, FileError> {
        let mut changed = Vec::new();
        for (shown, digest) in &self.outputs {
            let own = output_below(Path::new(shown)).ok().map(|below| root.join(below));
            let name = Path::new(shown).file_name();
            let elsewhere = targets.iter().filter(|t| t.file_name() == name).cloned();
            for path in own.into_iter().chain(elsewhere) {
                if !std::fs::symlink_metadata(&path).is_ok_and(|m| m.is_file()) || belongs_to(&path, inputs) {
                    continue;
                }
                if digest_of(&path).as_ref() == Some(digest) {
                    remove(&path)?;
                } else if !targets.contains(&path) {
                    changed.push(shown.clone());
                }
            }
        }
        Ok(changed)
    }
}

/// Returns `true` for one of these files, and for a file beside one of them that has the same stem and may be read
/// with it.
fn belongs_to(path: &Path, inputs: &[PathBuf]) -> bool {
    let beside = |input: &PathBuf| input.with_extension("") == path.with_extension("");
    inputs.iter().any(|input| is_same(path, input) || beside(input))
}

fn digest_of(path: &Path) -> Option<String> {
    let mut hasher = blake3::Hasher::new();
    hasher.update_reader(std::fs::File::open(path).ok()?).ok()?;
    Some(hasher.finalize().to_hex().to_string())
}

fn remove(path: &Path) -> Result<(), FileError> {
    match std::fs::remove_file(path) {
        Err(e) if e.kind() != std::io::ErrorKind::NotFound => Err(write_error(path, &e)),
        _ => Ok(()),
    }
}
