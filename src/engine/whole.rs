//! Files that are written whole: under a temporary name in the same folder, then renamed. No link is followed.

use std::fs::{File, TryLockError};
use std::io::{ErrorKind, Result, Write as _};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// Ending of temporary files; a run sweeps those that an earlier one left.
const TEMP_ENDING: &str = ".tmp-toile";
/// Temporary files that this process has named so far.
static NAMED: AtomicU64 = AtomicU64::new(0);

/// Name of the temporary file with this number or word in a folder.
pub(crate) fn temp_path(folder: &Path, word: impl std::fmt::Display) -> PathBuf {
    folder.join(format!(".{word}{TEMP_ENDING}"))
}

/// Is this the name of a temporary file of a run that is over? A lock is none.
pub(super) fn is_temp_name(name: &str) -> bool {
    let word = name.strip_prefix('.').and_then(|n| n.strip_suffix(TEMP_ENDING));
    word.is_some_and(|w| w == "record" || (!w.is_empty() && w.bytes().all(|b| b.is_ascii_digit() || b == b'-')))
}

/// Writes a file that must last. A file or link that has the name goes first; the target of a link stays as it is.
pub(super) fn write_new(path: &Path, bytes: &[u8]) -> Result<()> {
    match std::fs::remove_file(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => return Err(error),
        _ => {}
    }
    let mut file = File::options().write(true).create_new(true).open(path)?;
    file.write_all(bytes)?;
    file.sync_all()
}

/// Writes a file by way of a temporary one in the same folder. Its name is of this process alone, so that two programs
/// in one folder do not mix their files.
pub(crate) fn write_whole(path: &Path, bytes: &[u8]) -> Result<()> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let temp = temp_path(folder, format!("{}-{}", std::process::id(), NAMED.fetch_add(1, Ordering::Relaxed)));
    let written = write_new(&temp, bytes).and_then(|()| std::fs::rename(&temp, path));
    if written.is_err() {
        drop(std::fs::remove_file(&temp));
    }
    sync_folder(folder);
    written
}

/// Makes renames last through a power cut, where the system can.
pub(super) fn sync_folder(folder: &Path) {
    if let Ok(dir) = File::open(folder) {
        drop(dir.sync_all());
    }
}

/// The lock of a folder, while it is held.
pub(crate) enum Lock {
    /// It is ours.
    Held(File),
    /// Another run has it.
    Taken,
}

/// Takes the lock file at a path. The system frees it when a process dies. A link in its place is no lock.
pub(crate) fn take_lock(path: &Path) -> Result<Lock> {
    for _ in 0..16 {
        let file = open_lock(path)?;
        match file.try_lock() {
            Ok(()) if is_same_file(&file, path) => return Ok(Lock::Held(file)),
            // The run before removed the file between our open and our lock: take the new one.
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Ok(Lock::Taken),
            // A disk without locks: better to work than to refuse.
            Err(TryLockError::Error(_)) => return Ok(Lock::Held(file)),
        }
    }
    Ok(Lock::Taken)
}

#[cfg(unix)]
fn open_lock(path: &Path) -> Result<File> {
    use std::os::unix::fs::OpenOptionsExt as _;
    let flags = i32::try_from(rustix::fs::OFlags::NOFOLLOW.bits()).unwrap_or_default();
    File::options().create(true).truncate(false).write(true).custom_flags(flags).open(path)
}

#[cfg(not(unix))]
fn open_lock(path: &Path) -> Result<File> {
    if std::fs::symlink_metadata(path).is_ok_and(|m| !m.is_file()) {
        return Err(std::io::Error::new(ErrorKind::AlreadyExists, "a link has the name of the lock"));
    }
    File::options().create(true).truncate(false).write(true).open(path)
}

#[cfg(unix)]
fn is_same_file(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    let (Ok(held), Ok(named)) = (file.metadata(), std::fs::symlink_metadata(path)) else { return false };
    held.ino() == named.ino() && held.dev() == named.dev()
}

#[cfg(not(unix))]
fn is_same_file(_: &File, _: &Path) -> bool {
    true
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::os::unix::fs::symlink;

    #[test]
    fn a_link_is_replaced_and_its_target_stays() {
        let dir = tempfile::tempdir().expect("folder");
        let (victim, link) = (dir.path().join("victim"), dir.path().join("link"));
        std::fs::write(&victim, "mine").expect("file");
        symlink(&victim, &link).expect("link");
        write_new(&link, b"new").expect("written");
        assert_eq!(std::fs::read_to_string(&victim).expect("text"), "mine");
        assert!(std::fs::symlink_metadata(&link).expect("file").is_file());
        symlink(&victim, dir.path().join("lock")).expect("link");
        assert!(take_lock(&dir.path().join("lock")).is_err());
        symlink(dir.path().join("absent"), dir.path().join("dangling")).expect("link");
        assert!(take_lock(&dir.path().join("dangling")).is_err());
        assert!(!dir.path().join("absent").exists());
    }

    #[test]
    fn a_lock_is_held_by_one() {
        let dir = tempfile::tempdir().expect("folder");
        let path = dir.path().join("lock");
        let first = take_lock(&path).expect("lock");
        assert!(matches!(first, Lock::Held(_)));
        assert!(matches!(take_lock(&path).expect("lock"), Lock::Taken));
    }
}
