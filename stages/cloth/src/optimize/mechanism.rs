//! Mechanisms: the rules that act at fixed moments of a descent.

use crate::optimize::descent::Descent;
use crate::{ClothError, StopReason, Watch};

/// How a mechanism lets the driver go on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    /// The round goes on.
    Go,
    /// Something has changed: a new round begins.
    Again,
    /// All that can be seen in this round says that the cloth is at rest. The driver then asks every mechanism
    /// ([`Mechanism::at_rest`]).
    AtRest,
    /// The descent ends.
    Stop(StopReason),
}

/// How a mechanism lets a block go on after a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum StepVerdict {
    /// The block goes on.
    Go,
    /// The block ends.
    EndBlock,
    /// The descent ends.
    Stop(StopReason),
}

/// The result of a block of steps.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Block {
    pub steps: usize,
    /// Mean part of the full step that was taken.
    pub mean: f64,
    /// Energy that was gained, J.
    pub gain: f64,
    /// Did it end with a step that gained nothing?
    pub stuck: bool,
    /// A reason to end the descent.
    pub stop: Option<StopReason>,
}

/// A named rule that acts at fixed moments of a descent. Every moment has a default that does nothing.
///
/// Mechanisms act in the order of their list; after a block they act in the reverse order.
pub(crate) trait Mechanism {
    /// Acts once, before the first round.
    fn begin(&mut self, _: &mut Descent<'_>) {}

    /// Acts at the head of a round.
    fn begin_round(&mut self, _: &mut Descent<'_>, _: &mut dyn Watch) -> Result<Verdict, ClothError> {
        Ok(Verdict::Go)
    }

    /// Acts right before the preconditioner is made, on forces that lag behind the positions.
    fn refresh(&mut self, _: &mut Descent<'_>) {}

    /// Acts with a preconditioner for this place, before the block.
    fn before_block(&mut self, _: &mut Descent<'_>, _: &mut dyn Watch) -> Result<Verdict, ClothError> {
        Ok(Verdict::Go)
    }

    /// Acts where the cloth is at rest as far as this round can see. Any verdict but [`Verdict::Go`] goes on from there.
    fn at_rest(&mut self, _: &mut Descent<'_>) -> Verdict {
        Verdict::Go
    }

    /// Acts after a step, of which this part was taken; `None` if it gained nothing.
    fn after_step(&mut self, _: &mut Descent<'_>, _: Option<f64>) -> StepVerdict {
        StepVerdict::Go
    }

    /// Acts after a block.
    fn after_block(&mut self, _: &mut Descent<'_>, _: &Block) -> Verdict {
        Verdict::Go
    }
}
