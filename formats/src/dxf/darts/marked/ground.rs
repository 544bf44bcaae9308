//! The outline on which marked legs end: legs are opened, cut off, divided and put onto it.

use crate::dxf::chain::Path;
use crate::dxf::darts::thresholds::{DISTANCE_OF_EXACT_END, DISTANCE_OF_LEG_END, OVERRUN_OF_LEG, REACH_OF_LEG};
use crate::dxf::geom::{self, Groups};
use toile_garment::Vec2;

/// Where marked legs may end.
pub(super) struct Ground<'a> {
    /// The sewn outline as drawn.
    line: Groups<'a>,
    /// Its working line.
    work: Groups<'a>,
    /// The cut line.
    cut: &'a [Vec2],
}

impl<'a> Ground<'a> {
    pub fn new(line: &'a [Vec2], work: &'a [Vec2], cut: &'a [Vec2]) -> Self {
        Self { line: Groups::new(line, true), work: Groups::new(work, true), cut }
    }

    /// Number of vertices, for limits.
    pub fn size(&self) -> usize {
        self.line.line.len() + self.work.line.len()
    }

    /// Distance from the outline; any number over `DISTANCE_OF_LEG_END` when it is not on it.
    fn off(&self, p: Vec2) -> f64 {
        let limit = 2.0 * DISTANCE_OF_LEG_END;
        self.line.distance_under(p, self.work.distance_under(p, limit))
    }

    pub fn on(&self, p: Vec2) -> bool {
        self.off(p) <= DISTANCE_OF_LEG_END
    }

    /// Outside the sewn outline, but not far past the edge.
    fn past(&self, p: Vec2) -> bool {
        !geom::inside(p, self.line.line)
            && (geom::inside(p, self.cut) || geom::distance(p, self.cut, true) <= OVERRUN_OF_LEG)
    }

    /// The lines a drawn line consists of: each inside, with its ends on the outline where it reaches it.
    pub fn lines(&self, path: &Path) -> Vec<Vec<Vec2>> {
        let line = self.trimmed(self.opened(path));
        let touches: Vec<usize> =
            (1..line.len().saturating_sub(1)).filter(|i| self.off(line[*i]) <= DISTANCE_OF_EXACT_END).collect();
        let starts = std::iter::once(0).chain(touches.iter().copied());
        let ends = touches.iter().copied().chain(line.len().checked_sub(1));
        starts.zip(ends).filter(|(a, b)| a < b).map(|(a, b)| self.fitted(line[a..=b].to_vec())).collect()
    }

    /// A closed triangle whose side lies along the outline, or past it, is the same as its two legs.
    fn opened(&self, path: &Path) -> Vec<Vec2> {
        let mut points = path.positions();
        let n = points.len();
        if path.closed && n >= 3 {
            let side = |test: &dyn Fn(Vec2) -> bool| (0..n).find(|i| test(points[*i]) && test(points[(i + 1) % n]));
            match side(&|p| self.on(p)).or_else(|| side(&|p| self.past(p))) {
                Some(i) => points.rotate_left((i + 1) % n),
                None => return Vec::new(),
            }
        }
        points
    }

    /// A line whose ends lie past the sewn outline, cut off where it crosses.
    fn trimmed(&self, mut line: Vec<Vec2>) -> Vec<Vec2> {
        for _ in 0..2 {
            line.reverse();
            let Some(end) = line.last().copied() else { return line };
            if self.on(end) || !self.past(end) {
                continue;
            }
            let Some(i) = line.iter().rposition(|p| geom::inside(*p, self.line.line)) else { continue };
            if let Some(p) = crossing(line[i], line[i + 1], self.line.line) {
                line.truncate(i + 1);
                line.push(p);
            }
        }
        line
    }

    /// Ends a little beside the outline go where the line meets it.
    fn fitted(&self, mut line: Vec<Vec2>) -> Vec<Vec2> {
        for _ in 0..2 {
            line.reverse();
            let n = line.len();
            let (inner, end) = (line[n - 2], line[n - 1]);
            if !(DISTANCE_OF_EXACT_END..=DISTANCE_OF_LEG_END).contains(&self.off(end))
                || (end - inner).norm() < REACH_OF_LEG
            {
                continue;
            }
            let beyond = end + (end - inner) * (REACH_OF_LEG / (end - inner).norm());
            let near = |p: &Vec2| (p - end).norm() <= REACH_OF_LEG;
            if let Some(p) = crossing(inner, beyond, self.work.line).filter(near) {
                line[n - 1] = p;
            }
        }
        line
    }
}

/// Where the way from `a` to `b` first crosses a closed line.
fn crossing(a: Vec2, b: Vec2, line: &[Vec2]) -> Option<Vec2> {
    (0..line.len())
        .filter_map(|k| geom::meet(a, b, line[k], line[(k + 1) % line.len()]))
        .min_by(|p, q| (p - a).norm().total_cmp(&(q - a).norm()))
}
