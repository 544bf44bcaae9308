//! CPU time of a run by kind of work. It is reported beside the results and never part of them.

/// Kinds of work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Work {
    /// Stretch, bending, weight.
    Cloth,
    SelfContact,
    BodyContact,
    Friction,
    Sewing,
    Hysteresis,
    Pressure,
    /// Preconditioner, factor and directions of the descent.
    Descent,
}

/// CPU seconds by kind of work.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Costs([f64; 8]);

impl Costs {
    /// Adds the time since the timer was last read.
    pub fn spend(&mut self, work: Work, lap: &mut CpuTimer) {
        self.0[work as usize] += lap.next();
    }

    /// Adds seconds of another thread.
    pub fn add(&mut self, work: Work, seconds: f64) {
        self.0[work as usize] += seconds;
    }

    /// CPU seconds of a kind of work.
    pub fn of(&self, work: Work) -> f64 {
        self.0[work as usize]
    }

    /// The sum of two costs.
    pub fn join(mut self, other: &Self) -> Self {
        self.0.iter_mut().zip(other.0).for_each(|(a, b)| *a += b);
        self
    }
}

/// A timer of CPU time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CpuTimer(f64);

impl CpuTimer {
    /// A timer that starts now.
    pub fn start() -> Self {
        Self(clock())
    }

    /// Seconds since the last call.
    pub fn next(&mut self) -> f64 {
        let before = std::mem::replace(&mut self.0, clock());
        self.0 - before
    }
}

/// CPU time of this thread, s.
#[cfg(unix)]
fn clock() -> f64 {
    let t = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    t.tv_sec as f64 + t.tv_nsec as f64 * 1e-9
}

/// Wall time, s, where the system has no CPU time of a thread.
#[cfg(not(unix))]
fn clock() -> f64 {
    static START: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
    START.get_or_init(std::time::Instant::now).elapsed().as_secs_f64()
}
