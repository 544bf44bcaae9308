//! Stretch laws: a curve as a table of tangents at equal strains, linear between them.
//!
//! Tension and energy are the exact integrals of the table and cost no exponential. The tangent may be capped for
//! explicit steps. The slope at the present strain is the stiffness c_e of equations 2 and 3 of the paper.

use crate::energy::strain_limit::{Bias, Lock};
use crate::energy::tuning::{LAW_CELLS, LAW_CELLS_OF_SAMPLES, LAW_REACH_LIMITS, LAW_REACH_UNLIMITED};
use crate::{Curve, Integrator, Material, Settings, Switch};

/// Bounds of the strain up to which the table of a fabric with a limit goes.
const REACH_BOUNDS: [f64; 2] = [0.02, 2.0];

/// A cell of the table.
#[derive(Clone, Copy, Debug, Default)]
struct Cell {
    /// Strain at which it begins.
    from: f64,
    /// Tension there, N/m.
    tension: f64,
    /// Slope of the tension there, N/m.
    tangent: f64,
    /// Growth of the slope with the strain, N/m.
    bow: f64,
    /// Energy there, J/m².
    energy: f64,
}

/// Tabulated stretch law of one direction.
#[derive(Clone, Debug)]
pub(crate) struct Law {
    inverse_step: f64,
    step: f64,
    /// The first cell is for compressed cloth, the last for all beyond the table; both are straight.
    cells: Vec<Cell>,
    lock: Lock,
}

/// The cells of a table of tangents at equal steps.
fn cells(tangent: &[f64], step: f64) -> Vec<Cell> {
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
    all
}

