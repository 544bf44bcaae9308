//! The walk through the frames.

use crate::dynamics::attachments::{Attachment, Path};
use crate::dynamics::drag::viscous;
use crate::dynamics::motion::{Dynamics, Frame, Motion, Trip};
use crate::dynamics::step::Stepper;
use crate::dynamics::tr_bdf2;
use crate::dynamics::tr_bdf2::State;
use crate::dynamics::tuning::BODY_STEP_EDGES;
use crate::dynamics::{figures, impact};
use crate::energy::inertia::Inertia;
use crate::optimize::descent::Descent;
use crate::optimize::task::Task;
use crate::prepare::start::Start;
use crate::{ClothError, Scene, Settings, Vec3, Watch};

/// Frames in a row without motion that count as rest.
pub(crate) const QUIET_FRAMES: usize = 5;

/// Moves the cloth in time by implicit steps; `each` is given every frame.
///
/// # Errors
/// An unusable scene, a start that crosses, cloth caught by the body, or a stop on request.
pub(crate) fn film(
    scene: &Scene,
    settings: &Settings,
    dynamics: &Dynamics,
    motion: &Motion,
    watch: &mut dyn Watch,
    each: &mut dyn FnMut(&Frame<'_>),
) -> Result<Trip, ClothError> {
    let mut walk = Walk::new(scene, settings, dynamics, motion)?;
    walk.go(watch, each)?;
    Ok(walk.end())
}

pub(crate) struct Walk<'a> {
    pub scene: &'a Scene,
    dynamics: &'a Dynamics,
    motion: &'a Motion,
    pub stepper: Stepper<'a>,
    path: Option<Path>,
    state: State,
    /// Velocities one step before, m/s, and that step, s.
    last: Option<(Vec<Vec3>, f64)>,
    free: Vec<bool>,
    pub trip: Trip,
}

impl<'a> Walk<'a> {
    /// Begins at the scene's positions.
    ///
    /// # Errors
    /// An unusable scene, or a start that crosses.
    pub fn new(
        scene: &'a Scene,
        settings: &'a Settings,
        dynamics: &'a Dynamics,
        motion: &'a Motion,
    ) -> Result<Self, ClothError> {
        let mut start = Start::new(scene, settings)?;
        let path = scene.body.as_ref().and_then(|b| Path::new(motion, &b.positions));
        if let Some(body) = start.body.as_mut().filter(|_| path.is_some()) {
            body.begin_motion();
        }
        let body = start.body.as_ref().filter(|_| path.is_some());
        let attachments =
            crate::scene::measures::held(scene).into_iter().map(|(v, at)| Attachment::new(v, at, body)).collect();
        // The shift of the regularisation is the inertia of a time step.
        let mut descent = Descent::new(scene, settings, start, Task::Settle);
        descent.regularization.unit = 1.0;
        if motion.rests && descent.warm_start_contacts() && descent.is_far_from_rest() {
            descent.drop_warm_start();
        }
        descent.preconditioner.always_convex = true;
        let mut free: Vec<bool> = descent.objective().unknowns.mass.iter().map(|m| *m > 0.0).collect();
        descent.objective().unknowns.pins.iter().for_each(|p| free[p.0 as usize] = false);
        let n = descent.x.len();
        let v = if motion.velocities.is_empty() { vec![Vec3::zeros(); n] } else { motion.velocities.clone() };
        let state = State { x: descent.x.clone(), v };
        let stepper = Stepper {
            descent,
            attachments,
            free: free.clone(),
            tolerance: dynamics.tolerance,
            unfinished: 0,
            parted: 0,
        };
        let trip = Trip { lead_in_distance: path.as_ref().map_or(0.0, |p| p.lead_in_distance), ..Trip::default() };
        Ok(Self { scene, dynamics, motion, stepper, path, state, last: None, free, trip })
    }

