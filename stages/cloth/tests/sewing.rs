//! Seams and darts close, join exactly and come out free of crossings.

mod common;

use common::{add, cotton, linear, noise, post, sheet, sphere};
use toile_cloth::{
    Element, ExplicitSteps, Material, Scene, Settings, Silent, StopReason, Vec3, certify, drape, sew, sew_in_order,
    weld,
};

#[test]
fn two_sheets_a_hand_apart_are_sewn() {
    let mut scene = sheet(0.2, 0.3, 8, 12, cotton(), |x, y| Vec3::new(x, y, 0.1));
    let back = sheet(0.2, 0.3, 8, 12, cotton(), |x, y| Vec3::new(x, y, -0.1));
    let shift = add(&mut scene, &back);
    for j in 0..=12 {
        for i in [0, 8] {
            scene.stitches.push([j * 9 + i, j * 9 + i + shift]);
        }
    }
    let settings = Settings::sewing();
    let out = sew(&scene, &settings, &mut Silent).unwrap();
    assert!(out.settled, "{:?}", out.stop_reason);
    assert_eq!(out.seam_gap_max, 0.0);
    assert!(out.open_stitches.is_empty());
    let welded = weld(&scene, &out.positions);
    assert_eq!(welded.scene.positions.len(), scene.positions.len() - 26);
    assert_eq!(certify(&welded.scene, &settings, &welded.scene.positions).unwrap().self_crossings, 0);
    assert_eq!(welded.spread(&welded.scene.positions), out.positions);
}

/// A tube of two sheets, and a band above it that is sewn to the upper edge of one when the sides are closed.
#[test]
fn what_is_sewn_last_is_not_in_the_way_before() {
    let mut scene = sheet(0.2, 0.3, 8, 12, cotton(), |x, y| Vec3::new(x, y, 0.1));
    let back = sheet(0.2, 0.3, 8, 12, cotton(), |x, y| Vec3::new(x, y, -0.1));
    let shift = add(&mut scene, &back);
    let band = sheet(0.2, 0.05, 8, 2, cotton(), |x, y| Vec3::new(x, y + 0.35, 0.0));
    let first = add(&mut scene, &band);
    for j in 0..=12 {
        scene.stitches.extend([0, 8].map(|i| [j * 9 + i, j * 9 + i + shift]));
    }
    scene.stitches.extend((0..9).map(|i| [12 * 9 + i, first + i]));
    let last: Vec<bool> = (0u32..).zip(&scene.positions).map(|(v, _)| v >= first).collect();
    let settings = Settings::sewing();
    let (out, moved) = sew_in_order(&scene, &settings, &last, &mut Silent).unwrap();
    assert_eq!((out.seam_gap_max, out.open_stitches.len(), moved.len()), (0.0, 0, 0));
    let welded = weld(&scene, &out.positions);
    // The corners of the tube and of the band are one, too.
    assert_eq!(welded.scene.positions.len(), scene.positions.len() - 26 - 9);
    assert_eq!(certify(&welded.scene, &settings, &welded.scene.positions).unwrap().self_crossings, 0);
    // Nothing in order is sewing as it was.
    let (none, _) = sew_in_order(&scene, &settings, &vec![false; last.len()], &mut Silent).unwrap();
    assert_eq!(none.positions, sew(&scene, &settings, &mut Silent).unwrap().positions);
}

/// A disc with a wedge of `degrees` cut out to its centre, flat, slightly buckled.
fn dart(degrees: f64, rings: u32, spokes: u32, radius: f64, material: Material) -> Scene {
    let mut scene = Scene { materials: vec![material], ..Scene::default() };
    let mut rest = vec![[0.0, 0.0]];
    let sweep = (360.0 - degrees).to_radians();
    for r in 1..=rings {
        for s in 0..=spokes {
            let (sin, cos) = libm::sincos(sweep * f64::from(s) / f64::from(spokes));
            let d = radius * f64::from(r) / f64::from(rings);
            rest.push([d * cos, d * sin]);
        }
    }
    let id = |r: u32, s: u32| if r == 0 { 0 } else { 1 + (r - 1) * (spokes + 1) + s };
    let mut push = |v: [u32; 3]| {
        scene.triangles.push(Element { vertices: v, rest: v.map(|i| rest[i as usize]), material: 0 });
    };
    for s in 0..spokes {
        push([0, id(1, s), id(1, s + 1)]);
        for r in 1..rings {
            push([id(r, s), id(r + 1, s), id(r + 1, s + 1)]);
            push([id(r, s), id(r + 1, s + 1), id(r, s + 1)]);
        }
    }
    // Out of plane a little, the middle up: the side a cone goes to.
    scene.positions = (0u32..)
        .zip(&rest)
        .map(|(i, p)| Vec3::new(p[0], 0.1 * (radius - libm::hypot(p[0], p[1])) + 1e-4 * noise(i), p[1]))
        .collect();
    scene.stitches = (1..=rings).map(|r| [id(r, 0), id(r, spokes)]).collect();
    scene
}

