//! Segments and waist of a body that nobody named: found on its mesh, in an A or T pose, upright and facing +z.

use super::section::{Section, sections};
use toile_garment::Vec3;
use toile_garment::body::{Body, BodySegment};

/// Steps over the height of the body in which it is cut.
const LEVELS: usize = 100;
/// Growth of the width of the trunk from one level to the next at which the arms join it.
const ARMS_JOIN: f64 = 1.2;
/// Part of an arm, hand included, that ends at the wrist.
const WRIST: f64 = 0.75;

/// The trunk at a level.
struct Level {
    y: f64,
    trunk: Option<Section>,
}

/// The body with the segments and the waist that it does not name. What it names stays; what cannot be found is left
/// out.
#[must_use]
pub fn with_segments(body: &Body) -> Body {
    let mut whole = body.clone();
    let (low, high) = bounds(&body.positions);
    let height = high.y - low.y;
    if height <= 0.0 {
        return whole;
    }
    let middle = Vec3::new(0.5 * (low.x + high.x), 0.0, 0.0).x;
    let levels: Vec<Level> =
        (2..LEVELS - 2).map(|k| level(body, middle, low.y + height * k as f64 / LEVELS as f64)).collect();
    let Some(marks) = Marks::of(&levels, low.y, height) else { return whole };
    let mut found: Vec<(String, BodySegment)> =
        vec![("torso".to_owned(), marks.torso(&levels)), ("neck".to_owned(), marks.neck(&levels))];
    for (side, sign) in [("left", 1.0), ("right", -1.0)] {
        found.extend(arm(body, middle, &marks, sign).map(|s| (format!("arm-{side}"), s)));
        found.extend(leg(body, middle, &marks, low.y, sign).map(|s| (format!("leg-{side}"), s)));
    }
    for (name, segment) in found {
        whole.segments.entry(name).or_insert(segment);
    }
    let named = ["waist", "waist-front"].iter().any(|n| whole.landmarks.contains_key(*n))
        || whole.measures.contains_key("waist_height");
    if !named {
        whole.landmarks.insert("waist".to_owned(), Vec3::new(middle, marks.waist, 0.0));
    }
    whole
}

fn bounds(points: &[Vec3]) -> (Vec3, Vec3) {
    let far = Vec3::repeat(f64::INFINITY);
    points.iter().fold((far, -far), |(low, high), p| (low.inf(p), high.sup(p)))
}

fn cut(body: &Body, at: Vec3, normal: Vec3) -> Vec<Section> {
    sections(&body.positions, &body.triangles, at, normal)
}

/// The outline around the middle at a height.
fn level(body: &Body, middle: f64, y: f64) -> Level {
    let around = |s: &Section| {
        let (low, high) = s.bounds();
        low.x < middle - 0.01 && high.x > middle + 0.01
    };
    let own = cut(body, Vec3::new(middle, y, 0.0), Vec3::y()).into_iter().filter(around);
    Level { y, trunk: own.max_by(|a, b| a.girth().total_cmp(&b.girth())) }
}

/// Heights that tell the parts of the body apart, m.
struct Marks {
    crotch: f64,
    waist: f64,
    armpit: f64,
    neck: f64,
    /// Half of the width of the trunk under the arms, m.
    half: f64,
}

impl Marks {
    fn of(levels: &[Level], low: f64, height: f64) -> Option<Self> {
        let share = |l: &Level| (l.y - low) / height;
        let width = |l: &Level| l.trunk.as_ref().map_or(0.0, |s| s.bounds().1.x - s.bounds().0.x);
        let girth = |l: &&Level| l.trunk.as_ref().map_or(f64::INFINITY, Section::girth);
        let trunk: Vec<&Level> = levels.iter().filter(|l| share(l) > 0.35 && l.trunk.is_some()).collect();
        let crotch = trunk.first().filter(|l| share(l) < 0.6)?;
        let upper: Vec<&Level> = trunk.iter().copied().filter(|l| share(l) > 0.62).collect();
        let joined = upper.windows(2).find(|w| width(w[1]) > ARMS_JOIN * width(w[0]) && share(w[1]) < 0.88);
        let (armpit, half) = joined.map_or((low + 0.75 * height, 0.1 * height), |w| (w[0].y, 0.5 * width(w[0])));
        let least = |from: f64, to: f64| {
            let within = trunk.iter().copied().filter(|l| l.y > from && l.y < to);
            within.min_by(|a, b| girth(a).total_cmp(&girth(b))).map(|l| l.y)
        };
        let waist = least(crotch.y + 0.08 * height, armpit - 0.04 * height)?;
        let neck = least(armpit + 0.04 * height, low + 0.92 * height)?;
        Some(Self { crotch: crotch.y, waist, armpit, neck, half })
    }

