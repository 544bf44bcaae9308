//! A trouser leg in one piece starts on a cone around its leg.
//!
//! A flat piece bends onto a cone without strain, as onto a cylinder. A leg narrows downwards, and so does its piece. On
//! a cylinder around the trunk the lower edges would lie outside the leg, and their threads would lead through it.

use super::dresser::{Dresser, across_segment};
use super::sheet::Sheet;
use crate::roles::outline::{Polygon, turned};
use std::f64::consts::{FRAC_PI_2, PI};
use std::ops::RangeInclusive;
use toile_garment::body::BodySegment;
use toile_garment::{Vec2, Vec3};

// Evidence: `docs/lab/2026-11-28-public-files.md`. Two leggings (ORILEG) need the cone; no number was varied.

/// Largest share of the way round a leg that its piece covers at the start.
const COVERED: f64 = 0.8;
/// Distance of the cloth from the leg, m.
const CLEARANCE: f64 = 0.02;
/// Distance of the edges from the middle of the body at the crotch, m: half the gap between both legs.
const FROM_MIDDLE: f64 = 0.01;
/// Radius of an ankle over that of its leg at the thigh.
const ANKLE: f64 = 0.55;
/// Height of the hem over the lowest point, as a share of the height of the piece. Hems are curved.
const HEM: f64 = 0.05;
/// Sines of half the angle of a cone. Below them the piece is as good as straight, and above them it is no leg.
const NARROWS: RangeInclusive<f64> = 0.01..=0.5;

/// A circular cone about an axis that points from its tip upwards.
#[derive(Clone, Debug)]
pub struct Cone {
    tip: Vec3,
    up: Vec3,
    /// From the axis to the middle of the piece.
    out: Vec3,
    /// Sine of the angle between the axis and the surface.
    sine: f64,
    /// Distance of the middle of the piece from the tip, m.
    middle: f64,
}

impl Cone {
    /// A point at a distance from the middle of the piece, to the right and up along the cloth, m.
    pub fn at(&self, d: Vec2) -> Vec3 {
        let (x, y) = (d.x, self.middle + d.y);
        let (from_tip, turn) = (libm::hypot(x, y), libm::atan2(x, y) / self.sine);
        let (s, c) = libm::sincos(turn);
        let cosine = (1.0 - self.sine * self.sine).sqrt();
        let away = self.out * c + self.up.cross(&self.out) * s;
        self.tip + (self.up * cosine + away * self.sine) * from_tip
    }
}

/// Lays a leg in one piece, which is bent around the trunk at its height, on a cone around its leg. A piece stays where
/// it is if the ends of its hem lie on the inner side of the leg, as those of shorts do, or if it does not narrow.
pub fn lay_on_cone(d: &mut Dresser<'_>, i: usize) {
    let Some(sheet) = d.sheets[i].clone().filter(|_| d.is_whole_leg(i)) else { return };
    let Some(bend) = &sheet.bend else { return };
    let side = usize::from(bend.angle < 0.0);
    let outline = d.outlines[i].map(|p| turned(p, sheet.turn));
    let height = sheet.at(turned(bend.middle, -sheet.turn)).y;
    let from_middle = |p: Vec3| (p.x - d.form.torso.from.x).abs();
    let hem = hem_height(&sheet, &outline);
    let at_hem = d.outlines[i].points.iter().map(|p| sheet.at(*p)).filter(|p| p.y < hem);
    let innermost = at_hem.map(from_middle).fold(f64::INFINITY, f64::min);
    if innermost < from_middle(d.form.legs[side].from) {
        return;
    }
    if let Some(cone) = cone(&outline, bend.middle, &d.form.legs[side], &d.form.torso, height) {
        d.sheets[i] = Some(sheet.on_cone(cone));
    }
}

/// Height in space below which a point of a bent piece belongs to its hem, m.
fn hem_height(sheet: &Sheet, outline: &Polygon) -> f64 {
    let [low, high] = outline.bounds();
    let at = |y: f64| sheet.at(turned(Vec2::new(0.5 * (low.x + high.x), y), -sheet.turn)).y;
    at(low.y + HEM * (high.y - low.y))
}

