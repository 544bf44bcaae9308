//! The loop of sewing and draping by the paper's scheme: explicit steps until the cloth rests (§1.3.2 and §2).

use crate::explicit::central_difference;
use crate::explicit::central_difference::State;
use crate::explicit::problem::Problem;
use crate::explicit::report;
use crate::explicit::rest::RestTest;
use crate::explicit::tuning::{
    BALANCE_GAIN, BALANCE_GIVE_UP, BALANCED_RESIDUAL, DAMPING_GROWTH, DAMPING_RAISE, DAMPING_RATE_MAX,
    ENERGY_CHECK_STEPS, ENERGY_GROWTH_FLOOR, ENERGY_GROWTH_SHARE, OPEN_SEAM_SPEED_SHARE, REST_WINDOWS, STEP_HALVING,
    STEP_HALVINGS_MAX, TREMBLING_SPEED, VELOCITY_REDUCTION, VELOCITY_REDUCTION_ROUNDS, VELOCITY_REDUCTION_SHARE,
};
use crate::scene::measures;
use crate::{ClothError, Outcome, Scene, Settings, StopReason, Watch};

/// Energy checks between two reports of progress.
const CHECKS_OF_PROGRESS: u64 = 16;

/// Sews the cloth (`pulls`) or settles it, from the scene's positions.
///
/// # Errors
/// An unusable scene or setting, a start that crosses, instability, or a stop on request.
pub(crate) fn run(
    scene: &Scene,
    settings: &Settings,
    pulls: bool,
    watch: &mut dyn Watch,
) -> Result<Outcome, ClothError> {
    let mut problem = Problem::new(scene, settings, pulls)?;
    let gravity = scene.gravity.norm() * settings.gravity_scale;
    let mut run = Run::new(&mut problem, settings, gravity, scene.triangles.len());
    let reason = run.advance_to_stop(watch)?;
    if reason == StopReason::Settled && !pulls && VELOCITY_REDUCTION.is_on() {
        run.reduce_velocity(watch)?;
    }
    Ok(run.outcome(scene, reason))
}

/// The adaptive time step, and the time so far.
struct Clock {
    /// Length of a step, s.
    step: f64,
    /// Halvings of the step so far.
    halvings: u32,
    /// Steps so far.
    steps: u64,
    /// Simulated time so far, s.
    seconds: f64,
}

/// The last state whose energy was sound, with that energy, J.
struct SoundState {
    state: State,
    energy: f64,
}

struct Run<'a> {
    problem: &'a mut Problem,
    settings: &'a Settings,
    triangles: usize,
    /// Gravity, m/s².
    gravity: f64,
    state: State,
    sound: SoundState,
    clock: Clock,
    rest: RestTest,
}

impl<'a> Run<'a> {
    fn new(problem: &'a mut Problem, settings: &'a Settings, gravity: f64, triangles: usize) -> Self {
        let state = State::at_rest(problem.start.clone());
        let rest = RestTest::new(&state.x, problem.elastic(&state.x));
        let energy = problem.potential(&state.x);
        let sound = SoundState { state: state.clone(), energy };
        let clock = Clock { step: 0.0, halvings: 0, steps: 0, seconds: 0.0 };
        let mut run = Self { problem, settings, triangles, gravity, state, sound, clock, rest };
        run.choose_step();
        run
    }

    /// Sets the adaptive step: a fraction of the stable one as the cloth stands, halved where energy grew.
    fn choose_step(&mut self) {
        let stable = self.problem.stable_step(&self.state.x);
        self.clock.step = self.settings.explicit.step_fraction * stable / f64::from(1u32 << self.clock.halvings);
    }

