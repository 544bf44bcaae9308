//! Half of a piece that is symmetric about its fold line.

use super::codes;
use super::model::{DrawLine, DrawPoint, PieceDrawing};
use toile_garment::outline::PointKind;
use toile_garment::{Diagnostic, Vec2};

/// Two points this near are one, mm.
const SAME: f64 = 0.02;

/// Keeps what lies to the left of the fold, and draws the fold line. A piece that is not symmetric stays whole, with
/// a finding.
pub fn half(drawing: PieceDrawing, fold: [Vec2; 2], findings: &mut Vec<Diagnostic>) -> PieceDrawing {
    let Some(axis) = Axis::new(fold) else { return drawing };
    let lines: Vec<_> = drawing.lines().map(|(_, l)| l).collect();
    let marks: Vec<_> = drawing.notches.iter().map(|n| n.at).chain(drawing.drill_holes.iter().map(|d| d.at)).collect();
    let symmetric = axis.mirrors(&lines.iter().flat_map(|l| l.points.iter().map(|p| p.at)).collect::<Vec<_>>())
        && axis.mirrors(&marks);
    let boundary = axis.cut(&drawing.boundary);
    let (Some((boundary, ends)), true) = (boundary, symmetric) else {
        findings.push(
            Diagnostic::warning(
                codes::FOLD_NOT_SYMMETRIC,
                format!(
                    "piece `{}` is not the mirror image of itself about its fold: it is written whole",
                    drawing.name
                ),
            )
            .hint("take the fold line away, or draw the other half"),
        );
        return drawing;
    };
    let sew_line = drawing.sew_line.as_ref().and_then(|l| axis.cut(l)).map(|(mut line, _)| {
        line.closed = false;
        line
    });
    let keep = |line: &DrawLine| line.points.iter().all(|p| axis.side(p.at) > -SAME);
    PieceDrawing {
        boundary,
        sew_line,
        internal: drawing.internal.iter().filter(|l| keep(l)).cloned().collect(),
        cutouts: drawing.cutouts.iter().filter(|l| keep(l)).cloned().collect(),
        notches: drawing.notches.iter().filter(|n| axis.side(n.at) > -SAME).copied().collect(),
        drill_holes: drawing.drill_holes.iter().filter(|d| axis.side(d.at) > -SAME).copied().collect(),
        stripes: drawing.stripes.iter().filter(|(_, l)| keep(l)).cloned().collect(),
        rules: drawing.rules.iter().filter(|r| axis.side(r.at) > -SAME).copied().collect(),
        fold: Some(ends),
        ..drawing
    }
}

struct Axis {
    from: Vec2,
    along: Vec2,
}

impl Axis {
    fn new([from, to]: [Vec2; 2]) -> Option<Self> {
        let d = to - from;
        (d.norm() > 1e-6).then(|| Self { from, along: d / d.norm() })
    }

    /// Distance to the left of the axis.
    fn side(&self, p: Vec2) -> f64 {
        let d = p - self.from;
        self.along.x * d.y - self.along.y * d.x
    }

    fn mirror(&self, p: Vec2) -> Vec2 {
        let left = Vec2::new(-self.along.y, self.along.x);
        p - left * (2.0 * self.side(p))
    }

    /// Has every point its twin?
    fn mirrors(&self, points: &[Vec2]) -> bool {
        let mut sorted: Vec<_> = points.to_vec();
        sorted.sort_by(|a, b| a.x.total_cmp(&b.x));
        points.iter().all(|p| {
            let twin = self.mirror(*p);
            let first = sorted.partition_point(|q| q.x < twin.x - SAME);
            sorted.iter().skip(first).take_while(|q| q.x <= twin.x + SAME).any(|q| (q.y - twin.y).abs() <= SAME)
        })
    }

    /// The part of a closed line to the left of the axis, starting and ending on it, and these two ends.
    /// `None` when the line does not cross the axis exactly twice.
    fn cut(&self, line: &DrawLine) -> Option<(DrawLine, [Vec2; 2])> {
        let mut points = self.with_crossings(line);
        let on: Vec<_> =
            (0..points.len()).filter(|i| self.side(points.get(*i).map_or(self.from, |p| p.at)).abs() <= SAME).collect();
        let &[a, b] = on.as_slice() else { return None };
        let between = points.get(a + 1).is_some_and(|p| b > a + 1 && self.side(p.at) > 0.0);
        let length = if between { b - a + 1 } else { points.len() - b + a + 1 };
        points.rotate_left(if between { a } else { b });
        points.truncate(length);
        if length < 3 {
            return None;
        }
        points.first_mut()?.kind = PointKind::Turn;
        points.last_mut()?.kind = PointKind::Turn;
        let ends = [points.last()?.at, points.first()?.at];
        Some((DrawLine { points, closed: true, dense: None }, ends))
    }

    /// The points of a closed line, with those where a segment crosses the axis.
    fn with_crossings(&self, line: &DrawLine) -> Vec<DrawPoint> {
        let mut out = Vec::with_capacity(line.points.len() + 2);
        let next = line.points.iter().cycle().skip(1);
        for (p, q) in line.points.iter().zip(next) {
            out.push(*p);
            let (s, t) = (self.side(p.at), self.side(q.at));
            if s.abs() > SAME && t.abs() > SAME && (s > 0.0) != (t > 0.0) {
                out.push(DrawPoint { at: p.at + (q.at - p.at) * (s / (s - t)), kind: PointKind::Turn });
            }
        }
        out
    }
}
