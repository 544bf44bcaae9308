//! Central differences (equations 8–14 of the paper).
//!
//! They are written here with the velocity at half steps, which is the same scheme.
//! `v⁺ = ((1 − c Δt/2) v⁻ + Δt f/m) / (1 + c Δt/2)`, `X⁺ = X + Δt v⁺`, with c = C_d/m of equation 7. The start is at
//! rest (equation 13).
//!
//! Forces are taken at `X + β v`. To first order that adds the force −β K v, a damping of the shortest waves.

use crate::Vec3;
use crate::explicit::problem::Problem;

/// Largest coordinate of cloth that is not lost, m. Beyond it a run has become unstable.
const COORDINATE_MAX: f64 = 1e6;

/// Positions of all vertices at a time, and their velocities half a step before.
#[derive(Clone, Debug)]
pub(crate) struct State {
    /// Positions, m.
    pub x: Vec<Vec3>,
    /// Velocities, m/s.
    pub v: Vec<Vec3>,
    /// Work array of a step: positions.
    next: Vec<Vec3>,
    /// Work array of a step: forces, N.
    force: Vec<Vec3>,
}

impl State {
    /// The state of cloth at rest at `x` (equation 13).
    pub fn at_rest(x: Vec<Vec3>) -> Self {
        let zero = vec![Vec3::zeros(); x.len()];
        Self { next: x.clone(), v: zero.clone(), force: zero, x }
    }

    /// Returns `true` if every position is a number and lies where cloth can be.
    pub fn is_in_range(&self) -> bool {
        self.x.iter().all(|p| p.amax() < COORDINATE_MAX)
    }

    /// Takes over the positions and velocities of another state of the same cloth.
    pub fn copy_motion(&mut self, other: &Self) {
        self.x.copy_from_slice(&other.x);
        self.v.copy_from_slice(&other.v);
    }
}

/// Advances the state by one step of `dt` seconds.
pub(crate) fn step(p: &mut Problem, s: &mut State, dt: f64) {
    let beta = p.damping.stiffness_steps * dt;
    for (y, (x, v)) in s.next.iter_mut().zip(s.x.iter().zip(&s.v)) {
        *y = x + v * beta;
    }
    p.forces(&s.next, &mut s.force);
    let half = 0.5 * p.damping.rate * dt;
    let (keep, push) = ((1.0 - half) / (1.0 + half), dt / (1.0 + half));
    for ((v, f), w) in s.v.iter_mut().zip(&s.force).zip(&p.masses.inverse) {
        *v = *v * keep + f * (push * w);
    }
    p.constrain_velocities(&mut s.v, &s.x, dt);
    for (y, (x, v)) in s.next.iter_mut().zip(s.x.iter().zip(&s.v)) {
        *y = x + v * dt;
    }
    p.constrain_positions(&s.x, &mut s.next, &mut s.v, dt);
    std::mem::swap(&mut s.x, &mut s.next);
}
