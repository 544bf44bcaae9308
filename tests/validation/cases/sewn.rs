//! Sewn shapes without weight: darts that end inside, a godet, a tube, two rings of unequal length.

use super::surface;
use crate::case::{Case, case, share, within};
use crate::lab::Lab;
use crate::support::cloth::Cloth;
use crate::support::mesh::{Family, Mesh, polar, sheet};
use crate::support::trial::Trial;
use std::f64::consts::{PI, TAU};
use toile_garment::Vec3;

pub fn cases() -> Vec<Case> {
    vec![
        case("dart-gauss-bonnet-0", |lab: &mut Lab| darts(lab, 0.12, 15.0)),
        case("dart-gauss-bonnet-25deg", |lab: &mut Lab| darts(lab, 0.09, 25.0)),
        case("godet-30", |lab: &mut Lab| godet(lab, 30.0)),
        case("tube-0", tube),
        // Not quick: without weight the descent is slow to come to rest.
        case("ease-0", ease),
    ]
}

/// Two wedge darts from the lower edge of a rectangle.
fn darts(lab: &mut Lab, leg: f64, degrees: f64) -> Result<(), String> {
    let (width, height, nx, ny) = (0.36, 0.24, 36, 24);
    let half = 0.5 * f64::to_radians(degrees);
    let depth = leg * libm::cos(half);
    let flat = sheet::sheet([width, height], nx, ny, Family::Right, |_| true);
    let rows = (depth / height * ny as f64).round() as usize;
    let column = |i: usize| width * i as f64 / nx as f64;
    let slits = [nx / 3, 2 * nx / 3];
    let (mut mesh, stitches) = slit(flat, &slits.map(column), height * rows as f64 / ny as f64);
    // The rows below the apex shrink or grow so that the legs have their length; each block between two legs narrows.
    let edges = [0.0, column(slits[0]), column(slits[1]), width];
    let rest: Vec<[f64; 2]> = (0..mesh.rest.len())
        .map(|v| {
            let [u, y] = mesh.rest[v];
            let (block, below) = (mesh.block[v], height * rows as f64 / ny as f64);
            let y =
                if y <= below { y * depth / below } else { depth + (y - below) * (height - depth) / (height - below) };
            let open = (depth - y).max(0.0) * libm::tan(half);
            let (low, high) = (edges[block], edges[block + 1]);
            let (a, b) = (low + if block > 0 { open } else { 0.0 }, high - if block < 2 { open } else { 0.0 });
            [a + (b - a) * (u - low) / (high - low), y]
        })
        .collect();
    mesh.mesh.rest = rest;
    let dome = |[u, y]: [f64; 2]| Vec3::new(u, y, 0.03 * libm::sin(PI * u / width) * libm::cos(0.5 * PI * y / height));
    let cloth = mesh.mesh.place(dome);
    let count = cloth.at.len();
    let mouth = 2.0 * leg * libm::sin(half);
    let first = stitches.iter().min_by(|a, b| cloth.rest[a[0]][1].total_cmp(&cloth.rest[b[0]][1])).ok_or("no dart")?;
    let [p, q] = first.map(|v| cloth.rest[v]);
    lab.figure("mouth m", libm::hypot(p[0] - q[0], p[1] - q[1]), mouth, share(1e-6, 1e-3));
    let trial =
        Trial { stitches: stitches.clone(), ..Trial::new(cloth, Cloth::linear(0.1, 500.0, 200.0, 1e-6)).weightless() };
    let d = lab.drape(&trial)?;
    let deficits = surface::deficits(&trial.cloth, &d.at, &surface::welded(count, &stitches));
    lab.figure("total deficit deg", deficits.values().sum::<f64>().to_degrees(), 2.0 * degrees, within(0.5, 3.0));
    Ok(())
}

/// A rectangle cut open along columns from its lower edge.
struct Slit {
    mesh: Mesh,
    /// Which block between the cuts every vertex belongs to.
    block: Vec<usize>,
}

impl std::ops::Deref for Slit {
    type Target = Mesh;

    fn deref(&self) -> &Mesh {
        &self.mesh
    }
}

/// Cuts from v = 0 up to `depth`, whose end stays whole; the pairs along the cuts.
fn slit(flat: Mesh, cuts: &[f64], depth: f64) -> (Slit, Vec<[usize; 2]>) {
    let mut mesh = flat;
    let block_of = |u: f64| cuts.iter().filter(|c| u > **c + 1e-9).count();
    let mut block: Vec<usize> = mesh.rest.iter().map(|r| block_of(r[0])).collect();
    let mut stitches = Vec::new();
    for (k, cut) in cuts.iter().enumerate() {
        for v in mesh.pick(|r| (r[0] - cut).abs() < 1e-9 && r[1] < depth - 1e-9) {
            let copy = mesh.rest.len();
            mesh.rest.push(mesh.rest[v]);
            mesh.at.push(mesh.at[v]);
            block.push(k + 1);
            stitches.push([v, copy]);
            for t in &mut mesh.triangles {
                let right = t.iter().any(|i| mesh.rest[*i][0] > cut + 1e-9);
                t.iter_mut().filter(|i| **i == v && right).for_each(|i| *i = copy);
            }
        }
    }
    (Slit { mesh, block }, stitches)
}

