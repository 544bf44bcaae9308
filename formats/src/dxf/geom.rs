//! Plane geometry on polygons, millimetres.

use super::limits;
use std::collections::BTreeMap;
use toile_garment::Vec2;

/// z of the cross product.
#[must_use]
pub fn cross(a: Vec2, b: Vec2) -> f64 {
    a.x * b.y - a.y * b.x
}

/// Angle between two directions, 0 to 180 degrees.
#[must_use]
pub fn angle(u: Vec2, v: Vec2) -> f64 {
    libm::atan2(cross(u, v).abs(), u.dot(&v)).to_degrees()
}

/// Turned counter-clockwise, radians.
#[must_use]
pub fn rotate(v: Vec2, angle: f64) -> Vec2 {
    let (s, c) = libm::sincos(angle);
    Vec2::new(c * v.x - s * v.y, s * v.x + c * v.y)
}

/// Signed area of a closed polygon, counter-clockwise positive.
#[must_use]
pub fn area(points: &[Vec2]) -> f64 {
    let Some(origin) = points.first().copied() else { return 0.0 };
    (0..points.len()).map(|i| 0.5 * cross(points[i] - origin, points[(i + 1) % points.len()] - origin)).sum()
}

/// Length of a line, the closing chord included when closed.
#[must_use]
pub fn length(points: &[Vec2], closed: bool) -> f64 {
    let open: f64 = points.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
    match (points.first(), points.last()) {
        (Some(a), Some(b)) if closed => open + (a - b).norm(),
        _ => open,
    }
}

/// Distance of a point from a segment and the parameter of the nearest point.
#[must_use]
pub fn point_segment(p: Vec2, a: Vec2, b: Vec2) -> (f64, f64) {
    let d = b - a;
    let l2 = d.norm_squared();
    let t = if l2 > 0.0 { ((p - a).dot(&d) / l2).clamp(0.0, 1.0) } else { 0.0 };
    ((p - (a + d * t)).norm(), t)
}

/// A place on a line: distance of the asked point, segment, parameter on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foot {
    /// Distance.
    pub distance: f64,
    /// Segment `i` runs from vertex `i` to `i + 1`.
    pub segment: usize,
    /// 0 at its start, 1 at its end.
    pub t: f64,
}

impl Foot {
    /// The place itself, on the line it was found for, or on another one with as many vertices.
    #[must_use]
    pub fn on(&self, line: &[Vec2]) -> Vec2 {
        let (a, b) = (line[self.segment], line[(self.segment + 1) % line.len()]);
        a + (b - a) * self.t
    }
}

/// The nearest place on a line.
#[must_use]
pub fn nearest(p: Vec2, line: &[Vec2], closed: bool) -> Option<Foot> {
    let mut best: Option<Foot> = None;
    for (segment, [a, b]) in segments(line, closed).enumerate() {
        let (distance, t) = point_segment(p, a, b);
        if best.is_none_or(|b| distance < b.distance) {
            best = Some(Foot { distance, segment, t });
        }
    }
    best
}

/// The segments of a line in order, without a division for each.
fn segments(line: &[Vec2], closed: bool) -> impl Iterator<Item = [Vec2; 2]> {
    let last = line.last().zip(line.first()).filter(|_| closed).map(|(a, b)| [*a, *b]);
    line.windows(2).map(|w| [w[0], w[1]]).chain(last)
}

/// Distance from a line; infinite when it has no segment.
#[must_use]
pub fn distance(p: Vec2, line: &[Vec2], closed: bool) -> f64 {
    nearest(p, line, closed).map_or(f64::INFINITY, |f| f.distance)
}

/// Segments of a line in groups with their boxes, for many distances from one line.
pub(crate) struct Groups<'a> {
    pub line: &'a [Vec2],
    segments: usize,
    boxes: Vec<(Vec2, Vec2)>,
}

/// Segments in a group.
const GROUP: usize = 12;

impl<'a> Groups<'a> {
    pub fn new(line: &'a [Vec2], closed: bool) -> Self {
        let n = line.len();
        let segments = if closed { n } else { n.saturating_sub(1) };
        let boxes = (0..segments)
            .step_by(GROUP)
            .filter_map(|first| bounds((first..=(first + GROUP).min(segments)).map(|i| line[i % n])))
            .collect();
        Self { line, segments, boxes }
    }

