//! Closed forms: hanging sheets, catenary, free fall, momentum, cantilever, friction on a slope.

mod common;

use common::{add, cotton, linear, noise, regular, sheet, sphere};
use toile_cloth::{
    BodyMesh, Curve, Effects, ExplicitSteps, Integrator, Material, Model, Pin, Scene, Settings, Silent, StopReason,
    Switch, Vec3, certify, drape,
};

const G: f64 = 9.81;

fn still() -> Settings {
    let effects = Effects { self_contact: Switch::Off, ..Effects::default() };
    Settings {
        effects,
        explicit: ExplicitSteps {
            energy_tolerance: 1e-9,
            speed_tolerance: 1e-6,
            stiffness_cap: f64::INFINITY,
            ..Settings::default().explicit
        },
        ..Settings::default()
    }
}

/// The same settings with other explicit steps.
fn stepping(mut settings: Settings, change: impl FnOnce(&mut ExplicitSteps)) -> Settings {
    change(&mut settings.explicit);
    settings
}

/// In time, by the paper's scheme.
fn moving() -> Settings {
    Settings { integrator: Integrator::CentralDifference, ..still() }
}

fn hang(scene: &mut Scene, nx: u32, ny: u32) {
    for i in 0..=nx {
        let v = ny * (nx + 1) + i;
        scene.pins.push(Pin { vertex: v, at: scene.positions[v as usize] });
    }
    scene.gravity = Vec3::new(0.0, -G, 0.0);
}

/// Lowest row's mean drop below its rest place.
fn elongation(x: &[Vec3], nx: u32) -> f64 {
    -(0..=nx).map(|i| x[i as usize].y).sum::<f64>() / f64::from(nx + 1)
}

#[test]
fn a_hanging_linear_sheet_stretches_by_the_closed_form() {
    let (length, k, sigma) = (0.5, 200.0, 0.2);
    // Edge springs on triangles are not exact: their diagonals help to carry (docs/structural.md).
    for (model, good) in [(Model::Coupled, 2e-3), (Model::Springs, 0.12)] {
        let mut scene = sheet(0.1, length, 4, 20, linear(sigma, k, k, 1e-3), |x, y| Vec3::new(x, y, 0.0));
        hang(&mut scene, 4, 20);
        let out = drape(&scene, &stepping(Settings { model, ..still() }, |e| e.damping = 40.0), &mut Silent).unwrap();
        assert!(out.settled);
        let expected = sigma * G * length * length / (2.0 * k);
        let got = elongation(&out.positions, 4);
        assert!((got / expected - 1.0).abs() < good, "{model:?}: {got} instead of {expected}");
        // The top row holds the weight.
        let held: f64 = out.reactions.iter().map(|r| r.force.y).sum();
        assert!((held / (sigma * G * 0.1 * length) - 1.0).abs() < 0.02, "{held}");
    }
}

#[test]
fn a_hanging_exponential_sheet_stretches_by_the_closed_form() {
    let (length, width, sigma, load) = (0.5, 0.1, 0.2, 40.0);
    let (k0, b) = (400.0, 20.0);
    let mut m = linear(sigma, 1.0, 400.0, 1e-3);
    m.warp = Curve::Exponential { k0, beta: b };
    let (nx, ny) = (4, 40);
    let mut scene = sheet(width, length, nx, ny, m, |x, y| Vec3::new(x, y, 0.0));
    hang(&mut scene, nx, ny);
    for i in 0..=nx {
        let share = if i == 0 || i == nx { 0.5 } else { 1.0 } / f64::from(nx);
        scene.loads.push(toile_cloth::Load { vertex: i, force: Vec3::new(0.0, -load * width * share, 0.0) });
    }
    let out = drape(&scene, &stepping(still(), |e| e.damping = 60.0), &mut Silent).unwrap();
    let f = |t: f64| ((1.0 + b * t / k0) * libm::log1p(b * t / k0) - b * t / k0) * k0 / (b * b);
    let w = sigma * G;
    let expected = (f(load + w * length) - f(load)) / w;
    let got = elongation(&out.positions, nx);
    assert!((got / expected - 1.0).abs() < 2e-3, "{got} instead of {expected}");
}

