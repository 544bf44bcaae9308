//! Checks that hold for every run that the program accepts (catalogue: U1 to U8).

use crate::crossing;
use crate::support::draped::Draped;
use crate::support::mesh::{Mesh, area};
use crate::support::program::Ended;
use crate::support::trial::Trial;
use std::collections::BTreeSet;
use toile_garment::Vec3;

#[derive(Default)]
pub struct Found {
    pub failures: Vec<String>,
    pub finite: bool,
    pub crossings: usize,
    pub silent: bool,
}

impl Found {
    fn expect(&mut self, holds: bool, words: impl FnOnce() -> String) {
        if !holds {
            self.failures.push(words());
        }
    }
}

/// Largest net force over the mean vertex weight at which `accuracy` may say "at rest".
fn rest(accuracy: Option<&str>) -> f64 {
    match accuracy {
        Some("draft") => 5e-2,
        Some("fine") => 2e-3,
        Some("reference") => 5e-4,
        _ => 1e-2,
    }
}

/// Asks all of it.
pub fn universal(trial: &Trial, run: &Ended, d: &Draped, accuracy: Option<&str>) -> Found {
    let mut found = Found { finite: d.at.iter().all(|p| p.iter().all(|c| c.is_finite())), ..Found::default() };
    let finite = found.finite;
    found.expect(finite, || "U1: a position is no number".into());
    let triangles = triangles(run);
    crossings(&mut found, trial, d, &triangles);
    truth(&mut found, run, d, accuracy);
    let first =
        trial.cloth.rest.len() == d.at.len() && !trial.texts.iter().any(|t| t.0 == "cloth.obj" || t.0 == "fabric.toml");
    if first && d.settled && trial.body.is_none() {
        balance(&mut found, trial, d, accuracy);
    }
    if first && flat(trial) {
        energy(&mut found, trial, d);
    }
    found
}

/// The faces of the exported mesh.
pub fn triangles(run: &Ended) -> Vec<[usize; 3]> {
    let text = String::from_utf8_lossy(run.output("final.obj").unwrap_or_default()).into_owned();
    let corner = |w: &str| w.split('/').next().and_then(|i| i.parse::<usize>().ok()).map(|i| i - 1);
    let face = |line: &str| {
        let c: Vec<usize> = line.strip_prefix("f ")?.split_whitespace().filter_map(corner).collect();
        <[usize; 3]>::try_from(c).ok()
    };
    text.lines().filter_map(face).collect()
}

/// Faces of a body above which not every vertex is asked whether it is inside.
const LARGE: usize = 50_000;

/// U2, U3: nothing crosses, nothing is inside the body.
fn crossings(found: &mut Found, trial: &Trial, d: &Draped, triangles: &[[usize; 3]]) {
    let off = |name: &str| trial.drape.iter().any(|k| *k == format!("effects.{name}-contact = \"off\""));
    let told = d.figure("self_crossings") + d.figure("body_crossings");
    let mut counted = if off("self") { 0 } else { crossing::own(&d.at, triangles) };
    if let Some(body) = trial.body.as_ref().filter(|_| !off("body")) {
        counted += crossing::with_body(&d.at, triangles, &body.at, &body.triangles);
        let used: BTreeSet<usize> = triangles.iter().flatten().copied().collect();
        // The sum over all faces is slow; where nothing crosses, a few vertices of a sheet tell for all of it.
        let stride = 1 + body.triangles.len() / LARGE;
        let used: Vec<Vec3> = used.into_iter().step_by(stride).map(|v| d.at[v]).collect();
        let deep = crossing::inside(&used, &body.at, &body.triangles);
        found.expect(deep == 0, || format!("U3: {deep} vertices inside the body"));
        let depth = d.figure("penetration_max_mm");
        found.expect(depth == 0.0, || format!("U3: the certificate says {depth} mm inside the body"));
    }
    found.expect(counted == 0, || format!("U2: {counted} crossings counted on the exported mesh"));
    let by_choice = off("self") || off("body");
    found.expect(by_choice || told == 0.0, || format!("U2: the certificate counts {told} crossings"));
    found.crossings = counted + if by_choice { 0 } else { told as usize };
}

