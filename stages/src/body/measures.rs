//! The measures of a body and what is possible among them.

use super::codes;
use toile_garment::Diagnostic;

/// Body measures by their ISO 8559-1 names, metres. Girths as a tape gives them, heights over the floor.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyMeasures {
    /// Name of the body, e.g. `size-38`.
    pub name: String,
    /// Floor to crown.
    pub stature: f64,
    /// Height of the back neck point.
    pub neck_height: f64,
    /// Height of the shoulder (acromion) point.
    pub shoulder_height: f64,
    /// Height of the bust points.
    pub bust_height: f64,
    /// Height of the waist.
    pub waist_height: f64,
    /// Height of the hips' largest girth.
    pub hip_height: f64,
    /// Height of the crotch.
    pub crotch_height: f64,
    /// Acromion to acromion, straight.
    pub shoulder_width: f64,
    /// Acromion to wrist, straight arm.
    pub arm_length: f64,
    /// Girths.
    pub girths: BodyGirths,
}

/// Girths of a body as a tape gives them, metres.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyGirths {
    /// Bust girth.
    pub bust: f64,
    /// Girth of the rib cage under the bust; a usual cup when `None`.
    pub under_bust: Option<f64>,
    /// Waist girth.
    pub waist: f64,
    /// Hip girth.
    pub hip: f64,
    /// Neck girth, across the neck's axis.
    pub neck: f64,
    /// Upper arm girth, half way between shoulder and elbow.
    pub upper_arm: f64,
    /// Wrist girth.
    pub wrist: f64,
    /// Thigh girth, just under the crotch.
    pub thigh: f64,
}

/// Girths under the bust, as shares of the bust girth, from which a chest begins to be flat, and from which it is flat.
const FLAT: [f64; 2] = [0.90, 0.94];
/// Persons of a smaller stature are drawn by shrinking a figure of [`FIGURE`], metres.
const SMALL: f64 = 1.5;
/// Stature of the figure, metres.
const FIGURE: f64 = 1.68;

impl Default for BodyMeasures {
    /// Size 38.
    fn default() -> Self {
        Self {
            name: "size-38".to_owned(),
            stature: 1.680,
            neck_height: 1.440,
            shoulder_height: 1.385,
            bust_height: 1.220,
            waist_height: 1.050,
            hip_height: 0.840,
            crotch_height: 0.770,
            shoulder_width: 0.380,
            arm_length: 0.580,
            girths: BodyGirths {
                bust: 0.880,
                under_bust: None,
                waist: 0.700,
                hip: 0.960,
                neck: 0.360,
                upper_arm: 0.280,
                wrist: 0.160,
                thigh: 0.550,
            },
        }
    }
}

impl BodyMeasures {
    /// The person's share of the figure, which is drawn as large as an adult: smaller ones are shrunk.
    #[must_use]
    pub(super) fn scale(&self) -> f64 {
        if self.stature < SMALL { self.stature.max(STATURE.0) / FIGURE } else { 1.0 }
    }

    /// The measures of a person who is larger by a factor.
    #[must_use]
    pub(super) fn times(&self, factor: f64) -> Self {
        let mut out = self.clone();
        for (name, value) in self.entries() {
            out.set(name, value * factor);
        }
        out
    }

    /// The same girths on a person of another stature: heights and the length of the arms are the same shares of it.
    #[must_use]
    pub fn grown(&self, stature: f64) -> Self {
        let mut out = self.clone();
        let is_length = |name: &str| name.ends_with("height") || name == "arm_length";
        for (name, value) in self.entries().into_iter().filter(|(name, _)| is_length(name)) {
            out.set(name, value * stature / self.stature);
        }
        out.stature = stature;
        out
    }

    /// The girth under the bust: as given, or that of a usual cup.
    #[must_use]
    pub fn under_bust(&self) -> f64 {
        self.girths.under_bust.unwrap_or(0.865 * self.girths.bust)
    }

