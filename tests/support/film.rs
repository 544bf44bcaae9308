//! The result of a motion: frames, and what is read off them over time.

use super::draped::positions;
use super::program::Ended;
use std::f64::consts::TAU;
use std::ops::Range;
use toile_garment::Vec3;

/// Name of the first frame, as `animate` is told it.
pub const FIRST: &str = "{out}/frame-0000.obj";

/// Places of all vertices in every frame, m.
pub struct Film {
    /// Frames in a second; the first is at time 0.
    pub fps: f64,
    pub shots: Vec<Vec<Vec3>>,
}

/// A quantity over time, the first value at time 0.
#[derive(Clone, Debug)]
pub struct Signal {
    /// s.
    pub dt: f64,
    pub values: Vec<f64>,
}

impl Film {
    /// Reads the frames that `animate` wrote.
    pub fn read(run: &Ended, fps: f64) -> Result<Self, String> {
        let mut shots = Vec::new();
        while let Ok(shot) = positions(run, &format!("frame-{:04}.obj", shots.len())) {
            shots.push(shot);
        }
        if shots.is_empty() { Err(format!("no frames: {}", run.said)) } else { Ok(Self { fps, shots }) }
    }

    pub fn signal(&self, of: impl Fn(&[Vec3]) -> f64) -> Signal {
        Signal { dt: 1.0 / self.fps, values: self.shots.iter().map(|s| of(s)).collect() }
    }
}

impl Signal {
    /// Times at which it goes through zero, on a straight line between frames, s.
    pub fn zeros(&self) -> Vec<f64> {
        let pairs = self.values.windows(2).enumerate().filter(|(_, w)| (w[0] < 0.0) != (w[1] < 0.0));
        pairs.map(|(i, w)| self.dt * (i as f64 + w[0] / (w[0] - w[1]))).collect()
    }

    /// Mean period from the first zero to the last, s.
    pub fn period(&self) -> Result<f64, String> {
        let zeros = self.zeros();
        if zeros.len() < 3 {
            return Err(format!("{} zeros in {:.2} s", zeros.len(), self.dt * self.values.len() as f64));
        }
        Ok(2.0 * (zeros[zeros.len() - 1] - zeros[0]) / (zeros.len() - 1) as f64)
    }

    /// Largest values, each from a parabola through three frames.
    pub fn peaks(&self) -> Vec<f64> {
        let tops = self.values.windows(3).filter(|w| w[1] > w[0] && w[1] >= w[2]);
        let over = |w: &[f64]| (w[2] - w[0]) * (w[2] - w[0]) / (8.0 * (2.0 * w[1] - w[0] - w[2]));
        tops.map(|w| w[1] + over(w)).collect()
    }

    /// Frequency of a wave that neither grows nor dies, 1/s: a first guess, mended until its phase is the same in both
    /// halves.
    pub fn omega(&self) -> Result<f64, String> {
        let mut omega = TAU / self.period()?;
        let middle = self.values.len() / 2;
        for _ in 0..6 {
            let (early, late) = (self.phase(omega, 0..middle), self.phase(omega, middle..2 * middle));
            let turn = late - early;
            omega -= (turn - TAU * (turn / TAU).round()) / (self.dt * middle as f64);
        }
        Ok(omega)
    }

    /// φ of the nearest `R cos(ω t − φ)` in some frames.
    fn phase(&self, omega: f64, frames: Range<usize>) -> f64 {
        let [mut cc, mut cs, mut ss, mut xc, mut xs] = [0.0; 5];
        for i in frames {
            let (s, c) = libm::sincos(omega * self.dt * i as f64);
            let x = self.values[i];
            (cc, cs, ss, xc, xs) = (cc + c * c, cs + c * s, ss + s * s, xc + x * c, xs + x * s);
        }
        libm::atan2(cc * xs - cs * xc, ss * xc - cs * xs)
    }
}
