//! Landmarks, girths and heights of a body, by their ISO 8559-1 names.

use super::limbs::{ArmLine, ELBOW_AT, UPPER_ARM_AT, angle};
use super::marks::{Marks, largest};
use super::moved::{LEVELS, without_moved};
use super::points::{across, top};
use super::slices::Slices;
use crate::body::section::{Section, section_near};
use crate::body::to_micrometres;
use std::collections::BTreeMap;
use toile_garment::Vec3;
use toile_garment::body::{Body, BodySegment};

/// Shares of the stature.
mod share {
    /// The rib cage is measured so far under the bust points.
    pub const UNDER_BUST: f64 = 0.0446;
    /// The thigh is measured so far under the crotch.
    pub const THIGH: f64 = 0.0208;
    /// Height of the middle of the knee.
    pub const KNEE: f64 = 0.285;
    /// Width of the shoulders.
    pub const SHOULDERS: f64 = 0.226;
    /// The chest of a body without a prominence is measured so far under the armpits.
    pub const CHEST: f64 = 0.02;
}
/// Share of the way from the crotch to the armpits at which a waist lies that is not narrow.
const WAIST: f64 = 0.58;
/// Share of the stature from the middle at which every shoulder has left the neck.
const SHOULDER: f64 = 0.085;
/// The axis of a neck leans by so much at most, degrees.
const LEAN: f64 = 20.0;
/// Angles of the arms to the vertical: from the first on the pose is A, from the second on T, degrees.
const POSES: [f64; 2] = [20.0, 70.0];
/// Width of a chest over that of the ribs under it, at most.
const CHEST: f64 = 1.15;
/// Angle between shoulder and arm under which no corner is seen between them, degrees.
const CORNER: f64 = 18.0;

/// How the arms are held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pose {
    /// Away from the body and down.
    A,
    /// Level.
    T,
    /// Beside the body.
    Down,
    /// No arms were seen.
    Armless,
}

impl Pose {
    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::A => "A pose",
            Self::T => "T pose",
            Self::Down => "arms down",
            Self::Armless => "no arms",
        }
    }
}

/// An outline around which a tape was laid.
#[derive(Clone, Debug)]
pub struct GirthLine {
    /// Name of the measure.
    pub name: &'static str,
    /// Points of the outline, metres.
    pub points: Vec<Vec3>,
    /// Its length, metres.
    pub length: f64,
}

/// A body with all that was found on its mesh.
#[derive(Clone, Debug)]
pub struct Found {
    /// The body. What it named before stays, but for what belongs to heights that were edited.
    pub body: Body,
    /// Measures of the mesh, metres, also where the body names others.
    pub mesh: BTreeMap<&'static str, f64>,
    /// Heights at which the tape lies because the body names them.
    pub led: Vec<String>,
    /// Those of them that were edited: the landmarks of the body stand at other heights.
    pub moved: Vec<String>,
    /// How it holds its arms.
    pub pose: Pose,
    /// The outlines that were measured.
    pub girths: Vec<GirthLine>,
    /// Names of the parts that were not found, and why.
    pub missing: Vec<(&'static str, &'static str)>,
    /// Names of the parts that stand at a usual share of the stature, and why.
    pub guessed: Vec<(&'static str, &'static str)>,
}

/// Finds all that a body does not name.
#[must_use]
pub fn measured(body: &Body) -> Found {
    let slices = Slices::new(body);
    let (kept, moved) = without_moved(body, slices.low);
    let mut tape = Tape::new(&kept, &slices);
    match Marks::of(&slices, named(body, slices.low, "crotch")) {
        Some(marks) => tape.all(&marks),
        None => tape.missing.push(("crotch", "no height was found at which two legs meet under a trunk")),
    }
    Found { moved, ..tape.finish() }
}