    /// Steps until a stop condition holds.
    fn advance_to_stop(&mut self, watch: &mut dyn Watch) -> Result<StopReason, ClothError> {
        let check_steps = ENERGY_CHECK_STEPS.get();
        loop {
            self.take_step();
            if self.clock.steps.is_multiple_of(check_steps) {
                if watch.cancelled() {
                    return Err(ClothError::Cancelled { step: self.clock.steps });
                }
                self.check_energy()?;
                if self.clock.steps.is_multiple_of(CHECKS_OF_PROGRESS * check_steps) {
                    self.show_progress(watch);
                }
            }
            if let Some(reason) = self.stop_reason() {
                return Ok(reason);
            }
        }
    }

    /// Takes one step and joins the pairs that came near.
    fn take_step(&mut self) {
        central_difference::step(self.problem, &mut self.state, self.clock.step);
        self.clock.steps += 1;
        self.clock.seconds += self.clock.step;
        if self.problem.sewing.pulls() {
            self.problem.sewing.time += self.clock.step;
            self.problem.sewing.join(&self.state.x);
        }
    }

    /// The reason to stop now, if there is one.
    fn stop_reason(&mut self) -> Option<StopReason> {
        if self.rest.is_due(self.clock.seconds) && self.is_at_rest() {
            let closed = !self.problem.sewing.pulls() || self.problem.sewing.is_closed(&self.state.x);
            return Some(if closed { StopReason::Settled } else { StopReason::SeamsOpen });
        }
        let sewing = &self.problem.sewing;
        if sewing.pulls() && sewing.is_hopeless() && !sewing.is_closed(&self.state.x) {
            return Some(StopReason::SeamsOpen);
        }
        if self.clock.steps >= self.settings.explicit.max_steps {
            return Some(StopReason::MaxSteps);
        }
        (self.clock.seconds >= self.settings.explicit.max_seconds).then_some(StopReason::MaxSeconds)
    }

    /// Takes nearly all motion out of every step until forces balance at every vertex, or gain no more.
    ///
    /// Cloth that rests in the mean may still tremble by micrometres from step to step, where friction and contact take
    /// turns.
    fn reduce_velocity(&mut self, watch: &mut dyn Watch) -> Result<(), ClothError> {
        let (gravity, balanced) = (self.gravity, BALANCED_RESIDUAL.get());
        let (gain, give_up) = (BALANCE_GAIN.get(), BALANCE_GIVE_UP.get());
        let share = VELOCITY_REDUCTION_SHARE.get();
        let mut best = f64::INFINITY;
        for _ in 0..VELOCITY_REDUCTION_ROUNDS.get() {
            let residual = report::balance(self.problem, &self.state.x, gravity, self.clock.step).residual_rel;
            if residual < balanced || residual > gain * best && best < give_up * balanced {
                break;
            }
            best = best.min(residual);
            for _ in 0..ENERGY_CHECK_STEPS.get() {
                central_difference::step(self.problem, &mut self.state, self.clock.step);
                self.state.v.iter_mut().for_each(|v| *v *= share);
            }
            self.clock.steps += ENERGY_CHECK_STEPS.get();
            if watch.cancelled() {
                return Err(ClothError::Cancelled { step: self.clock.steps });
            }
        }
        Ok(())
    }

    /// Shows progress in words, as a share of the whole, and as positions.
    fn show_progress(&self, watch: &mut dyn Watch) {
        let open = self.problem.sewing.open();
        let seams = if open > 0 { format!("{open} stitches open, ") } else { String::new() };
        let words = format!(
            "{seams}{:.2} s simulated, speed {:.1} mm/s (goal {:.1}), energy change {:.2e}",
            self.clock.seconds,
            self.rest.speed * 1e3,
            self.settings.explicit.speed_tolerance * 1e3,
            self.rest.change
        );
        watch.progress(self.clock.steps, &words);
        watch.done(self.clock.seconds / self.settings.explicit.max_seconds);
        watch.look(&self.state.x, self.triangles);
    }

