//! Outputs appear under their final names only when the run is through, each of them whole.

use super::earlier::{Earlier, pending_record};
use super::gate::{clean, output_below, refused};
use super::same::{is_same, refuse_input};
use super::stop::Stop;
use super::whole::{self, Lock, Temp, sweep, sync_folder, temp_path};
use std::collections::BTreeSet;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toile_stage_api::FileError;

/// Name of the run's own record.
pub const RECORD_NAME: &str = "run.json";
/// Space that must be free before the work begins, bytes.
const LEAST_SPACE: u64 = 4 << 20;

struct Staged {
    shown: String,
    temp: Temp,
    digest: String,
}

impl Staged {
    fn target(&self) -> &Path {
        self.temp.target()
    }
}

/// The outputs and inputs of a run, and its rights.
#[derive(Clone, Debug, Default)]
pub struct Plan {
    /// Further folders for outputs.
    pub allow_write: Vec<PathBuf>,
    /// Outputs, as the pipeline names them.
    pub outputs: Vec<PathBuf>,
    /// Real paths of inputs; none of them is ever replaced.
    pub inputs: Vec<PathBuf>,
    /// Replace files that are there?
    pub force: bool,
}

/// The output folder of one run.
pub struct Outputs {
    root: PathBuf,
    extra: Vec<PathBuf>,
    force: bool,
    /// Real paths of what is read.
    inputs: Vec<PathBuf>,
    /// Final places of outputs that are known before the work.
    planned: Vec<PathBuf>,
    /// Outputs of an earlier run that somebody changed since; they stay.
    changed: Vec<String>,
    staged: Vec<Staged>,
    stop: Arc<Stop>,
    lock: Option<File>,
}

impl Outputs {
    /// Makes and locks the folder and sweeps old temporaries. Checks that there is space, that no output is an input,
    /// and that no output is there yet. With `force` the outputs of an earlier run go instead.
    ///
    /// # Errors
    /// [`FileError::Refused`] when files are there and `force` is not given, an output is an input, or another run uses
    /// the folder; [`FileError::Write`] when it cannot be written.
    pub fn open(folder: &Path, plan: &Plan, stop: Arc<Stop>) -> Result<Self, FileError> {
        std::fs::create_dir_all(folder).map_err(|e| write_error(folder, &e))?;
        let root = folder.canonicalize().map_err(|e| write_error(folder, &e))?;
        let mut extra = Vec::new();
        for dir in &plan.allow_write {
            extra.push(dir.canonicalize().map_err(|e| write_error(dir, &e))?);
        }
        let lock = take_lock(&root)?;
        let mut outputs = Self {
            root,
            extra,
            force: plan.force,
            inputs: plan.inputs.clone(),
            planned: Vec::new(),
            changed: Vec::new(),
            staged: Vec::new(),
            stop,
            lock: Some(lock),
        };
        outputs.stop.add_litter(&lock_path(&outputs.root));
        outputs.check_free(folder)?;
        sweep(&outputs.root);
        outputs.planned = plan.outputs.iter().map(|path| outputs.target(path)).collect::<Result<_, _>>()?;
        outputs.planned.push(outputs.root.join(RECORD_NAME));
        for target in &outputs.planned {
            refuse_input(target, &outputs.inputs)?;
        }
        outputs.make_room(folder)?;
        Ok(outputs)
    }

    /// Nothing of an earlier run stays, or the run is refused.
    fn make_room(&mut self, folder: &Path) -> Result<(), FileError> {
        if !self.force {
            return self.check_planned(folder);
        }
        self.changed = Earlier::retire_all(&self.root, &self.planned, &self.inputs)?;
        Ok(())
    }

    /// Outputs of an earlier run that were changed since, and therefore stay.
    #[must_use]
    pub fn changed(&self) -> &[String] {
        &self.changed
    }

    /// Notes that a file is read.
    ///
    /// # Errors
    /// [`FileError::Refused`] when an output of this run is to take its place.
    pub fn note_input(&mut self, given: &Path, real: &Path) -> Result<(), FileError> {
        let mut targets = self.planned.iter().map(PathBuf::as_path).chain(self.staged.iter().map(Staged::target));
        if targets.any(|target| is_same(target, real)) {
            let reason = "an output of this run has its name, and an output never replaces an input";
            return Err(refused(given, reason));
        }
        if !self.inputs.iter().any(|known| known == real) {
            self.inputs.push(real.to_path_buf());
        }
        Ok(())
    }

