//! The region in which a list of candidate pairs stays valid.

use crate::Vec3;

/// The vertex positions for which a list of candidate pairs was made, and the slack around them.
///
/// The list holds every pair that comes near within the slack of those positions and along the step it was made for.
#[derive(Debug, Default)]
pub(crate) struct ListValidity {
    positions: Vec<Vec3>,
    /// Distance that every vertex may move before the list must be made anew, m.
    slack: f64,
    /// The list was made for a step that has not been taken yet.
    step_is_pending: bool,
}

impl ListValidity {
    /// Is the list valid along steps from `x` of at most `longest`, m?
    pub fn covers(&mut self, x: &[Vec3], longest: f64) -> bool {
        self.step_is_pending = false;
        let moved = crate::farthest(&self.positions, x);
        !self.positions.is_empty() && moved + longest <= self.slack
    }

    /// Records that a list has been made for a step from `x`.
    pub fn record(&mut self, x: &[Vec3], slack: f64) {
        self.positions.clear();
        self.positions.extend_from_slice(x);
        self.slack = slack;
        self.step_is_pending = true;
    }

    /// Records that a step to `x` was taken. If the list was made for that step, the slack counts from `x`.
    pub fn step_taken(&mut self, x: &[Vec3]) {
        if std::mem::take(&mut self.step_is_pending) {
            self.positions.copy_from_slice(x);
        }
    }

    /// Declares the list invalid.
    pub fn invalidate(&mut self) {
        self.positions.clear();
        self.step_is_pending = false;
    }
}
