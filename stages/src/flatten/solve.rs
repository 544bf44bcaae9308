//! Projected Newton with a line search that forbids flipped triangles.
//!
//! The stored piece is the start, so Newton needs no rounds of local/global before it: it opens a dart by six degrees
//! in about six rounds where local/global needs two hundred. It stops on motion, never on a count.

use super::energy::{EdgePair, Triangle};
use super::system::{System, SystemError};
use crate::joined::Joined;
use nalgebra::Matrix2;
use toile_garment::Vec2;

/// Triangles in the plane with the shape each should have, and the edges that are sewn to each other.
#[derive(Clone, Debug, Default)]
pub struct Sheet {
    /// Start positions, metres.
    pub start: Vec<Vec2>,
    /// Triangles with their targets.
    pub triangles: Vec<Triangle>,
    /// Sewn edges.
    pub pairs: Vec<EdgePair>,
}

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// Largest motion of a vertex in a round, metres.
    pub motion: f64,
    /// Rounds after which it has failed.
    pub rounds: u32,
}

/// Flat positions and how they were found.
#[derive(Clone, Debug, PartialEq)]
pub struct Flattened {
    /// Positions, metres.
    pub positions: Vec<Vec2>,
    /// Rounds taken.
    pub rounds: u32,
    /// Largest motion in the last round, metres.
    pub last_motion: f64,
    /// Energy left, m².
    pub energy: f64,
    /// Was the motion small enough before the rounds ran out?
    pub converged: bool,
}

/// Why it could not be solved.
#[derive(Debug, thiserror::Error)]
pub enum SolveError {
    /// The linear system.
    #[error(transparent)]
    System(#[from] SystemError),
    /// Stopped by the caller.
    #[error("stopped")]
    Stopped,
}

/// Flattens a sheet. `watch` is told round and motion after every round and says whether to go on.
///
/// A start that is already at rest is given back bit for bit.
///
/// # Errors
/// See [`SolveError`].
pub fn solve(sheet: &Sheet, stop: Stop, watch: &mut dyn FnMut(u32, f64) -> bool) -> Result<Flattened, SolveError> {
    let mut x = sheet.start.clone();
    let mut energy = total(sheet, &x);
    let groups = sheet.triangles.iter().map(|t| t.v.as_slice()).chain(sheet.pairs.iter().map(|p| p.v.as_slice()));
    let mut system = System::new(held(sheet), groups)?;
    let mut last_motion = f64::INFINITY;
    for round in 1..=stop.rounds {
        newton_direction(sheet, &x, &mut system)?;
        let motion = largest(&system.rhs);
        let resting = motion <= stop.motion;
        if !(resting && round == 1) {
            let step = line_search(sheet, &mut x, &system.rhs, &mut energy);
            last_motion = motion * step;
            if step == 0.0 {
                // Rounding hides any further descent: the direction itself says how far off the answer may be.
                last_motion = motion;
                return Ok(done(x, round, last_motion, energy, motion <= 1e3 * stop.motion));
            }
        } else {
            last_motion = motion;
        }
        if !watch(round, last_motion) {
            return Err(SolveError::Stopped);
        }
        if resting {
            return Ok(done(x, round, last_motion, energy, true));
        }
    }
    Ok(done(x, stop.rounds, last_motion, energy, false))
}

fn done(positions: Vec<Vec2>, rounds: u32, last_motion: f64, energy: f64, converged: bool) -> Flattened {
    Flattened { positions, rounds, last_motion, energy, converged }
}

fn total(sheet: &Sheet, x: &[Vec2]) -> f64 {
    let triangles: f64 = sheet.triangles.iter().map(|t| t.energy(x)).sum();
    triangles + sheet.pairs.iter().map(|p| p.energy(x)).sum::<f64>()
}

fn newton_direction(sheet: &Sheet, x: &[Vec2], system: &mut System) -> Result<(), SystemError> {
    system.clear();
    for t in &sheet.triangles {
        system.add(&t.v, &t.local(x));
    }
    for p in &sheet.pairs {
        if let Some(term) = p.local(x) {
            system.add(&p.v, &term);
        }
    }
    system.solve()
}

/// Takes the longest of the steps 1, ½, ¼ … that flips no triangle and lowers the energy; 0 when none does.
fn line_search(sheet: &Sheet, x: &mut Vec<Vec2>, direction: &[Vec2], energy: &mut f64) -> f64 {
    let mut step = flip_limit(sheet, x, direction);
    for _ in 0..40 {
        let trial: Vec<Vec2> = x.iter().zip(direction).map(|(p, d)| p + d * step).collect();
        let value = total(sheet, &trial);
        if value <= *energy + 1e-15 * energy.abs() {
            *x = trial;
            *energy = value;
            return step;
        }
        step *= 0.5;
    }
    0.0
}

/// Largest step up to 1 that keeps every triangle the right way up (0.9 of the way to the first flip).
fn flip_limit(sheet: &Sheet, x: &[Vec2], d: &[Vec2]) -> f64 {
    let edges = |p: &[Vec2], v: [u32; 3]| {
        let [a, b, c] = v.map(|i| p[i as usize]);
        Matrix2::from_columns(&[b - a, c - a])
    };
    sheet.triangles.iter().fold(1.0, |limit: f64, t| {
        let (e, g) = (edges(x, t.v), edges(d, t.v));
        let c0 = e.determinant();
        let c1 = e.m11 * g.m22 + g.m11 * e.m22 - e.m12 * g.m21 - g.m12 * e.m21;
        first_root(g.determinant(), c1, c0).map_or(limit, |r| limit.min(0.9 * r))
    })
}

/// Smallest positive root of `a t² + b t + c` for positive `c`.
fn first_root(a: f64, b: f64, c: f64) -> Option<f64> {
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return None;
    }
    let q = -0.5 * (b + discriminant.sqrt().copysign(b));
    [q / a, c / q].into_iter().filter(|r| r.is_finite() && *r > 0.0).reduce(f64::min)
}

