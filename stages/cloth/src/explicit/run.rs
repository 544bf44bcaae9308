//! The loop of sewing and draping by the paper's scheme: explicit steps until the cloth rests.

use crate::explicit::central_difference;
use crate::explicit::central_difference::State;
use crate::explicit::problem::Problem;
use crate::explicit::report;
use crate::scene::measures;
use crate::{ClothError, Outcome, Scene, Settings, StopReason, Vec3, Watch};

/// Steps between two looks at the energy.
const CHECK: u64 = 64;
/// Time between two looks at the rest, s (a film frame).
const WINDOW: f64 = 1.0 / 24.0;
/// Quiet windows in a row that count as rest.
const QUIET: u32 = 3;
const MOST_HALVINGS: u32 = 10;
/// Most rounds of quietening, each of [`CHECK`] steps.
const QUIETENINGS: u32 = 40;
/// Share of the velocity that is left after a quietened step.
const QUIET_SHARE: f64 = 0.5;
/// Net force over mean weight at which a vertex counts as balanced.
const BALANCED: f64 = 0.02;
/// Growth of the damping in every window whose energy rests while vertices still move …
const CALMING: f64 = 1.15;
/// … no faster than this many times the tolerance (what falls or swings is no trembling) …
const TREMBLING: f64 = 10.0;
/// … up to this, 1/s: slow enough to see real motion as motion.
const MOST_DAMPING: f64 = 100.0;

/// Sews (`pulls`) or settles the cloth from the scene's positions.
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
    let reason = run.go(watch)?;
    if reason == StopReason::Settled && !pulls {
        run.quieten(watch)?;
    }
    Ok(run.outcome(scene, reason))
}

struct Run<'a> {
    problem: &'a mut Problem,
    triangles: usize,
    settings: &'a Settings,
    state: State,
    /// The last state whose energy was sound.
    sound: State,
    sound_energy: f64,
    dt: f64,
    halvings: u32,
    steps: u64,
    seconds: f64,
    /// Positions and elastic energy at the start of the window.
    window: (Vec<Vec3>, f64, f64),
    quiet: u32,
    /// Largest elastic energy so far, J.
    peak: f64,
    speed: f64,
    change: f64,
    /// m/s².
    gravity: f64,
}

impl<'a> Run<'a> {
    fn new(problem: &'a mut Problem, settings: &'a Settings, gravity: f64, triangles: usize) -> Self {
        let state = State::at_rest(problem.start.clone());
        let elastic = problem.elastic(&state.x);
        let sound_energy = problem.potential(&state.x);
        let window = (state.x.clone(), elastic, 0.0);
        let mut run = Self {
            sound: state.clone(),
            state,
            problem,
            triangles,
            settings,
            sound_energy,
            dt: 0.0,
            halvings: 0,
            steps: 0,
            seconds: 0.0,
            window,
            quiet: 0,
            peak: elastic,
            speed: 0.0,
            change: 0.0,
            gravity,
        };
        run.choose_step();
        run
    }

    /// The adaptive step: a fraction of the stable one as the cloth stands, halved where energy grew.
    fn choose_step(&mut self) {
        let stable = self.problem.stable_step(&self.state.x);
        self.dt = self.settings.step_fraction * stable / f64::from(1u32 << self.halvings);
    }

    fn go(&mut self, watch: &mut dyn Watch) -> Result<StopReason, ClothError> {
        loop {
            central_difference::step(self.problem, &mut self.state, self.dt);
            self.steps += 1;
            self.seconds += self.dt;
            if self.problem.sewing.pulls() {
                self.problem.sewing.time += self.dt;
                self.problem.sewing.join(&self.state.x);
            }
            if self.steps.is_multiple_of(CHECK) {
                if watch.cancelled() {
                    return Err(ClothError::Cancelled { step: self.steps });
                }
                self.check_energy()?;
                if self.steps.is_multiple_of(16 * CHECK) {
                    watch.progress(self.steps, &self.words());
                    watch.done(self.seconds / self.settings.max_seconds);
                    watch.look(&self.state.x, self.triangles);
                }
            }
            if self.seconds - self.window.2 >= WINDOW && self.look_for_rest() {
                let closed = !self.problem.sewing.pulls() || self.problem.sewing.closed(&self.state.x);
                return Ok(if !closed { StopReason::SeamsOpen } else { StopReason::Settled });
            }
            let sewing = &self.problem.sewing;
            if sewing.pulls() && sewing.hopeless() && !sewing.closed(&self.state.x) {
                return Ok(StopReason::SeamsOpen);
            }
            if self.steps >= self.settings.max_steps {
                return Ok(StopReason::MaxSteps);
            }
            if self.seconds >= self.settings.max_seconds {
                return Ok(StopReason::MaxSeconds);
            }
        }
    }

