//! Coulomb friction on the accepted velocities: an impulse against the sliding, as large as stops it, at most
//! μ times the normal impulse. So what can stick does stick, without creep (docs/contact.md).

use crate::Vec3;
use crate::explicit::contact::Pair;

/// Applies friction to `v`; returns how many contacts slip.
pub(crate) fn apply(pairs: &[Pair], inverse_mass: &[f64], dt: f64, v: &mut [Vec3]) -> u64 {
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
