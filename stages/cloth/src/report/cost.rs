//! Where the CPU time of a run goes. It is told beside the results and never part of them.

/// Kinds of work that are told apart.
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
    /// Metric, factor and directions of the descent.
    Descent,
}

/// CPU seconds by kind of work.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Costs([f64; 8]);

impl Costs {
    /// Counts the time since the last look.
    pub fn spend(&mut self, work: Work, lap: &mut Lap) {
        self.0[work as usize] += lap.next();
    }

    /// Counts seconds of another thread.
    pub fn add(&mut self, work: Work, seconds: f64) {
        self.0[work as usize] += seconds;
    }

    pub fn of(&self, work: Work) -> f64 {
        self.0[work as usize]
    }

    pub fn join(mut self, other: &Self) -> Self {
        self.0.iter_mut().zip(other.0).for_each(|(a, b)| *a += b);
        self
    }
}

/// A stop watch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lap(f64);

impl Lap {
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

/// Wall time where the system tells nothing better, s.
#[cfg(not(unix))]
fn clock() -> f64 {
    static START: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
    START.get_or_init(std::time::Instant::now).elapsed().as_secs_f64()
}
