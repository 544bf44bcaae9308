//! Parts of the body that a piece does not meet while it is sewn.
//!
//! A wide skirt starts in the hands of an arm that hangs beside it, or its side seams close through a forearm. A person who
//! dresses the body lifts the arm. Here the pieces that do not lie on the arm ignore the forearm until they hang.

use super::place::spec_of;
use crate::body::hull;
use crate::solve::body_parts::{BodyPart, body_parts, nearest_part_seen_from_front};
use crate::solve::level_cut::level_cut;
use std::collections::BTreeMap;
use toile_garment::{Diagnostic, Garment, Vec2, Vec3};

/// Distance from the axis of a forearm within which cloth counts as touching it, over the radius of the arm. Gores of ten that
/// stand 60 mm inside the hand catch it while they are sewn.
const REACH: f64 = 1.5;
/// Steps from the elbow to the tip of the hand at which the cloth is looked at: one for about 50 mm.
const HEIGHTS: i32 = 8;
/// Length of a hand beyond the wrist, over the radius of the arm: 0.2 m on an arm of 50 mm.
const HAND_LENGTH: f64 = 4.0;

/// Names of the parts that each piece ignores, by the names of the pieces. What the sewing file says of a piece wins.
#[must_use]
pub fn ignored_parts(garment: &Garment, placed: &[Vec<Vec3>]) -> BTreeMap<String, Vec<String>> {
    let parts = garment.body.as_ref().map(body_parts).unwrap_or_default();
    let mut ignores: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let beside = beside_arms(garment, placed);
    for forearm in parts.iter().filter(|p| p.name.starts_with("forearm-")) {
        if is_in_the_way(garment, placed, &beside, forearm) {
            for i in &beside {
                let top = placed[*i].iter().map(|p| p.y).fold(f64::NEG_INFINITY, f64::max);
                // Cloth that begins below the elbow has nothing to do with the upper arm.
                let part = if top < forearm.axis[0].y { &forearm.segment } else { &forearm.name };
                ignores.entry(garment.pieces[*i].name.clone()).or_default().push(part.clone());
            }
        }
    }
    for piece in &garment.pieces {
        if let Some(named) = spec_of(garment, piece).and_then(|place| place.ignores.as_ref()) {
            ignores.insert(piece.name.clone(), named.clone());
        }
    }
    ignores.retain(|_, names| !names.is_empty());
    ignores
}

/// Returns `true` if more than half of these places lie nearest to a segment, seen from the front.
pub(super) fn lies_on(x: &[Vec3], segment: &str, parts: &[BodyPart]) -> bool {
    let near = |p: &&Vec3| nearest_part_seen_from_front(parts, p).is_some_and(|k| parts[k].segment == segment);
    2 * x.iter().filter(near).count() > x.len()
}

/// Pieces that lie on no arm.
#[must_use]
pub fn beside_arms(garment: &Garment, placed: &[Vec<Vec3>]) -> Vec<usize> {
    let parts = garment.body.as_ref().map(body_parts).unwrap_or_default();
    let on_arm = |x: &[Vec3]| ["arm-left", "arm-right"].iter().any(|arm| lies_on(x, arm, &parts));
    (0..placed.len()).filter(|i| !on_arm(&placed[*i])).collect()
}

/// Returns `true` if these pieces stand around a forearm or touch it. Cloth that starts beyond the arm has to pass it. The
/// hulls of some level cuts of the cloth decide.
fn is_in_the_way(garment: &Garment, placed: &[Vec<Vec3>], pieces: &[usize], forearm: &BodyPart) -> bool {
    let [elbow, wrist] = forearm.axis;
    let hand = (wrist - elbow).try_normalize(1e-9).unwrap_or_else(Vec3::zeros) * (HAND_LENGTH * forearm.radius);
    (0..=HEIGHTS).any(|k| {
        let p = elbow + (wrist + hand - elbow) * (f64::from(k) / f64::from(HEIGHTS));
        let meshes = pieces.iter().filter_map(|i| Some((garment.pieces[*i].mesh.as_ref()?, &placed[*i])));
        let ends = meshes.flat_map(|(mesh, at)| level_cut(mesh, at, p.y)).flat_map(|(ends, _)| ends);
        let seen_from_above = ends.map(|p| Vec2::new(p.x, p.z)).collect();
        depth_in_hull(&hull(seen_from_above), &Vec2::new(p.x, p.z)) > -REACH * forearm.radius
    })
}

