//! Half of a piece that is symmetric about its fold line.

use super::codes;
use super::model::{DrawLine, DrawPoint, LayerText, PieceDrawing};
use toile_garment::outline::PointKind;
use toile_garment::{Diagnostic, Vec2};

/// Two points this near are one, mm.
const SAME: f64 = 0.02;

/// Keeps what lies to the left of the fold, and draws the fold line. A piece that is not symmetric stays whole, with
/// a finding.
pub fn half(drawing: PieceDrawing, fold: [Vec2; 2], findings: &mut Vec<Diagnostic>) -> PieceDrawing {
    let Some(axis) = Axis::new(fold) else { return drawing };
    // Internal lines need not be mirrored; everything else must be.
    let inner = drawing.cutouts.iter().chain(&drawing.boundary_cutouts);
    let lines: Vec<_> = std::iter::once(&drawing.boundary).chain(&drawing.sew_line).chain(inner).collect();
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
    let keep = |lines: &[DrawLine]| axis.without_images(lines).into_iter().cloned().collect();
    let (internal, texts) = axis.half_of_lines(&drawing);
    PieceDrawing {
        boundary,
        sew_line,
        internal,
        texts,
        boundary_cutouts: keep(&drawing.boundary_cutouts),
        cutouts: keep(&drawing.cutouts),
        notches: drawing.notches.iter().filter(|n| axis.side(n.at) > -SAME).copied().collect(),
        drill_holes: drawing.drill_holes.iter().filter(|d| axis.side(d.at) > -SAME).copied().collect(),
        stripes: axis.stripes(&drawing.stripes),
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

    /// The place of the mirror image of a line among the others.
    fn image_of(&self, i: usize, lines: &[&DrawLine]) -> Option<usize> {
        (0..lines.len()).find(|j| *j != i && self.is_image(lines[i], lines[*j]))
    }

    /// Does the half hold this line? Of a line and its mirror image it holds the one that lies more to the left, and
    /// every line without an image: nothing is lost.
    fn holds(&self, i: usize, lines: &[&DrawLine]) -> bool {
        let Some(image) = self.image_of(i, lines) else { return true };
        let to_left: f64 = lines[i].points.iter().map(|p| self.side(p.at)).sum();
        if to_left.abs() > SAME { to_left > 0.0 } else { i < image }
    }

    /// The lines that the half holds.
    fn without_images<'a>(&self, lines: &'a [DrawLine]) -> Vec<&'a DrawLine> {
        let all: Vec<&DrawLine> = lines.iter().collect();
        (0..all.len()).filter(|i| self.holds(*i, &all)).map(|i| all[i]).collect()
    }

    /// The stripes that the half holds, each with its layer.
    fn stripes(&self, stripes: &[(&'static str, DrawLine)]) -> Vec<(&'static str, DrawLine)> {
        let all: Vec<&DrawLine> = stripes.iter().map(|s| &s.1).collect();
        (0..all.len()).filter(|i| self.holds(*i, &all)).map(|i| stripes[i].clone()).collect()
    }

    /// The internal lines of the half, and the texts of the piece. A line without an image, and not on the axis, stays
    /// as it is; the text `NM` (not mirrored) at its start says so.
    fn half_of_lines(&self, drawing: &PieceDrawing) -> (Vec<DrawLine>, Vec<LayerText>) {
        let (mut kept, mut texts) = (Vec::new(), drawing.texts.clone());
        let lines: Vec<&DrawLine> = drawing.internal.iter().collect();
        for (i, line) in lines.iter().enumerate().filter(|(i, _)| self.holds(*i, &lines)) {
            kept.push((*line).clone());
            let is_alone = self.image_of(i, &lines).is_none();
            let on_axis = line.points.iter().all(|p| self.side(p.at).abs() <= SAME);
            let Some(start) = line.points.first().filter(|_| is_alone && !on_axis) else { continue };
            let marked = texts.iter().any(|t| t.text.eq_ignore_ascii_case("nm") && (t.at - start.at).norm() <= SAME);
            if !marked {
                texts.push(LayerText { at: start.at, layer: "8".into(), text: "NM".into() });
            }
        }
        (kept, texts)
    }

    /// Is line `b` the mirror image of line `a`, drawn either way?
    fn is_image(&self, a: &DrawLine, b: &DrawLine) -> bool {
        let n = a.points.len();
        let image: Vec<Vec2> = a.points.iter().map(|p| self.mirror(p.at)).collect();
        let same = |i: usize, j: usize| (image[i] - b.points[j].at).norm() <= SAME;
        let along = |shift: usize| (0..n).all(|i| same(i, (i + shift) % n));
        let back = |shift: usize| (0..n).all(|i| same(i, (shift + n - i) % n));
        let shifts = if a.closed { 0..n } else { 0..1 };
        let ends = if a.closed { 0..n } else { n.saturating_sub(1)..n };
        n == b.points.len()
            && a.closed == b.closed
            && n > 0
            && (shifts.into_iter().any(along) || ends.into_iter().any(back))
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
        let copy = |fine: &Vec<Vec2>| {
            let points = fine.iter().map(|at| DrawPoint { at: *at, kind: PointKind::Plain }).collect();
            let (half, _) = self.cut(&DrawLine { points, closed: true, dense: None })?;
            Some(half.points.iter().map(|p| p.at).collect())
        };
        Some((DrawLine { points, closed: true, dense: line.dense.as_ref().and_then(copy) }, ends))
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