    /// The folder, real path.
    #[must_use]
    pub fn root(&self) -> &Path {
        &self.root
    }

    fn check_free(&self, folder: &Path) -> Result<(), FileError> {
        let full = free_bytes(&self.root).is_some_and(|free| free < LEAST_SPACE);
        if full {
            let reason = format!("less than {} MiB of space are left on the disk", LEAST_SPACE >> 20);
            return Err(FileError::Write { path: clean(folder), reason });
        }
        Ok(())
    }

    fn check_planned(&self, folder: &Path) -> Result<(), FileError> {
        let record = self.root.join(RECORD_NAME);
        let outputs = self.planned.iter().filter(|target| **target != record && target.is_file());
        let mut there: Vec<String> = outputs.map(|target| self.shown(target)).collect();
        // The record of a run that wrote nothing may be replaced; any other file of that name is somebody's.
        if record.exists() && Earlier::read(&record).is_none_or(|earlier| !earlier.is_empty()) {
            there.push(RECORD_NAME.to_owned());
        }
        let killed = Earlier::read(&pending_record(&self.root));
        there.extend(killed.into_iter().flat_map(|run| run.still_there(&self.root)));
        if there.is_empty() {
            return Ok(());
        }
        there.sort();
        there.dedup();
        let reason = format!(
            "it already holds {}; replace them with --force, or choose another folder with --out",
            there.join(", ")
        );
        Err(refused(folder, &reason))
    }

    /// Final place of an output.
    fn target(&self, path: &Path) -> Result<PathBuf, FileError> {
        if path.is_absolute() {
            let folder = path.parent().and_then(|p| p.canonicalize().ok());
            let allowed = folder.filter(|f| self.extra.iter().any(|dir| f.starts_with(dir)));
            return match (allowed, path.file_name()) {
                (Some(folder), Some(name)) => Ok(folder.join(name)),
                _ => Err(refused(path, "outputs stay in the output folder; allow another with --allow-write DIR")),
            };
        }
        Ok(self.root.join(output_below(path)?))
    }

    /// Name of an output in `run.json`: below the output folder, with forward slashes.
    fn shown(&self, target: &Path) -> String {
        let below = target
            .strip_prefix(&self.root)
            .map_or_else(|_| target.file_name().map(PathBuf::from).unwrap_or_default(), Path::to_path_buf);
        below.to_string_lossy().replace('\\', "/")
    }

    /// Writes an output under a temporary name.
    ///
    /// # Errors
    /// When the path is refused, is written twice, is there already, or the disk refuses.
    pub fn stage(&mut self, path: &Path, bytes: &[u8]) -> Result<(), FileError> {
        let target = self.target(path)?;
        let shown = self.shown(&target);
        if shown.eq_ignore_ascii_case(RECORD_NAME) {
            return Err(refused(path, "this name is kept for the run's own record"));
        }
        let folded = target.to_string_lossy().to_lowercase();
        if self.staged.iter().any(|s| s.target().to_string_lossy().to_lowercase() == folded) {
            return Err(refused(path, "two outputs of this run have this name; give each its own"));
        }
        refuse_input(&target, &self.inputs)?;
        if target.is_dir() || (target.exists() && !self.force) {
            return Err(refused(path, "it is there already; replace it with --force"));
        }
        let folder = target.parent().unwrap_or(&self.root).to_path_buf();
        std::fs::create_dir_all(&folder).map_err(|e| write_error(path, &e))?;
        self.check_folder(path, &folder)?;
        let temp = Temp::write(&target, bytes).map_err(|e| write_error(path, &e))?;
        self.stop.add_litter(temp.path());
        let digest = blake3::hash(bytes).to_hex().to_string();
        self.staged.push(Staged { shown, temp, digest });
        Ok(())
    }

    /// A link inside the output folder must not lead out of it.
    fn check_folder(&self, path: &Path, folder: &Path) -> Result<(), FileError> {
        let real = folder.canonicalize().map_err(|e| write_error(path, &e))?;
        let inside = std::iter::once(&self.root).chain(&self.extra).any(|root| real.starts_with(root));
        if inside { Ok(()) } else { Err(refused(path, "a link on the way leads out of the output folder")) }
    }

