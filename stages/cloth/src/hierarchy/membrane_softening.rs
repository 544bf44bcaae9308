//! Membrane softening of a coarser level against locking.
//!
//! Flat triangles fold along their edges only; a fold across a triangle stretches it. With stretch stiffness K, bending
//! stiffness B and edges h, folds are held the more, the larger K h²/B is. Coarse cloth therefore locks into folds that
//! the finer cloth leaves slowly, by a millimetre in a block of steps.
//!
//! A level is softer by the square of the ratio of its edges to those of the finer cloth. It then hangs lower, which
//! the finer cloth undoes in its first steps.

use crate::hierarchy::tuning::{MEMBRANE_SOFTENING, SOFTENED_STRAIN_MAX};
use crate::scene::measures::side;
use crate::scene::topology::Topology;
use crate::scene::{Material, Scene};

/// Strain at which the stiffness of a curve is taken.
const STIFFNESS_STRAIN: f64 = 0.01;

/// Softens the cloth of a level whose edges are `longer` times as long as those of the finer cloth.
pub(crate) fn soften_membrane(level: &mut Scene, longer: f64) {
    if !MEMBRANE_SOFTENING.is_on() {
        return;
    }
    let topology = Topology::of_elements(level.positions.len(), &level.triangles);
    let load = level.gravity.norm() * side(level, &topology);
    for m in &mut level.materials {
        let least = load * m.areal_mass
            / (SOFTENED_STRAIN_MAX.get() * m.warp.tangent(STIFFNESS_STRAIN).min(m.weft.tangent(STIFFNESS_STRAIN)));
        scale(m, (1.0 / (longer * longer)).max(least).min(1.0));
    }
}

/// Multiplies all stiffnesses of a fabric in its plane by a share.
fn scale(m: &mut Material, share: f64) {
    for curve in [&mut m.warp, &mut m.weft] {
        *curve = curve.times(share);
    }
    m.shear *= share;
    m.shear_curve = m.shear_curve.as_ref().map(|curve| curve.times(share));
    m.springs = m.springs.map(|all| all.map(|k| k * share));
}
