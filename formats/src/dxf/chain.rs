//! Runs chained into closed lines.

use super::geom::{self, PointIndex};
use std::collections::BTreeMap;
use toile_garment::Vec2;

/// Ends this near each other are one point, mm.
pub const JOIN: f64 = 0.06;
/// Vertices this near each other, in a row, are one vertex, mm.
const SAME: f64 = 0.004;

/// A line as drawn, in mm. `true` marks vertices of the file, `false` points of flattened curves.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Entity numbers it came from.
    pub ids: Vec<u32>,
    /// Line of the first one.
    pub line: u64,
    /// Points.
    pub points: Vec<(Vec2, bool)>,
    /// Closed by flag or by chaining; the first point is then not repeated.
    pub closed: bool,
}

impl Path {
    /// Positions only.
    #[must_use]
    pub fn positions(&self) -> Vec<Vec2> {
        self.points.iter().map(|p| p.0).collect()
    }

    fn ends(&self) -> (Vec2, Vec2) {
        let first = self.points.first().map_or(Vec2::zeros(), |p| p.0);
        (first, self.points.last().map_or(first, |p| p.0))
    }

    /// Drops repeated vertices and closes a line that ends where it began.
    #[must_use]
    pub fn tidy(mut self) -> Self {
        let mut points: Vec<(Vec2, bool)> = Vec::with_capacity(self.points.len());
        for p in self.points {
            match points.last_mut() {
                Some(last) if (last.0 - p.0).norm() <= SAME => last.1 |= p.1,
                _ => points.push(p),
            }
        }
        let near = |points: &[(Vec2, bool)]| (points[0].0 - points[points.len() - 1].0).norm() <= JOIN;
        if points.len() >= 4 && near(&points) {
            self.closed = true;
        }
        while self.closed && points.len() >= 2 && near(&points) {
            points.pop();
        }
        self.points = points;
        self
    }
}

/// A gap that was closed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// Width, mm.
    pub width: f64,
    /// Place, mm.
    pub at: Vec2,
}

/// The lines that chaining made of the runs.
#[derive(Clone, Debug, Default)]
pub struct Chained {
    /// Closed lines.
    pub closed: Vec<Path>,
    /// Lines that stayed open.
    pub open: Vec<Path>,
    /// Gaps wider than [`JOIN`] that were closed.
    pub gaps: Vec<Gap>,
    /// Entities that repeat another line point by point.
    pub doubled: Vec<u32>,
}

/// Chains runs end to end, in order where the file's order fits, reversing where needed. Gaps up to `gap` mm are
/// closed.
#[must_use]
pub fn chain(paths: Vec<Path>, gap: f64) -> Chained {
    let mut out = Chained::default();
    let (closed, mut open): (Vec<Path>, Vec<Path>) =
        paths.into_iter().map(Path::tidy).filter(|p| p.points.len() >= 2).partition(|p| p.closed);
    out.closed = distinct(closed, &mut out.doubled);
    open = distinct(open, &mut out.doubled);
    for tolerance in [JOIN, gap.max(JOIN)] {
        let (closed, rest, gaps) = join(open, tolerance);
        out.closed.extend(closed);
        out.gaps.extend(gaps);
        open = rest;
    }
    out.open = open;
    out
}

/// Drops lines that repeat another one. An open run that comes back the same way is a slit, not a repeat.
fn distinct(paths: Vec<Path>, doubled: &mut Vec<u32>) -> Vec<Path> {
    let grid = |p: Vec2| ((p.x * 100.0).round() as i64, (p.y * 100.0).round() as i64);
    let mut seen: BTreeMap<_, Vec<usize>> = BTreeMap::new();
    let mut out: Vec<Path> = Vec::with_capacity(paths.len());
    for path in paths {
        let (a, b) = path.ends();
        let (a, b) = if path.closed { (grid(a), grid(a)) } else { (grid(a), grid(b)) };
        let alike = seen.entry((a, b, path.points.len())).or_default();
        if alike.iter().any(|i| repeats(&path, &out[*i])) {
            doubled.extend(&path.ids);
        } else {
            alike.push(out.len());
            out.push(path);
        }
    }
    out
}

fn repeats(a: &Path, b: &Path) -> bool {
    let n = a.points.len();
    let same = |i: usize, j: usize| (a.points[i].0 - b.points[j].0).norm() <= 0.01;
    n == b.points.len() && ((0..n).all(|i| same(i, i)) || (a.closed && (0..n).all(|i| same(i, (n - i) % n))))
}

