//! Which vertices of a curve stand on layers 1 and 14.
//!
//! A line that was read holds the pattern's own curve points and, between them, the points of the smooth curve. If all
//! stood on layer 1 beside curve points on layer 3, a reader would smooth the smoothed curve once more. So the curve
//! points alone are written, as they came, wherever a reader makes the same curve of them.

use super::model::{DrawLine, DrawPoint};
use crate::dxf::geom;
use crate::dxf::outline::{Node, between};
use toile_garment::Vec2;
use toile_garment::outline::PointKind;

/// The curve through the curve points keeps this near the line, mm, where no dense copy stands beside it.
pub(crate) const CLOSE: f64 = 0.5;
/// The same with a dense copy, which a reader takes up to this, mm.
const CLOSE_TO_COPY: f64 = 2.0;
/// Chords keep this near the curve, mm.
const FLATNESS: f64 = 0.05;

/// The vertices to be written, and what that costs.
pub(crate) struct Sparse {
    /// The vertices.
    pub points: Vec<DrawPoint>,
    /// Curve points that became plain vertices: the curve through them would leave the line.
    pub lost: usize,
    /// How far the curve that a reader makes lies off the line, mm.
    pub off: f64,
}

/// A line as it is written, and what that costs.
pub(crate) struct Fitted {
    /// The line.
    pub line: DrawLine,
    /// Curve points that became plain vertices.
    pub lost: usize,
    /// How far the curve that a reader makes lies off the line, mm.
    pub off: f64,
}

/// The line as the dialect holds it.
pub(crate) fn fitted(line: &DrawLine, has_dense_layer: bool) -> Fitted {
    if let Some(fine) = &line.dense {
        let off = if has_dense_layer { 0.0 } else { apart(&smooth(&line.points, line.closed), fine, line.closed) };
        let line = DrawLine { dense: line.dense.clone().filter(|_| has_dense_layer), ..line.clone() };
        return Fitted { line, lost: 0, off };
    }
    let made = sparse(&line.points, line.closed, if has_dense_layer { CLOSE_TO_COPY } else { CLOSE });
    let thinner = has_dense_layer && made.points.len() < line.points.len();
    let dense = thinner.then(|| line.points.iter().map(|p| p.at).collect());
    let off = if has_dense_layer { 0.0 } else { made.off };
    Fitted { line: DrawLine { points: made.points, closed: line.closed, dense }, lost: made.lost, off }
}

/// The vertices without the points of smooth curves, as far as a curve through the others keeps within `most` mm. A run
/// for which it does not is a polygon of all its vertices.
pub(crate) fn sparse(line: &[DrawPoint], closed: bool, most: f64) -> Sparse {
    let mut out = Sparse { points: Vec::with_capacity(line.len()), lost: 0, off: 0.0 };
    for run in runs(line, closed) {
        let is_curve = |p: &DrawPoint| p.kind == PointKind::Curve;
        let last = run.len() - 1;
        let mut written = run[..last].to_vec();
        if run[1..last].iter().any(is_curve) {
            let own = |(i, p): (usize, &DrawPoint)| (i == 0 || i == last || p.kind != PointKind::Plain).then_some(*p);
            let kept: Vec<DrawPoint> = run.iter().enumerate().filter_map(own).collect();
            let at: Vec<Vec2> = run.iter().map(|p| p.at).collect();
            let off = apart(&smooth_run(&kept), &at, false);
            if off <= most {
                written = kept[..kept.len() - 1].to_vec();
                out.off = out.off.max(off);
            } else {
                out.lost += written.iter().filter(|p| is_curve(p)).count();
                written.iter_mut().filter(|p| is_curve(p)).for_each(|p| p.kind = PointKind::Plain);
            }
        }
        out.points.extend(written);
    }
    if let (false, Some(end)) = (closed, line.last()) {
        out.points.push(*end);
    }
    begin_like(line, &mut out.points, closed);
    out
}

/// A closed line goes on beginning where it began, if that vertex is still there.
fn begin_like(line: &[DrawPoint], points: &mut [DrawPoint], closed: bool) {
    let first = line.iter().find_map(|p| points.iter().position(|q| q.at == p.at));
    if let (true, Some(first)) = (closed, first) {
        points.rotate_left(first);
    }
}

/// The runs from corner to corner, both ends in each; of a closed line without corners one, from its first vertex on.
fn runs(line: &[DrawPoint], closed: bool) -> Vec<Vec<DrawPoint>> {
    let n = line.len();
    if n < 2 {
        return Vec::new();
    }
    let first = line.iter().position(|p| p.kind == PointKind::Turn).filter(|_| closed).unwrap_or(0);
    let steps = if closed { n } else { n - 1 };
    let mut out = Vec::new();
    let mut run = vec![line[first]];
    for k in 1..=steps {
        let point = line[(first + k) % n];
        run.push(point);
        if point.kind == PointKind::Turn || k == steps {
            out.push(std::mem::replace(&mut run, vec![point]));
        }
    }
    out
}

/// The curve that a reader makes of the vertices of a run.
fn smooth_run(run: &[DrawPoint]) -> Vec<Vec2> {
    let nodes: Vec<Node> = run.iter().map(|p| Node { at: p.at, kind: p.kind, drawn: true }).collect();
    let mut out = vec![run[0].at];
    for (inner, end) in between(&nodes, FLATNESS).into_iter().zip(&run[1..]) {
        out.extend(inner);
        out.push(end.at);
    }
    out
}

/// The curve that a reader makes of all vertices.
fn smooth(line: &[DrawPoint], closed: bool) -> Vec<Vec2> {
    let mut out: Vec<Vec2> = Vec::new();
    for run in runs(line, closed) {
        let curve = smooth_run(&run);
        out.extend(curve.iter().take(curve.len() - 1));
    }
    out.extend(line.last().filter(|_| !closed).map(|p| p.at));
    out
}

/// How far two lines are apart, mm.
fn apart(a: &[Vec2], b: &[Vec2], closed: bool) -> f64 {
    geom::deviation(a, b, closed).max(geom::deviation(b, a, closed))
}
