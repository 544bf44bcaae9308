//! Segments that cross or touch.

use robust::{Coord, orient2d};
use toile_garment::Vec2;

/// More pairs than this are no drawing (a sweep over a zigzag of long lines).
const MAX_PAIRS: u64 = 150_000_000;

/// A segment with a tag.
#[derive(Clone, Copy, Debug)]
pub struct Segment {
    /// Start.
    pub a: Vec2,
    /// End.
    pub b: Vec2,
    /// Curve it belongs to.
    pub curve: usize,
    /// Number within the curve.
    pub index: usize,
}

/// Two segments that meet, and where.
#[derive(Clone, Copy, Debug)]
pub struct Meeting {
    /// First.
    pub first: Segment,
    /// Second.
    pub second: Segment,
    /// Where, metres.
    pub at: Vec2,
}

/// Too many pairs to look at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooComplex;

/// All meetings of segments that `wanted` asks for, in the order of the sweep, at most `most`.
pub fn meetings(
    mut segments: Vec<Segment>,
    wanted: impl Fn(&Segment, &Segment) -> bool,
    most: usize,
) -> Result<Vec<Meeting>, TooComplex> {
    let low = |s: &Segment| s.a.x.min(s.b.x);
    segments.sort_by(|s, t| low(s).total_cmp(&low(t)).then((s.curve, s.index).cmp(&(t.curve, t.index))));
    let mut out = Vec::new();
    let mut pairs = 0_u64;
    for (i, s) in segments.iter().enumerate() {
        let right = s.a.x.max(s.b.x);
        let (bottom, top) = (s.a.y.min(s.b.y), s.a.y.max(s.b.y));
        for t in segments[i + 1..].iter().take_while(|t| low(t) <= right) {
            pairs += 1;
            if t.a.y.min(t.b.y) > top || t.a.y.max(t.b.y) < bottom || !wanted(s, t) {
                continue;
            }
            if let Some(at) = meet(s, t) {
                out.push(Meeting { first: *s, second: *t, at });
                if out.len() >= most {
                    return Ok(out);
                }
            }
        }
        if pairs > MAX_PAIRS {
            return Err(TooComplex);
        }
    }
    Ok(out)
}

fn side(a: Vec2, b: Vec2, p: Vec2) -> f64 {
    let c = |v: Vec2| Coord { x: v.x, y: v.y };
    orient2d(c(a), c(b), c(p))
}

/// Where two segments cross or touch, decided exactly.
pub fn meet(s: &Segment, t: &Segment) -> Option<Vec2> {
    let (ta, tb) = (side(s.a, s.b, t.a), side(s.a, s.b, t.b));
    let (sa, sb) = (side(t.a, t.b, s.a), side(t.a, t.b, s.b));
    if ta * tb > 0.0 || sa * sb > 0.0 || (ta > 0.0) == (tb > 0.0) && ta != 0.0 && tb != 0.0 {
        return None;
    }
    if ta == 0.0 && tb == 0.0 {
        return overlap(s, t);
    }
    let share = sa / (sa - sb);
    Some(if share.is_finite() { s.a + (s.b - s.a) * share.clamp(0.0, 1.0) } else { s.a })
}

/// A shared point of two segments on one line.
fn overlap(s: &Segment, t: &Segment) -> Option<Vec2> {
    let d = s.b - s.a;
    let along = |p: Vec2| (p - s.a).dot(&d);
    let (lo, hi) = (along(t.a).min(along(t.b)), along(t.a).max(along(t.b)));
    let (from, to) = (lo.max(0.0), hi.min(d.norm_squared()));
    (from <= to).then(|| if d.norm_squared() > 0.0 { s.a + d * (from / d.norm_squared()) } else { s.a })
}

/// Segments of a polyline.
pub fn segments(points: &[Vec2], closed: bool, curve: usize) -> Vec<Segment> {
    let n = points.len();
    let count = if closed { n } else { n.saturating_sub(1) };
    (0..count).map(|i| Segment { a: points[i], b: points[(i + 1) % n], curve, index: i }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_crossing_of_a_bow_tie() {
        let points = [(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)].map(|(x, y)| Vec2::new(x, y));
        let apart = |s: &Segment, t: &Segment| s.index.abs_diff(t.index) == 2;
        let found = meetings(segments(&points, true, 0), apart, 9).expect("few pairs");
        assert_eq!(found.len(), 1);
        assert!((found[0].at - Vec2::new(0.5, 0.5)).norm() < 1e-12);
    }

    #[test]
    fn touching_and_overlapping_count() {
        let s = |a: (f64, f64), b: (f64, f64)| Segment {
            a: Vec2::new(a.0, a.1),
            b: Vec2::new(b.0, b.1),
            curve: 0,
            index: 0,
        };
        assert!(meet(&s((0.0, 0.0), (2.0, 0.0)), &s((1.0, 0.0), (1.0, 1.0))).is_some());
        assert!(meet(&s((0.0, 0.0), (2.0, 0.0)), &s((1.0, 0.0), (3.0, 0.0))).is_some());
        assert!(meet(&s((0.0, 0.0), (2.0, 0.0)), &s((3.0, 0.0), (4.0, 0.0))).is_none());
        assert!(meet(&s((0.0, 0.0), (2.0, 0.0)), &s((1.0, 1e-9), (1.0, 1.0))).is_none());
    }
}
