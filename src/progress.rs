//! How a run tells what it does: bars on a terminal, plain lines every ten seconds off it, nothing when quiet; and
//! events as JSON lines for other programs. Only this file knows indicatif.

use crate::engine::Preview;
use crate::render::finding_line;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde_json::{Value, json};
use std::io::{IsTerminal as _, Write};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::{Duration, Instant};
use toile_garment::{Diagnostic, Garment};
use toile_stage_api::Progress;

/// Time between plain lines.
const LINE_EVERY: Duration = Duration::from_secs(10);
/// Time between progress events.
const EVENT_EVERY: Duration = Duration::from_millis(100);

/// How much is said on stderr.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Voice {
    /// Bars on a terminal, lines elsewhere.
    Auto,
    /// Nothing but errors.
    Quiet,
    /// Nothing at all.
    Silent,
}

/// Tells one run's progress and findings.
pub struct Teller {
    voice: Voice,
    bar: Option<ProgressBar>,
    lines: Option<Lines>,
    preview: Option<Preview>,
    keeps: bool,
    seen: Option<Garment>,
    events: Option<Box<dyn Write + Send>>,
    sequence: u64,
    started: Instant,
    pace: Pace,
    last_event: Option<Instant>,
    counts: std::collections::BTreeMap<String, usize>,
}

impl Teller {
    /// A teller; `events` gets JSON lines.
    #[must_use]
    pub fn new(voice: Voice, events: Option<Box<dyn Write + Send>>) -> Self {
        let terminal = voice == Voice::Auto && std::io::stderr().is_terminal();
        let bar = terminal.then(make_bar);
        let lines = (voice == Voice::Auto && !terminal).then(Lines::start);
        let counts = std::collections::BTreeMap::new();
        let now = Instant::now();
        Self {
            voice,
            bar,
            lines,
            preview: None,
            keeps: false,
            seen: None,
            events,
            sequence: 0,
            started: now,
            pace: Pace::start(),
            last_event: None,
            counts,
        }
    }

    /// A teller that says nothing.
    #[must_use]
    pub fn silent() -> Self {
        Self::new(Voice::Silent, None)
    }

    /// The garment on the way is kept, for the case that the run fails.
    pub fn keep_looks(&mut self, keep: bool) {
        self.keeps = keep;
    }

    /// The garment as it was last seen in the stage that is running, or was the last to run.
    pub fn last_look(&mut self) -> Option<Garment> {
        self.seen.take()
    }

    /// Words for a person, beside the findings.
    pub fn note(&mut self, words: &str) {
        if self.voice == Voice::Auto {
            self.say(words);
        }
    }

    /// The garment is shown there on the way.
    pub fn show_in(&mut self, preview: Preview) {
        self.preview = Some(preview);
    }

    /// A stage begins.
    pub fn stage_start(&mut self, number: usize, total: usize, id: &str) {
        self.pace = Pace::start();
        self.seen = None;
        let prefix = format!("{number}/{total} {id}");
        if let Some(bar) = &self.bar {
            bar.set_prefix(prefix.clone());
            bar.set_message("");
            bar.set_length(0);
            bar.set_position(0);
            bar.enable_steady_tick(EVENT_EVERY);
        }
        if let Some(lines) = &self.lines {
            lines.set(prefix, true);
        }
        self.event("stage.start", json!({ "stage": id, "number": number, "total": total }));
    }

    /// A stage is over.
    pub fn stage_end(&mut self, id: &str, seconds: f64, status: &str) {
        if let Some(bar) = &self.bar {
            let line = format!("{} {seconds:.2} s{}", bar.prefix(), if status == "good" { "" } else { " failed" });
            bar.println(line);
        }
        if let Some(lines) = &self.lines {
            lines.end(seconds, status);
        }
        self.event("stage.end", json!({ "stage": id, "seconds": seconds, "status": status }));
    }

    /// Findings: the first few of a code, then one line with the count at the end; notes of one code are one line.
    pub fn findings(&mut self, findings: &[Diagnostic]) {
        for finding in findings {
            self.event("finding", serde_json::to_value(finding).unwrap_or(Value::Null));
        }
        for finding in crate::render::grouped(findings) {
            self.tell(&finding);
        }
    }

