//! Heights that tell the parts of a body apart.

use super::slices::Slices;
use crate::body::section::Section;
use toile_garment::Vec3;
use toile_garment::body::BodySegment;

/// Steps over the height of the body in which it is cut.
const LEVELS: usize = 100;
/// Growth of the width of the trunk from one level to the next at which the arms join it.
const ARMS_JOIN: f64 = 1.2;
/// Halvings of an interval: to a few micrometres.
const HALVINGS: usize = 14;

/// The trunk at a level.
struct Level {
    y: f64,
    trunk: Option<Section>,
}

/// The heights, metres.
pub struct Marks {
    levels: Vec<Level>,
    /// Lowest level of the trunk.
    pub crotch: f64,
    /// Narrowest level between crotch and armpits.
    pub waist: f64,
    /// Highest level under the arms.
    pub armpit: f64,
    /// Narrowest level over the shoulders.
    pub neck: f64,
    /// Half of the width of the trunk under the arms.
    pub half: f64,
    /// Did arms join the trunk?
    pub has_arms: bool,
}

impl Marks {
    /// The heights, with the crotch where it is known; `None` where no legs meet, or nothing is narrow.
    pub fn of(slices: &Slices<'_>, crotch: Option<f64>) -> Option<Self> {
        let (low, height) = (slices.low, slices.height);
        let y = |k: usize| low + height * k as f64 / LEVELS as f64;
        let levels: Vec<Level> = (2..LEVELS - 2).map(|k| Level { y: y(k), trunk: slices.trunk(y(k)) }).collect();
        let share = |l: &Level| (l.y - low) / height;
        let girth = |l: &&Level| l.trunk.as_ref().map_or(f64::INFINITY, Section::girth);
        let trunk: Vec<&Level> = levels.iter().filter(|l| share(l) > 0.35 && l.trunk.is_some()).collect();
        let crotch = crotch.or_else(|| trunk.first().filter(|l| share(l) < 0.6).map(|l| l.y))?;
        let upper: Vec<&Level> = trunk.iter().copied().filter(|l| share(l) > 0.62).collect();
        let joined = upper.windows(2).find(|w| width(w[1]) > ARMS_JOIN * width(w[0]) && share(w[1]) < 0.88);
        let (armpit, half) = joined.map_or((low + 0.75 * height, 0.1 * height), |w| (w[0].y, 0.5 * width(w[0])));
        let least = |from: f64, to: f64| {
            let within = trunk.iter().copied().filter(|l| l.y > from && l.y < to);
            within.min_by(|a, b| girth(a).total_cmp(&girth(b))).map(|l| l.y)
        };
        let waist = least(crotch + 0.08 * height, armpit - 0.04 * height)?;
        let neck = least(armpit + 0.04 * height, low + 0.92 * height)?;
        let has_arms = joined.is_some();
        Some(Self { levels, crotch, waist, armpit, neck, half, has_arms })
    }

    /// From the base of the neck to the crotch, as wide and deep as the trunk is at most.
    pub fn torso(&self) -> BodySegment {
        let within = self.levels.iter().filter(|l| l.y >= self.crotch && l.y <= self.armpit);
        let trunk: Vec<&Section> = within.filter_map(|l| l.trunk.as_ref()).collect();
        let size = trunk
            .iter()
            .map(|s| s.bounds())
            .fold((0.0_f64, f64::INFINITY, f64::NEG_INFINITY), |(w, back, front), (low, high)| {
                (w.max(0.5 * (high.x - low.x)), back.min(low.z), front.max(high.z))
            });
        let z = 0.5 * (size.1 + size.2);
        let x = trunk.iter().map(|s| s.centre().x).sum::<f64>() / trunk.len().max(1) as f64;
        let top = self.neck - 0.4 * (self.neck - self.armpit).min(0.15);
        BodySegment {
            from: Vec3::new(x, top, z),
            to: Vec3::new(x, self.crotch, z),
            half_width: size.0,
            half_depth: 0.5 * (size.2 - size.1),
        }
    }

    /// A short piece of the neck at its narrowest.
    pub fn neck(&self, height: f64) -> BodySegment {
        let near = self
            .levels
            .iter()
            .filter(|l| l.trunk.is_some())
            .min_by(|a, b| (a.y - self.neck).abs().total_cmp(&(b.y - self.neck).abs()));
        let (low, high) = near.and_then(|l| l.trunk.as_ref()).map_or((Vec3::zeros(), Vec3::zeros()), Section::bounds);
        let at = |y: f64| Vec3::new(0.5 * (low.x + high.x), y, 0.5 * (low.z + high.z));
        BodySegment {
            from: at(self.neck + 0.04_f64.min(0.024 * height)),
            to: at(self.neck - 0.05_f64.min(0.03 * height)),
            half_width: 0.5 * (high.x - low.x),
            half_depth: 0.5 * (high.z - low.z),
        }
    }

    /// The height of the crotch between its level and the one below.
    pub fn exact_crotch(&self, slices: &Slices<'_>) -> f64 {
        halve(self.crotch, self.crotch - slices.height / LEVELS as f64, |y| slices.trunk(y).is_some())
    }

    /// The height of the armpits between their level and the one above.
    pub fn exact_armpit(&self, slices: &Slices<'_>) -> f64 {
        let is_free = |y: f64| {
            let width = slices.trunk(y).map_or(0.0, |s| s.bounds().1.x - s.bounds().0.x);
            width > 0.0 && width < 2.0 * ARMS_JOIN * self.half
        };
        halve(self.armpit, self.armpit + slices.height / LEVELS as f64, is_free)
    }
}

fn width(level: &Level) -> f64 {
    level.trunk.as_ref().map_or(0.0, |s| s.bounds().1.x - s.bounds().0.x)
}

/// The last place from `yes` towards `no` at which something holds.
pub fn halve(mut yes: f64, mut no: f64, holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (yes + no);
        if holds(middle) {
            yes = middle;
        } else {
            no = middle;
        }
    }
    yes
}

/// The place within an interval at which a value is largest, looked at in steps; the value there.
pub fn largest(from: f64, to: f64, steps: usize, value: impl Fn(f64) -> Option<f64>) -> Option<(f64, f64)> {
    let at = |k: usize| from + (to - from) * k as f64 / steps as f64;
    let seen = (0..=steps).filter_map(|k| value(at(k)).map(|v| (at(k), v)));
    seen.fold(None, |best: Option<(f64, f64)>, (y, v)| if best.is_none_or(|b| v > b.1) { Some((y, v)) } else { best })
}
