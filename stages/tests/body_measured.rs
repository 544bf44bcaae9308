//! Measures found on meshes that name nothing: the parametric body turned, scaled, opened and posed otherwise.
#![allow(clippy::unwrap_used)]

use std::collections::BTreeMap;
use toile_garment::Vec3;
use toile_garment::body::Body;
use toile_stages::body::{BodyMeasures, Pose, SIZE_TABLES, Stance, like, measured, parametric};

/// Names of measures and how far they may be off, millimetres.
const GIRTHS: [(&str, f64); 8] = [
    ("bust_girth", 6.0),
    ("under_bust_girth", 10.0),
    ("waist_girth", 5.0),
    ("hip_girth", 8.0),
    ("neck_girth", 8.0),
    ("upper_arm_girth", 8.0),
    ("wrist_girth", 4.0),
    ("thigh_girth", 4.0),
];
const HEIGHTS: [(&str, f64); 9] = [
    ("stature", 1.0),
    ("neck_height", 12.0),
    ("shoulder_height", 16.0),
    ("bust_height", 12.0),
    ("waist_height", 15.0),
    ("hip_height", 20.0),
    ("crotch_height", 1.0),
    ("shoulder_width", 26.0),
    ("arm_length", 26.0),
];

fn body(size: &str) -> Body {
    parametric(&BodyMeasures::size(size).unwrap()).unwrap()
}

/// The mesh alone.
fn bare(body: &Body) -> Body {
    Body {
        name: body.name.clone(),
        positions: body.positions.clone(),
        triangles: body.triangles.clone(),
        ..Body::default()
    }
}

fn agrees(known: &Body, found: &BTreeMap<String, f64>, what: &str, names: &[(&str, f64)]) {
    for (name, most) in names {
        let (have, want) = (found.get(*name).map(|x| 1e3 * x), 1e3 * known.measures[*name]);
        assert!(have.is_some_and(|h| (h - want).abs() <= *most), "{what}: {name} is {have:?}, not {want:.1}");
    }
}

#[test]
fn measures_are_found_on_the_bare_mesh() {
    for size in ["36", "38", "40", "men-48", "child-128"] {
        let known = body(size);
        let found = measured(&bare(&known));
        assert_eq!(found.pose, Pose::A, "{size}");
        assert!(found.missing.is_empty(), "{size}: {:?}", found.missing);
        agrees(&known, &found.body.measures, size, &GIRTHS);
        agrees(&known, &found.body.measures, size, &HEIGHTS);
        // A flat chest has no bust points.
        let is_flat = |name: &str| size.contains('-') && name.starts_with("bust");
        for name in known.landmarks.keys().filter(|n| !is_flat(n)) {
            let own = found.body.landmarks.get(name).unwrap_or_else(|| panic!("{size}: no {name}"));
            let off = (own - known.landmarks[name]).norm();
            assert!(off < 0.03, "{size}: {name} is off by {:.0} mm", 1e3 * off);
        }
        assert_eq!(found.body.segments.keys().collect::<Vec<_>>(), known.segments.keys().collect::<Vec<_>>());
    }
}

#[test]
fn turned_scaled_and_lifted_meshes_stand_up() {
    let known = body("38");
    type Turn = fn(Vec3) -> Vec3;
    let ways: [(&str, Turn, &str); 5] = [
        ("z up", |p| Vec3::new(p.x, -p.z, p.y), "+z up, front to -y, mm"),
        ("facing back", |p| Vec3::new(-p.x, p.y, -p.z), "+y up, front to -z, mm"),
        ("x to the front", |p| Vec3::new(p.z, p.x, p.y), "+z up, front to +x, mm"),
        ("on its head", |p| Vec3::new(-p.x, -p.y, p.z), "-y up, front to +z, mm"),
        ("lying", |p| Vec3::new(p.y, -p.x, p.z), "+x up, front to +z, mm"),
    ];
    for (name, turn, words) in ways {
        for (unit, factor) in [("mm", 1e3), ("cm", 1e2), ("inch", 1.0 / 0.0254), ("m", 1.0)] {
            let mut turned = bare(&known);
            turned.positions.iter_mut().for_each(|p| *p = turn(*p) * factor);
            let stance = Stance::of(&turned, None).unwrap();
            assert_eq!(stance.words(), words.replace("mm", unit), "{name} in {unit}");
            let upright = stance.upright(&turned);
            let off = upright.positions.iter().zip(&known.positions).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
            assert!(off < 2e-3, "{name} in {unit}: off by {off} m");
        }
    }
    let mut lifted = bare(&known);
    lifted.positions.iter_mut().for_each(|p| p.y -= 0.9);
    let stance = Stance::of(&lifted, None).unwrap();
    assert!(!stance.is_upright() && stance.words().ends_with("feet at -900 mm"), "{}", stance.words());
    assert!(Stance::of(&bare(&known), None).unwrap().is_upright());
}

#[test]
fn a_child_in_centimetres_is_no_giant_in_inches() {
    let mut child = bare(&body("child-80"));
    child.positions.iter_mut().for_each(|p| *p *= 100.0);
    assert_eq!(Stance::of(&child, None).unwrap().unit.name, "cm");
    let mut man = bare(&body("men-50"));
    man.positions.iter_mut().for_each(|p| *p /= 0.0254);
    assert_eq!(Stance::of(&man, None).unwrap().unit.name, "inch");
}

