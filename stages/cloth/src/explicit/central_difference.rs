//! Central differences (paper equations 8–14), written with the velocity at half steps, which is the same scheme:
//! `v⁺ = ((1 − c Δt/2) v⁻ + Δt f/m) / (1 + c Δt/2)`, `X⁺ = X + Δt v⁺`, with c = C_d/m. Started at rest.
//!
//! Forces are taken at `X + β v`: to first order that adds the force −β K v, a damping of the shortest waves.

use crate::Vec3;
use crate::explicit::problem::Problem;

/// Positions and velocities.
#[derive(Clone, Debug)]
pub(crate) struct State {
    pub x: Vec<Vec3>,
    pub v: Vec<Vec3>,
    /// Work arrays of a step.
    next: Vec<Vec3>,
    force: Vec<Vec3>,
}

impl State {
    pub fn at_rest(x: Vec<Vec3>) -> Self {
        let zero = vec![Vec3::zeros(); x.len()];
        Self { next: x.clone(), v: zero.clone(), force: zero, x }
    }

    pub fn copy_motion(&mut self, o: &Self) {
        self.x.copy_from_slice(&o.x);
        self.v.copy_from_slice(&o.v);
    }
}

/// One step of `dt`.
pub(crate) fn step(p: &mut Problem, s: &mut State, dt: f64) {
    let beta = p.stiffness_damping * dt;
    for (y, (x, v)) in s.next.iter_mut().zip(s.x.iter().zip(&s.v)) {
        *y = x + v * beta;
    }
    p.forces(&s.next, &mut s.force);
    let half = 0.5 * p.damping * dt;
    let (keep, push) = ((1.0 - half) / (1.0 + half), dt / (1.0 + half));
    for ((v, f), w) in s.v.iter_mut().zip(&s.force).zip(&p.inverse_mass) {
        *v = *v * keep + f * (push * w);
    }
    p.constrain_velocities(&mut s.v, &s.x, dt);
    for (y, (x, v)) in s.next.iter_mut().zip(s.x.iter().zip(&s.v)) {
        *y = x + v * dt;
    }
    p.constrain_positions(&s.x, &mut s.next, &mut s.v, dt);
    std::mem::swap(&mut s.x, &mut s.next);
}
