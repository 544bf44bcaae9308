//! Pieces of trousers lean in their planes until their lower ends lie before the legs.

use super::dresser::{Dresser, Segment};
use super::sheet::Sheet;
use crate::roles::Part;
use std::f64::consts::FRAC_PI_2;
use toile_garment::body::BodySegment;
use toile_garment::{Vec2, Vec3};

/// Largest lean, rad.
const LEAN_MOST: f64 = 0.2;

/// Leans a flat piece of a leg about its point nearest to the middle of the body, which is its fork. Its inner seam then passes
/// on the inner side of the leg. Pieces that hang straight down beside one another lie too far out, for their forks take room,
/// and the threads of the inner seam press against the leg.
pub fn over_leg(d: &mut Dresser<'_>, i: usize) {
    let is_leg = d.part(i) == Some(Part::Leg) && d.segments[i] == Segment::Torso && !d.is_given[i];
    let Some(sheet) = d.sheets[i].clone().filter(|s| is_leg && s.bend.is_none()) else { return };
    let Some(lean) = Lean::of(d, i, &sheet) else { return };
    let by = if sheet.right.x * lean.side > 0.0 { -lean.by } else { lean.by };
    d.sheets[i] = Some(sheet.leaning(by, lean.about));
}

/// A lean in the plane of a piece.
struct Lean {
    /// Side of the body: 1 left, −1 right.
    side: f64,
    /// The point that stays.
    about: Vec2,
    /// How far the lower end goes inwards, rad.
    by: f64,
}

impl Lean {
    /// The lean that brings the lower end before its leg, as far as the piece does not pass the plane of its fork. `None` for a
    /// piece without a fork in its upper half.
    fn of(d: &Dresser<'_>, i: usize, sheet: &Sheet) -> Option<Self> {
        let points = &d.outlines[i].points;
        let side = (sheet.at(d.outlines[i].centroid()).x - d.form.torso.from.x).signum();
        let by = |value: &dyn Fn(Vec3) -> f64| {
            points.iter().copied().min_by(|a, b| value(sheet.at(*a)).total_cmp(&value(sheet.at(*b))))
        };
        let [about, lowest, highest] = [by(&|p| side * p.x)?, by(&|p| p.y)?, by(&|p| -p.y)?];
        let [fork, bottom, top] = [about, lowest, highest].map(|p| sheet.at(p));
        // The angle of a point from straight down, outwards.
        let angle = |p: Vec3| libm::atan2(side * (p - fork).x, fork.y - p.y);
        let below = points.iter().map(|p| sheet.at(*p)).filter(|p| p.y < 0.5 * (fork.y + bottom.y));
        let [least, most] = below.map(angle).fold([FRAC_PI_2, -FRAC_PI_2], |[l, m], a| [l.min(a), m.max(a)]);
        let leg = &d.form.legs[usize::from(side < 0.0)];
        let wish = 0.5 * (least + most) - angle(at_height(leg, bottom.y));
        let has_fork = fork.y > 0.5 * (bottom.y + top.y);
        has_fork.then_some(Self { side, about, by: wish.min(least).clamp(-LEAN_MOST, LEAN_MOST) })
    }
}

/// The point of the axis of a leg at a height.
fn at_height(leg: &BodySegment, height: f64) -> Vec3 {
    let way = leg.to - leg.from;
    let share = if way.y.abs() > 1e-6 { ((height - leg.from.y) / way.y).clamp(0.0, 1.0) } else { 1.0 };
    leg.from + way * share
}
