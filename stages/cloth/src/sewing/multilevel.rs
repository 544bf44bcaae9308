//! Sewing from coarse to fine (docs/hierarchy.md): the coarsest level is sewn and settles; every finer level starts where the coarser
//! one lies, with its seams already closed.

use crate::certificate::strain_over_limit;
use crate::hierarchy::Level;
use crate::optimize::descent::Descent;
use crate::optimize::mechanism::{Block, Mechanism, Verdict};
use crate::optimize::mechanisms::pinned_targets::PinnedTargets;
use crate::optimize::mechanisms::strain_limit_homotopy::{narrow_barrier, widen_partly};
use crate::optimize::report;
use crate::optimize::strain_limit_phase::StrainLimitPhase;
use crate::optimize::task::Task;
use crate::optimize::tuning::{STRAIN_LIMIT_HOMOTOPY, SURROGATE_HESSIAN};
use crate::report::watch::Part;
use crate::scene::weld::weld;
use crate::sewing::closing::{cap_steps, close, drive_sewing};
use crate::sewing::tuning::{
    MULTILEVEL_SEWING, SETTLING_ENERGY_SHARE, SETTLING_MEAN_PART, SETTLING_QUIET_BLOCKS, SETTLING_SLIDE_MOST,
    SETTLING_STEPS_MOST, SETTLING_STUCK_BLOCKS_MOST, SETTLING_TAU_FIRST, SETTLING_TAU_FREE, SEWN_STRAIN_MOST,
};
use crate::{ClothError, Outcome, Scene, Settings, StopReason, Vec3, Watch};

/// Parts of all work, for the progress display: sewing coarser levels, settling the coarser of two, and sewing where there
/// is one level only.
const COARSE_SEWING_WORK: f64 = 0.5;
const COARSE_SETTLING_WORK: f64 = 0.65;
const SINGLE_LEVEL_SEWING_WORK: f64 = 0.8;

/// Closes the stitches as far as they come.
pub(crate) fn sew(scene: &Scene, settings: &Settings, watch: &mut dyn Watch) -> Result<Outcome, ClothError> {
    SewnLevel { scene, settings, finest: true }.sew(watch)
}

/// One level to be sewn.
#[derive(Clone, Copy)]
struct SewnLevel<'a> {
    scene: &'a Scene,
    settings: &'a Settings,
    /// No finer cloth hangs on it.
    finest: bool,
}

impl SewnLevel<'_> {
    fn sew(self, watch: &mut dyn Watch) -> Result<Outcome, ClothError> {
        if let Some(outcome) = self.by_levels(watch)? {
            return Ok(outcome);
        }
        let same = <[Vec3]>::to_vec;
        // The finer level settles coarser cloth.
        let work = if self.finest { SINGLE_LEVEL_SEWING_WORK } else { 1.0 };
        let closed = close(self.scene, self.settings, &mut Part::new(watch, [0.0, work], &same))?;
        if !self.finest {
            return Ok(closed.drawn);
        }
        // Else a garment that has no coarser level would hang where sewing left it.
        let watch = &mut Part::new(watch, [work, 1.0], &same);
        Ok(match self.settle_in_place(&closed.drawn.positions, watch)? {
            Some(down) => down.after(&closed.drawn),
            // A belt that is too short for its body is not sewn by drawing it out.
            None => closed.apart.unwrap_or(closed.drawn),
        })
    }

    /// Sews the next coarser level first; `None` where there is none, or where its cloth would cross something at the start
    /// or once its seams are welded.
    fn by_levels(self, watch: &mut dyn Watch) -> Result<Option<Outcome>, ClothError> {
        if self.scene.stitches.is_empty() || !MULTILEVEL_SEWING.is_on() {
            return Ok(None);
        }
        let Some(level) = Level::below(self.scene) else { return Ok(None) };
        let below = SewnLevel { scene: &level.scene, finest: false, ..self };
        let spread = |x: &[Vec3]| level.spread(x);
        let sewn = match below.sew(&mut Part::new(watch, [0.0, COARSE_SEWING_WORK], &spread)) {
            Ok(sewn) => sewn,
            // Long edges may cut through a body that the cloth of this level passes.
            Err(ClothError::StartCrosses { .. }) => return Ok(None),
            Err(e) => return Err(e),
        };
        let mut part = Part::new(watch, [COARSE_SEWING_WORK, COARSE_SETTLING_WORK], &spread);
        let Some(down) = below.settle_in_place(&sewn.positions, &mut part)? else { return Ok(None) };
        let x = level.spread(&down.positions);
        watch.look(&x, level.scene.triangles.len());
        let mut watch = Part::new(watch, [COARSE_SETTLING_WORK, 1.0], &<[Vec3]>::to_vec);
        Ok(self.settle_in_place(&x, &mut watch)?.map(|outcome| outcome.after(&sewn).after(&down)))
    }

    /// Lets sewn cloth slide down into its place under gravity and without friction, as hands would lead it. Cloth that would
    /// slide off stays.
    fn settle_in_place(self, x: &[Vec3], watch: &mut dyn Watch) -> Result<Option<Outcome>, ClothError> {
        let heavy = Settings { gravity_scale: 1.0, ..self.settings.clone() };
        let settled = SewnLevel { settings: &heavy, ..self }.smooth(x, watch)?;
        let moved = |o: &Outcome| crate::farthest(x, &o.positions);
        if settled.as_ref().is_some_and(|o| moved(o) > SETTLING_SLIDE_MOST.get()) {
            self.smooth(x, watch)
        } else {
            Ok(settled)
        }
    }

    /// Welds the seams and lets the cloth come near to rest from `x`; `None` where it crosses something there, or where it
    /// stays stretched far beyond its limit.
    fn smooth(self, x: &[Vec3], watch: &mut dyn Watch) -> Result<Option<Outcome>, ClothError> {
        let mut welded = weld(self.scene, x);
        let mut descent = match Descent::begin(&welded.scene, self.settings, Task::Settle) {
            Ok(descent) => descent,
            Err(ClothError::StartCrosses { .. }) => return Ok(None),
            Err(e) => return Err(e),
        };
        if !self.finest {
            // Between the places where they should be held, coarse cloth would cut through a round body.
            descent.hold_pins_here();
        }
        cap_steps(&mut descent);
        descent.regularization.tau = SETTLING_TAU_FIRST.get();
        if SURROGATE_HESSIAN.is_on() {
            descent.use_surrogate(true);
        }
        ease(&mut descent, self.scene.triangles.len(), watch)?;
        let mut outcome = report::outcome(&mut descent, &welded.scene, StopReason::Settled);
        drop(descent);
        // A belt that is too short for its body is not sewn by welding it.
        welded.scene.positions.clone_from(&outcome.positions);
        if strain_over_limit(&welded.scene, self.settings) > SEWN_STRAIN_MOST.get() {
            return Ok(None);
        }
        outcome.positions = welded.spread(&outcome.positions);
        Ok(Some(outcome))
    }
}

