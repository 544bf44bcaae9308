//! Inner points: a hexagonal lattice, turned off the grain, clear of every line.

use super::crossing::Segment;
use toile_garment::Vec2;

/// No lattice point nearer to a line than this share of the edge length.
const CLEARANCE: f64 = 0.65;

/// Points of a hexagonal lattice of spacing `h` inside the closed boundary and clear of all `lines`.
/// `rows` is the unit direction of its rows, `origin` one of its points.
pub fn hexagonal(boundary: &[Segment], lines: &[Segment], h: f64, rows: Vec2, origin: Vec2) -> Vec<Vec2> {
    let to_frame = |p: Vec2| {
        let d = p - origin;
        Vec2::new(d.dot(&rows), rows.x * d.y - rows.y * d.x)
    };
    let from_frame = |p: Vec2| origin + Vec2::new(rows.x * p.x - rows.y * p.y, rows.y * p.x + rows.x * p.y);
    let step = h * 0.75_f64.sqrt();
    let near = Near::new(lines.iter().map(|s| (to_frame(s.a), to_frame(s.b))).collect(), h, CLEARANCE * h);
    let mut out = Vec::new();
    for (row, mut xs) in crossings(boundary.iter().map(|s| (to_frame(s.a), to_frame(s.b))), step) {
        xs.sort_by(f64::total_cmp);
        let shift = if row.rem_euclid(2) == 1 { 0.5 } else { 0.0 };
        let y = row as f64 * step;
        for pair in xs.chunks_exact(2) {
            let mut i = (pair[0] / h - shift).ceil();
            while (i + shift) * h < pair[1] {
                let p = Vec2::new((i + shift) * h, y);
                if near.is_clear(p) {
                    out.push(from_frame(p));
                }
                i += 1.0;
            }
        }
    }
    out
}

/// Where the rows cross the boundary: row number and abscissae.
fn crossings(segments: impl Iterator<Item = (Vec2, Vec2)>, step: f64) -> Vec<(i64, Vec<f64>)> {
    let mut hits: Vec<(i64, f64)> = Vec::new();
    for (a, b) in segments {
        let (lo, hi) = (a.y.min(b.y), a.y.max(b.y));
        // Half open: a row through a vertex counts one of the two segments that meet there.
        let (first, last) = ((lo / step).ceil() as i64, (hi / step).ceil() as i64);
        for row in first..last {
            let y = row as f64 * step;
            hits.push((row, a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y))));
        }
    }
    hits.sort_by(|p, q| p.0.cmp(&q.0).then(p.1.total_cmp(&q.1)));
    let mut rows: Vec<(i64, Vec<f64>)> = Vec::new();
    for (row, x) in hits {
        match rows.last_mut() {
            Some((r, xs)) if *r == row => xs.push(x),
            _ => rows.push((row, vec![x])),
        }
    }
    rows
}

/// Segments by cell, for "is anything nearer than …".
pub struct Near {
    segments: Vec<(Vec2, Vec2)>,
    cells: Vec<((i64, i64), u32)>,
    size: f64,
    reach: f64,
}

impl Near {
    /// Sorts segments into cells of `size`, for questions about distances up to `reach`.
    pub fn new(segments: Vec<(Vec2, Vec2)>, size: f64, reach: f64) -> Self {
        let cell = |x: f64| (x / size).floor() as i64;
        let mut cells = Vec::new();
        for (i, (a, b)) in segments.iter().enumerate() {
            for cx in cell(a.x.min(b.x) - reach)..=cell(a.x.max(b.x) + reach) {
                for cy in cell(a.y.min(b.y) - reach)..=cell(a.y.max(b.y) + reach) {
                    cells.push(((cx, cy), i as u32));
                }
            }
        }
        cells.sort_unstable();
        Self { segments, cells, size, reach }
    }

    /// Is no segment within reach of the point?
    pub fn is_clear(&self, p: Vec2) -> bool {
        let cell = ((p.x / self.size).floor() as i64, (p.y / self.size).floor() as i64);
        let start = self.cells.partition_point(|(c, _)| *c < cell);
        self.cells[start..].iter().take_while(|(c, _)| *c == cell).all(|(_, i)| {
            let (a, b) = self.segments[*i as usize];
            distance(a, b, p) >= self.reach
        })
    }
}

/// Distance of a point from a segment.
pub fn distance(a: Vec2, b: Vec2, p: Vec2) -> f64 {
    let d = b - a;
    let l2 = d.norm_squared();
    let t = if l2 > 0.0 { ((p - a).dot(&d) / l2).clamp(0.0, 1.0) } else { 0.0 };
    (p - (a + d * t)).norm()
}