/// A height that a body names, by a measure or by a landmark.
pub(super) fn named(body: &Body, floor: f64, name: &str) -> Option<f64> {
    let height = body.measures.get(&format!("{name}_height")).map(|h| h + floor);
    let points = [name.to_owned(), format!("{name}-front"), format!("{name}-left")];
    height.or_else(|| points.iter().find_map(|n| body.landmarks.get(n)).map(|p| p.y))
}

/// The work in progress.
struct Tape<'a> {
    body: &'a Body,
    slices: &'a Slices<'a>,
    /// Triangles over the armpits.
    upper: Vec<[u32; 3]>,
    measures: BTreeMap<&'static str, f64>,
    landmarks: BTreeMap<String, Vec3>,
    segments: BTreeMap<String, BodySegment>,
    girths: Vec<GirthLine>,
    missing: Vec<(&'static str, &'static str)>,
    guessed: Vec<(&'static str, &'static str)>,
    pose: Pose,
}

const SIDES: [(&str, f64); 2] = [("left", 1.0), ("right", -1.0)];

impl<'a> Tape<'a> {
    fn new(body: &'a Body, slices: &'a Slices<'a>) -> Self {
        Self {
            body,
            slices,
            upper: Vec::new(),
            measures: BTreeMap::new(),
            landmarks: BTreeMap::new(),
            segments: BTreeMap::new(),
            girths: Vec::new(),
            missing: Vec::new(),
            guessed: Vec::new(),
            pose: Pose::Armless,
        }
    }

    fn finish(self) -> Found {
        let mut body = self.body.clone();
        let led = LEVELS.iter().map(|(level, _)| format!("{level}_height"));
        let led = led.filter(|name| body.measures.contains_key(name)).collect();
        let mesh: BTreeMap<_, _> = self.measures.into_iter().map(|(name, x)| (name, to_micrometres(x))).collect();
        for (name, length) in &mesh {
            body.measures.entry((*name).to_owned()).or_insert(*length);
        }
        for (name, p) in self.landmarks {
            body.landmarks.entry(name).or_insert(p.map(to_micrometres));
        }
        for (name, s) in self.segments {
            let steps = |p: Vec3| p.map(to_micrometres);
            let half = [s.half_width, s.half_depth].map(to_micrometres);
            let segment =
                BodySegment { from: steps(s.from), to: steps(s.to), half_width: half[0], half_depth: half[1] };
            body.segments.entry(name).or_insert(segment);
        }
        let Self { girths, mut missing, mut guessed, pose, .. } = self;
        // What both sides lack is said once.
        missing.dedup();
        guessed.dedup();
        Found { body, mesh, led, moved: Vec::new(), pose, girths, missing, guessed }
    }

    fn all(&mut self, marks: &Marks) {
        let (low, height) = (self.slices.low, self.slices.height);
        self.segments = super::segments(self.body, self.slices, marks);
        let armpit = marks.exact_armpit(self.slices);
        let least = armpit - 0.02 * height;
        let is_upper = |t: &&[u32; 3]| t.iter().any(|v| self.body.positions[*v as usize].y > least);
        self.upper = self.body.triangles.iter().filter(is_upper).copied().collect();
        self.height("stature", low + height);
        let crown = self.body.positions.iter().max_by(|a, b| a.y.total_cmp(&b.y));
        self.landmarks.extend(crown.map(|p| ("crown".to_owned(), *p)));
        let crotch = self.named("crotch").unwrap_or_else(|| marks.exact_crotch(self.slices));
        self.trunk(marks, crotch, armpit);
        self.neck(marks);
        self.arms(marks, armpit);
        self.legs(crotch);
    }

    /// A height that the body names itself.
    fn named(&self, name: &str) -> Option<f64> {
        named(self.body, self.slices.low, name)
    }

    fn height(&mut self, name: &'static str, y: f64) {
        self.measures.insert(name, y - self.slices.low);
    }

    fn girth(&mut self, name: &'static str, outline: Option<&Section>) {
        let Some(outline) = outline else {
            self.missing.push((name, "the mesh has no outline there"));
            return;
        };
        let length = outline.girth();
        self.measures.entry(name).or_insert(length);
        self.girths.push(GirthLine { name, points: outline.points.clone(), length });
    }

