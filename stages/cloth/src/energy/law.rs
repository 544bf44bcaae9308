//! A stretch curve as a table: tangents at equal strains, linear between, so that tension and energy are its exact
//! integrals and cost no exponential. The tangent may be capped (validation §8.5).

use crate::{Curve, Integrator, Material, Settings, Switch};

/// Cells of a table; more where it must show how the cloth locks.
const CELLS: usize = 256;
const CELLS_LOCKING: usize = 1024;
/// Share of the strain limit at which the cloth begins to lock, and at which it is locked …
pub(crate) const LOCKING: f64 = 0.99;
const SHUT: f64 = 0.996;
/// … and the tension that it carries there over that of its curve, N/m.
const LOCKED: f64 = 1000.0;

/// Tabulated stretch law of one direction.
#[derive(Clone, Debug)]
pub(crate) struct Law {
    inverse_step: f64,
    step: f64,
    tangent: Vec<f64>,
    tension: Vec<f64>,
    energy: Vec<f64>,
}

impl Law {
    /// Up to `reach` strain (a straight line beyond), with the tangent capped; `lock`: the strain at which the cloth
    /// locks (infinite for never).
    pub fn new(curve: &Curve, cap: f64, reach: f64, lock: f64) -> Self {
        let plain = matches!(curve, Curve::Linear { .. }) && lock.is_infinite();
        let cells = match (plain, lock.is_finite()) {
            (true, _) => 1,
            (_, true) => CELLS_LOCKING,
            _ => CELLS,
        };
        let step = reach / cells as f64;
        let mut tangent: Vec<f64> = (0..=cells)
            .map(|i| match curve {
                // The mean slope of the cell keeps the tension at its ends exact for measured samples.
                Curve::Samples(_) => {
                    let e = step * i as f64;
                    ((curve.tension(e + step) - curve.tension(e)) / step).min(cap)
                }
                _ => curve.tangent(step * i as f64).min(cap),
            })
            .collect();
        if lock.is_finite() {
            for (i, k) in tangent.iter_mut().enumerate() {
                let near = (step * i as f64 / lock - LOCKING) / (SHUT - LOCKING);
                *k += near.clamp(0.0, 1.0) * 2.0 * LOCKED / ((SHUT - LOCKING) * lock);
            }
        }
        let (mut tension, mut energy) = (vec![0.0], vec![0.0]);
        for i in 0..cells {
            let (t, k0, k1) = (tension[i], tangent[i], tangent[i + 1]);
            energy.push(energy[i] + step * (t + step * (k0 / 2.0 + (k1 - k0) / 6.0)));
            tension.push(t + step * 0.5 * (k0 + k1));
        }
        Self { inverse_step: 1.0 / step, step, tangent, tension, energy }
    }

    #[inline]
    fn cell(&self, strain: f64) -> Option<(usize, f64)> {
        let u = strain * self.inverse_step;
        let i = u as usize;
        (u > 0.0 && i < self.tangent.len() - 1).then_some((i, strain - self.step * i as f64))
    }

    /// Tension, N/m, and energy, J/m².
    #[inline(always)]
    pub fn both(&self, strain: f64) -> (f64, f64) {
        let (from, t, k, bow, energy) = match self.cell(strain) {
            Some((i, r)) => {
                let bow = (self.tangent[i + 1] - self.tangent[i]) * self.inverse_step;
                (r, self.tension[i], self.tangent[i], bow, self.energy[i])
            }
            None if strain <= 0.0 => (strain, 0.0, self.tangent[0], 0.0, 0.0),
            None => {
                let n = self.tangent.len() - 1;
                (strain - self.step * n as f64, self.tension[n], self.tangent[n], 0.0, self.energy[n])
            }
        };
        (t + from * (k + 0.5 * from * bow), energy + from * (t + from * (0.5 * k + from * bow / 6.0)))
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
        match self.cell(strain) {
            Some((i, r)) => self.tangent[i] + r * (self.tangent[i + 1] - self.tangent[i]) * self.inverse_step,
            None if strain <= 0.0 => self.tangent[0],
            None => self.tangent[self.tangent.len() - 1],
        }
    }

    /// A bound of the slope around a strain, N/m.
    pub fn tangent(&self, strain: f64) -> f64 {
        match self.cell(strain) {
            Some((i, _)) => self.tangent[i].max(self.tangent[i + 1]),
            None if strain <= 0.0 => self.tangent[0],
            None => self.tangent[self.tangent.len() - 1],
        }
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
        let beyond = if locks { 1.1 } else { 1.5 };
        let reach = |limit: f64| if limit.is_finite() { (beyond * limit).clamp(0.02, 2.0) } else { 0.5 };
        let law = |curve: &Curve, limit: f64| {
            Law::new(curve, s.curve_cap(), reach(limit), if locks { limit } else { f64::INFINITY })
        };
        let (warp, weft) = (law(&m.warp, m.strain_limit[0]), law(&m.weft, m.strain_limit[1]));
        let cross = m.poisson * warp.tangent(0.0).min(weft.tangent(0.0));
        Self { weft, warp, shear: m.shear, cross }
    }
}