/// U4, U6: exit code, certificate and findings tell the same, and it is true.
fn truth(found: &mut Found, run: &Ended, d: &Draped, accuracy: Option<&str>) {
    let passed = d.certificate["passed"].as_bool().unwrap_or(false);
    found.expect(passed == (run.code == 0), || format!("U4: exit code {}, certificate passed: {passed}", run.code));
    let residual = d.figure("residual_rel");
    let goal = rest(accuracy);
    found.expect(!d.settled || residual <= goal, || format!("U6: called at rest with a net force of {residual:.2e}"));
    let said = run.findings().find(|f| f["code"] == "drape-not-settled").map(|f| f["message"].to_string());
    found.expect(d.settled, || format!("not at rest: {}", said.as_deref().unwrap_or("without a word")));
    found.silent = !d.settled && said.is_none();
    let limits = &d.certificate["limits"];
    for name in ["residual_rel", "strain_max", "strain_p95", "seam_gap_max_mm", "dart_gap_max_mm"] {
        let limit = limits[name].as_f64().unwrap_or(f64::INFINITY);
        let figure = d.figure(name);
        found.expect(figure <= limit, || format!("U8: {name} {figure:.4} over {limit}"));
    }
}

/// U6: what the pins bear is the weight and the loads, to the tolerance of rest at every vertex.
fn balance(found: &mut Found, trial: &Trial, d: &Draped, accuracy: Option<&str>) {
    let mass: f64 =
        trial.cloth.triangles.iter().map(|t| area(&trial.cloth.rest, t).abs()).sum::<f64>() * trial.fabric.mass;
    let weight = mass * trial.gravity;
    let held: BTreeSet<usize> = trial.pins.iter().map(|p| p.0).collect();
    let loads: Vec3 = trial.loads.iter().filter(|l| !held.contains(&l.0)).map(|l| l.1).sum();
    let net = d.reaction(held.iter().copied()) + loads - Vec3::z() * weight;
    // The weight of a held vertex hangs on its pin without a force.
    let most = rest(accuracy) * weight * 2.0 + 1e-6;
    let own = weight * held.len() as f64 / d.at.len() as f64 * 2.0;
    let sideways = libm::hypot(net.x, net.y);
    found.expect(sideways <= most, || format!("U6: forces are off balance by {sideways:.2e} N sideways"));
    found.expect(net.z.abs() <= most + own, || format!("U6: forces are off balance by {:.2e} N", net.z));
}

/// Does every edge start at its rest length, in one plane, with nothing led elsewhere?
fn flat(trial: &Trial) -> bool {
    let m: &Mesh = &trial.cloth;
    let [a, b, c] = m.triangles[0].map(|v| m.at[v]);
    let normal = (b - a).cross(&(c - a)).normalize();
    let size = m.at.iter().map(|p| (p - a).norm()).fold(0.0, f64::max);
    let even = |t: &[usize; 3]| {
        (0..3).all(|k| {
            let (i, j) = (t[k], t[(k + 1) % 3]);
            let rest = libm::hypot(m.rest[j][0] - m.rest[i][0], m.rest[j][1] - m.rest[i][1]);
            ((m.at[j] - m.at[i]).norm() - rest).abs() <= 1e-6 * rest
        })
    };
    let still = trial.pins.iter().all(|(v, p)| (p - m.at[*v]).norm() < 1e-12);
    let plane = m.at.iter().all(|p| (p - a).dot(&normal).abs() <= 1e-6 * size);
    trial.stitches.is_empty() && still && plane && m.triangles.iter().all(even)
}

/// Largest distance from which contacts push, m.
const GAP: f64 = 1.5e-3;

/// U5: from a flat start without strain, what is stored was taken from the weight and the loads.
fn energy(found: &mut Found, trial: &Trial, d: &Draped) {
    let m = &trial.cloth;
    let mut fallen = 0.0;
    for t in &m.triangles {
        let third = trial.fabric.mass * area(&m.rest, t).abs() * trial.gravity / 3.0;
        fallen += t.iter().map(|v| third * (m.at[*v].z - d.at[*v].z)).sum::<f64>();
    }
    fallen += trial.loads.iter().map(|(v, f)| f.dot(&(d.at[*v] - m.at[*v]))).sum::<f64>();
    let stored = d.energy();
    let scale = stored.abs().max(fallen.abs());
    // Contacts may push a start that touches; they hold less than lifts the cloth by a gap.
    let weight: f64 = m.triangles.iter().map(|t| area(&m.rest, t).abs()).sum::<f64>() * trial.fabric.mass * 9.81;
    let most = fallen + 0.01 * scale + GAP * weight;
    found.expect(stored <= most, || format!("U5: {stored:.3e} J stored, {fallen:.3e} J taken from weight and loads"));
}
