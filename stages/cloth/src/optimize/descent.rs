//! A descent: the state of a minimisation, and the one door through which its objective is changed.

use crate::contact::barrier::Barrier;
use crate::optimize::lbfgs::{Lbfgs, dot};
use crate::optimize::objective::{Objective, Terms};
use crate::optimize::preconditioner::Preconditioner;
use crate::optimize::regularization::Regularization;
use crate::optimize::speculation::Speculation;
use crate::optimize::strain_limit_phase::StrainLimitPhase;
use crate::optimize::task::Task;
use crate::optimize::tuning::{BLOCK_STEPS_LARGE, LARGE_CLOTH_VERTICES, STEP_CAP_EDGES};
use crate::prepare::start::Start;
use crate::report::cost::{CpuTimer, Work};
use crate::scene::EARTH;
use crate::scene::measures::{mean_weight, or_earth, side};
use crate::scene::topology::Topology;
use crate::{ClothError, Scene, Settings, Vec3, Watch};

/// The minimisation of an objective: where it is, and what it has learnt of the energy.
pub(crate) struct Descent<'a> {
    objective: Objective,
    pub settings: &'a Settings,
    /// Positions of all vertices, m.
    pub x: Vec<Vec3>,
    /// Forces on the unknowns at `x`, N.
    pub f: Vec<Vec3>,
    /// Energy at `x`, J.
    pub energy: f64,
    /// Steps taken.
    pub steps: u64,
    /// Blocks in a row that took no step.
    pub stuck_blocks: u32,
    pub preconditioner: Preconditioner,
    pub history: Lbfgs,
    pub regularization: Regularization,
    pub step_cap: StepCap,
    pub newton: NewtonStep,
    pub strain_limits: StrainLimitPhase,
    pub speculation: Speculation,
    pub start: StartFacts,
}

/// How long a step may be.
#[derive(Debug)]
pub(crate) struct StepCap {
    /// Longest move of a vertex in a step, over the mean edge.
    pub edges: f64,
    /// Largest part of a step that is tried first, over the part that was taken last. It is infinite where each step is
    /// tried whole.
    pub growth: f64,
}

/// The Newton step at the last place where it was measured.
#[derive(Debug)]
pub(crate) struct NewtonStep {
    /// Half of the Newton decrement squared: the energy that the step would gain, over the elastic energy. It is infinite
    /// where it was never measured, as in sewing.
    pub decrement: f64,
    /// Longest move of a vertex, m. After a step it is that of its quasi-Newton direction.
    pub longest: f64,
    /// Largest net force over the mean weight of a vertex.
    pub residual: f64,
}

/// Facts of the start that do not change.
#[derive(Debug)]
pub(crate) struct StartFacts {
    /// Mean weight of a vertex, N.
    pub mean_weight: f64,
    /// Vertices moved before the first step, and the largest move, m.
    pub repaired: (usize, f64),
}

/// The values that a change of the objective makes invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Change {
    /// Nothing: the objective is the same.
    Nothing,
    /// Forces that lag behind the positions. They are evaluated again, and the history stays.
    LaggedForces,
    /// The energy. It is evaluated again, and the history is cleared.
    Energy,
    /// The energy and its stiffness. The next block also takes a new factorisation.
    Stiffness,
}

impl Change {
    /// [`Self::Energy`] if something has changed.
    pub fn energy_if(changed: bool) -> Self {
        if changed { Self::Energy } else { Self::Nothing }
    }
}

impl<'a> Descent<'a> {
    /// Begins at the scene's positions, freed of what they cross.
    ///
    /// # Errors
    /// An unusable scene or setting, or a start that crosses.
    pub fn begin(scene: &Scene, settings: &'a Settings, task: Task) -> Result<Self, ClothError> {
        Ok(Self::new(scene, settings, Start::new(scene, settings)?, task))
    }

    /// Begins at a start that was prepared.
    pub fn new(scene: &Scene, settings: &'a Settings, start: Start, task: Task) -> Self {
        let repaired = start.repaired;
        let time_unit = regularization_unit(scene, &start.topology);
        let (objective, x) = Objective::new(scene, settings, start, task);
        let gravity = scene.gravity.norm() * settings.gravity_scale;
        let mut descent = Self {
            f: vec![Vec3::zeros(); objective.unknowns.unknown_mass.len()],
            settings,
            x,
            energy: 0.0,
            steps: 0,
            stuck_blocks: 0,
            preconditioner: Preconditioner::new(settings.threads),
            history: Lbfgs::default(),
            regularization: Regularization::new(time_unit),
            step_cap: StepCap { edges: STEP_CAP_EDGES.get(), growth: f64::INFINITY },
            newton: NewtonStep { decrement: f64::INFINITY, longest: f64::INFINITY, residual: f64::INFINITY },
            strain_limits: StrainLimitPhase::Undecided,
            speculation: Speculation::default(),
            start: StartFacts { mean_weight: mean_weight(&objective.unknowns.mass, gravity), repaired },
            objective,
        };
        let still = vec![Vec3::zeros(); descent.x.len()];
        if let Some(b) = &mut descent.objective.terms.barrier {
            b.update_lists(&descent.x, &still);
        }
        if let Some(p) = &mut descent.objective.terms.pressure {
            p.refresh(&descent.x);
        }
        descent.evaluate();
        descent
    }

    pub fn objective(&self) -> &Objective {
        &self.objective
    }

