//! A stretch curve as a table: tangents at equal strains, linear between, so that tension and energy are its exact
//! integrals and cost no exponential. The tangent may be capped.

use crate::energy::strain_limit::{Bias, Lock};
use crate::{Curve, Integrator, Material, Settings, Switch};

/// Cells of a table, more for kinks of measured curves, and how far over the limit it goes.
const CELLS: usize = 256;
const CELLS_OF_SAMPLES: usize = 1024;
const BEYOND: f64 = 1.5;
/// Strain up to which a table goes otherwise.
const UNLIMITED: f64 = 0.5;

/// A piece of a law: what it has where it begins, and how its tangent grows.
#[derive(Clone, Copy, Debug, Default)]
struct Cell {
    from: f64,
    tension: f64,
    tangent: f64,
    bow: f64,
    energy: f64,
}

/// Tabulated stretch law of one direction.
#[derive(Clone, Debug)]
pub(crate) struct Law {
    inverse_step: f64,
    step: f64,
    /// The first for cloth pushed together, the last for all beyond the table; both straight.
    cells: Vec<Cell>,
    lock: Lock,
}

impl Law {
    /// Up to `reach` strain (a straight line beyond), with the tangent capped; `limit`: the strain at which the cloth
    /// locks (infinite for never).
    pub fn new(curve: &Curve, cap: f64, reach: f64, limit: f64) -> Self {
        let cells = match curve {
            Curve::Linear { .. } => 1,
            Curve::Samples(_) => CELLS_OF_SAMPLES,
            Curve::Exponential { .. } => CELLS,
        };
        let step = reach / cells as f64;
        let tangent: Vec<f64> = (0..=cells)
            .map(|i| match curve {
                // The mean slope of the cell keeps the tension at its ends exact for measured samples.
                Curve::Samples(_) => {
                    let e = step * i as f64;
                    ((curve.tension(e + step) - curve.tension(e)) / step).min(cap)
                }
                _ => curve.tangent(step * i as f64).min(cap),
            })
            .collect();
        let mut last = Cell { tangent: tangent[0], ..Cell::default() };
        let mut all = vec![last];
        for (i, k) in tangent.windows(2).enumerate() {
            let bow = (k[1] - k[0]) * (1.0 / step);
            all.push(Cell { bow, ..last });
            let (tension, energy) = (
                last.tension + step * 0.5 * (k[0] + k[1]),
                last.energy + step * (last.tension + step * (k[0] / 2.0 + (k[1] - k[0]) / 6.0)),
            );
            last = Cell { from: step * (i + 1) as f64, tension, tangent: k[1], bow: 0.0, energy };
        }
        all.push(last);
        let lock = Lock::at(limit, if limit.is_finite() { curve.tension(limit) } else { 0.0 });
        Self { inverse_step: 1.0 / step, step, cells: all, lock }
    }

    /// Does it carry more than its curve at this strain?
    fn is_locking(&self, strain: f64) -> bool {
        strain > self.lock.from
    }

    #[inline(always)]
    fn cell(&self, strain: f64) -> &Cell {
        let u = strain * self.inverse_step;
        let last = self.cells.len() - 1;
        &self.cells[if u > 0.0 { (u as usize + 1).min(last) } else { 0 }]
    }

    /// Tension, N/m, and energy, J/m².
    #[inline(always)]
    pub fn both(&self, strain: f64) -> (f64, f64) {
        let &Cell { from, tension: t, tangent: k, bow, energy } = self.cell(strain);
        let on = strain - from;
        let (t, energy) = (t + on * (k + 0.5 * on * bow), energy + on * (t + on * (0.5 * k + on * bow * (1.0 / 6.0))));
        if strain <= self.lock.from {
            return (t, energy);
        }
        let [tension, stored, _] = self.lock.over(strain);
        (t + tension, energy + stored)
    }

    /// N/m.
    #[inline(always)]
    pub fn tension(&self, strain: f64) -> f64 {
        self.both(strain).0
    }

    /// J/m².
    pub fn energy(&self, strain: f64) -> f64 {
        self.both(strain).1
    }

    /// dT/dε as interpolated, N/m.
    #[inline]
    pub fn slope(&self, strain: f64) -> f64 {
        let lock = if strain <= self.lock.from { 0.0 } else { self.lock.over(strain)[2] };
        let cell = self.cell(strain);
        lock + cell.tangent + (strain - cell.from) * cell.bow
    }

    /// A bound of the slope around a strain, N/m; only unlocked laws are asked for it.
    pub fn tangent(&self, strain: f64) -> f64 {
        let cell = self.cell(strain);
        cell.tangent.max(cell.tangent + self.step * cell.bow)
    }
}

/// Both directions, the shear and the bias of a fabric.
#[derive(Clone, Debug)]
pub(crate) struct Fabric {
    pub weft: Law,
    pub warp: Law,
    pub bias: Bias,
    pub shear: f64,
    /// Coupling modulus of warp and weft, N/m.
    pub cross: f64,
}

impl Fabric {
    pub fn new(m: &Material, s: &Settings) -> Self {
        let locks = s.integrator == Integrator::Static && s.effects.strain_limit != Switch::Off;
        let lock = |limit: f64| if locks { limit } else { f64::INFINITY };
        // A straight curve is one whatever its limit: a limit that is not reached changes no bit.
        let reach = |curve: &Curve, limit: f64| match curve {
            Curve::Linear { .. } => UNLIMITED,
            _ if limit.is_finite() => (BEYOND * limit).clamp(0.02, 2.0),
            _ => UNLIMITED,
        };
        let law = |curve: &Curve, limit: f64| Law::new(curve, s.curve_cap(), reach(curve, limit), lock(limit));
        let [along_warp, along_weft, on_bias] = m.strain_limit;
        let (warp, weft) = (law(&m.warp, along_warp), law(&m.weft, along_weft));
        let softer = if on_bias.is_finite() { m.warp.tension(on_bias).min(m.weft.tension(on_bias)) } else { 0.0 };
        let cross = m.poisson * warp.tangent(0.0).min(weft.tangent(0.0));
        Self { weft, warp, bias: Bias::at(lock(on_bias), softer), shear: m.shear, cross }
    }

    /// Lets it lock over this share of its limits; says whether that is anything new.
    pub fn lock_over(&mut self, locking: f64) -> bool {
        self.weft.lock.lock_over(locking) | self.warp.lock.lock_over(locking) | self.bias.lock_over(locking)
    }

    /// Does it carry more than its curves at these stretches along weft and warp and this Green strain?
    pub fn is_locking(&self, [weft, warp]: [f64; 2], green: &[f64; 3]) -> bool {
        self.weft.is_locking(weft - 1.0) || self.warp.is_locking(warp - 1.0) || self.bias.is_locking(green)
    }
}
