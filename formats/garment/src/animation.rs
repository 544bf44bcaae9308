//! The garment in motion: one shape for each frame.

use crate::Vec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

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
}
