//! The certificate of a motion: what no motion of cloth does, measured frame by frame.

use super::AnimateParams;
use crate::drape::SwitchName;
use std::collections::BTreeMap;
use toile_cloth::{Figures, Frame, Scene};
use toile_garment::Vec3;
use toile_garment::animation::MotionCertificate;

// The gates are chosen, not fitted to measurements.

/// Largest strain of a motion as a multiple of the gate of the drape's strain. A jerk stretches cloth beyond its drape
/// for a moment, which a finding tells.
const STRETCH_MARGIN: f64 = 2.0;
/// Largest share of energy that may come from nothing. A sheet that falls by explicit steps gains nothing up to 0.9 of
/// the stable step. At 1.1 and 1.7 of it, over 0.9 of the energy comes from nothing.
const ENERGY_GAIN: f64 = 0.25;
/// Largest deviation of a free fall, as a share of the fall. That sheet stays below 1e-12 up to 0.9 of the stable step,
/// and is off by over 0.9 at 1.1 and 1.7 of it.
const FALL_ERROR: f64 = 0.01;
/// Speed whose energy counts as none, m/s: ten times the usual speed at which cloth counts as at rest.
const QUIET_SPEED: f64 = 0.05;

/// Energies and the mass centre of the cloth over the frames.
pub(super) struct Watched {
    /// Mass of every vertex, kg.
    mass: Vec<f64>,
    /// The first frame: its energy, J, and its mass centre, m.
    first: Option<(f64, Vec3)>,
    /// Most energy of a frame beyond that of the first, J.
    gain: f64,
    /// Most kinetic energy of a frame, J.
    kinetic: f64,
    /// Least and most potential energy of a frame, J.
    potential: [f64; 2],
    /// The last frame: its time, s, and its mass centre, m.
    last: (f64, Vec3),
}

impl Watched {
    /// Nothing seen yet.
    pub fn new(scene: &Scene) -> Self {
        let mut mass = vec![0.0; scene.positions.len()];
        for t in &scene.triangles {
            let share = scene.materials[t.material as usize].areal_mass * t.area().abs() / 3.0;
            t.vertices.iter().for_each(|v| mass[*v as usize] += share);
        }
        let potential = [f64::INFINITY, f64::NEG_INFINITY];
        Self { mass, first: None, gain: 0.0, kinetic: 0.0, potential, last: (0.0, Vec3::zeros()) }
    }

    /// Takes a frame.
    pub fn take(&mut self, frame: &Frame<'_>) {
        let total: f64 = self.mass.iter().sum();
        let centre: Vec3 = self.mass.iter().zip(frame.positions).map(|(m, p)| p * (m / total.max(1e-300))).sum();
        let energy = frame.kinetic + frame.potential;
        let (first, _) = *self.first.get_or_insert((energy, centre));
        self.gain = self.gain.max(energy - first);
        self.kinetic = self.kinetic.max(frame.kinetic);
        self.potential = [self.potential[0].min(frame.potential), self.potential[1].max(frame.potential)];
        self.last = (frame.seconds, centre);
    }

    /// Energy gained, as a share of the energy that changes hands in the motion.
    fn energy_gain(&self) -> f64 {
        let quiet = 0.5 * self.mass.iter().sum::<f64>() * QUIET_SPEED * QUIET_SPEED;
        let exchanged = self.kinetic + (self.potential[1] - self.potential[0]).max(0.0) + quiet;
        if exchanged > 0.0 { self.gain / exchanged } else { 0.0 }
    }

    /// Deviation from a free fall; `None` before anything fell.
    fn fall_error(&self, gravity: f64) -> Option<f64> {
        let (time, now) = self.last;
        let fall = 0.5 * gravity * time * time;
        let (_, start) = self.first.filter(|_| fall > 0.0)?;
        Some((now - start + Vec3::y() * fall).norm() / fall)
    }

    /// Figures and gates together; `strain` is the gate of the drape's strain.
    pub fn certificate(
        &self,
        scene: &Scene,
        params: &AnimateParams,
        worst: &Figures,
        strain: f64,
    ) -> MotionCertificate {
        let undamped = params.air == SwitchName::Off && params.calming.0 <= 0.0;
        let free = scene.pins.is_empty() && scene.loads.is_empty() && scene.body.is_none();
        let limits = [
            ("stretch_max", STRETCH_MARGIN * strain),
            ("crossings", 0.0),
            ("energy_gain", ENERGY_GAIN),
            ("fall_error", FALL_ERROR),
        ];
        let mut certificate = MotionCertificate {
            passed: false,
            stretch_max: worst.strain_max,
            crossings: (worst.self_crossings + worst.body_crossings) as u64,
            energy_gain: if params.body.is_none() { self.energy_gain() } else { 0.0 },
            fall_error: if undamped && free { self.fall_error(params.gravity.0) } else { None },
            limits: BTreeMap::from(limits.map(|(name, limit)| (name.to_owned(), limit))),
        };
        certificate.passed = certificate.failures().is_empty();
        certificate
    }
}