#[test]
fn the_strain_limit_carries_what_the_curve_does_not() {
    // Above the length L_s = K em / w the sheet is at its limit.
    let (length, k, sigma, limit) = (0.5, 40.0, 0.4, 0.02);
    let mut m = linear(sigma, k, k, 1.0);
    m.strain_limit = [limit, limit, f64::INFINITY];
    let (nx, ny) = (4, 25);
    let mut scene = sheet(0.1, length, nx, ny, m, |x, y| Vec3::new(x, y, 0.0));
    hang(&mut scene, nx, ny);
    let settings = stepping(still(), |e| {
        e.damping = 20.0;
        e.speed_tolerance = 1e-4;
        e.energy_tolerance = 1e-5;
    });
    let out = drape(&scene, &settings, &mut Silent).unwrap();
    assert!(out.settled);
    let w = sigma * G;
    let slack = k * limit / w;
    let expected = w * slack * slack / (2.0 * k) + limit * (length - slack);
    let got = elongation(&out.positions, nx);
    // A few sweeps a step leave a little over: 5 %.
    assert!((got / expected - 1.0).abs() < 0.05, "{got} instead of {expected}");
    let figures = certify(&scene, &settings, &out.positions).unwrap();
    assert!(figures.strain_over_limit < 1.05, "{}", figures.strain_over_limit);
}

/// A square metre by two corners: single triangles there hang at the limit, a thousand times as stiff as all others.
#[test]
fn a_sheet_hangs_by_its_corners_at_the_strain_limit() {
    let n = 40;
    let soft = Material {
        strain_limit: [0.05, 0.05, f64::INFINITY],
        thickness: 5e-4,
        ..Material::isotropic(0.15, 500.0, 0.3, 1e-5)
    };
    let mut scene = sheet(1.0, 1.0, n, n, soft, |x, y| Vec3::new(x, 0.0, y));
    scene.pins = [0, n].iter().map(|v| Pin { vertex: *v, at: scene.positions[*v as usize] }).collect();
    scene.gravity = Vec3::new(0.0, -G, 0.0);
    let settings = Settings { effects: Effects::default(), ..Settings::default() };
    let rest = drape(&scene, &settings, &mut Silent).expect("a drape");
    assert!(rest.settled && rest.steps < 1500, "{:?} after {} steps", rest.stop_reason, rest.steps);
    let strain = certify(&scene, &settings, &rest.positions).expect("figures").strain_max;
    assert!((0.048..0.0502).contains(&strain), "{strain}");
    let held: f64 = rest.reactions.iter().map(|r| r.force.y).sum();
    assert!((held / (0.15 * G) - 1.0).abs() < 1e-3, "{held} N");
}

/// The same with limits along warp, weft and bias: no edge of its mesh, which lie in these directions, is longer, and
/// all but its corners hangs as it does without.
#[test]
fn a_sheet_hangs_by_its_corners_within_its_limits_on_the_bias_too() {
    let (n, limit) = (40, 0.0125);
    let hang = |strain_limit: [f64; 3]| {
        let soft = Material { strain_limit, thickness: 5e-4, ..Material::isotropic(0.15, 500.0, 0.3, 1e-5) };
        let mut scene = sheet(1.0, 1.0, n, n, soft, |x, y| Vec3::new(x, 0.0, y));
        scene.pins = [0, n].iter().map(|v| Pin { vertex: *v, at: scene.positions[*v as usize] }).collect();
        scene.gravity = Vec3::new(0.0, -G, 0.0);
        let settings = Settings { effects: Effects::default(), ..Settings::default() };
        let rest = drape(&scene, &settings, &mut Silent).expect("a drape");
        assert!(rest.settled && rest.steps < 600, "{:?} after {} steps", rest.stop_reason, rest.steps);
        (certify(&scene, &settings, &rest.positions).expect("figures"), rest)
    };
    let (limited, rest) = hang([limit; 3]);
    assert!((0.9 * limit..limit).contains(&limited.edge_strain_max), "{}", limited.edge_strain_max);
    assert!(limited.strain_over_limit < 1.0, "{}", limited.strain_over_limit);
    let held: f64 = rest.reactions.iter().map(|r| r.force.y).sum();
    assert!((held / (0.15 * G) - 1.0).abs() < 1e-3, "{held} N");
    let (free, _) = hang([f64::INFINITY; 3]);
    assert!(free.edge_strain_max > 0.05, "{}", free.edge_strain_max);
    assert!((limited.strain_p95 / free.strain_p95 - 1.0).abs() < 0.1, "{} and {}", limited.strain_p95, free.strain_p95);
}

