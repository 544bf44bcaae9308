//! For how long a list of what is near stays good.

use crate::Vec3;

/// Where the vertices were when a list was made that holds all that comes near within a slack of there, and of the way
/// along a step.
#[derive(Debug, Default)]
pub(crate) struct Listed {
    at: Vec<Vec3>,
    /// m, per vertex.
    slack: f64,
    on_the_way: bool,
}

impl Listed {
    /// Does the list hold for ways from `x` of at most `longest`, and `beside` them?
    pub fn covers(&mut self, x: &[Vec3], longest: f64, beside: f64) -> bool {
        self.on_the_way = false;
        let moved = crate::farthest(&self.at, x);
        !self.at.is_empty() && moved + longest + beside <= self.slack
    }

    /// A list has been made along a step from `x`.
    pub fn made(&mut self, x: &[Vec3], slack: f64) {
        self.at.clear();
        self.at.extend_from_slice(x);
        self.slack = slack;
        self.on_the_way = true;
    }

    /// `x` was reached: if the list was made for that step, the slack counts from here on.
    pub fn took(&mut self, x: &[Vec3]) {
        if std::mem::take(&mut self.on_the_way) {
            self.at.copy_from_slice(x);
        }
    }

    pub fn forget(&mut self) {
        self.at.clear();
        self.on_the_way = false;
    }
}
