//! Coulomb friction on the velocities after a step: an impulse against the sliding.
//!
//! The impulse is as large as stops the sliding, and at most μ times the normal impulse. A contact that can stick
//! therefore sticks, without creep (docs/contact.md). The paper has no friction.

use crate::Vec3;
use crate::explicit::contact::pair::ContactPair;

/// Applies friction to the velocities `v`; returns the number of contacts that slip.
pub(crate) fn apply(pairs: &[ContactPair], inverse_mass: &[f64], dt: f64, v: &mut [Vec3]) -> u64 {
    let mut slipping = 0;
    for p in pairs.iter().filter(|p| p.load > 0.0 && p.friction > 0.0) {
        let mut relative = Vec3::zeros();
        let mut mobility = 0.0;
        for k in 0..4 {
            let (w, i) = (p.weights[k], p.vertices[k] as usize);
            relative += v[i] * w;
            mobility += w * w * inverse_mass[i];
        }
        let slide = relative - p.normal * p.normal.dot(&relative);
        let speed = slide.norm();
        if speed <= 0.0 || mobility <= 0.0 {
            continue;
        }
        let stop = speed / mobility;
        let most = p.friction * p.load * dt;
        slipping += u64::from(stop > most);
        let impulse = slide * (stop.min(most) / speed);
        for k in 0..4 {
            let i = p.vertices[k] as usize;
            v[i] -= impulse * (p.weights[k] * inverse_mass[i]);
        }
    }
    slipping
}