    /// Goes through the frames.
    ///
    /// # Errors
    /// Cloth caught by the body, instability, or a stop on request.
    pub fn go(&mut self, watch: &mut dyn Watch, each: &mut dyn FnMut(&Frame<'_>)) -> Result<(), ClothError> {
        let lead_in = self.path.as_ref().map_or(0.0, |p| p.lead_in);
        if lead_in > 0.0 {
            self.span(-lead_in, 0.0, watch)?;
        }
        self.show(0, each);
        let frame = |k: usize| k as f64 / self.motion.fps;
        let mut quiet = 0;
        for k in 1..self.motion.frames.max(1) {
            let before = self.state.x.clone();
            self.span(frame(k - 1), frame(k), watch)?;
            let moved = crate::farthest(&before, &self.state.x);
            self.trip.speed = moved * self.motion.fps;
            self.show(k, each);
            let stopped = self.path.as_ref().is_none_or(|p| frame(k) >= p.end());
            quiet = if stopped && self.trip.speed <= self.dynamics.rest_speed { quiet + 1 } else { 0 };
            self.trip.settled = quiet >= QUIET_FRAMES;
            if self.trip.settled && self.motion.until_settled {
                break;
            }
        }
        Ok(())
    }

    /// Equal steps from one time to another.
    fn span(&mut self, from: f64, to: f64, watch: &mut dyn Watch) -> Result<(), ClothError> {
        let n = self.dynamics.steps(to - from).max(self.strides(from, to));
        let dt = (to - from) / n;
        for k in 0..n as usize {
            if watch.cancelled() {
                return Err(ClothError::Cancelled { step: self.trip.steps });
            }
            let now = from + dt * k as f64;
            watch.progress(self.trip.steps, &format!("{now:.2} s of {:.2} s", self.seconds()));
            self.step(now, dt)?;
            self.trip.steps += 1;
        }
        Ok(())
    }

    /// Steps in each of which the body comes no farther than [`BODY_STEP_EDGES`] towards cloth that goes on as it does in the mean: what
    /// is hit in one step is stretched by all of that.
    fn strides(&self, from: f64, to: f64) -> f64 {
        let Some(path) = &self.path else { return 1.0 };
        let v = &self.state.v;
        let along = v.iter().sum::<Vec3>() * ((to - from) / v.len().max(1) as f64);
        let start: Vec<Vec3> = path.at(from).iter().map(|p| p + along).collect();
        (crate::farthest(&start, &path.at(to)) / (BODY_STEP_EDGES.get() * self.stepper.descent.objective().edge)).ceil()
    }

    fn seconds(&self) -> f64 {
        self.motion.frames.saturating_sub(1) as f64 / self.motion.fps
    }

    fn step(&mut self, now: f64, dt: f64) -> Result<(), ClothError> {
        let mass = self.stepper.descent.objective().unknowns.mass.clone();
        let (scene, dynamics) = (self.scene, self.dynamics);
        let s = self.state.clone();
        let damping = |v: &[Vec3]| viscous(dynamics, &mass, &scene.triangles, &s.x, v);
        let mut force = vec![Vec3::zeros(); s.x.len()];
        self.stepper.descent.objective().terms.cloth.iter().for_each(|e| e.add_forces(&s.x, &mut force));
        force.iter_mut().zip(damping(&s.v)).zip(&s.v).for_each(|((f, c), v)| *f -= c * v);
        let ahead = |v: &[Vec3], old: &[Vec3], share: f64| -> Vec<Vec3> {
            v.iter().zip(old).map(|(v, o)| v + (v - o) * share).collect()
        };
        let soon = match &self.last {
            Some((old, span)) => ahead(&s.v, old, tr_bdf2::FIRST * dt / span),
            None => s.v.clone(),
        };
        let (most, rest) = (tr_bdf2::FIRST * dt, (1.0 - tr_bdf2::FIRST) * dt);
        let stage = tr_bdf2::first(&s, &force, &mass, damping(&soon), dt);
        let plain = tr_bdf2::plain(&s, &mass, damping(&s.v), most);
        let (middle, rough) = self.stage(stage, Some(plain), &s.v, [now, most])?;

        let plain = tr_bdf2::plain(&middle, &mass, damping(&middle.v), rest);
        let (stage, plain) = if rough {
            (plain, None)
        } else {
            let soon = ahead(&middle.v, &s.v, (1.0 - tr_bdf2::FIRST) / tr_bdf2::FIRST);
            (tr_bdf2::second(&s, &middle, &mass, damping(&soon), dt), Some(plain))
        };
        self.state = self.stage(stage, plain, &middle.v, [now + most, rest])?.0;
        self.last = Some((s.v, dt));
        Ok(())
    }

    /// One stage from a time on over a span, the cloth moving on with velocities `v` at first; and whether it was a rough
    /// one.
    fn stage(
        &mut self,
        inertia: Inertia,
        plain: Option<Inertia>,
        v: &[Vec3],
        [now, span]: [f64; 2],
    ) -> Result<(State, bool), ClothError> {
        let body = self.path.as_ref().map(|p| p.at(now + span));
        let before = self.path.as_ref().map(|p| p.at(now));
        let guess = v.iter().map(|v| v * span).collect();
        let rough = self.stepper.solve(inertia, plain, guess, body.as_deref(), now)?;
        let objective = self.stepper.descent.objective();
        let x = self.stepper.descent.x.clone();
        let mut v = objective.terms.inertia.as_ref().map_or_else(Vec::new, |i| tr_bdf2::velocities(i, &x));
        let pace: Vec<Vec3> = match (before, body) {
            (Some(a), Some(b)) => a.iter().zip(&b).map(|(a, b)| (b - a) / span).collect(),
            _ => Vec::new(),
        };
        if let Some(barrier) = &objective.terms.barrier {
            impact::settle(barrier, &x, &mut v, &objective.unknowns.mass, &self.free, &pace);
        }
        Ok((State { x, v }, rough))
    }

    fn show(&mut self, number: usize, each: &mut dyn FnMut(&Frame<'_>)) {
        self.trip.frames = number + 1;
        let potential = figures::potential(&mut self.stepper);
        let objective = self.stepper.descent.objective();
        let body = objective.body().map_or(&[][..], |b| &b.positions);
        each(&Frame {
            number,
            seconds: number as f64 / self.motion.fps,
            positions: &self.state.x,
            velocities: &self.state.v,
            body,
            kinetic: figures::kinetic(&objective.unknowns.mass, &self.state.v),
            potential,
        });
    }

    fn end(self) -> Trip {
        let Self { scene, dynamics, motion, stepper, mut trip, .. } = self;
        trip.descents = stepper.descent.steps;
        (trip.unfinished, trip.parted) = (stepper.unfinished, stepper.parted);
        figures::effects(&stepper, scene, dynamics, motion, &mut trip);
        trip
    }
}