fn largest(d: &[Vec2]) -> f64 {
    d.iter().map(|v| v.norm()).fold(0.0, f64::max)
}

/// Holds what the energies leave free: per connected cloth one vertex and the turn about it; vertices without cloth.
fn held(sheet: &Sheet) -> Vec<[bool; 2]> {
    let part = parts(sheet);
    let mut held = vec![[true; 2]; sheet.start.len()];
    for vertices in part {
        for v in &vertices {
            held[*v] = [false; 2];
        }
        let count = vertices.len() as f64;
        let centre = vertices.iter().map(|v| sheet.start[*v]).sum::<Vec2>() / count;
        let by = |to: Vec2| move |v: &&usize| (sheet.start[**v] - to).norm_squared();
        let Some(near) = vertices.iter().min_by(|a, b| by(centre)(a).total_cmp(&by(centre)(b))) else { continue };
        let pivot = sheet.start[*near];
        let Some(far) = vertices.iter().max_by(|a, b| by(pivot)(a).total_cmp(&by(pivot)(b))) else { continue };
        let arm = sheet.start[*far] - pivot;
        held[*far][usize::from(arm.x.abs() >= arm.y.abs())] = true;
        held[*near] = [true; 2];
    }
    held
}

/// Vertices of each connected cloth.
fn parts(sheet: &Sheet) -> Vec<Vec<usize>> {
    let mut joined = Joined::new(sheet.start.len());
    let mut used = vec![false; sheet.start.len()];
    for v in sheet.triangles.iter().flat_map(|t| t.v.map(|v| [t.v[0], v])) {
        used[v[1] as usize] = true;
        joined.join(v[0] as usize, v[1] as usize);
    }
    let mut parts = std::collections::BTreeMap::<usize, Vec<usize>>::new();
    for v in (0..used.len()).filter(|v| used[*v]) {
        parts.entry(joined.root(v)).or_default().push(v);
    }
    parts.into_values().collect()
}
