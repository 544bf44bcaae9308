//! The tests against closed forms and against each other.

use super::direction::bending_length;
use super::*;
use crate::testing::{cloth, lend};
use toile_garment::fabric::Fabric;

fn shirting() -> Fabric {
    cloth(0.115, 3000.0, 45.0, [8e-6, 5e-6])
}

fn drape(fabric: &Fabric, edge: f64, repeat: u32) -> Cusick {
    let params = CusickParams { edge, repeat, ..CusickParams::default() };
    lend(|cx| cusick::cusick(fabric, &params, cx)).0.expect("at rest")
}

/// Half the overhang at 41.5° is Peirce's length of the fabric's own rigidity, to what laboratories differ by.
#[test]
fn a_strip_shows_the_bending_length_of_its_direction() {
    let fabric = shirting();
    for direction in Direction::ALL {
        let params = CantileverParams { direction, edge: None };
        let read = lend(|cx| cantilever::cantilever(&fabric, &params, cx)).0.expect("at rest");
        let c = bending_length(direction.bending(&fabric), fabric.areal_mass);
        assert!((read.bending_length / c - 1.0).abs() < 0.02, "{direction:?}: {} of {c}", read.bending_length);
        let [along, down] = *read.profile.last().expect("a tip");
        assert!((libm::atan2(down, along).to_degrees() - cantilever::SLOPE).abs() < 0.1);
        let way: f64 = read.profile.windows(2).map(|p| libm::hypot(p[1][0] - p[0][0], p[1][1] - p[0][1])).sum();
        assert!((way / read.overhang - 1.0).abs() < 0.01, "the strip keeps its length");
    }
}

/// Strips cut out of the disc would keep 41 % at c = 25 mm; the intact cloth stands higher, as folds stiffen it. Stiff
/// cloth keeps nearly all, limp cloth little.
#[test]
fn the_drape_coefficient_rises_with_the_bending_length() {
    let with = |c: f64| drape(&cloth(0.15, 3000.0, 40.0, [0.15 * GRAVITY * c * c * c; 2]), 8e-3, 0);
    let [limp, usual, board] = [0.012, 0.025, 0.12].map(with);
    assert!((0.41..0.85).contains(&usual.drape_coefficient), "{}", usual.drape_coefficient);
    assert!(limp.drape_coefficient < usual.drape_coefficient - 0.15, "{}", limp.drape_coefficient);
    assert!(board.drape_coefficient > 0.97 && board.nodes.is_empty(), "{}", board.drape_coefficient);
    assert!((5..=11).contains(&limp.nodes.len()), "{} nodes", limp.nodes.len());
    assert!(limp.radius_min() >= cusick::DISC - 1e-9 && limp.radius_max() < 0.15);
}

/// Small ripples grow into eight folds, of which some would rather be one.
#[test]
fn the_deepest_rest_is_read() {
    let fabric = cloth(0.2, 3000.0, 40.0, [0.2 * GRAVITY * 8e-6; 2]);
    let params = CusickParams { edge: 8e-3, repeat: 1, ..CusickParams::default() };
    let rippled = lend(|cx| fall::fall(&fabric, &params, 0, cx)).0.expect("at rest");
    let rippled = cusick::read(&params, &rippled);
    let deepest = drape(&fabric, 8e-3, 1);
    assert!(deepest.energy < 1.03 * rippled.energy, "{} and {} J", deepest.energy, rippled.energy);
    assert!(deepest.nodes.len() < rippled.nodes.len());
    assert!(deepest.drape_coefficient < rippled.drape_coefficient - 0.05, "{}", deepest.drape_coefficient);
    // Falling is what cloth does: it ends below where it lay.
    assert!(rippled.energy < 0.0);
}

/// Where every stiffness and the mass grow alike, nothing changes.
#[test]
fn the_drape_coefficient_depends_on_stiffness_over_weight() {
    let light = drape(&cloth(0.1, 2000.0, 30.0, [5e-5, 4e-5]), 9e-3, 0);
    let heavy = drape(&cloth(0.3, 6000.0, 90.0, [15e-5, 12e-5]), 9e-3, 0);
    assert!((light.drape_coefficient - heavy.drape_coefficient).abs() < 0.01);
    assert_eq!(light.nodes.len(), heavy.nodes.len());
}

