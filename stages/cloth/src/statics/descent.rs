//! The descent: blocks of quasi-Newton steps around one factor, until a Newton step would win nothing more.

use super::memory::{Memory, dot};
use super::objective::Objective;
use super::report;
use crate::linear::factor::Factor;
use crate::linear::hessian::FIXED;
use crate::start::Start;
use crate::{ClothError, Outcome, Scene, Settings, StopReason, Vec3, Watch};

/// Sufficient decrease (Armijo).
const DECREASE: f64 = 1e-4;
const MOST_HALVINGS: usize = 8;
/// Shift of the metric: mass / τ. First τ, and the one from which it no longer matters, s².
const TAU_FIRST: f64 = 1e-2;
const TAU_FREE: f64 = 30.0;
const TAU_LEAST: f64 = 1e-8;
const TAU_MOST: f64 = 1e4;
/// Rounds in which single vertices are held back before the whole step is shortened.
const HOLD_ROUNDS: usize = 3;
/// Part of a step below which single vertices are held back instead of all.
const HOLD_UNDER: f64 = 0.1;
/// Longest step of a vertex over the mean edge.
const LONGEST: f64 = 1.0;

pub(crate) struct Descent<'a> {
    pub goal: Objective,
    pub settings: &'a Settings,
    pub x: Vec<Vec3>,
    pub f: Vec<Vec3>,
    pub energy: f64,
    factor: Factor,
    memory: Memory,
    tau: f64,
    pub steps: u64,
    pub evaluations: u64,
    /// At the last look: energy a Newton step would win over the elastic energy, its longest move (m), net force.
    pub decrement: f64,
    pub longest: f64,
    pub residual: f64,
    weight: f64,
}

/// What became of a block of steps.
#[derive(Clone, Copy, Debug, Default)]
struct Block {
    steps: usize,
    /// Mean part of the full step that was taken.
    mean: f64,
    least: f64,
    stuck: bool,
}

impl<'a> Descent<'a> {
    pub fn new(scene: &Scene, settings: &'a Settings, start: Start, pulls: bool) -> Self {
        let (goal, x) = Objective::new(scene, settings, start, pulls);
        let f = vec![Vec3::zeros(); goal.inertia.len()];
        let weight = goal.mean_weight(scene.gravity.norm() * settings.gravity_scale);
        let mut descent = Self {
            goal,
            settings,
            x,
            f,
            energy: 0.0,
            factor: Factor::default(),
            memory: Memory::default(),
            tau: TAU_FIRST,
            steps: 0,
            evaluations: 0,
            decrement: f64::INFINITY,
            longest: f64::INFINITY,
            residual: f64::INFINITY,
            weight,
        };
        if let Some(b) = &mut descent.goal.barrier {
            b.cover(&descent.x, &vec![Vec3::zeros(); descent.x.len()]);
        }
        descent.evaluate();
        descent
    }

    fn evaluate(&mut self) {
        self.evaluations += 1;
        self.energy = self.goal.evaluate(&self.x, &mut self.f);
    }

    /// Steps in a block: more where a factor costs more.
    fn block_length(&self) -> usize {
        if self.f.len() > 6000 { 16 } else { 8 }
    }

    /// Refreshes friction and metric. `false` if no metric can be had.
    fn refresh(&mut self) -> bool {
        if let (Some(stick), Some(barrier)) = (&mut self.goal.stick, &self.goal.barrier) {
            stick.refresh(&self.x, &barrier.touches);
            self.evaluate();
        }
        self.goal.assemble(&self.x, true);
        let (pattern, values) = self.goal.hessian.merged();
        loop {
            let shift: Vec<f64> = self.goal.inertia.iter().map(|m| m / self.tau).collect();
            if self.factor.factorise(&pattern, &values, &shift) {
                return true;
            }
            if std::env::var_os("TOILE_TRACE").is_some() {
                #[allow(clippy::print_stderr)]
                {
                    let most = values.iter().map(|m| m.amax()).fold(0.0, f64::max);
                    let finite = values.iter().all(|m| m.iter().all(|c| c.is_finite()));
                    let touch = self.goal.barrier.as_ref().map_or(0.0, |b| b.touches.iter().map(|t| t.slope).fold(0.0, f64::max));
                    let near = self.goal.barrier.as_ref().map_or(0.0, |b| b.touches.iter().map(|t| t.distance).fold(1.0, f64::min));
                    eprintln!("factor failed tau {:.1e}: largest {most:.2e}, finite {finite}, touch {touch:.2e}, nearest {near:.2e}, elastic {:.2e}", self.tau, self.goal.elastic(&self.x));
                }
            }
            self.tau *= 0.1;
            if self.tau < TAU_LEAST {
                return false;
            }
        }
    }

