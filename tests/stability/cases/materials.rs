//! B: cloth at the ends of the range and beyond it.

use crate::case::{Case, case};
use crate::lab::Lab;
use crate::scenes::{apart, ball, corners, cotton, del, even, lying, sag, top, upright};
use crate::support::cloth::{Cloth, Law};
use crate::support::draped::Draped;
use crate::support::mesh::{Family, sheet};
use crate::support::trial::Trial;
use toile_garment::Vec3;

pub fn cases() -> Vec<Case> {
    let mut list = vec![case("B1-sag-rises-with-softness", sags).quick()];
    for (name, k) in STIFFNESS {
        list.push(case(format!("B1-stretch-{name}-ball"), move |lab: &mut Lab| on_ball(lab, isotropic(k))).quick());
    }
    list.extend([case("B2-strain-with-mass", masses).quick(), case("B2-ball-2kg", heavy).quick()]);
    list.push(case("B3-bend-0-hung", |lab: &mut Lab| hung(lab, Cloth { bending: 0.0, ..cotton() }).map(drop)).quick());
    list.push(case("B3-bend-0-ball", |lab: &mut Lab| on_ball(lab, Cloth { bending: 0.0, ..cotton() })).quick());
    list.push(case("B4-bend-1e-2-ball", |lab: &mut Lab| on_ball(lab, Cloth { bending: 1e-2, ..cotton() })).quick());
    for degrees in [0.0, 30.0, 45.0, 90.0] {
        list.push(case(format!("B5-1000-to-1-grain-{degrees}"), move |lab: &mut Lab| grain(lab, degrees)).quick());
    }
    list.push(case("B5-mirrored-grain", mirrored).quick().once());
    list.push(case("B6-kinked-curve", kinked).quick());
    list.push(case("B7-curves-refused", curves).quick().once());
    list.push(case("B9-values-refused", values).quick().once());
    list.push(case("B11-strain-limit-1-percent", limit).quick());
    list
}

const STIFFNESS: [(&str, f64); 5] = [("1e2", 1e2), ("1e3", 1e3), ("1e4", 1e4), ("1e5", 1e5), ("1e6", 1e6)];

fn isotropic(k: f64) -> Cloth {
    Cloth { limit: 2.0, ..Cloth { thickness: 4e-4, ..Cloth::linear(0.15, k, 0.4 * k, 1e-5) } }
}

/// Hung by two corners.
fn hung(lab: &mut Lab, fabric: Cloth) -> Result<(Trial, Draped), String> {
    let cloth = upright(del(0.3, 0.02));
    let held = corners(&cloth);
    let trial = Trial::new(cloth, fabric).hold(held);
    let d = lab.settles(&trial)?;
    Ok((trial, d))
}

fn on_ball(lab: &mut Lab, fabric: Cloth) -> Result<(), String> {
    lab.settles(&Trial::new(lying(del(0.3, 0.02), 0.102), fabric).over(ball(0.1, Vec3::zeros(), 3)))?;
    Ok(())
}

/// The softer, the lower; at 1e6 N/m next to no stretch; and that without ten times the work.
fn sags(lab: &mut Lab) -> Result<(), String> {
    let mut sags = Vec::new();
    let mut largest = f64::INFINITY;
    for (_, k) in STIFFNESS {
        let (trial, d) = hung(lab, isotropic(k))?;
        sags.push(sag(&d.at));
        largest = trial.cloth.stretch(&d.at);
    }
    lab.expect(sags.windows(2).all(|s| s[1] < s[0] + 1e-5), format!("sags {sags:?} m"));
    lab.below("stretch at 1e6 N/m", largest, 1e-4);
    Ok(())
}

/// A strip hung by its upper edge lengthens in proportion to its mass.
fn masses(lab: &mut Lab) -> Result<(), String> {
    let mut shares = Vec::new();
    for mass in [0.02, 0.2, 2.0] {
        let cloth = upright(even(0.1, 0.3, 0.02));
        let held = top(&cloth);
        let low = cloth.pick(|[_, v]| v < 1e-9);
        let fabric = Cloth { mass, ..cotton() };
        let d = lab.settles(&Trial::new(cloth, fabric).hold(held).set("accuracy = \"reference\""))?;
        shares.push((-0.3 - d.mean(low).z) / mass);
    }
    lab.near("strain over mass, 0.02 kg/m2", shares[0], shares[1], 0.05);
    lab.near("strain over mass, 2 kg/m2", shares[2], shares[1], 0.05);
    // m g L² / 2 k
    lab.near("lengthening m per kg/m2", shares[1], 9.81 * 0.09 / 2.0 / 2000.0, 0.05);
    Ok(())
}

fn heavy(lab: &mut Lab) -> Result<(), String> {
    on_ball(lab, Cloth { mass: 2.0, ..cotton() })
}

/// Warp a thousand times as stiff as the weft.
fn ropes() -> Cloth {
    Cloth {
        warp: Law::Linear(1e5),
        weft: Law::Linear(1e2),
        limit: 2.0,
        thickness: 4e-4,
        ..Cloth::linear(0.15, 1e3, 100.0, 1e-5)
    }
}

fn grain(lab: &mut Lab, degrees: f64) -> Result<(), String> {
    let cloth = upright(del(0.3, 0.02));
    let held = corners(&cloth);
    lab.settles(&Trial::new(cloth.turn(degrees.to_radians()), ropes()).hold(held))?;
    Ok(())
}

