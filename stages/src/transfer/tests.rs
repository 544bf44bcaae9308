//! Bodies of this program on each other.

use super::BodyMap;
use crate::body::{BodyMeasures, girth_at, hull, parametric, section_at};
use crate::fit::level_height;
use std::collections::BTreeMap;
use toile_garment::body::Body;
use toile_garment::{Vec2, Vec3};

fn body(size: &str) -> Body {
    parametric(&BodyMeasures::size(size).expect("size")).expect("body")
}

/// Girth of a tape around the trunk at a height, this far from the skin, after the map.
fn girth(map: &BodyMap, body: &Body, height: f64, away: f64) -> f64 {
    let section = section_at(body, height).expect("section");
    let centre = section.centre();
    let points = section.points.iter().map(|p| map.at(p + (p - centre).normalize() * away));
    let ring = hull(points.map(|p| Vec2::new(p.x, p.z)).collect());
    (0..ring.len()).map(|k| (ring[(k + 1) % ring.len()] - ring[k]).norm()).sum()
}

#[test]
fn a_body_comes_to_itself() {
    let own = body("38");
    let map = BodyMap::new(&own, &own, &BTreeMap::new()).expect("map");
    for p in
        [Vec3::new(0.1, 1.1, 0.15), Vec3::new(-0.2, 0.3, 0.1), Vec3::new(0.5, 1.0, 0.02), Vec3::new(0.1, 1.42, 0.0)]
    {
        assert!((map.at(p) - p).norm() < 1e-9, "{p:?} {:?}", map.at(p));
    }
}

#[test]
fn the_skin_of_one_body_comes_to_that_of_another() {
    let (from, to) = (body("38"), body("42"));
    let map = BodyMap::new(&from, &to, &BTreeMap::new()).expect("map");
    for name in ["waist", "hip", "bust"] {
        let [a, b] = [&from, &to].map(|body| level_height(name, body).expect("height"));
        let (got, wanted) = (girth(&map, &from, a, 0.0), girth_at(&to, b));
        assert!((got - wanted).abs() < 0.004, "{name}: {got} instead of {wanted}");
    }
}

#[test]
fn girth_is_added_where_it_is_asked_for() {
    let own = body("38");
    let add = [("waist".to_owned(), 0.03), ("hip".to_owned(), 0.0)].into();
    let map = BodyMap::new(&own, &own, &add).expect("map");
    let still = BodyMap::new(&own, &own, &BTreeMap::new()).expect("map");
    for (name, wanted) in [("waist", 0.03), ("hip", 0.0), ("bust", 0.03)] {
        let height = level_height(name, &own).expect("height");
        let grown = girth(&map, &own, height, 0.01) - girth(&still, &own, height, 0.01);
        assert!((grown - wanted).abs() < 0.004, "{name}: {grown}");
    }
}

#[test]
fn a_sleeve_goes_with_its_arm() {
    let (from, to) = (body("38"), body("46"));
    let map = BodyMap::new(&from, &to, &BTreeMap::new()).expect("map");
    for side in ["left", "right"] {
        let arm = |body: &Body| body.segments[&format!("arm-{side}")].clone();
        let (a, b) = (arm(&from), arm(&to));
        let wrist = map.at(a.from.lerp(&a.to, 0.9));
        assert!((wrist - b.from.lerp(&b.to, 0.9)).norm() < 0.01, "{wrist:?}");
    }
}