#[test]
fn a_strip_between_two_pins_hangs_in_a_catenary() {
    // Span 1, length 1.2: sag 0.292344, by the catenary.
    let n = 60;
    let mut scene = sheet(1.2, 0.02, n, 1, linear(0.1, 2000.0, 2000.0, 20.0), |x, y| {
        let s = x / 1.2;
        Vec3::new(s, -0.25 * 4.0 * s * (1.0 - s), y)
    });
    scene.gravity = Vec3::new(0.0, -G, 0.0);
    for v in [0, n, n + 1, 2 * n + 1] {
        scene.pins.push(Pin { vertex: v, at: scene.positions[v as usize] });
    }
    let settings = stepping(still(), |e| {
        e.damping = 15.0;
        e.speed_tolerance = 1e-4;
        e.energy_tolerance = 1e-4;
    });
    let out = drape(&scene, &settings, &mut Silent).unwrap();
    assert!(out.settled);
    let sag = -out.positions.iter().map(|p| p.y).fold(0.0, f64::min);
    assert!((sag - 0.292_344).abs() < 0.005 * 0.292_344, "sag {sag}");
}

#[test]
fn free_fall_follows_gravity_and_keeps_the_shape() {
    let mut scene = sheet(0.2, 0.2, 6, 6, linear(0.15, 800.0, 500.0, 40.0), |x, y| Vec3::new(x, 0.0, y));
    scene.gravity = Vec3::new(0.0, -G, 0.0);
    let settings = stepping(moving(), |e| {
        e.damping = 0.0;
        e.max_seconds = 0.3;
    });
    let out = drape(&scene, &settings, &mut Silent).unwrap();
    assert_eq!(out.stop_reason, StopReason::MaxSeconds);
    // Started at rest by X(−Δt) = X(0): the sum of the steps is ½ g t (t + Δt).
    let dt = out.seconds / out.steps as f64;
    let expected = -0.5 * G * out.seconds * (out.seconds + dt);
    for (p, q) in out.positions.iter().zip(&scene.positions) {
        assert!((p.y - q.y - expected).abs() < 1e-9, "{} instead of {expected}", p.y - q.y);
        assert!((p.x - q.x).abs() < 1e-9 && (p.z - q.z).abs() < 1e-9);
    }
    let c = 3.0;
    let dragged = drape(
        &scene,
        &stepping(settings, |e| {
            e.damping = c;
            e.max_seconds = 0.3;
        }),
        &mut Silent,
    )
    .unwrap();
    let t = dragged.seconds;
    let fall = -(G / c) * (t - (1.0 - libm::exp(-c * t)) / c);
    assert!((dragged.positions[0].y / fall - 1.0).abs() < 2e-3, "{} instead of {fall}", dragged.positions[0].y);
}

#[test]
fn inner_forces_keep_momentum() {
    for model in [Model::Coupled, Model::Springs] {
        let mut m = linear(0.15, 800.0, 500.0, 40.0);
        (m.bending.warp, m.bending.weft) = (1e-4, 5e-5);
        let mut scene = sheet(0.2, 0.2, 6, 6, m, |x, y| Vec3::new(x, 0.0, y));
        for (i, p) in (0u32..).zip(&mut scene.positions) {
            *p += Vec3::new(noise(3 * i), noise(3 * i + 1), noise(3 * i + 2)) * 3e-3;
        }
        let settings = stepping(Settings { model, ..moving() }, |e| {
            e.max_seconds = 0.05;
            e.damping = 0.0;
        });
        let out = drape(&scene, &settings, &mut Silent).unwrap();
        let mut mass = vec![0.0; scene.positions.len()];
        for t in &scene.triangles {
            for v in t.vertices {
                mass[v as usize] += t.area() / 3.0;
            }
        }
        let centre = |x: &[Vec3]| x.iter().zip(&mass).map(|(p, m)| p * *m).sum::<Vec3>() / mass.iter().sum::<f64>();
        let drift = (centre(&out.positions) - centre(&scene.positions)).norm();
        assert!(drift < 1e-13, "{model:?}: the middle moved by {drift}");
        assert!((out.positions[0] - scene.positions[0]).norm() > 1e-4, "it did move");
    }
}

