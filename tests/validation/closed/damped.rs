//! A damped oscillator, `x″ + 2ζω x′ + ω² x = 0`, let go from rest at 1.

use std::f64::consts::TAU;

#[derive(Clone, Copy, Debug)]
pub struct Oscillator {
    /// Undamped, 1/s.
    pub omega: f64,
    /// Damping over the critical one, below 1.
    pub zeta: f64,
}

impl Oscillator {
    /// Natural logarithm of the ratio of one peak to the next.
    pub fn decrement(&self) -> f64 {
        TAU * self.zeta / self.root()
    }

    /// Energy over that one period before.
    pub fn energy_ratio(&self) -> f64 {
        libm::exp(-2.0 * self.decrement())
    }

    pub fn at(&self, t: f64) -> f64 {
        let turn = self.omega * self.root() * t;
        libm::exp(-self.zeta * self.omega * t) * (libm::cos(turn) + self.zeta / self.root() * libm::sin(turn))
    }

    fn root(&self) -> f64 {
        (1.0 - self.zeta * self.zeta).sqrt()
    }
}
