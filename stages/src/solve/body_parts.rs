//! Parts of the body by its segments: which triangles belong to which limb.

use super::Layout;
use std::collections::BTreeMap;
use std::sync::Arc;
use toile_cloth::ContactFilter;
use toile_garment::body::{Body, BodySegment};
use toile_garment::{Garment, MeshVertex, Vec3};

/// Where an arm's segment is cut into upper arm and forearm, as a share of its length from the shoulder.
const ELBOW: f64 = 0.5;

/// A part of the body that cloth may ignore: a segment, or the half of an arm.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyPart {
    /// `torso`, `neck`, `leg-left`, `arm-left` (the upper arm), `forearm-left` (with the hand) and their like.
    pub name: String,
    /// Segment that the part belongs to.
    pub segment: String,
    /// Axis, m.
    pub axis: [Vec3; 2],
    /// Largest half width across the axis, m.
    pub radius: f64,
}

/// The parts of a body, by the names of their segments.
#[must_use]
pub fn body_parts(body: &Body) -> Vec<BodyPart> {
    let part = |name: String, segment: &str, s: &BodySegment, [from, to]: [f64; 2]| BodyPart {
        name,
        segment: segment.to_owned(),
        axis: [from, to].map(|t| s.from + (s.to - s.from) * t),
        radius: s.half_width.max(s.half_depth),
    };
    let parts = body.segments.iter().flat_map(|(name, s)| match name.strip_prefix("arm-") {
        Some(side) => {
            let forearm = format!("forearm-{side}");
            vec![part(name.clone(), name, s, [0.0, ELBOW]), part(forearm, name, s, [ELBOW, 1.0])]
        }
        None => vec![part(name.clone(), name, s, [0.0, 1.0])],
    });
    // A part is one bit.
    parts.filter(|p| p.radius > 0.0).take(u32::BITS as usize).collect()
}

/// The part that a place is nearest to as seen from the front, by its distance from the axis over the part's radius. Flat
/// sheets in front of an arm and behind it lie on it.
#[must_use]
pub fn nearest_part_seen_from_front(parts: &[BodyPart], p: &Vec3) -> Option<usize> {
    let flat = |p: Vec3| Vec3::new(p.x, p.y, 0.0);
    let near = |part: &BodyPart| (flat(*p) - nearest_on(part.axis.map(flat), &flat(*p))).norm() / part.radius;
    (0..parts.len()).min_by(|a, b| near(&parts[*a]).total_cmp(&near(&parts[*b])))
}

/// The place on a line between two ends that is nearest to `p`.
fn nearest_on([from, to]: [Vec3; 2], p: &Vec3) -> Vec3 {
    let along = to - from;
    let share = (p - from).dot(&along) / along.norm_squared().max(1e-12);
    from + along * share.clamp(0.0, 1.0)
}

/// The filter of a garment whose pieces ignore some parts of its body, by the names of pieces and parts.
#[must_use]
pub fn contact_filter(garment: &Garment, layout: &Layout, ignores: &BTreeMap<String, Vec<String>>) -> ContactFilter {
    let Some(body) = garment.body.as_ref().filter(|_| ignores.values().any(|names| !names.is_empty())) else {
        return ContactFilter::default();
    };
    let parts = body_parts(body);
    let bits_of = |names: &Vec<String>| {
        let named = |p: &BodyPart| names.iter().any(|n| *n == p.name || *n == p.segment);
        parts.iter().enumerate().filter(|(_, p)| named(p)).fold(0, |bits, (k, _)| bits | 1 << k)
    };
    let mut ignored = Vec::new();
    for piece in &garment.pieces {
        let bits: u32 = ignores.get(&piece.name).map_or(0, bits_of);
        for v in 0..piece.mesh.as_ref().map_or(0, |m| m.rest.len()) {
            let vertex = MeshVertex { piece: piece.id, vertex: u32::try_from(v).unwrap_or(u32::MAX) };
            ignored.push((layout.index(vertex), bits));
        }
    }
    ignored.sort_unstable();
    ContactFilter {
        body_parts: Arc::new(triangle_parts(body, &parts)),
        ignored: ignored.into_iter().map(|(_, bits)| bits).collect(),
    }
}

/// The part of every triangle of the body, as a bit.
fn triangle_parts(body: &Body, parts: &[BodyPart]) -> Vec<u32> {
    let middle = |t: &[u32; 3]| t.iter().map(|v| body.positions[*v as usize]).sum::<Vec3>() / 3.0;
    // By the distance from the part's surface. A finger is far from its wrist.
    let gap = |part: &BodyPart, p: &Vec3| (p - nearest_on(part.axis, p)).norm() - part.radius;
    let part = |p: Vec3| (0..parts.len()).min_by(|a, b| gap(&parts[*a], &p).total_cmp(&gap(&parts[*b], &p)));
    body.triangles.iter().map(|t| part(middle(t)).map_or(0, |k| 1 << k)).collect()
}
