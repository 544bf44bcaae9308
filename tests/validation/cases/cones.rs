//! Sectors sewn to cones: darts to the centre of a disc, flared skirts.

use super::surface;
use crate::case::{Case, case, share, within};
use crate::closed::cone;
use crate::lab::Lab;
use crate::support::cloth::Cloth;
use crate::support::draped::Draped;
use crate::support::mesh::{FAMILIES, Family, polar};
use crate::support::trial::Trial;
use std::f64::consts::TAU;
use toile_garment::Vec3;

const RADIUS: f64 = 0.2;
/// Mesh edge, m.
const EDGE: f64 = 0.0125;

pub fn cases() -> Vec<Case> {
    let mut list = Vec::new();
    for (name, degrees) in [
        ("dart-cone-0", 30.0),
        ("dart-cone-1", 90.0),
        ("dart-cone-12", 12.0),
        ("dart-cone-60", 60.0),
        ("dart-cone-150", 150.0),
    ] {
        let it = case(name, move |lab: &mut Lab| dart(lab, degrees, Family::Regular));
        list.push(if degrees == 60.0 { it.quick() } else { it });
    }
    list.push(case("dart-cone-0.irregular", |lab: &mut Lab| dart(lab, 30.0, Family::Irregular)));
    for family in FAMILIES.into_iter().filter(|f| *f != Family::Right) {
        list.push(case(format!("flared-skirt-0.{}", family.name()), move |lab: &mut Lab| skirt(lab, family)));
    }
    list
}

/// A sewn sector: it starts on a wider cone with the mouth open by a tenth of a turn, so that it is bent the right way
/// and neither flat nor the answer. K is above 1e6 B/R², so that it rolls rather than stretches; limper cloth on such
/// edges finds its folds along them, and its waist gets oval.
fn sew(lab: &mut Lab, sector: polar::Sector, bending: f64) -> Result<(polar::Sector, Draped, Vec<usize>), String> {
    let stitches = sector.sides();
    let open = (0.9 * TAU).max(1.02 * sector.angle).min(TAU);
    let sector = sector.onto_cone(open);
    // No weight.
    let fabric = Cloth::linear(0.1, 500.0, 200.0, bending);
    let count = sector.mesh.at.len();
    let trial = Trial { stitches: stitches.clone(), ..Trial::new(sector.mesh.clone(), fabric).weightless() };
    let d = lab.drape(&trial)?;
    Ok((sector, d, surface::welded(count, &stitches)))
}

fn dart(lab: &mut Lab, degrees: f64, family: Family) -> Result<(), String> {
    let angle = TAU - f64::to_radians(degrees);
    let expected = cone::closed(0.0, RADIUS, angle);
    let (sector, d, group) = sew(lab, polar::sector(0.0, RADIUS, angle, EDGE, family), 1e-6)?;
    let fit = fit(&sector, &d, 0.2 * RADIUS);
    let rim = sector.circles.last().ok_or("no rim")?;
    let mean = |pick: usize| rim.iter().map(|v| fit.place(d.at[*v])[pick]).sum::<f64>() / rim.len() as f64;
    let tip = fit.place(d.at[0])[1];
    lab.figure("half angle deg", fit.half_angle.to_degrees(), expected.half_angle.to_degrees(), within(0.5, 3.0));
    lab.figure("height m", mean(1) - tip, expected.height, share(0.01, 0.05));
    lab.figure("base radius m", mean(0), expected.radii[1], share(3e-3, 0.02));
    let deficits = surface::deficits(&sector.mesh, &d.at, &group);
    let tip = deficits.get(&0).copied().unwrap_or(f64::NAN);
    lab.figure("tip deficit deg", tip.to_degrees(), degrees, within(0.3, 3.0));
    let strain = surface::largest_strain(&sector.mesh, &d.at, |t| !t.contains(&0));
    lab.figure("largest strain", strain, 0.0, within(1e-3, 1e-2));
    lab.figure("seam gap over h", gap(&sector, &d), 0.0, within(1e-3, 0.02));
    Ok(())
}

fn skirt(lab: &mut Lab, family: Family) -> Result<(), String> {
    let (inner, outer, angle) = (0.12, 0.62, std::f64::consts::PI);
    let expected = cone::closed(inner, outer, angle);
    let (sector, d, _) = sew(lab, polar::sector(inner, outer, angle, 0.02, family), 1e-5)?;
    let fit = fit(&sector, &d, inner);
    let mean = |circle: &[usize], pick: usize| along(&sector, circle, |v| fit.place(d.at[v])[pick]);
    let (waist, hem) = (&sector.circles[0], sector.circles.last().ok_or("no hem")?);
    lab.figure("half angle deg", fit.half_angle.to_degrees(), expected.half_angle.to_degrees(), within(0.5, 3.0));
    lab.figure("waist radius m", mean(waist, 0), expected.radii[0], share(5e-3, 0.03));
    lab.figure("hem radius m", mean(hem, 0), expected.radii[1], share(0.01, 0.05));
    lab.figure("height m", mean(hem, 1) - mean(waist, 1), expected.height, share(0.01, 0.05));
    Ok(())
}

/// The mean of a value along an arc, by its rest length: vertices stand unevenly, and those of the sewn ends are one.
fn along(sector: &polar::Sector, circle: &[usize], value: impl Fn(usize) -> f64) -> f64 {
    let angle = |v: usize| libm::atan2(sector.mesh.rest[v][1], sector.mesh.rest[v][0]);
    let steps = circle.windows(2).map(|w| (angle(w[1]) - angle(w[0])).rem_euclid(TAU));
    let (sum, length) = circle
        .windows(2)
        .zip(steps)
        .fold((0.0, 0.0), |(sum, length), (w, step)| (sum + 0.5 * step * (value(w[0]) + value(w[1])), length + step));
    sum / length
}

/// A cone through the vertices whose rest radius is at least this.
fn fit(sector: &polar::Sector, d: &Draped, from: f64) -> surface::Fit {
    let outer = |v: &usize| libm::hypot(sector.mesh.rest[*v][0], sector.mesh.rest[*v][1]) >= from - 1e-9;
    let points: Vec<Vec3> = (0..d.at.len()).filter(outer).map(|v| d.at[v]).collect();
    let rim = sector.circles.last().map_or_else(Vec3::zeros, |c| d.mean(c.iter().copied()));
    let first = d.mean(sector.circles[0].iter().copied());
    let share = sector.radii[0] / (sector.radii[sector.radii.len() - 1] - sector.radii[0]);
    surface::cone(&points, first - (rim - first) * share, rim - first)
}

fn gap(sector: &polar::Sector, d: &Draped) -> f64 {
    sector.sides().iter().map(|[a, b]| (d.at[*a] - d.at[*b]).norm()).fold(0.0, f64::max) / EDGE
}
