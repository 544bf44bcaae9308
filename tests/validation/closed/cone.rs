//! Cones from sectors, without stretch.

use std::f64::consts::TAU;

/// A sector of `angle` (rad) between two slant radii, closed to a cone.
#[derive(Clone, Copy, Debug)]
pub struct Cone {
    /// Half angle at the tip, rad: `sin α = angle / 2π`.
    pub half_angle: f64,
    /// Radius of the inner and of the outer edge, m.
    pub radii: [f64; 2],
    /// From edge to edge along the axis, m.
    pub height: f64,
}

pub fn closed(inner: f64, outer: f64, angle: f64) -> Cone {
    let sine = angle / TAU;
    let half_angle = libm::asin(sine);
    Cone { half_angle, radii: [inner * sine, outer * sine], height: (outer - inner) * libm::cos(half_angle) }
}