#[test]
fn a_cantilever_bends_by_its_length_over_bending_length() {
    // The ratio H/W of the heavy elastica, on regular triangles. Two rows are held, so the free length starts half a
    // row behind the second.
    let (sigma, n) = (0.2, 30);
    let row = 0.1 / f64::from(n);
    let side = row * 2.0 / 3f64.sqrt();
    let free = 0.1 - 0.5 * row;
    for (gamma, expected) in [(2.0, 0.246_673), (10.0, 1.066_802)] {
        let b = sigma * G * free * free * free / gamma;
        let mut m = linear(sigma, 300.0, 300.0, 10.0);
        (m.bending.warp, m.bending.weft) = (b, b);
        let mut scene = regular(5, n, side, m);
        scene.gravity = Vec3::new(0.0, -G, 0.0);
        scene.pins = (0..12).map(|v| Pin { vertex: v, at: scene.positions[v as usize] }).collect();
        let settings = stepping(still(), |e| {
            e.damping = 30.0;
            e.speed_tolerance = 2e-5;
            e.energy_tolerance = 1e-6;
        });
        let out = drape(&scene, &settings, &mut Silent).unwrap();
        let tip = out.positions[out.positions.len() - 3];
        let ratio = -tip.y / (tip.z - 0.5 * row);
        assert!((ratio / expected - 1.0).abs() < 0.05, "Γ {gamma}: H/W {ratio} instead of {expected}");
    }
}

fn slope(angle: f64) -> Scene {
    let (s, c) = libm::sincos(angle);
    let along = Vec3::new(c, -s, 0.0);
    let normal = Vec3::new(s, c, 0.0);
    let mut m = linear(0.2, 300.0, 300.0, 30.0);
    m.friction = 0.3;
    let mut scene = sheet(0.1, 0.1, 4, 4, m, |x, y| along * x + normal * 1.2e-3 + Vec3::z() * y);
    let p = |a: f64, z: f64| along * a + Vec3::z() * z;
    scene.body = Some(
        BodyMesh {
            positions: vec![p(-1.0, -1.0), p(3.0, -1.0), p(3.0, 1.0), p(-1.0, 1.0)],
            triangles: vec![[0, 2, 1], [0, 3, 2]],
        }
        .into(),
    );
    scene.gravity = Vec3::new(0.0, -G, 0.0);
    scene
}

#[test]
fn friction_holds_below_the_slope_angle_and_slides_by_the_law_above() {
    let critical = libm::atan(0.3);
    let settings = stepping(moving(), |e| {
        e.damping = 0.0;
        e.max_seconds = 0.5;
        e.energy_tolerance = 0.0;
        e.speed_tolerance = 0.0;
    });
    let run = |angle: f64, seconds: f64| {
        let scene = slope(angle);
        let out = drape(&scene, &stepping(settings.clone(), |e| e.max_seconds = seconds), &mut Silent).unwrap();
        let (s, c) = libm::sincos(angle);
        ((out.positions[12] - scene.positions[12]).dot(&Vec3::new(c, -s, 0.0)), out.seconds)
    };
    // Dropped from a hair above it slides a little before it sticks; then it stays.
    let held = critical - 0.5f64.to_radians();
    let creep = run(held, 0.6).0 - run(held, 0.35).0;
    assert!(creep.abs() < 1e-9, "it crept {creep} m");
    let angle = critical + 5f64.to_radians();
    let (moved, t) = run(angle, 0.5);
    let a = G * (libm::sin(angle) - 0.3 * libm::cos(angle));
    assert!((moved / (0.5 * a * t * t) - 1.0).abs() < 0.03, "{moved} instead of {}", 0.5 * a * t * t);
}

