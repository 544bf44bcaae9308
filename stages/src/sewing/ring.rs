//! A closed line of a piece as it is meshed and sewn, measured by arc length.
//!
//! In the outer ring every wedge dart is notched out, also those that are only marked: the walk goes down one leg and
//! up the other. The stretch between the two mouth points is a [`Gap`]: a seam that runs over it skips it.

use toile_garment::Vec2;
use toile_garment::dart::DartKind;

/// Positions nearer than this are one (0.001 mm).
pub const SAME: f64 = 1e-6;
/// Coordinates are snapped to this grid (0.0001 mm), so that equality is exact.
pub const GRID: f64 = 1e-7;
/// A spike narrower than this is drawn by mistake (0.02 mm).
const SPIKE: f64 = 2e-5;

/// A dart's or pleat's intake on a ring.
#[derive(Clone, Debug, PartialEq)]
pub struct Gap {
    /// Index of the dart in the piece.
    pub dart: usize,
    /// Its kind.
    pub kind: DartKind,
    /// Ring point of the mouth met first, walking forward.
    pub from: usize,
    /// Ring point of the apex; none for pleats, whose intake stays.
    pub apex: Option<usize>,
    /// Ring point of the other mouth.
    pub to: usize,
    /// Is `from` the second mouth point of the dart?
    pub swapped: bool,
}

/// A closed line with arc length.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ring {
    /// Points in order; the first is not repeated.
    pub points: Vec<Vec2>,
    /// Arc position of every point, and the total at the end.
    pub arc: Vec<f64>,
    /// For every vertex of the drawn line the ring point it became; none when a dart's mouth swallowed it.
    pub of_line: Vec<Option<usize>>,
    /// Intakes, in walking order.
    pub gaps: Vec<Gap>,
}

/// The grid point nearest to a point.
#[must_use]
pub fn snap(p: Vec2) -> Vec2 {
    Vec2::new((p.x / GRID).round() * GRID, (p.y / GRID).round() * GRID)
}

/// Drops repeated points and hair spikes, snaps to the grid. Second: the kept index of every input point.
#[must_use]
pub fn clean(points: &[Vec2]) -> (Vec<Vec2>, Vec<usize>) {
    let mut kept: Vec<(Vec2, usize)> = Vec::with_capacity(points.len());
    let mut target: Vec<usize> = (0..points.len()).collect();
    for (i, p) in points.iter().enumerate() {
        let p = snap(*p);
        match kept.last() {
            Some((q, k)) if (p - q).norm() < SAME => target[i] = *k,
            _ => kept.push((p, i)),
        }
    }
    while kept.len() > 1 && (kept[0].0 - kept[kept.len() - 1].0).norm() < SAME {
        if let Some((_, i)) = kept.pop() {
            target[i] = kept[0].1;
        }
    }
    drop_spikes(&mut kept, &mut target);
    let mut place = vec![usize::MAX; points.len()];
    for (k, (_, i)) in kept.iter().enumerate() {
        place[*i] = k;
    }
    let map = (0..points.len()).map(|i| follow(i, &target, &place)).collect();
    (kept.into_iter().map(|(p, _)| p).collect(), map)
}

/// Follows dropped points to the one that stands for them.
fn follow(i: usize, target: &[usize], place: &[usize]) -> usize {
    let mut at = i;
    for _ in 0..target.len() {
        if place[at] != usize::MAX || target[at] == at {
            break;
        }
        at = target[at];
    }
    if place[at] == usize::MAX { 0 } else { place[at] }
}

fn drop_spikes(kept: &mut Vec<(Vec2, usize)>, target: &mut [usize]) {
    let mut i = 0;
    let mut clean_steps = 0;
    while kept.len() > 3 && clean_steps < kept.len() {
        let n = kept.len();
        i %= n;
        let (before, tip, after) = (kept[(i + n - 1) % n], kept[i], kept[(i + 1) % n]);
        if is_spike(before.0, tip.0, after.0) {
            target[tip.1] = before.1;
            kept.remove(i);
            if (before.0 - after.0).norm() < SPIKE {
                let at = if i == kept.len() { 0 } else { i };
                target[after.1] = before.1;
                kept.remove(at);
            }
            i = (i + kept.len()).saturating_sub(2);
            clean_steps = 0;
        } else {
            i += 1;
            clean_steps += 1;
        }
    }
}

