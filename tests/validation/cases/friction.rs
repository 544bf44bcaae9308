//! Friction: a sheet on a slope, a light strip pulled over a cylinder, a heavy strip over a rod.

use super::bracket::bracket;
use crate::case::{Case, case, share, within};
use crate::closed::{G, contact};
use crate::lab::Lab;
use crate::support::cloth::Cloth;
use crate::support::mesh::{Family, body, sheet};
use crate::support::trial::Trial;
use std::f64::consts::{FRAC_PI_2, PI};
use toile_garment::Vec3;

const THICKNESS: f64 = 1e-4;
/// `body_gap` of the drape, m: the cloth's middle lies this and half its thickness off the body.
const GAP: f64 = 1e-3;
/// Pull on the held end of the capstan, m: first more than the strip stretches, then little by little, because the end
/// of a pull rings and shakes the strip loose.
const PULLS: [f64; 14] = [0.02, 0.02, 1e-3, 1e-3, 5e-4, 5e-4, 5e-4, 5e-4, 5e-4, 5e-4, 5e-4, 5e-4, 5e-4, 5e-4];
/// Pulls at the end over which the tension is a mean.
const SLIDING: usize = 10;
const OFF: f64 = GAP + 0.5 * THICKNESS;

pub fn cases() -> Vec<Case> {
    let mut list = vec![case("incline-0", incline).quick()];
    for (i, wrap) in [FRAC_PI_2, PI].into_iter().enumerate() {
        list.push(case(format!("capstan-{i}"), move |lab: &mut Lab| capstan(lab, wrap)));
    }
    list.push(case("heavy-capstan-0", heavy));
    list
}

fn incline(lab: &mut Lab) -> Result<(), String> {
    let mu = 0.3;
    bracket(lab, "critical angle deg", libm::atan(mu).to_degrees(), within(0.3, 2.0), |lab, degrees| {
        let slope = f64::to_radians(degrees);
        let trial = slope_trial(slope, mu).set("max_time = \"2 s\"");
        let start = trial.cloth.at.clone();
        let down = Vec3::new(libm::cos(slope), 0.0, -libm::sin(slope));
        let d = lab.drape(&trial)?;
        let moved: f64 = d.at.iter().zip(&start).map(|(p, q)| (p - q).dot(&down)).sum();
        // In these two seconds a sheet at the next angle slides several millimetres, whatever the damping.
        Ok(d.settled && moved / (start.len() as f64) < 1e-3)
    })
}

/// A sheet that lies on a slope (rad), off it by its gap.
pub fn slope_trial(slope: f64, friction: f64) -> Trial {
    let (s, c) = (libm::sin(slope), libm::cos(slope));
    let mesh = sheet::sheet([0.1, 0.1], 5, 6, Family::Regular, |_| true).place(|[u, v]| {
        let x = u - 0.05;
        Vec3::new(c * x, v - 0.05, -s * x) + Vec3::new(s, 0.0, c) * OFF
    });
    let fabric = Cloth { friction, thickness: THICKNESS, ..Cloth::linear(0.2, 500.0, 50.0, 1e-5) };
    Trial::new(mesh, fabric).over(body::slab([1.0, 0.5], 0.05, slope))
}

/// A strip in the x–z plane over a cylinder along y: straight, half a turn or less over the top, straight. `s` runs
/// from the left end.
struct Over {
    radius: f64,
    wrap: f64,
    /// Straight lengths left and right of the arc.
    tails: [f64; 2],
}

impl Over {
    fn length(&self) -> f64 {
        self.tails[0] + self.wrap * self.radius + self.tails[1]
    }

    /// Outward direction of the right tail; the left one is its mirror.
    fn down(&self, left: bool) -> Vec3 {
        let half = 0.5 * self.wrap;
        Vec3::new(if left { -libm::cos(half) } else { libm::cos(half) }, 0.0, -libm::sin(half))
    }