    /// What a Newton step from here would win, over the elastic energy, and its longest move.
    fn look(&mut self) {
        let mut d = self.f.clone();
        self.factor.solve(&mut d);
        let win = 0.5 * dot(&d, &self.f);
        let scale = self.goal.elastic(&self.x).max(1e-12);
        self.decrement = win / scale;
        self.longest = d.iter().map(|d| d.norm()).fold(0.0, f64::max);
        let net = self.f.iter().map(|f| f.norm()).fold(0.0, f64::max);
        self.residual = if self.weight > 0.0 { net / self.weight } else { 0.0 };
    }

    fn resting(&self) -> bool {
        let s = self.settings;
        let slid = self.goal.stick.as_ref().map_or(0.0, |s| s.largest);
        self.tau >= TAU_FREE
            && self.decrement <= s.decrement_tolerance
            && self.longest <= s.move_tolerance
            && self.residual <= s.residual_tolerance
            && slid <= s.move_tolerance
            && self.pins_placed()
    }

    fn pins_placed(&self) -> bool {
        self.goal.pins.iter().all(|(v, at)| (at - self.x[*v as usize]).norm() <= 1e-6)
    }

    /// Leads held vertices towards their places, as far as nothing is in the way.
    fn lead(&mut self) {
        if self.pins_placed() {
            return;
        }
        let most = 0.5 * self.goal.edge;
        let mut step = vec![Vec3::zeros(); self.x.len()];
        for (v, at) in &self.goal.pins {
            let d = at - self.x[*v as usize];
            step[*v as usize] = if d.norm() > most { d * (most / d.norm()) } else { d };
        }
        self.limit(&mut step);
        self.x.iter_mut().zip(&step).for_each(|(x, d)| *x += d);
        if let Some(b) = &mut self.goal.barrier {
            b.took(&self.x);
        }
        self.memory.clear();
        self.evaluate();
    }

    /// Shortens a step so that nothing crosses.
    fn limit(&mut self, step: &mut [Vec3]) {
        for round in 0..=HOLD_ROUNDS {
            if self.goal.barrier.as_mut().is_some_and(|b| b.cover(&self.x, step)) {
                self.evaluate();
            }
            let Some(barrier) = &mut self.goal.barrier else { return };
            // A shorter step along the same direction is still a good one; only where a few vertices would stop all
            // others are they held back alone.
            let part = barrier.free_part(&self.x, step);
            if part >= HOLD_UNDER || round == HOLD_ROUNDS {
                if part < 1.0 {
                    barrier.tally.limited += 1;
                    step.iter_mut().for_each(|d| *d *= part);
                }
                return;
            }
            barrier.hold_back(&self.x, step);
        }
    }

