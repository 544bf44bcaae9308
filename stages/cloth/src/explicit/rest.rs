//! Measures of rest: how far vertices moved and how much the elastic energy changed over a window of time.

use crate::Vec3;
use crate::explicit::problem::Problem;
use crate::explicit::tuning::{REST_PEAK_ENERGY_SHARE, REST_WINDOW};

/// The present window, and what the last one showed.
pub(crate) struct RestTest {
    /// Positions at the start of the window, m.
    positions: Vec<Vec3>,
    /// Elastic energy at the start of the window, J.
    elastic: f64,
    /// Simulated time at the start of the window, s.
    begun: f64,
    /// Largest elastic energy so far, J.
    peak: f64,
    /// Largest mean speed of a free vertex over the last window, m/s.
    pub speed: f64,
    /// Relative change of the elastic energy over the last window (stop condition b of the paper).
    pub change: f64,
    /// Quiet windows in a row.
    pub quiet_windows: u32,
}

impl RestTest {
    /// Begins the first window at time 0.
    pub fn new(x: &[Vec3], elastic: f64) -> Self {
        Self { positions: x.to_vec(), elastic, begun: 0.0, peak: elastic, speed: 0.0, change: 0.0, quiet_windows: 0 }
    }

    /// Returns `true` at the end of a window.
    pub fn is_due(&self, seconds: f64) -> bool {
        seconds - self.begun >= REST_WINDOW.get()
    }

    /// Measures speed and change of energy over the window, and begins the next one.
    pub fn measure(&mut self, problem: &Problem, x: &[Vec3], seconds: f64) {
        let span = seconds - self.begun;
        let elastic = problem.elastic(x);
        let free = |i: &usize| problem.is_free(*i);
        let moved = (0..x.len()).filter(free).map(|i| (x[i] - self.positions[i]).norm());
        self.speed = moved.fold(0.0, f64::max) / span;
        // A flat piece at rest stores next to nothing; its largest energy so far gives the scale then.
        self.peak = self.peak.max(elastic);
        let scale = elastic.max(self.elastic).max(REST_PEAK_ENERGY_SHARE.get() * self.peak);
        self.change = if scale > 0.0 { (elastic - self.elastic).abs() / scale } else { 0.0 };
        self.positions.copy_from_slice(x);
        self.elastic = elastic;
        self.begun = seconds;
    }
}
