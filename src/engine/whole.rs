//! Files that are written whole: under a temporary name in the same folder, then renamed. No link is followed.

use super::gate::clean;
use crate::codes::WRITE_FAILED;
use std::collections::BTreeSet;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{ErrorKind, Result, Write as _};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;
use toile_garment::Diagnostic;

/// Ending of temporary files.
const TEMP_ENDING: &str = ".tmp-toile";
/// Temporary files that this process has named so far.
static NAMED: AtomicU64 = AtomicU64::new(0);
/// Folders that this process has swept.
static SWEPT: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());
/// Names that are tried for a temporary file.
const TRIES: usize = 64;

/// Name of the temporary file with this number or word in a folder.
pub(crate) fn temp_path(folder: &Path, word: impl std::fmt::Display) -> PathBuf {
    folder.join(format!(".{word}{TEMP_ENDING}"))
}

/// Why a file cannot be written, with what helps.
pub(crate) fn unwritten(path: &Path, error: &std::io::Error) -> Diagnostic {
    let folder = clean(folder_of(path));
    let hint = match error.kind() {
        ErrorKind::NotFound => format!("there is no folder `{folder}`: make it, or correct the name"),
        ErrorKind::NotADirectory => format!("`{folder}` is no folder: choose another name"),
        ErrorKind::IsADirectory => "a folder has this name: choose another name".to_owned(),
        ErrorKind::AlreadyExists => "choose another file, or pass --force to replace it".to_owned(),
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
            format!("nothing may be written into `{folder}`: choose another folder")
        }
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => "make room on this disk, or choose another".to_owned(),
        _ => "choose another file".to_owned(),
    };
    Diagnostic::error(WRITE_FAILED, format!("cannot write `{}`: {error}", clean(path))).hint(hint)
}

/// A file under a temporary name, which becomes the file at `target` or is removed. While its process lives, the file is
/// locked. So any command can tell what a dead process left.
pub(crate) struct Temp {
    path: PathBuf,
    target: PathBuf,
    held: File,
    is_named: bool,
}

impl Temp {
    /// Writes a file that must last into the folder of `target`, after what dead processes left there is gone.
    pub fn write(target: &Path, bytes: &[u8]) -> Result<Self> {
        let folder = folder_of(target);
        sweep_once(folder);
        for _ in 0..TRIES {
            let word = format!("{}-{}", std::process::id(), NAMED.fetch_add(1, Ordering::Relaxed));
            let path = temp_path(folder, word);
            // Another file or a link has the name: it is not ours.
            let Some(file) = create_held(&path)? else { continue };
            let mut temp = Self { path, target: target.to_path_buf(), held: file, is_named: false };
            temp.held.write_all(bytes)?;
            temp.held.sync_all()?;
            return Ok(temp);
        }
        Err(std::io::Error::new(ErrorKind::AlreadyExists, "no temporary name is free"))
    }

    /// The temporary name.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The file that it becomes.
    pub fn target(&self) -> &Path {
        &self.target
    }

    /// Gives the file its own name; one of that name is replaced. No link is followed.
    pub fn name(&mut self) -> Result<()> {
        std::fs::rename(&self.path, &self.target)?;
        self.is_named = true;
        Ok(())
    }
}

impl Drop for Temp {
    fn drop(&mut self) {
        if !self.is_named {
            drop(std::fs::remove_file(&self.path));
        }
    }
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// A new file of this name, locked by this process; `None` where the name is taken, or another process swept it.
fn create_held(path: &Path) -> Result<Option<File>> {
    let file = match File::options().write(true).create_new(true).open(path) {
        Err(error) if error.kind() == ErrorKind::AlreadyExists => return Ok(None),
        opened => opened?,
    };
    match file.try_lock() {
        Ok(()) if !is_same_file(&file, path) => Ok(None),
        Err(TryLockError::WouldBlock) => Ok(None),
        // A disk without locks: then no command sweeps it.
        Ok(()) | Err(TryLockError::Error(_)) => Ok(Some(file)),
    }
}

/// Returns `true` for the name of a temporary file or a lock.
fn is_temp_name(name: &str) -> bool {
    let word = name.strip_prefix('.').and_then(|n| n.strip_suffix(TEMP_ENDING));
    let is_number = |w: &str| !w.is_empty() && w.bytes().all(|b| b.is_ascii_digit() || b == b'-');
    word.is_some_and(|w| matches!(w, "record" | "lock") || is_number(w))
}

/// Sweeps a folder before this process writes its first file there. To sweep before every file would try the locks of
/// all files that the process itself holds.
fn sweep_once(folder: &Path) {
    let mut swept = SWEPT.lock().unwrap_or_else(PoisonError::into_inner);
    if swept.insert(folder.to_path_buf()) {
        sweep(folder);
    }
}

/// Removes the temporary files and locks that dead processes left in a folder. What a living process holds stays.
pub(super) fn sweep(folder: &Path) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for entry in entries.flatten().filter(|e| is_temp_name(&e.file_name().to_string_lossy())) {
        let path = entry.path();
        match entry.file_type() {
            // A link is no file of ours; one with the name of a lock is refused later.
            Ok(kind) if kind.is_symlink() && !path.ends_with(temp_path(Path::new(""), "lock")) => {
                drop(std::fs::remove_file(path));
            }
            Ok(kind) if kind.is_file() => sweep_file(&path),
            _ => {}
        }
    }
}

/// Removes a file that no process holds. It is removed while it is held, so that a new one of the name is safe.
fn sweep_file(path: &Path) {
    let Ok(file) = no_link(File::options().write(true)).open(path) else { return };
    if file.try_lock().is_ok() && is_same_file(&file, path) {
        drop(std::fs::remove_file(path));
    }
}