    /// One step along the quasi-Newton direction; the part of it that was taken, `None` if nothing was won.
    fn step(&mut self) -> Option<f64> {
        let mut d = self.memory.direction(&self.f, |q| self.factor.solve(q));
        if dot(&d, &self.f) <= 0.0 || d.iter().any(|v| !v.iter().all(|c| c.is_finite())) {
            self.memory.clear();
            d = self.f.clone();
            self.factor.solve(&mut d);
        }
        let longest = d.iter().map(|d| d.norm()).fold(0.0, f64::max);
        let most = LONGEST * self.goal.edge;
        let cap = if longest > most { most / longest } else { 1.0 };
        let mut step = vec![Vec3::zeros(); self.x.len()];
        for (s, u) in step.iter_mut().zip(&self.goal.unknown) {
            if *u != FIXED {
                *s = d[*u as usize] * cap;
            }
        }
        self.limit(&mut step);
        let mut moved = vec![Vec3::zeros(); self.f.len()];
        crate::linear::hessian::gather(&self.goal.unknown, &step, &mut moved);
        let mut slope = dot(&moved, &self.f);
        if slope <= 0.0 {
            return None;
        }
        let (from, energy, force) = (self.x.clone(), self.energy, self.f.clone());
        let mut part = 1.0;
        for _ in 0..MOST_HALVINGS {
            for ((x, p), d) in self.x.iter_mut().zip(&from).zip(&step) {
                *x = p + d * part;
            }
            self.evaluate();
            let slack = 1e-14 * energy.abs();
            if self.energy.is_finite() && self.energy <= energy - DECREASE * part * slope + slack {
                let s: Vec<Vec3> = moved.iter().map(|d| d * part).collect();
                let y: Vec<Vec3> = force.iter().zip(&self.f).map(|(p, q)| p - q).collect();
                self.memory.push(s, y);
                self.steps += 1;
                if let Some(b) = &mut self.goal.barrier {
                    b.took(&self.x);
                }
                return Some(part);
            }
            // The parabola through both energies and the slope.
            let best = 0.5 * part * part * slope / (self.energy - energy + part * slope);
            part = if best.is_finite() { best.clamp(0.1 * part, 0.5 * part) } else { 0.1 * part };
            slope = slope.max(0.0);
        }
        self.x = from;
        self.evaluate();
        None
    }

    fn block(&mut self) -> Block {
        let mut b = Block { least: 1.0, ..Block::default() };
        let mut sum = 0.0;
        for _ in 0..self.block_length() {
            match self.step() {
                Some(part) => {
                    b.steps += 1;
                    sum += part;
                    b.least = b.least.min(part);
                    if part < 0.2 {
                        break;
                    }
                }
                None => {
                    b.stuck = true;
                    break;
                }
            }
        }
        b.mean = if b.steps > 0 { sum / b.steps as f64 } else { 0.0 };
        b
    }

    /// Adapts the shift to how the block went.
    fn adapt(&mut self, b: Block) {
        if b.stuck && b.steps == 0 {
            self.memory.clear();
            self.tau = (self.tau * 0.1).max(TAU_LEAST);
        } else if b.mean > 0.8 {
            self.tau = (self.tau * 4.0).min(TAU_MOST);
        } else if b.mean < 0.4 {
            let less = if b.steps == 1 { 0.15 } else { 0.4 };
            self.tau = (self.tau * less).max(TAU_LEAST);
        }
    }

    /// Goes on until at rest.
    pub fn settle(&mut self, watch: &mut dyn Watch) -> Result<StopReason, ClothError> {
        let mut stuck = 0;
        loop {
            self.lead();
            if !self.energy.is_finite() {
                return Err(ClothError::Unstable { step: self.steps, what: "the energy is beyond numbers".into() });
            }
            if !self.refresh() {
                let what = "no descent direction: the stiffness matrix cannot be factorised".into();
                return Err(ClothError::Unstable { step: self.steps, what });
            }
            self.look();
            if std::env::var_os("TOILE_TRACE").is_some() {
                #[allow(clippy::print_stderr)]
                {
                    eprintln!(
                        "step {} eval {} E {:.9} el {:.3e} dec {:.2e} longest {:.3} mm res {:.2e} tau {:.1e} an {} slid {:.3} touches {} limited {} lists {}",
                        self.steps, self.evaluations, self.energy, self.goal.elastic(&self.x), self.decrement, self.longest * 1e3,
                        self.residual, self.tau, self.factor.analyses, self.goal.stick.as_ref().map_or(0.0, |s| s.largest) * 1e3,
                        self.goal.barrier.as_ref().map_or(0, |b| b.touches.len()),
                        self.goal.barrier.as_ref().map_or(0, |b| b.tally.limited), self.goal.barrier.as_ref().map_or(0, |b| b.tally.lists),
                    );
                }
            }
            if self.resting() {
                return Ok(StopReason::Settled);
            }
            if self.tau < TAU_FREE && self.decrement < self.settings.decrement_tolerance && self.residual < 10.0 * self.settings.residual_tolerance {
                // Near rest: is it also without the shift?
                self.tau = TAU_FREE;
                continue;
            }
            if watch.cancelled() {
                return Err(ClothError::Cancelled { step: self.steps });
            }
            watch.progress(self.steps, &self.words());
            if self.steps >= self.settings.max_descents {
                return Ok(StopReason::MaxSteps);
            }
            let b = self.block();
            stuck = if b.steps == 0 { stuck + 1 } else { 0 };
            if stuck > 12 {
                return Ok(StopReason::MaxSteps);
            }
            self.adapt(b);
        }
    }

