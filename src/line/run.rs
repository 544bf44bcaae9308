//! Runs the jobs of a line on this machine: each is a plain `toile run` in a process of its own.
//!
//! A job that is done is not run again, whatever ended the line before. Processes end with this one: their standard
//! input is a pipe that it holds.

use super::done::{is_done, record, was_run};
use super::survey::{Planned, Rights, Survey};
use super::thumbnail::draw;
use super::{Job, Line};
use crate::engine::{CacheOptions, Exit, Stop, is_locked};
use serde_json::Value;
use std::collections::VecDeque;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// How often a process is looked at.
const TICK: Duration = Duration::from_millis(5);
/// Longest wait for a process of an earlier line that is still leaving.
const LEAVING: Duration = Duration::from_secs(10);

/// How the jobs are run.
pub struct Order<'a> {
    /// The line.
    pub line: &'a Line,
    /// The survey of its jobs.
    pub survey: &'a Survey,
    /// Folder of the results.
    pub out: PathBuf,
    /// The program.
    pub program: PathBuf,
    /// Rights of the pipelines.
    pub rights: Rights,
    /// Processes at once.
    pub processes: usize,
    /// Threads of each.
    pub threads: usize,
    /// Memory of all processes together, MB.
    pub mb: f64,
    /// Cache of stages.
    pub cache: Option<CacheOptions>,
    /// Do finished jobs again?
    pub force: bool,
}

/// How a job ended.
#[derive(Clone, Debug)]
pub struct Ran {
    /// Exit code.
    pub code: u8,
    /// Its record, if it wrote one.
    pub record: Option<Value>,
    /// Was it done before?
    pub kept: bool,
}

/// The jobs that wait, and the memory that is taken.
struct Queue {
    waiting: VecDeque<usize>,
    running: usize,
    mb: f64,
}

