//! The only place of this package that knows lyon.
//!
//! Its fill rule tells cloth from holes and intakes. Its measurements of paths place the vertices along every stretch
//! of a line. Its tessellator makes the draft mesh. lyon computes in `f32`, so every path lies in a frame of its own,
//! in steps of the grid that the points of a pattern are snapped to.
//!
//! Its tessellation is no ground for the mesh that is draped: a slit of 0.2 mm costs it an edge of the outline (see the
//! tests).

mod draft;
mod fill_rule;
mod flips;
mod walk;

use crate::sewing::ring::GRID;
use lyon::math::{Point, point};
use toile_garment::Vec2;

pub use draft::fill;
pub use fill_rule::covers;
pub use walk::places_along;

/// Tolerance of lyon's flattening, of no effect: all lines are polygons here.
const NO_CURVES: f32 = 1.0;

/// Steps of the grid about a place. `f32` holds all grid points within 1.6 m of it exactly.
#[derive(Clone, Copy)]
struct Frame(Vec2);

impl Frame {
    fn to(&self, p: Vec2) -> Point {
        let d = (p - self.0) / GRID;
        point(d.x as f32, d.y as f32)
    }

    fn back(&self, p: Point) -> Vec2 {
        self.0 + Vec2::new(f64::from(p.x), f64::from(p.y)) * GRID
    }
}

#[cfg(test)]
mod tests;