    fn words(&self) -> String {
        format!(
            "a Newton step would win {:.1e} of the elastic energy (goal {:.0e}) and move {:.3} mm (goal {:.1})",
            self.decrement,
            self.settings.decrement_tolerance,
            self.longest * 1e3,
            self.settings.move_tolerance * 1e3
        )
    }
}

/// Settles the cloth.
pub(crate) fn drape(scene: &Scene, settings: &Settings, watch: &mut dyn Watch) -> Result<Outcome, ClothError> {
    let start = Start::new(scene, settings)?;
    let repaired = start.repaired;
    let mut descent = Descent::new(scene, settings, start, false);
    let reason = descent.settle(watch)?;
    Ok(report::outcome(descent, scene, reason, repaired))
}

/// Pull of the threads at first, per length of seam, N/m, and at most.
const PULL_FIRST: f64 = 1.0;
const PULL_MOST: f64 = 300.0;
/// Blocks without much progress after which something must be in the way.
const PATIENCE: u32 = 40;
/// Distance to the body at first, over the mean edge.
const WIDE: f64 = 0.6;
/// Gap over the mean edge at which the full pull acts while the pieces come together.
const REACH: f64 = 0.5;
/// Energy won in a block over the elastic energy at which a sewn state is good enough to drape.
const SEWN: f64 = 0.2;
/// Widest gap over the mean edge from which the threads are drawn tight.
const NEAR: f64 = 0.1;
/// Pull at the sewing distance in the end, N/m.
const PULL_SEWN: f64 = 1e4;

/// Closes the stitches: the threads pull harder from block to block, until all pairs are closed. `None` where something
/// stays in the way.
pub(crate) fn sew(scene: &Scene, settings: &Settings, watch: &mut dyn Watch) -> Result<Option<Outcome>, ClothError> {
    let start = Start::new(scene, settings)?;
    let repaired = start.repaired;
    let mut descent = Descent::new(scene, settings, start, true);
    let closed = descent.goal.seams.is_none() || descent.close(watch)?;
    Ok(closed.then(|| report::outcome(descent, scene, StopReason::Settled, repaired)))
}

