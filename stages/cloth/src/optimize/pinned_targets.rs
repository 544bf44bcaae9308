//! Held vertices that must get elsewhere are led there, no faster than the cloth follows: led alone, the few that move would
//! tear at the others.

use crate::Vec3;
use crate::linear::hessian::scattered;
use crate::optimize::descent::Descent;

/// Longest way that held vertices are led at a time, over the mean edge, and the shortest.
const MOST: f64 = 0.5;
const LEAST: f64 = 1e-3;
/// The longest where cloth rubs: what slides is held by the pressure before the way, and would slide too far along a long one.
const MOST_RUBBING: f64 = 0.1;
/// Mean part of the steps of a block below which the cloth did not follow those that were led: they wait, and go less far.
const FOLLOWS: f64 = 0.1;
/// What a Newton step would win over the elastic energy, above which they wait, too.
const TAUT: f64 = 0.5;
/// What a step of held vertices may raise the energy by, over what is stored and the lifting of the cloth, and how often it
/// is quartered for that.
const TEARS: f64 = 10.0;
const SHORTENED: usize = 4;
/// Strain above which cloth that is led would long be torn, and held vertices wait: yarns of elastane break there or a little
/// later, no fabric comes near.
const TORN: f64 = 3.0;
/// Part of its strain to which torn cloth must ease in so many blocks, if what it hangs at is to let it through.
const EASED: f64 = 0.9;
const PATIENCE: u32 = 12;
/// Part of a step of held vertices that shows what it changes in the forces.
const TOUCH: f64 = 1e-3;

/// How held vertices are led.
#[derive(Debug)]
pub(crate) struct Leading {
    /// How far next, over the mean edge.
    way: f64,
    /// Do they wait for the cloth?
    waits: bool,
    /// Least strain of cloth that is torn by now, and blocks since it was; infinite where it is not.
    torn: f64,
    since: u32,
}

impl Default for Leading {
    fn default() -> Self {
        Self { way: MOST, waits: false, torn: f64::INFINITY, since: 0 }
    }
}

impl Leading {
    /// After a block of steps of this mean part, from a state from which a Newton step would win so much.
    pub fn adapt(&mut self, mean: f64, decrement: f64) {
        let follows = mean >= FOLLOWS;
        // Sewing never looks at the rest.
        self.waits = !follows || decrement.is_finite() && decrement > TAUT;
        self.way = (self.way * if follows { 2.0 } else { 0.5 }).clamp(LEAST, MOST);
    }

    /// After a look at the strain.
    fn strained(&mut self, strain: f64) {
        if strain <= TORN {
            (self.torn, self.since) = (f64::INFINITY, 0);
        } else if strain < EASED * self.torn {
            (self.torn, self.since) = (strain, 0);
        } else {
            self.since += 1;
        }
    }
}

impl Descent<'_> {
    /// Does something hold the cloth back, so that it would be torn before what is led has got to its place?
    pub fn is_torn(&mut self) -> bool {
        let strain = if self.pins_placed() { 0.0 } else { self.goal.strain(&self.x) };
        self.leading.strained(strain);
        self.leading.since > PATIENCE
    }

    /// Leads held vertices towards their places, as far as nothing is in the way and the cloth follows.
    pub fn lead(&mut self) {
        if self.leading.waits || self.leading.torn.is_finite() || self.pins_placed() {
            return;
        }
        let rubs = self.goal.has_rubbed() && self.goal.seams.is_none();
        let most = self.leading.way.min(if rubs { MOST_RUBBING } else { MOST }) * self.goal.edge;
        let mut step = vec![Vec3::zeros(); self.x.len()];
        for (v, at) in &self.goal.pins {
            step[*v as usize] = (at - self.x[*v as usize]).cap_magnitude(most);
        }
        self.x = self.led(step);
        if let Some(b) = &mut self.goal.barrier {
            b.took(&self.x);
        }
        self.start_anew();
    }

    /// Where a step of held vertices leads, shortened until it does not tear at the others.
    fn led(&mut self, mut step: Vec<Vec3>) -> Vec<Vec3> {
        // What lifting all of the cloth so far would take is no sign of tearing.
        let stored = self.goal.elastic(&self.x) + self.weight * self.x.len() as f64 * crate::longest(&step);
        let mut best = self.after(step.clone());
        for _ in 0..SHORTENED {
            if best.1 - self.energy <= stored || self.factor.factors == 0 {
                break;
            }
            let along = self.carried(&step);
            let along = self.after(along);
            if along.1 < best.1 {
                best = along;
            }
            if best.1 - self.energy <= TEARS * stored {
                break;
            }
            step.iter_mut().for_each(|d| *d *= 0.25);
            best = self.after(step.clone());
        }
        best.0
    }

    /// Where a step leads as far as nothing crosses, and the energy there.
    fn after(&mut self, mut step: Vec<Vec3>) -> (Vec<Vec3>, f64) {
        self.limit(&mut step);
        let place: Vec<Vec3> = self.x.iter().zip(&step).map(|(x, d)| x + d).collect();
        let (from, before) = (std::mem::replace(&mut self.x, place), self.energy);
        self.evaluate();
        let energy = std::mem::replace(&mut self.energy, before);
        (std::mem::replace(&mut self.x, from), energy)
    }

    /// A step of held vertices, and of the cloth along with them as the last metric answers to what they change in the
    /// forces.
    pub fn carried(&mut self, step: &[Vec3]) -> Vec<Vec3> {
        self.evaluate();
        let (from, force) = (self.x.clone(), self.f.clone());
        self.x.iter_mut().zip(step).for_each(|(x, d)| *x += d * TOUCH);
        self.evaluate();
        let mut d: Vec<Vec3> = self.f.iter().zip(&force).map(|(p, q)| (p - q) / TOUCH).collect();
        self.x = from;
        self.evaluate();
        self.factor.solve(&mut d);
        let (led, along) = (crate::longest(step), crate::longest(&d));
        if !along.is_finite() {
            return step.to_vec();
        }
        let mut all = scattered(&self.goal.unknown, &d, (led / along).min(1.0));
        all.iter_mut().zip(step).for_each(|(d, s)| *d += s);
        all
    }
}
