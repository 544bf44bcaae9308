//! TR-BDF2 (Bank et al. 1985): a trapezoidal stage over γ = 2 − √2 of the step, then backward differences of second
//! order over all of it. Second order, L-stable, and both stages share h = (1 − 1/√2) Δt, so also the metric.
//! A stage in which the cloth runs into something is done by implicit Euler instead.
//! Contact and friction act at the end of each stage only: their force belongs to where the cloth gets to.

use crate::Vec3;
use crate::energy::inertia::Inertia;
use nalgebra::Matrix3;
use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

/// Share of the step after the first stage, γ.
pub(crate) const FIRST: f64 = 2.0 - SQRT_2;
/// h / Δt.
const HALF: f64 = 1.0 - FRAC_1_SQRT_2;
/// Weights of the middle and of the start in the second stage.
const MIDDLE: f64 = 0.5 * (SQRT_2 + 1.0);
const START: f64 = MIDDLE - 1.0;

/// Places and velocities.
#[derive(Clone, Debug)]
pub(crate) struct State {
    pub x: Vec<Vec3>,
    pub v: Vec<Vec3>,
}

fn join(a: &[Vec3], b: &[Vec3], f: impl Fn(&Vec3, &Vec3) -> Vec3) -> Vec<Vec3> {
    a.iter().zip(b).map(|(a, b)| f(a, b)).collect()
}

/// The trapezoidal stage from `s` under the forces `f` there (contact left out, damping included).
pub(crate) fn first(s: &State, f: &[Vec3], mass: &[f64], viscous: Vec<Matrix3<f64>>, dt: f64) -> Inertia {
    let h = HALF * dt;
    let mut target = join(&s.x, &s.v, |x, v| x + v * (2.0 * h));
    for ((t, f), m) in target.iter_mut().zip(f).zip(mass).filter(|(_, m)| **m > 0.0) {
        *t += f * (h * h / m);
    }
    let base = join(&s.x, &s.v, |x, v| x + v * h);
    Inertia { mass: mass.to_vec(), rate: 0.5 / (h * h), share: 0.5, target, base, h, viscous }
}

/// The second stage, from the start and what the first stage gave.
pub(crate) fn second(s: &State, middle: &State, mass: &[f64], viscous: Vec<Matrix3<f64>>, dt: f64) -> Inertia {
    let h = HALF * dt;
    let base = join(&middle.x, &s.x, |m, s| m * MIDDLE - s * START);
    let pace = join(&middle.v, &s.v, |m, s| m * MIDDLE - s * START);
    let target = join(&base, &pace, |b, v| b + v * h);
    Inertia { mass: mass.to_vec(), rate: 1.0 / (h * h), share: 1.0, target, base, h, viscous }
}

/// A step of implicit Euler from `s`, for what is no smooth motion: an impact, or forces no stage comes to an end with. It
/// takes nothing over from the forces before, so that none can kick back.
pub(crate) fn plain(s: &State, mass: &[f64], viscous: Vec<Matrix3<f64>>, span: f64) -> Inertia {
    let target = join(&s.x, &s.v, |x, v| x + v * span);
    Inertia { mass: mass.to_vec(), rate: 1.0 / (span * span), share: 1.0, target, base: s.x.clone(), h: span, viscous }
}

/// Velocities at the end of a stage.
pub(crate) fn velocities(stage: &Inertia, x: &[Vec3]) -> Vec<Vec3> {
    join(x, &stage.base, |x, b| (x - b) / stage.h)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One step of a free spring by hand: both stages are linear in x.
    fn step(s: &State, w2: f64, dt: f64) -> State {
        let none = || vec![Matrix3::zeros()];
        let solve = |i: &Inertia| {
            let x = i.target[0] * i.rate / (i.rate + i.share * w2);
            State { v: velocities(i, &[x]), x: vec![x] }
        };
        let middle = solve(&first(s, &[s.x[0] * -w2], &[1.0], none(), dt));
        solve(&second(s, &middle, &[1.0], none(), dt))
    }

    fn error(dt: f64) -> f64 {
        let w = 3.0;
        let mut s = State { x: vec![Vec3::x()], v: vec![Vec3::zeros()] };
        let n = (2.0 / dt).round() as usize;
        (0..n).for_each(|_| s = step(&s, w * w, dt));
        (s.x[0].x - libm::cos(w * 2.0)).abs()
    }

    #[test]
    fn the_scheme_is_of_second_order() {
        let ratio = error(0.02) / error(0.01);
        assert!((ratio - 4.0).abs() < 0.3, "{ratio}");
    }

    #[test]
    fn stiff_springs_come_to_rest_at_once() {
        let w2 = 1e12;
        let s = step(&State { x: vec![Vec3::x()], v: vec![Vec3::zeros()] }, w2, 0.1);
        // Energy left of ½ w² x².
        let left = s.x[0].norm_squared() + s.v[0].norm_squared() / w2;
        assert!(left < 1e-8, "{left}: {s:?}");
    }
}