/// The cone of an upright piece whose `middle` starts at a height, m, or lower: its crotch lies no higher than that of the
/// body, because its edges would start in the trunk.
fn cone(outline: &Polygon, middle: Vec2, leg: &BodySegment, torso: &BodySegment, height: f64) -> Option<Cone> {
    let [low, high] = outline.bounds();
    let side =
        |at: f64| outline.points.iter().filter(|p| (p.x - at).abs() < 1e-9).map(|p| p.y).fold(f64::INFINITY, f64::min);
    let (crotch, hem) = (side(low.x).min(side(high.x)), low.y + HEM * (high.y - low.y));
    let thick = leg.half_width.max(leg.half_depth);
    let least = |width: f64, leg: f64| (width / (2.0 * PI * COVERED)).max(leg + CLEARANCE);
    let aside = (leg.from.x - torso.from.x).abs();
    let width = width_at(outline, crotch)?;
    let at_crotch = radius(least(width, thick), width, aside);
    let at_hem = least(width_at(outline, hem)?, ANKLE * thick);
    let sine = (at_crotch - at_hem) / (crotch - hem);
    if !NARROWS.contains(&sine) {
        return None;
    }
    let up = (leg.from - leg.to).try_normalize(1e-9)?;
    let [_, left] = across_segment(leg);
    let out = if leg.from.x < torso.from.x { -left } else { left };
    let from_tip = at_crotch / sine + middle.y - crotch;
    let cosine = (1.0 - sine * sine).sqrt();
    let height = height.min(torso.to.y + middle.y - crotch);
    let on_axis = leg.from + up * ((height - leg.from.y) / up.y);
    Some(Cone { tip: on_axis - up * (from_tip * cosine), up, out, sine, middle: from_tip })
}

/// The smallest radius from `least` on at which the edges of a piece of this width stay on their side of the body.
fn radius(least: f64, width: f64, aside: f64) -> f64 {
    let inside = |r: f64| aside + r * libm::cos((0.5 * width / r).min(PI)) < FROM_MIDDLE;
    let (mut low, mut high) = (least, least.max(width / PI * FRAC_PI_2));
    if !inside(low) {
        return low;
    }
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        (low, high) = if inside(middle) { (middle, high) } else { (low, middle) };
    }
    high
}

/// Width of an outline at a height, m.
fn width_at(outline: &Polygon, y: f64) -> Option<f64> {
    let crossing = |[a, b]: [Vec2; 2]| ((a.y <= y) != (b.y <= y)).then(|| a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
    let xs: Vec<f64> = outline.sides().filter_map(crossing).collect();
    let [low, high] = xs.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], x| [l.min(*x), h.max(*x)]);
    (xs.len() > 1).then_some(high - low)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cone_keeps_the_lengths_of_a_flat_piece() {
        let cone = Cone { tip: Vec3::zeros(), up: Vec3::y(), out: Vec3::x(), sine: 0.09, middle: 1.0 };
        let step = 1e-5;
        for p in [Vec2::new(0.0, 0.0), Vec2::new(0.24, 0.15), Vec2::new(-0.1, -0.4)] {
            let along = |d: Vec2| (cone.at(p + d * step) - cone.at(p - d * step)) / (2.0 * step);
            let (u, v) = (along(Vec2::x()), along(Vec2::y()));
            assert!((u.norm() - 1.0).abs() < 1e-6 && (v.norm() - 1.0).abs() < 1e-6 && u.dot(&v).abs() < 1e-6);
            // The right side of the cloth looks away from the axis.
            let away = cone.at(p) - Vec3::y() * cone.at(p).y;
            assert!(u.cross(&v).dot(&away) > 0.9 * away.norm());
        }
    }

    #[test]
    fn edges_stay_on_their_side_of_the_body() {
        for width in [0.45, 0.52, 0.7, 0.9] {
            let r = radius(width / (2.0 * PI * COVERED), width, 0.09);
            assert!(0.09 + r * libm::cos(0.5 * width / r) > 0.99 * FROM_MIDDLE, "{width}: {r}");
        }
    }
}
