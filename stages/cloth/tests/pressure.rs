//! A tube under an inner pressure: free up to a hoop strain of 50 %, and held at one vertex.
#![allow(clippy::unwrap_used)]

mod common;

use common::{linear, sheet};
use std::f64::consts::TAU;
use toile_cloth::{Outcome, Pin, Scene, Settings, Silent, Vec3, drape, weld};

const ROUND: u32 = 48;
const RADIUS: f64 = 0.05;
const STRETCH: f64 = 300.0;

/// A tube that is 60 mm high and as round as its cloth.
fn tube() -> Scene {
    let girth = TAU * RADIUS;
    let radius = 0.5 * girth / f64::from(ROUND) / libm::sin(0.5 * TAU / f64::from(ROUND));
    let place = |u: f64, v: f64| {
        let (s, c) = libm::sincos(u / RADIUS);
        Vec3::new(radius * c, radius * s, v)
    };
    let mut open = sheet(girth, 0.06, ROUND, 9, linear(0.1, STRETCH, STRETCH, 40.0), place);
    open.materials[0].bend_warp = 1e-7;
    open.materials[0].bend_weft = 1e-7;
    open.stitches = (0..10).map(|row| [row * (ROUND + 1), row * (ROUND + 1) + ROUND]).collect();
    let at = open.positions.clone();
    weld(&open, &at).scene
}

fn blown(scene: &Scene, pressure: f64) -> Outcome {
    drape(scene, &Settings { pressure, ..Settings::default() }, &mut Silent).unwrap()
}

/// p R = K (R/R₀ − 1) in the middle row.
fn check(scene: &Scene, pressure: f64) {
    let out = blown(scene, pressure);
    assert!(out.settled, "{pressure} Pa: {:?}, {} steps", out.stop_reason, out.steps);
    let row = &out.positions[4 * ROUND as usize..5 * ROUND as usize];
    let middle = row.iter().sum::<Vec3>() / f64::from(ROUND);
    let radius = row.iter().map(|p| (p - middle).norm()).sum::<f64>() / f64::from(ROUND);
    let expected = RADIUS / (1.0 - pressure * RADIUS / STRETCH);
    assert!((radius / expected - 1.0).abs() < 0.01, "{pressure} Pa: {radius} m instead of {expected} m");
}

#[test]
fn a_free_tube_is_blown_up_by_a_half() {
    for pressure in [500.0, 1000.0, 2000.0] {
        check(&tube(), pressure);
    }
}

/// Nothing pulls at one vertex that is held.
#[test]
fn a_tube_that_is_held_at_one_vertex_is_as_wide_as_a_free_one() {
    let mut scene = tube();
    let v = 4 * ROUND;
    scene.pins = vec![Pin { vertex: v, at: scene.positions[v as usize] }];
    check(&scene, 500.0);
}
