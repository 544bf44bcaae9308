//! The descent: blocks of quasi-Newton steps around one factor, until a Newton step would win nothing more.

use crate::contact::lagged_friction::Stick;
use crate::linear::factor::Factor;
use crate::optimize::lbfgs::{Memory, dot};
use crate::optimize::objective::Objective;
use crate::optimize::pinned_targets::Leading;
use crate::optimize::preconditioner::Made;
use crate::optimize::speculative_steps::Ahead;
use crate::prepare::start::Start;
use crate::report::cost::{Lap, Work};
use crate::scene::EARTH;
use crate::scene::measures::{mean_weight, or_earth, side};
use crate::scene::topology::Topology;
use crate::{ClothError, Scene, Settings, Vec3, Watch};

/// Shift of the metric: mass / (τ · unit). First τ, and the one from which it no longer matters; the unit is 1 s² for a
/// square metre of cloth on Earth, and goes with lengths and weight as pendulums do, so that similar cloth takes similar
/// steps.
const TAU_FIRST: f64 = 1e-2;
pub(crate) const TAU_FREE: f64 = 30.0;
pub(crate) const TAU_LEAST: f64 = 1e-8;
const TAU_MOST: f64 = 1e4;
/// What τ grows by after a good block, and for large cloth once a Newton step would win as little as at rest: it has long lost its
/// use there, and every new τ takes a factor.
const TAU_GROWS: f64 = 4.0;
const TAU_SOARS: f64 = 100.0;
/// First and last share of the stretch stiffness in all directions, and what it grows by.
const FIRM_LEAST: f64 = 1e-3;
const FIRM_MOST: f64 = 0.1;
const FIRMER: f64 = 8.0;
/// What a Newton step would win over the elastic energy, below which contacts that are nearly shut are so under a load, and not
/// because the cloth began there.
const LOADED: f64 = 1.0;
/// Part of a step below which a block ends: its metric says too little of what is here. Shorter ones than a full step still
/// teach the memory.
const SHORTEST: f64 = 0.1;
/// Vertices over which a factor takes as long as many steps.
pub(crate) const LARGE: usize = 4_500;
/// Steps in a block of large cloth, and of other where it is sewn or moves.
const MANY: usize = 16;
pub(crate) const FEW: usize = 8;
/// A factor has led well through a block of which the mean part of a step is more than this, and the largest net force at its end
/// less than this part of that before.
const WELL: f64 = 0.8;
const CALMED: f64 = 0.3;
/// Longest step of a vertex over the mean edge.
const STRIDE: f64 = 1.0;

pub(crate) struct Descent<'a> {
    pub goal: Objective,
    pub settings: &'a Settings,
    pub x: Vec<Vec3>,
    pub f: Vec<Vec3>,
    pub energy: f64,
    pub factor: Factor,
    /// Is it that of the second derivatives as they are?
    pub exact: bool,
    pub(crate) memory: Memory,
    pub tau: f64,
    /// Share of the stretch stiffness that the metric lets stand in all directions.
    pub firm: f64,
    /// Longest step of a vertex over the mean edge.
    pub stride: f64,
    /// Largest part of a step that is tried first, over that of the last one in the block; infinite where each is tried whole.
    pub(crate) bolder: f64,
    /// Unit of τ, s².
    pub unit: f64,
    /// τ from which the shift is no more than the rounding of the factor (cloth that nothing holds has motions without
    /// stiffness).
    pub free: f64,
    pub steps: u64,
    /// At the last look: energy a Newton step would win over the elastic energy, its longest move (m), net force.
    pub decrement: f64,
    pub longest: f64,
    pub residual: f64,
    /// Mean of a vertex, N.
    pub(crate) weight: f64,
    /// Vertices moved before the first step, and the largest move, m.
    pub repaired: (usize, f64),
    pub(crate) leading: Leading,
    pub(crate) ahead: Ahead,
    /// Of what the factor is.
    pub(crate) made: Made,
    /// Blocks until the true metric is tried again, and how many it will be after the next failure.
    pub(crate) wait: u32,
    pub(crate) patience: u32,
}

/// What became of a block of steps.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Block {
    pub steps: usize,
    /// Mean part of the full step that was taken.
    pub mean: f64,
    /// Energy, J.
    pub won: f64,
    stuck: bool,
}

/// Size of the largest part over gravity in units of the Earth's, s².
fn unit(scene: &Scene, topology: &Topology) -> f64 {
    side(scene, topology) * (EARTH / or_earth(scene.gravity.norm()))
}

