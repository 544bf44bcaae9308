//! Draping: the mechanisms of a descent to rest, and coarser levels that find the way first.

use crate::contact::lagged_friction::LaggedFriction;
use crate::hierarchy::Level;
use crate::optimize::descent::{Change, Descent};
use crate::optimize::driver::{Blocks, Detection, drive};
use crate::optimize::mechanism::Mechanism;
use crate::optimize::mechanisms::contact_refresh::{AdaptiveStiffness, LaggedForces};
use crate::optimize::mechanisms::factor_reuse::FactorReuse;
use crate::optimize::mechanisms::gap_update::GapUpdate;
use crate::optimize::mechanisms::negative_curvature::NegativeCurvature;
use crate::optimize::mechanisms::pinned_targets::PinnedTargets;
use crate::optimize::mechanisms::regularization_schedule::RegularizationSchedule;
use crate::optimize::mechanisms::rest::{
    BlockEnd, ConvergenceTest, FallLimit, MeasureNewtonStep, RestProgress, StagnationLimit, StepLimit,
};
use crate::optimize::mechanisms::strain_limit_homotopy::{SlowStrainLimits, StrainLimitHomotopy};
use crate::optimize::mechanisms::surrogate_hessian::SurrogateHessian;
use crate::optimize::report;
use crate::optimize::task::Task;
use crate::optimize::tuning::{
    BLOCK_STEPS, BLOCK_STEPS_COARSE, COARSE_FIRST_DECREMENT, COARSE_LEVELS, COARSE_TOLERANCE_FACTOR,
    COARSE_TOLERANCE_FACTOR_LARGE, CONTACT_WARM_START, GAP_UPDATE, LARGE_CLOTH_VERTICES, LOADS_BALANCE_DECREMENT,
    NEGATIVE_CURVATURE, STRAIN_LIMIT_HOMOTOPY, SURROGATE_HESSIAN,
};
use crate::report::watch::Part;
use crate::{ClothError, EffectReport, Outcome, Scene, Settings, StopReason, Vec3, Watch};

/// Part of all work that coarser levels take, for the progress display.
const COARSE_WORK: f64 = 0.2;

/// Settles the cloth.
///
/// # Errors
/// An unusable scene or setting, a start that crosses, instability, or a stop on request.
pub(crate) fn drape(scene: &Scene, settings: &Settings, watch: &mut dyn Watch) -> Result<Outcome, ClothError> {
    drape_level(scene, settings, Task::Settle, watch)
}

/// Settles one level, after the coarser one below it where that is to find the way first.
fn drape_level(scene: &Scene, settings: &Settings, task: Task, watch: &mut dyn Watch) -> Result<Outcome, ClothError> {
    let (mut before, mut done) = (Vec::new(), 0.0);
    let mut begun = None;
    if let Some(level) = level_to_drape_first(scene, settings, task, &mut begun)? {
        // The factor of this level is larger than those of all coarser ones.
        drop(begun.take());
        if let Some((x, effects)) = rest_of_coarser_level(&level, settings, task, watch)? {
            (before, done) = (effects, COARSE_WORK);
            drop(level);
            begun = begin_at(scene, x, settings, task)?;
        }
    }
    let mut descent = match begun {
        Some(descent) => descent,
        None => begin(scene, settings, task)?,
    };
    let reason = settle(&mut descent, task, &mut Part::new(watch, [done, 1.0], &<[Vec3]>::to_vec))?;
    let mut outcome = report::outcome(&mut descent, scene, reason);
    outcome.add_costs(&before);
    Ok(outcome)
}

/// The coarser level that is to find the way first. Where only a factorisation can tell, `begun` keeps the descent that was
/// begun for it.
fn level_to_drape_first<'a>(
    scene: &Scene,
    settings: &'a Settings,
    task: Task,
    begun: &mut Option<Descent<'a>>,
) -> Result<Option<Level>, ClothError> {
    if !COARSE_LEVELS.is_on() || !Level::may_be_below_folds(scene) {
        return Ok(None);
    }
    let far = COARSE_FIRST_DECREMENT.get();
    let is_far =
        surely_far(scene, settings, task)? || begun.insert(begin(scene, settings, task)?).newton.decrement > far;
    Ok(is_far.then(|| Level::below_folds(scene)).flatten())
}

