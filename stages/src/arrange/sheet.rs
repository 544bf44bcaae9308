//! A piece in space: a flat sheet, or bent around a segment of the body. Both keep its lengths.

use super::around::Cylinder;
use super::whole_leg::Cone;
use crate::roles::outline::turned;
use toile_garment::body::BodySegment;
use toile_garment::{Vec2, Vec3};

/// Step along a cylinder by which its tangents are taken, m.
const TANGENT_STEP: f64 = 1e-4;

/// A piece bent around a segment.
#[derive(Clone, Debug)]
pub struct Bend {
    cylinder: Cylinder,
    /// The segment that it was made for.
    segment: BodySegment,
    /// Distance from the segment, m.
    clearance: f64,
    /// Angle of the middle of the piece, from the front of the segment.
    pub angle: f64,
    /// Distance of the middle along the axis, m.
    pub axial: f64,
    /// Middle of the piece after its turn, m.
    pub middle: Vec2,
    /// The cone that it lies on instead of the cylinder.
    cone: Option<Cone>,
}

/// Where a piece starts.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// Turn of the piece in its plane that makes it upright, rad.
    pub turn: f64,
    /// Unit vectors of the upright piece: to its right as drawn, up, and outwards.
    pub right: Vec3,
    /// See `right`.
    pub up: Vec3,
    /// The right side of the cloth looks there.
    pub normal: Vec3,
    /// Where the origin of the piece lies, m. Of a bent piece, that of the plane that touches its middle.
    pub origin: Vec3,
    /// The bend, if there is one.
    pub bend: Option<Bend>,
}

impl Sheet {
    /// An upright sheet that looks along `normal`; `up` is made square to it. It lies at the origin of the world.
    #[must_use]
    pub fn facing(normal: Vec3, up: Vec3, turn: f64) -> Self {
        let up = (up - normal * up.dot(&normal)).try_normalize(1e-9).unwrap_or_else(Vec3::y);
        Self { turn, right: up.cross(&normal), up, normal, origin: Vec3::zeros(), bend: None }
    }

    /// A piece bent around a segment, its middle at an angle from the front and a distance along the axis, m.
    /// `middle` is that of the piece after its turn. `None` where the segment has no length.
    #[must_use]
    pub fn around(
        segment: &BodySegment,
        clearance: f64,
        turn: f64,
        middle: Vec2,
        angle: f64,
        axial: f64,
    ) -> Option<Self> {
        let cylinder = Cylinder::new(segment, clearance)?;
        let bend = Bend { cylinder, segment: segment.clone(), clearance, angle, axial, middle, cone: None };
        let mut sheet = Self { bend: Some(bend), ..Self::facing(Vec3::z(), Vec3::y(), turn) };
        sheet.touch();
        Some(sheet)
    }

    /// A bent piece on a cone instead of its cylinder.
    #[must_use]
    pub fn on_cone(mut self, cone: Cone) -> Self {
        if let Some(b) = &mut self.bend {
            b.cone = Some(cone);
        }
        self.touch();
        self
    }

    /// Where a point of the piece lies, m.
    #[must_use]
    pub fn at(&self, p: Vec2) -> Vec3 {
        let q = turned(p, self.turn);
        match &self.bend {
            None => self.origin + self.right * q.x + self.up * q.y,
            Some(b) => b.at(q - b.middle),
        }
    }

    /// A direction in the piece, in space, where the piece is flat or has its middle.
    #[must_use]
    pub fn direction(&self, d: Vec2) -> Vec3 {
        let q = turned(d, self.turn);
        self.right * q.x + self.up * q.y
    }

    /// Point of space in the coordinates of the upright flat piece, and the distance before it, m.
    #[must_use]
    pub fn seen(&self, p: Vec3) -> (Vec2, f64) {
        let d = p - self.origin;
        (Vec2::new(d.dot(&self.right), d.dot(&self.up)), d.dot(&self.normal))
    }

    /// Rows of the rotation of the flat piece; of a bent one that of the plane that touches its middle.
    #[must_use]
    pub fn rotation(&self) -> [[f64; 3]; 3] {
        let x = self.direction(Vec2::x());
        let y = self.direction(Vec2::y());
        [0, 1, 2].map(|k| [x[k], y[k], self.normal[k]])
    }

