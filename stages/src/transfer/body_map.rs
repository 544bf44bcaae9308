//! The map from the space around one body to the space around another.

use super::chart::{Chart, Polar};
use super::heights::Heights;
use crate::body::{where_on, with_segments};
use crate::fit::level_height;
use std::collections::BTreeMap;
use toile_garment::Vec3;
use toile_garment::body::{Body, BodySegment};

/// Share of an arm from its joint on where its outlines are free of the trunk, and where they end before the hand.
const FREE_ARM: [f64; 2] = [0.25, 0.95];
/// A point that is that much nearer to an arm than to the trunk belongs to the arm alone, metres. One that is not nearer
/// belongs to the trunk alone, as the edge of an armhole does.
const BLEND: f64 = 0.06;
/// A garment hangs from the hip where the body names no hip; then the share of the trunk from the crotch up.
const HIP_SHARE: f64 = 0.1;

/// A part of both bodies.
struct Part {
    from: Chart,
    to: Chart,
}

impl Part {
    /// Where a point of the first body's chart comes to at a place along the axis of the second. Outside of the tape the
    /// distance from it stays, and `added` is put to its radius; inside it scales.
    fn moved(&self, p: Polar, along: f64, added: f64) -> Vec3 {
        let own = self.from.radius(p.along, p.angle);
        let wanted = self.to.radius(along, p.angle) + added;
        let far = if p.far >= own { wanted + (p.far - own) } else { p.far * wanted / own.max(f64::MIN_POSITIVE) };
        self.to.point(Polar { along, angle: p.angle, far })
    }
}

/// An arm of both bodies: lengths along it scale.
struct Arm {
    part: Part,
    stretch: f64,
    /// Its axis on the first body.
    axis: BodySegment,
}

/// The map. It is continuous, and a point of the first body's surface comes to that of the second.
pub struct BodyMap {
    trunk: Part,
    heights: Heights,
    arms: Vec<Arm>,
}

impl BodyMap {
    /// The map from a body to another; `add` is girth that cloth gets beside, metres, by the name of its level.
    ///
    /// # Errors
    /// The name of the part that a body lacks, and which body it is.
    pub fn new(from: &Body, to: &Body, add: &BTreeMap<String, f64>) -> Result<Self, String> {
        let (from, to) = (&with_segments(from), &with_segments(to));
        let trunk = |body: &Body, which: &str| {
            trunk(body).ok_or_else(|| format!("the body that the garment {which} has no trunk that can be measured"))
        };
        let trunk = Part { from: trunk(from, "is on")?, to: trunk(to, "goes to")? };
        let arms = ["arm-left", "arm-right"].into_iter().filter_map(|name| {
            let (a, b) = (from.segments.get(name)?, to.segments.get(name)?);
            let part = Part { from: limb(from, a)?, to: limb(to, b)? };
            let stretch = (b.to - b.from).norm() / (a.to - a.from).norm();
            Some(Arm { part, stretch, axis: a.clone() })
        });
        let arms = arms.collect();
        Ok(Self { trunk, heights: Heights::new(from, to, add), arms })
    }

    /// Where a point of the first body's space comes to.
    pub fn at(&self, p: Vec3) -> Vec3 {
        let (on_trunk, far) = self.on_trunk(p);
        self.arms.iter().fold(on_trunk, |so_far, arm| {
            let nearer = far - arm.distance(p);
            let weight = smooth(nearer / BLEND);
            if weight > 0.0 { so_far.lerp(&arm.at(p), weight) } else { so_far }
        })
    }

    /// The map of the trunk, and the distance of the point from it.
    fn on_trunk(&self, p: Vec3) -> (Vec3, f64) {
        let polar = self.trunk.from.polar(p);
        let added = self.heights.added(polar.along) / std::f64::consts::TAU;
        let moved = self.trunk.moved(polar, self.heights.moved(polar.along), added);
        (moved, polar.far - self.trunk.from.radius(polar.along, polar.angle))
    }
}

impl Arm {
    fn at(&self, p: Vec3) -> Vec3 {
        let polar = self.part.from.polar(p);
        self.part.moved(polar, polar.along * self.stretch, 0.0)
    }

    /// Distance from the skin of the arm, about.
    fn distance(&self, p: Vec3) -> f64 {
        let polar = self.part.from.polar(p);
        where_on::distance(&self.axis, p) - self.part.from.radius(polar.along, polar.angle)
    }
}

/// 0 below 0, 1 above 1, without a kink between.
fn smooth(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// The trunk with neck and head, and the legs hidden under what hangs from the hip.
fn trunk(body: &Body) -> Option<Chart> {
    let torso = body.segments.get("torso")?;
    let middle = 0.5 * (torso.from.x + torso.to.x);
    let half = body.landmarks.get("shoulder-left").map_or(torso.half_width, |p| (p.x - middle).abs());
    let crotch = torso.from.y.min(torso.to.y);
    let top = body.positions.iter().map(|p| p.y).fold(f64::NEG_INFINITY, f64::max);
    let frame = [Vec3::x(), Vec3::z(), Vec3::y()];
    let origin = Vec3::new(middle, 0.0, 0.5 * (torso.from.z + torso.to.z));
    let mut chart = Chart::new(body, origin, frame, [crotch, top], |p| (p.x - middle).abs() <= half)?;
    let hip = level_height("hip", body).unwrap_or(crotch + HIP_SHARE * (torso.from.y - torso.to.y).abs());
    chart.hang_below(hip);
    Some(chart)
}

fn limb(body: &Body, segment: &BodySegment) -> Option<Chart> {
    let way = segment.to - segment.from;
    let along = way.normalize();
    let deep = (Vec3::z() - along * along.z).normalize();
    let frame = [deep.cross(&along), deep, along];
    let range = FREE_ARM.map(|share| share * way.norm());
    Chart::new(body, segment.from, frame, range, |_| true)
}
