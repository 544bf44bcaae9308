//! Elastic bands and pressed folds against equilibria worked out by hand.
#![allow(clippy::unwrap_used)]

mod common;

use common::{linear, post, sheet};
use std::f64::consts::{PI, TAU};
use toile_cloth::{
    Band, Bending, BodyMesh, Effects, FoldLine, Material, Outcome, Pin, Scene, Settings, Silent, StopReason, Switch,
    Vec3, band_state, drape, fold_angles, weld,
};

const G: f64 = 9.81;

fn settle(scene: &Scene, friction: Switch) -> Outcome {
    let effects = Effects { friction, ..Effects::default() };
    drape(scene, &Settings { effects, ..Settings::default() }, &mut Silent).unwrap()
}

/// Vertices around a ring of cloth.
const ROUND: u32 = 48;

/// A ring of cloth, three rows high, with a band along its middle row; `radius` gives that of the cloth at a height.
fn ring(material: Material, around: f64, height: f64, radius: impl Fn(f64) -> f64, band: f64, stiffness: f64) -> Scene {
    let place = |x: f64, y: f64| {
        let (s, c) = libm::sincos(TAU * x / around);
        Vec3::new(radius(y) * c, y, -radius(y) * s)
    };
    let mut open = sheet(around, height, ROUND, 2, material, place);
    open.stitches = (0..3).map(|row| [row * (ROUND + 1), row * (ROUND + 1) + ROUND]).collect();
    let middle = (0..ROUND).map(|k| ROUND + 1 + k).collect();
    open.bands = vec![Band { vertices: middle, rest: vec![band / f64::from(ROUND); ROUND as usize], stiffness }];
    open.gravity = Vec3::new(0.0, -G, 0.0);
    let at = open.positions.clone();
    weld(&open, &at).scene
}

/// An upright cone that narrows upwards, with the radius 0.1 m at height 0 and a half angle.
fn cone(half_angle: f64) -> BodyMesh {
    let slope = libm::tan(half_angle);
    let mut body = post(1.0, 0.4, 192);
    for p in &mut body.positions {
        let r = 0.1 - p.y * slope;
        (p.x, p.z) = (p.x * r, p.z * r);
    }
    body
}

/// A band on a smooth cone climbs until its tension carries the weight: T = W/(2π tan α), whatever its stiffness.
#[test]
fn a_band_on_a_smooth_cone_carries_the_weight_by_its_tension() {
    let (half_angle, height, density): (f64, f64, f64) = (10f64.to_radians(), 0.02, 1.0);
    let around = TAU * 0.1;
    let expected = density * G * around * height / (TAU * libm::tan(half_angle));
    for stiffness in [1.0, 3.0] {
        // The cloth itself resists next to nothing.
        let cloth = linear(density, 200.0, 0.05, 1.0);
        let band = TAU * 0.1 / (1.0 + expected / stiffness);
        let slope = libm::tan(half_angle);
        let radius = |y: f64| 0.1015 - (y - 0.5 * height) * slope;
        let mut scene = ring(cloth, around, height, radius, band * 0.97, stiffness);
        scene.body = Some(cone(half_angle).into());
        let out = settle(&scene, Switch::Off);
        assert!(out.settled, "{:?}", out.stop_reason);
        let (length, tension) = band_state(&scene.bands[0], &out.positions);
        assert!((tension / expected - 1.0).abs() < 0.02, "{tension} N instead of {expected} N");
        let by_hand = scene.bands[0].rest_length() * (1.0 + expected / stiffness);
        assert!((length / by_hand - 1.0).abs() < 0.005, "{length} m instead of {by_hand} m");
    }
}

