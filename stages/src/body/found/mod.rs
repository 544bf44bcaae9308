//! Segments, landmarks, girths and heights of a body that nobody named: found on its mesh, upright and facing +z, in an A
//! or T pose or with hanging arms.

mod limbs;
mod marks;
mod measure;
mod moved;
mod points;
mod slices;
mod stance;

pub use measure::{Found, GirthLine, Pose, measured};
pub use slices::Slices;
pub use stance::{MESH_UNITS, MeshUnit, Stance};

use marks::Marks;
use std::collections::BTreeMap;
use toile_garment::Vec3;
use toile_garment::body::{Body, BodySegment};

/// The body with the segments and the waist that it does not name. What it names stays; what cannot be found is left
/// out.
#[must_use]
pub fn with_segments(body: &Body) -> Body {
    let mut whole = body.clone();
    let slices = Slices::new(body);
    let Some(marks) = Marks::of(&slices, measure::named(body, slices.low, "crotch")) else { return whole };
    for (name, segment) in segments(body, &slices, &marks) {
        whole.segments.entry(name).or_insert(segment);
    }
    let named = ["waist", "waist-front"].iter().any(|n| whole.landmarks.contains_key(*n))
        || whole.measures.contains_key("waist_height");
    if !named {
        whole.landmarks.insert("waist".to_owned(), Vec3::new(slices.middle, marks.waist, 0.0));
    }
    whole
}

/// The segments of a body that are seen on its mesh.
fn segments(body: &Body, slices: &Slices<'_>, marks: &Marks) -> BTreeMap<String, BodySegment> {
    let mut found = BTreeMap::new();
    found.insert("torso".to_owned(), marks.torso());
    found.insert("neck".to_owned(), marks.neck(slices.height));
    for (side, sign) in [("left", 1.0), ("right", -1.0)] {
        let seen = limbs::arm(body, slices, marks.half, sign).filter(|arm| !limbs::hangs(arm));
        let arm = seen.or_else(|| limbs::hanging_arm(slices, marks, sign));
        found.extend(arm.map(|s| (format!("arm-{side}"), s)));
        found.extend(limbs::leg(slices, marks, sign).map(|s| (format!("leg-{side}"), s)));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{BodyMeasures, parametric};

    #[test]
    fn segments_are_found_where_the_parametric_body_has_them() {
        let known = parametric(&BodyMeasures::default()).expect("a body");
        let bare = Body {
            segments: Default::default(),
            landmarks: Default::default(),
            measures: Default::default(),
            ..known.clone()
        };
        let found = with_segments(&bare);
        assert!((found.landmarks["waist"].y - known.measures["waist_height"]).abs() < 0.03);
        for (name, segment) in &known.segments {
            let own = &found.segments[name];
            // On an arm the middle of its length is compared: where it begins is a matter of taste.
            let middle = |s: &BodySegment| (s.from + s.to) * 0.5;
            let off = (middle(own) - middle(segment)).norm();
            assert!(off < 0.08, "{name}: {off} {own:?} {segment:?}");
            let way = |s: &BodySegment| (s.to - s.from).normalize();
            assert!(way(own).dot(&way(segment)) > 0.95, "{name}: {own:?} {segment:?}");
        }
    }

    #[test]
    fn an_edited_height_takes_girth_and_landmarks_with_it() {
        let known = parametric(&BodyMeasures::default()).expect("a body");
        let same = measured(&known);
        assert!(same.moved.is_empty(), "{:?}", same.moved);
        assert!(known.measures.iter().all(|(name, x)| same.body.measures.get(name) == Some(x)), "what is named stays");
        let mut edited = known.clone();
        edited.measures.insert("waist_height".to_owned(), known.measures["waist_height"] + 0.05);
        edited.measures.insert("hip_girth".to_owned(), 0.9);
        let found = measured(&edited);
        assert_eq!(found.moved, ["waist_height"]);
        assert!(found.body.measures["waist_girth"] > known.measures["waist_girth"] + 0.01, "the tape moved");
        assert!((found.body.landmarks["waist-front"].y - known.landmarks["waist-front"].y - 0.05).abs() < 1e-3);
        assert_eq!(found.body.measures["hip_girth"], 0.9, "what a person names stays");
        assert!(
            (found.mesh["hip_girth"] - known.measures["hip_girth"]).abs() < 0.008,
            "and the mesh is told beside it"
        );
    }

    #[test]
    fn what_a_body_names_stays() {
        let known = parametric(&BodyMeasures::default()).expect("a body");
        assert_eq!(with_segments(&known), known);
    }
}