    fn tell(&mut self, finding: &Diagnostic) {
        let is_error = finding.severity == toile_garment::Severity::Error;
        let heard = match self.voice {
            Voice::Auto => true,
            Voice::Quiet => is_error,
            Voice::Silent => false,
        };
        let count = self.counts.entry(finding.code.clone()).or_default();
        *count += 1;
        if heard && *count <= crate::render::MAX_PER_CODE {
            self.say(&finding_line(finding));
        }
    }

    /// The run is over.
    pub fn run_end(&mut self, status: &str, seconds: f64) {
        if self.voice == Voice::Auto {
            for (code, count) in std::mem::take(&mut self.counts) {
                if count > crate::render::MAX_PER_CODE {
                    let more = count - crate::render::MAX_PER_CODE;
                    self.say(&format!("… and {more} more of `{code}`: see run.json"));
                }
            }
        }
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
        self.lines = None;
        self.event("run.end", json!({ "status": status, "seconds": seconds }));
    }

    fn say(&self, text: &str) {
        match &self.bar {
            Some(bar) => bar.println(text),
            // A closed stderr is no reason to stop a run.
            None => drop(writeln!(std::io::stderr(), "{text}")),
        }
    }

    fn event(&mut self, kind: &str, mut body: Value) {
        let Some(events) = &mut self.events else { return };
        let t = (self.started.elapsed().as_secs_f64() * 1000.0).round() / 1000.0;
        if let Some(map) = body.as_object_mut() {
            map.insert("v".to_owned(), json!(1));
            map.insert("seq".to_owned(), json!(self.sequence));
            map.insert("t".to_owned(), json!(t));
            map.insert("kind".to_owned(), json!(kind));
        }
        self.sequence += 1;
        if writeln!(events, "{}", toile_garment::text::json(&body.to_string())).and_then(|()| events.flush()).is_err() {
            // Nobody listens any more.
            self.events = None;
        }
    }
}

impl Progress for Teller {
    fn update(&mut self, done: u64, total: u64, words: &str) {
        let left = self.pace.left(Instant::now(), done as f64 / total.max(1) as f64);
        if let Some(bar) = &self.bar {
            bar.set_length(total);
            bar.set_position(done);
            bar.set_message(format!("{}: {words}", in_words(left)));
        }
        if let Some(lines) = &self.lines {
            lines.update(left, done, total, words);
        }
        if self.events.is_some() && self.last_event.is_none_or(|last| last.elapsed() >= EVENT_EVERY) {
            self.last_event = Some(Instant::now());
            let left = left.map(|s| (s * 10.0).round() / 10.0);
            self.event("progress", json!({ "done": done, "total": total, "left_s": left, "words": words }));
        }
    }

    fn looks(&self) -> bool {
        self.preview.is_some() || self.keeps
    }

    fn look(&mut self, garment: &Garment, words: &str) {
        self.seen = self.keeps.then(|| garment.clone());
        let Some(preview) = &self.preview else { return };
        match preview.show(garment) {
            Ok(()) => self.event("preview", json!({ "words": words })),
            Err(reason) => {
                // The run itself needs no preview.
                self.preview = None;
                self.say(&format!("no preview: {reason}"));
            }
        }
    }
}

/// Part of a stage below which nothing is said of the time that it will take.
const EARLY: f64 = 0.05;

/// How fast the work of a stage goes.
struct Pace {
    started: Instant,
    /// When the part that is done was last seen to grow, and that part.
    grown: (Instant, f64),
}

impl Pace {
    fn start() -> Self {
        let now = Instant::now();
        Self { started: now, grown: (now, 0.0) }
    }

    /// Seconds that the stage will still take, as its work has gone up to now. Where the work stands still the time runs
    /// down, and in the end nothing is known any more.
    fn left(&mut self, now: Instant, part: f64) -> Option<f64> {
        if part > self.grown.1 {
            self.grown = (now, part);
        }
        let (at, part) = self.grown;
        let whole = at.duration_since(self.started).as_secs_f64() * (1.0 - part) / part;
        let left = whole - now.duration_since(at).as_secs_f64();
        ((EARLY..1.0).contains(&part) && left > 0.0).then_some(left)
    }
}

