//! lyon's even-odd rule at one point: is there cloth?

use super::{Frame, NO_CURVES};
use lyon::algorithms::hit_test::hit_test_path;
use lyon::math::Point;
use lyon::path::{FillRule, PathEvent};
use toile_garment::Vec2;

/// The rule that decides cloth: what one ring encloses is cloth, and a ring within it takes it away again.
pub const RULE: FillRule = FillRule::EvenOdd;

/// Tells whether the cloth that closed rings bound covers a point.
///
/// The point is the middle of the frame, so that rounding to `f32` cannot move it over a ring near by.
pub fn covers<'r>(rings: impl IntoIterator<Item = &'r [Vec2]>, p: Vec2) -> bool {
    let frame = Frame(p);
    let events = rings.into_iter().flat_map(|ring| closed(frame, ring));
    hit_test_path(&Point::origin(), events, RULE, NO_CURVES)
}

/// The sides of a ring as events of a path.
fn closed(frame: Frame, ring: &[Vec2]) -> impl Iterator<Item = PathEvent> {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(move |(a, b)| PathEvent::Line { from: frame.to(*a), to: frame.to(*b) })
}
