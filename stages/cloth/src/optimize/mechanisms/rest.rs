//! Stopping: the convergence test by the Newton step, and the limits at which a descent is given up.

use crate::optimize::descent::Descent;
use crate::optimize::mechanism::{Block, Mechanism, StepVerdict, Verdict};
use crate::optimize::objective::PIN_PLACED;
use crate::optimize::strain_limit_phase::StrainLimitPhase;
use crate::optimize::tuning::{
    BLOCK_END_PART, FALL_DISTANCE_SIZES, NEARLY_AT_REST_RESIDUAL, PIN_WAY_PART, STUCK_BLOCKS_MOST,
};
use crate::report::watch::Watch;
use crate::{ClothError, StopReason, Vec3};

impl Descent<'_> {
    /// Is the cloth at rest by the last measured Newton step? It gains and moves no more than the tolerances, net forces and
    /// slides are small, held vertices are at their places, and no regularisation acts.
    pub fn rests(&self) -> bool {
        let s = self.settings;
        self.regularization.is_free()
            && self.newton.decrement <= s.equilibrium.decrement_tolerance
            && self.newton.longest <= s.equilibrium.move_tolerance
            && self.newton.residual <= s.equilibrium.residual_tolerance
            && self.objective().largest_slide() <= s.equilibrium.move_tolerance
            && self.pins_placed()
    }

    /// Is the cloth nearly at rest by the Newton step of the last round, even if that step was regularised?
    pub fn nearly_rests(&self) -> bool {
        let s = self.settings;
        self.newton.decrement < s.equilibrium.decrement_tolerance
            && self.newton.residual < NEARLY_AT_REST_RESIDUAL.get() * s.equilibrium.residual_tolerance
    }
}

/// Measures the Newton step with the preconditioner of the round.
pub(crate) struct MeasureNewtonStep;

impl Mechanism for MeasureNewtonStep {
    fn before_block(&mut self, d: &mut Descent<'_>, _: &mut dyn Watch) -> Result<Verdict, ClothError> {
        d.measure_newton_step();
        Ok(Verdict::Go)
    }
}

/// Tests whether the cloth is at rest.
pub(crate) struct ConvergenceTest;

impl Mechanism for ConvergenceTest {
    fn before_block(&mut self, d: &mut Descent<'_>, _: &mut dyn Watch) -> Result<Verdict, ClothError> {
        let widened = matches!(d.strain_limits, StrainLimitPhase::Wide(_));
        Ok(if !widened && d.rests() { Verdict::AtRest } else { Verdict::Go })
    }
}

/// Ends a block whose steps are too short for its preconditioner, or whose net forces are as small as the goal. A shorter
/// step than a full one still improves the history.
pub(crate) struct BlockEnd;

impl Mechanism for BlockEnd {
    fn after_step(&mut self, d: &mut Descent<'_>, taken: Option<f64>) -> StepVerdict {
        let short = taken.is_some_and(|part| part < BLOCK_END_PART.get());
        let goal = d.settings.equilibrium.residual_tolerance;
        if short || goal.is_finite() && d.net_force() <= goal { StepVerdict::EndBlock } else { StepVerdict::Go }
    }
}

/// Gives cloth up that has fallen out of the scene.
#[derive(Default)]
pub(crate) struct FallLimit {
    start: Vec<Vec3>,
    farthest: f64,
}

impl Mechanism for FallLimit {
    fn begin(&mut self, d: &mut Descent<'_>) {
        self.start = d.x.clone();
        self.farthest = FALL_DISTANCE_SIZES.get() * d.objective().size(&self.start);
    }

    fn before_block(&mut self, d: &mut Descent<'_>, _: &mut dyn Watch) -> Result<Verdict, ClothError> {
        let limit = self.farthest * self.farthest;
        let fell = self.start.iter().zip(&d.x).any(|(p, q)| (p - q).norm_squared() > limit);
        Ok(if fell { Verdict::Stop(StopReason::Unheld) } else { Verdict::Go })
    }
}

/// Ends a descent after the most steps of the settings. Held vertices that are led to their places take their time:
/// the steps count anew whenever a part of their way is done.
#[derive(Debug)]
pub(crate) struct StepLimit {
    /// The longest way that was left when the steps began to count, m.
    way_left: f64,
    /// Steps until then.
    since: u64,
}

impl Default for StepLimit {
    fn default() -> Self {
        Self { way_left: f64::INFINITY, since: 0 }
    }
}

impl Mechanism for StepLimit {
    fn begin(&mut self, d: &mut Descent<'_>) {
        self.way_left = d.objective().way_of_pins(&d.x);
    }

    fn before_block(&mut self, d: &mut Descent<'_>, _: &mut dyn Watch) -> Result<Verdict, ClothError> {
        let left = d.objective().way_of_pins(&d.x);
        if self.way_left > PIN_PLACED && left < (1.0 - PIN_WAY_PART.get()) * self.way_left {
            (self.way_left, self.since) = (left, d.steps);
        }
        let over = d.steps >= self.since + d.settings.equilibrium.max_descents;
        Ok(if over { Verdict::Stop(StopReason::MaxSteps) } else { Verdict::Go })
    }
}

/// Ends a descent after many blocks in a row that took no step.
pub(crate) struct StagnationLimit;

impl Mechanism for StagnationLimit {
    fn after_block(&mut self, d: &mut Descent<'_>, _: &Block) -> Verdict {
        if d.stuck_blocks <= STUCK_BLOCKS_MOST.get() {
            return Verdict::Go;
        }
        Verdict::Stop(if d.pins_placed() { StopReason::MaxSteps } else { StopReason::HeldBack })
    }
}

/// Reports how far a descent to rest has come, and ends it on request.
#[derive(Debug, Default)]
pub(crate) struct RestProgress {
    first: f64,
    part: f64,
}

impl RestProgress {
    /// The part of the way that is done: by the digits of what must become small. It never shrinks.
    fn part(&mut self, to_go: f64) -> f64 {
        self.first = self.first.max(to_go);
        let digits = if self.first > 1.0 { 1.0 - libm::log(to_go) / libm::log(self.first) } else { 1.0 };
        self.part = self.part.max(digits.clamp(0.0, 1.0));
        self.part
    }
}

impl Mechanism for RestProgress {
    fn before_block(&mut self, d: &mut Descent<'_>, watch: &mut dyn Watch) -> Result<Verdict, ClothError> {
        d.report_progress(watch, &words(d))?;
        watch.done(self.part(to_go(d)));
        Ok(Verdict::Go)
    }
}

/// The largest ratio of a quantity that must be small at rest to its tolerance, at least 1.
fn to_go(d: &Descent<'_>) -> f64 {
    let (n, s) = (&d.newton, d.settings);
    let ratios = [
        n.decrement / s.equilibrium.decrement_tolerance,
        n.longest / s.equilibrium.move_tolerance,
        n.residual / s.equilibrium.residual_tolerance,
    ];
    ratios.into_iter().fold(1.0, f64::max)
}

fn words(d: &Descent<'_>) -> String {
    format!(
        "energy {:.4e} J, a Newton step would win {:.1e} of the elastic energy (goal {:.0e}) and move {:.3} mm (goal {:.1})",
        d.energy,
        d.newton.decrement,
        d.settings.equilibrium.decrement_tolerance,
        d.newton.longest * 1e3,
        d.settings.equilibrium.move_tolerance * 1e3
    )
}
