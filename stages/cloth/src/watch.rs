//! How a caller follows and stops a run.

/// Told about progress, asked whether to go on.
pub trait Watch {
    /// After `step` steps; a few words on how far it is.
    fn progress(&mut self, step: u64, words: &str);
    /// Should the run stop now?
    fn cancelled(&self) -> bool;
}

/// Watches nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Watch for Silent {
    fn progress(&mut self, _: u64, _: &str) {}
    fn cancelled(&self) -> bool {
        false
    }
}
