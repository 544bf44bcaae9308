//! Motion in time by the paper's central differences (equations 8–14), for comparison with the implicit steps.
//!
//! Steps are as long as the cloth bears, as in the paper, and halved where the energy grows all the same. Steps whose
//! length is held fast end the run where they are too long. The body stands still.

use crate::dynamics::drag::viscous;
use crate::dynamics::motion::{Dynamics, Frame, Motion, Trip};
use crate::effects::effect;
use crate::explicit::central_difference;
use crate::explicit::central_difference::State;
use crate::explicit::problem::Problem;
use crate::explicit::report;
use crate::explicit::tuning::{
    ENERGY_GROWTH_FLOOR, ENERGY_GROWTH_SHARE, MOTION_STEP_FRACTION, STEP_HALVING, STEP_HALVINGS_MAX,
};
use crate::{ClothError, Scene, Settings, Vec3, Watch};

/// Moves the cloth by explicit steps, and hands every frame to `each`.
///
/// # Errors
/// An unusable scene, a body that moves, cloth that bears no step worth taking, steps held fast that are too long, or a
/// stop on request.
pub(crate) fn animate(
    scene: &Scene,
    settings: &Settings,
    dynamics: &Dynamics,
    motion: &Motion,
    watch: &mut dyn Watch,
    each: &mut dyn FnMut(&Frame<'_>),
) -> Result<Trip, ClothError> {
    if !motion.body.is_empty() {
        let what = "central differences know a body at rest only".into();
        return Err(ClothError::BadSetting { name: "integrator", what });
    }
    let mut run = MotionRun::new(scene, settings, dynamics, motion)?;
    run.show(0, each);
    for k in 1..motion.frames.max(1) {
        run.advance_to_frame(k, watch)?;
        run.show(k, each);
        if run.trip.settled && motion.until_settled {
            break;
        }
    }
    Ok(run.end(settings))
}

/// Checks that a step of `dt` seconds bears a contact stiffness, N/m.
///
/// The step must be shorter than 2/ω of the lightest vertex.
fn check_penalty_step(problem: &Problem, stiffness: f64, dt: f64) -> Result<(), ClothError> {
    let lightest = problem.masses.inverse.iter().fold(0.0_f64, |a, b| a.max(*b));
    let longest = 2.0 / (stiffness * lightest).sqrt();
    if dt < longest {
        return Ok(());
    }
    let what =
        format!("{stiffness} N/m at the lightest vertex bears steps below {longest:.3e} s, these are {dt:.3e} s");
    Err(ClothError::BadSetting { name: "contact_stiffness", what })
}

/// Shortest step that is worth taking, s. It is chosen: a second then takes ten million steps.
const STEP_MIN: f64 = 1e-7;

/// Number of equal steps from frame to frame: as set, or as many as the cloth bears.
fn steps_in_frame(dynamics: &Dynamics, frame: f64, stable: f64) -> Result<f64, ClothError> {
    let asked = dynamics.steps(frame);
    if dynamics.fixed {
        return Ok(asked);
    }
    let steps = asked.max((frame / (MOTION_STEP_FRACTION.get() * stable)).ceil());
    if frame / steps >= STEP_MIN {
        return Ok(steps);
    }
    let what = format!("this cloth bears steps of about {stable:.1e} s, too short for a motion");
    Err(ClothError::BadSetting { name: "integrator", what })
}

/// A motion in progress.
struct MotionRun<'a> {
    scene: &'a Scene,
    dynamics: &'a Dynamics,
    motion: &'a Motion,
    problem: Problem,
    /// Positions at a time, and velocities half a step before.
    state: State,
    /// Steps from frame to frame, a whole number.
    steps: f64,
    /// Length of a step, s.
    dt: f64,
    /// Estimate of the longest stable step at the start, s.
    stable: f64,
    /// Halvings of the step so far.
    halvings: u32,
    /// Frames in a row that were at rest.
    quiet_frames: usize,
    trip: Trip,
}

impl<'a> MotionRun<'a> {
    fn new(
        scene: &'a Scene,
        settings: &Settings,
        dynamics: &'a Dynamics,
        motion: &'a Motion,
    ) -> Result<Self, ClothError> {
        let frame = 1.0 / motion.fps;
        // Only the damping of the settings acts, and every vertex has the inertia of its mass.
        let damping = if dynamics.lagged { 0.0 } else { dynamics.damping };
        let mut plain = settings.clone();
        plain.explicit.damping = damping;
        plain.explicit.stiffness_damping = 0.0;
        plain.explicit.mass_scaling = false;
        let mut problem = Problem::new(scene, &plain, false)?;
        let stable = problem.stable_step(&problem.start.clone());
        let steps = steps_in_frame(dynamics, frame, stable)?;
        let dt = frame / steps;
        if problem.contact.is_some() {
            check_penalty_step(&problem, plain.explicit.contact_stiffness, dt)?;
        }
        if problem.contact.is_some() && dt < stable {
            // Contact becomes as stiff as this step bears.
            plain.explicit.step_fraction = dt / stable;
            problem = Problem::new(scene, &plain, false)?;
        }
        let state = State::at_rest(problem.start.clone());
        let mut run = Self {
            scene,
            dynamics,
            motion,
            problem,
            state,
            steps,
            dt,
            stable,
            halvings: 0,
            quiet_frames: 0,
            trip: Trip::default(),
        };
        run.set_velocities_half_a_step_back();
        Ok(run)
    }

    /// Takes the velocities back by half a step before the start.
    fn set_velocities_half_a_step_back(&mut self) {
        if !self.motion.velocities.is_empty() {
            self.state.v.copy_from_slice(&self.motion.velocities);
        }
        self.shift_velocities(-0.5 * self.dt);
    }