#[test]
fn a_dart_closes_into_its_cone() {
    // 90° in a disc: half angle 48.59°, height R cos(α).
    let mut m = linear(0.1, 500.0, 500.0, 200.0);
    (m.bending.warp, m.bending.weft) = (1e-5, 1e-5);
    let (radius, rings) = (0.1, 8);
    let scene = dart(90.0, rings, 36, radius, m);
    let settings = Settings {
        explicit: ExplicitSteps { speed_tolerance: 2e-3, energy_tolerance: 1e-3, ..Settings::sewing().explicit },
        ..Settings::sewing()
    };
    let out = sew(&scene, &settings, &mut Silent).unwrap();
    assert!(out.settled, "{:?} {:?}", out.stop_reason, out.open_stitches);
    assert_eq!(out.seam_gap_max, 0.0);
    let rim: Vec<Vec3> = out.positions[out.positions.len() - 37..].to_vec();
    let middle = rim.iter().sum::<Vec3>() / 37.0;
    let height = (out.positions[0] - middle).norm();
    let angle = libm::acos(height / radius).to_degrees();
    let cone = libm::asin(0.75f64).to_degrees();
    assert!((90.0 - angle - (90.0 - cone)).abs() < 3.0, "half angle {angle}°, the cone has {cone}°");
    let welded = weld(&scene, &out.positions);
    assert_eq!(certify(&welded.scene, &settings, &welded.scene.positions).unwrap().self_crossings, 0);
}

/// A tunic of two squares over a ball: sewn from both sides, then hung on it.
fn tunic() -> Scene {
    let place = |z: f64| move |x: f64, y: f64| Vec3::new(x - 0.2, y - 0.12, z);
    let mut scene = sheet(0.4, 0.3, 16, 12, cotton(), place(0.2));
    let back = sheet(0.4, 0.3, 16, 12, cotton(), place(-0.2));
    let shift = add(&mut scene, &back);
    for j in 0..=12 {
        scene.stitches.push([j * 17, j * 17 + shift]);
        scene.stitches.push([j * 17 + 16, j * 17 + 16 + shift]);
    }
    for i in 0..=16 {
        scene.stitches.push([12 * 17 + i, 12 * 17 + i + shift]);
    }
    scene.gravity = Vec3::new(0.0, -9.81, 0.0);
    scene.body = Some(sphere(Vec3::zeros(), 0.1, 16).into());
    scene
}

#[test]
fn a_bag_is_sewn_over_a_ball_and_hangs_on_it() {
    let scene = tunic();
    let sewn = sew(&scene, &Settings::sewing(), &mut Silent).unwrap();
    assert_eq!(sewn.stop_reason, StopReason::Settled);
    assert_eq!(sewn.seam_gap_max, 0.0);
    let welded = weld(&scene, &sewn.positions);
    let settings = Settings::default();
    let out = drape(&welded.scene, &settings, &mut Silent).unwrap();
    assert!(out.settled, "{:?}", out.stop_reason);
    let figures = certify(&welded.scene, &settings, &out.positions).unwrap();
    assert_eq!((figures.self_crossings, figures.body_crossings, figures.penetration_max), (0, 0, 0.0));
}

#[test]
fn the_same_scene_gives_the_same_bits_at_any_thread_count() {
    let scene = tunic();
    let run = |threads: usize| {
        let settings = Settings {
            threads,
            explicit: ExplicitSteps { max_seconds: 0.4, ..Settings::sewing().explicit },
            ..Settings::sewing()
        };
        sew(&scene, &settings, &mut Silent).unwrap().positions
    };
    let one = run(1);
    for threads in [2, 3, 8] {
        assert_eq!(one, run(threads), "{threads} threads");
    }
}

#[test]
fn a_seam_that_cannot_close_is_reported() {
    // A belt three quarters as long as the girth of the post it lies around.
    let m = linear(0.1, 3000.0, 3000.0, 300.0);
    let n = 30;
    let mut scene = sheet(0.47, 0.02, n, 2, m, |x, y| {
        let (s, c) = libm::sincos((x - 0.235) / 0.103);
        Vec3::new(0.103 * s, y - 0.01, 0.103 * c)
    });
    scene.materials[0].strain_limit = [0.02, 0.02, f64::INFINITY];
    scene.body = Some(post(0.1, 1.0, 40).into());
    scene.stitches = (0..=2).map(|j| [j * (n + 1), j * (n + 1) + n]).collect();
    let settings =
        Settings { explicit: ExplicitSteps { max_seconds: 4.0, ..Settings::sewing().explicit }, ..Settings::sewing() };
    let out = sew(&scene, &settings, &mut Silent).unwrap();
    assert!(!out.settled && out.stop_reason != StopReason::Settled);
    assert_eq!(out.open_stitches.len(), 3);
    assert!(out.seam_gap_max > 0.02);
    let figures = certify(&scene, &settings, &out.positions).unwrap();
    assert_eq!((figures.body_crossings, figures.penetration_max), (0, 0.0));
    assert!(out.positions.iter().all(|p| p.norm() < 0.5));
}
