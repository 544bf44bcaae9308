//! Strips rolled, buckled and pressed; sectors over the edge of a disc.

use crate::case::{Case, case, share};
use crate::closed::{G, buckling, root, sector, slip};
use crate::lab::Lab;
use crate::support::cloth::Cloth;
use crate::support::mesh::{Family, body, polar, sheet};
use crate::support::trial::Trial;
use std::f64::consts::{PI, TAU};
use toile_garment::Vec3;

pub fn cases() -> Vec<Case> {
    vec![
        case("roll-up-0.regular", |lab: &mut Lab| roll_up(lab, Family::Regular)),
        case("roll-up-0.right", |lab: &mut Lab| roll_up(lab, Family::Right)),
        case("self-buckling", upright),
        case("lateral-buckling", on_edge),
        case("stick-slip.mu0.2", |lab: &mut Lab| stick_slip(lab, 0.2)),
        case("stick-slip.mu0.3", |lab: &mut Lab| stick_slip(lab, 0.3)),
        case("drape-sector-0", |lab: &mut Lab| overhang(lab, 0.02)),
        case("drape-sector-1", |lab: &mut Lab| overhang(lab, 0.03)),
    ]
}

/// A strip held on a circle by two rows at each end: moment from the reactions, energy from the certificate.
fn roll_up(lab: &mut Lab, family: Family) -> Result<(), String> {
    let (bending, length, width, rows) = (1e-5, 0.2, 0.02, 40);
    let radius = length / TAU;
    // One cell short of a full turn, so that the ends do not meet.
    let arc = length * (rows - 1) as f64 / rows as f64;
    let cell = length / rows as f64;
    let flat = sheet::sheet([width, arc], 4, rows - 1, family, |_| true);
    let mesh = flat.place(|[u, v]| {
        let bulge = libm::sin(PI * (v - cell).max(0.0).min(arc - 2.0 * cell) / (arc - 2.0 * cell));
        let r = radius + 2e-3 * bulge * bulge * libm::sin(3.0 * v / radius);
        Vec3::new(r * libm::cos(v / radius), u, r * libm::sin(v / radius))
    });
    let ends = [mesh.pick(|r| r[1] < cell + 1e-9), mesh.pick(|r| r[1] > arc - cell - 1e-9)];
    let on_circle = |p: Vec3| p;
    let trial =
        Trial::new(mesh, Cloth::linear(0.05, 1000.0, 100.0, bending)).weightless().lead(ends.concat(), on_circle);
    let d = lab.drape(&trial)?;
    let turn = |v: &usize| d.at[*v].cross(&d.reactions[v]).y;
    let moment = ends[0].iter().map(turn).sum::<f64>().abs() / width;
    // Hinges lie on all rows but the two outermost: each stands for one cell.
    let hinged = arc - cell;
    lab.figure("moment N", moment, TAU * bending / length, share(0.01, 0.1));
    lab.figure("energy J/m", d.energy() / width * length / hinged, 2.0 * PI * PI * bending / length, share(0.01, 0.1));
    Ok(())
}

/// The critical Γ from how a small side load moves the tip at two Γ below it (Southwell's plot, with the exact curve
/// in place of a straight line). `tip` gives displacement at Γ; `curve` what it is per load and stiffness.
fn critical(
    expected: f64,
    shares: [f64; 2],
    mut tip: impl FnMut(f64) -> Result<f64, String>,
    curve: impl Fn(f64) -> f64,
) -> Result<f64, String> {
    let [a, b] = shares.map(|s| s * expected);
    let ratio = tip(b)? / tip(a)?;
    // The load per stiffness grows with Γ, because Γ is set by the stiffness.
    let of = |scale: f64| b * curve(scale * b) / (a * curve(scale * a)) - ratio;
    let highest = 0.999 / shares[1];
    Ok(expected / root(0.2, highest, of))
}

fn upright(lab: &mut Lab) -> Result<(), String> {
    let (length, width, w, rows) = (0.15, 0.02, 1.962, 30);
    let expected = buckling::upright_critical();
    let tip = |gamma: f64| {
        let cell = length / (rows as f64 + 0.5);
        let total = length + 0.5 * cell;
        let mesh = sheet::sheet([width, total], 4, rows + 1, Family::Regular, |_| true);
        let mesh = mesh.place(|[u, v]| Vec3::new(0.0, u, v));
        let held = mesh.pick(|r| r[1] < cell + 1e-9);
        let end = mesh.pick(|r| r[1] > total - 1e-9);
        let bending = w * length * length * length / gamma;
        // A sideways push that bends the weightless strip by a hundredth of its length.
        let push = 0.03 * w * length / 8.0 * width / end.len() as f64;
        let mut trial = Trial::new(mesh, Cloth::linear(w / G, 1900.0, 190.0, bending)).hold(held);
        trial.loads = end.iter().map(|v| (*v, Vec3::new(push, 0.0, 0.0))).collect();
        let d = lab.drape(&trial)?;
        Ok(d.mean(end).x)
    };
    let measured = critical(expected, [0.6, 0.85], tip, buckling::upright)?;
    lab.figure("Gamma critical", measured, expected, share(0.02, 0.1));
    Ok(())
}