    /// Front, back and sides at a height of the trunk.
    fn around(&mut self, name: &str, outline: &Section) {
        let (low, high) = outline.bounds();
        let z = 0.5 * (low.z + high.z);
        let [back, front] = across(outline, self.slices.middle).map_or([None; 2], |ends| ends.map(Some));
        let places = [
            ("front", front),
            ("back", back),
            ("left", Some(Vec3::new(high.x, low.y, z))),
            ("right", Some(Vec3::new(low.x, low.y, z))),
        ];
        self.landmarks.extend(places.into_iter().filter_map(|(side, p)| Some((format!("{name}-{side}"), p?))));
    }

    fn trunk(&mut self, marks: &Marks, crotch: f64, armpit: f64) {
        let height = self.slices.height;
        self.height("crotch_height", crotch);
        if let Some(outline) = self.slices.trunk(crotch + 1e-4) {
            let place = Vec3::new(self.slices.middle, crotch, outline.centre().z);
            self.landmarks.insert("crotch".to_owned(), place);
        }
        let tape = |y: f64| self.slices.trunk(y).map(|s| s.girth());
        let narrow = largest(marks.waist - 0.012 * height, marks.waist + 0.012 * height, 24, |y| tape(y).map(|g| -g));
        let [from, to] = [crotch + 0.1 * height, armpit - 0.055 * height];
        let waist = match narrow.filter(|n| (from..to).contains(&n.0)) {
            Some(narrow) => narrow.0,
            None if self.named("waist").is_some() => 0.0,
            None => {
                self.guessed.push(("waist_height", "the trunk is nowhere narrow between hips and armpits"));
                crotch + WAIST * (armpit - crotch)
            }
        };
        let waist = self.named("waist").unwrap_or(waist);
        // A full belly over the hips is none of them.
        let hip = largest(crotch + 0.008 * height, crotch + 0.35 * (waist - crotch), 60, tape).map_or(crotch, |h| h.0);
        let hip = self.named("hip").unwrap_or(hip);
        for (name, y) in [("waist", waist), ("hip", hip)] {
            let outline = self.slices.trunk(y);
            self.girth(if name == "waist" { "waist_girth" } else { "hip_girth" }, outline.as_ref());
            self.height(if name == "waist" { "waist_height" } else { "hip_height" }, y);
            if let Some(outline) = outline {
                self.around(name, &outline);
            }
        }
        self.bust(waist, armpit);
    }

    /// The trunk at a height without the arms that may join it.
    fn chest(&self, y: f64, half: f64) -> Option<Section> {
        self.slices.trunk(y).map(|s| s.within(self.slices.middle, half))
    }