#[test]
fn the_drape_coefficient_does_not_depend_on_the_mesh() {
    // One cloth does not fall alike twice, and with more folds it covers more: so readings with as many folds are
    // compared.
    let read = |edge| -> Vec<(usize, f64)> {
        let readings = (0..10).map(|start| drape(&shirting(), edge, start));
        readings.map(|d| (d.nodes.len(), d.drape_coefficient)).collect()
    };
    let [coarse, fine] = [8e-3, 6e-3].map(read);
    let of = |all: &[(usize, f64)], folds| -> (f64, f64) {
        let with = all.iter().filter(|(n, _)| *n == folds).map(|(_, c)| c);
        (with.clone().count() as f64, with.sum())
    };
    let (mut pairs, mut apart) = (0.0, 0.0);
    for folds in 1..=12 {
        let ((n, a), (m, b)) = (of(&coarse, folds), of(&fine, folds));
        if n > 0.0 && m > 0.0 {
            (pairs, apart) = (pairs + n.min(m), apart + n.min(m) * (b / m - a / n));
        }
    }
    assert!(pairs >= 5.0 && (apart / pairs).abs() < 0.05, "{coarse:?} and {fine:?}");
}

/// The standard's rule: another specimen for limp and for stiff cloth, none for usual cloth or beyond the last size.
#[test]
fn another_specimen_is_asked_for_by_the_standard() {
    let asked = |specimen: f64, drape_coefficient: f64| {
        let params = CusickParams { specimen, ..CusickParams::default() };
        let (outline, nodes) = (Vec::new(), Vec::new());
        let read = Cusick {
            params,
            drape_coefficient,
            shadow_area: 0.0,
            outline,
            nodes,
            drop_max: 0.0,
            drop_mean: 0.0,
            energy: 0.0,
            triangles: 0,
        };
        let report = lend(|cx| cusick::advise(&read, cx)).1;
        report.findings.into_iter().next().map(|f| (f.code, f.hint.unwrap_or_default()))
    };
    let is = |found: Option<(String, String)>, code: &str, size: &str| {
        found.is_some_and(|(c, hint)| c == code && hint.contains(size))
    };
    assert!(is(asked(0.30, 0.29), "specimen-too-large", "24 cm"));
    assert!(is(asked(0.36, 0.29), "specimen-too-large", "30 cm"));
    assert!(is(asked(0.30, 0.86), "specimen-too-small", "36 cm"));
    assert!(asked(0.30, 0.31).is_none() && asked(0.24, 0.1).is_none() && asked(0.36, 0.9).is_none());
}

/// Yarns that keep their lengths: the angle in the middle, and 6 G ε of force per width at small extension.
#[test]
fn a_bias_strip_shears_as_its_yarns_must() {
    let fabric = cloth(0.1, 8e4, 40.0, [1e-5; 2]);
    let params = BiasParams { edge: 5e-3, extension: 0.05 };
    let read = lend(|cx| bias::bias(&fabric, &params, cx)).0.expect("at rest");
    for r in &read.readings[1..] {
        let ratio = r.shear_angle / r.shear_angle_rigid;
        assert!((ratio - 1.0).abs() < 0.05, "{} of {} rad", r.shear_angle, r.shear_angle_rigid);
    }
    let first = read.readings[1];
    let expected = 6.0 * fabric.shear * first.extension * bias::WIDTH;
    assert!((first.force / expected - 1.0).abs() < 0.08, "{} of {expected} N", first.force);
    assert!((read.shear_fast / fabric.shear - 1.5).abs() < 0.2, "{}", read.shear_fast);
    assert!(read.readings.windows(2).all(|p| p[1].force > p[0].force && p[1].waist < p[0].waist));
}

#[test]
fn a_frame_feels_shear_alone() {
    let params = FrameParams { edge: 8e-3, ..FrameParams::default() };
    let read = lend(|cx| frame::frame(&shirting(), &params, cx)).0.expect("at rest");
    for r in &read.readings[1..] {
        assert!((r.shear_stress / (45.0 * r.shear_angle) - 1.0).abs() < 0.01, "{r:?}");
        // The two figures of shear per length differ by the cosine of the angle.
        assert!((r.shear_force * libm::cos(r.shear_angle) / r.shear_stress - 1.0).abs() < 1e-9);
    }
    assert!((read.shear_secant() / read.shear - 1.0).abs() < 0.01);
}

#[test]
fn what_has_no_answer_is_refused() {
    let limp = cloth(0.1, 2000.0, 30.0, [6e-6, 0.0]);
    let code = |e: StageError| match e {
        StageError::Input(f) | StageError::Parameter(f) => f[0].code.clone(),
        other => other.to_string(),
    };
    let refused = lend(|cx| cusick::cusick(&limp, &CusickParams::default(), cx)).0.expect_err("no bending");
    assert_eq!(code(refused), "fabric-without-bending");
    let params = CantileverParams { direction: Direction::Weft, edge: None };
    let refused = lend(|cx| cantilever::cantilever(&limp, &params, cx)).0.expect_err("no bending");
    assert_eq!(code(refused), "fabric-without-bending");
    for edge in [1e-4, 0.1, f64::NAN] {
        let params = CusickParams { edge, ..CusickParams::default() };
        let refused = lend(|cx| cusick::cusick(&shirting(), &params, cx)).0.expect_err("edge");
        assert_eq!(code(refused), "setting-out-of-range");
    }
}