/// Does large cloth begin so far from rest that no factorisation is needed to tell?
fn surely_far(scene: &Scene, settings: &Settings, task: Task) -> Result<bool, ClothError> {
    let mut descent = Descent::begin(scene, settings, task)?;
    descent.warm_start_contacts();
    descent.refresh_contacts();
    Ok(descent.surely_gains(COARSE_FIRST_DECREMENT.get()))
}

/// Begins at the scene's positions and measures how far they are from rest.
fn begin<'a>(scene: &Scene, settings: &'a Settings, task: Task) -> Result<Descent<'a>, ClothError> {
    let mut descent = Descent::begin(scene, settings, task)?;
    let loaded = descent.warm_start_contacts();
    if descent.is_far_from_rest() && loaded {
        descent.drop_warm_start();
    }
    Ok(descent)
}

/// Begins at the rest of a coarser level; `None` where the cloth would cross something there.
fn begin_at<'a>(
    scene: &Scene,
    positions: Vec<Vec3>,
    settings: &'a Settings,
    task: Task,
) -> Result<Option<Descent<'a>>, ClothError> {
    match Descent::begin(&Scene { positions, ..scene.clone() }, settings, task) {
        Ok(descent) => Ok(Some(descent)),
        Err(ClothError::StartCrosses { .. }) => Ok(None),
        Err(e) => Err(e),
    }
}

/// Positions, and the costs of the effects on the way there.
type CoarseRest = (Vec<Vec3>, Vec<EffectReport>);

/// The place where a coarser level comes to lie, if it does not fall off.
fn rest_of_coarser_level(
    level: &Level,
    settings: &Settings,
    finer: Task,
    watch: &mut dyn Watch,
) -> Result<Option<CoarseRest>, ClothError> {
    let factor = coarse_tolerance_factor(level.scene.positions.len(), finer);
    let mut coarse = settings.clone();
    coarse.equilibrium.decrement_tolerance *= factor;
    coarse.equilibrium.move_tolerance *= factor;
    coarse.equilibrium.residual_tolerance = f64::INFINITY;
    let spread = |x: &[Vec3]| level.spread(x);
    match drape_level(&level.scene, &coarse, Task::SettleCoarse, &mut Part::new(watch, [0.0, COARSE_WORK], &spread)) {
        Ok(rest) if matches!(rest.stop_reason, StopReason::Settled | StopReason::MaxSteps) => {
            let x = level.spread(&rest.positions);
            watch.look(&x, level.scene.triangles.len());
            Ok(Some((x, rest.effects)))
        }
        Ok(_) | Err(ClothError::StartCrosses { .. } | ClothError::Unstable { .. }) => Ok(None),
        Err(e) => Err(e),
    }
}

/// Tolerances of a coarser level with this many vertices over those of the finer one.
fn coarse_tolerance_factor(vertices: usize, finer: Task) -> f64 {
    match (vertices > LARGE_CLOTH_VERTICES.get(), finer == Task::SettleCoarse) {
        (true, true) => 1.0,
        (true, false) => COARSE_TOLERANCE_FACTOR_LARGE.get(),
        (false, _) => COARSE_TOLERANCE_FACTOR.get(),
    }
}

/// Descends until at rest.
///
/// # Errors
/// Instability, or a stop on request.
pub(crate) fn settle(d: &mut Descent<'_>, task: Task, watch: &mut dyn Watch) -> Result<StopReason, ClothError> {
    let (mut pinned, mut progress) = (PinnedTargets::settling(), RestProgress::default());
    loop {
        let reason = settle_unchecked(d, task, &mut pinned, &mut progress, watch)?;
        if d.check_or_roll_back() {
            return Ok(reason);
        }
    }
}