/// Does the walk turn back at `tip` within a hair?
fn is_spike(before: Vec2, tip: Vec2, after: Vec2) -> bool {
    let (u, v) = (tip - before, after - tip);
    let (lu, lv) = (u.norm(), v.norm());
    if lu < SAME || lv < SAME || u.dot(&v) >= 0.0 {
        return false;
    }
    // Width where the shorter side ends.
    let cross = (u.x * v.y - u.y * v.x).abs();
    cross / lu.max(lv) < SPIKE
}

impl Ring {
    /// A ring through points that are clean.
    #[must_use]
    pub fn new(points: Vec<Vec2>, of_line: Vec<Option<usize>>) -> Self {
        let arc = arcs(&points, true);
        Self { points, arc, of_line, gaps: Vec::new() }
    }

    /// A ring through the points of a drawn line.
    #[must_use]
    pub fn from_line(points: &[Vec2]) -> Self {
        let (points, map) = clean(points);
        Self::new(points, map.into_iter().map(Some).collect())
    }

    /// The ring around an open line: along it and back.
    #[must_use]
    pub fn around(line: &[Vec2]) -> Self {
        let mut points: Vec<Vec2> = line.iter().map(|p| snap(*p)).collect();
        points.dedup_by(|a, b| (*a - *b).norm() < SAME);
        let back: Vec<Vec2> = points.iter().rev().skip(1).take(points.len().saturating_sub(2)).copied().collect();
        points.extend(back);
        Self::new(points, Vec::new())
    }

    /// The points of the line that the ring goes around.
    #[must_use]
    pub fn line(&self) -> &[Vec2] {
        &self.points[..self.points.len().min(self.points.len() / 2 + 1)]
    }

    /// Length of the whole ring, metres.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.arc.last().copied().unwrap_or(0.0)
    }

    /// Distance walking forward from one position to another, in `[0, total)`.
    #[must_use]
    pub fn ahead(&self, from: f64, to: f64) -> f64 {
        let total = self.total();
        if total <= 0.0 {
            return 0.0;
        }
        let d = (to - from).rem_euclid(total);
        if d >= total || total - d < SAME { 0.0 } else { d }
    }

    /// Length of the line without the intakes on it, metres.
    #[must_use]
    pub fn without_gaps(&self) -> f64 {
        let taken = self.gaps.iter().map(|g| self.ahead(self.arc[g.from], self.arc[g.to]));
        self.total() - taken.sum::<f64>()
    }

    /// The point at an arc position; positions beyond the ends wrap.
    #[must_use]
    pub fn at(&self, s: f64) -> Vec2 {
        let n = self.points.len();
        let s = if self.total() > 0.0 { s.rem_euclid(self.total()) } else { 0.0 };
        let i = self.arc.partition_point(|a| *a <= s).clamp(1, n) - 1;
        along(self.points[i], self.points[(i + 1) % n], self.arc[i], self.arc[i + 1], s)
    }

    /// Nearest position on the ring and its distance.
    #[must_use]
    pub fn project(&self, p: Vec2) -> (f64, f64) {
        nearest_on(&self.points, &self.arc, true, p)
    }

    /// Sewn length walking forward: intakes that lie wholly between are left out.
    #[must_use]
    pub fn sewn_ahead(&self, from: f64, to: f64) -> f64 {
        let d = self.ahead(from, to);
        d - self.gaps_between(from, d).iter().map(|(start, end, _)| end - start).sum::<f64>()
    }

    /// Arc position after a sewn length walking forward; intakes on the way are skipped.
    #[must_use]
    pub fn after_sewn(&self, from: f64, length: f64) -> f64 {
        let mut way = length;
        for (start, end, _) in self.gaps_between(from, self.total()) {
            if way <= start + SAME {
                break;
            }
            way += end - start;
        }
        let total = self.total();
        if total > 0.0 { (from + way).rem_euclid(total) } else { from }
    }

    /// Gaps wholly inside a forward walk of length `d`: start, end (distances from the start of the walk), gap.
    #[must_use]
    pub fn gaps_between(&self, from: f64, d: f64) -> Vec<(f64, f64, &Gap)> {
        let mut out: Vec<_> = self
            .gaps
            .iter()
            .filter_map(|g| {
                let start = self.ahead(from, self.arc[g.from]);
                let end = start + self.ahead(self.arc[g.from], self.arc[g.to]);
                (end <= d + SAME).then_some((start, end, g))
            })
            .collect();
        out.sort_by(|a, b| a.0.total_cmp(&b.0));
        out
    }

    /// The gap that has this position strictly inside.
    #[must_use]
    pub fn gap_around(&self, s: f64) -> Option<&Gap> {
        self.gaps.iter().find(|g| {
            let (start, end) = (self.arc[g.from], self.arc[g.to]);
            let x = self.ahead(start, s);
            x > SAME && x < self.ahead(start, end) - SAME
        })
    }
}