    fn bust(&mut self, waist: f64, armpit: f64) {
        let (height, middle) = (self.slices.height, self.slices.middle);
        let width = |y: f64| self.slices.trunk(y).map_or(0.2 * height, |s| s.bounds().1.x - s.bounds().0.x);
        // Skin that is drawn up by lifted arms is none of the chest.
        let half = (0.5 * width(armpit - 1e-4)).min(0.5 * CHEST * width(armpit - 0.07 * height));
        let front = |y: f64| {
            let outline = self.chest(y, half)?;
            let ahead = outline.points.iter().filter(|p| ((p.x - middle).abs() / height - 0.04).abs() < 0.028);
            ahead.map(|p| p.z).max_by(f64::total_cmp)
        };
        let step = 0.003 * height;
        let [from, to] = [waist + 0.3 * (armpit - waist), armpit + 0.035 * height];
        let steps = ((to - from) / step) as usize;
        let line: Vec<(f64, f64)> =
            (0..=steps).filter_map(|k| front(to - step * k as f64).map(|z| (to - step * k as f64, z))).collect();
        // From above: the first place that lies before all within 25 mm of an adult.
        let is_near = |k: usize, l: &(f64, f64)| (l.0 - line[k].0).abs() < 5.5 * step;
        let is_peak = |k: &usize| {
            (3..line.len().saturating_sub(3)).contains(k) && !line.iter().any(|l| is_near(*k, l) && l.1 > line[*k].1)
        };
        let seen = self.named("bust").or_else(|| (0..line.len()).find(is_peak).map(|k| line[k].0));
        let y = seen.unwrap_or_else(|| {
            self.guessed.push(("bust_height", "the chest has no prominence; it is measured under the armpits"));
            armpit - share::CHEST * height
        });
        self.height("bust_height", y);
        let outline = self.chest(y, half);
        self.girth("bust_girth", outline.as_ref());
        for (side, sign) in SIDES {
            let of = |s: &Section| {
                s.points
                    .iter()
                    .filter(|p| sign * (p.x - middle) > 0.02 * height)
                    .copied()
                    .max_by(|a, b| a.z.total_cmp(&b.z))
            };
            self.landmarks.extend(outline.as_ref().and_then(of).map(|p| (format!("bust-{side}"), p)));
        }
        let under = self.chest(y - share::UNDER_BUST * height, half);
        self.girth("under_bust_girth", under.as_ref());
    }

    fn neck(&mut self, marks: &Marks) {
        let height = self.slices.height;
        let tape = |y: f64| self.slices.trunk(y).map(|s| -s.girth());
        let narrow = largest(marks.neck - 0.01 * height, marks.neck + 0.01 * height, 20, tape);
        let Some((narrow, Some(outline))) = narrow.map(|(y, _)| (y, self.slices.trunk(y))) else { return };
        // The head is wider than the neck: shoulders are looked for under the narrowest place.
        self.upper.retain(|t| t.iter().all(|v| self.body.positions[*v as usize].y < narrow));
        let feet: Vec<Vec3> = SIDES.iter().filter_map(|(_, sign)| self.neck_side(*sign, narrow, &outline)).collect();
        let [left, right] = feet[..] else {
            self.missing.push(("neck_height", "no shoulder begins beside the neck"));
            return;
        };
        self.landmarks.insert("neck-side-left".to_owned(), left);
        self.landmarks.insert("neck-side-right".to_owned(), right);
        let back = 0.5 * (left.y + right.y);
        self.height("neck_height", back);
        let middle = self.slices.middle;
        let slices = self.slices;
        let ends = |y: f64| slices.trunk(y).and_then(|s| across(&s, middle));
        self.landmarks.extend(ends(back).map(|[behind, _]| ("neck-back".to_owned(), behind)));
        self.neck_girth(0.5 * (narrow + back), narrow - back);
        // The pit of the neck lies farthest behind a straight line from the narrowest place down to the chest.
        let front = |y: f64| ends(y).map(|[_, before]| before);
        let (Some(a), Some(b)) = (front(narrow), front(back - 0.075 * height)) else { return };
        let depth = |y: f64| {
            let p = front(y)?;
            Some((a.z + (b.z - a.z) * (y - a.y) / (b.y - a.y)) - p.z)
        };
        let pit = largest(b.y, a.y, 40, depth).and_then(|(y, _)| front(y));
        self.landmarks.extend(pit.map(|p| ("neck-front".to_owned(), p)));
    }

    /// The foot of the neck on a side: the place farthest under a straight line from the neck to the middle of the
    /// shoulder.
    fn neck_side(&self, sign: f64, narrow: f64, outline: &Section) -> Option<Vec3> {
        let middle = self.slices.middle;
        let out = |p: &Vec3| sign * (p.x - middle);
        let edge = outline.points.iter().map(out).fold(f64::NEG_INFINITY, f64::max);
        let far = SHOULDER * self.slices.height;
        let line = self.shoulder_line(sign);
        let end = line.iter().find(|p| out(p) >= far)?;
        let under = |p: &Vec3| narrow + (end.y - narrow) * (out(p) - edge) / (out(end) - edge) - p.y;
        let between = line.iter().filter(|p| out(p) > edge && out(p) < far);
        between.max_by(|a, b| under(a).total_cmp(&under(b))).copied()
    }

