//! The garment in motion: one shape for each frame.

use crate::Vec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The figures of a motion, each with its gate.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MotionCertificate {
    /// Are all figures within their gates?
    pub passed: bool,
    /// Largest strain along warp or weft in any frame.
    pub stretch_max: f64,
    /// Most intersecting triangle pairs of a frame, of the cloth with itself and with the body.
    pub crossings: u64,
    /// Energy gained from nothing, as a share of the energy that moves in the motion. 0 where the body moves, which
    /// does work.
    pub energy_gain: f64,
    /// Distance of the middle of free cloth from where gravity alone brings it, as a share of the fall. `None` where
    /// something else acts: pins, loads, a body, air or calming.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fall_error: Option<f64>,
    /// Gates.
    pub limits: BTreeMap<String, f64>,
}

impl MotionCertificate {
    /// The figures beyond their gates: name, figure, gate. A figure that is no number never passes.
    #[must_use]
    pub fn failures(&self) -> Vec<(&'static str, f64, f64)> {
        let figures = [
            ("stretch_max", Some(self.stretch_max)),
            ("crossings", Some(self.crossings as f64)),
            ("energy_gain", Some(self.energy_gain)),
            ("fall_error", self.fall_error),
        ];
        let gate = |name: &str| self.limits.get(name).copied().unwrap_or(f64::INFINITY);
        let known = figures.into_iter().filter_map(|(name, value)| Some((name, value?, gate(name))));
        known.filter(|(_, value, limit)| value.is_nan() || value > limit).collect()
    }
}

/// Frames at equal times, and the worst that was counted in any of them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Animation {
    /// Frames in a second; the first is at time 0.
    pub fps: f64,
    /// Number of frames.
    pub count: u32,
    /// Per frame, per piece, per mesh vertex, metres. Empty in the document of a GLB: there the frames are morph
    /// targets.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(with = "Vec<Vec<Vec<[f64; 3]>>>")]
    pub frames: Vec<Vec<Vec<Vec3>>>,
    /// Had the cloth come to rest in the last frame?
    pub settled: bool,
    /// Most intersecting triangle pairs of the cloth in a frame, exact, on the numbers that are stored.
    pub self_crossings: u64,
    /// Most intersecting pairs of cloth and body triangles in a frame.
    pub body_crossings: u64,
    /// Deepest cloth vertex inside the body in any frame, mm.
    pub penetration_max_mm: f64,
    /// Largest strain along warp or weft in any frame.
    pub strain_max: f64,
    /// The certificate of the motion.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub certificate: Option<MotionCertificate>,
}
