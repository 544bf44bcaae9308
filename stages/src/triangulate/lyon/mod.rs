//! The only place of this package that knows lyon.
//!
//! Its fill rule tells cloth from holes and intakes. Its tessellator makes the draft mesh. lyon computes in `f32`, so
//! every path lies in a frame of its own, in steps of the grid that the points of a pattern are snapped to.
//!
//! Its tessellation is no ground for the mesh that is draped: a slit of 0.2 mm costs it an edge of the outline (see the
//! tests).

mod draft;
mod fill_rule;

use crate::sewing::ring::GRID;
use lyon::math::{Point, point};
use toile_garment::Vec2;

pub use draft::fill;
pub use fill_rule::covers;

/// Steps of the grid about a place. `f32` holds all grid points within 1.6 m of it exactly.
struct Frame(Vec2);

impl Frame {
    fn to(&self, p: Vec2) -> Point {
        let d = (p - self.0) / GRID;
        point(d.x as f32, d.y as f32)
    }
}

#[cfg(test)]
mod tests;
