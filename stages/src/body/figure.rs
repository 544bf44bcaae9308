//! The figure: which solids make the body, placed and sized by its measures.

use super::curve::Curve;
use super::field::{Egg, Sample, Sweep, pair};
use super::measures::BodyMeasures;
use toile_garment::Vec3;

/// Angle of the arms away from the vertical (A-pose) up to a usual bust girth, degrees.
const ARM_ANGLE: f64 = 40.0;
/// Slope of the shoulders, degrees.
const SHOULDER_SLOPE: f64 = 21.0;
/// Where the arm's girth is taken: share of the way from acromion to wrist.
const UPPER_ARM_AT: f64 = 0.29;
/// Girth of the usual hand, metres, and the least girth of a hand over that of its wrist.
const HAND_GIRTH: f64 = 0.177;
const HAND_OVER_WRIST: f64 = 1.07;
/// Half the gap between the thighs at their widest, metres.
const THIGH_GAP: f64 = 0.013;

/// The unknowns of the fit, by which the mesh meets the measures: factors of girths, offsets of heights (metres).
#[derive(Clone, Debug, PartialEq)]
pub struct Tune {
    /// Factors: hip, waist, under bust, bust, neck, upper arm, wrist, thigh.
    pub girths: [f64; 8],
    /// Offsets, metres: stature, crotch, shoulder, bust, floor.
    pub rises: [f64; 5],
}

impl Default for Tune {
    fn default() -> Self {
        Self { girths: [1.0; 8], rises: [0.0; 5] }
    }
}

/// The body as a field.
#[derive(Clone, Debug)]
pub struct Figure {
    torso: Sweep,
    yoke: Sweep,
    neck: Sweep,
    head: Egg,
    bust: Egg,
    arm: Sweep,
    leg: Sweep,
    foot: Sweep,
    /// Acromion of the left side.
    pub acromion: Vec3,
    /// Position of the upper arm girth along the arm's axis.
    pub upper_arm_at: f64,
    /// Position of the wrist along the arm's axis.
    pub wrist_at: f64,
}

impl Figure {
    /// Places and sizes the solids.
    pub fn new(m: &BodyMeasures, tune: &Tune) -> Self {
        let [hip, waist, under, bust, neck, upper_arm, wrist, thigh] = tune.girths;
        let [stature, crotch, shoulder, bust_rise, floor] = tune.rises;
        let acromion = Vec3::new(0.5 * m.shoulder_width, m.shoulder_height + shoulder, -0.014);
        let arms = ArmPlan::new(m, acromion, upper_arm, wrist);
        Self {
            torso: torso(m, [hip, waist, under, bust], crotch),
            yoke: yoke(m, acromion),
            neck: neck_sweep(m, neck),
            head: head(m, stature),
            bust: bust_egg(m, bust, bust_rise),
            upper_arm_at: arms.girth_at,
            wrist_at: arms.wrist_at,
            arm: arms.sweep,
            leg: leg(m, thigh),
            foot: foot(m, floor),
            acromion,
        }
    }

    /// Signed distance (about) and its gradient at a point with x ≥ 0; the body is its own mirror image.
    pub fn at(&self, p: Vec3) -> Sample {
        let yokes = pair(p, 0.05, |p| self.yoke.at(p));
        let legs = pair(p, 0.02, |p| self.leg.at(p)).join(self.foot.at(p), 0.03);
        let trunk = self.torso.at(p).join(yokes, 0.075);
        let busts = pair(p, 0.07, |p| self.bust.at(p));
        trunk
            .join(self.neck.at(p), 0.035)
            .join(self.head.at(p), 0.04)
            .join(self.arm.at(p), 0.07)
            .join(busts, 0.06)
            .join(legs, 0.06)
    }

    /// Axis of the left arm: origin and direction.
    pub fn arm_axis(&self) -> (Vec3, Vec3) {
        (self.arm.origin, self.arm.axes[2])
    }

    /// Axis of the neck: origin at the base and direction.
    pub fn neck_axis(&self) -> (Vec3, Vec3) {
        (self.neck.origin, self.neck.axes[2])
    }

    /// Centre of the left leg at a height (x and z), metres.
    pub fn leg_centre(&self, height: f64) -> Vec3 {
        let row = self.leg.keys.at(height).0;
        Vec3::new(row[2], height, row[3])
    }
}

/// A row of a section table: half width, half depth, centre u, centre v.
type Row = (f64, [f64; 4]);

fn upright(keys: &[Row], power: f64, caps: [f64; 2]) -> Sweep {
    let axes = [Vec3::x(), Vec3::z(), Vec3::y()];
    Sweep { origin: Vec3::zeros(), axes, keys: Curve::new(keys), power, caps }
}

/// A torso section from its half width, front and back (z), and factors of width and depth; metres.
fn section(y: f64, half_width: f64, front: f64, back: f64, wide: f64, deep: f64) -> Row {
    (y, [half_width * wide, 0.5 * (front - back) * deep, 0.0, 0.5 * (front + back) * deep])
}