    /// Gives all staged files their final names, and the record last: who finds the record finds the rest. The record
    /// is safe on the disk before the first output takes its name, so that the next run finds the outputs of a killed
    /// one. Where one cannot take its name, none of them has.
    ///
    /// # Errors
    /// When the disk refuses.
    pub fn commit(&mut self, record: &[u8]) -> Result<(), FileError> {
        let stop = Arc::clone(&self.stop);
        let _whole = stop.commit_guard();
        let failed = |e| write_error(Path::new(RECORD_NAME), &e);
        let pending = pending_record(&self.root);
        Temp::write(&pending, record).and_then(|mut kept| kept.name()).map_err(failed)?;
        if let Err(error) = self.name_all() {
            drop(std::fs::remove_file(&pending));
            return Err(error);
        }
        std::fs::rename(&pending, self.root.join(RECORD_NAME)).map_err(failed)?;
        sync_folder(&self.root);
        self.stop.set_last_words(None);
        self.staged.clear();
        Ok(())
    }

    /// Renames all staged files, or none.
    fn name_all(&mut self) -> Result<(), FileError> {
        for k in 0..self.staged.len() {
            if let Err(error) = self.staged[k].temp.name() {
                // They are incomplete without this one.
                self.staged[..k].iter().for_each(|s| drop(std::fs::remove_file(s.target())));
                return Err(write_error(Path::new(&self.staged[k].shown), &error));
            }
            self.stop.forget_litter(self.staged[k].temp.path());
        }
        let folders: BTreeSet<&Path> = self.staged.iter().filter_map(|s| s.target().parent()).collect();
        folders.into_iter().for_each(sync_folder);
        Ok(())
    }

    /// Writes the record alone, after a failure. The record of a run with outputs stays.
    ///
    /// # Errors
    /// When the disk refuses.
    pub fn write_record(&self, record: &[u8]) -> Result<(), FileError> {
        let path = self.root.join(RECORD_NAME);
        whole::write_whole(&path, record).map_err(|e| write_error(Path::new(RECORD_NAME), &e))
    }

    /// Path and blake3 of what is staged.
    #[must_use]
    pub fn list(&self) -> Vec<(String, String)> {
        self.staged.iter().map(|s| (s.shown.clone(), s.digest.clone())).collect()
    }
}

impl Drop for Outputs {
    fn drop(&mut self) {
        for staged in self.staged.drain(..) {
            self.stop.forget_litter(staged.temp.path());
        }
        let lock = lock_path(&self.root);
        // Removed while held, so that nobody removes the lock of a run that came after.
        drop(std::fs::remove_file(&lock));
        self.stop.forget_litter(&lock);
        drop(self.lock.take());
    }
}

/// The lock in the output folder.
fn lock_path(root: &Path) -> PathBuf {
    temp_path(root, "lock")
}

/// Does a run use this folder now?
#[must_use]
pub fn is_locked(folder: &Path) -> bool {
    let path = lock_path(folder);
    path.exists() && matches!(whole::take_lock(&path), Ok(Lock::Taken))
}

/// Takes the folder's lock, or says that another run has it.
fn take_lock(root: &Path) -> Result<File, FileError> {
    match whole::take_lock(&lock_path(root)).map_err(|e| write_error(&lock_path(root), &e))? {
        Lock::Held(file) => Ok(file),
        Lock::Taken => Err(refused(root, "another run of toile uses this folder; wait, or choose another with --out")),
    }
}

/// Free bytes of the disk that holds a folder, where the system tells.
#[cfg(unix)]
fn free_bytes(folder: &Path) -> Option<u64> {
    let stat = rustix::fs::statvfs(folder).ok()?;
    stat.f_bavail.checked_mul(stat.f_frsize)
}

#[cfg(not(unix))]
fn free_bytes(_: &Path) -> Option<u64> {
    None
}

pub(super) fn write_error(path: &Path, error: &std::io::Error) -> FileError {
    FileError::Write { path: clean(path), reason: error.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn where_one_output_cannot_take_its_name_none_does() {
        let dir = tempfile::tempdir().expect("folder");
        let mut outputs = Outputs::open(dir.path(), &Plan::default(), Stop::new()).expect("folder");
        outputs.stage(Path::new("{out}/a.txt"), b"a").expect("staged");
        outputs.stage(Path::new("{out}/b.txt"), b"b").expect("staged");
        std::fs::create_dir(dir.path().join("b.txt")).expect("in the way");
        assert!(outputs.commit(b"{}").is_err());
        drop(outputs);
        let left: Vec<_> = std::fs::read_dir(dir.path()).expect("folder").flatten().map(|e| e.file_name()).collect();
        assert_eq!(left, ["b.txt"]);
    }
}
