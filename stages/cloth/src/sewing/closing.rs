//! Closing the stitches by a penalty with force continuation (docs/sewing.md): the pieces are gathered by a growing force, then the
//! threads are drawn tight while the cloth comes to its distance from the body.

use crate::certificate::strain_over_limit;
use crate::optimize::descent::{Change, Descent};
use crate::optimize::driver::{Blocks, Detection, drive};
use crate::optimize::mechanism::{Block, Mechanism, Verdict};
use crate::optimize::mechanisms::contact_refresh::{AdaptiveStiffness, LaggedForces};
use crate::optimize::mechanisms::factor_reuse::FactorReuse;
use crate::optimize::mechanisms::pinned_targets::PinnedTargets;
use crate::optimize::mechanisms::regularization_schedule::RegularizationSchedule;
use crate::optimize::mechanisms::rest::BlockEnd;
use crate::optimize::mechanisms::strain_limit_homotopy::widen_partly;
use crate::optimize::report;
use crate::optimize::task::Task;
use crate::optimize::tuning::{BLOCK_STEPS, STRAIN_LIMIT_HOMOTOPY, SURROGATE_HESSIAN};
use crate::sewing::initial_guess;
use crate::sewing::joining::{Obstacles, join};
use crate::sewing::tuning::{
    CLOSED_GAP, GATHERED_GAP, GATHERING_IDLE_MOST, GATHERING_REACH, GATHERING_TAU_MOST, INITIAL_GUESS,
    SEWING_FORCE_BLOCK_STEPS, SEWING_FORCE_FACTOR, SEWING_FORCE_FIRST, SEWING_FORCE_MEAN_PART, SEWING_FORCE_MOST,
    SEWING_FORCE_TIGHT, SEWING_GAP_PROGRESS, SEWING_STEP_CAP_EDGES, SEWING_STEP_GROWTH, SEWN_ENERGY_SHARE,
    SEWN_STRAIN_MOST, STAND_OFF, STAND_OFF_CRAMPED_FORCE, STAND_OFF_EDGES, STAND_OFF_EDGES_LEAST, STAND_OFF_FACTOR,
    STAND_OFF_MOST, STAND_OFF_NARROW_GAP, TIGHTENING_ENERGY_SHARE, TIGHTENING_GAP_PROGRESS, TIGHTENING_STEPS_MOST,
};
use crate::{ClothError, Outcome, Scene, Settings, StopReason, Vec3, Watch};

/// Part of the work until the pieces are together, for the progress display.
const GATHERING_WORK: f64 = 0.8;

/// Cloth whose stitches were closed.
pub(crate) struct Closed {
    /// With all threads drawn tight.
    pub drawn: Outcome,
    /// Before that, where drawing the threads tight stretches the cloth far beyond its limit.
    pub apart: Option<Outcome>,
}

/// Closes the stitches as far as they come.
///
/// # Errors
/// An unusable scene or setting, a start that crosses, instability, or a stop on request.
pub(crate) fn close(scene: &Scene, settings: &Settings, watch: &mut dyn Watch) -> Result<Closed, ClothError> {
    let mut descent = Descent::begin(scene, settings, Task::Sew)?;
    let mut apart = None;
    if descent.objective().terms.stitches.is_some() {
        apart = sew(&mut descent, scene, watch)?;
        join_closed_stitches(&mut descent, scene);
    }
    let outcome = |d: &mut Descent<'_>| {
        let open = d.objective().widest_stitch(&d.x) > settings.stitches.closed_distance;
        report::outcome(d, scene, if open { StopReason::SeamsOpen } else { StopReason::Settled })
    };
    let drawn = outcome(&mut descent);
    let apart = apart.map(|x| {
        descent.move_to(x);
        outcome(&mut descent)
    });
    Ok(Closed { drawn, apart })
}

