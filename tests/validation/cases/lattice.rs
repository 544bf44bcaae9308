//! Bare edge springs in regular lattices: what the model `springs` makes of a patch that is strained evenly. Rim
//! springs bear half, so a patch is as stiff as the endless lattice.

use crate::case::{Case, case, share};
use crate::lab::Lab;
use crate::support::cloth::Cloth;
use crate::support::mesh::{Mesh, jitter, sheet};
use crate::support::trial::Trial;
use toile_garment::Vec3;

/// Small enough that lines stay lines.
const STRAIN: f64 = 1e-4;
/// Length of a spring, m.
const EDGE: f64 = 0.02;
const CELLS: usize = 8;

pub fn cases() -> Vec<Case> {
    let mut list = vec![case("lattice-equilateral", bare_equilateral).quick()];
    list.push(case("lattice-equilateral.by-law", lawful_equilateral).quick());
    list.push(case("lattice-square", |lab| bare_square(lab, 450.0, 50.0)).quick());
    list.push(case("lattice-square.ks120-kd300", |lab| bare_square(lab, 120.0, 300.0)).quick());
    list.push(case("lattice-square.by-law-ks450-kd250", lawful_square).quick());
    list
}

/// The spring constants stand in the fabric.
fn bare(springs: [f64; 2]) -> Cloth {
    Cloth { springs: Some(springs), ..Cloth::linear(0.1, 500.0, 50.0, 1e-5) }
}

/// Springs of 100 N/m on all sides.
fn bare_equilateral(lab: &mut Lab) -> Result<(), String> {
    equilateral(lab, 100.0, bare([100.0; 2]))
}

/// Springs as they follow from a law: a side's spring has √3/2 of its direction's stiffness K there
/// (stages/cloth/docs/structural.md, Van Gelder's weight). A shear stiffness of K/2 makes up for what the sides off the
/// yarns lack.
fn lawful_equilateral(lab: &mut Lab) -> Result<(), String> {
    let k = 100.0;
    let stretch = 2.0 / libm::sqrt(3.0) * k;
    equilateral(lab, k, Cloth::linear(0.1, stretch, 0.5 * stretch, 1e-5))
}

fn equilateral(lab: &mut Lab, k: f64, fabric: Cloth) -> Result<(), String> {
    let root = libm::sqrt(3.0);
    let place = |i: usize, j: usize| [(i as f64 + 0.5 * j as f64) * EDGE, 0.5 * root * j as f64 * EDGE];
    let side = CELLS + 1;
    let rest = (0..side * side).map(|n| place(n % side, n / side)).collect();
    let cell = |n: usize| {
        let a = n / CELLS * side + n % CELLS;
        [[a, a + 1, a + side], [a + 1, a + side + 1, a + side]]
    };
    let triangles = (0..CELLS * CELLS).flat_map(cell).collect();
    let rim = |n: usize| [n % side, n / side].iter().any(|c| *c == 0 || *c == CELLS);
    let [c11, c12, c66] = moduli(lab, &Mesh { at: Vec::new(), rest, triangles }, rim, fabric)?;
    lab.figure("E N/m", c11 - c12 * c12 / c11, 2.0 / root * k, share(5e-3, 5e-2));
    lab.figure("nu", c12 / c11, 1.0 / 3.0, share(5e-3, 5e-2));
    lab.figure("C66 N/m", c66, 0.25 * root * k, share(5e-3, 5e-2));
    Ok(())
}

/// Squares with both diagonals of constant `kd`; they meet in a vertex, so that each is two springs of twice the
/// constant.
fn bare_square(lab: &mut Lab, ks: f64, kd: f64) -> Result<(), String> {
    square(lab, ks, kd, bare([ks, 2.0 * kd]))
}

/// Diagonals as they follow from a law are at least half as stiff as the sides, as a fabric without any shear stiffness
/// makes them.
fn lawful_square(lab: &mut Lab) -> Result<(), String> {
    let (stretch, shear) = (900.0, 50.0);
    square(lab, 0.5 * stretch, 0.25 * stretch + 0.5 * shear, Cloth::linear(0.1, stretch, shear, 1e-5))
}

fn square(lab: &mut Lab, ks: f64, kd: f64, fabric: Cloth) -> Result<(), String> {
    let size = CELLS as f64 * EDGE;
    let mesh = sheet::crossed([size, size], CELLS, CELLS);
    let on = |x: f64| x.abs() < 1e-9 || (x - size).abs() < 1e-9;
    let rest = mesh.rest.clone();
    let rim = |n: usize| on(rest[n][0]) || on(rest[n][1]);
    let [c11, c12, c66] = moduli(lab, &mesh, rim, fabric)?;
    lab.figure("C11 N/m", c11, ks + kd, share(5e-3, 5e-2));
    lab.figure("C12 N/m", c12, kd, share(5e-3, 5e-2));
    lab.figure("C66 N/m", c66, kd, share(5e-3, 5e-2));
    Ok(())
}

/// C11, C12, C66 by the work of the rim's reactions.
fn moduli(lab: &mut Lab, flat: &Mesh, rim: impl Fn(usize) -> bool, fabric: Cloth) -> Result<[f64; 3], String> {
    let area: f64 = flat.triangles.iter().map(|t| crate::support::mesh::area(&flat.rest, t)).sum::<f64>().abs();
    let along = |[u, _]: [f64; 2]| [u, 0.0];
    let across = |[_, v]: [f64; 2]| [0.0, v];
    let sheared = |[_, v]: [f64; 2]| [v, 0.0];
    let stretched = work(lab, flat, &rim, fabric, along)?;
    let turned = work(lab, flat, &rim, fabric, sheared)?;
    let of = |forces: &[(usize, Vec3)], field: &dyn Fn([f64; 2]) -> [f64; 2]| {
        let one = |(v, f): &(usize, Vec3)| {
            let [x, y] = field(flat.rest[*v]);
            f.x * x - f.z * y
        };
        forces.iter().map(one).sum::<f64>() / (area * STRAIN)
    };
    Ok([of(&stretched, &along), of(&stretched, &across), of(&turned, &sheared)])
}

/// Reactions of the rim when all of it is displaced by `STRAIN` times a field of the flat cloth.
fn work(
    lab: &mut Lab,
    flat: &Mesh,
    rim: &impl Fn(usize) -> bool,
    fabric: Cloth,
    field: impl Fn([f64; 2]) -> [f64; 2],
) -> Result<Vec<(usize, Vec3)>, String> {
    let mut mesh = flat.clone().place(|r| {
        let d = field(r);
        Vec3::new(r[0] + STRAIN * d[0], 0.0, -(r[1] + STRAIN * d[1]))
    });
    let held: Vec<usize> = (0..mesh.rest.len()).filter(|v| rim(*v)).collect();
    // The middle starts elsewhere than where it must come to rest.
    for (i, p) in mesh.at.iter_mut().enumerate().filter(|(i, _)| !rim(*i)) {
        *p += Vec3::new(jitter::noise(3 * i as u64), 0.0, jitter::noise(3 * i as u64 + 1)) * (0.1 * STRAIN * EDGE);
    }
    let trial = Trial::new(mesh, fabric).weightless().hold(held.iter().copied()).set("model = \"springs\"");
    let d = lab.drape(&trial)?;
    Ok(held.into_iter().map(|v| (v, d.reactions[&v])).collect())
}