/// A wedge let in: more than a full turn round a point.
fn godet(lab: &mut Lab, degrees: f64) -> Result<(), String> {
    let angle = TAU + f64::to_radians(degrees);
    let sector = polar::sector(0.0, 0.2, angle, 0.0125, Family::Regular).place(|r, a| {
        let turn = a * TAU / angle;
        Vec3::new(r * libm::cos(turn), r * libm::sin(turn), 0.25 * r * libm::cos(2.0 * turn))
    });
    let stitches = sector.sides();
    let count = sector.mesh.at.len();
    let fabric = Cloth::linear(0.1, 500.0, 200.0, 1e-6);
    let trial = Trial { stitches: stitches.clone(), ..Trial::new(sector.mesh, fabric).weightless() };
    let d = lab.drape(&trial)?;
    let deficits = surface::deficits(&trial.cloth, &d.at, &surface::welded(count, &stitches));
    lab.figure("tip deficit deg", deficits.get(&0).map_or(f64::NAN, |a| a.to_degrees()), -degrees, within(0.3, 3.0));
    let strain = surface::largest_strain(&trial.cloth, &d.at, |t| !t.contains(&0));
    lab.figure("largest strain", strain, 0.0, within(1e-3, 1e-2));
    Ok(())
}

/// A rectangle sewn to a tube, from an oval start.
fn tube(lab: &mut Lab) -> Result<(), String> {
    let (width, length, bending, cells) = (0.6, 0.3, 1e-5, 48);
    let radius = width / TAU;
    let flat = sheet::sheet([width, length], cells, 24, Family::Right, |_| true);
    let oval = |[u, v]: [f64; 2]| {
        let a = TAU * ((u / width * cells as f64).round() % cells as f64) / cells as f64;
        Vec3::new(1.1 * radius * libm::cos(a), v, 0.9 * radius * libm::sin(a))
    };
    let mesh = flat.place(oval);
    let stitches = mesh.round(width);
    let trial = Trial { stitches, ..Trial::new(mesh, Cloth::linear(0.05, 300.0, 100.0, bending)).weightless() };
    let d = lab.drape(&trial)?;
    let centre = d.mean(trial.cloth.pick(|r| r[0] < width - 1e-9));
    let radii: Vec<f64> = d.at.iter().map(|p| libm::hypot(p.x - centre.x, p.z - centre.z)).collect();
    let mean = radii.iter().sum::<f64>() / radii.len() as f64;
    // The corners of a regular polygon of the same girth lie a little outside.
    let chord = libm::sin(PI / cells as f64) / (PI / cells as f64);
    let spread = radii.iter().fold(0.0f64, |a, r| a.max(*r)) - radii.iter().fold(f64::INFINITY, |a, r| a.min(*r));
    lab.figure("radius m", mean * chord, radius, share(5e-3, 0.03));
    lab.figure("roundness", spread / mean, 0.0, within(0.01, 0.05));
    lab.figure("bending energy J", d.energy(), PI * bending * length / radius, share(0.02, 0.2));
    Ok(())
}

/// Two narrow rings of unequal length sewn along both edges: their tensions balance.
fn ease(lab: &mut Lab) -> Result<(), String> {
    let (l1, l2, k1, k2, height, cells) = (0.6, 0.57, 300.0, 300.0, 0.01, 60);
    let expected = (k1 + k2) / (k1 / l1 + k2 / l2);
    let radius = 0.5 * (l1 + l2) / TAU;
    let band = |length: f64| {
        sheet::sheet([length, height], cells, 1, Family::Right, |_| true).place(|[u, v]| {
            let a = TAU * ((u / length * cells as f64).round() % cells as f64) / cells as f64;
            Vec3::new(radius * libm::cos(a), v, radius * libm::sin(a))
        })
    };
    let mut mesh = band(l1);
    let count = mesh.at.len();
    mesh.join(&band(l2));
    let mut stitches: Vec<[usize; 2]> = (0..count).map(|v| [v, v + count]).collect();
    for row in [0, cells + 1] {
        stitches.push([row, row + cells]);
        stitches.push([count + row, count + row + cells]);
    }
    let trial = Trial { stitches, ..Trial::new(mesh, Cloth::linear(0.1, k1, 100.0, 1e-6)).weightless() };
    let d = lab.drape(&trial)?;
    let length: f64 = (0..cells).map(|i| (d.at[i + 1] - d.at[i]).norm()).sum();
    lab.figure("length m", length, expected, share(1e-3, 1e-2));
    Ok(())
}