/// Files that get their names one after the other, once all of them are written.
#[derive(Default)]
pub(crate) struct Temps(Vec<Temp>);

impl Temps {
    /// Writes one more file under a temporary name.
    pub fn add(&mut self, target: &Path, bytes: &[u8]) -> std::result::Result<(), (PathBuf, std::io::Error)> {
        self.0.push(Temp::write(target, bytes).map_err(|e| (target.to_path_buf(), e))?);
        Ok(())
    }

    /// Removes the files that are to be replaced, so that new files never lie beside old ones.
    pub fn retire_old(&self) -> std::result::Result<(), (PathBuf, std::io::Error)> {
        for temp in &self.0 {
            match std::fs::remove_file(temp.target()) {
                Err(error) if error.kind() != ErrorKind::NotFound => return Err((temp.target().to_path_buf(), error)),
                _ => {}
            }
        }
        Ok(())
    }

    /// Gives the files their names, in the order in which they were added.
    pub fn name(mut self) -> std::result::Result<(), (PathBuf, std::io::Error)> {
        for temp in &mut self.0 {
            temp.name().map_err(|e| (temp.target().to_path_buf(), e))?;
        }
        let folders: BTreeSet<&Path> = self.0.iter().map(|t| folder_of(t.target())).collect();
        folders.into_iter().for_each(sync_folder);
        Ok(())
    }
}

/// Writes a file by way of a temporary one in the same folder.
pub(crate) fn write_whole(path: &Path, bytes: &[u8]) -> Result<()> {
    Temp::write(path, bytes)?.name()?;
    sync_folder(folder_of(path));
    Ok(())
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

/// Time for which a held lock is looked at again, and the number of looks: another process may only see if it is free.
const LOOK: Duration = Duration::from_millis(2);
const LOOKS: usize = 5;

/// Takes the lock file at a path. The system frees it when a process dies. A link in its place is no lock.
pub(crate) fn take_lock(path: &Path) -> Result<Lock> {
    let mut looks = 0;
    for _ in 0..16 {
        let file = no_link(File::options().create(true).truncate(false).write(true)).open(path)?;
        match file.try_lock() {
            Ok(()) if is_same_file(&file, path) => return Ok(Lock::Held(file)),
            // The run before removed the file between our open and our lock: take the new one.
            Ok(()) => {}
            Err(TryLockError::WouldBlock) if looks == LOOKS => return Ok(Lock::Taken),
            Err(TryLockError::WouldBlock) => {
                looks += 1;
                std::thread::sleep(LOOK);
            }
            // A disk without locks: better to work than to refuse.
            Err(TryLockError::Error(_)) => return Ok(Lock::Held(file)),
        }
    }
    Ok(Lock::Taken)
}

/// Options that refuse a link in the file's place.
#[cfg(unix)]
fn no_link(options: &mut OpenOptions) -> &mut OpenOptions {
    use std::os::unix::fs::OpenOptionsExt as _;
    options.custom_flags(i32::try_from(rustix::fs::OFlags::NOFOLLOW.bits()).unwrap_or_default())
}

/// Options that do not follow a link in the file's place: the file is then opened as the link itself.
#[cfg(windows)]
fn no_link(options: &mut OpenOptions) -> &mut OpenOptions {
    use std::os::windows::fs::OpenOptionsExt as _;
    const OPEN_REPARSE_POINT: u32 = 0x0020_0000;
    options.custom_flags(OPEN_REPARSE_POINT)
}

#[cfg(not(any(unix, windows)))]
fn no_link(options: &mut OpenOptions) -> &mut OpenOptions {
    options
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
        write_whole(&link, b"new").expect("written");
        assert_eq!(std::fs::read_to_string(&victim).expect("text"), "mine");
        assert!(std::fs::symlink_metadata(&link).expect("file").is_file());
        symlink(&victim, dir.path().join("lock")).expect("link");
        assert!(take_lock(&dir.path().join("lock")).is_err());
        symlink(dir.path().join("absent"), dir.path().join("dangling")).expect("link");
        assert!(take_lock(&dir.path().join("dangling")).is_err());
        assert!(!dir.path().join("absent").exists());
    }

    #[test]
    fn what_the_living_hold_stays_and_what_the_dead_left_goes() {
        let dir = tempfile::tempdir().expect("folder");
        let mut mine = Temp::write(&dir.path().join("a"), b"a").expect("written");
        let lock = take_lock(&temp_path(dir.path(), "lock")).expect("lock");
        std::fs::write(temp_path(dir.path(), "4711-0"), "left").expect("file");
        std::fs::write(temp_path(dir.path(), "0"), "left").expect("file");
        std::fs::write(dir.path().join(".notes.tmp-toile"), "mine").expect("file");
        symlink(dir.path().join("absent"), temp_path(dir.path(), "4711-1")).expect("link");
        write_whole(&dir.path().join("b"), b"b").expect("written");
        assert!(mine.path().exists() && temp_path(dir.path(), "lock").exists());
        mine.name().expect("named");
        drop((mine, lock));
        sweep(dir.path());
        let mut left: Vec<_> =
            std::fs::read_dir(dir.path()).expect("folder").flatten().map(|e| e.file_name()).collect();
        left.sort();
        assert_eq!(left, [".notes.tmp-toile", "a", "b"]);
    }

    #[test]
    fn a_temporary_file_without_a_name_goes() {
        let dir = tempfile::tempdir().expect("folder");
        let mut temps = Temps::default();
        temps.add(&dir.path().join("a"), b"a").expect("written");
        assert!(temps.add(&dir.path().join("absent/b"), b"b").is_err());
        drop(temps);
        assert_eq!(std::fs::read_dir(dir.path()).expect("folder").count(), 0);
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