    /// From the base of the neck to the crotch, as wide and deep as the trunk is at most.
    fn torso(&self, levels: &[Level]) -> BodySegment {
        let trunk =
            || levels.iter().filter(|l| l.y >= self.crotch && l.y <= self.armpit).filter_map(|l| l.trunk.as_ref());
        let size = trunk()
            .map(|s| s.bounds())
            .fold((0.0_f64, f64::INFINITY, f64::NEG_INFINITY), |(w, back, front), (low, high)| {
                (w.max(0.5 * (high.x - low.x)), back.min(low.z), front.max(high.z))
            });
        let z = 0.5 * (size.1 + size.2);
        let x = trunk().map(|s| s.centre().x).sum::<f64>() / trunk().count().max(1) as f64;
        let top = self.neck - 0.4 * (self.neck - self.armpit).min(0.15);
        BodySegment {
            from: Vec3::new(x, top, z),
            to: Vec3::new(x, self.crotch, z),
            half_width: size.0,
            half_depth: 0.5 * (size.2 - size.1),
        }
    }

    /// A short piece of the neck at its narrowest.
    fn neck(&self, levels: &[Level]) -> BodySegment {
        let near = levels
            .iter()
            .filter(|l| l.trunk.is_some())
            .min_by(|a, b| (a.y - self.neck).abs().total_cmp(&(b.y - self.neck).abs()));
        let (low, high) = near.and_then(|l| l.trunk.as_ref()).map_or((Vec3::zeros(), Vec3::zeros()), Section::bounds);
        let at = |y: f64| Vec3::new(0.5 * (low.x + high.x), y, 0.5 * (low.z + high.z));
        BodySegment {
            from: at(self.neck + 0.04),
            to: at(self.neck - 0.05),
            half_width: 0.5 * (high.x - low.x),
            half_depth: 0.5 * (high.z - low.z),
        }
    }
}

/// The arm of a side, from upright cuts across it.
fn arm(body: &Body, middle: f64, marks: &Marks, sign: f64) -> Option<BodySegment> {
    let reach = body.positions.iter().map(|p| sign * (p.x - middle)).fold(0.0, f64::max);
    let from = marks.half + 0.03;
    let steps = 24;
    let mut points: Vec<Vec3> = Vec::new();
    let mut radii: Vec<f64> = Vec::new();
    for k in 0..steps {
        let x = middle + sign * (from + (reach - from) * (f64::from(k) + 0.5) / f64::from(steps));
        let loops = cut(body, Vec3::new(x, 0.0, 0.0), Vec3::x());
        let highest = loops.into_iter().max_by(|a, b| a.centre().y.total_cmp(&b.centre().y))?;
        let (low, high) = highest.bounds();
        points.push(highest.centre());
        radii.push(0.5 * (high.z - low.z).min(high.y - low.y));
    }
    // An arm that hangs straight down is not seen so.
    if reach - from < 0.15 {
        return None;
    }
    let upper = (0.15 * f64::from(steps)) as usize;
    let lower = (WRIST * f64::from(steps)) as usize;
    let (a, b) = (points[upper], points[lower]);
    let along = (b - a).try_normalize(1e-6)?;
    let start = a - along * ((a.x - middle).abs() - 0.9 * marks.half).max(0.0) / along.x.abs().max(0.2);
    radii.truncate(lower);
    radii.sort_by(f64::total_cmp);
    let radius = *radii.get(radii.len() * 3 / 4)?;
    Some(BodySegment { from: start, to: b, half_width: radius, half_depth: radius })
}

/// The leg of a side, between the crotch and the ankle.
fn leg(body: &Body, middle: f64, marks: &Marks, floor: f64, sign: f64) -> Option<BodySegment> {
    let at = |y: f64| {
        let own = cut(body, Vec3::new(middle, y, 0.0), Vec3::y())
            .into_iter()
            .filter(|s| sign * (s.centre().x - middle) > 0.0);
        own.max_by(|a, b| a.girth().total_cmp(&b.girth()))
    };
    let (thigh, ankle) = (at(marks.crotch - 0.06)?, at(floor + 0.1)?);
    let (low, high) = thigh.bounds();
    Some(BodySegment {
        from: thigh.centre(),
        to: ankle.centre(),
        half_width: 0.5 * (high.x - low.x),
        half_depth: 0.5 * (high.z - low.z),
    })
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
    fn what_a_body_names_stays() {
        let known = parametric(&BodyMeasures::default()).expect("a body");
        assert_eq!(with_segments(&known), known);
    }
}
