//! The table of `drape.md`: the virtual drape beside what laboratories found.
//!
//! `cargo test --release -p toile-stages --lib drape_beside_laboratories -- --ignored --nocapture`

use super::cusick::{CusickParams, cusick};
use super::{GRAVITY, bending_length};
use crate::testing::{cloth, lend};
use toile_garment::fabric::Fabric;

/// The mean of three readings: drape coefficient, %, and nodes.
fn drape(fabric: &Fabric) -> [f64; 2] {
    let read = |repeat| {
        let params = CusickParams { edge: 8e-3, repeat, ..CusickParams::default() };
        let c = lend(|cx| cusick(fabric, &params, cx)).0.expect("at rest");
        [100.0 * c.drape_coefficient, c.nodes.len() as f64]
    };
    let all: Vec<[f64; 2]> = (0..3).map(read).collect();
    [0, 1].map(|k| all.iter().map(|r| r[k]).sum::<f64>() / 3.0)
}

/// Cusick 1965: bending length, cm, and the angle at which the cloth buckles in shear, degrees.
fn cusick_1965(c: f64, angle: f64) -> f64 {
    35.6 * c - 3.61 * c * c - 2.59 * angle + 0.0461 * angle * angle + 17.0
}

/// Niwa and Seto 1986, in units of KES; a hysteresis of shear is not in fabric files.
fn niwa_1986(f: &Fabric, hysteresis: f64) -> f64 {
    let weight = f.areal_mass / 0.01;
    let term = |factor: f64, value: f64| factor * libm::cbrt(value / weight);
    let bending = 0.5 * (f.bend_warp + f.bend_weft) / 9.80665e-5;
    let of_bending = term(115.0, bending) + term(131.1, f.bend_hysteresis.unwrap_or(0.0) / 9.80665e-3);
    5.1 + of_bending + term(1.2, f.shear / 56.188) + term(4.2, hysteresis)
}

fn of_length(c: f64, weight: f64, stretch: f64, shear: f64) -> Fabric {
    cloth(weight, stretch, shear, [weight * GRAVITY * c * c * c; 2])
}

fn beside_cusick() {
    println!("c cm | 0.1 kg/m2: DC nodes | 0.2 kg/m2: DC nodes | Cusick 1965, A = 5, 10, 20, 28 deg");
    for tenths in [10, 15, 20, 25, 30, 35, 40] {
        let c = 0.1 * f64::from(tenths);
        let [[light, l], [heavy, h]] = [0.1, 0.2].map(|w| drape(&of_length(0.01 * c, w, 3000.0, 40.0)));
        let [a, b, d, e] = [5.0, 10.0, 20.0, 28.0].map(|angle| cusick_1965(c, angle));
        println!("{c:.1} | {light:.1} {l:.1} | {heavy:.1} {h:.1} | {a:.1} {b:.1} {d:.1} {e:.1}");
    }
}

fn beside_stiffness() {
    println!("stretch N/m | c = 2 cm, 0.15 kg/m2: DC at G = 1, 5, 20, 60 N/m");
    for stretch in [100.0, 1000.0, 1e4] {
        let [a, b, c, d] = [1.0, 5.0, 20.0, 60.0].map(|shear| drape(&of_length(0.02, 0.15, stretch, shear))[0]);
        println!("{stretch} | {a:.1} {b:.1} {c:.1} {d:.1}");
    }
}

/// B, N m, and 2HB, N, of Matsudaira et al. 2015; the areal mass, stretch and shear are assumed.
fn measured() -> Vec<(Fabric, &'static str)> {
    let mut all = Vec::new();
    let mut add = |name: &str, masses: [f64; 3], shear: f64, [b, hysteresis]: [f64; 2], lab| {
        for mass in masses {
            let plain = cloth(mass, 5000.0, shear, [b, b]);
            all.push((Fabric { name: name.to_owned(), bend_hysteresis: Some(hysteresis), ..plain }, lab));
        }
    };
    add("cotton broadcloth", [0.10, 0.12, 0.14], 45.0, [1.157e-5, 1.216e-3], "82.9");
    add("polyester faille", [0.10, 0.12, 0.15], 25.0, [1.863e-6, 6.865e-5], "28.3");
    add("wool tropical", [0.15, 0.18, 0.21], 30.0, [6.57e-6, 3.24e-4], "-");
    all
}

fn samples() -> Vec<(Fabric, &'static str)> {
    ["silk-habotai", "cotton-shirting", "linen-plain", "wool-suiting", "denim-11oz", "cotton-jersey"]
        .map(|name| {
            let path = format!("{}/../samples/fabrics/{name}.toml", env!("CARGO_MANIFEST_DIR"));
            let text = std::fs::read_to_string(&path).expect("a sample");
            (toile_formats::fabric::read(&text, name).expect("a fabric"), "-")
        })
        .into()
}

fn beside_hysteresis() {
    println!(
        "fabric | kg/m2 | c cm | without 2HB: DC nodes | with: DC nodes | Niwa 1986, 2HG = 0, 2 gf/cm | laboratory"
    );
    for (fabric, lab) in measured().into_iter().chain(samples()) {
        let (name, mass) = (&fabric.name, fabric.areal_mass);
        let c = 50.0 * (bending_length(fabric.bend_warp, mass) + bending_length(fabric.bend_weft, mass));
        let [without, w] = drape(&Fabric { bend_hysteresis: None, ..fabric.clone() });
        let [with, n] = drape(&fabric);
        let [low, high] = [0.0, 2.0].map(|hysteresis| niwa_1986(&fabric, hysteresis));
        println!("{name} | {mass:.3} | {c:.2} | {without:.1} {w:.1} | {with:.1} {n:.1} | {low:.1} {high:.1} | {lab}");
    }
}

#[test]
#[ignore = "minutes: prints a table"]
fn drape_beside_laboratories() {
    beside_cusick();
    beside_stiffness();
    beside_hysteresis();
}
