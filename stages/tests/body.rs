//! The parametric body: closed, clean, symmetric, and true to the tape.
//!
//! ```text
//! cargo test --release --package toile-stages --test body -- --ignored
//! ```
//!
//! tries every size of every table, and not only the ends and middles of the tables.
#![allow(clippy::unwrap_used)]

use rayon::prelude::*;
use std::collections::BTreeMap;
use toile_formats::body::write;
use toile_garment::Vec3;
use toile_garment::body::Body;
use toile_stages::body::{
    BodyMeasures, SIZE_TABLES, SizeTable, girth_at, parametric, section_at, section_near, sections,
};

/// Every size of every table.
fn sizes() -> Vec<BodyMeasures> {
    let of = |t: &SizeTable| t.sizes.iter().map(|s| t.measures(s)).collect::<Vec<_>>();
    SIZE_TABLES.iter().flat_map(of).collect()
}

/// The ends and the middle of every table, a tall, a short, a large and a small figure, and one with a large cup.
fn figures() -> Vec<BodyMeasures> {
    let of = |t: &SizeTable| [0, t.sizes.len() / 2, t.sizes.len() - 1].map(|i| t.measures(&t.sizes[i]));
    let mut all: Vec<BodyMeasures> = SIZE_TABLES.iter().flat_map(of).collect();
    let with = |name: &str, changes: &[(&str, f64)]| {
        let mut m = BodyMeasures { name: name.to_owned(), ..BodyMeasures::default() };
        for (measure, mm) in changes {
            assert!(m.set(measure, mm / 1000.0), "{measure}");
        }
        m
    };
    all.push(with("size-32", &girths([760.0, 600.0, 840.0, 330.0, 250.0, 490.0, 148.0])));
    let mut larger = girths([1040.0, 880.0, 1120.0, 395.0, 330.0, 630.0, 175.0]).to_vec();
    larger.extend([("shoulder_width", 396.0), ("bust_height", 1205.0)]);
    all.push(with("size-46", &larger));
    let mut large = girths([1280.0, 1130.0, 1340.0, 430.0, 410.0, 720.0, 195.0]).to_vec();
    large.extend([("shoulder_width", 416.0), ("bust_height", 1190.0)]);
    all.push(with("size-54", &large));
    all.push(with("tall", &heights(1.07)));
    all.push(with("short", &heights(0.91)));
    all.push(with("large-cup", &[("under_bust_girth", 720.0)]));
    all.push(with("small-cup", &[("under_bust_girth", 790.0)]));
    all
}

fn girths(mm: [f64; 7]) -> [(&'static str, f64); 7] {
    let [bust, waist, hip, neck, arm, thigh, wrist] = mm;
    [
        ("bust_girth", bust),
        ("waist_girth", waist),
        ("hip_girth", hip),
        ("neck_girth", neck),
        ("upper_arm_girth", arm),
        ("thigh_girth", thigh),
        ("wrist_girth", wrist),
    ]
}

fn heights(factor: f64) -> Vec<(&'static str, f64)> {
    let base = BodyMeasures::default();
    let tall =
        base.entries().into_iter().filter(|(n, _)| n.ends_with("height") || *n == "stature" || *n == "arm_length");
    tall.map(|(name, metres)| (name, metres * 1000.0 * factor)).collect()
}

fn near(name: &str, what: &str, have: f64, want: f64, share: f64) {
    assert!((have - want).abs() <= share * want, "{name}: {what} is {:.2} mm, not {:.2} mm", have * 1e3, want * 1e3);
}

#[test]
fn every_figure_is_closed_clean_symmetric_and_true_to_the_tape() {
    check(&figures());
}

#[test]
#[ignore = "all sizes of all tables take two minutes"]
fn every_size_is_closed_clean_symmetric_and_true_to_the_tape() {
    check(&sizes());
}

fn check(figures: &[BodyMeasures]) {
    figures.par_iter().for_each(|m| {
        let body = parametric(m).unwrap_or_else(|found| panic!("{}: {found:?}", m.name));
        closed_and_outwards(&body);
        even_triangles(&body);
        symmetric(&body);
        assert_eq!(crossings(&body), 0, "{}", m.name);
        tape_agrees(m, &body);
        heights_agree(m, &body);
        gaps_are_open(m, &body);
    });
}

fn closed_and_outwards(body: &Body) {
    let mut edges: BTreeMap<(u32, u32), i32> = BTreeMap::new();
    for t in &body.triangles {
        for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
            *edges.entry((a, b)).or_default() += 1;
        }
    }
    assert!(edges.iter().all(|((a, b), n)| *n == 1 && edges.get(&(*b, *a)) == Some(&1)), "{}: not manifold", body.name);
    let euler = body.positions.len() + body.triangles.len() - edges.len() / 2;
    assert_eq!(euler, 2, "{}: not one ball", body.name);
    let volume: f64 = body.triangles.iter().map(|t| corners(body, t)).map(|[a, b, c]| a.dot(&b.cross(&c)) / 6.0).sum();
    let adult = volume / (share(body) * share(body) * share(body));
    assert!((0.03..0.2).contains(&adult), "{}: {volume} m³", body.name);
}

