//! Words for a place on the body: the limb or the side, and the height beside a landmark.

use super::with_segments;
use toile_garment::Vec3;
use toile_garment::body::{Body, BodySegment};

/// A place nearer to the height of a landmark lies at it, m.
const AT_LANDMARK: f64 = 0.01;
/// Share of the half width of the trunk from which on a place lies left or right of its middle.
const OFF_MIDDLE: f64 = 0.25;
/// Words for the heights of landmarks, by the beginning of their names.
const HEIGHTS: [&str; 8] = ["neck", "shoulder", "bust", "waist", "hip", "crotch", "knee", "ankle"];

/// A place in words, such as `at the left front, 40 mm above the waist`; `None` where the body tells no segments.
#[must_use]
pub fn words(body: &Body, at: Vec3) -> Option<String> {
    let body = with_segments(body);
    let beside = |s: &BodySegment| distance(s, at) - 0.5 * (s.half_width + s.half_depth);
    // Legs reach into the trunk.
    let crotch = body.segments.get("torso").map_or(f64::INFINITY, |s| s.from.y.min(s.to.y));
    let may_hold = |name: &str| !name.starts_with("leg") || at.y < crotch;
    let held = body.segments.iter().filter(|(name, _)| may_hold(name));
    let (name, segment) = held.min_by(|a, b| beside(a.1).total_cmp(&beside(b.1)))?;
    let limb = match name.as_str() {
        "torso" => format!("at the {}", side(segment, at)),
        "neck" => format!("at the {} of the neck", side(segment, at)),
        limb => {
            let (limb, lateral) = limb.split_once('-')?;
            format!("on the {lateral} {limb}")
        }
    };
    Some(match height(&body, at.y) {
        Some(height) if !name.starts_with("arm") && name != "neck" => format!("{limb}, {height}"),
        _ => limb,
    })
}

/// Distance from the axis of a segment, m.
pub fn distance(segment: &BodySegment, at: Vec3) -> f64 {
    let along = segment.to - segment.from;
    let share = ((at - segment.from).dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    (at - segment.from - along * share).norm()
}

/// The side of a segment on which a place lies.
fn side(segment: &BodySegment, at: Vec3) -> String {
    let middle = (segment.from + segment.to) * 0.5;
    let (across, deep) = (at.x - middle.x, at.z - middle.z);
    let lateral = if across > 0.0 { "left" } else { "right" };
    let facing = if deep > 0.0 { "front" } else { "back" };
    if across.abs() * segment.half_depth > deep.abs() * segment.half_width {
        format!("{lateral} side")
    } else if across.abs() > OFF_MIDDLE * segment.half_width {
        format!("{lateral} {facing}")
    } else {
        facing.to_owned()
    }
}

/// A height beside the nearest landmark.
fn height(body: &Body, y: f64) -> Option<String> {
    let of = |word: &'static str| {
        let mark = body.landmarks.iter().find(|(name, _)| name.starts_with(word)).map(|(_, p)| p.y);
        mark.or_else(|| body.measures.get(&format!("{word}_height")).copied()).map(|at| (word, y - at))
    };
    let nearest = HEIGHTS.into_iter().filter_map(of).min_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
    let (word, off) = nearest;
    Some(match off {
        _ if off.abs() < AT_LANDMARK => format!("at the height of the {word}"),
        _ if off > 0.0 => format!("{:.0} mm above the {word}", off * 1e3),
        _ => format!("{:.0} mm below the {word}", -off * 1e3),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{BodyMeasures, parametric};

    #[test]
    fn places_on_a_body_have_words() {
        let body = parametric(&BodyMeasures::size("38").expect("size")).expect("body");
        let told = |x: f64, y: f64, z: f64| words(&body, Vec3::new(x, y, z)).expect("words");
        assert_eq!(told(0.0, 1.05, 0.1), "at the front, at the height of the waist");
        assert_eq!(told(0.06, 1.09, 0.09), "at the left front, 40 mm above the waist");
        assert_eq!(told(-0.17, 0.82, -0.02), "at the right side, 20 mm below the hip");
        assert_eq!(told(0.0, 1.3, -0.1), "at the back, 80 mm above the bust");
        assert_eq!(told(0.45, 1.0, -0.01), "on the left arm");
        assert_eq!(told(-0.09, 0.5, 0.06), "on the right leg, 21 mm above the knee");
        assert_eq!(told(0.0, 1.46, 0.06), "at the front of the neck");
    }

    #[test]
    fn a_mesh_without_names_is_told_by_its_sides_and_its_waist() {
        let named = parametric(&BodyMeasures::size("38").expect("size")).expect("body");
        let bare = Body { positions: named.positions, triangles: named.triangles, ..Body::default() };
        let told = words(&bare, Vec3::new(0.0, 1.0, 0.12)).expect("words");
        assert!(told.starts_with("at the front, ") && told.ends_with(" below the waist"), "{told}");
    }
}
