//! Vertices on a floor that gives way like a spring: central differences with a contact stiffness.

use crate::case::{Case, case, share};
use crate::closed::{G, penalty};
use crate::lab::Lab;
use crate::motion::Motion;
use crate::support::cloth::Cloth;
use crate::support::film::Signal;
use crate::support::mesh::Mesh;
use crate::support::trial::Trial;
use toile_garment::Vec3;

/// Mass of a vertex, kg.
const M: f64 = 1e-4;
/// N/m.
const K: f64 = 50.0;
/// Speed at which it meets the floor, m/s.
const V: f64 = 0.5;
/// Far deeper than it gives way: contact is hard below a quarter of the gap.
const GAP: f64 = 4e-3;
/// Edge of the triangle, m.
const SIDE: f64 = 0.1;

pub fn cases() -> Vec<Case> {
    vec![case("penalty-0", floor)]
}

/// A level triangle `high` above where it touches; each corner bears a third of its mass.
fn triangle(high: f64) -> Trial {
    let rest = vec![[0.0, 0.0], [SIDE, 0.0], [0.0, SIDE]];
    let mesh = Mesh { at: Vec::new(), rest, triangles: vec![[0, 1, 2]] };
    let sigma = 3.0 * M / (0.5 * SIDE * SIDE);
    let fabric = Cloth::linear(sigma, 500.0, 50.0, 1e-5);
    let touch = GAP + 0.5 * fabric.thickness;
    let at = [[-1.0, -1.0], [3.0, -1.0], [-1.0, 3.0]].map(|[x, y]| Vec3::new(x, y, 0.0)).to_vec();
    let floor = Mesh { at, rest: Vec::new(), triangles: vec![[0, 1, 2]] };
    let mesh = mesh.place(|[u, v]| Vec3::new(u, v, touch + high));
    Trial::new(mesh, fabric).weightless().over(floor)
}

/// `seconds` in steps of 2e-5 s, with a frame at each `every`.
fn motion(seconds: f64, every: f64) -> Motion {
    let mut motion = Motion::new(1.0 / (every * 2e-5), seconds, 2e-5);
    let gap = format!("body_gap = \"{GAP} m\"");
    let stiffness = format!("contact_stiffness = \"{K} N/m\"");
    let off = ["strain-limit", "self-contact", "friction"].map(|e| format!("effects.{e} = \"off\""));
    motion.more = [vec!["integrator = \"central-difference\"".to_owned(), gap, stiffness], off.to_vec()].concat();
    motion
}

fn floor(lab: &mut Lab) -> Result<(), String> {
    let high = V * V / (2.0 * G);
    let film = lab.film(&triangle(high), &motion(V / G + 6e-3, 2.0))?;
    let depth = film.signal(|x| GAP + 5e-5 - x[0].z);
    let deepest = depth.peaks().into_iter().fold(f64::NEG_INFINITY, f64::max);
    lab.figure("deepest m", deepest, penalty::deepest(M, K, V), share(0.01, 0.1));
    let zeros = depth.zeros();
    let [touch, leave, ..] = zeros.as_slice() else { return Err(format!("{} times through the gap", zeros.len())) };
    lab.figure("time of contact s", leave - touch, penalty::contact_time(M, K, V), share(0.01, 0.1));
    let calm = Motion { calming: 4e-3, ..motion(0.3, 100.0) };
    let film = lab.film(&triangle(1e-5), &calm)?;
    let last = |s: Signal| s.values[s.values.len() - 1];
    let rest = last(film.signal(|x| GAP + 5e-5 - x[0].z));
    lab.figure("depth at rest m", rest, penalty::at_rest(M, K), share(1e-3, 1e-2));
    Ok(())
}