/// Children are shrunk: the share of the adult's size.
fn share(body: &Body) -> f64 {
    let stature = body.measures["stature"];
    if stature < 1.5 { stature / 1.68 } else { 1.0 }
}

fn corners(body: &Body, t: &[u32; 3]) -> [Vec3; 3] {
    t.map(|v| body.positions[v as usize])
}

fn even_triangles(body: &Body) {
    assert!((9_000..20_000).contains(&body.triangles.len()), "{}: {} triangles", body.name, body.triangles.len());
    for p in body.triangles.iter().map(|t| corners(body, t)) {
        for i in 0..3 {
            let (u, v) = (p[(i + 1) % 3] - p[i], p[(i + 2) % 3] - p[i]);
            let angle = u.angle(&v).to_degrees();
            assert!(angle > 20.0, "{}: angle {angle:.1}° at {:?}", body.name, p[i]);
            assert!((0.004..0.036).contains(&(u.norm() / share(body))), "{}: edge {:.1} mm", body.name, u.norm() * 1e3);
        }
    }
}

fn symmetric(body: &Body) {
    let steps = |p: &Vec3, side: f64| [side * p.x, p.y, p.z].map(|x| (x * 1e6).round() as i64);
    let mut left: Vec<[i64; 3]> = body.positions.iter().map(|p| steps(p, 1.0)).collect();
    let mut right: Vec<[i64; 3]> = body.positions.iter().map(|p| steps(p, -1.0)).collect();
    left.sort_unstable();
    right.sort_unstable();
    assert_eq!(left, right, "{}: not symmetric", body.name);
}

/// Pairs of triangles that cross: an edge of one pierces the other.
fn crossings(body: &Body) -> usize {
    let cell = |x: f64| (x / 0.04).floor() as i32;
    let mut cells: BTreeMap<[i32; 3], Vec<usize>> = BTreeMap::new();
    for (id, t) in body.triangles.iter().enumerate() {
        let p = corners(body, t);
        let (low, high) = (p[0].inf(&p[1]).inf(&p[2]).map(cell), p[0].sup(&p[1]).sup(&p[2]).map(cell));
        for x in low.x..=high.x {
            for y in low.y..=high.y {
                for z in low.z..=high.z {
                    cells.entry([x, y, z]).or_default().push(id);
                }
            }
        }
    }
    let pairs = cells.values().flat_map(|ids| ids.iter().flat_map(move |a| ids.iter().map(move |b| (*a, *b))));
    pairs.filter(|(a, b)| a != b && pierces(body, &body.triangles[*a], &body.triangles[*b])).count()
}

fn pierces(body: &Body, a: &[u32; 3], b: &[u32; 3]) -> bool {
    let q = corners(body, b);
    let side = |p: Vec3| (q[1] - q[0]).cross(&(q[2] - q[0])).dot(&(p - q[0]));
    [(a[0], a[1]), (a[1], a[2]), (a[2], a[0])].iter().filter(|(v, w)| !b.contains(v) && !b.contains(w)).any(|(v, w)| {
        let (from, to) = (body.positions[*v as usize], body.positions[*w as usize]);
        let (s, t) = (side(from), side(to));
        if (s > 0.0) == (t > 0.0) {
            return false;
        }
        let along = to - from;
        let turn = |i: usize| (q[i] - from).cross(&(q[(i + 1) % 3] - from)).dot(&along) > 0.0;
        turn(0) == turn(1) && turn(1) == turn(2)
    })
}

fn tape_agrees(m: &BodyMeasures, body: &Body) {
    for (what, height, want) in [
        ("hip", m.hip_height, m.girths.hip),
        ("waist", m.waist_height, m.girths.waist),
        ("bust", m.bust_height, m.girths.bust),
        ("under bust", m.bust_height - 0.075 * share(body), m.under_bust()),
    ] {
        near(&m.name, what, girth_at(body, height), want, 0.002);
    }
    let around =
        |point: Vec3, normal: Vec3| section_near(&body.positions, &body.triangles, point, normal).unwrap().girth();
    for side in ["left", "right"] {
        let arm = &body.segments[&format!("arm-{side}")];
        let along = arm.to - arm.from;
        near(&m.name, "upper arm", around(arm.from + along * 0.29, along), m.girths.upper_arm, 0.002);
        near(&m.name, "wrist", around(arm.to, along), m.girths.wrist, 0.002);
        let leg = &body.segments[&format!("leg-{side}")];
        let thigh = Vec3::new(leg.from.x, m.crotch_height - 0.035 * share(body), leg.from.z);
        near(&m.name, "thigh", around(thigh, Vec3::y()), m.girths.thigh, 0.002);
    }
    let neck = &body.segments["neck"];
    let up = (neck.from - neck.to).normalize();
    near(&m.name, "neck", around(neck.to + up * (0.055 * share(body)), up), m.girths.neck, 0.002);
    for (name, want) in m.entries() {
        near(&m.name, name, body.measures[name], want, 0.01);
    }
}