/// Gathers the pieces and draws the threads tight. Returns the positions before that where it stretches the cloth far beyond
/// its limit.
fn sew(d: &mut Descent<'_>, scene: &Scene, watch: &mut dyn Watch) -> Result<Option<Vec<Vec3>>, ClothError> {
    if SURROGATE_HESSIAN.is_on() {
        d.use_surrogate(true);
    }
    // Threads pull single triangles to their strain limit. Beside the stiffness there, steps would be micrometres long.
    if STRAIN_LIMIT_HOMOTOPY.is_on() {
        widen_partly(d);
    }
    let mut threads = Threads::new(d);
    cap_steps(d);
    let mut pinned = PinnedTargets::sewing();
    let reason = gather(d, scene, &mut threads, &mut pinned, watch)?;
    let apart = (reason != StopReason::Settled).then(|| d.x.clone());
    close_tightly(d, &mut threads, &mut pinned, watch)?;
    let drawn = Scene { positions: d.x.clone(), ..scene.clone() };
    Ok(apart.filter(|_| strain_over_limit(&drawn, d.settings) > SEWN_STRAIN_MOST.get()))
}

/// Caps steps as sewing needs it. They are so short that a contact is felt before it is passed, and that flat cloth may bend.
pub(crate) fn cap_steps(d: &mut Descent<'_>) {
    d.step_cap.edges = SEWING_STEP_CAP_EDGES.get();
    d.step_cap.growth = SEWING_STEP_GROWTH.get();
}

/// Descends by the mechanisms of sewing around `rule`, which decides when to end.
pub(crate) fn drive_sewing(
    d: &mut Descent<'_>,
    rule: &mut dyn Mechanism,
    pinned: &mut PinnedTargets,
    tau_most: f64,
    watch: &mut dyn Watch,
) -> Result<StopReason, ClothError> {
    let mut regularization = RegularizationSchedule { most: tau_most };
    let (mut stiffness, mut lagged, mut reuse, mut block_end) =
        (AdaptiveStiffness, LaggedForces, FactorReuse, BlockEnd);
    let mut mechanisms: [&mut dyn Mechanism; 7] =
        [rule, pinned, &mut stiffness, &mut lagged, &mut reuse, &mut regularization, &mut block_end];
    let blocks = Blocks { steps: d.block_steps(BLOCK_STEPS.get()), detection: Detection::EveryBlock };
    drive(d, blocks, &mut mechanisms, watch)
}

/// The force of the threads, and the distance at which cloth feels the body while it is sewn.
struct Threads {
    /// Largest distance to the body as it should be in the end, m.
    gap: f64,
    /// Distance at which cloth feels the body for now, m. Cloth that feels the body early slides round it.
    contact_distance: f64,
    /// Force per length of seam, N/m.
    force: f64,
}

impl Threads {
    fn new(d: &mut Descent<'_>) -> Self {
        let barrier = d.objective().terms.barrier.as_ref();
        let gap = barrier.map_or(0.0, |b| b.parameters.body_gap.iter().copied().fold(0.0, f64::max));
        let mut threads = Self { gap, contact_distance: 0.0, force: SEWING_FORCE_FIRST.get() };
        let first = (STAND_OFF_EDGES.get() * d.objective().edge).min(STAND_OFF_MOST.get());
        threads.set_contact_distance(d, if STAND_OFF.is_on() { first } else { 0.0 });
        threads
    }

    fn pull(&mut self, d: &mut Descent<'_>, force: f64, reach: f64) {
        self.force = force;
        d.change(|o, _| {
            if let Some(s) = &mut o.terms.stitches {
                (s.force, s.reach) = (force, reach);
            }
            Change::Energy
        });
    }

    fn set_contact_distance(&mut self, d: &mut Descent<'_>, distance: f64) {
        self.contact_distance = distance;
        d.change(|o, x| {
            if let Some(b) = &mut o.terms.barrier {
                b.body_activation_distance = distance;
                b.rebuild_lists(x);
            }
            Change::Energy
        });
    }
}

