//! A piece wrapped around a segment of the body: an elliptical cylinder about the segment's axis.
//!
//! The wrap keeps lengths along and across the axis, so the piece starts without membrane strain.

use toile_garment::body::BodySegment;
use toile_garment::{Vec2, Vec3};

/// Samples of the ellipse; the arc length between two of them is taken as straight (error below 1e-5 of the girth).
const SAMPLES: usize = 1440;

/// Where the middle of a piece sits around the segment, as an angle from the front, counter-clockwise from above.
#[must_use]
pub fn side_angle(side: &str) -> Option<f64> {
    use std::f64::consts::{FRAC_PI_2, PI};
    match side {
        "front" => Some(0.0),
        "left" => Some(FRAC_PI_2),
        "back" => Some(PI),
        "right" => Some(1.5 * PI),
        _ => None,
    }
}

/// An elliptical cylinder around a segment.
#[derive(Clone, Debug)]
pub struct Cylinder {
    origin: Vec3,
    down: Vec3,
    front: Vec3,
    left: Vec3,
    half_width: f64,
    half_depth: f64,
    /// Arc length from the front to each sample.
    arc: Vec<f64>,
}

impl Cylinder {
    /// The cylinder that keeps `clearance` (m) from the segment's largest section.
    /// `None` when the segment's axis has no length.
    #[must_use]
    pub fn new(segment: &BodySegment, clearance: f64) -> Option<Self> {
        let axis = segment.to - segment.from;
        let length = axis.norm();
        if length.is_nan() || length < 1e-6 {
            return None;
        }
        let down = axis / length;
        let ahead = Vec3::z() - down * down.z;
        let front = if ahead.norm() > 1e-6 { ahead / ahead.norm() } else { Vec3::y() };
        let left = (-down).cross(&front);
        let mut cylinder = Self {
            origin: segment.from,
            down,
            front,
            left,
            half_width: segment.half_width + clearance,
            half_depth: segment.half_depth + clearance,
            arc: Vec::with_capacity(SAMPLES + 1),
        };
        let mut total = 0.0;
        let mut before = cylinder.section(0.0);
        for i in 0..=SAMPLES {
            let here = cylinder.section(angle_of(i));
            total += (here - before).norm();
            cylinder.arc.push(total);
            before = here;
        }
        Some(cylinder)
    }

    /// Length once around, metres.
    #[must_use]
    pub fn girth(&self) -> f64 {
        self.arc[SAMPLES]
    }

    /// Arc length from the front to an angle of the ellipse's parameter.
    #[must_use]
    pub fn arc_at(&self, angle: f64) -> f64 {
        let turns = angle / std::f64::consts::TAU;
        let whole = turns.floor();
        let place = (turns - whole) * SAMPLES as f64;
        let i = (place as usize).min(SAMPLES - 1);
        whole * self.girth() + self.arc[i] + (place - i as f64) * (self.arc[i + 1] - self.arc[i])
    }

    /// Distance along the axis from its start to a height above the floor, where the axis is not level.
    #[must_use]
    pub fn axial_of_height(&self, height: f64) -> Option<f64> {
        (self.down.y.abs() > 0.1).then(|| (height - self.origin.y) / self.down.y)
    }

    /// The point at an arc length around and a distance along the axis.
    #[must_use]
    pub fn at(&self, arc: f64, axial: f64) -> Vec3 {
        let girth = self.girth();
        let whole = (arc / girth).floor();
        let rest = arc - whole * girth;
        let i = self.arc.partition_point(|a| *a <= rest).clamp(1, SAMPLES) - 1;
        let share = (rest - self.arc[i]) / (self.arc[i + 1] - self.arc[i]);
        let p = self.section(angle_of(i)) * (1.0 - share) + self.section(angle_of(i + 1)) * share;
        self.origin + self.down * axial + self.left * p.x + self.front * p.y
    }

    fn section(&self, angle: f64) -> Vec2 {
        let (s, c) = libm::sincos(angle);
        Vec2::new(self.half_width * s, self.half_depth * c)
    }
}

fn angle_of(sample: usize) -> f64 {
    std::f64::consts::TAU * sample as f64 / SAMPLES as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn torso() -> BodySegment {
        BodySegment { from: Vec3::new(0.0, 1.4, 0.0), to: Vec3::new(0.0, 0.8, 0.0), half_width: 0.15, half_depth: 0.1 }
    }

    #[test]
    fn the_wrap_keeps_lengths_and_faces_outwards() {
        let c = Cylinder::new(&torso(), 0.02).expect("cylinder");
        let step = (c.at(0.01, 0.1) - c.at(0.0, 0.1)).norm();
        assert!((step - 0.01).abs() < 2e-5, "{step}");
        // At the front, x of the piece runs to the wearer's left and the right side looks to +z.
        assert!(c.at(0.05, 0.0).x > 0.0 && c.at(0.0, 0.0).z > 0.1);
        let left = c.at(c.arc_at(std::f64::consts::FRAC_PI_2), 0.0);
        assert!((left - Vec3::new(0.17, 1.4, 0.0)).norm() < 1e-6);
    }

    #[test]
    fn girth_is_that_of_the_ellipse() {
        let c = Cylinder::new(&torso(), 0.0).expect("cylinder");
        // Ramanujan's second formula, good to 1e-9 for this flattening.
        let (a, b) = (0.15_f64, 0.1_f64);
        let h = ((a - b) / (a + b)) * ((a - b) / (a + b));
        let exact = std::f64::consts::PI * (a + b) * (1.0 + 3.0 * h / (10.0 + (4.0 - 3.0 * h).sqrt()));
        assert!((c.girth() - exact).abs() < 1e-5 * exact);
    }
}
