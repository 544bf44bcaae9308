//! Pieces of trousers are turned in their planes until their lower ends lie before the legs.

use super::dresser::{Dresser, Segment};
use super::sheet::Sheet;
use crate::roles::Part;
use std::f64::consts::FRAC_PI_2;
use toile_garment::body::BodySegment;
use toile_garment::{Vec2, Vec3};

/// Largest lean, rad. It only bounds what an odd outline asks for; no garment was seen to need it.
const LEAN_MOST: f64 = 0.2;

/// Leans a flat piece of a leg about its fork until its lower end lies before the leg, or reaches the plane of the fork.
///
/// Left and right pieces hang beside one another, and their forks take room. Straight down they would lie too far out, and
/// the threads of the inner seam would press against the leg.
pub fn over_leg(d: &mut Dresser<'_>, i: usize) {
    let is_leg = d.part(i) == Some(Part::Leg) && d.segments[i] == Segment::Torso && !d.is_given[i];
    let Some(sheet) = d.sheets[i].clone().filter(|s| is_leg && s.bend.is_none()) else { return };
    if let Some((by, fork)) = lean(d, i, &sheet) {
        d.sheets[i] = Some(sheet.leaning(by, fork));
    }
}

/// The lean of a piece, rad, counter-clockwise as seen from its right side, and its fork: the point nearest to the middle of
/// the body. `None` where that point lies in the lower half of the piece.
fn lean(d: &Dresser<'_>, i: usize, sheet: &Sheet) -> Option<(f64, Vec2)> {
    let points = &d.outlines[i].points;
    let side = (sheet.at(d.outlines[i].centroid()).x - d.form.torso.from.x).signum();
    let least = |value: &dyn Fn(Vec3) -> f64| {
        points.iter().copied().min_by(|a, b| value(sheet.at(*a)).total_cmp(&value(sheet.at(*b))))
    };
    let about = least(&|p| side * p.x)?;
    let [fork, bottom, top] = [about, least(&|p| p.y)?, least(&|p| -p.y)?].map(|p| sheet.at(p));
    if fork.y <= 0.5 * (bottom.y + top.y) {
        return None;
    }
    // Angles at the fork from straight down, outwards.
    let angle = |p: Vec3| libm::atan2(side * (p - fork).x, fork.y - p.y);
    let lower = points.iter().map(|p| sheet.at(*p)).filter(|p| p.y < 0.5 * (fork.y + bottom.y));
    let [inner, outer] = lower.map(angle).fold([FRAC_PI_2, -FRAC_PI_2], |[l, m], a| [l.min(a), m.max(a)]);
    let leg = &d.form.legs[usize::from(side < 0.0)];
    let inwards = 0.5 * (inner + outer) - angle(at_height(leg, bottom.y));
    let inwards = inwards.min(inner).clamp(-LEAN_MOST, LEAN_MOST);
    Some((if sheet.right.x * side > 0.0 { -inwards } else { inwards }, about))
}

/// The point of the axis of a leg at a height.
fn at_height(leg: &BodySegment, height: f64) -> Vec3 {
    let way = leg.to - leg.from;
    let share = if way.y.abs() > 1e-6 { ((height - leg.from.y) / way.y).clamp(0.0, 1.0) } else { 1.0 };
    leg.from + way * share
}
