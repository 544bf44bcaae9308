//! How much softer in its plane the cloth of a coarser level is.
//!
//! Flat triangles fold along their edges only. What folds across them stretches them, and stretch K holds folds of a mesh
//! of edges h the more, the larger K h²/B is beside the bending stiffness B: coarse cloth locks into folds that the finer
//! one leaves again, slowly, a millimetre a block of steps. So a level is as much softer as its edges are longer, squared.
//! How far it then hangs down is nothing: the finer cloth draws itself up in the first steps.

use crate::scene::measures::side;
use crate::scene::topology::Topology;
use crate::scene::{Material, Scene};

/// Strain under the weight of as long a cloth as the largest part is wide, up to which a level is made softer: from 3 % on
/// the shape becomes another.
const STRAIN: f64 = 0.02;
/// Strain at which stiffness is told.
const AT: f64 = 0.01;

/// Softens the cloth of a level whose edges are so many times as long as those of the finer one.
pub(crate) fn soften(level: &mut Scene, longer: f64) {
    let topology = Topology::of_elements(level.positions.len(), &level.triangles);
    let load = level.gravity.norm() * side(level, &topology);
    for m in &mut level.materials {
        let least = load * m.areal_mass / (STRAIN * m.warp.tangent(AT).min(m.weft.tangent(AT)));
        scale(m, (1.0 / (longer * longer)).max(least).min(1.0));
    }
}

fn scale(m: &mut Material, share: f64) {
    for curve in [&mut m.warp, &mut m.weft] {
        *curve = curve.times(share);
    }
    m.shear *= share;
    m.springs = m.springs.map(|all| all.map(|k| k * share));
}