    /// The girth across the axis of the neck, half way between its foot and its narrowest place.
    fn neck_girth(&mut self, y: f64, rise: f64) {
        let step = (0.5 * rise).max(0.004 * self.slices.height);
        let centre = |y: f64| self.slices.trunk(y).map(|s| s.centre());
        let (Some(at), Some(over)) = (centre(y), centre(y + step)) else { return };
        let lean = (over - at) / (over - at).y.max(1e-9);
        let most = libm::tan(LEAN.to_radians()) / libm::sqrt(lean.x * lean.x + lean.z * lean.z).max(1e-9);
        let along = Vec3::y() + Vec3::new(lean.x, 0.0, lean.z) * most.min(1.0);
        let outline = section_near(&self.body.positions, &self.body.triangles, at, along);
        self.girth("neck_girth", outline.as_ref());
    }

    /// The top of the body from the neck outwards.
    fn shoulder_line(&self, sign: f64) -> Vec<Vec3> {
        let (height, middle) = (self.slices.height, self.slices.middle);
        let x = |k: i32| middle + sign * height * (0.02 + 0.0025 * f64::from(k));
        (0..60).filter_map(|k| top(self.body, &self.upper, x(k))).collect()
    }

    fn arms(&mut self, marks: &Marks, armpit: f64) {
        let limbs = [self.segments.get("arm-left").cloned(), self.segments.get("arm-right").cloned()];
        let angles: Vec<f64> = limbs.iter().flatten().map(angle).collect();
        self.pose = match angles.iter().copied().reduce(f64::max) {
            None => Pose::Armless,
            Some(a) if a < POSES[0] => Pose::Down,
            Some(a) if a < POSES[1] => Pose::A,
            Some(_) => Pose::T,
        };
        if limbs.iter().any(Option::is_none) {
            self.missing.push(("arm_length", "no outline of an arm was found beside the trunk"));
        }
        let mut ends = Vec::new();
        for ((side, sign), limb) in SIDES.into_iter().zip(limbs) {
            let Some(shoulder) = self.shoulder(marks, armpit, sign, limb.as_ref()) else { continue };
            self.landmarks.insert(format!("shoulder-{side}"), shoulder);
            ends.push(shoulder);
            if marks.has_arms {
                self.underarm(side, sign, armpit);
            }
            let Some(limb) = limb else { continue };
            match ArmLine::of(self.body, &limb, shoulder) {
                Some(arm) => self.arm(side, &arm, shoulder),
                None => self.missing.push(("wrist_girth", "the arm could not be followed to its end")),
            }
        }
        if let [left, right] = ends[..] {
            self.measures.insert("shoulder_width", (left - right).norm());
            self.height("shoulder_height", 0.5 * (left.y + right.y));
        }
    }

    fn underarm(&mut self, side: &str, sign: f64, armpit: f64) {
        let below = armpit - 1e-4;
        let out = |p: &Vec3| sign * (p.x - self.slices.middle);
        let Some(trunk) = self.slices.trunk(below) else { return };
        let edge = trunk.points.iter().copied().max_by(|a, b| out(a).total_cmp(&out(b)));
        self.landmarks.extend(edge.map(|p| (format!("underarm-{side}"), p)));
    }

