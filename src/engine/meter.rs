//! CPU seconds and peak memory of this process, where the system tells. They only ever go into `run.json`.

/// A reading of the process's clocks.
#[derive(Clone, Copy, Debug)]
pub struct Meter {
    started: std::time::Instant,
    cpu: Option<f64>,
}

impl Meter {
    /// Starts measuring.
    #[must_use]
    pub fn start() -> Self {
        Self { started: std::time::Instant::now(), cpu: cpu_seconds() }
    }

    /// Wall seconds since the start.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        milli(self.started.elapsed().as_secs_f64())
    }

    /// CPU seconds of all threads since the start.
    #[must_use]
    pub fn cpu_seconds(&self) -> Option<f64> {
        Some(milli(cpu_seconds()? - self.cpu?))
    }
}

fn milli(seconds: f64) -> f64 {
    (seconds * 1000.0).round() / 1000.0
}

/// Largest resident memory so far, MB, since `reset_peak` if that was called. Not reset from stage to stage: who
/// measures the process from outside would see the last stage's peak only.
#[must_use]
pub fn peak_mb() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:"))?;
    let kib: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some((kib * 1.024 / 100.0).round() / 10.0)
}

/// Lets the peak of memory count from here: for a process that makes many runs.
pub(crate) fn reset_peak() {
    // Not every system lets a process do this; the peak is then that of all runs so far.
    drop(std::fs::write("/proc/self/clear_refs", "5"));
}

/// User and system time of the process in seconds; Linux counts them in hundredths for every program.
fn cpu_seconds() -> Option<f64> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    let fields: Vec<&str> = stat.rsplit(')').next()?.split_whitespace().collect();
    let ticks = |i: usize| fields.get(i)?.parse::<f64>().ok();
    Some((ticks(11)? + ticks(12)?) / 100.0)
}
