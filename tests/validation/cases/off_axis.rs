//! Uniaxial modulus against the grain angle: a strip held at one end, pulled at the other, measured in the middle.

use crate::case::{Case, case, share};
use crate::lab::Lab;
use crate::support::cloth::{Cloth, Law};
use crate::support::mesh::{Family, Mesh, sheet};
use crate::support::trial::Trial;
use toile_garment::Vec3;

const WIDTH: f64 = 0.03;
/// Twenty-two widths: the middle fifth is ten widths away from both ends.
const LENGTH: f64 = 0.66;
const ROWS: usize = 88;
const K: [f64; 2] = [500.0, 300.0];
const G: f64 = 40.0;

pub fn cases() -> Vec<Case> {
    let mut list = Vec::new();
    for (family, poisson) in
        [(Family::Regular, 0.0), (Family::Right, 0.0), (Family::Irregular, 0.0), (Family::Regular, 0.25)]
    {
        let tag = if poisson > 0.0 { "-nu" } else { "" };
        let name = format!("off-axis-0{tag}.{}", family.name());
        list.push(case(name, move |lab: &mut Lab| turn(lab, family, poisson)));
    }
    list.push(case("off-axis-isotropic", isotropic).quick());
    list
}

fn turn(lab: &mut Lab, family: Family, nu: f64) -> Result<(), String> {
    for degrees in [0.0, 22.5, 45.0, 67.5, 90.0] {
        let angle = f64::to_radians(degrees);
        let fabric =
            Cloth { warp: Law::Linear(K[0]), weft: Law::Linear(K[1]), poisson: nu, ..Cloth::linear(0.1, 1.0, G, 0.0) };
        let (s, c) = (libm::sin(angle), libm::cos(angle));
        let (ss, cc) = (s * s, c * c);
        let expected = 1.0 / (cc * cc / K[0] + ss * ss / K[1] + (1.0 / G - 2.0 * nu / K[0]) * ss * cc);
        let (modulus, _) = pull(lab, family, angle, fabric, expected)?;
        lab.figure(format!("E {degrees} N/m"), modulus, expected, share(0.02, 0.15));
    }
    Ok(())
}

/// An isotropic cloth with a Poisson ratio: stiffness along the strip and narrowing across.
fn isotropic(lab: &mut Lab) -> Result<(), String> {
    let (young, nu) = (100.0, 0.3);
    let fabric = Cloth { poisson: nu, ..Cloth::linear(0.1, young, young / (2.0 * (1.0 + nu)), 0.0) };
    let (modulus, ratio) = pull(lab, Family::Right, 0.0, fabric, young)?;
    lab.figure("E N/m", modulus, young, share(0.02, 0.15));
    lab.figure("Poisson ratio", ratio, nu, share(0.02, 0.15));
    Ok(())
}

/// Modulus and Poisson ratio read in the middle of a strip under a strain of about 1e-3.
fn pull(lab: &mut Lab, family: Family, angle: f64, fabric: Cloth, near: f64) -> Result<(f64, f64), String> {
    let calm = |v: f64| !(0.1..=LENGTH - 0.1).contains(&v) || (v / LENGTH - 0.5).abs() > 0.09;
    let flat = sheet::sheet([WIDTH, LENGTH], 4, ROWS, family, calm);
    let tension = 1e-3 * near;
    let row = |v: f64| flat.pick(|r| (r[1] - v).abs() < 1e-9);
    let (held, pulled) = (row(0.0), row(LENGTH));
    // Each vertex of the loaded edge carries its share of the edge.
    let share = |v: &usize| {
        let u = flat.rest[*v][0];
        let near = |side: f64| {
            let others = pulled.iter().map(|o| (flat.rest[*o][0] - u) * side).filter(|d| *d > 1e-12);
            others.fold(f64::INFINITY, f64::min)
        };
        [near(1.0), near(-1.0)].into_iter().filter(|d| d.is_finite()).sum::<f64>() / 2.0
    };
    let loads = pulled.iter().map(|v| (*v, Vec3::new(0.0, 0.0, -tension * share(v)))).collect();
    let gauge = [flat.pick(|_| true), Vec::new()].concat();
    let placed = flat.clone().place(|[u, v]| Vec3::new(u, 0.0, -v)).turn(angle);
    let trial = Trial { loads, ..Trial::new(placed, fabric).weightless().hold(held) };
    let d = lab.drape(&trial)?;
    Ok(strains(&flat, &gauge, &d.at, tension))
}

/// Least squares of the displacement over the middle fifth: strain along and across.
fn strains(flat: &Mesh, among: &[usize], at: &[Vec3], tension: f64) -> (f64, f64) {
    let middle: Vec<usize> = among.iter().copied().filter(|v| (flat.rest[*v][1] / LENGTH - 0.5).abs() < 0.1).collect();
    let n = middle.len() as f64;
    let (mut u0, mut v0) = (0.0, 0.0);
    middle.iter().for_each(|i| (u0, v0) = (u0 + flat.rest[*i][0] / n, v0 + flat.rest[*i][1] / n));
    let (mut uu, mut vv, mut uv, mut ux, mut vz, mut vx, mut uz) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    for i in &middle {
        let (u, v) = (flat.rest[*i][0] - u0, flat.rest[*i][1] - v0);
        let (x, z) = (at[*i].x - flat.rest[*i][0], -at[*i].z - flat.rest[*i][1]);
        uu += u * u;
        vv += v * v;
        uv += u * v;
        ux += u * x;
        vx += v * x;
        uz += u * z;
        vz += v * z;
    }
    let det = uu * vv - uv * uv;
    let along = (uu * vz - uv * uz) / det;
    let across = (vv * ux - uv * vx) / det;
    (tension / along, -across / along)
}
