//! Stopping: a signal sets a flag that stages look at; whoever does not look in time is left behind.

use super::whole::write_whole;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// How long a stage has to see the flag before the program leaves without it.
const GRACE: Duration = Duration::from_millis(350);

/// The things to tidy when the program leaves in the middle of its work.
#[derive(Default)]
pub struct Stop {
    flag: AtomicBool,
    litter: Mutex<BTreeSet<PathBuf>>,
    groups: Mutex<BTreeSet<i32>>,
    reason: Mutex<Option<String>>,
    last_words: Mutex<Option<(PathBuf, String)>>,
    committing: Mutex<()>,
}

impl Stop {
    /// A stop that nobody has asked for yet.
    #[must_use]
    pub fn new() -> Arc<Self> {
        Arc::default()
    }

    /// Listens to SIGINT, SIGTERM and SIGHUP. The first sets the flag and leaves after a short grace, the second at
    /// once. Does nothing when the process listens already.
    pub fn listen(self: &Arc<Self>) {
        let stop = Arc::clone(self);
        let heard = ctrlc::set_handler(move || stop.heard());
        // A library user may have an own handler; then stopping is theirs.
        drop(heard);
    }

    fn heard(self: &Arc<Self>) {
        if self.flag.swap(true, Ordering::SeqCst) {
            self.leave();
        }
        let stop = Arc::clone(self);
        std::thread::spawn(move || {
            std::thread::sleep(GRACE);
            stop.leave();
        });
    }

    /// Asks for a stop.
    pub fn ask(&self) {
        self.flag.store(true, Ordering::SeqCst);
    }

    /// Leaves as soon as the standard input is closed: for a program whose work is of no use without the one that began
    /// it.
    pub(crate) fn leave_with_parent(self: &Arc<Self>) {
        let stop = Arc::clone(self);
        std::thread::spawn(move || {
            drop(std::io::copy(&mut std::io::stdin().lock(), &mut std::io::sink()));
            stop.leave();
        });
    }

    /// Asks for a stop that no person asked for.
    pub(super) fn ask_because(&self, reason: String) {
        *lock(&self.reason) = Some(reason);
        self.ask();
    }

    /// Why the program itself asked for a stop.
    pub(super) fn reason(&self) -> Option<String> {
        lock(&self.reason).clone()
    }

    /// The flag.
    #[must_use]
    pub fn flag(&self) -> &AtomicBool {
        &self.flag
    }

    /// Was a stop asked for?
    #[must_use]
    pub fn asked(&self) -> bool {
        self.flag.load(Ordering::Relaxed)
    }

    /// Held while outputs get their final names: nobody leaves in between.
    pub(super) fn commit_guard(&self) -> MutexGuard<'_, ()> {
        lock(&self.committing)
    }

    pub(crate) fn add_litter(&self, path: &Path) {
        lock(&self.litter).insert(path.to_path_buf());
    }

    pub(crate) fn forget_litter(&self, path: &Path) {
        lock(&self.litter).remove(path);
    }

    /// `run.json` for the case that nobody is left to write it.
    pub(super) fn set_last_words(&self, words: Option<(PathBuf, String)>) {
        *lock(&self.last_words) = words;
    }

    /// A process group that must not outlive the program.
    pub(crate) fn add_group(&self, id: i32) {
        lock(&self.groups).insert(id);
    }

    pub(crate) fn forget_group(&self, id: i32) {
        lock(&self.groups).remove(&id);
    }

    /// Tidies and ends the process.
    fn leave(&self) -> ! {
        let _whole = self.commit_guard();
        for group in lock(&self.groups).iter() {
            kill_group(*group);
        }
        for path in lock(&self.litter).iter() {
            // What cannot be removed is swept by the next run.
            drop(std::fs::remove_file(path).or_else(|_| std::fs::remove_dir_all(path)));
        }
        if let Some((path, text)) = lock(&self.last_words).take() {
            drop(write_whole(&path, text.as_bytes()));
        }
        std::process::exit(i32::from(super::Exit::Stopped.code()))
    }
}

/// A panic elsewhere must not keep the program from tidying.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Ends a process group.
#[cfg(unix)]
pub(crate) fn kill_group(id: i32) {
    if let Some(pid) = rustix::process::Pid::from_raw(id).filter(|_| id > 1) {
        // It may be gone already, which is as good.
        let _gone = rustix::process::kill_process_group(pid, rustix::process::Signal::KILL);
    }
}

/// Ends a process group: not on this system.
#[cfg(not(unix))]
pub(crate) fn kill_group(_: i32) {}
