//! One triangle, held by two corners, is one mass on one spring: what it does when it is let go.

use crate::case::{Case, case, share, within};
use crate::closed::damped::Oscillator;
use crate::lab::Lab;
use crate::motion::Motion;
use crate::support::cloth::Cloth;
use crate::support::mesh::Mesh;
use crate::support::trial::Trial;
use toile_garment::Vec3;

/// Height of the triangle, m.
pub const HEIGHT: f64 = 0.5;
/// Weight of the drape that pulls it, m/s²: it is let go where its weight held it.
pub const PULL: f64 = 1.0;
const SIGMA: f64 = 0.3;

pub fn cases() -> Vec<Case> {
    vec![case("damping-0", damping).quick()]
}

/// The third corner hangs under the two that are held. It bears the mass σ b h/6 on the spring K b/2h: ω² = 3K/σh².
pub fn triangle(omega: f64) -> Trial {
    let rest = vec![[0.0, 0.0], [HEIGHT, 0.0], [0.5 * HEIGHT, -HEIGHT]];
    let mesh = Mesh { at: Vec::new(), rest, triangles: vec![[0, 2, 1]] };
    let mesh = mesh.place(|[u, v]| Vec3::new(u, 0.0, v));
    let k = omega * omega * SIGMA * HEIGHT * HEIGHT / 3.0;
    Trial { gravity: PULL, ..Trial::new(mesh, Cloth::linear(SIGMA, k, 0.1 * k, 0.0)).hold([0, 1]) }
}

fn damping(lab: &mut Lab) -> Result<(), String> {
    let expected = Oscillator { omega: 12.0, zeta: 0.05 };
    // Velocities die away with the rate 2ζω.
    let calming = 0.5 / (expected.zeta * expected.omega);
    let motion = Motion { calming, ..Motion::new(200.0, 3.0, 1e-3).weightless() };
    let film = lab.film(&triangle(expected.omega), &motion)?;
    let rest = -HEIGHT;
    let first = film.shots[0][2].z - rest;
    let x = film.signal(|x| (x[2].z - rest) / first);
    // At the start it stands at its first peak.
    let peaks: Vec<f64> = std::iter::once(1.0).chain(x.peaks()).collect();
    let n = peaks.len() - 1;
    let decrement = libm::log(peaks[0] / peaks[n]) / n as f64;
    lab.figure("log decrement", decrement, expected.decrement(), share(1e-3, 3e-2));
    lab.figure(
        "energy ratio a period",
        peaks[1] * peaks[1] / (peaks[0] * peaks[0]),
        expected.energy_ratio(),
        share(3e-3, 5e-2),
    );
    lab.figure("x after 1 s", x.values[200], expected.at(1.0), within(5e-3, 5e-2));
    Ok(())
}
