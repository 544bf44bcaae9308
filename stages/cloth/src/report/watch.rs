//! How a caller follows and stops a run.

use crate::Vec3;

/// An observer of a run, who may stop it.
pub trait Watch {
    /// Called now and then after `step` steps, with the progress in words.
    fn progress(&mut self, step: u64, words: &str);
    /// Returns `true` if the run should stop now.
    fn cancelled(&self) -> bool;
    /// The part of the work that seems done, 0 to 1. It never shrinks; nothing else depends on it.
    fn done(&mut self, _part: f64) {}
    /// Returns `true` for a watch that wants to see the cloth on the way.
    fn looks(&self) -> bool {
        false
    }
    /// The cloth on the way: places of all vertices of the scene, m, worked out on a mesh of `triangles` triangles.
    fn look(&mut self, _positions: &[Vec3], _triangles: usize) {}
}

/// A watch that does nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Watch for Silent {
    fn progress(&mut self, _: u64, _: &str) {}
    fn cancelled(&self) -> bool {
        false
    }
}

/// A watch over a part of the work that is done on another cloth than the caller's.
pub(crate) struct Part<'a> {
    whole: &'a mut dyn Watch,
    /// Places of the caller's vertices from those of the other cloth.
    back: &'a dyn Fn(&[Vec3]) -> Vec<Vec3>,
    /// Share of the whole that was done before this part.
    from: f64,
    /// Share of the whole that is done after this part.
    to: f64,
}

impl<'a> Part<'a> {
    pub fn new(whole: &'a mut dyn Watch, [from, to]: [f64; 2], back: &'a dyn Fn(&[Vec3]) -> Vec<Vec3>) -> Self {
        Self { whole, back, from, to }
    }
}

impl Watch for Part<'_> {
    fn progress(&mut self, step: u64, words: &str) {
        self.whole.progress(step, words);
    }

    fn cancelled(&self) -> bool {
        self.whole.cancelled()
    }

    fn done(&mut self, part: f64) {
        self.whole.done(self.from + part * (self.to - self.from));
    }

    fn looks(&self) -> bool {
        self.whole.looks()
    }

    fn look(&mut self, positions: &[Vec3], triangles: usize) {
        if self.looks() {
            self.whole.look(&(self.back)(positions), triangles);
        }
    }
}
