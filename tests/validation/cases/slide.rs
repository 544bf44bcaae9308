//! A sheet on a slope in time: how far it slides above the critical angle, how it creeps below.

use super::friction::slope_trial;
use crate::case::{Case, case, share, within};
use crate::closed::fall;
use crate::lab::Lab;
use crate::motion::Motion;
use crate::support::film::Signal;
use toile_garment::Vec3;

const MU: f64 = 0.3;
/// Frames in a second.
const FPS: f64 = 60.0;

pub fn cases() -> Vec<Case> {
    vec![case("incline-0.motion", slide)]
}

fn slide(lab: &mut Lab) -> Result<(), String> {
    let end = 30;
    let way = slid(lab, 20.0)?.values[end];
    let expected = fall::slid(f64::to_radians(20.0), MU, end as f64 / FPS);
    lab.figure("distance m", way, expected, share(0.02, 0.1));
    // Half a degree below the critical angle; the first quarter of a second is left to the cloth for coming to lie.
    let way = slid(lab, libm::atan(MU).to_degrees() - 0.5)?.values;
    let creep = (way[end] - way[end / 2]) / ((end - end / 2) as f64 / FPS);
    lab.figure("creep m/s", creep, 0.0, within(1e-4, 1e-2));
    Ok(())
}

/// Mean way down the slope.
fn slid(lab: &mut Lab, degrees: f64) -> Result<Signal, String> {
    let slope = degrees.to_radians();
    let trial = slope_trial(slope, MU).weightless();
    let film = lab.film(&trial, &Motion::new(FPS, 0.5, 1.0 / 240.0))?;
    let down = Vec3::new(libm::cos(slope), 0.0, -libm::sin(slope));
    let start = &film.shots[0];
    Ok(film.signal(|x| x.iter().zip(start).map(|(p, q)| (p - q).dot(&down)).sum::<f64>() / x.len() as f64))
}
