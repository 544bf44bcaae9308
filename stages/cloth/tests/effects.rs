//! Effects that a scene does not call for change not a bit of it, and say so (reliability I1, I2).
#![allow(clippy::unwrap_used)]

mod common;

use common::{cotton, linear, sheet, sphere};
use toile_cloth::{BodyMesh, Effects, Outcome, Pin, Scene, Settings, Silent, Switch, Vec3, drape};

/// A sheet that hangs from its upper edge, a little rippled.
fn hanging() -> Scene {
    let place = |x: f64, y: f64| Vec3::new(x, 2e-3 * libm::sin(9.0 * x) * (0.6 - y), y);
    let mut scene = sheet(0.5, 0.6, 10, 12, cotton(), place);
    scene.gravity = Vec3::new(0.0, 0.0, -9.81);
    scene.pins = (12 * 11..13 * 11).map(|v| Pin { vertex: v, at: scene.positions[v as usize] }).collect();
    scene
}

/// A square that lies down on a ball.
fn on_a_ball() -> Scene {
    let mut scene = sheet(0.4, 0.4, 12, 12, cotton(), |x, y| Vec3::new(x - 0.2, 0.112, y - 0.2));
    scene.gravity = Vec3::new(0.0, -9.81, 0.0);
    scene.body = Some(sphere(Vec3::zeros(), 0.11, 16).into());
    scene
}

fn run(scene: &Scene, effects: Effects) -> Outcome {
    drape(scene, &Settings { effects, ..Settings::default() }, &mut Silent).unwrap()
}

fn evidence<'a>(o: &'a Outcome, name: &str) -> (bool, &'a str) {
    let e = o.effects.iter().find(|e| e.name == name).unwrap();
    (e.on, &e.evidence)
}

fn same(a: &Outcome, b: &Outcome) {
    assert_eq!((a.steps, a.energy.to_bits()), (b.steps, b.energy.to_bits()));
    assert!(a.positions.iter().zip(&b.positions).all(|(p, q)| p == q));
}

#[test]
fn self_contact_of_a_taut_sheet_is_never_active() {
    let on = run(&hanging(), Effects { self_contact: Switch::On, ..Effects::default() });
    let off = run(&hanging(), Effects { self_contact: Switch::Off, ..Effects::default() });
    same(&on, &off);
    assert!(on.settled);
    let (built, told) = evidence(&on, "self-contact");
    assert!(built && told.starts_with("never active: not needed"), "{told}");
    assert!(!evidence(&off, "self-contact").0);
}

/// Cloth that hangs in folds looks at itself afterwards only: the same steps as without.
#[test]
fn self_contact_of_cloth_in_folds_that_do_not_meet_is_never_active() {
    let on = run(&on_a_ball(), Effects { self_contact: Switch::On, ..Effects::default() });
    same(&on, &run(&on_a_ball(), Effects { self_contact: Switch::Off, ..Effects::default() }));
    let (_, told) = evidence(&on, "self-contact");
    assert!(told.starts_with("never active: not needed") && told.ends_with(" 0 of them taken back"), "{told}");
    assert!(on.settled && on.positions.iter().any(|p| p.y < -0.02), "it hangs");
}

/// Held vertices are led as fast as the cloth follows where nothing rubs, whether or not anything could rub.
#[test]
fn effects_that_nothing_calls_for_do_not_slow_what_is_led() {
    let mut drawn = hanging();
    drawn.pins.extend((0..11).map(|v| Pin { vertex: v, at: drawn.positions[v as usize] - Vec3::new(0.0, 0.02, 0.0) }));
    let on = run(&drawn, Effects::default());
    same(&on, &run(&drawn, Effects { self_contact: Switch::Off, ..Effects::default() }));
    same(&on, &run(&drawn, Effects { friction: Switch::Off, ..Effects::default() }));
    assert!(on.settled);
}

#[test]
fn a_body_out_of_reach_is_never_active() {
    let mut far = hanging();
    far.body = Some(sphere(Vec3::new(0.25, 10.0, 0.3), 0.1, 8).into());
    let on = run(&far, Effects::default());
    same(&on, &run(&far, Effects { body_contact: Switch::Off, ..Effects::default() }));
    same(&on, &run(&hanging(), Effects::default()));
    let (built, told) = evidence(&on, "body-contact");
    assert!(built && told.starts_with("never active: not needed"), "{told}");
}

#[test]
fn friction_without_contact_is_never_active() {
    let mut far = hanging();
    far.body = Some(BodyMesh { ..sphere(Vec3::new(0.25, 10.0, 0.3), 0.1, 8) }.into());
    let on = run(&far, Effects { friction: Switch::On, ..Effects::default() });
    same(&on, &run(&far, Effects { friction: Switch::Off, ..Effects::default() }));
    let (built, told) = evidence(&on, "friction");
    assert!(built && told.starts_with("never active: not needed"), "{told}");
}

#[test]
fn no_friction_is_friction_with_a_coefficient_of_nothing() {
    let smooth = |mut s: Scene| {
        s.materials[0].friction = 0.0;
        s
    };
    let off = run(&on_a_ball(), Effects { friction: Switch::Off, ..Effects::default() });
    same(&run(&smooth(on_a_ball()), Effects::default()), &off);
    // Where it is called for, it is felt.
    let rough = run(&on_a_ball(), Effects::default());
    assert!(rough.positions != off.positions);
    assert!(evidence(&rough, "body-contact").1.starts_with("active in "));
}