impl Order<'_> {
    /// Folder of a job.
    #[must_use]
    pub fn folder(&self, job: &Job) -> PathBuf {
        self.out.join("jobs").join(&job.name)
    }

    /// File of the messages of a job that said anything.
    fn log(&self, job: &Job) -> PathBuf {
        self.out.join("logs").join(format!("{}.txt", job.name))
    }

    /// Runs all jobs of `wanted`; `told` hears of every end with the number of jobs that are through. `None` for jobs
    /// that were not begun because of a stop.
    pub fn run(&self, wanted: &[usize], stop: &Stop, told: &mut dyn FnMut(usize, &Job, &Ran)) -> Vec<Option<Ran>> {
        let mut results: Vec<Option<Ran>> = vec![None; self.line.jobs.len()];
        let mut order = wanted.to_vec();
        // Long jobs first: so the last ones to end are short.
        let seconds = |k: &usize| self.planned(*k).map_or(0.0, |p| p.seconds);
        order.sort_by(|a, b| seconds(b).total_cmp(&seconds(a)).then(a.cmp(b)));
        let queue = Mutex::new(Queue { waiting: order.into(), running: 0, mb: 0.0 });
        let free = Condvar::new();
        std::thread::scope(|scope| {
            let (tell, heard) = std::sync::mpsc::channel();
            for _ in 0..self.processes {
                let (tell, queue, free) = (tell.clone(), &queue, &free);
                scope.spawn(move || {
                    while let Some(number) = self.next(queue, free, stop) {
                        let ran = self.one(number, stop);
                        self.give_back(number, queue, free);
                        // The listener lives as long as this thread.
                        drop(tell.send((number, ran)));
                    }
                });
            }
            drop(tell);
            for (done, (number, ran)) in heard.into_iter().enumerate() {
                if !stop.asked() {
                    told(done + 1, &self.line.jobs[number], &ran);
                    results[number] = Some(ran);
                }
            }
        });
        results
    }

    /// The memory of a job is free again.
    fn give_back(&self, number: usize, queue: &Mutex<Queue>, free: &Condvar) {
        let mut queue = lock(queue);
        queue.running -= 1;
        queue.mb -= self.mb_of(number);
        free.notify_all();
    }

    /// The next job, as soon as its memory is free. One job runs always.
    fn next(&self, queue: &Mutex<Queue>, free: &Condvar, stop: &Stop) -> Option<usize> {
        let mut queue = lock(queue);
        loop {
            let number = *queue.waiting.front().filter(|_| !stop.asked())?;
            if queue.running == 0 || queue.mb + self.mb_of(number) <= self.mb {
                queue.waiting.pop_front();
                queue.running += 1;
                queue.mb += self.mb_of(number);
                return Some(number);
            }
            queue = free.wait(queue).unwrap_or_else(PoisonError::into_inner);
        }
    }

    fn planned(&self, number: usize) -> Option<&Planned> {
        self.survey.jobs[number].planned.as_ref()
    }

    fn mb_of(&self, number: usize) -> f64 {
        self.planned(number).map_or(0.0, |p| p.mb)
    }

    fn one(&self, number: usize, stop: &Stop) -> Ran {
        let job = &self.line.jobs[number];
        let folder = self.folder(job);
        let is_kept = !self.force && self.planned(number).is_some_and(|p| is_done(&folder, p));
        if let Some(ran) = was_run(&folder).filter(|_| is_kept) {
            return ran;
        }
        let code = self.process(job, &folder, stop).unwrap_or(Exit::System.code());
        let log = self.log(job);
        if log.metadata().is_ok_and(|m| m.len() == 0) {
            drop(std::fs::remove_file(log));
        }
        // A try that was refused before it began leaves the record of an earlier one.
        let record = record(&folder).filter(|r| r["exit_code"] == code);
        if let Some(record) = &record {
            // The page does without where nothing can be drawn.
            let _ = draw(&folder, record, &self.out.join("pictures").join(format!("{}.png", job.name)));
        }
        Ran { code, record, kept: false }
    }

    fn process(&self, job: &Job, folder: &Path, stop: &Stop) -> std::io::Result<u8> {
        let began = std::time::Instant::now();
        while is_locked(folder) && began.elapsed() < LEAVING && !stop.asked() {
            std::thread::sleep(10 * TICK);
        }
        let mut child = Command::new(&self.program)
            .args(arguments(self.line, job))
            .arg("--out")
            .arg(folder)
            .args(self.options())
            .current_dir(if self.line.folder.as_os_str().is_empty() { Path::new(".") } else { &self.line.folder })
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(File::create(self.log(job))?)
            .spawn()?;
        wait(&mut child, stop)
    }

    /// Options of every job, apart from what it makes.
    fn options(&self) -> Vec<std::ffi::OsString> {
        let mut options: Vec<std::ffi::OsString> =
            ["--quiet", "--force", "--tied", "--threads"].map(Into::into).to_vec();
        options.push(self.threads.to_string().into());
        for folder in &self.rights.allow_read {
            options.extend(["--allow-read".into(), folder.into()]);
        }
        for plugin in &self.rights.allow_run {
            options.extend(["--allow-run".into(), plugin.into()]);
        }
        if let Some(cache) = &self.cache {
            options.extend(["--cache".into(), (&cache.folder).into(), "--cache-size".into()]);
            options.push((cache.limit as f64 * 1e-6).to_string().into());
        }
        options
    }
}

/// Waits for a process; a stop takes its standard input away, and it leaves.
fn wait(child: &mut Child, stop: &Stop) -> std::io::Result<u8> {
    let tie = child.stdin.take();
    loop {
        if let Some(status) = child.try_wait()? {
            // A process that was killed has no code.
            return Ok(status.code().and_then(|c| u8::try_from(c).ok()).unwrap_or(Exit::System.code()));
        }
        if stop.asked() {
            drop(tie);
            let status = child.wait()?;
            return Ok(status.code().and_then(|c| u8::try_from(c).ok()).unwrap_or(Exit::Stopped.code()));
        }
        std::thread::sleep(TICK);
    }
}

/// Arguments of the program that make a job, to be run in the folder of the line: pipeline, overrides and limits.
#[must_use]
pub fn arguments(line: &Line, job: &Job) -> Vec<String> {
    let mut words = vec!["run".to_owned(), job.pipeline.to_string_lossy().into_owned()];
    words.extend(job.sets.iter().flat_map(|set| ["--set".to_owned(), set.text.clone()]));
    let limits = line.file.limits;
    let limits = [("--max-seconds", limits.seconds), ("--max-memory", limits.mb)];
    words.extend(limits.iter().filter_map(|(k, v)| Some([(*k).to_owned(), (*v)?.to_string()])).flatten());
    words
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