    fn point(&self, s: f64, y: f64) -> Vec3 {
        let half = 0.5 * self.wrap;
        let angle = ((s - self.tails[0]) / self.radius).clamp(0.0, self.wrap) - half;
        let on = Vec3::new(libm::sin(angle), 0.0, libm::cos(angle)) * self.radius;
        let left = (self.tails[0] - s).max(0.0);
        let right = (s - self.tails[0] - self.wrap * self.radius).max(0.0);
        on + self.down(true) * left + self.down(false) * right + Vec3::new(0.0, y, 0.0)
    }
}

fn capstan(lab: &mut Lab, wrap: f64) -> Result<(), String> {
    let (mu, width, tension) = (0.3, 0.02, 5.0);
    let over = Over { radius: 0.05, wrap, tails: [0.05, 0.05] };
    let rows = (over.length() / 0.004).round() as usize;
    let mesh = sheet::sheet([width, over.length()], 4, rows, Family::Right, |_| true);
    let (left, right) = (mesh.pick(|r| r[1] < 1e-9), mesh.pick(|r| r[1] > over.length() - 1e-9));
    let mesh = mesh.place(|[u, v]| over.point(v, u - 0.5 * width));
    // Soft and light, so that the pull does not ring: what rings shakes the strip loose.
    let fabric = Cloth { friction: mu, thickness: THICKNESS, limit: 0.6, ..Cloth::linear(0.02, 50.0, 20.0, 1e-8) };
    let edge = |v: &usize| if mesh.at[*v].y.abs() > 0.49 * width { 0.5 } else { 1.0 } * width / 4.0;
    let loads = right.iter().map(|v| (*v, over.down(false) * (tension * edge(v)))).collect();
    let mut trial = Trial { loads, ..Trial::new(mesh.clone(), fabric).weightless() };
    trial.body = Some(body::cylinder(over.radius - OFF, over.radius - OFF, -0.1, 0.1, 180));
    // The load first, then the held end in steps, each from where the strip came to rest.
    let mut d = lab.drape(&trial.clone().hold(left.iter().copied()))?;
    let mut held = Vec::new();
    for pull in PULLS {
        trial.cloth.at.clone_from(&d.at);
        d = lab.drape(&trial.clone().lead(left.iter().copied(), |p| p + over.down(true) * pull))?;
        held.push(d.reaction(left.iter().copied()).norm() / width);
    }
    // The strip slides in little slips, so that its tension goes up and down by some percent.
    let last = &held[PULLS.len() - SLIDING..];
    lab.figure(
        "tension ratio",
        last.iter().sum::<f64>() / SLIDING as f64 / tension,
        contact::capstan(mu, wrap),
        share(0.03, 0.2),
    );
    Ok(())
}

fn heavy(lab: &mut Lab) -> Result<(), String> {
    let (radius, l2, mu, width) = (0.05, 0.2, 0.2, 0.02);
    let expected = contact::heavy_capstan(radius, l2, mu);
    bracket(lab, "longest tail m", expected, share(0.03, 0.2), |lab, l1| {
        let over = Over { radius, wrap: PI, tails: [l1, l2] };
        let rows = (over.length() / 0.006).round() as usize;
        let mesh = sheet::sheet([width, over.length()], 3, rows, Family::Right, |_| true);
        let mesh = mesh.place(|[u, v]| over.point(v, u - 0.5 * width));
        let start = mesh.at.clone();
        let fabric = Cloth { friction: mu, thickness: THICKNESS, ..Cloth::linear(1.962 / G, 2000.0, 200.0, 1e-8) };
        let mut trial = Trial::new(mesh, fabric).set("max_time = \"3 s\"");
        trial.body = Some(body::cylinder(radius - OFF, radius - OFF, -0.1, 0.1, 180));
        let d = lab.drape(&trial)?;
        let lowered = start[0].z - d.at[0].z;
        Ok(d.settled && lowered.abs() < 5e-3)
    })
}
