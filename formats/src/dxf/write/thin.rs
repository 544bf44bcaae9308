//! Which vertices of a curve stand on layers 1 and 14, and which only in the dense copy.
//!
//! A line that was read holds the pattern's own curve points and, between them, the points of the smooth curve. If all
//! stood on layer 1 beside curve points on layer 3, a reader would smooth the smoothed curve once more.

use super::model::{DrawLine, DrawPoint};
use toile_garment::Vec2;
use toile_garment::outline::PointKind;

/// How far the fine curve may lie from the chords of the curve points, mm (vendors' files: up to 1.6 mm).
const CHORD: f64 = 2.0;

/// Curve points further apart than this are joined by a smooth curve when they are read, mm.
const SPARSE: f64 = 3.0;

/// The line as it is written.
///
/// A run of curve points alone, some of them far apart, is a curve that was dense enough for its writer: it is written
/// as a polygon, so that no reader smooths it.
///
/// With a dense layer the curve points stay on the line, and the fine curve goes there. Without one, or where the curve
/// points alone would lose the shape, every vertex stays and the run has no curve points: it is a polygon.
pub fn thin(line: &DrawLine, has_dense_layer: bool) -> DrawLine {
    if line.dense.is_some() {
        return line.clone();
    }
    let finished = unmixed_sparse(line);
    let line = &finished;
    let mixed = mixed(line);
    if !mixed.contains(&true) {
        return line.clone();
    }
    if has_dense_layer {
        let kept = |i: usize, p: &DrawPoint| p.kind != PointKind::Plain || !mixed[i];
        let points: Vec<_> = line.points.iter().enumerate().filter(|(i, p)| kept(*i, p)).map(|(_, p)| *p).collect();
        if points.len() >= 3 && holds(line, &points) {
            let dense = Some(line.points.iter().map(|p| p.at).collect());
            return DrawLine { points, closed: line.closed, dense };
        }
    }
    let plain = |(p, mixed): (&DrawPoint, &bool)| {
        if *mixed && p.kind == PointKind::Curve { DrawPoint { kind: PointKind::Plain, ..*p } } else { *p }
    };
    DrawLine { points: line.points.iter().zip(&mixed).map(plain).collect(), closed: line.closed, dense: None }
}

/// The line with the curve points of runs without plain points made plain where they lie far apart.
fn unmixed_sparse(line: &DrawLine) -> DrawLine {
    let mut out = line.clone();
    let n = out.points.len();
    let turns: Vec<usize> = (0..n).filter(|i| line.points[*i].kind == PointKind::Turn).collect();
    for (k, from) in turns.iter().enumerate() {
        let to = turns.get(k + 1).copied().unwrap_or(if line.closed { turns[0] + n } else { n - 1 });
        let inner: Vec<usize> = (from + 1..to).map(|i| i % n).collect();
        let all_curve = !inner.is_empty() && inner.iter().all(|i| line.points[*i].kind == PointKind::Curve);
        let far = (*from..to).any(|i| (line.points[(i + 1) % n].at - line.points[i % n].at).norm() > SPARSE);
        if all_curve && far {
            inner.into_iter().for_each(|i| out.points[i].kind = PointKind::Plain);
        }
    }
    out
}

/// For every vertex: does its run between turn points hold curve points and plain ones?
fn mixed(line: &DrawLine) -> Vec<bool> {
    let n = line.points.len();
    let start = line.points.iter().position(|p| p.kind == PointKind::Turn).unwrap_or(0);
    let mut out = vec![false; n];
    let mut run: Vec<usize> = Vec::new();
    let mut flush = |run: &mut Vec<usize>| {
        let has = |kind| run.iter().any(|i| line.points[*i].kind == kind);
        if has(PointKind::Curve) && has(PointKind::Plain) {
            run.iter().for_each(|i| out[*i] = true);
        }
        run.clear();
    };
    for k in 0..n {
        let i = (start + k) % n;
        let open_end = !line.closed && i == 0;
        if line.points[i].kind == PointKind::Turn || open_end {
            flush(&mut run);
        }
        if line.points[i].kind != PointKind::Turn {
            run.push(i);
        }
    }
    flush(&mut run);
    out
}

/// Does the thinned line keep the shape?
fn holds(line: &DrawLine, points: &[DrawPoint]) -> bool {
    // Walk both lines together: every dropped vertex lies between two kept neighbours.
    let n = line.points.len();
    let mut k = 0;
    let first = line.points.iter().position(|p| points.first() == Some(p)).unwrap_or(0);
    for s in 0..n {
        let p = line.points[(first + s) % n];
        if points.get((k + 1) % points.len()) == Some(&p) {
            k = (k + 1) % points.len();
            continue;
        }
        let (a, b) = (points[k].at, points[(k + 1) % points.len()].at);
        if distance(p.at, a, b) > CHORD {
            return false;
        }
    }
    true
}

fn distance(p: Vec2, a: Vec2, b: Vec2) -> f64 {
    let d = b - a;
    let t = if d.norm_squared() > 0.0 { ((p - a).dot(&d) / d.norm_squared()).clamp(0.0, 1.0) } else { 0.0 };
    (a + d * t - p).norm()
}