/// Distance of a place from the border of a hull, m, below zero outside. Without a hull it is infinitely far outside.
fn depth_in_hull(hull: &[Vec2], p: &Vec2) -> f64 {
    let next = hull.iter().skip(1).chain(hull.first());
    let depth = |(a, b): (&Vec2, &Vec2)| (b - a).perp(&(p - a)) / (b - a).norm();
    if hull.is_empty() { f64::NEG_INFINITY } else { hull.iter().zip(next).map(depth).fold(f64::INFINITY, f64::min) }
}

/// Tells which pieces were sewn without which parts.
#[must_use]
pub fn finding(ignores: &BTreeMap<String, Vec<String>>) -> Option<Diagnostic> {
    let mut parts: Vec<&str> = ignores.values().flatten().map(String::as_str).collect();
    parts.sort_unstable();
    parts.dedup();
    let pieces: Vec<String> = ignores.keys().map(|name| format!("`{name}`")).collect();
    (!parts.is_empty()).then(|| {
        let message = format!("{} were sewn without meeting {}", pieces.join(", "), parts.join(", "));
        Diagnostic::info(super::codes::SEWN_PAST_LIMB, message).hint(
            "the drape meets the whole body; ignores = [] in a [[place]] lets that piece meet all of it from the start",
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::body_of;
    use toile_garment::body::Body;
    use toile_garment::mesh::PieceMesh;
    use toile_garment::{Piece, PieceId};

    fn body() -> Body {
        body_of(&[
            ("torso", [0.0, 1.4, 0.0], [0.0, 0.8, 0.0], 0.17),
            ("arm-left", [0.16, 1.39, 0.0], [0.54, 1.0, 0.0], 0.05),
        ])
    }

    /// A front and a back sheet, whose sides lie at a distance from the middle, m.
    fn sheets(side: f64) -> (Garment, Vec<Vec<Vec3>>) {
        let rest = vec![Vec2::new(-side, 0.0), Vec2::new(side, 0.0), Vec2::new(side, 0.3), Vec2::new(-side, 0.3)];
        let piece = |id: usize, name: &str| Piece {
            id: PieceId::from(id),
            name: name.into(),
            mesh: Some(PieceMesh { rest: rest.clone(), triangles: vec![[0, 1, 2], [0, 2, 3]], ..PieceMesh::default() }),
            ..Piece::default()
        };
        let at = |z: f64| rest.iter().map(|p| Vec3::new(p.x, p.y + 0.9, z)).collect::<Vec<_>>();
        let garment =
            Garment { pieces: vec![piece(0, "front"), piece(1, "back")], body: Some(body()), ..Garment::default() };
        (garment, vec![at(0.2), at(-0.2)])
    }

    #[test]
    fn sheets_around_the_forearm_ignore_it() {
        let (garment, placed) = sheets(0.45);
        let ignores = ignored_parts(&garment, &placed);
        assert_eq!(ignores.keys().collect::<Vec<_>>(), ["back", "front"]);
        assert!(ignores.values().all(|names| names == &["forearm-left"]));
        let told = finding(&ignores).expect("a finding").message;
        assert!(told.contains("`front`") && told.contains("forearm-left"), "{told}");
    }

    #[test]
    fn sheets_that_close_beside_the_arm_meet_all_of_the_body() {
        let (garment, placed) = sheets(0.25);
        assert!(ignored_parts(&garment, &placed).is_empty());
    }

    #[test]
    fn the_sewing_file_wins() {
        let (mut garment, placed) = sheets(0.45);
        garment.plan.places = ["front", "back"]
            .map(|piece| toile_garment::sewing::PlaceSpec {
                piece: piece.into(),
                ignores: Some(Vec::new()),
                placement: toile_garment::sewing::Placement::Explicit {
                    rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
                    translation: Vec3::zeros(),
                },
                source: None,
            })
            .into();
        assert!(ignored_parts(&garment, &placed).is_empty());
    }
}