    /// Changes the objective. This is the only way to change the energy: it makes invalid what the change says.
    /// Returns whether anything has changed.
    pub fn change(&mut self, change: impl FnOnce(&mut Objective, &[Vec3]) -> Change) -> bool {
        let made = change(&mut self.objective, &self.x);
        self.apply(made);
        made != Change::Nothing
    }

    /// Moves the cloth elsewhere, not by a step: its history says nothing of that place.
    pub fn move_to(&mut self, x: Vec<Vec3>) {
        self.x = x;
        self.apply(Change::Energy);
    }

    fn apply(&mut self, change: Change) {
        match change {
            Change::Nothing => {}
            Change::LaggedForces => self.energy = self.objective.evaluate_again(&self.x, &mut self.f),
            Change::Energy => {
                self.history.forget();
                self.evaluate();
            }
            Change::Stiffness => {
                self.history.forget();
                self.evaluate();
                self.preconditioner.renew();
            }
        }
    }

    /// Lists and bounds of collision detection. A caller updates lists by it and asks for bounds; a change of the energy goes
    /// through [`Self::change`].
    pub fn detection(&mut self) -> Option<&mut Barrier> {
        self.objective.terms.barrier.as_mut()
    }

    /// Uses the surrogate bending Hessian in the next factorisations, or the whole one.
    pub fn use_surrogate(&mut self, surrogate: bool) {
        self.objective.use_surrogate(surrogate);
    }

    /// Evaluates energy and forces at the positions.
    pub fn evaluate(&mut self) {
        self.energy = self.objective.evaluate(&self.x, &mut self.f);
    }

    /// Evaluates them again where only terms other than the cloth's own have changed.
    pub fn evaluate_again(&mut self) {
        self.apply(Change::LaggedForces);
    }

    /// The Hessian at the positions, projected to be convex or as it is.
    pub fn assemble(&mut self, convex: bool) -> crate::linear::system::System {
        let mut lap = CpuTimer::start();
        let system = self.objective.assemble(&self.x, self.regularization.isotropic, convex);
        self.spend(&mut lap);
        system
    }

    /// Adds the time since the last lap to the cost of the descent, with the time of the factor's other thread.
    pub fn spend(&mut self, lap: &mut CpuTimer) {
        self.objective.costs.spend(Work::Descent, lap);
        self.objective.costs.add(Work::Descent, self.preconditioner.factor.take_second_thread_seconds());
    }

    /// Is a factorisation of this cloth as dear as many steps?
    pub fn is_large(&self) -> bool {
        self.f.len() > LARGE_CLOTH_VERTICES.get()
    }

    /// Steps of a block: `steps`, or more where a factorisation costs more.
    pub fn block_steps(&self, steps: usize) -> usize {
        if self.is_large() { BLOCK_STEPS_LARGE.get() } else { steps }
    }

    /// Elastic energy that the gain of a step is compared with, J.
    pub fn elastic_scale(&self) -> f64 {
        self.objective.last_elastic().max(1e-12)
    }

    /// Largest net force over the mean weight of a vertex.
    pub fn net_force(&self) -> f64 {
        let net = crate::longest(&self.f);
        if self.start.mean_weight > 0.0 { net / self.start.mean_weight } else { 0.0 }
    }

    /// Are all held vertices at their places?
    pub fn pins_placed(&self) -> bool {
        self.objective.pins_placed(&self.x)
    }

    /// Holds the held vertices where they are. No term of the energy reads their places, so nothing becomes invalid.
    pub fn hold_pins_here(&mut self) {
        let x = &self.x;
        self.objective.unknowns.pins.iter_mut().for_each(|(v, at)| *at = x[*v as usize]);
    }

    /// Measures the Newton step from the positions with the last factorisation.
    pub fn measure_newton_step(&mut self) {
        let mut lap = CpuTimer::start();
        let mut d = self.f.clone();
        self.preconditioner.factor.solve(&mut d);
        self.spend(&mut lap);
        let gain = 0.5 * dot(&d, &self.f);
        self.newton.decrement = gain / self.elastic_scale();
        self.newton.longest = crate::longest(&d);
        self.newton.residual = self.net_force();
    }

    /// Reports progress.
    ///
    /// # Errors
    /// A stop on request.
    pub fn report_progress(&self, watch: &mut dyn Watch, words: &str) -> Result<(), ClothError> {
        if watch.cancelled() {
            return Err(ClothError::Cancelled { step: self.steps });
        }
        watch.progress(self.steps, words);
        Ok(())
    }

    /// Refreshes the forces that lag behind the positions: friction in contacts and in bending, and pressure.
    pub fn refresh_lagged_forces(&mut self) {
        self.change(|objective, x| {
            let mut lap = CpuTimer::start();
            let Objective { terms, costs, .. } = objective;
            let Terms { barrier, friction, hysteresis, pressure, .. } = terms;
            if let (Some(friction), Some(barrier)) = (friction, barrier) {
                friction.refresh(x, &barrier.contacts, barrier.parameters.stiffness);
                costs.spend(Work::Friction, &mut lap);
            }
            if let Some(h) = hysteresis {
                h.refresh(x);
                costs.spend(Work::Hysteresis, &mut lap);
            }
            if let Some(p) = pressure {
                p.refresh(x);
                costs.spend(Work::Pressure, &mut lap);
            }
            let lags = objective.has_friction() || objective.terms.pressure.is_some();
            if lags { Change::LaggedForces } else { Change::Nothing }
        });
    }
}

/// Side of the largest part of the cloth over gravity in units of the Earth's, s².
fn regularization_unit(scene: &Scene, topology: &Topology) -> f64 {
    side(scene, topology) * (EARTH / or_earth(scene.gravity.norm()))
}