/// Grain at 30° draws a hanging strip to one side, at −30° as far to the other.
fn mirrored(lab: &mut Lab) -> Result<(), String> {
    let mut aside = Vec::new();
    for degrees in [30.0f64, -30.0] {
        let cloth = upright(sheet::sheet([0.06, 0.2], 6, 22, Family::Regular, |_| true));
        let (held, low) = (top(&cloth), cloth.pick(|[_, v]| v < 1e-9));
        let fabric = Cloth { bending: 1e-4, ..ropes() };
        let trial = Trial::new(cloth.turn(degrees.to_radians()), fabric).hold(held).set("accuracy = \"reference\"");
        aside.push(lab.settles(&trial)?.mean(low).x);
    }
    lab.note(format!("{:.2} mm aside", aside[0] * 1e3));
    lab.expect(aside[0].abs() > 1e-4, format!("the grain draws nothing aside: {} m", aside[0]));
    lab.below("sum of both m", (aside[0] + aside[1]).abs(), 1e-5);
    Ok(())
}

/// Tensions of a curve with kinks at 2, 5 and 8 %: slopes 500, 5,000 and 50,000 N/m, then 50,000.
const KINKS: &str =
    r#"[["0 %", "0 N/m"], ["2 %", "10 N/m"], ["5 %", "160 N/m"], ["8 %", "1660 N/m"], ["20 %", "7660 N/m"]]"#;

fn curved(rows: &str) -> String {
    format!(
        "name = \"curve\"\nareal_mass = \"0.01 kg/m2\"\nthickness = \"0.4 mm\"\nfriction = 0.3\nstrain_limit_warp = \"15 %\"\n\
         strain_limit_weft = \"15 %\"\n[curve]\nwarp = {rows}\nweft = {rows}\nshear = \"100 N/m/rad\"\nbending = \"1e-6 N.m\"\n"
    )
}

/// A strip of 100 × 25 mm under loads from 2 to 50 N follows its table.
fn kinked(lab: &mut Lab) -> Result<(), String> {
    let strip = upright(even(0.025, 0.1, 0.0125));
    for (tension, strain) in [(5.0, 0.01), (10.0, 0.02), (85.0, 0.035), (160.0, 0.05), (910.0, 0.065)] {
        let (held, low) = (top(&strip), strip.pick(|[_, v]| v < 1e-9));
        let share = |v: usize| if strip.at[v].x.abs() > 0.0124 { 0.5 } else { 1.0 };
        let loads = low.iter().map(|v| (*v, Vec3::z() * (-tension * 0.0125 * share(*v)))).collect();
        let fabric = Cloth { mass: 0.01, ..cotton() };
        let trial = Trial { loads, ..Trial::new(strip.clone(), fabric).weightless() }.hold(held);
        let trial = trial.set("accuracy = \"fine\"").text("fabric.toml", curved(KINKS));
        let d = lab.settles(&trial)?;
        lab.near(&format!("strain under {tension} N/m"), (-0.1 - d.mean(low).z) / 0.1, strain, 0.01);
    }
    Ok(())
}

/// Curves that no cloth has are refused with the row.
fn curves(lab: &mut Lab) -> Result<(), String> {
    for rows in [
        r#"[["0 %", "0 N/m"], ["4 %", "20 N/m"], ["6 %", "10 N/m"]]"#,
        r#"[["0 %", "0 N/m"], ["4 %", "20 N/m"], ["4 %", "30 N/m"]]"#,
        r#"[["0 %", "5 N/m"], ["4 %", "20 N/m"]]"#,
        r#"[["4 %", "20 N/m"], ["2 %", "10 N/m"]]"#,
        r#"[["0 %", "0 N/m"], ["4 %", "nan N/m"]]"#,
        r#"[["0 %", "0 N/m"]]"#,
        r#"[[0.0, 0.0], [0.04, 20.0]]"#,
    ] {
        let cloth = lying(even(0.1, 0.1, 0.05), 0.0);
        lab.refuses(&Trial::new(cloth, cotton()).hold([0]).text("fabric.toml", curved(rows)), 3, "fabric-curve")?;
    }
    Ok(())
}

/// Values that no cloth has are refused.
fn values(lab: &mut Lab) -> Result<(), String> {
    let good = cotton();
    for fabric in [
        Cloth { warp: Law::Linear(0.0), ..good },
        Cloth { mass: 0.0, ..good },
        Cloth { mass: -0.1, ..good },
        Cloth { thickness: -1e-4, ..good },
        Cloth { shear: -1.0, ..good },
        Cloth { bending: -1e-6, ..good },
        Cloth { poisson: 0.5, ..good },
        Cloth { poisson: 0.6, ..good },
        Cloth { friction: -0.1, ..good },
    ] {
        lab.refuses(&Trial::new(lying(even(0.1, 0.1, 0.05), 0.0), fabric).hold([0]), 3, "value-out-of-range")?;
    }
    Ok(())
}

/// Hung by two corners, 0.45 kg at the middle of the hem, no more than 1 % of strain.
fn limit(lab: &mut Lab) -> Result<(), String> {
    let cloth = upright(even(0.3, 0.3, 0.02));
    let (held, middle) = (corners(&cloth), cloth.pick(|[u, v]| v < 1e-9 && (u - 0.16).abs() < 0.011));
    let load = middle.first().map(|v| (*v, Vec3::z() * (-9.81 * 0.45))).ok_or("a middle")?;
    let trial = Trial { loads: vec![load], ..Trial::new(cloth, Cloth { limit: 0.01, ..cotton() }) }.hold(held);
    let start = trial.cloth.at.clone();
    let d = lab.settles(&trial)?;
    lab.below("largest strain", d.figure("strain_max"), 0.01 + 1e-6);
    lab.expect(apart(&start, &d.at) > 1e-3, "it did not move");
    Ok(())
}
