//! Outputs appear under their final names only when the run is through, each of them whole.

use super::gate::{clean, output_below, refused};
use super::stop::Stop;
use std::collections::BTreeSet;
use std::fs::{File, TryLockError};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toile_stage_api::FileError;

/// Ending of temporary files; a run sweeps those that an earlier one left.
const TEMP_ENDING: &str = ".tmp-toile";
/// Name of the lock in the output folder.
const LOCK_NAME: &str = ".lock.tmp-toile";
/// Name of the run's own record.
pub const RECORD_NAME: &str = "run.json";
/// Space that must be free before the work begins, bytes.
const LEAST_SPACE: u64 = 4 << 20;

struct Staged {
    shown: String,
    target: PathBuf,
    temp: PathBuf,
    digest: String,
}

/// The output folder of one run.
pub struct Outputs {
    root: PathBuf,
    extra: Vec<PathBuf>,
    force: bool,
    staged: Vec<Staged>,
    swept: BTreeSet<PathBuf>,
    stop: Arc<Stop>,
    lock: Option<File>,
}

impl Outputs {
    /// Makes and locks the folder, sweeps old temporaries, checks that there is space and that `planned` files are
    /// not there yet.
    ///
    /// # Errors
    /// [`FileError::Refused`] when files are there and `force` is not given, or another run uses the folder;
    /// [`FileError::Write`] when it cannot be written.
    pub fn open(
        folder: &Path,
        allow_write: &[PathBuf],
        planned: &[PathBuf],
        force: bool,
        stop: Arc<Stop>,
    ) -> Result<Self, FileError> {
        std::fs::create_dir_all(folder).map_err(|e| write_error(folder, &e))?;
        let root = folder.canonicalize().map_err(|e| write_error(folder, &e))?;
        let mut extra = Vec::new();
        for dir in allow_write {
            extra.push(dir.canonicalize().map_err(|e| write_error(dir, &e))?);
        }
        let lock = take_lock(&root)?;
        let mut outputs =
            Self { root, extra, force, staged: Vec::new(), swept: BTreeSet::new(), stop, lock: Some(lock) };
        outputs.stop.add_litter(&outputs.root.join(LOCK_NAME));
        outputs.check_free(folder)?;
        outputs.sweep(&outputs.root.clone());
        outputs.check_planned(folder, planned)?;
        Ok(outputs)
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

    fn check_planned(&self, folder: &Path, planned: &[PathBuf]) -> Result<(), FileError> {
        if self.force {
            return Ok(());
        }
        let mut there: Vec<String> = Vec::new();
        for path in planned {
            let target = self.target(path)?;
            if target.is_file() {
                there.push(self.shown(&target));
            }
        }
        if self.record_has_outputs() {
            there.push(RECORD_NAME.to_owned());
        }
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

    /// The record of a run that wrote nothing may be replaced; any other file of that name is somebody's.
    fn record_has_outputs(&self) -> bool {
        let path = self.root.join(RECORD_NAME);
        if !path.exists() {
            return false;
        }
        let record = std::fs::read(&path).ok().and_then(|b| serde_json::from_slice::<serde_json::Value>(&b).ok());
        let empty = record.and_then(|r| Some(r.get("toile").is_some() && r.get("outputs")?.as_array()?.is_empty()));
        empty != Some(true)
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
        if self.staged.iter().any(|s| s.target.to_string_lossy().to_lowercase() == folded) {
            return Err(refused(path, "two outputs of this run have this name; give each its own"));
        }
        if target.is_dir() || (target.exists() && !self.force) {
            return Err(refused(path, "it is there already; replace it with --force"));
        }
        let folder = target.parent().unwrap_or(&self.root).to_path_buf();
        std::fs::create_dir_all(&folder).map_err(|e| write_error(path, &e))?;
        self.check_folder(path, &folder)?;
        self.sweep(&folder);
        let temp = folder.join(format!(".{}{TEMP_ENDING}", self.staged.len()));
        self.stop.add_litter(&temp);
        if let Err(error) = write_synced(&temp, bytes) {
            drop(std::fs::remove_file(&temp));
            return Err(write_error(path, &error));
        }
        let digest = blake3::hash(bytes).to_hex().to_string();
        self.staged.push(Staged { shown, target, temp, digest });
        Ok(())
    }

    /// A link inside the output folder must not lead out of it.
    fn check_folder(&self, path: &Path, folder: &Path) -> Result<(), FileError> {
        let real = folder.canonicalize().map_err(|e| write_error(path, &e))?;
        let inside = std::iter::once(&self.root).chain(&self.extra).any(|root| real.starts_with(root));
        if inside { Ok(()) } else { Err(refused(path, "a link on the way leads out of the output folder")) }
    }

    /// Removes what a killed run left in a folder. The lock makes sure that no living run owns it.
    fn sweep(&mut self, folder: &Path) {
        if !self.swept.insert(folder.to_path_buf()) {
            return;
        }
        let Ok(entries) = std::fs::read_dir(folder) else { return };
        for entry in entries.flatten() {
            let name = entry.file_name().to_string_lossy().into_owned();
            let number = name.strip_prefix('.').and_then(|n| n.strip_suffix(TEMP_ENDING));
            if number.is_some_and(|n| !n.is_empty() && (n == "record" || n.bytes().all(|b| b.is_ascii_digit()))) {
                drop(std::fs::remove_file(entry.path()));
            }
        }
    }

    /// Gives all staged files their final names, and the record last: who finds the record finds the rest.
    ///
    /// # Errors
    /// When the disk refuses.
    pub fn commit(&mut self, record: &[u8]) -> Result<(), FileError> {
        let stop = Arc::clone(&self.stop);
        let _whole = stop.commit_guard();
        let mut folders = BTreeSet::new();
        for staged in &self.staged {
            std::fs::rename(&staged.temp, &staged.target).map_err(|e| write_error(Path::new(&staged.shown), &e))?;
            self.stop.forget_litter(&staged.temp);
            folders.extend(staged.target.parent().map(Path::to_path_buf));
        }
        self.write_record(record)?;
        self.stop.set_last_words(None);
        folders.iter().for_each(|folder| sync_folder(folder));
        self.staged.clear();
        Ok(())
    }

    /// Writes the record alone, after a failure. The record of a run with outputs stays.
    ///
    /// # Errors
    /// When the disk refuses.
    pub fn write_record(&self, record: &[u8]) -> Result<(), FileError> {
        let path = self.root.join(RECORD_NAME);
        write_whole(&path, record).map_err(|e| write_error(Path::new(RECORD_NAME), &e))
    }

    /// Path and blake3 of what is staged.
    #[must_use]
    pub fn list(&self) -> Vec<(String, String)> {
        self.staged.iter().map(|s| (s.shown.clone(), s.digest.clone())).collect()
    }
}

impl Drop for Outputs {
    fn drop(&mut self) {
        for staged in &self.staged {
            drop(std::fs::remove_file(&staged.temp));
            self.stop.forget_litter(&staged.temp);
        }
        let lock = self.root.join(LOCK_NAME);
        // Removed while held, so that nobody removes the lock of a run that came after.
        drop(std::fs::remove_file(&lock));
        self.stop.forget_litter(&lock);
        drop(self.lock.take());
    }
}

/// Takes the folder's lock, or says that another run has it. The system frees it when a process dies.
fn take_lock(root: &Path) -> Result<File, FileError> {
    let path = root.join(LOCK_NAME);
    for _ in 0..16 {
        let file =
            File::options().create(true).truncate(false).write(true).open(&path).map_err(|e| write_error(root, &e))?;
        match file.try_lock() {
            Ok(()) if is_same_file(&file, &path) => return Ok(file),
            // The run before removed the file between our open and our lock: take the new one.
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                return Err(refused(root, "another run of toile uses this folder; wait, or choose another with --out"));
            }
            // A disk without locks: better to work than to refuse.
            Err(TryLockError::Error(_)) => return Ok(file),
        }
    }
    Err(refused(root, "another run of toile uses this folder; wait, or choose another with --out"))
}

#[cfg(unix)]
fn is_same_file(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    let (Ok(held), Ok(named)) = (file.metadata(), std::fs::metadata(path)) else { return false };
    held.ino() == named.ino() && held.dev() == named.dev()
}

#[cfg(not(unix))]
fn is_same_file(_: &File, _: &Path) -> bool {
    true
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

fn write_synced(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let mut file = File::create(path)?;
    file.write_all(bytes)?;
    file.sync_all()
}

/// Writes a file by way of a temporary one in the same folder.
pub(crate) fn write_whole(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let temp = path.with_file_name(format!(".record{TEMP_ENDING}"));
    let written = write_synced(&temp, bytes).and_then(|()| std::fs::rename(&temp, path));
    if written.is_err() {
        drop(std::fs::remove_file(&temp));
    }
    if let Some(folder) = path.parent() {
        sync_folder(folder);
    }
    written
}

/// Makes renames last through a power cut, where the system can.
fn sync_folder(folder: &Path) {
    if let Ok(dir) = File::open(folder) {
        drop(dir.sync_all());
    }
}

fn write_error(path: &Path, error: &std::io::Error) -> FileError {
    FileError::Write { path: clean(path), reason: error.to_string() }
}
