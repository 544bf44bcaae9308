//! The body: a closed triangle mesh with named girths, landmarks and segments (ISO 8559-1).

use crate::Vec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A limb or the torso as a straight axis with a radius, for placing pieces around it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BodySegment {
    /// Start of the axis (shoulder, hip joint, crotch level of the torso's top …), metres.
    #[schemars(with = "[f64; 3]")]
    pub from: Vec3,
    /// End of the axis, metres.
    #[schemars(with = "[f64; 3]")]
    pub to: Vec3,
    /// Half width across the axis along +x (torso: sideways), metres, largest along the segment.
    pub half_width: f64,
    /// Half depth across the axis along +z, metres, largest along the segment.
    pub half_depth: f64,
}

/// Collision form and measuring dummy; metres, +y up, +z front, +x the wearer's left, feet at y = 0.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Body {
    /// Name.
    pub name: String,
    /// Vertices.
    #[schemars(with = "Vec<[f64; 3]>")]
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub positions: Vec<Vec3>,
    /// Triangles, counter-clockwise seen from outside.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub triangles: Vec<[u32; 3]>,
    /// Girths and lengths by ISO 8559-1 name (`waist_girth`, `hip_girth`, …), metres.
    #[serde(default)]
    pub measures: BTreeMap<String, f64>,
    /// Landmarks by name, metres.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, [f64; 3]>")]
    pub landmarks: BTreeMap<String, Vec3>,
    /// Segments by name: `torso`, `arm-left`, `arm-right`, `leg-left`, `leg-right`, `neck`.
    #[serde(default)]
    pub segments: BTreeMap<String, BodySegment>,
    /// Digest of the mesh (blake3 of its file), to tell bodies apart when the mesh itself is not carried.
    #[serde(default)]
    pub digest: String,
}
