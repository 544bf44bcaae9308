//! A level sheet falls against a linear drag.

use crate::case::{Case, case, share, within};
use crate::closed::fall;
use crate::lab::Lab;
use crate::motion::Motion;
use crate::support::cloth::Cloth;
use crate::support::mesh::{Family, sheet};
use crate::support::trial::Trial;
use toile_garment::Vec3;

pub fn cases() -> Vec<Case> {
    vec![case("fall-0", fall).quick()]
}

fn fall(lab: &mut Lab) -> Result<(), String> {
    let (sigma, c, fps, end) = (0.2, 0.5, 200.0, 80);
    let t = end as f64 / fps;
    // Places that single precision holds, so that the start is without strain.
    let mesh = sheet::sheet([0.25, 0.25], 8, 8, Family::Regular, |_| true).place(|[u, v]| Vec3::new(u, v, 1.0));
    let trial = Trial::new(mesh, Cloth::linear(sigma, 500.0, 50.0, 1e-5)).weightless();
    // A drag of c on a fabric of σ takes velocities away in σ/c.
    let motion = Motion { calming: sigma / c, ..Motion::new(fps, t + 1.0 / fps, 1.0 / fps) };
    let film = lab.film(&trial, &motion)?;
    let way = film.signal(|x| x.iter().zip(&film.shots[0]).map(|(p, q)| q.z - p.z).sum::<f64>() / x.len() as f64);
    let speed = 0.5 * (way.values[end + 1] - way.values[end - 1]) * fps;
    let [v, y] = fall::dragged(sigma, c, t);
    lab.figure("speed m/s", speed, v, share(1e-3, 2e-2));
    lab.figure("way m", way.values[end], y, share(1e-3, 2e-2));
    let (first, last) = (&film.shots[0], &film.shots[end]);
    let moved = last[0] - first[0];
    let shape = last.iter().zip(first).map(|(p, q)| (p - q - moved).norm()).fold(0.0, f64::max);
    lab.figure("change of shape m", shape, 0.0, within(1e-9, 1e-9));
    Ok(())
}
