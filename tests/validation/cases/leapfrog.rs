//! The paper's central differences in motion: the frequency they show, and the step that they bear.

use super::damped::{HEIGHT, PULL, triangle};
use crate::case::{Case, case, share};
use crate::closed::leapfrog;
use crate::lab::Lab;
use crate::motion::Motion;
use crate::support::cloth::{Cloth, Law};
use crate::support::mesh::{Family, sheet};
use crate::support::trial::Trial;
use toile_garment::Vec3;

/// Steps in a frame where a step may be shorter than a frame.
const STEPS: f64 = 8.0;

pub fn cases() -> Vec<Case> {
    vec![
        case("leapfrog-0", leapfrog).quick(),
        case("leapfrog-damped-0", damped).quick(),
        case("axial-dt-0", chain),
        case("grid-dt-0", grid),
    ]
}

/// Motion by explicit steps of this length, s.
fn explicit(steps: usize, in_frame: f64, dt: f64) -> Motion {
    let frames = 1.0 / (in_frame * dt);
    let mut motion = Motion::new(frames, steps as f64 * dt, dt).weightless();
    // Without what would hold a motion that runs away: elongation is taken back, and cloth is kept off cloth.
    let off = ["strain-limit", "self-contact"].map(|e| format!("effects.{e} = \"off\""));
    let explicit = ["integrator = \"central-difference\"", "fixed_step = true"].map(str::to_owned);
    motion.more = [explicit.to_vec(), off.to_vec()].concat();
    motion
}

fn leapfrog(lab: &mut Lab) -> Result<(), String> {
    let (omega, dt) = (10.0, 0.05);
    let film = lab.film(&triangle(omega), &explicit(1000, 1.0, dt))?;
    let got = film.signal(|x| x[2].z + HEIGHT).omega()?;
    let expected = leapfrog::omega(omega, dt);
    lab.figure("omega 1/s", got, expected, share(1e-8, 1e-3));
    lab.figure("error of the period", omega / got - 1.0, omega / expected - 1.0, share(1e-6, 1e-3));
    Ok(())
}

/// Damping that lags makes the longest step shorter.
fn damped(lab: &mut Lab) -> Result<(), String> {
    let (omega, zeta) = (10.0, 0.2);
    let expected = leapfrog::lagged_step(omega, zeta);
    let motion = |dt: f64| {
        // Writing the frames takes most of the time. A film has at least one frame in a second.
        let mut motion = explicit(4000, 4.0, dt);
        motion.calming = 0.5 / (zeta * omega);
        motion.more[0] = "integrator = \"leapfrog\"".to_owned();
        motion
    };
    let trial = triangle(omega);
    // It is let go this far above its rest.
    let swing = PULL / (omega * omega);
    let got = halve(expected, 0.03, |dt| lab.bounded(&trial, &motion(dt), 4.0 * swing))?;
    lab.figure("longest step s", got, expected, share(1e-3, 0.05));
    Ok(())
}

/// A chain held at one end has every other mode of one twice as long that is held at both. So no rim of triangles plays
/// a part, whose corners are lighter than half a mass. Columns of vertices along the yarn are such chains.
fn chain(lab: &mut Lab) -> Result<(), String> {
    let (k, sigma, length, n) = (200.0, 0.2, 0.5, 50);
    let h = length / n as f64;
    let expected = leapfrog::chain_step(k, sigma, length, n);
    let mesh = sheet::sheet([h, 2.0 * length], 1, 2 * n, Family::Right, |_| true).place(|[u, v]| Vec3::new(u, v, 0.0));
    let ends = mesh.pick(|r| r[1] < 1e-9 || r[1] > 2.0 * length - 1e-9);
    let fabric = Cloth { weft: Law::Linear(1.0), ..Cloth::linear(sigma, k, 1e-5 * k, 0.0) };
    let trial = Trial::new(mesh, fabric).weightless().hold(ends);
    let got = halve(expected, 0.03, |dt| lab.bounded(&trial, &explicit(2000, STEPS, dt), 1e-6))?;
    lab.figure("longest step s", got, expected, share(1e-3, 0.05));
    Ok(())
}

/// The inside of a sheet whose border is held, so that rims and corners play no part; rounding alone sets it in motion.
/// The reference's step is that of springs that do not shear, so the case is taken with next to no shear stiffness.
/// With the case's own, triangles bear less, because they shear in that mode: h √(σ/(K + 2G)).
fn grid(lab: &mut Lab) -> Result<(), String> {
    let (k, sigma, h) = (500.0, 0.2, 0.01);
    for (name, shear, expected) in [
        ("longest step without shear s", 1e-3 * k, leapfrog::longest_step(k, sigma, h)),
        ("longest step s", 50.0, leapfrog::longest_step(k + 2.0 * 50.0, sigma, h)),
    ] {
        let got = longest_step(lab, k, shear, sigma, h, expected)?;
        lab.figure(name, got, expected, share(0.02, 0.3));
    }
    Ok(())
}

/// By halves, s.
fn longest_step(lab: &mut Lab, k: f64, shear: f64, sigma: f64, h: f64, about: f64) -> Result<f64, String> {
    let n = 12;
    let size = n as f64 * h;
    let mesh = sheet::sheet([size, size], n, n, Family::Right, |_| true).place(|[u, v]| Vec3::new(u, v, 0.0));
    let border = mesh.pick(|r| r.iter().any(|c| *c < 1e-9 || *c > size - 1e-9));
    let trial = Trial::new(mesh, Cloth::linear(sigma, k, shear, 0.0)).weightless().hold(border);
    halve(about, 0.3, |dt| lab.stable(&trial, &explicit(2000, STEPS, dt)))
}

/// The longest step a trial bears, s: sought by halves within a share of what is expected.
fn halve(about: f64, within: f64, mut stable: impl FnMut(f64) -> Result<bool, String>) -> Result<f64, String> {
    let (mut low, mut high) = ((1.0 - within) * about, (1.0 + within) * about);
    for _ in 0..8 {
        let dt = 0.5 * (low + high);
        if stable(dt)? { low = dt } else { high = dt }
    }
    Ok(0.5 * (low + high))
}