#[test]
fn a_strain_limit_that_is_never_reached_changes_nothing() {
    let mut limited = hanging();
    limited.materials[0].strain_limit = [0.2; 3];
    let on = run(&limited, Effects { strain_limit: Switch::On, ..Effects::default() });
    same(&on, &run(&limited, Effects { strain_limit: Switch::Off, ..Effects::default() }));
    same(&on, &run(&hanging(), Effects::default()));
}

#[test]
fn bending_without_friction_has_no_hysteresis() {
    let on = run(&on_a_ball(), Effects { bending_hysteresis: Switch::On, ..Effects::default() });
    same(&on, &run(&on_a_ball(), Effects { bending_hysteresis: Switch::Off, ..Effects::default() }));
    let little = |friction: f64| {
        let mut scene = on_a_ball();
        scene.materials[0].bending.friction = friction;
        scene
    };
    // By itself only where it is felt.
    same(&on, &run(&little(1e-6), Effects::default()));
    let felt = run(&little(1e-3), Effects::default());
    assert!(felt.settled && evidence(&felt, "bending-hysteresis").0);
    assert!(felt.positions != on.positions);
}

/// A strip without weight takes the curvature of its fabric, towards the right side or away from it.
#[test]
fn a_strip_curls_as_its_fabric_does() {
    for curvature in [20.0, -35.0] {
        let mut scene = sheet(0.02, 0.12, 4, 24, cotton(), |x, y| Vec3::new(x, y, 0.0));
        scene.materials[0].bending.rest_curvature = [curvature, 0.0];
        scene.gravity = Vec3::zeros();
        // The first two rows are held flat.
        scene.pins = (0..10).map(|v| Pin { vertex: v, at: scene.positions[v as usize] }).collect();
        let o = run(&scene, Effects::default());
        assert!(o.settled && evidence(&o, "rest-curvature").0);
        let row = |j: usize| o.positions[5 * j + 2];
        for j in 4..23 {
            let [a, b, c] = [row(j - 1), row(j), row(j + 1)];
            let turn = libm::atan2((b - a).cross(&(c - b)).x, (b - a).dot(&(c - b)));
            let bent = turn / (0.5 * (c - a).norm());
            assert!((bent / curvature - 1.0).abs() < 0.02, "row {j}: {bent} of {curvature}");
        }
    }
    assert!(run(&hanging(), Effects::default()).effects.iter().all(|e| e.name != "rest-curvature"));
}

#[test]
fn explicit_steps_refuse_hysteresis_that_is_asked_for() {
    let effects = Effects { bending_hysteresis: Switch::On, ..Effects::default() };
    let s = Settings { integrator: toile_cloth::Integrator::CentralDifference, effects, ..Settings::default() };
    let error = drape(&on_a_ball(), &s, &mut Silent).unwrap_err().to_string();
    assert!(error.contains("effects.bending-hysteresis") && error.contains("static"), "{error}");
}

#[test]
fn a_curve_that_is_a_line_is_the_line() {
    use toile_cloth::Curve;
    let mut line = hanging();
    line.materials[0] = linear(0.115, 1000.0, 800.0, 45.0);
    let mut curve = line.clone();
    curve.materials[0].warp = Curve::Exponential { k0: 1000.0, beta: 1e-12 };
    curve.materials[0].weft = Curve::Exponential { k0: 800.0, beta: 1e-12 };
    let (line, curve) = (run(&line, Effects::default()), run(&curve, Effects::default()));
    let apart = line.positions.iter().zip(&curve.positions).map(|(p, q)| (p - q).norm()).fold(0.0, f64::max);
    assert!(line.settled && curve.settled && apart < 1e-6, "{apart}");
}

#[test]
fn every_pair_of_switches_runs() {
    // A covering array of strength two over five effects, on or off.
    for row in ["00000", "11111", "11100", "10011", "01010", "00101"] {
        let at = |k: usize| if row.as_bytes()[k] == b'1' { Switch::On } else { Switch::Off };
        let effects = Effects {
            self_contact: at(0),
            body_contact: at(1),
            friction: at(2),
            strain_limit: at(3),
            bending_hysteresis: at(4),
        };
        let mut scene = on_a_ball();
        scene.materials[0].bending.friction = 1e-4;
        scene.pins = vec![Pin { vertex: 84, at: scene.positions[84] }];
        let o = run(&scene, effects);
        assert!(o.settled, "{row}: {:?}", o.stop_reason);
        assert!(o.positions.iter().all(|p| p.iter().all(|c| c.is_finite())), "{row}");
        let built = ["self-contact", "body-contact", "bending-hysteresis"].map(|n| evidence(&o, n).0);
        assert_eq!(built, [0, 1, 4].map(|k| at(k) == Switch::On), "{row}");
    }
}

#[test]
fn costs_are_told_by_effect() {
    let o = run(&on_a_ball(), Effects::default());
    let cost = |name: &str| o.effects.iter().find(|e| e.name == name).map_or(-1.0, |e| e.cpu_seconds);
    for name in ["cloth", "descent", "self-contact", "body-contact", "friction"] {
        assert!(cost(name) > 0.0, "{name}");
    }
    let off = run(&hanging(), Effects { self_contact: Switch::Off, ..Effects::default() });
    assert!(off.effects.iter().filter(|e| !e.on).all(|e| e.cpu_seconds == 0.0));
}