fn heights_agree(m: &BodyMeasures, body: &Body) {
    let top = body.positions.iter().map(|p| p.y).fold(0.0, f64::max);
    let floor = body.positions.iter().map(|p| p.y).fold(1.0, f64::min);
    near(&m.name, "stature", top, m.stature, 0.002);
    assert!(floor.abs() < 1e-3, "{}: floor {floor}", m.name);
    let mark = |name: &str| body.landmarks[name];
    near(&m.name, "bust height", mark("bust-left").y, m.bust_height, 0.002);
    near(&m.name, "shoulder height", mark("shoulder-left").y, m.shoulder_height, 0.002);
    near(&m.name, "neck height", mark("neck-back").y, m.neck_height, 0.002);
    near(&m.name, "crotch height", mark("crotch").y, m.crotch_height, 0.01);
    near(&m.name, "shoulder width", mark("shoulder-left").x - mark("shoulder-right").x, m.shoulder_width, 0.002);
    near(&m.name, "arm length", (mark("wrist-left") - mark("shoulder-left")).norm(), m.arm_length, 0.01);
    for (name, p) in &body.landmarks {
        let gap = body.positions.iter().map(|q| (q - p).norm()).fold(f64::INFINITY, f64::min);
        assert!(gap < 0.022, "{}: {name} lies {:.1} mm off the mesh", m.name, gap * 1e3);
    }
    // The waist is a waist: between ribs and hips nothing is smaller by more than a hair.
    let slim = (0..12)
        .map(|i| girth_at(body, m.waist_height + share(body) * (0.01 * f64::from(i) - 0.055)))
        .fold(f64::INFINITY, f64::min);
    if m.girths.waist < 0.95 * m.under_bust() {
        near(&m.name, "smallest girth near the waist", slim, m.girths.waist, 0.01);
    }
}

/// Cloth fits between arm and torso right under the armpit, and between the legs under the crotch.
fn gaps_are_open(m: &BodyMeasures, body: &Body) {
    let armpit = body.landmarks["underarm-left"].y;
    let share = share(body);
    assert!(m.shoulder_height - armpit > 0.08 * share && armpit > m.bust_height, "{}: armpit at {armpit}", m.name);
    for (below, least) in [(0.02 * share, 0.02 * share), (0.05 * share, 0.04 * share)] {
        let torso = section_at(body, armpit - below).unwrap().bounds().1.x;
        let loops = sections(&body.positions, &body.triangles, Vec3::new(0.0, armpit - below, 0.0), Vec3::y());
        let arm = loops.iter().map(|s| s.bounds().0.x).fold(0.0, f64::max);
        assert!(arm - torso > least, "{}: {:.1} mm beside the torso", m.name, (arm - torso) * 1e3);
    }
    for height in [m.crotch_height - 0.04 * share, 0.6 * m.crotch_height, 0.05 * share] {
        let loops = sections(&body.positions, &body.triangles, Vec3::new(0.0, height, 0.0), Vec3::y());
        let inner = loops.iter().map(|s| s.bounds().0.x).filter(|x| *x > 0.0).fold(1.0, f64::min);
        assert!(2.0 * inner > 0.015 * share, "{}: {:.1} mm between the legs at {height}", m.name, 2e3 * inner);
    }
}

#[test]
fn the_same_measures_give_the_same_bytes() {
    let m = BodyMeasures::default();
    assert_eq!(write(&parametric(&m).unwrap()), write(&parametric(&m).unwrap()));
}

#[test]
fn impossible_measures_are_refused_with_every_reason() {
    let with = |changes: &[(&str, f64)]| {
        let mut m = BodyMeasures::default();
        for (name, metres) in changes {
            assert!(m.set(name, *metres));
        }
        parametric(&m).unwrap_err()
    };
    let found = with(&[("waist_girth", 3.0), ("neck_girth", -0.3), ("stature", f64::NAN)]);
    assert_eq!(found.len(), 3);
    assert!(found.iter().all(|f| f.code == "body-measure-out-of-range"));
    assert_eq!(found[1].message, "waist_girth = 3000.0 mm is no measure of a body");
    assert_eq!(found[1].hint.as_deref(), Some("give waist_girth between 480 mm and 1600 mm"));
    let found = with(&[("waist_height", 0.90), ("thigh_girth", 0.80)]);
    assert!(found.iter().all(|f| f.code == "body-measures-contradict"));
    assert_eq!(found[0].message, "hip_height = 840.0 mm is not at least 100 mm under waist_height = 900.0 mm");
    assert!(found[1].message.starts_with("thigh_girth = 800.0 mm does not go with hip_girth = 960.0 mm"));
}

#[test]
fn unknown_sizes_and_measures_are_told() {
    assert!(BodyMeasures::size("39").is_none());
    assert!(!BodyMeasures::default().set("waist", 0.7));
}
