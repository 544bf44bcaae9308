//! Limbs and torso as straight axes, for placing pieces around them.

use super::figure::Figure;
use super::measures::BodyMeasures;
use super::section::section_near;
use std::collections::BTreeMap;
use toile_garment::Vec3;
use toile_garment::body::BodySegment;

/// The segments by name; `from` is the upper end.
pub fn segments(
    figure: &Figure,
    m: &BodyMeasures,
    positions: &[Vec3],
    triangles: &[[u32; 3]],
) -> BTreeMap<String, BodySegment> {
    let (arm, along) = figure.arm_axis();
    let (neck, up) = figure.neck_axis();
    let leg_top = figure.leg_centre(m.crotch_height + 0.05);
    let ends = [
        ("torso", Vec3::new(0.0, m.shoulder_height, -0.01), Vec3::new(0.0, m.crotch_height, -0.01)),
        ("neck", neck + up * 0.09, neck),
        ("arm-left", arm, arm + along * figure.wrist_at),
        ("leg-left", leg_top, figure.leg_centre(0.05 * m.stature)),
    ];
    let mut found = BTreeMap::new();
    for (name, from, to) in ends {
        let (half_width, half_depth) = largest(name, from, to, positions, triangles);
        let segment = BodySegment { from: steps(from), to: steps(to), half_width, half_depth };
        if let Some(limb) = name.strip_suffix("-left") {
            let flip = |p: Vec3| Vec3::new(-p.x, p.y, p.z);
            let right = BodySegment { from: flip(segment.from), to: flip(segment.to), ..segment.clone() };
            found.insert(format!("{limb}-right"), right);
        }
        found.insert(name.to_owned(), segment);
    }
    found
}

fn steps(p: Vec3) -> Vec3 {
    p.map(super::to_micrometres)
}

/// Largest half width and half depth of the sections across an axis, where only this limb is cut.
fn largest(name: &str, from: Vec3, to: Vec3, positions: &[Vec3], triangles: &[[u32; 3]]) -> (f64, f64) {
    let along = (to - from).normalize();
    let across = (Vec3::x() - along * along.x).normalize();
    let deep = along.cross(&across);
    // Near the joints a section runs into the trunk (the torso's: into the arms).
    let (first, last) = match name {
        "torso" => (9, 38),
        "neck" => (8, 36),
        _ => (10, 40),
    };
    let mut most = (0.0_f64, 0.0_f64);
    for i in first..=last {
        let at = from + (to - from) * (f64::from(i) / 40.0);
        if let Some(section) = section_near(positions, triangles, at, along) {
            let span = |axis: Vec3| {
                let reach = section.points.iter().map(|p| axis.dot(p));
                0.5 * (reach.clone().fold(f64::NEG_INFINITY, f64::max) - reach.fold(f64::INFINITY, f64::min))
            };
            most = (most.0.max(span(across)), most.1.max(span(deep)));
        }
    }
    (super::to_micrometres(most.0), super::to_micrometres(most.1))
}