/// A band presses with T/R on a post. Friction holds the cloth if μ · 2π T is over its weight, and lets it slide if not.
#[test]
fn a_band_holds_on_a_post_by_friction_or_slides() {
    let (height, density, stiffness) = (0.02, 0.5, 2.0);
    let around = TAU * 0.1005;
    let weight = density * G * around * height;
    for (margin, holds) in [(1.3, true), (0.7, false)] {
        let mut cloth = linear(density, 200.0, 0.05, 1.0);
        cloth.friction = 0.3;
        let tension = margin * weight / (0.3 * TAU);
        // Cloth is held off a body by the gap and half of its thickness.
        let gap = 1.15e-3;
        // The middles of a ring's edges lie a little inside its circle.
        let length = f64::from(ROUND) * (0.1 + gap) * libm::sin(TAU / f64::from(ROUND));
        let band = length / (1.0 + tension / stiffness);
        let mut scene = ring(cloth, around, height, |_| 0.1 + gap, band, stiffness);
        scene.body = Some(post(0.1, 0.6, 192).into());
        let out = settle(&scene, Switch::Auto);
        let sank = scene.positions[0].y - out.positions[0].y;
        if holds {
            assert!(out.settled && sank < 5e-3, "it sank by {sank} m: {:?}", out.stop_reason);
            let (now, found) = band_state(&scene.bands[0], &out.positions);
            assert!((now / length - 1.0).abs() < 1e-3, "{now} m instead of {length} m");
            assert!((found / tension - 1.0).abs() < 0.03, "{found} N instead of {tension} N");
        } else {
            assert!(out.stop_reason == StopReason::Unheld || sank > 0.01, "it sank by {sank} m: {:?}", out.stop_reason);
        }
    }
}

/// A strip in the plane y = 0 that is held at its first three columns and folded at x = 0.1 m.
fn strip(material: Material, angle: f64, stiffness: f64) -> Scene {
    let mut scene = sheet(0.16, 0.05, 16, 5, material, |x, z| Vec3::new(x, 0.0, z));
    let id = |i: u32, j: u32| 17 * j + i;
    scene.folds = vec![FoldLine { vertices: (0..6).map(|j| id(10, j)).collect(), angle, stiffness }];
    let held = (0..6).flat_map(|j| (0..10).map(move |i| id(i, j)));
    scene.pins = held.map(|v| Pin { vertex: v, at: scene.positions[v as usize] }).collect();
    scene
}

fn mean_angle(scene: &Scene, out: &Outcome) -> f64 {
    let angles = fold_angles(scene, &scene.folds[0], &out.positions);
    assert_eq!(angles.len(), 5);
    angles.iter().map(|a| a[0] * a[1]).sum::<f64>() / angles.iter().map(|a| a[1]).sum::<f64>()
}

/// Without weight a fold comes to its own angle, to either side.
#[test]
fn a_fold_without_load_takes_its_angle() {
    let stiff = Material { bending: Bending::isotropic(1e-3), ..linear(0.2, 1000.0, 1000.0, 400.0) };
    for angle in [0.5 * PI, -0.5 * PI, 0.9 * PI] {
        let scene = strip(stiff.clone(), angle, 0.02);
        let out = settle(&scene, Switch::Auto);
        assert!(out.settled, "{:?}", out.stop_reason);
        let found = mean_angle(&scene, &out);
        assert!((found - angle).abs() < 0.01, "{found} rad instead of {angle}");
        // The right side, up in the scene's first frame, is outside where the angle is over 0.
        let tip = out.positions[16];
        assert!(tip.y * angle * scene_up(&scene) < 0.0, "{tip:?}");
    }
}

/// Which way the right side of the cloth faces: 1 up, −1 down.
fn scene_up(scene: &Scene) -> f64 {
    let [a, b, c] = scene.triangles[0].vertices.map(|v| scene.positions[v as usize]);
    (b - a).cross(&(c - a)).y.signum()
}

/// A flap hangs from a fold that is pressed flat: k θ = ½ σ g a² cos θ per length.
#[test]
fn a_flap_hangs_from_a_fold_by_the_closed_form() {
    let (density, flap) = (0.2, 0.06);
    let stiff = Material { bending: Bending::isotropic(1.0), ..linear(density, 1e4, 1e4, 4e3) };
    let weight = 0.5 * density * G * flap * flap;
    for expected in [0.3f64, 0.8] {
        let stiffness = weight * libm::cos(expected) / expected;
        let mut scene = strip(stiff.clone(), 0.0, stiffness);
        scene.gravity = Vec3::new(0.0, -G, 0.0);
        let out = settle(&scene, Switch::Auto);
        assert!(out.settled, "{:?}", out.stop_reason);
        let found = mean_angle(&scene, &out).abs();
        assert!((found / expected - 1.0).abs() < 0.02, "{found} rad instead of {expected}");
    }
}