/// Brings the pieces together, as far as they come. Returns `Settled` if they are together.
fn gather(
    d: &mut Descent<'_>,
    scene: &Scene,
    threads: &mut Threads,
    pinned: &mut PinnedTargets,
    watch: &mut dyn Watch,
) -> Result<StopReason, ClothError> {
    let edge = d.objective().edge;
    let reach = GATHERING_REACH.get() * edge;
    threads.pull(d, SEWING_FORCE_FIRST.get(), reach);
    if INITIAL_GUESS.is_on() {
        initial_guess::bend_pieces(d, scene);
    }
    let first = d.objective().widest_stitch(&d.x);
    let mut rule = Gathering { threads, edge, reach, first, before: first, idle: 0 };
    drive_sewing(d, &mut rule, pinned, GATHERING_TAU_MOST.get(), watch)
}

/// Force continuation while the pieces are apart: the threads pull harder where the gaps no longer shrink.
struct Gathering<'t> {
    threads: &'t mut Threads,
    /// Mean edge, m.
    edge: f64,
    /// Gap at which the full force acts, m.
    reach: f64,
    /// Widest gap at the start, m.
    first: f64,
    /// Widest gap before the block, m.
    before: f64,
    /// Blocks without much progress; a standstill counts four times.
    idle: u32,
}

impl Mechanism for Gathering<'_> {
    fn begin_round(&mut self, d: &mut Descent<'_>, watch: &mut dyn Watch) -> Result<Verdict, ClothError> {
        self.before = d.objective().widest_stitch(&d.x);
        watch.done(GATHERING_WORK * ((self.first - self.before) / self.first.max(1e-12)).max(0.0));
        if self.before < self.threads.contact_distance {
            // The seams are nearly closed: the distance to the body shrinks with the gaps.
            self.threads.set_contact_distance(d, self.before.max(0.5 * self.threads.contact_distance));
        }
        if self.before <= GATHERED_GAP.get() * self.edge {
            return Ok(Verdict::Stop(StopReason::Settled));
        }
        d.report_progress(watch, &format!("widest seam {:.1} mm open", self.before * 1e3))?;
        Ok(Verdict::Go)
    }

    fn after_block(&mut self, d: &mut Descent<'_>, b: &Block) -> Verdict {
        if d.objective().widest_stitch(&d.x) <= SEWING_GAP_PROGRESS.get() * self.before {
            return Verdict::Go;
        }
        self.press_on(d, b);
        // The full force holds the gap open. The threads are drawn tight, and welding closes what stays open.
        if self.idle <= GATHERING_IDLE_MOST.get() { Verdict::Go } else { Verdict::Stop(StopReason::SeamsOpen) }
    }
}

impl Gathering<'_> {
    /// The gaps no longer shrink by themselves: pulls harder, lets the cloth nearer to the body, or counts the block as idle.
    fn press_on(&mut self, d: &mut Descent<'_>, b: &Block) {
        let (force_most, threads) = (SEWING_FORCE_MOST.get(), &mut *self.threads);
        let may_come_nearer = threads.contact_distance > STAND_OFF_EDGES_LEAST.get() * self.edge;
        if threads.force < force_most
            && b.steps > SEWING_FORCE_BLOCK_STEPS.get()
            && b.mean > SEWING_FORCE_MEAN_PART.get()
        {
            threads.pull(d, SEWING_FORCE_FACTOR.get() * threads.force, self.reach);
            if threads.force >= STAND_OFF_CRAMPED_FORCE.get() && may_come_nearer {
                threads.set_contact_distance(d, STAND_OFF_FACTOR.get() * threads.contact_distance);
            }
        } else if threads.force >= force_most && self.before < STAND_OFF_NARROW_GAP.get() * self.edge && may_come_nearer
        {
            // In a narrow place the body itself may hold the gap open.
            threads.set_contact_distance(d, STAND_OFF_FACTOR.get() * threads.contact_distance);
        } else {
            // Short steps are no standstill yet; a block without a step is.
            self.idle += if b.steps == 0 || threads.force >= force_most { 4 } else { 1 };
        }
    }
}