    fn within(&self, group: usize, p: Vec2) -> f64 {
        let last = ((group + 1) * GROUP).min(self.segments);
        // The closing segment of a closed line ends in its first vertex.
        let closing = if last == self.line.len() { Some([self.line[last - 1], self.line[0]]) } else { None };
        let run = &self.line[group * GROUP..(last + 1).min(self.line.len())];
        let segments = run.windows(2).map(|w| [w[0], w[1]]).chain(closing);
        segments.map(|[a, b]| point_segment(p, a, b).0).fold(f64::INFINITY, f64::min)
    }

    /// Distance from the line, where it is smaller than `limit`; else `limit`.
    pub fn distance_under(&self, p: Vec2, limit: f64) -> f64 {
        self.nearest_group(p, limit, 0.0, &mut 0)
    }

    /// Distance from the line, but any number up to `enough` when it is not larger. `near` is the group of the point
    /// before and becomes that of this one.
    fn distance_over(&self, p: Vec2, enough: f64, near: &mut usize) -> f64 {
        let first = if self.boxes.is_empty() { f64::INFINITY } else { self.within(*near, p) };
        self.nearest_group(p, first, enough, near)
    }

    /// The smallest distance below `best`, and the group that has it; ends as soon as one is not over `enough`.
    fn nearest_group(&self, p: Vec2, mut best: f64, enough: f64, near: &mut usize) -> f64 {
        if best <= enough {
            return best;
        }
        for (group, (lo, hi)) in self.boxes.iter().enumerate() {
            let out = Vec2::new((lo.x - p.x).max(p.x - hi.x).max(0.0), (lo.y - p.y).max(p.y - hi.y).max(0.0));
            if out.norm_squared() < best * best {
                let here = self.within(group, p);
                if here < best {
                    (best, *near) = (here, group);
                }
                if best <= enough {
                    break;
                }
            }
        }
        best
    }
}

/// Largest distance of the points of `a` from line `b`; at most about 2000 points are looked at.
#[must_use]
pub fn deviation(a: &[Vec2], b: &[Vec2], closed: bool) -> f64 {
    let (stride, groups, mut near) = (a.len() / 2000 + 1, Groups::new(b, closed), 0);
    a.iter().step_by(stride).fold(0.0, |most, p| groups.distance_over(*p, most, &mut near).max(most))
}

/// Where two segments meet, their ends included.
#[must_use]
pub fn meet(a: Vec2, b: Vec2, c: Vec2, d: Vec2) -> Option<Vec2> {
    let (u, v) = (b - a, d - c);
    let area = cross(u, v);
    if area.abs() < 1e-12 {
        return None;
    }
    let (s, t) = (cross(c - a, v) / area, cross(c - a, u) / area);
    ((0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t)).then(|| a + u * s)
}

/// Is the point inside the closed polygon (even-odd)?
#[must_use]
pub fn inside(p: Vec2, polygon: &[Vec2]) -> bool {
    let n = polygon.len();
    let mut odd = false;
    for i in 0..n {
        let (a, b) = (polygon[i], polygon[(i + 1) % n]);
        if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) {
            odd = !odd;
        }
    }
    odd
}

/// Turn at `b` coming from `a` and going to `c`, radians, left positive.
#[must_use]
pub fn turn(a: Vec2, b: Vec2, c: Vec2) -> f64 {
    let (u, v) = (b - a, c - b);
    libm::atan2(cross(u, v), u.dot(&v))
}

/// Mirrored at the line through `a` and `b`.
#[must_use]
pub fn mirror(p: Vec2, a: Vec2, b: Vec2) -> Vec2 {
    let d = b - a;
    let l2 = d.norm_squared();
    if l2 <= 0.0 {
        return p;
    }
    a + d * (2.0 * (p - a).dot(&d) / l2) - (p - a)
}

/// Lower and upper corner of the bounding box.
#[must_use]
pub fn bounds(points: impl IntoIterator<Item = Vec2>) -> Option<(Vec2, Vec2)> {
    points.into_iter().fold(None, |acc, p| match acc {
        None => Some((p, p)),
        Some((lo, hi)) => Some((lo.inf(&p), hi.sup(&p))),
    })
}

/// Points found again by position.
#[derive(Clone, Debug)]
pub struct PointIndex {
    cell: f64,
    cells: BTreeMap<(i64, i64), Vec<(Vec2, usize)>>,
}

impl PointIndex {
    /// An index for look-ups within `radius`.
    #[must_use]
    pub fn new(radius: f64, points: impl IntoIterator<Item = (Vec2, usize)>) -> Self {
        // Cells much larger than the radius: most look-ups then touch one.
        let mut index = Self { cell: 8.0 * radius, cells: BTreeMap::new() };
        for (p, id) in points {
            index.insert(p, id);
        }
        index
    }