/// A ribbon on edge. Its clamped end cannot warp, which raises Γ by 0.85 width/length (seen at a tenth, a twentieth and
/// a fortieth on fine meshes), and its own plane must not bend before it buckles.
fn on_edge(lab: &mut Lab) -> Result<(), String> {
    let (length, width, w, rows, stretch) = (0.1, 0.0025, 0.4905, 160, 19_000.0);
    // EI = B b and GJ = 2 B b without a Poisson ratio.
    let scale = 2.0f64.sqrt();
    let expected = scale * buckling::on_edge_critical();
    let tip = |gamma: f64| {
        let cell = length / (rows as f64 + 0.5);
        let total = length + 0.5 * cell;
        let mesh = sheet::sheet([width, total], 2, rows + 1, Family::Regular, |_| true);
        let mesh = mesh.place(|[u, v]| Vec3::new(v, 0.0, u));
        let held = mesh.pick(|r| r[1] < cell + 1e-9);
        let end = mesh.pick(|r| r[1] > total - 1e-9);
        let bending = w * length * length * length / gamma;
        let push = 0.03 * w * length / 8.0 * width / end.len() as f64;
        let mut trial = Trial::new(mesh, Cloth::linear(w / G, stretch, 0.5 * stretch, bending)).hold(held);
        trial.loads = end.iter().map(|v| (*v, Vec3::new(0.0, push, 0.0))).collect();
        let d = lab.drape(&trial)?;
        Ok(d.mean(end).y)
    };
    let measured = critical(expected, [0.5, 0.85], tip, |gamma| buckling::on_edge(gamma / scale))?;
    lab.figure("Gamma critical", measured, expected, share(0.03, 0.2));
    lab.figure("lambda critical", measured / scale, expected / scale, share(0.03, 0.2));
    Ok(())
}

/// A strip clamped above a rough floor, its tip under the clamp. The clamp is lowered little by little, each time from
/// where the strip came to rest, until the tip slips.
fn stick_slip(lab: &mut Lab, mu: f64) -> Result<(), String> {
    let (length, width, bending, rows) = (0.1, 0.02, 1e-4, 30);
    let expected = slip::compression(mu);
    let cell = length / (rows as f64 + 0.5);
    let total = length + 0.5 * cell;
    let (first, step) = (0.8 * expected, 0.01 * expected);
    let shape = slip::shape(first);
    // Squares cut one way twist when they bend, and would stand on a corner.
    let mesh = sheet::sheet([width, total], 6, rows + 1, Family::Regular, |_| true);
    let mesh = mesh.place(|[u, v]| {
        let [x, z] = shape((v - 0.5 * cell) / length);
        Vec3::new(length * x, u, length * z)
    });
    let clamp = mesh.pick(|r| r[1] < cell + 1e-9);
    let tip = mesh.pick(|r| r[1] > total - 1e-9);
    let fabric = Cloth { friction: mu, ..Cloth::linear(0.05, 1900.0, 190.0, bending) };
    let mut trial = Trial::new(mesh, fabric).weightless();
    let mut floor = body::slab([0.5, 0.5], 0.05, 0.0);
    floor.at.iter_mut().for_each(|p| p.z -= 1e-3 + 0.5e-4);
    trial.body = Some(floor);
    // First with its tip held, so that what it carries is its own.
    let mut d = lab.drape(&trial.clone().hold([clamp.clone(), tip.clone()].concat()))?;
    let mut lowered = first;
    while lowered < 1.3 * expected {
        let before = d.mean(tip.clone()).x;
        trial.cloth.at.clone_from(&d.at);
        d = lab.drape(&trial.clone().lead(clamp.iter().copied(), |p| p - Vec3::new(0.0, 0.0, step * length)))?;
        lowered += step;
        // Once it slips the force leans ever more, and the tip runs out by half a length.
        if (d.mean(tip.clone()).x - before).abs() > 0.02 * length {
            break;
        }
    }
    lab.figure("compression at slip", lowered - 0.5 * step, expected, share(0.02, 0.15));
    Ok(())
}

/// One of 48 sectors of a specimen over a disc.
fn overhang(lab: &mut Lab, c: f64) -> Result<(), String> {
    let (disc, rim, w, rows) = (0.09, 0.15, 1.962, 24);
    let expected = sector::drape_coefficient(c, disc, rim);
    // Rows half a cell on each side of the disc's edge are held.
    let cell = (rim - disc) / (rows as f64 - 0.5);
    let inner = disc - 0.5 * cell;
    let cut = polar::sector(inner, rim, TAU / 48.0, cell, Family::Regular);
    let held = [cut.circles[0].clone(), cut.circles[1].clone()].concat();
    let bending = w * c * c * c;
    let trial = Trial::new(cut.mesh.clone(), Cloth::linear(w / G, 1900.0, 950.0, bending)).hold(held);
    let d = lab.drape(&trial)?;
    let tips = cut.circles.last().ok_or("no rim")?;
    let tip = tips.iter().map(|v| libm::hypot(d.at[*v].x, d.at[*v].y)).sum::<f64>() / tips.len() as f64;
    let share_of = |r: f64| r * r - disc * disc;
    lab.figure("drape coefficient", share_of(tip) / share_of(rim), expected, share(0.02, 0.1));
    Ok(())
}