impl<'a> Descent<'a> {
    /// From the scene's positions, freed of what they cross. `pulls`: do threads close the stitches?
    pub fn begin(scene: &Scene, settings: &'a Settings, pulls: bool) -> Result<Self, ClothError> {
        Ok(Self::new(scene, settings, Start::new(scene, settings)?, pulls))
    }

    pub fn new(scene: &Scene, settings: &'a Settings, start: Start, pulls: bool) -> Self {
        let repaired = start.repaired;
        let unit = unit(scene, &start.topology);
        let (goal, x) = Objective::new(scene, settings, start, pulls);
        let f = vec![Vec3::zeros(); goal.inertia.len()];
        let weight = mean_weight(&goal.mass, scene.gravity.norm() * settings.gravity_scale);
        let mut descent = Self {
            goal,
            settings,
            x,
            f,
            energy: 0.0,
            factor: Factor::by(settings.threads),
            exact: false,
            memory: Memory::default(),
            tau: TAU_FIRST,
            firm: 0.0,
            stride: STRIDE,
            bolder: f64::INFINITY,
            unit,
            free: TAU_FREE,
            steps: 0,
            decrement: f64::INFINITY,
            longest: f64::INFINITY,
            residual: f64::INFINITY,
            weight,
            repaired,
            leading: Leading::default(),
            ahead: Ahead::default(),
            made: Made::default(),
            wait: 0,
            patience: 0,
        };
        if let Some(b) = &mut descent.goal.barrier {
            b.cover(&descent.x, &vec![Vec3::zeros(); descent.x.len()]);
        }
        if let Some(p) = &mut descent.goal.pressure {
            p.refresh(&descent.x);
        }
        descent.evaluate();
        descent
    }

    pub fn evaluate(&mut self) {
        self.energy = self.goal.evaluate(&self.x, &mut self.f);
    }

    /// The same after only what presses or holds the cloth has been told anew.
    pub(crate) fn evaluate_again(&mut self) {
        self.energy = self.goal.evaluate_again(&self.x, &mut self.f);
    }

    /// Factors made.
    pub fn factors(&self) -> u32 {
        self.factor.factors
    }

    /// Steps in a block: `few`, or more where a factor costs more.
    pub fn block_length(&self, few: usize) -> usize {
        if self.is_large() { MANY } else { few }
    }

    pub(crate) fn is_large(&self) -> bool {
        self.f.len() > LARGE
    }

    /// Hardens contacts that are nearly shut under a load, and refreshes friction.
    pub(crate) fn take_up(&mut self) {
        // In a time step friction holds on to where the step began, until its end.
        if self.goal.inert.is_none() {
            // Sewing never looks at the rest.
            let falls = self.decrement.is_finite() && self.decrement >= LOADED;
            if !falls && self.goal.barrier.as_mut().is_some_and(|b| b.harden(&self.goal.unknown)) {
                self.start_anew();
            }
            self.refresh_lagged();
        }
    }

    /// Lets contacts that gave way push from farther off; says whether there were any.
    pub fn bear(&mut self) -> bool {
        let any = self.goal.barrier.as_mut().is_some_and(|b| b.bear(&self.x, &self.goal.unknown));
        if any {
            self.start_anew();
        }
        any
    }

    /// Cloth that lies on the body at the start does so with the load that holds it in balance; says whether any does.
    pub fn preload(&mut self) -> bool {
        let goal = &mut self.goal;
        let Some(b) = goal.barrier.as_mut().filter(|_| goal.stick.is_some()) else { return false };
        if !b.preload(&self.x, &self.f, &goal.unknown) {
            return false;
        }
        self.start_anew();
        let goal = &mut self.goal;
        let forces = goal.forces().to_vec();
        if let (Some(stick), Some(b)) = (&mut goal.stick, &goal.barrier) {
            stick.refresh(&self.x, &b.touches, b.frame.press);
            stick.take_up(forces, &goal.unknown);
        }
        self.evaluate();
        true
    }

    /// It does not after all.
    pub fn unload(&mut self) {
        if let Some(b) = &mut self.goal.barrier {
            b.unload(&self.x);
        }
        self.goal.stick.iter_mut().for_each(|s| *s = Stick::default());
        self.start_anew();
    }

    /// New normal forces and holds from the contacts and folds here, and what pressure pushes; what slid is taken over.
    pub fn refresh_lagged(&mut self) {
        let goal = &mut self.goal;
        let mut lap = Lap::start();
        if let (Some(stick), Some(barrier)) = (&mut goal.stick, &goal.barrier) {
            stick.refresh(&self.x, &barrier.touches, barrier.frame.press);
            goal.costs.spend(Work::Friction, &mut lap);
        }
        if let Some(h) = &mut goal.hysteresis {
            h.refresh(&self.x);
            goal.costs.spend(Work::Hysteresis, &mut lap);
        }
        if let Some(p) = &mut goal.pressure {
            p.refresh(&self.x);
            goal.costs.spend(Work::Pressure, &mut lap);
        }
        if self.goal.rubs() || self.goal.pressure.is_some() {
            self.evaluate_again();
        }
    }

