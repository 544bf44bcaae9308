//! Strips held at one end that ring, along themselves and across. Draped under a weight and let go without it, they
//! swing in many modes; the sum over the shape of the first, weighted with the masses, holds that one alone.

use crate::case::{Case, case, share};
use crate::closed::ring;
use crate::lab::Lab;
use crate::motion::Motion;
use crate::support::cloth::Cloth;
use crate::support::mesh::{FAMILIES, Family, sheet};
use crate::support::trial::Trial;
use std::f64::consts::{FRAC_PI_2, TAU};
use toile_garment::Vec3;

const SIGMA: f64 = 0.2;

pub fn cases() -> Vec<Case> {
    let mut list = vec![case("axial-0", axial)];
    for f in FAMILIES {
        list.push(case(format!("cantilever-vibration-0.{}", f.name()), move |lab: &mut Lab| across(lab, f)));
    }
    list
}

fn axial(lab: &mut Lab) -> Result<(), String> {
    let (length, k, n) = (0.5, 200.0, 50);
    let mesh = sheet::sheet([0.02, length], 2, n, Family::Right, |_| true).place(|[u, v]| Vec3::new(u, 0.0, -v));
    let top = mesh.pick(|r| r[1] < 1e-9);
    let trial = Trial::new(mesh, Cloth::linear(SIGMA, k, 10.0, 0.0)).hold(top);
    // Ten periods, 250 steps each.
    let film = lab.film(&trial, &Motion::new(1000.0, 0.64, 2.5e-4).weightless())?;
    let weights = trial.cloth.weights(|r| libm::sin(FRAC_PI_2 * r[1] / length));
    let at = &trial.cloth.at;
    let mode = film.signal(|x| x.iter().zip(at).zip(&weights).map(|((p, q), w)| w * (p.z - q.z)).sum());
    let omega = TAU / mode.period()?;
    lab.figure("omega 1/s", omega, ring::along(length, k, SIGMA), share(2e-3, 2e-2));
    lab.figure("omega of 50 springs", omega, ring::along_springs(length, k, SIGMA, n), share(1e-4, 1e-2));
    Ok(())
}

/// Two rows are held; the free length counts from half a cell behind the second, as in the cantilever's case.
fn across(lab: &mut Lab, family: Family) -> Result<(), String> {
    let (length, b, rows) = (0.1, 1e-4, 30);
    let cell = length / (rows as f64 + 0.5);
    let total = length + 0.5 * cell;
    let mesh = sheet::sheet([0.02, total], 6, rows + 1, family, |v| v < 2.5 * cell);
    let mesh = mesh.place(|[u, v]| Vec3::new(v, u, 0.0));
    let held = mesh.pick(|r| r[1] < cell + 1e-9);
    // The weight bends it by a hundredth of its length.
    let trial = Trial { gravity: 0.4, ..Trial::new(mesh, Cloth::linear(SIGMA, 2000.0, 200.0, b)).hold(held) };
    let film = lab.film(&trial, &Motion::new(100.0, 2.5, 5e-3).weightless())?;
    let weights = trial.cloth.weights(|r| ring::across_shape(((r[1] - 0.5 * cell) / length).max(0.0)));
    let mode = film.signal(|x| x.iter().zip(&weights).map(|(p, w)| w * p.z).sum());
    lab.figure("omega 1/s", TAU / mode.period()?, ring::across(length, b, SIGMA), share(0.01, 0.1));
    Ok(())
}