fn join(paths: Vec<Path>, tolerance: f64) -> (Vec<Path>, Vec<Path>, Vec<Gap>) {
    let ends = paths.iter().enumerate().flat_map(|(i, p)| [(p.ends().0, 2 * i), (p.ends().1, 2 * i + 1)]);
    let index = PointIndex::new(tolerance, ends);
    let mut slots: Vec<Option<Path>> = paths.into_iter().map(Some).collect();
    let (mut closed, mut open, mut gaps) = (Vec::new(), Vec::new(), Vec::new());
    for first in 0..slots.len() {
        let Some(mut line) = slots[first].take() else { continue };
        let mut last = first;
        let mut turned = false;
        loop {
            if let Some(gap) = closes(&line, tolerance) {
                gaps.extend(gap);
                line.closed = true;
                closed.push(line.tidy());
                break;
            }
            match follower(&line, last, &index, &slots, tolerance) {
                Some((end, d)) => {
                    last = end / 2;
                    let Some(mut next) = slots[last].take() else { break };
                    if end % 2 == 1 {
                        next.points.reverse();
                    }
                    if d > JOIN {
                        gaps.push(Gap { width: d, at: line.ends().1 });
                    }
                    let skip = usize::from(d <= JOIN);
                    line.points.extend(next.points.into_iter().skip(skip));
                    line.ids.extend(next.ids);
                }
                None if !turned => {
                    line.points.reverse();
                    turned = true;
                }
                None => {
                    line.points.reverse();
                    open.push(line);
                    break;
                }
            }
        }
    }
    (closed, open, gaps)
}

fn closes(line: &Path, tolerance: f64) -> Option<Option<Gap>> {
    let (a, b) = line.ends();
    let width = (a - b).norm();
    if line.points.len() < 4 && !(line.points.len() == 3 && width > JOIN) || width > tolerance {
        return None;
    }
    // A short open line is no outline with a small gap.
    if geom::length(&line.positions(), false) < 8.0 * width {
        return None;
    }
    Some((width > JOIN).then_some(Gap { width, at: a }))
}

/// The end to go on with: of the next run in file order if it fits, else of the nearest free one.
fn follower(
    line: &Path,
    last: usize,
    index: &PointIndex,
    slots: &[Option<Path>],
    tolerance: f64,
) -> Option<(usize, f64)> {
    let free: Vec<(f64, usize)> =
        index.near(line.ends().1, tolerance).into_iter().filter(|(_, end)| slots[end / 2].is_some()).collect();
    let next = free.iter().find(|(_, end)| end / 2 == last + 1 && end % 2 == 0);
    next.or_else(|| free.first()).map(|(d, end)| (*end, *d))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(points: &[(f64, f64)]) -> Path {
        let points = points.iter().map(|(x, y)| (Vec2::new(*x, *y), true)).collect();
        Path { ids: vec![0], line: 1, points, closed: false }
    }

    #[test]
    fn runs_in_any_order_and_direction_close() {
        let c = chain(
            vec![
                path(&[(0.0, 0.0), (10.0, 0.0)]),
                path(&[(10.0, 10.0), (10.0, 0.05)]),
                path(&[(0.0, 10.0), (0.0, 0.0)]),
                path(&[(10.0, 10.0), (5.0, 10.0), (0.0, 10.0)]),
            ],
            0.5,
        );
        assert_eq!((c.closed.len(), c.open.len(), c.gaps.len()), (1, 0, 0));
        assert!((geom::area(&c.closed[0].positions()).abs() - 100.0).abs() < 0.5);
        assert_eq!(c.closed[0].points.len(), 5);
    }

    #[test]
    fn small_gap_is_noted_and_wide_gap_stays_open() {
        let square = |end: f64| path(&[(0.0, 0.0), (100.0, 0.0), (100.0, 100.0), (0.0, 100.0), (0.0, end)]);
        let c = chain(vec![square(0.3)], 0.5);
        assert_eq!((c.closed.len(), c.gaps.len()), (1, 1));
        assert!((c.gaps[0].width - 0.3).abs() < 1e-9);
        let c = chain(vec![square(30.0)], 0.5);
        assert_eq!((c.closed.len(), c.open.len()), (0, 1));
    }

    #[test]
    fn repeated_vertices_go_and_closing_vertex_is_not_kept() {
        let c = chain(vec![path(&[(0.0, 0.0), (0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (9.0, 9.0), (0.0, 0.0)])], 0.5);
        assert_eq!(c.closed[0].points.len(), 3);
    }
}
