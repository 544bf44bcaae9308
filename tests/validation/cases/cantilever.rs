//! Cantilever strips: the master curve of drop over reach, and the 41.5° test.

use crate::case::{Case, case, share};
use crate::closed::{G, elastica};
use crate::lab::Lab;
use crate::support::cloth::Cloth;
use crate::support::mesh::{FAMILIES, Family, sheet};
use crate::support::trial::Trial;
use toile_garment::Vec3;

/// Free length, m.
const LENGTH: f64 = 0.2;
const WIDTH: f64 = 0.02;
/// Areal weight, N/m².
const W: f64 = 1.962;

pub fn cases() -> Vec<Case> {
    let mut list = Vec::new();
    for f in FAMILIES {
        list.push(case(format!("cantilever-master.{}", f.name()), move |lab: &mut Lab| master(lab, f)));
    }
    for (couple, gammas) in [(0.5, [5.0, 20.0]), (2.0, [20.0, 50.0])] {
        list.push(case(format!("cantilever-friction.{couple}"), move |lab: &mut Lab| friction(lab, couple, gammas)));
    }
    for (couple, gammas) in [(0.5, [5.0, 20.0]), (2.0, [20.0, 50.0])] {
        list.push(case(format!("cantilever-curve.{couple}"), move |lab: &mut Lab| knee(lab, couple, gammas)).quick());
    }
    for curl in [-1.5, 1.5] {
        list.push(case(format!("cantilever-curl.{curl}"), move |lab: &mut Lab| curled(lab, curl)).quick());
    }
    list.push(case("bending-length-0", bending_length));
    list
}

fn master(lab: &mut Lab, family: Family) -> Result<(), String> {
    for gamma in [0.1, 1.0, 5.0, 10.0, 50.0, 100.0] {
        let tolerance = if gamma > 50.0 { share(0.02, 0.1) } else { share(0.01, 0.1) };
        let expected = elastica::cantilever(gamma).ratio();
        let (drop, reach) = bend(lab, family, gamma)?;
        lab.figure(format!("H/W at {gamma}"), drop / reach, expected, tolerance);
    }
    Ok(())
}

/// Curvature at which the friction has built up, over 1/c (stages/cloth/docs/hysteresis.md).
const RISE: f64 = 0.02;

/// A frictional couple HB beside the elastic one, for HB L/B.
fn friction(lab: &mut Lab, couple: f64, gammas: [f64; 2]) -> Result<(), String> {
    for gamma in gammas {
        let expected = elastica::rubbing(gamma, couple, RISE * libm::cbrt(gamma)).ratio();
        let (drop, reach) = bend_with(lab, Family::Regular, gamma, |fabric| {
            fabric.hysteresis = 2.0 * couple * fabric.bending / LENGTH
        })?;
        lab.figure(format!("H/W at {gamma}"), drop / reach, expected, share(0.02, 0.1));
    }
    Ok(())
}

/// Curvature times length up to which the measured curve is steeper.
const KNEE: f64 = 1.0;

/// A measured curve: beside the elastic moment one that grows to HB and stays, for HB L/B.
fn knee(lab: &mut Lab, couple: f64, gammas: [f64; 2]) -> Result<(), String> {
    for gamma in gammas {
        let expected = elastica::rubbing(gamma, couple, KNEE).ratio();
        let (drop, reach) = bend_with(lab, Family::Regular, gamma, |fabric| {
            fabric.bend_knee = Some([KNEE / LENGTH, couple * fabric.bending / LENGTH])
        })?;
        lab.figure(format!("H/W at {gamma}"), drop / reach, expected, share(0.01, 0.1));
    }
    Ok(())
}

/// Cloth that bends up or down without load, by an angle `curl` over its free length.
fn curled(lab: &mut Lab, curl: f64) -> Result<(), String> {
    for gamma in [2.0, 10.0] {
        let expected = elastica::curled(gamma, curl);
        // The right side of the strip lies below.
        let (drop, reach) = bend_with(lab, Family::Regular, gamma, |fabric| fabric.curl = curl / LENGTH)?;
        lab.figure(format!("drop m at {gamma}"), drop, expected.drop * LENGTH, share(0.02, 0.1));
        lab.figure(format!("reach m at {gamma}"), reach, expected.reach * LENGTH, share(0.01, 0.1));
    }
    Ok(())
}

/// The overhang at which the chord slopes by 41.5°: Γ by the secant rule on log Γ, on one mesh.
fn bending_length(lab: &mut Lab) -> Result<(), String> {
    let angle = f64::to_radians(41.5);
    let expected = elastica::gamma_at_chord(angle);
    let mut slope = |log: f64| {
        let (drop, reach) = bend(lab, Family::Regular, libm::exp(log))?;
        Ok::<f64, String>(libm::atan2(drop, reach) - angle)
    };
    let (mut a, mut b) = (libm::log(7.0), libm::log(9.0));
    let (mut fa, mut fb) = (slope(a)?, slope(b)?);
    for _ in 0..2 {
        let next = b - fb * (b - a) / (fb - fa);
        (a, fa) = (b, fb);
        (b, fb) = (next, slope(next)?);
    }
    let gamma = libm::exp(b - fb * (b - a) / (fb - fa));
    lab.figure("Gamma at 41.5 deg", gamma, expected, share(0.015, 0.15));
    lab.figure("c over l", 1.0 / libm::cbrt(gamma), 1.0 / libm::cbrt(expected), share(0.005, 0.05));
    Ok(())
}

/// Drop and reach of the tip. Two rows are held, and the hinge over the second of them bends over half a cell on each
/// side, so the free length counts from half a cell behind it.
fn bend(lab: &mut Lab, family: Family, gamma: f64) -> Result<(f64, f64), String> {
    bend_with(lab, family, gamma, |_| {})
}

fn bend_with(lab: &mut Lab, family: Family, gamma: f64, more: impl Fn(&mut Cloth)) -> Result<(f64, f64), String> {
    let rows = if family == Family::Right { 40 } else { 44 };
    let cell = LENGTH / (rows as f64 + 0.5);
    let total = LENGTH + 0.5 * cell;
    let calm = |v: f64| v < 2.5 * cell;
    let mesh = sheet::sheet([WIDTH, total], 4, rows + 1, family, calm).place(|[u, v]| Vec3::new(v, u, 0.0));
    let held = mesh.pick(|r| r[1] < cell + 1e-9);
    let tip = mesh.pick(|r| r[1] > total - 1e-9);
    let bending = W * LENGTH * LENGTH * LENGTH / gamma;
    // K ≥ 1e3 w L keeps the stretch out of the figure.
    let mut fabric = Cloth::linear(W / G, 1900.0, 190.0, bending);
    more(&mut fabric);
    let d = lab.drape(&Trial::new(mesh, fabric).hold(held))?;
    let tip = d.mean(tip);
    Ok((-tip.z, tip.x - 0.5 * cell))
}
