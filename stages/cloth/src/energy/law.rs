//! A stretch curve as a table: tangents at equal strains, linear between, so that tension and energy are its exact
//! integrals and cost no exponential. The tangent may be capped (validation §8.5).

use crate::{Curve, Integrator, Material, Settings, Switch};

/// Cells of a table, more for kinks of measured curves, and how far over the limit it goes.
const CELLS: usize = 256;
const CELLS_OF_SAMPLES: usize = 1024;
const BEYOND: f64 = 1.5;
/// Share of the strain limit at which the cloth is locked, and what it takes to lock before that, as a share of the limit: more
/// of a small limit (to 4 % of one of 1 %, width · limit in between), beside which single precision else knows too little of
/// the soft motions, and a sheet took thousands of steps …
const SHUT: f64 = 0.9975;
const LOCKING: f64 = 0.005;
const MOST_LOCKING: f64 = 0.04;
const WIDTH_OF_SMALL: f64 = 4e-6;
/// … and the tension that it carries there over that of its curve, N/m.
const LOCKED: f64 = 900.0;
/// How much faster it grows beyond, up to so many widths on: so that a band drawn over gathers stays within its limit. Only so far,
/// because cloth that comes from a coarser mesh begins far beyond in places, and must find back.
const SHUTTING: f64 = 4.0;
const SHUT_AFTER: f64 = 0.5;

/// What a locking cloth carries over its curve: a tension that grows with the square of the strain from where it begins, and
/// faster just after it is locked. Below it adds nothing, so that a limit that is not reached changes no bit.
#[derive(Clone, Copy, Debug)]
struct Lock {
    from: f64,
    /// Strain from its beginning to where the cloth is locked.
    width: f64,
}

impl Lock {
    /// Infinite for never; over at least `locking` of the limit.
    fn at(limit: f64, locking: f64) -> Self {
        if !limit.is_finite() {
            return Self { from: limit, width: 1.0 };
        }
        let width = (locking.max(LOCKING) * limit).max((MOST_LOCKING * limit).min(WIDTH_OF_SMALL / limit));
        Self { from: SHUT * limit - width, width }
    }

    /// Tension, N/m, energy, J/m², and slope, N/m, at a strain over `from`.
    fn over(&self, strain: f64) -> [f64; 3] {
        let near = (strain - self.from) / self.width;
        let (rise, on) = (near.min(1.0), (near - 1.0).max(0.0));
        let first = on.min(SHUT_AFTER);
        let rest = on - first;
        let tension = rise * rise + 2.0 * on + SHUTTING * first * (first + 2.0 * rest);
        let energy = rise * rise * rise / 3.0
            + on * (1.0 + on)
            + SHUTTING * first * (first * first / 3.0 + rest * (first + rest));
        let slope = 2.0 * (rise + SHUTTING * first) / self.width;
        [LOCKED * tension, LOCKED * self.width * energy, LOCKED * slope]
    }
}

/// Strain from which cloth with this limit locks.
pub(crate) fn locks_from(limit: f64) -> f64 {
    Lock::at(limit, 0.0).from
}

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
    limit: f64,
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
        Self { inverse_step: 1.0 / step, step, cells: all, limit, lock: Lock::at(limit, 0.0) }
    }

    /// Lets the cloth lock over this share of its limit, or over less if that is all it ever takes; says whether that is
    /// anything new.
    fn lock_over(&mut self, locking: f64) -> bool {
        let before = std::mem::replace(&mut self.lock, Lock::at(self.limit, locking));
        before.width != self.lock.width
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

/// Both directions and the shear of a fabric.
#[derive(Clone, Debug)]
pub(crate) struct Fabric {
    pub weft: Law,
    pub warp: Law,
    pub shear: f64,
    /// Coupling modulus of warp and weft, N/m.
    pub cross: f64,
}

impl Fabric {
    pub fn new(m: &Material, s: &Settings) -> Self {
        let locks = s.integrator == Integrator::Static && s.effects.strain_limit != Switch::Off;
        let reach = |limit: f64| if limit.is_finite() { (BEYOND * limit).clamp(0.02, 2.0) } else { 0.5 };
        let law = |curve: &Curve, limit: f64| {
            Law::new(curve, s.curve_cap(), reach(limit), if locks { limit } else { f64::INFINITY })
        };
        let (warp, weft) = (law(&m.warp, m.strain_limit[0]), law(&m.weft, m.strain_limit[1]));
        let cross = m.poisson * warp.tangent(0.0).min(weft.tangent(0.0));
        Self { weft, warp, shear: m.shear, cross }
    }

    /// [`Law::lock_over`] of both directions.
    pub fn lock_over(&mut self, locking: f64) -> bool {
        self.weft.lock_over(locking) | self.warp.lock_over(locking)
    }

    /// Does it carry more than its curves at these stretches along weft and warp?
    pub fn is_locking(&self, [weft, warp]: [f64; 2]) -> bool {
        self.weft.is_locking(weft - 1.0) || self.warp.is_locking(warp - 1.0)
    }
}
