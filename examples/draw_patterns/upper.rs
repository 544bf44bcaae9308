//! All garments for the upper body share this: shoulder, neckline, armhole.

use crate::body::SHOULDER_SLOPE;
use crate::draft::{Edge, at, left, towards};
use toile_garment::Vec2;

/// Shoulder, neck and armhole of one quarter.
pub struct Upper {
    /// Neck point at the shoulder.
    pub neck: Vec2,
    /// x of the shoulder point.
    pub shoulder_x: f64,
    /// Slope of the shoulder seam, degrees.
    pub slope: f64,
    /// y of the neckline at the centre.
    pub neck_centre: f64,
    /// Share of the neckline chord that runs level at the centre.
    pub neck_reach: [f64; 2],
    /// Point of the armhole that is nearest to the centre.
    pub pitch: Vec2,
}

impl Upper {
    /// Shoulder point.
    pub fn shoulder(&self) -> Vec2 {
        let dx = self.shoulder_x - self.neck.x;
        at(self.shoulder_x, self.neck.y - dx * libm::tan(self.slope.to_radians()))
    }

    /// Armhole, shoulder and neckline of the right half, from the underarm point. `up` is the direction of the side
    /// seam there: the armhole starts square to it and ends square to the shoulder.
    pub fn edges(&self, underarm: Vec2, up: Vec2) -> [Edge; 3] {
        let shoulder = self.shoulder();
        let along = towards(-self.slope);
        let armhole = Edge::start("armhole", underarm)
            .curve(left(up), self.pitch, at(0.0, 1.0), [0.42, 0.42], 18)
            .curve(at(0.0, 1.0), shoulder, left(along), [0.36, 0.3], 14);
        let centre = at(0.0, self.neck_centre);
        let neck = Edge::start("neck", self.neck).curve(-left(along), centre, at(-1.0, 0.0), self.neck_reach, 18);
        [armhole, Edge::straight("shoulder", shoulder, self.neck), neck]
    }
}

/// Slope of a fitted shoulder.
pub const FITTED: f64 = SHOULDER_SLOPE;

/// Names of the mirrored edges.
pub fn left_name(right: &'static str) -> &'static str {
    match right {
        "side" => "side-2",
        "side-low" => "side-low-2",
        "side-top" => "side-top-2",
        "hem-side" => "hem-side-2",
        "armhole" => "armhole-2",
        "shoulder" => "shoulder-2",
        other => other,
    }
}
