//! Newton with a line search that no triangle can flip in.
//!
//! The stored piece is the start, so Newton needs no rounds of local/global before it: it opens a dart by six degrees
//! in about six rounds where local/global needs two hundred. The energy grows without bound towards a flip, and no step
//! goes farther than 0.9 of the way to the first one.
//!
//! Rest is judged by what the energy can resolve. The Newton decrement is the energy that the next step would gain.
//! Below the rounding of the energy no step can be told from no step; the last full step is taken, and that is the end.

use super::energy::{Curvature, EdgePair, Triangle};
use super::lock::Lock;
use super::system::{System, SystemError};
use crate::joined::Joined;
use nalgebra::Matrix2;
use toile_garment::Vec2;

/// Share of the energy, below which rounding of its sum hides what a step gains.
const ENERGY_RESOLUTION: f64 = 1e-13;
/// Share of the energy that may be left to gain where the line search finds no step.
const ENERGY_SHARE_AT_REST: f64 = 1e-8;
/// Share of the energy that the next step gains, from which on the exact Hessian is tried: smaller means later.
const EXACT_HESSIAN_FROM: f64 = 0.05;
/// Rounds after which the energy must have fallen by more than its share at rest; else the solve ends as it is.
const STALLED_ROUNDS: u32 = 40;
/// Share of the decrement that a step must gain at least (Armijo).
const SUFFICIENT_DECREASE: f64 = 1e-4;

/// Triangles in the plane with the shape each should have, and what is held between them.
#[derive(Clone, Debug, Default)]
pub struct Sheet {
    /// Start positions, metres. No triangle may be flipped.
    pub start: Vec<Vec2>,
    /// Triangles with their targets.
    pub triangles: Vec<Triangle>,
    /// Sewn edges.
    pub pairs: Vec<EdgePair>,
    /// Locks.
    pub locks: Vec<Lock>,
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
    /// Did it come to rest before the rounds ran out?
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
/// A start that is already at rest is given back bit for bit. Where the rounds run out, or the energy no longer falls, the
/// best positions so far are given back; the energy only falls, so they are the last ones.
///
/// # Errors
/// See [`SolveError`].
pub fn solve(sheet: &Sheet, stop: Stop, watch: &mut dyn FnMut(u32, f64) -> bool) -> Result<Flattened, SolveError> {
    let mut x = sheet.start.clone();
    let mut energy = total(sheet, &x);
    let groups = sheet.triangles.iter().map(|t| t.v.as_slice()).chain(sheet.pairs.iter().map(|p| p.v.as_slice()));
    let mut system = System::new(held(sheet), groups.chain(sheet.locks.iter().map(Lock::vertices)))?;
    let mut last_motion = f64::INFINITY;
    let mut curvature = Curvature::Projected;
    let mut energy_before = energy;
    for round in 1..=stop.rounds {
        let decrement = newton_direction(sheet, &x, &mut system, curvature)?;
        let motion = largest(&system.rhs);
        let hidden = decrement <= ENERGY_RESOLUTION * energy;
        let resting = motion <= stop.motion || hidden;
        if motion <= stop.motion && round == 1 {
            last_motion = motion;
        } else {
            let step = line_search(sheet, &mut x, &system.rhs, &mut energy, if resting { 0.0 } else { decrement });
            last_motion = motion * step;
        }
        if !watch(round, last_motion) {
            return Err(SolveError::Stopped);
        }
        // Where no step gains anything, only rounding is left to gain; the exact Hessian may have misled.
        let stuck = last_motion == 0.0 && curvature == Curvature::Projected;
        if resting || stuck {
            let converged = resting || decrement <= ENERGY_SHARE_AT_REST * energy;
            return Ok(Flattened { positions: x, rounds: round, last_motion, energy, converged });
        }
        if round % STALLED_ROUNDS == 0 {
            if energy >= (1.0 - ENERGY_SHARE_AT_REST) * energy_before {
                return Ok(Flattened { positions: x, rounds: round, last_motion, energy, converged: false });
            }
            energy_before = energy;
        }
        let near = decrement < EXACT_HESSIAN_FROM * energy && last_motion > 0.0;
        curvature = if near { Curvature::Exact } else { Curvature::Projected };
    }
    Ok(Flattened { positions: x, rounds: stop.rounds, last_motion, energy, converged: false })
}

fn total(sheet: &Sheet, x: &[Vec2]) -> f64 {
    let triangles: f64 = sheet.triangles.iter().map(|t| t.energy(x)).sum();
    let pairs: f64 = sheet.pairs.iter().map(|p| p.energy(x)).sum();
    triangles + pairs + sheet.locks.iter().map(|l| l.energy(x)).sum::<f64>()
}

/// Leaves the direction in `system.rhs` and gives the decrement, the energy that a full step gains to second order.
///
/// Where the exact Hessian is not positive, the projected one takes its place.
fn newton_direction(sheet: &Sheet, x: &[Vec2], system: &mut System, curvature: Curvature) -> Result<f64, SystemError> {
    system.clear();
    for t in &sheet.triangles {
        system.add(&t.v, &t.local(x, curvature));
    }
    for p in &sheet.pairs {
        if let Some(term) = p.local(x, curvature) {
            system.add(&p.v, &term);
        }
    }
    for lock in &sheet.locks {
        lock.assemble(x, curvature, |v, term| system.add(v, term));
    }
    match system.factorize() {
        Err(SystemError::NotPositive) if curvature == Curvature::Exact => {
            return newton_direction(sheet, x, system, Curvature::Projected);
        }
        other => other?,
    }
    let downhill = system.rhs.clone();
    system.substitute();
    Ok(0.5 * downhill.iter().zip(&system.rhs).map(|(g, d)| g.dot(d)).sum::<f64>())
}

/// Takes the longest of the steps 1, ½, ¼ … that flips no triangle and gains enough energy; 0 when none does.
///
/// With a `decrement` of 0 the gain is not asked for, since the energy cannot resolve it.
fn line_search(sheet: &Sheet, x: &mut Vec<Vec2>, direction: &[Vec2], energy: &mut f64, decrement: f64) -> f64 {
    let mut step = flip_limit(sheet, x, direction);
    let slack = if decrement > 0.0 { 0.1 * ENERGY_RESOLUTION } else { 100.0 * ENERGY_RESOLUTION };
    for _ in 0..40 {
        let trial: Vec<Vec2> = x.iter().zip(direction).map(|(p, d)| p + d * step).collect();
        let value = total(sheet, &trial);
        if value <= *energy * (1.0 + slack) - SUFFICIENT_DECREASE * step * decrement {
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