/// A scale of a girth as scales of width and depth: larger bodies grow deeper more than wider.
fn spread(scale: f64) -> (f64, f64) {
    (libm::pow(scale, 0.8), libm::pow(scale, 1.2))
}

fn torso(m: &BodyMeasures, [hip, waist, under, bust]: [f64; 4], crotch: f64) -> Sweep {
    let (h, w) = (hip * m.girths.hip / 0.960, waist * m.girths.waist / 0.700);
    let (u, b) = (under * m.under_bust() / 0.7612, bust * m.girths.bust / 0.880);
    let ((hw, hd), (ww, wd), (uw, ud)) = (spread(h), spread(w), spread(u));
    let (mw, md) = spread(0.5 * (h + w));
    let flat = m.flatness();
    let own = 0.4 + 0.6 * flat;
    let (bw, bd) = spread((1.0 - own) * u + own * b);
    let wide = m.shoulder_width / 0.380;
    let chest = 0.5 * (wide + uw.min(bw));
    let top = m.shoulder_height;
    let upper = top - m.bust_height;
    let hip_to_waist = m.waist_height - m.hip_height;
    let bottom = m.crotch_height + crotch;
    let keys = [
        section(bottom + 0.026, 0.154, 0.083, -0.119, hw, hd),
        section(m.hip_height + 0.004, 0.171, 0.094, -0.130, hw, hd),
        section(m.hip_height + 0.5 * hip_to_waist, 0.156, 0.104, -0.108, mw, md),
        section(m.waist_height, 0.122, 0.092, -0.088, ww, wd),
        section(m.bust_height - 0.075, 0.134, 0.098, -0.102, uw, ud),
        section(m.bust_height, 0.143, 0.090 + 0.012 * flat, -0.110 + 0.006 * flat, bw, bd),
        section(m.bust_height + 0.5 * upper, 0.150, 0.084 + 0.006 * flat, -0.112, chest, ud),
        section(m.bust_height + 0.78 * upper, 0.138, 0.060, -0.096, wide, 0.5 * (1.0 + ud)),
        section(top, 0.104, 0.030, -0.076, wide, 0.5 * (1.0 + ud)),
    ];
    upright(&keys, 2.25, [0.026, 0.045])
}

/// The shoulder: from the neck to the acromion at the shoulders' slope.
fn yoke(m: &BodyMeasures, acromion: Vec3) -> Sweep {
    let (sin, cos) = libm::sincos(SHOULDER_SLOPE.to_radians());
    let along = Vec3::new(cos, -sin, 0.0);
    let up = Vec3::new(sin, cos, 0.0);
    let length = acromion.x / cos;
    let thick = 0.036;
    let origin = acromion - along * length - up * thick;
    let deep = 0.5 + 0.5 * m.under_bust() / 0.7612;
    let keys = [
        (0.03, [thick, 0.050 * deep, 0.0, -0.010]),
        (0.5 * length, [thick, 0.046 * deep, 0.0, -0.006]),
        (length - 0.055, [thick * 0.97, 0.041 * deep, 0.0, 0.0]),
    ];
    Sweep { origin, axes: [up, Vec3::z(), along], keys: Curve::new(&keys), power: 2.0, caps: [0.03, 0.050] }
}

fn neck_sweep(m: &BodyMeasures, factor: f64) -> Sweep {
    let base = Vec3::new(0.0, m.neck_height - 0.035, -0.020);
    let tilt = 16.0_f64.to_radians();
    let along = Vec3::new(0.0, libm::cos(tilt), libm::sin(tilt));
    let forward = Vec3::new(0.0, -libm::sin(tilt), libm::cos(tilt));
    let r = factor * m.girths.neck / (2.0 * std::f64::consts::PI);
    let row = |s: f64| [s * r * 0.97, s * r * 1.03, 0.0, 0.0];
    let rise = m.stature - m.neck_height - 0.10;
    let keys = [(-0.02, row(1.12)), (0.055, row(1.0)), (rise, row(0.97))];
    Sweep { origin: base, axes: [Vec3::x(), forward, along], keys: Curve::new(&keys), power: 2.0, caps: [0.05, 0.04] }
}

fn head(m: &BodyMeasures, rise: f64) -> Egg {
    let tall = m.stature - m.neck_height;
    let r = tall / 0.240;
    let (down, up) = (0.105 * r, 0.085 * r);
    // The heads of children are larger, not only taller.
    let wide = 1.0 + 0.8 * (r - 1.05).max(0.0);
    Egg {
        centre: Vec3::new(0.0, m.stature + rise - up, 0.018),
        minus: Vec3::new(0.072 * wide, down, 0.092 * wide),
        plus: Vec3::new(0.072 * wide, up, 0.088 * wide),
    }
}