    /// What rests in the mean may still tremble by micrometres, from step to step, where friction and contact take
    /// turns. Nearly all motion is taken out of every step until forces balance at every vertex, or gain no more.
    fn quieten(&mut self, watch: &mut dyn Watch) -> Result<(), ClothError> {
        let gravity = self.gravity;
        let mut best = f64::INFINITY;
        for _ in 0..QUIETENINGS {
            let residual = report::balance(self.problem, &self.state.x, gravity, self.dt).residual_rel;
            if residual < BALANCED || residual > 0.9 * best && best < 10.0 * BALANCED {
                break;
            }
            best = best.min(residual);
            for _ in 0..CHECK {
                central_difference::step(self.problem, &mut self.state, self.dt);
                self.state.v.iter_mut().for_each(|v| *v *= QUIET_SHARE);
            }
            self.steps += CHECK;
            if watch.cancelled() {
                return Err(ClothError::Cancelled { step: self.steps });
            }
        }
        Ok(())
    }

    fn words(&self) -> String {
        let open = self.problem.sewing.open();
        let seams = if open > 0 { format!("{open} stitches open, ") } else { String::new() };
        format!(
            "{seams}{:.2} s simulated, speed {:.1} mm/s (goal {:.1}), energy change {:.2e}",
            self.seconds,
            self.speed * 1e3,
            self.settings.speed_tolerance * 1e3,
            self.change
        )
    }

    /// Halves the step and goes back to the last sound state when the numbers or the energy run away.
    fn check_energy(&mut self) -> Result<(), ClothError> {
        let kinetic = self.problem.kinetic(&self.state.v);
        let elastic = self.problem.elastic(&self.state.x);
        let total = kinetic + self.problem.potential(&self.state.x);
        let finite = total.is_finite() && self.state.x.iter().all(|p| p.amax() < 1e6);
        // Sewing forces and led vertices do work, so growth then proves nothing.
        let closed = !self.problem.sewing.pulling() && self.problem.pins_placed(&self.sound.x);
        let grown = closed && total > self.sound_energy + 0.2 * (kinetic + elastic) + 1e-9;
        if finite && !grown {
            self.sound_energy = total;
            self.sound.copy_motion(&self.state);
            self.choose_step();
            return Ok(());
        }
        if self.halvings >= MOST_HALVINGS {
            if finite {
                // The step is a thousandth of the stable one: the growth is no instability.
                self.sound_energy = total;
                return Ok(());
            }
            let what = "the forces stayed beyond numbers although the step was halved 10 times".into();
            return Err(ClothError::Unstable { step: self.steps, what });
        }
        self.halvings += 1;
        self.state.copy_motion(&self.sound);
        if let Some(c) = &mut self.problem.contact {
            c.measure(&self.state.x, 0.0);
        }
        self.sound_energy = f64::INFINITY;
        self.choose_step();
        Ok(())
    }

    /// Has nothing moved for a few windows? Both the paper's energy rule and the speed must agree.
    fn look_for_rest(&mut self) -> bool {
        let span = self.seconds - self.window.2;
        let elastic = self.problem.elastic(&self.state.x);
        let free = |i: &usize| self.problem.free(*i);
        let moved = (0..self.state.x.len()).filter(free).map(|i| (self.state.x[i] - self.window.0[i]).norm());
        self.speed = moved.fold(0.0, f64::max) / span;
        // A flat piece at rest stores next to nothing; what it stored on the way gives the scale then.
        self.peak = self.peak.max(elastic);
        let scale = elastic.max(self.window.1).max(0.01 * self.peak);
        self.change = if scale > 0.0 { (elastic - self.window.1).abs() / scale } else { 0.0 };
        self.window.0.copy_from_slice(&self.state.x);
        self.window.1 = elastic;
        self.window.2 = self.seconds;
        // Open seams are given up only when hardly anything moves.
        let sewing = &self.problem.sewing;
        let pulling = sewing.pulls() && !sewing.closed(&self.state.x);
        let most = if pulling { 0.1 } else { 1.0 } * self.settings.speed_tolerance;
        let calm = self.change <= self.settings.energy_tolerance
            && self.speed <= most
            && (!pulling || sewing.strained())
            && self.problem.pins_placed(&self.state.x);
        self.quiet = if calm { self.quiet + 1 } else { 0 };
        let trembling = self.speed <= TREMBLING * self.settings.speed_tolerance;
        if !calm && !pulling && trembling && self.change <= self.settings.energy_tolerance {
            // The energy rests, single vertices still tremble at a contact: damping does not move the rest shape.
            self.problem.damping = (self.problem.damping * CALMING).min(MOST_DAMPING);
        }
        self.quiet >= QUIET
    }

    fn outcome(self, scene: &Scene, stop_reason: StopReason) -> Outcome {
        let gaps = measures::gaps(scene, &self.state.x);
        let energy = self.problem.elastic(&self.state.x);
        let gravity = self.gravity;
        let balance = report::balance(self.problem, &self.state.x, gravity, self.dt);
        Outcome {
            steps: self.steps,
            seconds: self.seconds,
            settled: stop_reason == StopReason::Settled,
            stop_reason,
            energy,
            speed_max: self.speed,
            residual_rel: balance.residual_rel,
            seam_gap_max: gaps.first().map_or(0.0, |g| g.1),
            open_stitches: gaps.into_iter().filter(|g| g.1 > self.settings.sewing_distance).take(20).collect(),
            effects: report::effects(self.problem, scene, self.settings),
            reactions: balance.reactions,
            repaired: self.problem.repaired,
            joined: 0,
            positions: self.state.x,
        }
    }
}
