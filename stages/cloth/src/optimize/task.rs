//! The tasks that a descent is built for.

/// The goal of a descent. The task decides which terms the objective has and which mechanisms act.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Task {
    /// Close the stitches: a stitch penalty pulls every pair together.
    Sew,
    /// Settle cloth whose rest is the result.
    Settle,
    /// Settle a coarser level, from whose rest a finer level goes on. It may rest with any forces.
    SettleCoarse,
}