/// Descends until little is gained. The strain-limit barrier begins wide and becomes the law's own on the way.
fn ease(d: &mut Descent<'_>, triangles: usize, watch: &mut dyn Watch) -> Result<(), ClothError> {
    if STRAIN_LIMIT_HOMOTOPY.is_on() {
        widen_partly(d);
    }
    let mut rule = Settling { triangles, quiet_blocks: 0 };
    drive_sewing(d, &mut rule, &mut PinnedTargets::sewing(), f64::INFINITY, watch)?;
    Ok(())
}

/// The rule of settling: it ends when several blocks gained little, or after a fixed number of steps.
struct Settling {
    triangles: usize,
    /// Blocks that gained little.
    quiet_blocks: u32,
}

impl Mechanism for Settling {
    fn begin_round(&mut self, d: &mut Descent<'_>, watch: &mut dyn Watch) -> Result<Verdict, ClothError> {
        let most = SETTLING_STEPS_MOST.get();
        watch.done((d.steps as f64 / most as f64).sqrt());
        let quiet = self.quiet_blocks >= SETTLING_QUIET_BLOCKS.get();
        if d.steps >= most || d.stuck_blocks > SETTLING_STUCK_BLOCKS_MOST.get() || quiet {
            return Ok(Verdict::Stop(StopReason::Settled));
        }
        d.report_progress(watch, &format!("smoothing {} triangles", self.triangles))?;
        Ok(Verdict::Go)
    }

    fn after_block(&mut self, d: &mut Descent<'_>, b: &Block) -> Verdict {
        let enough = SETTLING_QUIET_BLOCKS.get();
        let little = b.gain <= SETTLING_ENERGY_SHARE.get() * d.objective().elastic(&d.x);
        // A small gain of steps that fell short shows nothing, and under a large shift it shows only that the shift is large.
        self.quiet_blocks = match (little && b.steps > 0, b.mean > SETTLING_MEAN_PART.get()) {
            (true, true) if d.regularization.tau >= SETTLING_TAU_FREE.get() => enough,
            (true, true) => self.quiet_blocks + 1,
            (true, false) => self.quiet_blocks,
            _ => 0,
        };
        if let StrainLimitPhase::Wide(share) = d.strain_limits
            && self.quiet_blocks >= enough
            && narrow_barrier(d, share)
        {
            self.quiet_blocks = 0;
        }
        Verdict::Go
    }
}
