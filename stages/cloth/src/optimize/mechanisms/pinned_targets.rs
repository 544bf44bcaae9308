//! Continuation of pinned targets: held vertices that must get elsewhere are moved there in parts, no faster than the cloth
//! follows. If they moved at once, these few vertices would stretch the cloth beside them out of all measure.

use crate::linear::hessian::scattered;
use crate::optimize::descent::Descent;
use crate::optimize::mechanism::{Block, Mechanism, Verdict};
use crate::optimize::tuning::{
    PIN_ENERGY_RISE_MOST, PIN_FOLLOW_PART, PIN_HALT_DECREMENT, PIN_HALT_STRAIN, PIN_MOVE_FIRST, PIN_MOVE_FRICTION,
    PIN_MOVE_LEAST, PIN_PROBE_PART, PIN_SHORTENINGS, PIN_STRAIN_EASED, PIN_STRAIN_ROUNDS,
};
use crate::report::watch::Watch;
use crate::{ClothError, StopReason, Vec3};

/// Moves held vertices towards their places.
#[derive(Debug)]
pub(crate) struct PinnedTargets {
    /// Longest next move, over the mean edge.
    way: f64,
    /// Do they wait for the cloth?
    waits: bool,
    /// Does the strain of the cloth halt them, and end a descent in which it does not ease?
    halts_at_strain: bool,
    /// Least strain since it was too large; infinite where it is not.
    least_strain: f64,
    /// Rounds since that strain eased.
    rounds: u32,
}

impl PinnedTargets {
    /// Held vertices of cloth that settles: too much strain halts them.
    pub fn settling() -> Self {
        Self { halts_at_strain: true, ..Self::sewing() }
    }

    /// Held vertices of cloth that is sewn.
    pub fn sewing() -> Self {
        Self { way: PIN_MOVE_FIRST.get(), waits: false, halts_at_strain: false, least_strain: f64::INFINITY, rounds: 0 }
    }

    /// Takes notice of the largest strain.
    fn observe(&mut self, strain: f64) {
        if strain <= PIN_HALT_STRAIN.get() {
            (self.least_strain, self.rounds) = (f64::INFINITY, 0);
        } else if strain < PIN_STRAIN_EASED.get() * self.least_strain {
            (self.least_strain, self.rounds) = (strain, 0);
        } else {
            self.rounds += 1;
        }
    }

    fn move_pins(&self, d: &mut Descent<'_>) {
        let rubs = d.objective().friction_has_acted() && d.objective().terms.stitches.is_none();
        let most = if rubs { PIN_MOVE_FRICTION.get() } else { PIN_MOVE_FIRST.get() };
        let most = self.way.min(most) * d.objective().edge;
        let mut step = vec![Vec3::zeros(); d.x.len()];
        for (v, at) in &d.objective().unknowns.pins {
            step[*v as usize] = (at - d.x[*v as usize]).cap_magnitude(most);
        }
        let x = reached(d, step);
        if let Some(b) = d.detection() {
            b.step_taken(&x);
        }
        d.move_to(x);
    }
}

impl Mechanism for PinnedTargets {
    fn begin_round(&mut self, d: &mut Descent<'_>, _: &mut dyn Watch) -> Result<Verdict, ClothError> {
        if self.halts_at_strain {
            let strain = if d.pins_placed() { 0.0 } else { d.objective().strain(&d.x) };
            self.observe(strain);
            if self.rounds > PIN_STRAIN_ROUNDS.get() {
                return Ok(Verdict::Stop(StopReason::HeldBack));
            }
        }
        if !(self.waits || self.least_strain.is_finite() || d.pins_placed()) {
            self.move_pins(d);
        }
        Ok(Verdict::Go)
    }

    fn after_block(&mut self, d: &mut Descent<'_>, b: &Block) -> Verdict {
        let follows = b.mean >= PIN_FOLLOW_PART.get();
        // Sewing never measures the Newton step.
        let decrement = d.newton.decrement;
        self.waits = !follows || decrement.is_finite() && decrement > PIN_HALT_DECREMENT.get();
        self.way = (self.way * if follows { 2.0 } else { 0.5 }).clamp(PIN_MOVE_LEAST.get(), PIN_MOVE_FIRST.get());
        Verdict::Go
    }
}

/// Positions after a step of held vertices, which is shortened until it does not tear at the others.
fn reached(d: &mut Descent<'_>, mut step: Vec<Vec3>) -> Vec<Vec3> {
    // The work of lifting all of the cloth this far is no sign of tearing.
    let lift = d.start.mean_weight * d.x.len() as f64 * crate::longest(&step);
    let stored = d.objective().elastic(&d.x) + lift;
    let mut best = after(d, step.clone());
    for _ in 0..PIN_SHORTENINGS.get() {
        if best.1 - d.energy <= stored || d.factorisations() == 0 {
            break;
        }
        let along = with_cloth_beside(d, &step);
        let along = after(d, along);
        if along.1 < best.1 {
            best = along;
        }
        if best.1 - d.energy <= PIN_ENERGY_RISE_MOST.get() * stored {
            break;
        }
        step.iter_mut().for_each(|d| *d *= 0.25);
        best = after(d, step.clone());
    }
    best.0
}

/// Positions after a step as far as nothing crosses, and the energy there.
fn after(d: &mut Descent<'_>, mut step: Vec<Vec3>) -> (Vec<Vec3>, f64) {
    d.limit(&mut step);
    let place: Vec<Vec3> = d.x.iter().zip(&step).map(|(x, s)| x + s).collect();
    let (from, before) = (std::mem::replace(&mut d.x, place), d.energy);
    d.evaluate();
    let energy = std::mem::replace(&mut d.energy, before);
    (std::mem::replace(&mut d.x, from), energy)
}

/// A step of held vertices, together with the response of the cloth beside them. The response is one solve with the last
/// factor: its right side is the change of the forces by a small part of the step.
pub(crate) fn with_cloth_beside(d: &mut Descent<'_>, step: &[Vec3]) -> Vec<Vec3> {
    let probe = PIN_PROBE_PART.get();
    d.evaluate();
    let (from, force) = (d.x.clone(), d.f.clone());
    d.x.iter_mut().zip(step).for_each(|(x, s)| *x += s * probe);
    d.evaluate();
    let mut response: Vec<Vec3> = d.f.iter().zip(&force).map(|(p, q)| (p - q) / probe).collect();
    d.x = from;
    d.evaluate();
    d.preconditioner.factor.solve(&mut response);
    let (longest, along) = (crate::longest(step), crate::longest(&response));
    if !along.is_finite() {
        return step.to_vec();
    }
    let mut all = scattered(&d.objective().unknowns.index, &response, (longest / along).min(1.0));
    all.iter_mut().zip(step).for_each(|(a, s)| *a += s);
    all
}
