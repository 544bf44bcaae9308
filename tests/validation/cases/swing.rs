//! Strips that hang by their upper edge and swing: stiff ones as a rod, a limp one as a chain.

use crate::case::{Case, case, share};
use crate::closed::swing;
use crate::lab::Lab;
use crate::motion::Motion;
use crate::support::cloth::Cloth;
use crate::support::mesh::{Family, sheet};
use crate::support::trial::Trial;
use toile_garment::Vec3;

const LENGTH: f64 = 0.5;
const WIDTH: f64 = 0.04;
/// Two periods, s.
const SECONDS: f64 = 2.7;

pub fn cases() -> Vec<Case> {
    let rod = |i: i32, degrees: f64| case(format!("pendulum-{i}"), move |lab: &mut Lab| rod(lab, degrees));
    vec![rod(0, 10.0), rod(1, 60.0), case("chain-0", chain)]
}

/// A straight strip, swung out as a whole; draped without weight it stays so.
fn strip(rows: usize, angle: f64, bending: f64) -> Trial {
    let (s, c) = (libm::sin(angle), libm::cos(angle));
    let mesh = sheet::sheet([WIDTH, LENGTH], 2, rows, Family::Right, |_| true);
    let mesh = mesh.place(|[u, v]| Vec3::new(v * s, u, -v * c));
    let top = mesh.pick(|r| r[1] < 1e-9);
    Trial::new(mesh, Cloth::linear(0.2, 2000.0, 1000.0, bending)).weightless().hold(top)
}

fn rod(lab: &mut Lab, degrees: f64) -> Result<(), String> {
    let angle = degrees.to_radians();
    let trial = strip(24, angle, 1.0);
    let film = lab.film(&trial, &Motion::new(120.0, SECONDS, 1.0 / 120.0))?;
    let tip = trial.cloth.at.len() - 1;
    let period = film.signal(|x| libm::atan2(x[tip].x, -x[tip].z)).period()?;
    lab.figure("period s", period, swing::rod(LENGTH, angle), share(3e-3, 3e-2));
    Ok(())
}

/// Swung out by 1°, which is no mode; the first one is what is left when the others are summed to nothing.
fn chain(lab: &mut Lab) -> Result<(), String> {
    let trial = strip(40, f64::to_radians(1.0), 0.0);
    let film = lab.film(&trial, &Motion::new(120.0, SECONDS, 1.0 / 240.0))?;
    let weights = trial.cloth.weights(|r| swing::limp_shape(1.0 - r[1] / LENGTH));
    let mode = film.signal(|x| x.iter().zip(&weights).map(|(p, w)| w * p.x).sum());
    lab.figure("period s", mode.period()?, swing::limp(LENGTH), share(5e-3, 3e-2));
    Ok(())
}