fn in_words(left: Option<f64>) -> String {
    left.filter(|s| *s >= 0.5).map_or_else(String::new, |s| format!(", about {s:.0} s left"))
}

fn make_bar() -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(0), ProgressDrawTarget::stderr_with_hz(10));
    let style = ProgressStyle::with_template("{prefix} {wide_bar} {percent:>3} % {elapsed}{msg}");
    bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

/// A sign on a terminal that work goes on whose end cannot be foreseen. It is gone when dropped.
pub struct Spinner(Option<ProgressBar>);

impl Spinner {
    /// Shows these words and the time since now.
    #[must_use]
    pub fn start(words: String) -> Self {
        Self(std::io::stderr().is_terminal().then(|| {
            let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr_with_hz(10));
            let style = ProgressStyle::with_template("{spinner} {msg}, {elapsed}");
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()));
            bar.set_message(words);
            bar.enable_steady_tick(EVENT_EVERY);
            bar
        }))
    }
}

impl Drop for Spinner {
    fn drop(&mut self) {
        if let Some(bar) = &self.0 {
            bar.finish_and_clear();
        }
    }
}

/// State of the plain lines, shared with the thread that prints them.
#[derive(Default)]
struct State {
    prefix: String,
    left: Option<f64>,
    done: u64,
    total: u64,
    words: String,
    over: bool,
}

impl State {
    fn line(&self) -> String {
        let share = if self.total > 0 {
            format!(" {:.0} %", 100.0 * self.done as f64 / self.total as f64)
        } else {
            String::new()
        };
        format!("{}{share}{}: {}", self.prefix, in_words(self.left), self.words)
    }
}

/// Plain lines: one when a stage begins and ends, one every ten seconds between.
struct Lines {
    shared: Arc<(Mutex<State>, Condvar)>,
    thread: Option<std::thread::JoinHandle<()>>,
}

impl Lines {
    fn start() -> Self {
        let shared: Arc<(Mutex<State>, Condvar)> = Arc::default();
        let other = Arc::clone(&shared);
        let thread = Some(std::thread::spawn(move || print_lines(&other)));
        Self { shared, thread }
    }

    fn set(&self, prefix: String, print: bool) {
        if print {
            drop(writeln!(std::io::stderr(), "{prefix}"));
        }
        *self.lock() = State { prefix, ..State::default() };
    }

    fn update(&self, left: Option<f64>, done: u64, total: u64, words: &str) {
        let mut state = self.lock();
        state.left = left;
        state.done = done;
        state.total = total;
        words.clone_into(&mut state.words);
    }

    fn end(&self, seconds: f64, status: &str) {
        let mut state = self.lock();
        let failed = if status == "good" { "" } else { ", failed" };
        drop(writeln!(std::io::stderr(), "{} took {seconds:.2} s{failed}", state.prefix));
        state.prefix.clear();
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, State> {
        self.shared.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn print_lines(shared: &(Mutex<State>, Condvar)) {
    let mut state = shared.0.lock().unwrap_or_else(PoisonError::into_inner);
    while !state.over {
        let (next, timeout) = shared.1.wait_timeout(state, LINE_EVERY).unwrap_or_else(PoisonError::into_inner);
        state = next;
        if timeout.timed_out() && !state.over && !state.prefix.is_empty() {
            drop(writeln!(std::io::stderr(), "{}", state.line()));
        }
    }
}

impl Drop for Lines {
    fn drop(&mut self) {
        self.lock().over = true;
        self.shared.1.notify_all();
        if let Some(thread) = self.thread.take() {
            drop(thread.join());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_that_is_left_runs_down_and_then_is_unknown() {
        let mut pace = Pace::start();
        let started = pace.started;
        let mut left = |seconds: u64, part: f64| pace.left(started + Duration::from_secs(seconds), part);
        assert_eq!(left(1, 0.01), None, "too early");
        assert_eq!(left(10, 0.5), Some(10.0));
        // The work stands still.
        assert_eq!(left(14, 0.5), Some(6.0));
        assert_eq!([left(20, 0.5), left(60, 0.5)], [None, None]);
        assert_eq!(left(61, 1.0), None, "all is done but the end");
        assert_eq!(in_words(None), "");
    }
}