impl Law {
    /// The law of a curve up to `reach` strain, a straight line beyond, with its tangent capped, N/m.
    ///
    /// `limit` is the strain at which the cloth locks, infinite for never.
    pub fn new(curve: &Curve, cap: f64, reach: f64, limit: f64) -> Self {
        let cells = match curve {
            Curve::Linear { .. } => 1,
            Curve::Samples(_) => LAW_CELLS_OF_SAMPLES.get(),
            Curve::Exponential { .. } => LAW_CELLS.get(),
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
        let lock = Lock::at(limit, if limit.is_finite() { curve.tension(limit) } else { 0.0 });
        Self { inverse_step: 1.0 / step, step, cells: self::cells(&tangent, step), lock }
    }

    /// The force that measured samples carry over a straight line of their smallest slope. `None` where there are no
    /// samples.
    pub fn above_least_slope(curve: &Curve, cap: f64) -> Option<Self> {
        let above = curve.above_least_slope()?;
        let reach = above.last()?[0];
        let curve = Curve::Samples(above);
        let step = reach / LAW_CELLS_OF_SAMPLES.get() as f64;
        // The slope over both cells around a place keeps the tension there exact, but for the cells beside a sample.
        let odd = |e: f64| curve.tension(e.abs()).copysign(e);
        let slope = |i: usize| {
            let e = step * i as f64;
            ((odd(e + step) - odd(e - step)) / (2.0 * step)).clamp(0.0, cap)
        };
        let tangent: Vec<f64> = (0..=LAW_CELLS_OF_SAMPLES.get()).map(slope).collect();
        Some(Self { inverse_step: 1.0 / step, step, cells: cells(&tangent, step), lock: Lock::at(f64::INFINITY, 0.0) })
    }

    /// Tension and energy of a law that is the same in both senses.
    #[inline]
    pub fn odd(&self, strain: f64) -> (f64, f64) {
        let (tension, energy) = self.tension_and_energy(strain.abs());
        (tension.copysign(strain), energy)
    }

    /// Returns `true` if it carries more than its curve at this strain.
    fn is_locking(&self, strain: f64) -> bool {
        strain > self.lock.from
    }

    #[inline(always)]
    fn cell(&self, strain: f64) -> &Cell {
        let u = strain * self.inverse_step;
        let last = self.cells.len() - 1;
        &self.cells[if u > 0.0 { (u as usize).saturating_add(1).min(last) } else { 0 }]
    }

    /// Tension, N/m, and energy, J/m².
    #[inline(always)]
    pub fn tension_and_energy(&self, strain: f64) -> (f64, f64) {
        let &Cell { from, tension: t, tangent: k, bow, energy } = self.cell(strain);
        let on = strain - from;
        let (t, energy) = (t + on * (k + 0.5 * on * bow), energy + on * (t + on * (0.5 * k + on * bow * (1.0 / 6.0))));
        if strain <= self.lock.from {
            return (t, energy);
        }
        let [tension, stored, _] = self.lock.over(strain);
        (t + tension, energy + stored)
    }

    /// Tension, N/m.
    #[inline(always)]
    pub fn tension(&self, strain: f64) -> f64 {
        self.tension_and_energy(strain).0
    }

    /// Energy, J/m².
    pub fn energy(&self, strain: f64) -> f64 {
        self.tension_and_energy(strain).1
    }

    /// Slope dT/dε as interpolated, N/m.
    #[inline]
    pub fn slope(&self, strain: f64) -> f64 {
        let lock = if strain <= self.lock.from { 0.0 } else { self.lock.over(strain)[2] };
        let cell = self.cell(strain);
        lock + cell.tangent + (strain - cell.from) * cell.bow
    }

    /// A bound of the slope around a strain, N/m, without the lock.
    pub fn tangent(&self, strain: f64) -> f64 {
        let cell = self.cell(strain);
        cell.tangent.max(cell.tangent + self.step * cell.bow)
    }
}

/// The laws of a fabric: both directions, shear and bias.
#[derive(Clone, Debug)]
pub(crate) struct Fabric {
    pub weft: Law,
    pub warp: Law,
    pub bias: Bias,
    /// Shear stiffness G, N/m per radian.
    pub shear: f64,
    /// Coupling modulus of warp and weft, N/m.
    pub cross: f64,
}

impl Fabric {
    /// The laws of a material for these settings.
    pub fn new(m: &Material, s: &Settings) -> Self {
        let locks = s.integrator != Integrator::CentralDifference && s.effects.strain_limit != Switch::Off;
        let lock = |limit: f64| if locks { limit } else { f64::INFINITY };
        // A straight curve has one cell whatever its limit, so a limit that is not reached changes no bit.
        let reach = |curve: &Curve, limit: f64| match curve {
            Curve::Linear { .. } => LAW_REACH_UNLIMITED.get(),
            _ if limit.is_finite() => (LAW_REACH_LIMITS.get() * limit).clamp(REACH_BOUNDS[0], REACH_BOUNDS[1]),
            _ => LAW_REACH_UNLIMITED.get(),
        };
        let law = |curve: &Curve, limit: f64| Law::new(curve, s.curve_cap(), reach(curve, limit), lock(limit));
        let [along_warp, along_weft, on_bias] = m.strain_limit;
        let (warp, weft) = (law(&m.warp, along_warp), law(&m.weft, along_weft));
        let softer = if on_bias.is_finite() { m.warp.tension(on_bias).min(m.weft.tension(on_bias)) } else { 0.0 };
        let cross = m.poisson * warp.tangent(0.0).min(weft.tangent(0.0));
        Self { weft, warp, bias: Bias::at(lock(on_bias), softer), shear: m.shear, cross }
    }

    /// Lets it lock over this share of its limits. Returns `true` if that is a change.
    pub fn lock_over(&mut self, locking: f64) -> bool {
        self.weft.lock.lock_over(locking) | self.warp.lock.lock_over(locking) | self.bias.lock_over(locking)
    }

    /// Returns `true` if it carries more than its curves at these stretches along weft and warp and this Green strain.
    pub fn is_locking(&self, [weft, warp]: [f64; 2], green: &[f64; 3]) -> bool {
        self.weft.is_locking(weft - 1.0) || self.warp.is_locking(warp - 1.0) || self.bias.is_locking(green)
    }
}
