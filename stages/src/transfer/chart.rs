//! A part of a body around an axis: at every height a centre, and the radius of a tape around it in every direction.

use crate::body::{hull, section_near};
use toile_garment::body::Body;
use toile_garment::{Vec2, Vec3};

/// Directions in which a radius is stored.
const DIRECTIONS: usize = 90;
/// Distance of the slices, metres.
const STEP: f64 = 0.01;
/// Passes of the weights 1/4, 1/2, 1/4 over neighbouring slices, which take out the steps of the mesh.
const SMOOTHING_PASSES: usize = 2;

/// One slice across the axis.
#[derive(Clone, Debug)]
struct Slice {
    centre: Vec2,
    radius: Vec<f64>,
}

/// A point as a chart has it.
#[derive(Clone, Copy, Debug)]
pub struct Polar {
    /// Place along the axis, metres from the origin of the chart.
    pub along: f64,
    /// Direction around the axis, radians.
    pub angle: f64,
    /// Distance from the centre, metres.
    pub far: f64,
}

/// An axis with the outlines around it.
#[derive(Clone, Debug)]
pub struct Chart {
    origin: Vec3,
    /// Across, across, along; of unit length.
    frame: [Vec3; 3],
    /// Place of the first slice along the axis.
    first: f64,
    slices: Vec<Slice>,
}

impl Chart {
    /// A chart with slices from `range[0]` to `range[1]` along an axis; beyond them the nearest slice holds. `clip` says
    /// which points of an outline belong to the part. `None` where the body has no outline there.
    pub fn new(
        body: &Body,
        origin: Vec3,
        frame: [Vec3; 3],
        range: [f64; 2],
        clip: impl Fn(Vec3) -> bool,
    ) -> Option<Self> {
        let count = ((range[1] - range[0]) / STEP).ceil().max(1.0) as usize;
        let mut slices: Vec<Option<Slice>> = Vec::with_capacity(count + 1);
        for k in 0..=count {
            let at = origin + frame[2] * (range[0] + STEP * k as f64);
            slices.push(slice(body, at, frame, origin, &clip));
        }
        let known = slices.iter().flatten().next().cloned()?;
        let mut last = known;
        let slices = slices.into_iter().map(|s| {
            last = s.unwrap_or_else(|| last.clone());
            last.clone()
        });
        let mut chart = Self { origin, frame, first: range[0], slices: slices.collect() };
        for _ in 0..SMOOTHING_PASSES {
            chart.smooth();
        }
        Some(chart)
    }

    /// Below a place on a vertical axis nothing is narrower than there, as cloth that hangs freely.
    pub fn hang_below(&mut self, along: f64) {
        let from = ((along - self.first) / STEP).round().max(0.0) as usize;
        for k in (0..from.min(self.slices.len())).rev() {
            let above = self.slices[k + 1].clone();
            let shift = self.slices[k].centre - above.centre;
            let own = &self.slices[k].radius;
            let radius = above.radius.iter().enumerate().map(|(d, r)| {
                let direction = direction(d);
                r.max(own[d] + shift.dot(&direction))
            });
            self.slices[k] = Slice { radius: radius.collect(), centre: above.centre };
        }
    }

    fn smooth(&mut self) {
        let old = self.slices.clone();
        let last = old.len() - 1;
        for (k, slice) in self.slices.iter_mut().enumerate() {
            let (a, b) = (&old[k.saturating_sub(1)], &old[(k + 1).min(last)]);
            slice.centre = (a.centre + b.centre) * 0.25 + old[k].centre * 0.5;
            for (d, r) in slice.radius.iter_mut().enumerate() {
                *r = 0.25 * (a.radius[d] + b.radius[d]) + 0.5 * old[k].radius[d];
            }
        }
    }

    /// The point in this chart.
    pub fn polar(&self, p: Vec3) -> Polar {
        let off = p - self.origin;
        let along = off.dot(&self.frame[2]);
        let across = Vec2::new(off.dot(&self.frame[0]), off.dot(&self.frame[1])) - self.centre(along);
        Polar { along, angle: libm::atan2(across.y, across.x), far: across.norm() }
    }

    /// The point of space that has these coordinates.
    pub fn point(&self, p: Polar) -> Vec3 {
        let (sin, cos) = libm::sincos(p.angle);
        let across = self.centre(p.along) + Vec2::new(cos, sin) * p.far;
        self.origin + self.frame[0] * across.x + self.frame[1] * across.y + self.frame[2] * p.along
    }

    /// Radius of the tape at a place along the axis in a direction, metres.
    pub fn radius(&self, along: f64, angle: f64) -> f64 {
        let turn = angle.rem_euclid(std::f64::consts::TAU) / std::f64::consts::TAU * DIRECTIONS as f64;
        let d = (turn.floor() as usize).min(DIRECTIONS - 1);
        let share = turn - d as f64;
        self.between(along, |s| s.radius[d] * (1.0 - share) + s.radius[(d + 1) % DIRECTIONS] * share)
    }

    fn centre(&self, along: f64) -> Vec2 {
        Vec2::new(self.between(along, |s| s.centre.x), self.between(along, |s| s.centre.y))
    }

    fn between(&self, along: f64, value: impl Fn(&Slice) -> f64) -> f64 {
        let last = self.slices.len() - 1;
        let at = ((along - self.first) / STEP).clamp(0.0, last as f64);
        let k = (at.floor() as usize).min(last);
        let share = at - k as f64;
        value(&self.slices[k]) * (1.0 - share) + value(&self.slices[(k + 1).min(last)]) * share
    }
}

fn direction(d: usize) -> Vec2 {
    let (sin, cos) = libm::sincos(std::f64::consts::TAU * d as f64 / DIRECTIONS as f64);
    Vec2::new(cos, sin)
}

fn slice(body: &Body, at: Vec3, frame: [Vec3; 3], origin: Vec3, clip: &impl Fn(Vec3) -> bool) -> Option<Slice> {
    let section = section_near(&body.positions, &body.triangles, at, frame[2])?;
    let flat = |p: &Vec3| Vec2::new((p - origin).dot(&frame[0]), (p - origin).dot(&frame[1]));
    let ring = hull(section.points.iter().filter(|p| clip(**p)).map(flat).collect());
    if ring.len() < 3 {
        return None;
    }
    let far = Vec2::repeat(f64::INFINITY);
    let (low, high) = ring.iter().fold((far, -far), |(low, high), p| (low.inf(p), high.sup(p)));
    let centre = (low + high) * 0.5;
    let radius = (0..DIRECTIONS).map(|d| ray(&ring, centre, direction(d))).collect();
    Some(Slice { centre, radius })
}

/// Way from a point inside a convex ring to the ring, in a direction.
fn ray(ring: &[Vec2], from: Vec2, along: Vec2) -> f64 {
    let next = ring.iter().skip(1).chain(ring.first());
    let hits = ring.iter().zip(next).filter_map(|(a, b)| {
        let (edge, off) = (b - a, a - from);
        let across = along.perp(&edge);
        let way = off.perp(&edge) / across;
        let share = off.perp(&along) / across;
        (across.abs() > 0.0 && way >= 0.0 && (-1e-9..=1.0 + 1e-9).contains(&share)).then_some(way)
    });
    hits.fold(0.0, f64::max)
}