#[test]
fn open_meshes_and_meshes_of_several_parts_are_measured() {
    let known = body("38");
    let mut open = bare(&known);
    let corner = |v: u32| known.positions[v as usize];
    // Without soles, finger tips and the top of the head.
    open.triangles.retain(|t| t.iter().all(|v| (0.02..1.64).contains(&corner(*v).y) && corner(*v).x.abs() < 0.60));
    let found = measured(&open);
    assert!(found.missing.is_empty(), "{:?}", found.missing);
    agrees(&known, &found.body.measures, "open", &GIRTHS[..5]);
    agrees(&known, &found.body.measures, "open", &GIRTHS[7..]);
    // Eyes of their own within the head.
    let mut parts = bare(&known);
    let ball = [Vec3::x(), -Vec3::x(), Vec3::y(), -Vec3::y(), Vec3::z(), -Vec3::z()];
    for x in [-0.03, 0.03] {
        let first = parts.positions.len() as u32;
        parts.positions.extend(ball.map(|p| Vec3::new(x, 1.58, 0.08) + p * 0.012));
        let faces = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
        parts.triangles.extend(faces.map(|t: [u32; 3]| t.map(|v| v + first)));
    }
    agrees(&known, &measured(&parts).body.measures, "parts", &GIRTHS);
}

/// The arms of a body turned about the shoulders until they hold an angle to the vertical.
fn posed(known: &Body, angle: f64) -> Body {
    let mut out = bare(known);
    for p in &mut out.positions {
        let side = p.x.signum();
        let arm = &known.segments["arm-left"];
        let along = (arm.to - arm.from).normalize();
        let own = libm::atan2(along.x, -along.y);
        let local = Vec3::new(side * p.x, p.y, p.z) - arm.from;
        let out_of = local.dot(&along);
        let near = (local - along * out_of).norm();
        let share = if near < 0.11 { ((out_of + 0.01) / 0.09).clamp(0.0, 1.0) } else { 0.0 };
        let (sin, cos) = libm::sincos((angle.to_radians() - own) * share);
        let turned = Vec3::new(cos * local.x - sin * local.y, sin * local.x + cos * local.y, local.z) + arm.from;
        *p = Vec3::new(side * turned.x, turned.y, turned.z);
    }
    out
}

#[test]
fn arms_may_be_level_or_hang() {
    let known = body("38");
    for (angle, pose) in [(88.0, Pose::T), (60.0, Pose::A), (12.0, Pose::Down)] {
        let found = measured(&posed(&known, angle));
        assert_eq!(found.pose, pose, "{angle}°");
        let what = format!("arms at {angle}°");
        agrees(&known, &found.body.measures, &what, &[("waist_girth", 5.0), ("hip_girth", 8.0), ("thigh_girth", 4.0)]);
        agrees(&known, &found.body.measures, &what, &[("wrist_girth", 8.0), ("bust_girth", 20.0), ("neck_girth", 8.0)]);
        agrees(&known, &found.body.measures, &what, &[("upper_arm_girth", 12.0), ("arm_length", 36.0)]);
        assert_eq!(found.body.segments.len(), 6, "{angle}°");
    }
}

#[test]
fn what_a_side_file_names_leads_the_tape() {
    let known = body("38");
    let mut named = bare(&known);
    named.landmarks.insert("waist".to_owned(), Vec3::new(0.0, 1.10, 0.0));
    let found = measured(&named).body;
    assert!((found.measures["waist_height"] - 1.10).abs() < 1e-3);
    assert!(found.measures["waist_girth"] > known.measures["waist_girth"] + 0.01);
    assert_eq!(measured(&known).body.measures["waist_girth"], known.measures["waist_girth"]);
}

#[test]
fn a_mesh_without_legs_says_what_is_missing() {
    let mut bust = bare(&body("38"));
    let high = |v: &u32| bust.positions[*v as usize].y > 0.85;
    let kept: Vec<[u32; 3]> = bust.triangles.iter().filter(|t| t.iter().all(high)).copied().collect();
    bust.triangles = kept;
    assert!(Stance::of(&bust, None).is_none());
    assert!(measured(&Body::default()).missing.iter().any(|(part, _)| *part == "crotch"));
}

#[test]
fn sizes_have_names_and_neighbours() {
    let all: Vec<String> = SIZE_TABLES.iter().flat_map(|t| t.sizes.iter().map(|s| t.name(s))).collect();
    assert_eq!(all.len(), 39);
    assert!(all.iter().all(|name| BodyMeasures::size(name).is_some()));
    assert_eq!(BodyMeasures::size("38"), BodyMeasures::size("women-38"));
    assert_eq!(like("men-51"), ["men-50", "men-52"]);
    assert_eq!(like("man50"), ["men-50", "men-48"]);
    assert_eq!(like("children-125"), ["child-122", "child-128"]);
    assert_eq!(like("39"), ["women-38", "women-40"]);
    assert!(like("XL").is_empty());
}