    /// Moves the sheet, m; a bent one along its axis and around it.
    pub fn shift(&mut self, by: Vec3) {
        match &mut self.bend {
            None => self.origin += by,
            Some(b) => {
                let (right, up) = (self.right, self.up);
                b.axial -= by.dot(&up);
                b.angle += by.dot(&right) / (b.cylinder.girth() / std::f64::consts::TAU);
                self.touch();
            }
        }
    }

    /// A flat sheet that leans in its plane about a point of its piece, rad; its lower end goes to its right.
    #[must_use]
    pub fn leaning(self, by: f64, about: Vec2) -> Self {
        let held = self.at(about);
        let (s, c) = libm::sincos(by);
        let mut sheet = Self { right: self.right * c + self.up * s, up: self.up * c - self.right * s, ..self };
        sheet.origin += held - sheet.at(about);
        sheet
    }

    /// Bends the piece around a wider cylinder, m farther from the segment.
    pub fn widen(&mut self, by: f64) {
        let Some(b) = &mut self.bend else { return };
        b.clearance += by;
        if let Some(cylinder) = Cylinder::new(&b.segment, b.clearance) {
            b.cylinder = cylinder;
        }
        self.touch();
    }

    /// Turns a bent piece around its segment until its middle lies at an angle from the front, rad.
    pub fn turn_to(&mut self, angle: f64) {
        if let Some(b) = &mut self.bend {
            b.angle = angle;
            self.touch();
        }
    }

    /// Length once around the cylinder of a bent piece, m.
    #[must_use]
    pub fn girth(&self) -> Option<f64> {
        self.bend.as_ref().map(|b| b.cylinder.girth())
    }

    /// Takes the plane that touches a bent piece in its middle.
    fn touch(&mut self) {
        let Some(b) = &self.bend else { return };
        let tangent = |d: Vec2| (b.at(d * TANGENT_STEP) - b.at(-d * TANGENT_STEP)).normalize();
        let (right, up) = (tangent(Vec2::x()), tangent(Vec2::y()));
        let middle = b.at(Vec2::zeros()) - right * b.middle.x - up * b.middle.y;
        (self.right, self.up, self.normal, self.origin) = (right, up, right.cross(&up), middle);
    }
}

impl Bend {
    /// A point at a distance from the middle, to the right and up along the cloth, m.
    fn at(&self, d: Vec2) -> Vec3 {
        let on_cylinder = || self.cylinder.at(self.cylinder.arc_at(self.angle) + d.x, self.axial - d.y);
        self.cone.as_ref().map_or_else(on_cylinder, |cone| cone.at(d))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn torso() -> BodySegment {
        BodySegment { from: Vec3::new(0.0, 1.4, 0.0), to: Vec3::new(0.0, 0.8, 0.0), half_width: 0.15, half_depth: 0.1 }
    }

    #[test]
    fn front_and_back_look_outwards_and_keep_the_right_side_out() {
        let front = Sheet::facing(Vec3::z(), Vec3::y(), 0.0);
        assert!((front.right - Vec3::x()).norm() < 1e-12);
        let back = Sheet::facing(-Vec3::z(), Vec3::y(), 0.0);
        assert_eq!(back.rotation(), [[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]);
    }

    #[test]
    fn a_bent_piece_touches_its_plane_in_the_middle_and_moves_along_its_axis() {
        let middle = Vec2::new(0.3, 0.1);
        let mut sheet = Sheet::around(&torso(), 0.02, 0.0, middle, 0.0, 0.3).expect("a torso");
        let flat = sheet.origin + sheet.right * middle.x + sheet.up * middle.y;
        assert!((sheet.at(middle) - flat).norm() < 1e-9);
        assert!((sheet.at(middle) - Vec3::new(0.0, 1.1, 0.12)).norm() < 1e-6);
        assert!((sheet.normal - Vec3::z()).norm() < 1e-6);
        sheet.shift(Vec3::new(0.0, 0.05, 0.0));
        assert!((sheet.at(middle).y - 1.15).abs() < 1e-9);
    }
}