#[test]
fn the_step_bound_is_safe_and_not_wasteful() {
    // Undamped ringing: below the bound the energy stays, well above it the step must be halved.
    let mut scene = sheet(0.1, 0.1, 8, 8, linear(0.15, 500.0, 500.0, 50.0), |x, y| Vec3::new(x, 0.0, y));
    for (i, p) in (0u32..).zip(&mut scene.positions) {
        *p += Vec3::new(noise(2 * i), 0.0, noise(2 * i + 1)) * 1e-5;
    }
    let base = stepping(moving(), |e| {
        e.damping = 0.0;
        e.stiffness_damping = 0.0;
        e.max_steps = 20_000;
        e.max_seconds = 1e3;
    });
    let base = stepping(base, |e| {
        e.energy_tolerance = 0.0;
        e.speed_tolerance = 0.0;
    });
    let start = certify(&scene, &base, &scene.positions).unwrap().energy;
    let calm = drape(&scene, &stepping(base.clone(), |e| e.step_fraction = 0.99), &mut Silent).unwrap();
    assert!(calm.energy <= start * 1.3, "{} J from {start} J", calm.energy);
    let full = calm.seconds / calm.steps as f64;
    let wild = drape(&scene, &stepping(base, |e| e.step_fraction = 1.6), &mut Silent).unwrap();
    assert!(wild.energy.is_finite() && wild.energy < 10.0 * start, "{} J from {start} J", wild.energy);
    let halved = wild.seconds / wild.steps as f64;
    assert!(halved < 1.5 * full, "the step was halved: {halved} against {full}");
}

#[test]
fn cloth_over_a_sphere_settles_without_a_crossing() {
    let m = cotton();
    let mut scene = sheet(0.5, 0.5, 25, 25, m, |x, y| Vec3::new(x - 0.25, 0.123, y - 0.25));
    for (i, p) in (0u32..).zip(&mut scene.positions) {
        p.y += 1e-4 * noise(i);
    }
    scene.gravity = Vec3::new(0.0, -G, 0.0);
    scene.body = Some(sphere(Vec3::zeros(), 0.12, 24).into());
    let settings = Settings::default();
    let out = drape(&scene, &settings, &mut Silent).unwrap();
    assert!(out.settled, "{:?}", out.stop_reason);
    let figures = certify(&scene, &settings, &out.positions).unwrap();
    assert_eq!((figures.self_crossings, figures.body_crossings), (0, 0));
    assert_eq!(figures.penetration_max, 0.0);
    assert!(figures.body_distance_min > 2e-4);
    assert!(out.positions.iter().map(|p| p.y).fold(f64::INFINITY, f64::min) < -0.05, "the corners hang down");
}

#[test]
fn a_far_piece_changes_nothing() {
    let mut one = sheet(0.2, 0.2, 8, 8, cotton(), |x, y| Vec3::new(x, 0.0, y));
    one.gravity = Vec3::new(0.0, -G, 0.0);
    one.pins = vec![Pin { vertex: 0, at: one.positions[0] }, Pin { vertex: 8, at: one.positions[8] }];
    let settings = stepping(Settings { integrator: Integrator::CentralDifference, ..Settings::default() }, |e| {
        e.max_seconds = 0.2
    });
    let alone = drape(&one, &settings, &mut Silent).unwrap();
    let mut two = one.clone();
    let other = sheet(0.2, 0.2, 8, 8, cotton(), |x, y| Vec3::new(x + 10.0, 0.0, y));
    add(&mut two, &other);
    let both = drape(&two, &settings, &mut Silent).unwrap();
    let most = alone.positions.iter().zip(&both.positions).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    assert!(most < 1e-9, "{most}");
}

/// A strip that is clamped at one end bends down. Both seek the least of the same energy: one without time, one by steps in
/// time that are damped.
#[test]
fn implicit_steps_end_where_the_descent_ends() {
    let mut scene = sheet(0.05, 0.2, 2, 16, cotton(), |x, y| Vec3::new(x, 0.0, y));
    scene.gravity = Vec3::new(0.0, -G, 0.0);
    scene.pins = (0..6).map(|vertex| Pin { vertex, at: scene.positions[vertex as usize] }).collect();
    let draped = |integrator| {
        let settings = Settings { integrator, ..Settings::default() };
        drape(&scene, &settings, &mut Silent).unwrap()
    };
    let [descent, steps] = [Integrator::Static, Integrator::Implicit].map(draped);
    assert!(steps.settled && steps.seconds > 0.5 && steps.residual_rel < 0.05, "{steps:?}");
    let most = descent.positions.iter().zip(&steps.positions).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    assert!(most < 1e-3, "{most}");
    assert!((steps.energy / descent.energy - 1.0).abs() < 0.02, "{} instead of {}", steps.energy, descent.energy);
}

