//! The air damps motion by two terms.
//!
//! A pressure p = c v |v| acts against the part v of the velocity that is across the cloth. A plate in a stream has
//! c = ½ ρ C_d. A plain rate in 1/s acts on the whole velocity (paper equation 7).

use crate::dynamics::motion::Dynamics;
use crate::{Element, Vec3};
use nalgebra::Matrix3;

/// Damping matrix of every vertex at velocities `v`, kg/s.
pub(crate) fn viscous(d: &Dynamics, mass: &[f64], cloth: &[Element], x: &[Vec3], v: &[Vec3]) -> Vec<Matrix3<f64>> {
    let mut all: Vec<Matrix3<f64>> = mass.iter().map(|m| Matrix3::identity() * (m * d.damping)).collect();
    if d.drag <= 0.0 {
        return all;
    }
    for e in cloth {
        let t = &e.vertices;
        let Some(n) = crate::unit_normal(crate::pick3(x, t)) else { continue };
        let speed = (t.iter().map(|i| v[*i as usize]).sum::<Vec3>() / 3.0).dot(&n).abs();
        let share = n * n.transpose() * (d.drag * speed * e.area().abs() / 3.0);
        t.iter().for_each(|i| all[*i as usize] += share);
    }
    all
}