    fn key(&self, p: Vec2) -> (i64, i64) {
        ((p.x / self.cell).floor() as i64, (p.y / self.cell).floor() as i64)
    }

    /// Adds a point.
    pub fn insert(&mut self, p: Vec2, id: usize) {
        let key = self.key(p);
        self.cells.entry(key).or_default().push((p, id));
    }

    /// All ids within `radius` (about the radius of the index), nearest first, then by id.
    #[must_use]
    pub fn near(&self, p: Vec2, radius: f64) -> Vec<(f64, usize)> {
        let reach = Vec2::new(radius, radius);
        let ((x0, y0), (x1, y1)) = (self.key(p - reach), self.key(p + reach));
        let mut found = Vec::new();
        for x in x0..=x1 {
            for y in y0..=y1 {
                for (q, id) in self.cells.get(&(x, y)).into_iter().flatten() {
                    let d = (q - p).norm();
                    if d <= radius {
                        found.push((d, *id));
                    }
                }
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        found
    }

    /// Is there a point within `radius`?
    #[must_use]
    pub fn has(&self, p: Vec2, radius: f64) -> bool {
        let reach = Vec2::new(radius, radius);
        let ((x0, y0), (x1, y1)) = (self.key(p - reach), self.key(p + reach));
        (x0..=x1).any(|x| {
            (y0..=y1).any(|y| self.cells.get(&(x, y)).into_iter().flatten().any(|(q, _)| (q - p).norm() <= radius))
        })
    }

    /// Puts the point in unless one within `radius` is there; was it new?
    pub fn insert_new(&mut self, p: Vec2, id: usize, radius: f64) -> bool {
        let new = !self.has(p, radius);
        if new {
            self.insert(p, id);
        }
        new
    }
}

/// How deep two segments must pass through each other to count as crossing, mm: doubled and zero-width lines of real
/// files differ by rounding.
const CROSSING_DEPTH: f64 = 0.02;

/// Outcome of a test for crossings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Crossing {
    /// No two segments cross.
    None,
    /// These two do, at this point.
    At(usize, usize, Vec2),
    /// Too many pairs to test.
    TooMany,
}

/// First proper crossing of a closed polygon's segments. Touching, doubled lines and zero-width spikes pass.
#[must_use]
pub fn crossing(points: &[Vec2]) -> Crossing {
    let n = points.len();
    let mut best: Option<(usize, usize, Vec2)> = None;
    let whole = near_pairs(points, 0.0, &mut |j, i| {
        if let Some(p) = segments_cross(points[j], points[(j + 1) % n], points[i], points[(i + 1) % n])
            && best.is_none_or(|(bj, bi, _)| (j, i) < (bj, bi))
        {
            best = Some((j, i, p));
        }
    });
    if !whole {
        return Crossing::TooMany;
    }
    best.map_or(Crossing::None, |(j, i, p)| Crossing::At(j, i, p))
}

/// Visits all pairs `j < i` of segments of a closed polygon that come within about `reach` of each other, some of them
/// more than once. `false` when they are too many.
pub(crate) fn near_pairs(points: &[Vec2], reach: f64, visit: &mut dyn FnMut(usize, usize)) -> bool {
    let n = points.len();
    let Some((lo, hi)) = bounds(points.iter().copied()) else { return true };
    let side = libm::sqrt(n as f64).clamp(1.0, 512.0);
    let cell = ((hi.x - lo.x).max(hi.y - lo.y) / side).max(1e-6);
    let key = |v: f64, low: f64| ((v - low) / cell).floor() as i64;
    let pad = 1e-6 + reach;
    let mut cells: BTreeMap<(i64, i64), Vec<usize>> = BTreeMap::new();
    let mut tests = 0_u64;
    for i in 0..n {
        let (a, b) = (points[i], points[(i + 1) % n]);
        let (x0, x1) = (key(a.x.min(b.x) - reach, lo.x), key(a.x.max(b.x) + reach, lo.x));
        for x in x0..=x1 {
            // Only the cells of this column that the segment really passes.
            let (left, right) = (lo.x + x as f64 * cell, lo.x + (x + 1) as f64 * cell);
            let (ya, yb) = clip(a, b, left - reach, right + reach);
            for y in key(ya.min(yb) - pad, lo.y)..=key(ya.max(yb) + pad, lo.y) {
                let others = cells.entry((x, y)).or_default();
                tests += others.len() as u64;
                if tests > limits::CROSSING_TESTS {
                    return false;
                }
                for &j in others.iter() {
                    visit(j, i);
                }
                if others.last() != Some(&i) {
                    others.push(i);
                }
            }
        }
    }
    true
}

fn clip(a: Vec2, b: Vec2, left: f64, right: f64) -> (f64, f64) {
    let dx = b.x - a.x;
    if dx.abs() < 1e-12 {
        return (a.y, b.y);
    }
    let at = |x: f64| a.y + (b.y - a.y) * ((x - a.x) / dx).clamp(0.0, 1.0);
    (at(left), at(right))
}

fn segments_cross(a: Vec2, b: Vec2, c: Vec2, d: Vec2) -> Option<Vec2> {
    let (u, v) = (b - a, d - c);
    let (lu, lv) = (u.norm(), v.norm());
    if lu < CROSSING_DEPTH || lv < CROSSING_DEPTH {
        return None;
    }
    let (ca, cb) = (cross(v, a - c) / lv, cross(v, b - c) / lv);
    let (ac, ad) = (cross(u, c - a) / lu, cross(u, d - a) / lu);
    let opposite = |p: f64, q: f64| p * q < 0.0 && p.abs().min(q.abs()) > CROSSING_DEPTH;
    (opposite(ca, cb) && opposite(ac, ad)).then(|| a + u * (ca / (ca - cb)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn v(list: &[(f64, f64)]) -> Vec<Vec2> {
        list.iter().map(|(x, y)| Vec2::new(*x, *y)).collect()
    }

    #[test]
    fn bow_tie_crosses_in_the_middle() {
        let bow = v(&[(0.0, 0.0), (300.0, 600.0), (300.0, 0.0), (0.0, 600.0)]);
        assert_eq!(crossing(&bow), Crossing::At(0, 2, Vec2::new(150.0, 300.0)));
    }

    #[test]
    fn spikes_and_touching_pass() {
        let spike =
            v(&[(0.0, 0.0), (100.0, 0.0), (100.0, 50.0), (90.0, 50.0), (100.0, 50.0), (100.0, 100.0), (0.0, 100.0)]);
        assert_eq!(crossing(&spike), Crossing::None);
        let touch = v(&[(0.0, 0.0), (100.0, 0.0), (50.0, 50.0), (100.0, 100.0), (0.0, 100.0), (50.0, 50.0)]);
        assert_eq!(crossing(&touch), Crossing::None);
    }

    #[test]
    fn long_polygon_is_fast_and_found() {
        let n = 20_000;
        let mut wave: Vec<Vec2> =
            (0..n).map(|i| Vec2::new(f64::from(i) * 0.1, if i % 2 == 0 { 0.0 } else { 500.0 })).collect();
        wave.push(Vec2::new(2000.0, -10.0));
        wave.push(Vec2::new(0.0, -10.0));
        assert_eq!(crossing(&wave), Crossing::None);
        wave.insert(10_000, Vec2::new(1000.0, -20.0));
        assert!(matches!(crossing(&wave), Crossing::At(..)));
    }

    #[test]
    fn deviation_is_the_largest_of_all_distances() {
        let wave = |n: usize, k: f64| -> Vec<Vec2> {
            (0..n).map(|i| i as f64 / n as f64).map(|t| Vec2::new(500.0 * t, k * libm::sin(40.0 * t))).collect()
        };
        let (a, b) = (wave(700, 31.0), wave(333, 30.0));
        for closed in [true, false] {
            let plain = a.iter().map(|p| distance(*p, &b, closed)).fold(0.0, f64::max);
            assert_eq!(deviation(&a, &b, closed), plain);
        }
        assert_eq!(deviation(&a, &b[..1], false), f64::INFINITY);
    }

    #[test]
    fn mirror_and_nearest() {
        assert!(
            (mirror(Vec2::new(3.0, 1.0), Vec2::zeros(), Vec2::new(0.0, 5.0)) - Vec2::new(-3.0, 1.0)).norm() < 1e-12
        );
        let square = v(&[(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)]);
        let foot = nearest(Vec2::new(-2.0, 5.0), &square, true).expect("foot");
        assert_eq!((foot.segment, foot.t, foot.distance), (3, 0.5, 2.0));
        assert!(inside(Vec2::new(5.0, 5.0), &square) && !inside(Vec2::new(11.0, 5.0), &square));
    }
}