#[test]
fn cloth_that_nothing_holds_is_told_so() {
    let mut scene = sheet(0.2, 0.2, 6, 6, linear(0.15, 800.0, 500.0, 40.0), |x, y| Vec3::new(x, 0.0, y));
    scene.gravity = Vec3::new(0.0, -G, 0.0);
    let out = drape(&scene, &still(), &mut Silent).unwrap();
    assert!(!out.settled);
    assert_eq!(out.stop_reason, StopReason::Unheld);
}

/// A square held by one edge and led by the other: to twice its length it comes along, to eight times no cloth would.
#[test]
fn cloth_is_not_led_farther_than_any_would_bear() {
    for (lengths, reason) in [(2.0, StopReason::Settled), (8.0, StopReason::HeldBack)] {
        let mut scene = sheet(0.1, 0.1, 6, 6, linear(0.15, 800.0, 500.0, 40.0), |x, y| Vec3::new(x, 0.0, y));
        let ends = (0..7).chain(42..49).map(|v| v as u32);
        let far = |z: f64| if z > 0.05 { 0.1 * lengths } else { z };
        let at = |v: u32| scene.positions[v as usize];
        scene.pins = ends.map(|v| Pin { vertex: v, at: Vec3::new(at(v).x, 0.0, far(at(v).z)) }).collect();
        let out = drape(&scene, &still(), &mut Silent).unwrap();
        assert_eq!(out.stop_reason, reason);
        let reached = out.positions.iter().map(|p| p.z).fold(0.0, f64::max) / 0.1;
        assert!(
            if out.settled { (reached - lengths).abs() < 1e-4 } else { reached > 3.0 && reached < 6.0 },
            "{reached}"
        );
    }
}

/// A sheet that is pulled by one edge over a rough table, over more than its own length. It follows, lies straight
/// behind the edge, and rests there.
#[test]
fn a_sheet_is_led_over_a_rough_table_as_far_as_asked() {
    let (length, friction, areal_mass) = (0.2, 0.3, 0.08);
    let mut m = linear(areal_mass, 20_000.0, 20_000.0, 8_000.0);
    (m.friction, m.bending.warp, m.bending.weft) = (friction, 3e-4, 3e-4);
    let height = 1.2e-3;
    let mut scene = sheet(0.1, length, 6, 12, m, |x, y| Vec3::new(x, height, y));
    let at = |x: f64, z: f64| Vec3::new(x, 0.0, z);
    scene.body = Some(
        BodyMesh {
            positions: vec![at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 2.0), at(-1.0, 2.0)],
            triangles: vec![[0, 2, 1], [0, 3, 2]],
        }
        .into(),
    );
    scene.gravity = Vec3::new(0.0, -G, 0.0);
    let edge: Vec<u32> = (84..91).collect();
    let target = |v: u32| scene.positions[v as usize] + Vec3::z() * 1.5 * length;
    scene.pins = edge.iter().map(|v| Pin { vertex: *v, at: target(*v) }).collect();
    let out = drape(&scene, &still(), &mut Silent).unwrap();
    assert_eq!(out.stop_reason, StopReason::Settled);
    for (p, start) in out.positions.iter().zip(&scene.positions) {
        assert!((p.z - start.z - 1.5 * length).abs() < 1e-4, "{p} from {start}");
        assert!(p.y > 0.0 && p.y < 2.0 * height, "{p}");
    }
}

/// A strip clamped below that stands exactly upright: all forces vanish, however tall it is. Above its critical height,
/// (7.837 B / (ρ g))^⅓ (Greenhill 1881), that is only a saddle.
#[test]
fn a_strip_that_stands_upright_stays_so_only_below_its_critical_height() {
    let critical = libm::cbrt(7.837 * 8e-6 / (0.115 * G));
    for (height, stands) in [(0.8 * critical, true), (1.4 * critical, false)] {
        let mut scene = sheet(0.02, height, 6, 18, cotton(), |x, y| Vec3::new(x, y, 0.0));
        scene.gravity = Vec3::new(0.0, -G, 0.0);
        scene.pins = (0..14).map(|v| Pin { vertex: v, at: scene.positions[v as usize] }).collect();
        let o = drape(&scene, &still(), &mut Silent).unwrap();
        assert!(o.settled);
        let sag = o.positions.iter().map(|p| p.z.abs()).fold(0.0, f64::max) / height;
        assert!(if stands { sag < 1e-6 } else { sag > 0.3 }, "{height}: {sag}");
    }
}
