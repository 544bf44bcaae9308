//! A coarse grid of lower bounds of the distance from the body, so that cloth far from it searches no tree.

use crate::Vec3;
use crate::collision::broad_phase::aabb::Aabb;
use crate::collision::narrow_phase::distance::point_triangle;
use crate::collision::tuning::{DISTANCE_GRID_CELLS, DISTANCE_GRID_RANGE};

/// Lower bounds of the distance to a set of triangles.
#[derive(Debug)]
pub(crate) struct DistanceGrid {
    low: Vec3,
    /// Side of a cell, m.
    cell: f64,
    /// Number of cells along each axis.
    size: [usize; 3],
    /// A lower bound for all places in each cell, m.
    bound: Vec<f64>,
}

impl DistanceGrid {
    /// Makes the grid around the triangles `faces` with corners in `x`, whose box is `bounds`.
    pub fn new(x: &[Vec3], faces: &[[u32; 3]], bounds: &Aabb) -> Self {
        let range = DISTANCE_GRID_RANGE.get();
        let cell = ((bounds.high - bounds.low).amax() / DISTANCE_GRID_CELLS.get()).max(1e-6);
        let low = bounds.low - Vec3::repeat(cell * range as f64);
        let size = [0, 1, 2].map(|k| ((bounds.high[k] - bounds.low[k]) / cell) as usize + 2 * range + 1);
        let mut grid = Self { low, cell, size, bound: vec![(range * range) as f64; size.iter().product()] };
        for t in faces {
            grid.mark(&crate::pick3(x, t));
        }
        (0..3).for_each(|k| grid.propagate(k));
        grid.bound.iter_mut().for_each(|b| *b = b.sqrt() * cell);
        grid
    }

    /// Coordinates of a place in cells.
    fn place(&self, p: &Vec3) -> [f64; 3] {
        [0, 1, 2].map(|k| (p[k] - self.low[k]) / self.cell)
    }

    /// Sets the cells that a triangle may pass through to 0.
    fn mark(&mut self, t: &[Vec3; 3]) {
        let b = Aabb::of_three(t);
        let (from, to) = (self.place(&b.low).map(|c| c as usize), self.place(&b.high).map(|c| c as usize));
        let normal = (t[1] - t[0]).cross(&(t[2] - t[0]));
        // A cell reaches half its diagonal from its middle; 0.51 allows for rounding.
        let reach = 0.51 * self.cell * (normal.x.abs() + normal.y.abs() + normal.z.abs());
        for i in from[0]..=to[0] {
            for j in from[1]..=to[1] {
                for k in from[2]..=to[2] {
                    let middle = self.low + Vec3::new(i as f64 + 0.5, j as f64 + 0.5, k as f64 + 0.5) * self.cell;
                    if (middle - t[0]).dot(&normal).abs() <= reach && self.is_near(&middle, t) {
                        let at = self.index([i, j, k]);
                        self.bound[at] = 0.0;
                    }
                }
            }
        }
    }

    /// Is the triangle within half a diagonal of the middle of a cell?
    fn is_near(&self, middle: &Vec3, t: &[Vec3; 3]) -> bool {
        let w = point_triangle(middle, &t[0], &t[1], &t[2]);
        let d = middle - (t[0] * w[0] + t[1] * w[1] + t[2] * w[2]);
        // The square of half a diagonal is 3/4 of the square of a side; 0.76 allows for rounding.
        d.norm_squared() <= 0.76 * self.cell * self.cell
    }

    /// Index of a cell.
    fn index(&self, c: [usize; 3]) -> usize {
        (c[0] * self.size[1] + c[1]) * self.size[2] + c[2]
    }

    /// Propagates squared distances, in cells, along one axis. Neighbouring cells may touch, so one cell apart counts
    /// as 0.
    fn propagate(&mut self, axis: usize) {
        let inner = self.size[axis + 1..].iter().product::<usize>();
        let (block, range) = (self.size[axis] * inner, DISTANCE_GRID_RANGE.get());
        let mut before = vec![0.0; block];
        for bound in self.bound.chunks_exact_mut(block) {
            before.copy_from_slice(bound);
            for cells in 1..self.size[axis].min(range + 1) {
                let (shift, apart) = (cells * inner, ((cells - 1) * (cells - 1)) as f64);
                lower(&mut bound[shift..], &before, apart);
                lower(bound, &before[shift..], apart);
            }
        }
    }

    /// A lower bound of the distance of `p`, m; 0 outside the grid, where the caller's box test decides.
    #[inline]
    pub fn at(&self, p: &Vec3) -> f64 {
        let c = self.place(p);
        let inside = (0..3).all(|k| c[k] >= 0.0 && c[k] < self.size[k] as f64);
        if inside { self.bound[self.index(c.map(|c| c as usize))] } else { 0.0 }
    }
}

/// Lowers each bound to another bound plus `more`, where that is less.
#[inline]
fn lower(bounds: &mut [f64], others: &[f64], more: f64) {
    for (b, o) in bounds.iter_mut().zip(others) {
        let other = o + more;
        *b = if other < *b { other } else { *b };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn never_promises_more_than_the_true_distance_and_not_much_less() {
        let x = [Vec3::new(0.0, 0.0, 0.0), Vec3::new(0.5, 0.1, 0.2), Vec3::new(0.1, 0.4, -0.3)];
        let grid = DistanceGrid::new(&x, &[[0, 1, 2]], &Aabb::of(&x));
        let mut most: f64 = 0.0;
        for i in 0..4000u32 {
            // The places are spread over a box around the triangle by multiples of three irrational shares.
            let part = |share: f64| (f64::from(i) * share).fract() * 0.7 - 0.15;
            let p = Vec3::new(part(0.754_877), part(0.569_840), part(0.430_16) - 0.15);
            let w = point_triangle(&p, &x[0], &x[1], &x[2]);
            let d = (p - (x[0] * w[0] + x[1] * w[1] + x[2] * w[2])).norm();
            let bound = grid.at(&p);
            assert!(bound <= d, "{p:?}: {bound} {d}");
            if d < 0.9 * grid.cell * DISTANCE_GRID_RANGE.get() as f64 && bound > 0.0 {
                most = most.max((d - bound) / grid.cell);
            }
        }
        assert!(most < 4.5, "{most}");
    }
}