    /// Takes the velocities on by a time, s, as the forces of the present drive them.
    fn shift_velocities(&mut self, time: f64) {
        let mut force = vec![Vec3::zeros(); self.state.x.len()];
        self.problem.forces(&self.state.x, &mut force);
        for ((v, f), w) in self.state.v.iter_mut().zip(&force).zip(&self.problem.masses.inverse) {
            *v += f * (time * w);
        }
    }

    /// Steps from a frame to the next one, which has this number.
    fn advance_to_frame(&mut self, number: usize, watch: &mut dyn Watch) -> Result<(), ClothError> {
        let begun = self.state.clone();
        loop {
            let energy = self.energies();
            self.step_through_frame(watch)?;
            if !self.has_grown(energy) {
                break;
            }
            self.halve_step(&begun)?;
        }
        let (frames, fps) = (self.motion.frames, self.motion.fps);
        watch.progress(self.trip.steps, &format!("frame {number} of {frames}"));
        self.trip.speed = crate::farthest(&begun.x, &self.state.x) * fps;
        self.quiet_frames = if self.trip.speed <= self.dynamics.rest_speed { self.quiet_frames + 1 } else { 0 };
        self.trip.settled = self.quiet_frames >= crate::dynamics::run::QUIET_FRAMES;
        Ok(())
    }

    /// Total energy, and the part of it that is kinetic or elastic (stored), J.
    fn energies(&self) -> [f64; 2] {
        let kinetic = self.problem.kinetic(&self.state.v);
        [kinetic + self.problem.potential(&self.state.x), kinetic + self.problem.elastic(&self.state.x)]
    }

    /// Returns `true` if the energy has grown by more than motion explains, or the cloth is lost. `total` and `stored` are
    /// the [energies](Self::energies) before. Held vertices on their way do work, so growth then proves nothing.
    ///
    /// Motion explains a share of the stored energy. Energy stored since counts too, but at most doubles the share: cloth
    /// that runs away stores without end.
    fn has_grown(&self, [total, stored]: [f64; 2]) -> bool {
        if self.dynamics.fixed {
            return false;
        }
        let [now, stored_now] = self.energies();
        let room = ENERGY_GROWTH_SHARE.get() * stored.max(stored_now.min(stored * 2.0)) + ENERGY_GROWTH_FLOOR.get();
        let grown = self.problem.are_pins_placed(&self.state.x) && now > total + room;
        !self.state.is_in_range() || grown
    }

    /// Goes back to a state and halves the step from there.
    fn halve_step(&mut self, begun: &State) -> Result<(), ClothError> {
        if self.halvings >= STEP_HALVINGS_MAX.get() || !STEP_HALVING.is_on() {
            let what = format!("the energy grows even with steps of {:.1e} s", self.dt);
            return Err(ClothError::Unstable { step: self.trip.steps, what });
        }
        self.halvings += 1;
        self.state.copy_motion(begun);
        // Velocities stand half a step before: that is nearer now.
        self.shift_velocities(0.25 * self.dt);
        (self.steps, self.dt) = (2.0 * self.steps, 0.5 * self.dt);
        Ok(())
    }

    /// Takes all steps of a frame.
    fn step_through_frame(&mut self, watch: &mut dyn Watch) -> Result<(), ClothError> {
        for _ in 0..self.steps as usize {
            if watch.cancelled() {
                return Err(ClothError::Cancelled { step: self.trip.steps });
            }
            self.apply_drag();
            central_difference::step(&mut self.problem, &mut self.state, self.dt);
            self.trip.steps += 1;
            if self.dynamics.fixed {
                self.check_stability()?;
            }
        }
        Ok(())
    }

    /// Ends the run where the cloth has become unstable.
    fn check_stability(&self) -> Result<(), ClothError> {
        if self.state.is_in_range() {
            return Ok(());
        }
        let (dt, stable) = (self.dt, self.stable);
        let what = format!("steps of {dt:.3e} s are too long for this cloth, which bears about {stable:.3e} s");
        Err(ClothError::Unstable { step: self.trip.steps, what })
    }

    /// Applies the drag of the air, and damping that lags, against the velocity of half a step before.
    fn apply_drag(&mut self) {
        let damping = if self.dynamics.lagged { self.dynamics.damping } else { 0.0 };
        if self.dynamics.drag <= 0.0 && damping <= 0.0 {
            return;
        }
        let air = Dynamics { damping, ..*self.dynamics };
        let State { x, v, .. } = &mut self.state;
        let against = viscous(&air, &self.problem.masses.cloth, &self.scene.triangles, x, v);
        for ((v, c), w) in v.iter_mut().zip(&against).zip(&self.problem.masses.inverse) {
            *v -= c * *v * (self.dt * w);
        }
    }

    /// Hands the present frame to `each`.
    fn show(&mut self, number: usize, each: &mut dyn FnMut(&Frame<'_>)) {
        self.trip.frames = number + 1;
        each(&Frame {
            number,
            seconds: number as f64 / self.motion.fps,
            positions: &self.state.x,
            velocities: &self.state.v,
            body: self.scene.body.as_ref().map_or(&[], |b| &b.positions),
            kinetic: self.problem.kinetic(&self.state.v),
            potential: self.problem.potential(&self.state.x),
        });
    }

    /// Ends the motion with its report.
    fn end(mut self, settings: &Settings) -> Trip {
        self.trip.effects = report::effects(&self.problem, self.scene, settings);
        self.trip.effects.push(effect(
            "inertia",
            true,
            "the cloth moves in time".into(),
            format!("{} explicit steps of {:.3e} s, stable about {:.3e} s", self.trip.steps, self.dt, self.stable),
        ));
        self.trip.effects.push(crate::dynamics::figures::air(self.dynamics));
        self.trip
    }
}
