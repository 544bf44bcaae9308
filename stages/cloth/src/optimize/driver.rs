//! The one loop of every descent: rounds of a factorisation and a block of quasi-Newton steps, with mechanisms around them.
//!
//! Drape, coarse level, sewing, settling and time step differ only in the terms of their objective and in their list of
//! mechanisms.

use crate::optimize::descent::Descent;
use crate::optimize::mechanism::{Block, Mechanism, Verdict};
use crate::{ClothError, StopReason, Watch};

/// How collision detection of cloth with itself accompanies a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Detection {
    /// Every step is bounded by continuous detection.
    EveryStep,
    /// Steps may be taken ahead of detection, which then checks each block.
    EveryBlock,
    /// Steps may be taken ahead of detection, which then checks several blocks at once.
    SeveralBlocks,
}

/// How blocks of steps are taken.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Blocks {
    /// Most steps of a block.
    pub steps: usize,
    pub detection: Detection,
}

/// Lowers the energy until a mechanism ends the descent.
///
/// # Errors
/// An energy beyond numbers, a Hessian that cannot be factorised, or a stop on request.
pub(crate) fn drive(
    d: &mut Descent<'_>,
    blocks: Blocks,
    mechanisms: &mut [&mut dyn Mechanism],
    watch: &mut dyn Watch,
) -> Result<StopReason, ClothError> {
    d.stuck_blocks = 0;
    mechanisms.iter_mut().for_each(|m| m.begin(d));
    loop {
        match round(d, blocks, mechanisms, watch)? {
            Verdict::Stop(reason) => return Ok(reason),
            Verdict::Go | Verdict::Again | Verdict::AtRest => {}
        }
    }
}

/// One round.
fn round(
    d: &mut Descent<'_>,
    blocks: Blocks,
    mechanisms: &mut [&mut dyn Mechanism],
    watch: &mut dyn Watch,
) -> Result<Verdict, ClothError> {
    for m in mechanisms.iter_mut() {
        match m.begin_round(d, watch)? {
            Verdict::Go => {}
            other => return Ok(other),
        }
    }
    match precondition(d, mechanisms) {
        // Where cloth has gone through itself ahead of detection, no way may lead on. It is taken back.
        Err(_) if !d.check_or_roll_back() => precondition(d, mechanisms)?,
        other => other?,
    }
    for k in 0..mechanisms.len() {
        match mechanisms[k].before_block(d, watch)? {
            Verdict::Go => {}
            Verdict::AtRest => return Ok(at_rest(d, mechanisms)),
            other => return Ok(other),
        }
    }
    let Some(block) = take_block(d, blocks, mechanisms) else { return Ok(Verdict::Again) };
    d.stuck_blocks = if block.steps == 0 { d.stuck_blocks + 1 } else { 0 };
    if let Some(reason) = block.stop {
        return Ok(Verdict::Stop(reason));
    }
    for m in mechanisms.iter_mut().rev() {
        match m.after_block(d, &block) {
            Verdict::Go => {}
            other => return Ok(other),
        }
    }
    Ok(Verdict::Go)
}

fn precondition(d: &mut Descent<'_>, mechanisms: &mut [&mut dyn Mechanism]) -> Result<(), ClothError> {
    d.check_energy()?;
    mechanisms.iter_mut().for_each(|m| m.refresh(d));
    d.precondition()
}

fn at_rest(d: &mut Descent<'_>, mechanisms: &mut [&mut dyn Mechanism]) -> Verdict {
    for m in mechanisms.iter_mut() {
        match m.at_rest(d) {
            Verdict::Go => {}
            other => return other,
        }
    }
    Verdict::Stop(StopReason::Settled)
}

fn take_block(d: &mut Descent<'_>, blocks: Blocks, mechanisms: &mut [&mut dyn Mechanism]) -> Option<Block> {
    let Blocks { steps, detection } = blocks;
    match detection {
        Detection::EveryStep => Some(d.take_steps(steps, mechanisms)),
        Detection::EveryBlock => Some(d.take_checked_block(steps, mechanisms)),
        Detection::SeveralBlocks => d.take_block_ahead(steps, mechanisms),
    }
}
