//! Rigid motions of cloth in the plane.

use toile_formats::dxf::geom;
use toile_garment::Vec2;

/// A turn about a point of the plane, and a shift after it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// The point, metres.
    about: Vec2,
    /// The angle, radians, counter-clockwise.
    pub angle: f64,
    /// The shift, metres.
    shift: Vec2,
}

impl Motion {
    /// No motion.
    pub const NONE: Self = Self { about: Vec2::new(0.0, 0.0), angle: 0.0, shift: Vec2::new(0.0, 0.0) };

    /// A turn about a point.
    pub fn turn(about: Vec2, angle: f64) -> Self {
        Self { about, angle, shift: Vec2::new(0.0, 0.0) }
    }

    /// The motion that lays one place with a direction onto another.
    pub fn onto(from: Vec2, from_way: Vec2, to: Vec2, to_way: Vec2) -> Self {
        let angle = libm::atan2(geom::cross(from_way, to_way), from_way.dot(&to_way));
        Self { about: from, angle, shift: to - from }
    }

    /// Where a point comes to lie.
    pub fn apply(&self, p: Vec2) -> Vec2 {
        if self.angle == 0.0 {
            return p + self.shift;
        }
        self.about + geom::rotate(p - self.about, self.angle) + self.shift
    }

    /// This motion after another one.
    pub fn after(&self, first: &Self) -> Self {
        let shift = self.apply(first.about + first.shift) - first.about;
        Self { about: first.about, angle: self.angle + first.angle, shift }
    }

    /// The way back.
    pub fn inverse(&self) -> Self {
        Self { about: self.about + self.shift, angle: -self.angle, shift: -self.shift }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn motions_are_joined_and_undone() {
        let a = Motion::turn(Vec2::new(0.1, 0.2), 0.3);
        let b = Motion::onto(Vec2::new(0.5, 0.1), Vec2::new(1.0, 0.0), Vec2::new(0.2, 0.4), Vec2::new(0.0, 2.0));
        let p = Vec2::new(-0.3, 0.7);
        assert!((b.after(&a).apply(p) - b.apply(a.apply(p))).norm() < 1e-15);
        assert!((b.inverse().apply(b.apply(p)) - p).norm() < 1e-15);
        assert!((b.apply(Vec2::new(0.6, 0.1)) - Vec2::new(0.2, 0.5)).norm() < 1e-15);
    }
}