fn bust_egg(m: &BodyMeasures, factor: f64, rise: f64) -> Egg {
    let size = factor * m.girths.bust / 0.880;
    let ribs = m.under_bust() / 0.7612;
    let cup = ((m.girths.bust - m.under_bust()) / (0.135 * m.girths.bust)).clamp(0.2, 2.0);
    let r = libm::sqrt(size) * (0.7 + 0.3 * cup) * (1.0 - 0.9 * m.flatness());
    Egg {
        centre: Vec3::new(0.086 * ribs.min(1.15), m.bust_height + rise, 0.056 * ribs + 0.012 * (size - 1.0)),
        minus: Vec3::new(0.062, 0.060, 0.060) * r,
        plus: Vec3::new(0.058, 0.092, 0.058 + 0.35 * (factor - 1.0)) * r,
    }
}

/// Larger bodies hold their arms wider, so that the armpits stay above the bust.
fn arm_angle(m: &BodyMeasures) -> f64 {
    ARM_ANGLE + (35.0 * (m.girths.bust / 0.95 - 1.0)).clamp(0.0, 15.0)
}

/// The arm with the positions where it is measured.
struct ArmPlan {
    sweep: Sweep,
    girth_at: f64,
    wrist_at: f64,
}

impl ArmPlan {
    fn new(m: &BodyMeasures, acromion: Vec3, upper: f64, wrist: f64) -> Self {
        let (sin, cos) = libm::sincos(arm_angle(m).to_radians());
        let along = Vec3::new(sin, -cos, 0.0);
        let out = Vec3::new(cos, sin, 0.0);
        let ru = upper * m.girths.upper_arm / (2.0 * std::f64::consts::PI);
        let rw = wrist * m.girths.wrist / (2.0 * std::f64::consts::PI);
        let joint = 0.050;
        let reach = libm::sqrt(m.arm_length * m.arm_length - (joint - rw) * (joint - rw));
        let elbow = 0.54 * reach;
        let girth_at = UPPER_ARM_AT * reach;
        let hand = m.stature / 1.68;
        // A hand is larger around than its wrist.
        let palm = (HAND_OVER_WRIST * m.girths.wrist / HAND_GIRTH).max(1.0);
        let keys = [
            (0.020, [0.047, 0.052, 0.0, 0.0]),
            (0.070, [0.5 * (ru + 0.047), 0.4 * ru + 0.033, 0.0, 0.0]),
            (girth_at, [ru * 0.99, ru * 1.01, 0.0, 0.0]),
            (elbow, [0.45 * ru + 0.58 * rw, 0.45 * ru + 0.62 * rw, 0.0, 0.0]),
            (elbow + 0.07, [0.43 * ru + 0.62 * rw, 0.43 * ru + 0.70 * rw, 0.0, 0.0]),
            (reach, [rw * 0.88, rw * 1.12, 0.0, 0.0]),
            (reach + 0.05 * hand, [0.019 * palm, 0.036 * palm, 0.0, 0.0]),
            (reach + 0.10 * hand, [0.019 * palm, 0.039 * palm, 0.0, 0.0]),
            (reach + 0.140 * hand, [0.018 * palm, 0.030 * palm, 0.0, 0.0]),
        ];
        let origin = acromion - out * joint;
        let axes = [out, Vec3::z(), along];
        let sweep = Sweep { origin, axes, keys: Curve::new(&keys), power: 2.0, caps: [0.065, 0.03] };
        Self { sweep, girth_at, wrist_at: reach }
    }
}

fn leg(m: &BodyMeasures, factor: f64) -> Sweep {
    let s = factor * m.girths.thigh / 0.550;
    let slim = libm::sqrt(s);
    let c = m.crotch_height;
    let top = 0.080 * s;
    let row = |a: f64, b: f64, cx: f64, cz: f64| [a, b, cx, cz];
    let keys = [
        (0.055, row(0.032, 0.037, 0.086, -0.026)),
        (0.110 * c / 0.77, row(0.033 * slim, 0.038 * slim, 0.086, -0.026)),
        (0.43 * c, row(0.048 * slim, 0.054 * slim, 0.086, -0.022)),
        (0.61 * c, row(0.052 * slim, 0.056 * slim, 0.086 + 0.3 * (top - 0.08), -0.004)),
        (0.80 * c, row(0.068 * s, 0.076 * s, 0.090 + 0.6 * (top - 0.08), -0.004)),
        (c - 0.035, row(top, 0.094 * s, top + THIGH_GAP, -0.012)),
        (c + 0.060, row(0.076 * s, 0.094 * s, top + 0.009, -0.018)),
    ];
    upright(&keys, 2.0, [0.04, 0.09])
}

fn foot(m: &BodyMeasures, floor: f64) -> Sweep {
    let s = m.stature / 1.68;
    let row = |a: f64, high: f64| [a, 0.5 * high, 0.086, 0.5 * high + floor];
    let keys = [
        (-0.055 * s, row(0.030, 0.060)),
        (0.000, row(0.033, 0.076)),
        (0.060 * s, row(0.041, 0.056)),
        (0.110 * s, row(0.045, 0.042)),
        (0.145 * s, row(0.040, 0.032)),
    ];
    let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
    Sweep { origin: Vec3::zeros(), axes, keys: Curve::new(&keys), power: 2.2, caps: [0.025, 0.025] }
}
