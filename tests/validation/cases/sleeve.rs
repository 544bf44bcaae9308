//! Tight sleeves on a round and on an elliptic cylinder: tension from the stretched girth, pressure from tension and
//! curvature.

use crate::case::{Case, case, share};
use crate::closed::contact::Parallel;
use crate::lab::Lab;
use crate::support::cloth::Cloth;
use crate::support::draped::Draped;
use crate::support::mesh::{Family, body, sheet};
use crate::support::trial::Trial;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use toile_garment::Vec3;

const K: f64 = 400.0;
const THICKNESS: f64 = 1e-4;
const OFF: f64 = 1e-3 + 0.5 * THICKNESS;
const HEIGHT: f64 = 0.04;
const ROWS: usize = 8;

pub fn cases() -> Vec<Case> {
    vec![case("sleeve-0", round).quick(), case("sleeve-ellipse-0", ellipse)]
}

/// A rectangle `girth` round and [`HEIGHT`] high, sewn to a ring along a given curve; the columns of its middle row in
/// order, the seam once.
struct Ring {
    draped: Draped,
    middle: Vec<usize>,
}

fn ring(lab: &mut Lab, girth: f64, cells: usize, curve: &Parallel, body: [f64; 2], mu: f64) -> Result<Ring, String> {
    let flat = sheet::sheet([girth, HEIGHT], cells, ROWS, Family::Right, |_| true);
    // Round the curve at equal lengths, a little way off, so that nothing touches at the start.
    let far = Parallel { off: curve.off + 5e-4, ..*curve };
    let places = equal_arcs(&far, cells);
    let place = |[u, v]: [f64; 2]| {
        let i = (u / girth * cells as f64).round() as usize % cells;
        Vec3::new(places[i][0], v - 0.5 * HEIGHT, places[i][1])
    };
    let mesh = flat.place(place);
    let row = |v: f64| {
        let mut list = mesh.pick(|r| (r[1] - v).abs() < 1e-9);
        list.sort_by(|a, b| mesh.rest[*a][0].total_cmp(&mesh.rest[*b][0]));
        list
    };
    let mut middle = row(0.5 * HEIGHT);
    middle.pop();
    let stitches = mesh.round(girth);
    let fabric = Cloth { friction: mu, thickness: THICKNESS, ..Cloth::linear(0.1, K, 40.0, 1e-7) };
    let mut trial = Trial { stitches, ..Trial::new(mesh, fabric).weightless() };
    trial.body = Some(body::cylinder(body[0], body[1], -0.1, 0.1, 240));
    Ok(Ring { draped: lab.drape(&trial)?, middle })
}

impl Ring {
    fn points(&self) -> Vec<Vec3> {
        self.middle.iter().map(|v| self.draped.at[*v]).collect()
    }

    fn girth(&self) -> f64 {
        let p = self.points();
        (0..p.len()).map(|i| (p[(i + 1) % p.len()] - p[i]).norm()).sum()
    }
}

fn round(lab: &mut Lab) -> Result<(), String> {
    let (radius, girth) = (0.05, 0.3);
    let curve = Parallel { a: radius - OFF, b: radius - OFF, off: OFF };
    let ring = ring(lab, girth, 60, &curve, [curve.a, curve.b], 0.3)?;
    let expected = K * (TAU * radius / girth - 1.0);
    // A chord of the mesh is shorter than its arc.
    let chord = PI / 60.0 / libm::sin(PI / 60.0);
    let tension = K * (ring.girth() * chord / girth - 1.0);
    let mean = ring.points().iter().map(|p| libm::hypot(p.x, p.z)).sum::<f64>() / 60.0;
    lab.figure("T N/m", tension, expected, share(0.02, 0.1));
    lab.figure("p Pa", tension / mean, expected / radius, share(0.02, 0.1));
    Ok(())
}

fn ellipse(lab: &mut Lab) -> Result<(), String> {
    let (a, b, girth, cells) = (0.09, 0.05, 0.4, 120);
    let curve = Parallel { a: a - OFF, b: b - OFF, off: OFF };
    let ring = ring(lab, girth, cells, &curve, [curve.a, curve.b], 0.0)?;
    let expected = K * (curve.perimeter() / girth - 1.0);
    let tension = K * (ring.girth() / girth - 1.0);
    lab.figure("T N/m", tension, expected, share(0.02, 0.1));
    let [sharp, flat] = curve.curvatures();
    let points = ring.points();
    let at = |t: f64| {
        let [x, z] = curve.point(t);
        let d = |i: &usize| libm::hypot(points[*i].x - x, points[*i].z - z);
        let i = (0..cells).min_by(|i, j| d(i).total_cmp(&d(j))).expect("points");
        pressure(&points, i, girth / cells as f64)
    };
    lab.figure("p max Pa", at(0.0), expected * sharp, share(0.05, 0.25));
    lab.figure("p min Pa", at(FRAC_PI_2), expected * flat, share(0.05, 0.25));
    Ok(())
}

/// Force per area on a vertex of a ring from the tensions of the edges on its two sides, over five vertices.
fn pressure(points: &[Vec3], i: usize, rest: f64) -> f64 {
    let n = points.len();
    let edge = |k: usize| points[(k + 1) % n] - points[k % n];
    let pull = |k: usize| {
        let e = edge(k);
        e.normalize() * (K * (e.norm() / rest - 1.0))
    };
    let (from, to) = (i + n - 3, i + n + 2);
    let length: f64 = (from + 1..to).map(|k| edge(k).norm()).sum::<f64>() + 0.5 * (edge(from).norm() + edge(to).norm());
    (pull(to) - pull(from)).norm() / length
}

/// Points at equal distances along the curve.
fn equal_arcs(curve: &Parallel, count: usize) -> Vec<[f64; 2]> {
    let fine = 100_000;
    let at = |i: usize| curve.point(TAU * i as f64 / fine as f64);
    let mut lengths = vec![0.0];
    for i in 0..fine {
        let ([x, z], [u, w]) = (at(i), at(i + 1));
        lengths.push(lengths[i] + libm::hypot(u - x, w - z));
    }
    let total = lengths[fine];
    (0..count)
        .map(|k| {
            let goal = total * k as f64 / count as f64;
            let i = lengths.partition_point(|l| *l < goal).min(fine);
            curve.point(TAU * i as f64 / fine as f64)
        })
        .collect()
}
