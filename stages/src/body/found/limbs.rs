//! Arms and legs of a body.

use super::marks::{Marks, largest};
use super::slices::Slices;
use crate::body::section::{Section, section_near, sections};
use toile_garment::Vec3;
use toile_garment::body::{Body, BodySegment};

/// Part of an arm, hand included, that ends at the wrist.
const WRIST: f64 = 0.75;
/// Share of the arm, from the shoulder to the wrist, at which its upper girth is taken, and the elbow.
pub const UPPER_ARM_AT: f64 = 0.29;
pub const ELBOW_AT: f64 = 0.54;
/// Angle to the vertical under which an arm is cut across at heights, degrees.
const HANGING: f64 = 25.0;

/// The arm of a side, from upright cuts across it.
pub fn arm(body: &Body, slices: &Slices<'_>, half: f64, sign: f64) -> Option<BodySegment> {
    let (middle, height) = (slices.middle, slices.height);
    let reach = body.positions.iter().map(|p| sign * (p.x - middle)).fold(0.0, f64::max);
    let from = half + 0.03_f64.min(0.018 * height);
    let steps = 24;
    let mut points: Vec<Vec3> = Vec::new();
    let mut radii: Vec<f64> = Vec::new();
    for k in 0..steps {
        let x = middle + sign * (from + (reach - from) * (f64::from(k) + 0.5) / f64::from(steps));
        let loops = sections(&body.positions, &body.triangles, Vec3::new(x, 0.0, 0.0), Vec3::x());
        let highest = loops.into_iter().max_by(|a, b| a.centre().y.total_cmp(&b.centre().y))?;
        let (low, high) = highest.bounds();
        points.push(highest.centre());
        radii.push(0.5 * (high.z - low.z).min(high.y - low.y));
    }
    // An arm that hangs straight down is not seen so.
    if reach - from < 0.15_f64.min(0.09 * height) {
        return None;
    }
    let upper = (0.15 * f64::from(steps)) as usize;
    let lower = (WRIST * f64::from(steps)) as usize;
    let (a, b) = (points[upper], points[lower]);
    let along = (b - a).try_normalize(1e-6)?;
    let start = a - along * ((a.x - middle).abs() - 0.9 * half).max(0.0) / along.x.abs().max(0.2);
    radii.truncate(lower);
    radii.sort_by(f64::total_cmp);
    let radius = *radii.get(radii.len() * 3 / 4)?;
    Some(BodySegment { from: start, to: b, half_width: radius, half_depth: radius })
}

/// An arm that hangs beside the trunk, from level cuts.
pub fn hanging_arm(slices: &Slices<'_>, marks: &Marks, sign: f64) -> Option<BodySegment> {
    let step = 0.01 * slices.height;
    let beside = |y: f64| {
        let trunk =
            slices.trunk(y).map_or(0.0, |s| s.bounds().1.x.max(2.0 * slices.middle - s.bounds().0.x) - slices.middle);
        let out =
            slices.cut(y).into_iter().filter(|s| sign * (s.centre().x - slices.middle) > trunk.max(0.95 * marks.half));
        out.max_by(|a, b| a.girth().total_cmp(&b.girth()))
    };
    let levels = (1..45).map(|k| marks.armpit - f64::from(k) * step);
    let loops: Vec<Section> = levels.map_while(beside).collect();
    // From the armpit to the finger tips an arm is 0.35 of the stature long.
    if (loops.len() as f64) * step < 0.2 * slices.height {
        return None;
    }
    let at = |share: f64| loops[((loops.len() - 1) as f64 * share) as usize].centre();
    let (a, b) = (at(0.1), at(0.7));
    let along = (b - a).try_normalize(1e-6)?;
    let mut radii: Vec<f64> =
        loops.iter().take(7 * loops.len() / 10).map(|s| s.girth() / std::f64::consts::TAU).collect();
    radii.sort_by(f64::total_cmp);
    let radius = *radii.get(radii.len() * 3 / 4)?;
    Some(BodySegment { from: a - along * (0.06 * slices.height), to: b, half_width: radius, half_depth: radius })
}

/// Angle of a limb to the vertical, degrees.
pub fn angle(limb: &BodySegment) -> f64 {
    let along = limb.to - limb.from;
    libm::atan2(libm::sqrt(along.x * along.x + along.z * along.z), -along.y).to_degrees()
}

/// Is the segment of an arm from upright cuts one that hangs?
pub fn hangs(limb: &BodySegment) -> bool {
    angle(limb) < HANGING
}

/// The leg of a side, between the crotch and the ankle.
pub fn leg(slices: &Slices<'_>, marks: &Marks, sign: f64) -> Option<BodySegment> {
    let (under, over) = (0.06_f64.min(0.036 * slices.height), 0.1_f64.min(0.06 * slices.height));
    let (thigh, ankle) = (slices.beside(marks.crotch - under, sign)?, slices.beside(slices.low + over, sign)?);
    let (low, high) = thigh.bounds();
    Some(BodySegment {
        from: thigh.centre(),
        to: ankle.centre(),
        half_width: 0.5 * (high.x - low.x),
        half_depth: 0.5 * (high.z - low.z),
    })
}

/// An arm in detail: the middle line from the shoulder to the finger tips.
pub struct ArmLine {
    triangles: Vec<[u32; 3]>,
    along: Vec3,
    from: Vec3,
    /// Distance from the shoulder to the wrist along the arm, metres.
    pub wrist: f64,
}

impl ArmLine {
    /// The arm that a segment lies in, from its shoulder point on.
    pub fn of(body: &Body, segment: &BodySegment, shoulder: Vec3) -> Option<Self> {
        let along = (segment.to - segment.from).try_normalize(1e-6)?;
        let onto = |p: Vec3| segment.from + along * (p - segment.from).dot(&along);
        // The segment ends at the wrist; a leg may stand behind the finger tips.
        let most = 1.5 * (segment.to - segment.from).norm();
        // An elbow may be bent a little.
        let wide = 2.1 * segment.half_width.max(segment.half_depth);
        let near = |v: &u32| {
            let p = body.positions[*v as usize];
            let way = (p - segment.from).dot(&along);
            (p - onto(p)).norm() < wide && (0.0..most).contains(&way)
        };
        let triangles: Vec<[u32; 3]> = body.triangles.iter().filter(|t| t.iter().all(near)).copied().collect();
        let ends = triangles.iter().flatten().map(|v| (body.positions[*v as usize] - segment.from).dot(&along));
        let tip = ends.fold(f64::NEG_INFINITY, f64::max);
        let from = onto(shoulder);
        let reach = tip - (from - segment.from).dot(&along);
        let mut out = Self { triangles, along, from, wrist: 0.0 };
        // A hand is a quarter of the arm; a mesh without hands ends at the wrist.
        let slim = largest(0.62 * reach, 0.86 * reach, 24, |t| out.cut(body, t).map(|s| -s.girth()));
        out.wrist = slim.map(|s| s.0).filter(|t| *t > 0.0)?;
        Some(out)
    }

    /// The outline across the arm at a distance from the shoulder.
    pub fn cut(&self, body: &Body, t: f64) -> Option<Section> {
        let at = self.from + self.along * t;
        section_near(&body.positions, &self.triangles, at, self.along)
    }

    /// Directions out of the arm, away from the body and upwards.
    pub fn outwards(&self) -> Vec3 {
        let out = Vec3::new(-self.along.y, self.along.x, 0.0).normalize();
        if out.y < 0.0 { -out } else { out }
    }
}