    /// Halves the step and goes back to the last sound state when the numbers or the energy run away.
    fn check_energy(&mut self) -> Result<(), ClothError> {
        let kinetic = self.problem.kinetic(&self.state.v);
        let elastic = self.problem.elastic(&self.state.x);
        let total = kinetic + self.problem.potential(&self.state.x);
        let finite = total.is_finite() && self.state.is_in_range();
        if finite && !(self.has_grown(total, kinetic + elastic) && STEP_HALVING.is_on()) {
            self.sound.energy = total;
            self.sound.state.copy_motion(&self.state);
            self.choose_step();
            return Ok(());
        }
        if self.clock.halvings >= STEP_HALVINGS_MAX.get() {
            if finite {
                // The step is a thousandth of the stable one, so the growth is no instability.
                self.sound.energy = total;
                return Ok(());
            }
            let what = "the forces stayed beyond numbers although the step was halved 10 times".into();
            return Err(ClothError::Unstable { step: self.clock.steps, what });
        }
        self.clock.halvings += 1;
        self.state.copy_motion(&self.sound.state);
        if let Some(c) = &mut self.problem.contact {
            c.measure(&self.state.x, 0.0);
        }
        self.sound.energy = f64::INFINITY;
        self.choose_step();
        Ok(())
    }

    /// Returns `true` if the total energy grew by more than motion explains; `stored` is kinetic and elastic energy, J.
    ///
    /// Sewing forces and held vertices on their way do work, so growth then proves nothing.
    fn has_grown(&self, total: f64, stored: f64) -> bool {
        let closed = !self.problem.sewing.is_pulling() && self.problem.are_pins_placed(&self.sound.state.x);
        closed && total > self.sound.energy + ENERGY_GROWTH_SHARE.get() * stored + ENERGY_GROWTH_FLOOR.get()
    }

    /// Returns `true` if nothing has moved for a few windows. The paper's energy rule and the speed must agree.
    fn is_at_rest(&mut self) -> bool {
        self.rest.measure(self.problem, &self.state.x, self.clock.seconds);
        let (speed, tolerance) = (self.rest.speed, self.settings.explicit.speed_tolerance);
        let energy_rests = self.rest.change <= self.settings.explicit.energy_tolerance;
        // Open seams are given up only when hardly anything moves.
        let sewing = &self.problem.sewing;
        let pulling = sewing.pulls() && !sewing.is_closed(&self.state.x);
        let most = if pulling { OPEN_SEAM_SPEED_SHARE.get() } else { 1.0 } * tolerance;
        let quiet = energy_rests
            && speed <= most
            && (!pulling || sewing.is_fully_grown())
            && self.problem.are_pins_placed(&self.state.x);
        self.rest.quiet_windows = if quiet { self.rest.quiet_windows + 1 } else { 0 };
        let is_oscillating = speed <= TREMBLING_SPEED.get() * tolerance;
        if !quiet && !pulling && is_oscillating && energy_rests && DAMPING_RAISE.is_on() {
            // Single vertices still tremble at a contact. Damping does not move the rest shape.
            let rate = &mut self.problem.damping.rate;
            *rate = (*rate * DAMPING_GROWTH.get()).min(DAMPING_RATE_MAX.get());
        }
        self.rest.quiet_windows >= REST_WINDOWS.get()
    }

    /// The outcome of the run.
    fn outcome(self, scene: &Scene, stop_reason: StopReason) -> Outcome {
        let gaps = measures::gaps(scene, &self.state.x);
        let energy = self.problem.elastic(&self.state.x);
        let balance = report::balance(self.problem, &self.state.x, self.gravity, self.clock.step);
        Outcome {
            steps: self.clock.steps,
            seconds: self.clock.seconds,
            settled: stop_reason == StopReason::Settled,
            stop_reason,
            energy,
            speed_max: self.rest.speed,
            residual_rel: balance.residual_rel,
            seam_gap_max: gaps.first().map_or(0.0, |g| g.1),
            open_stitches: measures::open_stitches(gaps, self.settings.stitches.closed_distance),
            effects: report::effects(self.problem, scene, self.settings),
            reactions: balance.reactions,
            repaired: self.problem.repaired,
            joined: 0,
            positions: self.state.x,
        }
    }
}