    /// How flat the chest is: 0 with a bust, 1 where the rib cage is nearly as large as the chest.
    #[must_use]
    pub(super) fn flatness(&self) -> f64 {
        let share = self.under_bust() / self.girths.bust;
        ((share - FLAT[0]) / (FLAT[1] - FLAT[0])).clamp(0.0, 1.0)
    }

    /// All measures by name, in a fixed order.
    #[must_use]
    pub fn entries(&self) -> [(&'static str, f64); 17] {
        [
            ("stature", self.stature),
            ("neck_height", self.neck_height),
            ("shoulder_height", self.shoulder_height),
            ("bust_height", self.bust_height),
            ("waist_height", self.waist_height),
            ("hip_height", self.hip_height),
            ("crotch_height", self.crotch_height),
            ("shoulder_width", self.shoulder_width),
            ("arm_length", self.arm_length),
            ("bust_girth", self.girths.bust),
            ("under_bust_girth", self.under_bust()),
            ("waist_girth", self.girths.waist),
            ("hip_girth", self.girths.hip),
            ("neck_girth", self.girths.neck),
            ("upper_arm_girth", self.girths.upper_arm),
            ("wrist_girth", self.girths.wrist),
            ("thigh_girth", self.girths.thigh),
        ]
    }

    /// Sets one measure by its name, metres. False when there is no measure of that name.
    pub fn set(&mut self, name: &str, value: f64) -> bool {
        let slot = match name {
            "stature" => &mut self.stature,
            "neck_height" => &mut self.neck_height,
            "shoulder_height" => &mut self.shoulder_height,
            "bust_height" => &mut self.bust_height,
            "waist_height" => &mut self.waist_height,
            "hip_height" => &mut self.hip_height,
            "crotch_height" => &mut self.crotch_height,
            "shoulder_width" => &mut self.shoulder_width,
            "arm_length" => &mut self.arm_length,
            "bust_girth" => &mut self.girths.bust,
            "under_bust_girth" => self.girths.under_bust.insert(value),
            "waist_girth" => &mut self.girths.waist,
            "hip_girth" => &mut self.girths.hip,
            "neck_girth" => &mut self.girths.neck,
            "upper_arm_girth" => &mut self.girths.upper_arm,
            "wrist_girth" => &mut self.girths.wrist,
            "thigh_girth" => &mut self.girths.thigh,
            _ => return false,
        };
        *slot = value;
        true
    }

    /// The impossible ones among these measures: every finding, not only the first.
    #[must_use]
    pub fn check(&self) -> Vec<Diagnostic> {
        let scale = self.scale();
        let mut found: Vec<Diagnostic> = self
            .entries()
            .into_iter()
            .zip(RANGES)
            .filter_map(|((name, value), (low, high))| match name {
                "stature" => outside(name, value, STATURE),
                _ => outside(name, value, (low * scale, high * scale)),
            })
            .collect();
        if found.is_empty() {
            found.extend(self.height_gaps().into_iter().filter_map(Gap::broken));
            found.extend(self.girth_shares().into_iter().filter_map(Share::broken));
        }
        found
    }

    fn height_gaps(&self) -> [Gap; 6] {
        let scale = self.scale();
        let gap = |lower, low, least: f64, upper, high| Gap { lower, low, least: least * scale, upper, high };
        [
            gap("crotch_height", self.crotch_height, 0.03, "hip_height", self.hip_height),
            gap("hip_height", self.hip_height, 0.10, "waist_height", self.waist_height),
            gap("waist_height", self.waist_height, 0.10, "bust_height", self.bust_height),
            gap("bust_height", self.bust_height, 0.10, "shoulder_height", self.shoulder_height),
            gap("shoulder_height", self.shoulder_height, 0.01, "neck_height", self.neck_height),
            gap("neck_height", self.neck_height, 0.15, "stature", self.stature),
        ]
    }

    fn girth_shares(&self) -> [Share; 9] {
        let rel = |small, value, most, large, whole| Share { small, value, most, large, whole };
        let under = self.under_bust();
        [
            rel("waist_girth", self.girths.waist, 1.2, "hip_girth", self.girths.hip),
            rel("waist_girth", self.girths.waist, 1.2, "bust_girth", self.girths.bust),
            rel("under_bust_girth", under, 0.97, "bust_girth", self.girths.bust),
            rel("bust_girth", self.girths.bust, 1.35, "under_bust_girth", under),
            rel("thigh_girth", self.girths.thigh, 0.66, "hip_girth", self.girths.hip),
            rel("neck_girth", self.girths.neck, 0.55, "bust_girth", self.girths.bust),
            rel("upper_arm_girth", self.girths.upper_arm, 0.42, "bust_girth", self.girths.bust),
            rel("wrist_girth", self.girths.wrist, 0.85, "upper_arm_girth", self.girths.upper_arm),
            rel("shoulder_width", self.shoulder_width, 0.55, "bust_girth", self.girths.bust),
        ]
    }
}

/// Smallest and largest sane value of a measure of an adult by its name, metres.
pub(super) fn range_of(name: &str) -> Option<(f64, f64)> {
    let names = BodyMeasures::default().entries().map(|(name, _)| name);
    names.iter().position(|n| *n == name).map(|i| RANGES[i])
}

/// Smallest and largest stature, metres.
const STATURE: (f64, f64) = (0.75, 2.10);
/// Smallest and largest sane value of each measure of an adult, in the order of [`BodyMeasures::entries`], metres.
const RANGES: [(f64, f64); 17] = [
    (1.30, 2.10),
    (1.05, 1.85),
    (1.00, 1.80),
    (0.85, 1.65),
    (0.75, 1.45),
    (0.55, 1.20),
    (0.50, 1.10),
    (0.28, 0.55),
    (0.40, 0.75),
    (0.65, 1.60),
    (0.60, 1.50),
    (0.48, 1.60),
    (0.70, 1.70),
    (0.26, 0.55),
    (0.18, 0.55),
    (0.11, 0.26),
    (0.38, 0.95),
];

fn outside(name: &str, value: f64, (low, high): (f64, f64)) -> Option<Diagnostic> {
    if (low..=high).contains(&value) {
        return None;
    }
    let message = format!("{name} = {:.1} mm is no measure of a body", value * 1000.0);
    let hint = format!("give {name} between {:.0} mm and {:.0} mm", low * 1000.0, high * 1000.0);
    Some(Diagnostic::error(codes::BODY_MEASURE_OUT_OF_RANGE, message).hint(hint))
}

/// Two heights of which one lies under the other.
struct Gap {
    lower: &'static str,
    low: f64,
    least: f64,
    upper: &'static str,
    high: f64,
}

impl Gap {
    fn broken(self) -> Option<Diagnostic> {
        if self.high - self.low >= self.least {
            return None;
        }
        let (low, high, least) = (self.low * 1000.0, self.high * 1000.0, self.least * 1000.0);
        let message =
            format!("{} = {low:.1} mm is not at least {least:.0} mm under {} = {high:.1} mm", self.lower, self.upper);
        let hint = format!("make {} smaller or {} larger", self.lower, self.upper);
        Some(Diagnostic::error(codes::BODY_MEASURES_CONTRADICT, message).hint(hint))
    }
}

/// A measure that can be at most a share of another.
struct Share {
    small: &'static str,
    value: f64,
    most: f64,
    large: &'static str,
    whole: f64,
}

impl Share {
    fn broken(self) -> Option<Diagnostic> {
        let limit = self.most * self.whole;
        if self.value <= limit {
            return None;
        }
        let message = format!(
            "{} = {:.1} mm does not go with {} = {:.1} mm: at most {:.1} mm is possible",
            self.small,
            self.value * 1000.0,
            self.large,
            self.whole * 1000.0,
            limit * 1000.0
        );
        let hint = format!("make {} smaller or {} larger", self.small, self.large);
        Some(Diagnostic::error(codes::BODY_MEASURES_CONTRADICT, message).hint(hint))
    }
}
