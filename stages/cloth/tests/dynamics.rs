//! Motion in time against closed forms: fall, pendulum, waves, impacts, moving bodies.

mod common;

use common::{cotton, linear, noise, regular, sheet, sphere};
use std::f64::consts::PI;
use toile_cloth::{
    BodyMesh, ClothError, Dynamics, Effects, Motion, Pin, Scene, Settings, Silent, Switch, Vec3, animate, certify,
};

const G: f64 = 9.81;

fn alone() -> Settings {
    let effects = Effects { self_contact: Switch::Off, ..Effects::default() };
    Settings { effects, ..Settings::default() }
}

/// No damping, no air, solved far below what is looked at.
fn exact(step: f64) -> Dynamics {
    Dynamics { step, damping: 0.0, drag: 0.0, tolerance: 1e-8, rest_speed: 0.0 }
}

/// A moment: seconds, positions, kinetic and whole energy.
struct Shot {
    t: f64,
    x: Vec<Vec3>,
    v: Vec<Vec3>,
    body: Vec<Vec3>,
    kinetic: f64,
    energy: f64,
}

fn film(scene: &Scene, settings: &Settings, dynamics: &Dynamics, motion: &Motion) -> Vec<Shot> {
    let mut shots = Vec::new();
    let trip = animate(scene, settings, dynamics, motion, &mut Silent, &mut |f| {
        shots.push(Shot {
            t: f.seconds,
            x: f.positions.to_vec(),
            v: f.velocities.to_vec(),
            body: f.body.to_vec(),
            kinetic: f.kinetic,
            energy: f.kinetic + f.potential,
        });
    })
    .unwrap();
    assert_eq!(trip.frames, shots.len());
    shots
}

fn falling() -> Scene {
    let mut m = linear(0.2, 500.0, 500.0, 50.0);
    (m.bend_warp, m.bend_weft) = (1e-5, 1e-5);
    let mut scene = sheet(0.2, 0.2, 6, 6, m, |x, y| Vec3::new(x, 1.0, y));
    scene.gravity = Vec3::new(0.0, -G, 0.0);
    scene
}

#[test]
fn free_fall_is_exact() {
    let motion = Motion { fps: 20.0, frames: 9, ..Motion::default() };
    for shot in film(&falling(), &Settings::default(), &exact(1.0 / 60.0), &motion) {
        let fall = -0.5 * G * shot.t * shot.t;
        for (p, q) in shot.x.iter().zip(&falling().positions) {
            assert!((p.y - q.y - fall).abs() < 1e-9 && (p.x - q.x).abs() < 1e-9, "{} at {}", p.y - q.y, shot.t);
        }
    }
}

#[test]
fn a_fall_with_linear_drag_follows_the_closed_form() {
    // validation-cases fall-0: σ 0.2, c 0.5, t 0.4.
    let (sigma, c, t) = (0.2, 0.5, 0.4);
    let motion = Motion { fps: 20.0, frames: 9, ..Motion::default() };
    let dynamics = Dynamics { damping: c / sigma, ..exact(1.0 / 60.0) };
    let shots = film(&falling(), &Settings::default(), &dynamics, &motion);
    let last = shots.last().unwrap();
    let v = sigma * G / c * -libm::expm1(-c * t / sigma);
    let y = sigma * G / c * (t + sigma / c * libm::expm1(-c * t / sigma));
    assert!((last.t - t).abs() < 1e-12);
    for (p, q) in last.x.iter().zip(&falling().positions) {
        assert!(((q.y - p.y) / y - 1.0).abs() < 1e-3, "{} instead of {y}", q.y - p.y);
        assert!((p.x - q.x).abs() < 1e-9);
    }
    assert!((-last.v[0].y / v - 1.0).abs() < 1e-3, "{} instead of {v}", last.v[0].y);
}

#[test]
fn a_fall_with_air_follows_the_closed_form() {
    // m v′ = m g − c A v²: v = v∞ tanh(g t / v∞), v∞ = √(σ g / c).
    let (sigma, c) = (0.2, 0.6);
    let motion = Motion { fps: 20.0, frames: 13, ..Motion::default() };
    let dynamics = Dynamics { drag: c, ..exact(1.0 / 120.0) };
    let end = (sigma * G / c).sqrt();
    for shot in film(&falling(), &alone(), &dynamics, &motion).iter().skip(1) {
        let v = end * libm::tanh(G * shot.t / end);
        let y = end * end / G * libm::log(libm::cosh(G * shot.t / end));
        let (got, fell) = (-shot.v[24].y, 1.0 - shot.x[24].y);
        assert!((got / v - 1.0).abs() < 3e-3, "{got} instead of {v} at {}", shot.t);
        assert!((fell / y - 1.0).abs() < 3e-3, "{fell} instead of {y}");
    }
}

/// Period from the times at which a signal goes through zero, s.
fn period(shots: &[Shot], signal: impl Fn(&Shot) -> f64) -> f64 {
    let mut zeros = Vec::new();
    for w in shots.windows(2) {
        let (a, b) = (signal(&w[0]), signal(&w[1]));
        if a * b < 0.0 {
            zeros.push(w[0].t + (w[1].t - w[0].t) * a / (a - b));
        }
    }
    assert!(zeros.len() > 2, "{} zeros", zeros.len());
    2.0 * (zeros[zeros.len() - 1] - zeros[0]) / (zeros.len() - 1) as f64
}

/// A strip of `n` rows hanging from row 0 at the origin, swung out by `angle` as a whole.
fn strip(n: u32, length: f64, angle: f64, m: toile_cloth::Material) -> Scene {
    let (s, c) = libm::sincos(angle);
    let mut scene = sheet(0.04, length, 2, n, m, |x, y| Vec3::new(y * s, -y * c, x));
    scene.gravity = Vec3::new(0.0, -G, 0.0);
    scene.pins = (0..3).map(|v| Pin { vertex: v, at: scene.positions[v as usize] }).collect();
    scene
}

#[test]
fn a_stiff_strip_swings_with_the_period_of_a_rod() {
    // validation-cases pendulum-0 and -1; the tolerance of a good solver is 0.3 %.
    for (degrees, expected) in [(10.0_f64, 1.160_412_049), (60.0, 1.242_962_768)] {
        let mut m = linear(0.2, 5e4, 5e4, 2e4);
        (m.bend_warp, m.bend_weft) = (20.0, 20.0);
        let scene = strip(12, 0.5, degrees.to_radians(), m);
        let motion = Motion { fps: 120.0, frames: 320, ..Motion::default() };
        let shots = film(&scene, &alone(), &Dynamics { tolerance: 1e-6, ..exact(1.0 / 120.0) }, &motion);
        let got = period(&shots, |s| s.x[s.x.len() - 2].x);
        println!("pendulum {degrees}: {got} {:+.4} %", 100.0 * (got / expected - 1.0));
        assert!((got / expected - 1.0).abs() < 3e-3, "{degrees}°: {got} instead of {expected}");
    }
}