/// Draws the threads tight while the cloth comes to its distance from the body.
fn close_tightly(
    d: &mut Descent<'_>,
    threads: &mut Threads,
    pinned: &mut PinnedTargets,
    watch: &mut dyn Watch,
) -> Result<(), ClothError> {
    let distance = d.settings.stitches.closed_distance;
    threads.pull(d, SEWING_FORCE_TIGHT.get(), distance);
    let last_step = d.steps + TIGHTENING_STEPS_MOST.get();
    let mut rule = Tightening { threads, last_step, widest: 0.0, last_energy: f64::INFINITY };
    drive_sewing(d, &mut rule, pinned, f64::INFINITY, watch)?;
    Ok(())
}

/// The rule of the tightening. The drape goes on from its end, so the cloth need not rest.
struct Tightening<'t> {
    threads: &'t mut Threads,
    /// Number of the step at which the tightening ends.
    last_step: u64,
    /// Widest gap before the block, m.
    widest: f64,
    /// Energy after the block before, J.
    last_energy: f64,
}

impl Mechanism for Tightening<'_> {
    fn begin_round(&mut self, d: &mut Descent<'_>, watch: &mut dyn Watch) -> Result<Verdict, ClothError> {
        if d.steps >= self.last_step {
            return Ok(Verdict::Stop(StopReason::MaxSteps));
        }
        self.widest = d.objective().widest_stitch(&d.x);
        let done = 1.0 - (self.last_step - d.steps) as f64 / TIGHTENING_STEPS_MOST.get() as f64;
        watch.done(GATHERING_WORK + (1.0 - GATHERING_WORK) * done);
        d.report_progress(watch, &format!("widest seam {:.3} mm open", self.widest * 1e3))?;
        Ok(Verdict::Go)
    }

    fn after_block(&mut self, d: &mut Descent<'_>, b: &Block) -> Verdict {
        if self.threads.contact_distance > 0.0 {
            let next = 0.5 * self.threads.contact_distance;
            self.threads.set_contact_distance(d, if next <= self.threads.gap { 0.0 } else { next });
            self.last_energy = f64::INFINITY;
            return Verdict::Go;
        }
        let gain = self.last_energy - d.energy;
        self.last_energy = d.energy;
        let elastic = d.objective().elastic(&d.x);
        let widest = d.objective().widest_stitch(&d.x);
        let closed = widest <= CLOSED_GAP.get() * d.settings.stitches.closed_distance;
        // A few stitches of tight cloth hold out against any force. Such seams are welded all the same.
        let in_vain =
            widest > TIGHTENING_GAP_PROGRESS.get() * self.widest && gain <= TIGHTENING_ENERGY_SHARE.get() * elastic;
        let sewn = closed && gain <= SEWN_ENERGY_SHARE.get() * elastic;
        if sewn || in_vain || b.steps == 0 && gain <= 0.0 { Verdict::Stop(StopReason::Settled) } else { Verdict::Go }
    }
}

/// Puts the members of closed stitches on one point, where nothing crosses then.
fn join_closed_stitches(d: &mut Descent<'_>, scene: &Scene) {
    let gap_most = CLOSED_GAP.get() * d.settings.stitches.closed_distance;
    let faces: Vec<[u32; 3]> = scene.triangles.iter().map(|t| t.vertices).collect();
    let barrier = d.objective().terms.barrier.as_ref();
    let near = Obstacles {
        faces: &faces,
        has_self_contact: barrier.is_some_and(|b| b.parameters.has_self_contact),
        body: barrier.and_then(|b| b.body.as_ref()),
    };
    d.x = join(&d.x, &scene.stitches, gap_most, &near).x;
}