/// Descends until at rest; the last blocks may be ahead of collision detection.
fn settle_unchecked(
    d: &mut Descent<'_>,
    task: Task,
    pinned: &mut PinnedTargets,
    progress: &mut RestProgress,
    watch: &mut dyn Watch,
) -> Result<StopReason, ClothError> {
    let coarse = task == Task::SettleCoarse;
    let steps = if coarse { BLOCK_STEPS_COARSE.get() } else { BLOCK_STEPS.get() };
    let mut homotopy = StrainLimitHomotopy { ends_on: !coarse };
    let mut gap_update = GapUpdate::default();
    let mut curvature = NegativeCurvature::default();
    let mut fall = FallLimit::default();
    let mut regularization = RegularizationSchedule::unlimited();
    let mut adaptive_stiffness = AdaptiveStiffness;
    let mut lagged_forces = LaggedForces;
    let mut measure_newton_step = MeasureNewtonStep;
    let mut surrogate_hessian = SurrogateHessian;
    let mut factor_reuse = FactorReuse;
    let mut convergence_test = ConvergenceTest;
    let mut step_limit = StepLimit::default();
    let mut slow_strain_limits = SlowStrainLimits;
    let mut stagnation_limit = StagnationLimit;
    let mut block_end = BlockEnd;
    let all: [(bool, &mut dyn Mechanism); 17] = [
        (true, pinned),
        (true, &mut adaptive_stiffness),
        (true, &mut lagged_forces),
        (true, &mut measure_newton_step),
        (SURROGATE_HESSIAN.is_on(), &mut surrogate_hessian),
        (STRAIN_LIMIT_HOMOTOPY.is_on(), &mut homotopy),
        (GAP_UPDATE.is_on() && !coarse, &mut gap_update),
        (true, &mut factor_reuse),
        (NEGATIVE_CURVATURE.is_on(), &mut curvature),
        (true, &mut convergence_test),
        (true, &mut regularization),
        (true, progress),
        (true, &mut fall),
        (true, &mut step_limit),
        (STRAIN_LIMIT_HOMOTOPY.is_on(), &mut slow_strain_limits),
        (true, &mut stagnation_limit),
        (true, &mut block_end),
    ];
    let mut mechanisms: Vec<&mut dyn Mechanism> = all.into_iter().filter(|(on, _)| *on).map(|(_, m)| m).collect();
    let blocks = Blocks { steps: d.block_steps(steps), detection: Detection::SeveralBlocks };
    drive(d, blocks, &mut mechanisms, watch)
}

impl Descent<'_> {
    /// Would a Newton step gain more than all elastic energy?
    pub fn is_far_from_rest(&mut self) -> bool {
        if self.check_energy().is_err() {
            return true;
        }
        self.refresh_contacts();
        if self.precondition().is_err() {
            return true;
        }
        self.measure_newton_step();
        self.newton.decrement > LOADS_BALANCE_DECREMENT.get()
    }

    /// Gives cloth that lies on the body at the start the contact load that holds it in balance; says whether any has one.
    pub fn warm_start_contacts(&mut self) -> bool {
        let forces = self.f.clone();
        let warm = CONTACT_WARM_START.is_on()
            && self.change(|o, x| {
                let index = &o.unknowns.index;
                let has_friction = o.terms.friction.is_some();
                let barrier = o.terms.barrier.as_mut().filter(|_| has_friction);
                Change::energy_if(barrier.is_some_and(|b| b.warm_start_loads(x, &forces, index)))
            });
        if !warm {
            return false;
        }
        self.change(|o, x| {
            let forces = o.forces().to_vec();
            if let (Some(friction), Some(b)) = (&mut o.terms.friction, &o.terms.barrier) {
                friction.refresh(x, &b.contacts, b.parameters.stiffness);
                friction.balance(forces, &o.unknowns.index);
            }
            Change::Energy
        });
        true
    }

    /// Takes those loads back: the cloth did not begin in balance.
    pub fn drop_warm_start(&mut self) {
        self.change(|o, x| {
            if let Some(b) = &mut o.terms.barrier {
                b.undo_warm_start(x);
            }
            o.terms.friction.iter_mut().for_each(|s| *s = LaggedFriction::default());
            Change::Energy
        });
    }
}
