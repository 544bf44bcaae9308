//! State of speculative steps.

use crate::Vec3;
use crate::contact::lagged_friction::LaggedFriction;
use crate::energy::hysteresis::held::Hysteresis;
use crate::optimize::tuning::SPECULATION_BLOCKS_FIRST;

/// When blocks are taken ahead of detection, and from where.
pub(crate) struct Speculation {
    /// Blocks without self-contact that are still to come before speculation begins again.
    pub wait: u32,
    /// Blocks to wait after the next time that the cloth is taken back.
    pub next_wait: u32,
    /// The last place that was checked, once blocks are ahead of it.
    pub checkpoint: Option<Checkpoint>,
    /// Blocks ahead of detection, and the most that there may be.
    pub blocks: u32,
    pub most_blocks: u32,
}

impl Default for Speculation {
    fn default() -> Self {
        Self { wait: 0, next_wait: 0, checkpoint: None, blocks: 0, most_blocks: SPECULATION_BLOCKS_FIRST.get() }
    }
}

/// A place to which the cloth may be taken back, with the friction that holds it there.
pub(crate) struct Checkpoint {
    pub x: Vec<Vec3>,
    pub tau: f64,
    pub isotropic: f64,
    pub steps: u64,
    pub friction: Option<LaggedFriction>,
    pub hysteresis: Option<Hysteresis>,
}
