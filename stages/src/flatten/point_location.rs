//! The triangle of a mesh that holds a point of the plane.

use super::metric::edges2;
use nalgebra::SVector;
use std::collections::BTreeMap;
use toile_garment::Vec2;

/// Rings of cells around a point that are searched for the nearest triangle.
const RINGS_SEARCHED: i64 = 3;

/// Triangles of a plane mesh, sorted into square cells.
pub struct PointLocation<'a> {
    rest: &'a [Vec2],
    triangles: &'a [[u32; 3]],
    cell: f64,
    cells: BTreeMap<(i64, i64), Vec<u32>>,
}

impl<'a> PointLocation<'a> {
    /// Sorts the triangles; a cell is about as wide as an edge.
    #[must_use]
    pub fn new(rest: &'a [Vec2], triangles: &'a [[u32; 3]]) -> Self {
        let area: f64 = triangles.iter().map(|t| 0.5 * edges2(rest, *t).determinant().abs()).sum();
        let cell = (2.0 * area / triangles.len().max(1) as f64).sqrt().max(1e-6);
        let mut cells: BTreeMap<(i64, i64), Vec<u32>> = BTreeMap::new();
        for (k, t) in triangles.iter().enumerate() {
            let corner = t.map(|v| key(rest[v as usize], cell));
            let (xs, ys) = (corner.map(|c| c.0), corner.map(|c| c.1));
            let range = |v: [i64; 3]| v[0].min(v[1]).min(v[2])..=v[0].max(v[1]).max(v[2]);
            for i in range(xs) {
                for j in range(ys) {
                    cells.entry((i, j)).or_default().push(k as u32);
                }
            }
        }
        Self { rest, triangles, cell, cells }
    }

    /// A field on the vertices at a point, linear in its triangle. Beside the mesh the nearest triangle goes on.
    #[must_use]
    pub fn interpolate<const D: usize>(&self, p: Vec2, field: &[SVector<f64, D>]) -> SVector<f64, D> {
        let Some((t, w)) = self.find(p) else { return SVector::zeros() };
        t.iter().zip(w).map(|(v, w)| field[*v as usize] * w).sum()
    }

    /// The triangle and the weights of its corners.
    fn find(&self, p: Vec2) -> Option<([u32; 3], [f64; 3])> {
        let (i, j) = key(p, self.cell);
        let mut best: Option<(f64, [u32; 3], [f64; 3])> = None;
        for ring in 0..=RINGS_SEARCHED {
            let around = (-ring..=ring).flat_map(|a| (-ring..=ring).map(move |b| (a, b)));
            let cells = around.filter(|(a, b)| a.abs().max(b.abs()) == ring).map(|(a, b)| (i + a, j + b));
            for k in cells.filter_map(|c| self.cells.get(&c)).flatten() {
                let t = self.triangles[*k as usize];
                let e = edges2(self.rest, t);
                let Some(inverse) = e.try_inverse() else { continue };
                let s = inverse * (p - self.rest[t[0] as usize]);
                let w = [1.0 - s.x - s.y, s.x, s.y];
                let outside = w.iter().map(|w| (-w).max(0.0)).fold(0.0, f64::max);
                if best.as_ref().is_none_or(|(b, _, _)| outside < *b) {
                    best = Some((outside, t, w));
                }
            }
            if best.as_ref().is_some_and(|(outside, _, _)| *outside < 1e-3 || ring > 0) {
                break;
            }
        }
        best.map(|(_, t, w)| (t, w))
    }
}

fn key(p: Vec2, cell: f64) -> (i64, i64) {
    ((p.x / cell).floor() as i64, (p.y / cell).floor() as i64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_linear_field_is_met_inside_and_beside_the_mesh() {
        let rest = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Vec2::new(x, y));
        let triangles = [[0, 1, 2], [0, 2, 3]];
        let field = rest.map(|p| Vec2::new(p.x + 2.0 * p.y, 3.0 * p.x));
        let location = PointLocation::new(&rest, &triangles);
        for p in [Vec2::new(0.3, 0.2), Vec2::new(0.2, 0.9), Vec2::new(1.0005, 0.5)] {
            let exact = Vec2::new(p.x + 2.0 * p.y, 3.0 * p.x);
            assert!((location.interpolate(p, &field) - exact).norm() < 1e-12, "{p}");
        }
    }
}