/// Arc positions of points; one more at the end when closed.
#[must_use]
pub fn arcs(points: &[Vec2], closed: bool) -> Vec<f64> {
    let n = points.len();
    let mut arc = Vec::with_capacity(n + 1);
    let mut s = 0.0;
    for i in 0..n {
        arc.push(s);
        if closed || i + 1 < n {
            s += (points[(i + 1) % n] - points[i]).norm();
        }
    }
    if closed {
        arc.push(s);
    }
    arc
}

/// The point of a segment at an arc position.
#[must_use]
pub fn along(a: Vec2, b: Vec2, arc_a: f64, arc_b: f64, s: f64) -> Vec2 {
    let span = arc_b - arc_a;
    if span <= 0.0 || s <= arc_a {
        return a;
    }
    a + (b - a) * ((s - arc_a) / span).clamp(0.0, 1.0)
}

/// Nearest position on a polyline and its distance.
#[must_use]
pub fn nearest_on(points: &[Vec2], arc: &[f64], closed: bool, p: Vec2) -> (f64, f64) {
    let n = points.len();
    let mut best = (0.0, f64::INFINITY);
    if let [only] = points {
        return (0.0, (p - only).norm());
    }
    let segments = if closed { n } else { n.saturating_sub(1) };
    for i in 0..segments {
        let (a, b) = (points[i], points[(i + 1) % n]);
        let d = b - a;
        let length2 = d.norm_squared();
        let t = if length2 > 0.0 { ((p - a).dot(&d) / length2).clamp(0.0, 1.0) } else { 0.0 };
        let distance = (p - (a + d * t)).norm();
        if distance < best.1 {
            best = (arc[i] + t * length2.sqrt(), distance);
        }
    }
    if closed && arc.last().is_some_and(|total| best.0 >= *total) {
        best.0 = 0.0;
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(list: &[(f64, f64)]) -> Vec<Vec2> {
        list.iter().map(|(x, y)| Vec2::new(*x, *y)).collect()
    }

    #[test]
    fn walks_by_arc_length() {
        let ring = Ring::from_line(&points(&[(0.0, 0.0), (3.0, 0.0), (3.0, 4.0), (0.0, 4.0)]));
        assert_eq!(ring.total(), 14.0);
        assert_eq!(ring.at(5.0), Vec2::new(3.0, 2.0));
        assert_eq!(ring.at(-1.0), Vec2::new(0.0, 1.0));
        assert_eq!(ring.ahead(13.0, 2.0), 3.0);
        let (s, d) = ring.project(Vec2::new(1.0, -0.5));
        assert_eq!((s, d), (1.0, 0.5));
    }

    #[test]
    fn cleans_doubles_and_spikes() {
        let (kept, map) = clean(&points(&[
            (0.0, 0.0),
            (0.0, 0.0),
            (1.0, 0.0),
            (1.0, 0.5),
            (1.5, 0.500_005),
            (1.0, 0.500_01),
            (1.0, 1.0),
            (0.0, 1.0),
            (0.0, 1e-8),
        ]));
        assert_eq!(kept.len(), 5, "{kept:?}");
        assert_eq!(map[1], 0);
        assert_eq!(map[8], 0);
        assert!(map.iter().all(|m| *m < kept.len()));
    }
}