    /// What a Newton step from here would win, over the elastic energy, and its longest move.
    pub fn look(&mut self) {
        let mut lap = Lap::start();
        let mut d = self.f.clone();
        self.factor.solve(&mut d);
        self.spend(&mut lap);
        let win = 0.5 * dot(&d, &self.f);
        self.decrement = win / self.scale();
        self.longest = crate::longest(&d);
        self.residual = self.net();
    }

    /// Elastic energy over which what a step would win is told, J.
    pub(crate) fn scale(&self) -> f64 {
        self.goal.stored().max(1e-12)
    }

    /// Largest net force over the mean vertex weight.
    fn net(&self) -> f64 {
        let net = crate::longest(&self.f);
        if self.weight > 0.0 { net / self.weight } else { 0.0 }
    }

    /// Are the net forces within a goal that is set for them?
    fn quiet(&self) -> bool {
        let goal = self.settings.residual_tolerance;
        goal.is_finite() && self.net() <= goal
    }

    pub fn resting(&self) -> bool {
        let s = self.settings;
        self.tau >= self.free
            && self.firm == 0.0
            && self.decrement <= s.decrement_tolerance
            && self.longest <= s.move_tolerance
            && self.residual <= s.residual_tolerance
            && self.goal.slid() <= s.move_tolerance
            && self.pins_placed()
    }

    pub(crate) fn pins_placed(&self) -> bool {
        self.goal.pins.iter().all(|(v, at)| (at - self.x[*v as usize]).norm() <= 1e-6)
    }

    /// Holds the held vertices where they are.
    pub fn hold_here(&mut self) {
        self.goal.pins.iter_mut().for_each(|(v, at)| *at = self.x[*v as usize]);
    }

    /// Of at least `few`, if none ends it.
    pub(crate) fn take_steps(&mut self, few: usize) -> Block {
        let mut b = Block::default();
        let before = self.energy;
        let (mut sum, mut first) = (0.0, 1.0);
        for _ in 0..self.block_length(few) {
            match self.step(first) {
                Some(part) => {
                    first = (self.bolder * part).min(1.0);
                    b.steps += 1;
                    sum += part;
                    if part < SHORTEST || self.quiet() {
                        break;
                    }
                }
                None => {
                    b.stuck = true;
                    break;
                }
            }
        }
        b.won = before - self.energy;
        b.mean = if b.steps > 0 { sum / b.steps as f64 } else { 0.0 };
        b
    }

    /// Adapts the shift to how the block went.
    pub fn adapt(&mut self, b: Block) {
        self.leading.adapt(b.mean, self.decrement);
        self.made.good &= b.mean > WELL && self.net() < CALMED * self.residual;
        if self.stiffen(b) {
            return;
        }
        if b.stuck && b.steps == 0 {
            self.memory.clear();
            self.tau = (self.tau * 0.1).max(TAU_LEAST);
        } else if b.mean > 0.8 {
            let soars = self.is_large() && self.decrement <= self.settings.decrement_tolerance;
            let more = if soars { TAU_SOARS } else { TAU_GROWS };
            self.tau = (self.tau * more).min(TAU_MOST);
        } else if b.mean < 0.4 {
            let less = if b.steps == 1 { 0.15 } else { 0.4 };
            self.tau = (self.tau * less).max(TAU_LEAST);
        }
    }

    /// Steps that fell short are first met with a metric that turns less easily; says whether it became such a one.
    fn stiffen(&mut self, b: Block) -> bool {
        let last = self.firm;
        if b.mean < 0.4 {
            self.firm = (FIRMER * last).clamp(FIRM_LEAST, FIRM_MOST);
        } else if b.mean > 0.8 {
            self.firm = if last > FIRM_LEAST { last / FIRMER } else { 0.0 };
        }
        self.firm > last
    }

    /// The energy has been changed: evaluates, and forgets what was learnt of its curvature.
    pub fn start_anew(&mut self) {
        self.memory.clear();
        self.evaluate();
    }

    /// Metric, block and adaption in one.
    pub fn advance(&mut self, watch: &mut dyn Watch, words: &str) -> Result<Block, ClothError> {
        if watch.cancelled() {
            return Err(ClothError::Cancelled { step: self.steps });
        }
        watch.progress(self.steps, words);
        self.lead();
        self.metric()?;
        let b = self.block(FEW);
        self.adapt(b);
        Ok(b)
    }
}
