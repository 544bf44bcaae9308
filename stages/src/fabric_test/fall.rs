//! How the specimen of a drape test falls, and in which state of rest it is read.
//!
//! Cloth over a disc has many states of rest, with two to twelve folds. A small ripple grows into the folds that grow
//! fastest, often eight, and stays there, though five may lie deeper and shade seven points less. Cloth in a laboratory
//! falls with a swing and is not so shy. So it falls several times, on a coarse mesh, each time with another number of
//! folds begun, and is read where elastic energy and weight together are least.
//!
//! The cloth on the disc is held flat. A hinge over the last held circle bends over half a cell on each side of it, so
//! the edge of the disc lies half a cell within that circle.

use super::cusick::{CusickParams, DISC};
use super::mesh::{Flat, ROW, ring};
use super::rig::{Rest, Rig};
use crate::solve::material;
use std::f64::consts::PI;
use toile_garment::Vec3;
use toile_garment::fabric::Fabric;
use toile_stage_api::{StageContext, StageError};

/// Edge of the mesh on which the folds are sought, m.
const SEARCH: f64 = 8e-3;
/// Folds to begin with; 0: small ripples of all lengths.
const FOLDS: [u32; 5] = [0, 4, 5, 6, 7];
/// Ripple of the flat start at the hem, m: the folds must begin somewhere, and the same on every mesh.
const RIPPLE: f64 = 5e-4;
/// Slope of begun folds at the hem, rad: less than any rest has, so that yarns which rub are bent one way only.
const TILT: f64 = 0.14;
/// The golden angle spreads phases evenly, without chance.
const GOLDEN: f64 = 2.399_963_229_728_653;

/// A specimen at rest.
pub struct Fallen {
    pub cloth: Flat,
    pub rest: Rest,
    begun: u32,
}

/// The deepest rest of all beginnings.
///
/// # Errors
/// When the cloth comes to rest from none of them, or the user asks to stop.
pub fn deepest(fabric: &Fabric, params: &CusickParams, cx: &mut StageContext<'_>) -> Result<Fallen, StageError> {
    let edge = params.edge.max(SEARCH.min(params.coarsest()));
    let coarse = CusickParams { edge, ..*params };
    let mut found: Result<Fallen, StageError> = Err(StageError::Internal("no beginning".into()));
    for begun in FOLDS {
        match (fall(fabric, &coarse, begun, cx), &found) {
            (Ok(new), Ok(old)) if new.rest.energy >= old.rest.energy => {}
            (Err(StageError::Unstable(_)), Ok(_)) => {}
            (new @ (Ok(_) | Err(StageError::Unstable(_))), _) => found = new,
            (Err(other), _) => return Err(other),
        }
    }
    let found = found?;
    if edge > params.edge { fall(fabric, params, found.begun, cx) } else { Ok(found) }
}

/// Lets the cloth come to rest from one beginning.
pub(super) fn fall(
    fabric: &Fabric,
    params: &CusickParams,
    begun: u32,
    cx: &mut StageContext<'_>,
) -> Result<Fallen, StageError> {
    let rim = 0.5 * params.specimen;
    let (cloth, held) = mesh(rim, params.edge);
    let start = cloth.place(|p| {
        if begun == 0 { ripples(p, rim, params.repeat) } else { folds(p, [held, rim], begun, params.repeat) }
    });
    let pins = cloth.pick(|p| libm::hypot(p[0], p[1]) < held).into_iter().map(|v| (v, start[v as usize])).collect();
    let rig = Rig { cloth: &cloth, material: material(fabric), start, held: pins, heavy: true, folds: true };
    let rest = rig.settle(cx)?;
    Ok(Fallen { cloth, rest, begun })
}

/// Circles from half a cell within the disc's edge to the hem, and the radius up to which vertices are held.
fn mesh(rim: f64, edge: f64) -> (Flat, f64) {
    let free = (rim - DISC) / (edge * ROW);
    let count = (free + 0.5).round().max(2.0) as u32;
    let cell = (rim - DISC) / (f64::from(count) - 0.5);
    let radii: Vec<f64> = (0..=count).map(|k| DISC + (f64::from(k) - 0.5) * cell).collect();
    (ring(&radii, edge), DISC + cell)
}

/// Flat, with ripples of two to nine waves that grow towards the hem.
fn ripples([x, y]: [f64; 2], rim: f64, repeat: u32) -> Vec3 {
    let (r, angle) = (libm::hypot(x, y), libm::atan2(y, x));
    let out = ((r - DISC) / (rim - DISC)).max(0.0);
    let phase = |n: u32| GOLDEN * f64::from(n + 8 * repeat) * f64::from(n);
    let ripple: f64 = (2..=9).map(|n| libm::cos(f64::from(n) * angle + phase(n))).sum();
    Vec3::new(x, if r > DISC { RIPPLE * out * out * ripple } else { 0.0 }, -y)
}

/// Radii bent down to arcs, most in the valleys of so many folds.
fn folds([x, y]: [f64; 2], [held, rim]: [f64; 2], count: u32, repeat: u32) -> Vec3 {
    let (r, angle) = (libm::hypot(x, y), libm::atan2(y, x));
    let free = r - held;
    if free <= 0.0 {
        return Vec3::new(x, 0.0, -y);
    }
    let phase = GOLDEN * f64::from(repeat) + PI;
    let slope = TILT * free / (rim - held) * 0.5 * (1.0 + libm::cos(f64::from(count) * angle + phase));
    let out = (held + free * libm::cos(0.5 * slope)) / r;
    Vec3::new(out * x, -free * libm::sin(0.5 * slope), -out * y)
}
