//! Starts a program without a shell, in its own process group, with limits, and listens to it.

use crate::engine::{Stop, kill_group};
use crate::pipeline::Plugin;
use std::io::{Read, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::time::{Duration, Instant};

/// Longest line on stdout, bytes.
const MAX_LINE: usize = 1 << 20;
/// All of stdout, bytes.
const MAX_STDOUT: usize = 16 << 20;
/// Most of stderr that is kept, bytes.
const MAX_STDERR: usize = 4096;
/// Time for `describe`.
const DESCRIBE_TIME: Duration = Duration::from_secs(10);
/// How often the stop flag is looked at.
const TICK: Duration = Duration::from_millis(20);
/// How long pipes are listened to once the program itself has ended: a process it left behind may hold them open.
const LAST_WORDS: Duration = Duration::from_millis(300);
/// The path of programs; nothing of the caller's environment is handed on.
const PLAIN_PATH: &str = "/usr/local/bin:/usr/bin:/bin";

/// Why a program did not do its work.
#[derive(Debug, thiserror::Error)]
pub enum ProcessError {
    /// It could not be started.
    #[error("cannot start `{0}`: {1}")]
    Start(String, std::io::Error),
    /// It took too long.
    #[error("it took longer than {0} s and was ended")]
    Timeout(f64),
    /// It wrote too much.
    #[error("it wrote more than {0} bytes and was ended")]
    Flood(usize),
    /// It could not be talked to.
    #[error("cannot talk to it: {0}")]
    Talk(#[from] std::io::Error),
    /// It is another program than the one that was asked for its stages.
    #[error("its files were changed since it was asked for its stages")]
    Changed,
    /// The user stopped the run.
    #[error("stopped")]
    Stopped,
}

/// A declared program.
#[derive(Clone)]
pub struct Program {
    path: PathBuf,
    arguments: Vec<String>,
    folder: PathBuf,
    digest: String,
    timeout: Duration,
    stop: Arc<Stop>,
}

/// How a program ended.
pub struct Ended {
    /// Exit status.
    pub status: ExitStatus,
    /// The beginning of stderr.
    pub stderr: String,
}

impl Program {
    /// The program of a plugin; a path with a separator is relative to the pipeline's folder, a bare name is looked
    /// for on the caller's path.
    #[must_use]
    pub fn new(plugin: &Plugin, folder: &Path, stop: Arc<Stop>) -> Self {
        let (first, arguments) = plugin.command.split_first().map_or(("", &[][..]), |(f, a)| (f.as_str(), a));
        let timeout = Duration::from_secs_f64(plugin.timeout.clamp(0.001, 86_400.0));
        let (path, arguments, folder) = (find(first, folder), arguments.to_vec(), folder.to_path_buf());
        let mut program = Self { path, arguments, folder, digest: String::new(), timeout, stop };
        program.digest = program.content();
        program
    }

    /// Digest of the command and of all files that its words name. What these load besides is not in it.
    #[must_use]
    pub fn digest(&self) -> &str {
        &self.digest
    }

    /// The way to stop it.
    pub(super) fn stop(&self) -> &Arc<Stop> {
        &self.stop
    }

    /// The digest as the files are now.
    fn content(&self) -> String {
        let mut hasher = blake3::Hasher::new();
        let words = self.arguments.iter().map(|word| (word.as_str(), self.folder.join(word)));
        // The path of the program itself differs between machines; its bytes count.
        for (word, path) in std::iter::once(("", self.path.clone())).chain(words) {
            hasher.update(&(word.len() as u64).to_le_bytes()).update(word.as_bytes());
            let mut one = blake3::Hasher::new();
            let file = std::fs::File::open(&path).ok().filter(|_| path.is_file());
            if file.is_some_and(|f| one.update_reader(f).is_ok()) {
                hasher.update(one.finalize().as_bytes());
            }
        }
        hasher.finalize().to_hex().to_string()
    }

    /// Asks for the description.
    ///
    /// # Errors
    /// See [`ProcessError`].
    pub fn describe(&self) -> Result<(Ended, Vec<u8>), ProcessError> {
        let mut answer = Vec::new();
        let folder = self.path.parent().unwrap_or(Path::new("/")).to_path_buf();
        let ended = self.talk("describe", &[], &folder, DESCRIBE_TIME.min(self.timeout), &mut |line| {
            answer.extend_from_slice(line);
            answer.push(b'\n');
        })?;
        Ok((ended, answer))
    }

    /// Starts it with a verb, `run` or `forecast`, and a request on stdin.
    ///
    /// # Errors
    /// See [`ProcessError`].
    pub fn ask(
        &self,
        verb: &str,
        request: &[u8],
        folder: &Path,
        hear: &mut dyn FnMut(&[u8]),
    ) -> Result<Ended, ProcessError> {
        self.talk(verb, request, folder, self.timeout, hear)
    }

    fn talk(
        &self,
        verb: &str,
        request: &[u8],
        folder: &Path,
        limit: Duration,
        hear: &mut dyn FnMut(&[u8]),
    ) -> Result<Ended, ProcessError> {
        let mut child = Running { child: self.start(verb, folder)?, stop: Arc::clone(&self.stop) };
        self.stop.add_group(child.group());
        let stdin = child.child.stdin.take();
        let request = request.to_vec();
        std::thread::spawn(move || stdin.map(|mut s| s.write_all(&request)));
        let (send, lines) = sync_channel(64);
        if let Some(stdout) = child.child.stdout.take() {
            std::thread::spawn(move || read_lines(stdout, &send));
        }
        let (said, errors) = sync_channel(64);
        if let Some(stderr) = child.child.stderr.take() {
            std::thread::spawn(move || hand_on(stderr, &said));
        }
        let until = Instant::now() + limit;
        self.listen(&mut child, &lines, until, limit, hear)?;
        let status = child.wait(&self.stop, until, limit)?;
        // Grandchildren that hold the pipes open must not keep the run waiting, in whatever group they are.
        kill_group(child.group());
        Ok(Ended { status, stderr: keep_head(&errors) })
    }

    fn listen(
        &self,
        child: &mut Running,
        lines: &Receiver<Heard>,
        until: Instant,
        limit: Duration,
        hear: &mut dyn FnMut(&[u8]),
    ) -> Result<(), ProcessError> {
        let mut quiet = Instant::now();
        loop {
            match lines.recv_timeout(TICK) {
                Ok(Heard::Line(line)) => {
                    hear(&line);
                    quiet = Instant::now();
                }
                Ok(Heard::Flood(limit)) => return Err(ProcessError::Flood(limit)),
                Err(RecvTimeoutError::Disconnected) => return Ok(()),
                Err(RecvTimeoutError::Timeout) if child.child.try_wait()?.is_none() => quiet = Instant::now(),
                Err(RecvTimeoutError::Timeout) if quiet.elapsed() > LAST_WORDS => return Ok(()),
                Err(RecvTimeoutError::Timeout) => {}
            }
            check_time(&self.stop, until, limit)?;
        }
    }

    /// A word of the command. The program starts in another folder, so the name of a file beside the pipeline is given
    /// as its full path: what is run is what the digest was made of.
    fn argument(&self, word: &str) -> PathBuf {
        let path = self.folder.join(word);
        if path.is_file() { path } else { PathBuf::from(word) }
    }

    fn start(&self, verb: &str, folder: &Path) -> Result<Child, ProcessError> {
        if self.content() != self.digest {
            return Err(ProcessError::Changed);
        }
        let mut command = Command::new(&self.path);
        command.args(self.arguments.iter().map(|word| self.argument(word))).arg(verb);
        command.current_dir(folder).env_clear();
        command.env("PATH", PLAIN_PATH).env("LC_ALL", "C");
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        own_group(&mut command);
        command.spawn().map_err(|e| ProcessError::Start(self.path.display().to_string(), e))
    }
}

fn check_time(stop: &Stop, until: Instant, limit: Duration) -> Result<(), ProcessError> {
    if stop.asked() {
        return Err(ProcessError::Stopped);
    }
    if Instant::now() >= until { Err(ProcessError::Timeout(limit.as_secs_f64())) } else { Ok(()) }
}

/// A child that does not outlive its handle, nor do its own children.
struct Running {
    child: Child,
    stop: Arc<Stop>,
}

impl Running {
    fn group(&self) -> i32 {
        i32::try_from(self.child.id()).unwrap_or(0)
    }

    fn wait(&mut self, stop: &Stop, until: Instant, limit: Duration) -> Result<ExitStatus, ProcessError> {
        loop {
            if let Some(status) = self.child.try_wait()? {
                return Ok(status);
            }
            check_time(stop, until, limit)?;
            std::thread::sleep(TICK);
        }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        kill_group(self.group());
        drop(self.child.kill());
        drop(self.child.wait());
        self.stop.forget_group(self.group());
    }
}

enum Heard {
    Line(Vec<u8>),
    Flood(usize),
}

fn read_lines(mut stdout: impl Read, send: &SyncSender<Heard>) {
    let (mut line, mut total, mut buffer) = (Vec::new(), 0_usize, [0_u8; 8192]);
    while let Ok(n) = stdout.read(&mut buffer) {
        if n == 0 {
            break;
        }
        total += n;
        for byte in &buffer[..n] {
            if *byte != b'\n' {
                line.push(*byte);
            } else if send.send(Heard::Line(std::mem::take(&mut line))).is_err() {
                return;
            }
        }
        if total > MAX_STDOUT || line.len() > MAX_LINE {
            drop(send.send(Heard::Flood(if total > MAX_STDOUT { MAX_STDOUT } else { MAX_LINE })));
            return;
        }
    }
    if !line.is_empty() {
        drop(send.send(Heard::Line(line)));
    }
}

/// Hands on what is read, until the pipe or the listener is gone.
fn hand_on(mut pipe: impl Read, send: &SyncSender<Vec<u8>>) {
    let mut buffer = [0_u8; 4096];
    // A pipe that nobody listens to any more is read all the same, so that its writer does not hang.
    while let Ok(n @ 1..) = pipe.read(&mut buffer) {
        drop(send.try_send(buffer[..n].to_vec()));
    }
}

/// The beginning of what was said. Nobody waits long for the end: a process left behind may hold the pipe open.
fn keep_head(said: &Receiver<Vec<u8>>) -> String {
    let (mut kept, until) = (Vec::new(), Instant::now() + LAST_WORDS);
    while let Ok(part) = said.recv_timeout(until.saturating_duration_since(Instant::now())) {
        let room = MAX_STDERR.saturating_sub(kept.len()).min(part.len());
        kept.extend_from_slice(&part[..room]);
    }
    String::from_utf8_lossy(&kept).trim().to_owned()
}

fn find(name: &str, folder: &Path) -> PathBuf {
    let path = Path::new(name);
    if path.is_absolute() {
        return path.to_path_buf();
    }
    if name.contains('/') {
        return folder.join(path);
    }
    let search = std::env::var_os("PATH").unwrap_or_default();
    let found = std::env::split_paths(&search).filter(|d| d.is_absolute()).map(|d| d.join(name)).find(|p| p.is_file());
    found.unwrap_or_else(|| path.to_path_buf())
}

#[cfg(unix)]
fn own_group(command: &mut Command) {
    use std::os::unix::process::CommandExt as _;
    command.process_group(0);
}

#[cfg(not(unix))]
fn own_group(_: &mut Command) {}