impl Descent<'_> {
    fn pull(&mut self, force: f64, reach: f64) {
        if let Some(s) = &mut self.goal.seams {
            (s.force, s.reach) = (force, reach);
        }
        self.memory.clear();
        self.evaluate();
    }

    /// Holds the cloth further off the body than its gaps: what feels the body early slides round it.
    fn stand_off(&mut self, gaps: &[f64], wide: f64) {
        if let Some(b) = &mut self.goal.barrier {
            b.frame.body_gap.iter_mut().zip(gaps).for_each(|(g, own)| *g = own.max(wide));
            b.cover_anew(&self.x);
        }
        self.memory.clear();
        self.evaluate();
    }

    /// Is everything closed?
    fn close(&mut self, watch: &mut dyn Watch) -> Result<bool, ClothError> {
        let (mut force, distance) = (PULL_FIRST, self.settings.sewing_distance);
        let gaps = self.goal.barrier.as_ref().map_or_else(Vec::new, |b| b.frame.body_gap.clone());
        let mut wide = WIDE * self.goal.edge;
        self.stand_off(&gaps, wide);
        let reach = REACH * self.goal.edge;
        self.pull(force, reach);
        let mut patience = 0;
        loop {
            self.lead();
            if !self.refresh() {
                let what = "no descent direction: the stiffness matrix cannot be factorised".into();
                return Err(ClothError::Unstable { step: self.steps, what });
            }
            self.look();
            let before = self.goal.seams.as_ref().map_or(0.0, |s| s.widest(&self.x));
            if before < wide {
                // Nearly closed: the body's distance shrinks with the gaps.
                wide = (0.5 * wide).max(before.min(wide));
                self.stand_off(&gaps, wide);
            }
            if std::env::var_os("TOILE_TRACE").is_some() {
                #[allow(clippy::print_stderr)]
                {
                    eprintln!("sew step {} E {:.6} widest {:.3} mm force {force:.1} tau {:.1e} longest {:.2} limited {}", self.steps, self.energy, before*1e3, self.tau, self.longest*1e3,
                    self.goal.barrier.as_ref().map_or(0, |b| b.tally.limited));
                }
            }
            if before <= NEAR * self.goal.edge {
                break;
            }
            let b = self.block();
            if std::env::var_os("TOILE_TRACE").is_some() {
                #[allow(clippy::print_stderr)]
                {
                eprintln!("   {b:?}");
                if let Some(ba) = &self.goal.barrier {
                    let mut t: Vec<_> = ba.touches.iter().collect();
                    t.sort_by(|a, b| a.distance.total_cmp(&b.distance));
                    for t in t.iter().take(3) {
                        eprintln!("      kind {} d {:.2e} load {:.2e} at {:?} key {:?}", t.key.0, t.distance, t.load, self.x[t.vertices[0] as usize].as_slice(), t.key.1);
                    }
                    if let Some(s) = &self.goal.seams { eprintln!("      widest at {:?}", s.widest_at(&self.x)); }
                }
                }
            }
            self.adapt(b);
            self.tau = self.tau.min(1.0);
            let after = self.goal.seams.as_ref().map_or(0.0, |s| s.widest(&self.x));
            if watch.cancelled() {
                return Err(ClothError::Cancelled { step: self.steps });
            }
            watch.progress(self.steps, &format!("widest seam {:.1} mm open", after * 1e3));
            // Pull harder when the gaps no longer shrink by themselves.
            if after > 0.95 * before {
                patience += 1;
            }
            if after > 0.95 * before && b.steps > 3 && b.mean > 0.3 {
                if patience > PATIENCE {
                    return Ok(false);
                }
                if force < PULL_MOST {
                    force *= 1.6;
                    self.pull(force, reach);
                }
            }
        }
        self.pull(PULL_SEWN, distance);
        let most = self.steps + 200;
        let mut last = self.energy;
        loop {
            self.lead();
            if !self.refresh() {
                break;
            }
            if std::env::var_os("TOILE_TRACE").is_some() {
                #[allow(clippy::print_stderr)]
                {
                    eprintln!("sew polish {} E {:.6} widest {:.4} mm tau {:.1e} wide {:.2}", self.steps, self.energy, self.goal.seams.as_ref().map_or(0.0, |s| s.widest(&self.x))*1e3, self.tau, wide * 1e3);
                }
            }
            let b = self.block();
            self.adapt(b);
            if watch.cancelled() {
                return Err(ClothError::Cancelled { step: self.steps });
            }
            if wide > 0.0 {
                wide *= 0.5;
                if gaps.iter().all(|g| wide <= *g) {
                    wide = 0.0;
                }
                self.stand_off(&gaps, wide);
                last = f64::INFINITY;
                continue;
            }
            let won = last - self.energy;
            last = self.energy;
            let closed = self.goal.seams.as_ref().map_or(0.0, |s| s.widest(&self.x)) <= 0.1 * distance;
            // The drape goes on from here: no need to rest.
            if closed && won <= SEWN * self.goal.elastic(&self.x) || self.steps > most {
                break;
            }
        }
        Ok(self.goal.seams.as_ref().is_none_or(|s| s.widest(&self.x) <= distance))
    }
}
