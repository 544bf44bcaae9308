//! Impacts without rebound: cloth that met something in a stage does not leave it faster than nothing pulls it away.
//! The stages of a scheme of second order turn a hit into a rebound of up to √2 times its speed, out of nothing.

use crate::Vec3;
use crate::contact::barrier::Barrier;
use crate::contact::barrier::active_contact::ActiveContact;
use crate::dynamics::tuning::IMPACT_SWEEPS;

/// Takes the separating speed out of every contact, by impulses of equal size on both sides.
///
/// `body` holds the velocities of the body's vertices. It is empty for a body at rest. `free` marks the vertices that
/// are not held.
pub(crate) fn settle(barrier: &Barrier, x: &[Vec3], v: &mut [Vec3], mass: &[f64], free: &[bool], body: &[Vec3]) {
    let place = |t: &ActiveContact| match &barrier.body {
        Some(b) if !body.is_empty() => b.interpolate_at_pair(&t.key, x, body),
        _ => Vec3::zeros(),
    };
    let others: Vec<Vec3> = barrier.contacts.iter().map(place).collect();
    for _ in 0..IMPACT_SWEEPS.get() {
        for (t, other) in barrier.contacts.iter().zip(&others) {
            stop(t, other, v, mass, free);
        }
    }
}

fn stop(t: &ActiveContact, other: &Vec3, v: &mut [Vec3], mass: &[f64], free: &[bool]) {
    let mut speed = -other.dot(&t.normal);
    let mut mobility = 0.0;
    for (w, i) in t.weights.iter().zip(t.vertices.map(|i| i as usize)).filter(|(w, _)| **w != 0.0) {
        speed += w * v[i].dot(&t.normal);
        mobility += if free[i] { w * w / mass[i] } else { 0.0 };
    }
    if speed <= 0.0 || mobility <= 0.0 {
        return;
    }
    for (w, i) in t.weights.iter().zip(t.vertices.map(|i| i as usize)).filter(|(w, i)| **w != 0.0 && free[*i]) {
        v[i] -= t.normal * (speed / mobility * w / mass[i]);
    }
}