    /// The shoulder point: the corner between the shoulder and the arm, seen from the front.
    fn shoulder(&mut self, marks: &Marks, armpit: f64, sign: f64, limb: Option<&BodySegment>) -> Option<Vec3> {
        let height = self.slices.height;
        let line = self.shoulder_line(sign);
        let out = |p: &Vec3| sign * (p.x - self.slices.middle);
        let start = *self.landmarks.get(if sign > 0.0 { "neck-side-left" } else { "neck-side-right" })?;
        let edge = self
            .slices
            .trunk(armpit - 1e-4)
            .map_or(marks.half, |s| s.points.iter().map(out).fold(f64::NEG_INFINITY, f64::max));
        let fall = |a: &Vec3, b: &Vec3| libm::atan2(a.y - b.y, out(b) - out(a)).to_degrees();
        let middle = line.iter().find(|p| out(p) > 0.55 * out(&start) + 0.45 * edge)?;
        let near = line.iter().find(|p| out(p) > 0.8 * out(&start) + 0.2 * edge)?;
        let shoulder = fall(near, middle);
        let arm = limb.map_or(90.0, |l| 90.0 - angle(l));
        if arm - shoulder < CORNER {
            self.guessed.push(("shoulder_width", "no corner is seen between shoulder and arm"));
            return line.iter().copied().find(|p| out(p) >= 0.5 * share::SHOULDERS * height);
        }
        let turned = 0.5 * (shoulder + arm);
        let corner = line.windows(3).find(|w| out(&w[1]) > out(middle) && fall(&w[0], &w[2]) > turned);
        corner.map(|w| w[1])
    }

    fn arm(&mut self, side: &str, arm: &ArmLine, shoulder: Vec3) {
        let upper = arm.cut(self.body, UPPER_ARM_AT * arm.wrist);
        self.girth("upper_arm_girth", upper.as_ref());
        let wrist = arm.cut(self.body, arm.wrist);
        self.girth("wrist_girth", wrist.as_ref());
        let out = arm.outwards();
        let outer = |s: &Section| s.points.iter().copied().max_by(|a, b| a.dot(&out).total_cmp(&b.dot(&out)));
        let elbow = arm.cut(self.body, ELBOW_AT * arm.wrist);
        let [elbow, wrist] = [elbow, wrist].map(|s| s.as_ref().and_then(outer));
        self.landmarks.extend(elbow.map(|p| (format!("elbow-{side}"), p)));
        self.landmarks.extend(wrist.map(|p| (format!("wrist-{side}"), p)));
        if let (Some(elbow), Some(wrist)) = (elbow, wrist) {
            let bent = (elbow - shoulder).norm() + (wrist - elbow).norm();
            self.measures.entry("arm_length").or_insert(bent);
        }
    }

    fn legs(&mut self, crotch: f64) {
        let (low, height) = (self.slices.low, self.slices.height);
        let knee = low + share::KNEE * height;
        self.height("knee_height", knee);
        for (side, sign) in SIDES {
            let tape = |y: f64| self.slices.beside(y, sign).map(|s| s.girth());
            let calf = largest(low + 0.13 * height, knee - 0.03 * height, 24, tape).map(|c| c.0);
            let ankle = largest(low + 0.035 * height, low + 0.12 * height, 24, |y| tape(y).map(|g| -g)).map(|a| a.0);
            let places = [
                ("thigh_girth", Some(crotch - share::THIGH * height)),
                ("knee_girth", Some(knee)),
                ("calf_girth", calf),
                ("ankle_girth", ankle),
            ];
            for (name, y) in places {
                let outline = y.and_then(|y| self.slices.beside(y, sign));
                self.girth(name, outline.as_ref());
            }
            let side_of = |s: &Section| s.points.iter().copied().max_by(|a, b| (sign * a.x).total_cmp(&(sign * b.x)));
            let front_of = |s: &Section| s.points.iter().copied().max_by(|a, b| a.z.total_cmp(&b.z));
            let at = |y: f64| self.slices.beside(y, sign);
            let kneecap = at(knee).as_ref().and_then(front_of);
            let outer = ankle.and_then(at).as_ref().and_then(side_of);
            self.landmarks.extend(kneecap.map(|p| (format!("knee-{side}"), p)));
            self.landmarks.extend(outer.map(|p| (format!("ankle-{side}"), p)));
        }
    }
}
