//! Where the picture is taken from: an orthographic camera that looks level or a little downwards.

use toile_garment::Vec3;

/// A fixed view of the garment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// From the front.
    Front,
    /// From the back.
    Back,
    /// From the wearer's left.
    Left,
    /// From the wearer's right.
    Right,
    /// From the front and the wearer's left, a little from above.
    ThreeQuarter,
    /// The pieces, laid flat side by side.
    Flat,
}

impl View {
    /// All views, in the order in which people ask for them.
    pub const ALL: [Self; 6] = [Self::Front, Self::Back, Self::Left, Self::Right, Self::ThreeQuarter, Self::Flat];

    /// Its name, as pipelines write it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::Back => "back",
            Self::Left => "left",
            Self::Right => "right",
            Self::ThreeQuarter => "three-quarter",
            Self::Flat => "flat",
        }
    }

    /// Turn of the camera around the wearer from the front to the left, and its height above the horizon, degrees.
    fn angles(self) -> [f64; 2] {
        match self {
            Self::Front | Self::Flat => [0.0, 0.0],
            Self::Back => [180.0, 0.0],
            Self::Left => [90.0, 0.0],
            Self::Right => [-90.0, 0.0],
            Self::ThreeQuarter => [38.0, 12.0],
        }
    }
}

/// An orthographic camera: axes of the picture in space, and its scale.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    /// To the right of the picture, unit.
    pub right: Vec3,
    /// Upwards in the picture, unit.
    pub up: Vec3,
    /// From the scene to the eye, unit.
    pub toward: Vec3,
    /// The point in the middle of the picture, metres.
    pub centre: Vec3,
    /// Pixels per metre.
    pub scale: f64,
    /// The middle of the picture, pixels.
    pub middle: [f64; 2],
}

impl Camera {
    /// A camera for a view, without a place and a scale.
    #[must_use]
    pub fn of(view: View) -> Self {
        let [turn, rise] = view.angles().map(f64::to_radians);
        let ((st, ct), (sr, cr)) = (libm::sincos(turn), libm::sincos(rise));
        Self {
            right: Vec3::new(ct, 0.0, -st),
            up: Vec3::new(-st * sr, cr, -ct * sr),
            toward: Vec3::new(st * cr, sr, ct * cr),
            centre: Vec3::zeros(),
            scale: 1.0,
            middle: [0.0; 2],
        }
    }

    /// Width and height of a frame around points, metres, with its middle.
    #[must_use]
    pub fn frame<'p>(&self, points: impl Iterator<Item = &'p Vec3>) -> Option<([f64; 2], Vec3)> {
        let axes = [self.right, self.up, self.toward];
        let far = [f64::INFINITY; 3];
        let (low, high) = points.fold((far, far.map(|x| -x)), |(mut low, mut high), p| {
            for (k, axis) in axes.iter().enumerate() {
                let x = p.dot(axis);
                low[k] = if x < low[k] { x } else { low[k] };
                high[k] = if x > high[k] { x } else { high[k] };
            }
            (low, high)
        });
        let middle = (0..3).map(|k| axes[k] * (0.5 * (low[k] + high[k]))).sum();
        (low[0] <= high[0]).then(|| ([high[0] - low[0], high[1] - low[1]], middle))
    }

    /// A point in the picture: pixels to the right, pixels downwards, metres towards the eye.
    #[must_use]
    pub fn place(&self, p: Vec3) -> [f64; 3] {
        let d = p - self.centre;
        let [x, y] = self.middle;
        [x + self.scale * d.dot(&self.right), y - self.scale * d.dot(&self.up), d.dot(&self.toward)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_wearers_left_is_where_it_is_seen() {
        let left = Vec3::new(1.0, 0.0, 0.0);
        let x = |view| Camera::of(view).place(left)[0];
        assert!((x(View::Front) - 1.0).abs() < 1e-12 && (x(View::Back) + 1.0).abs() < 1e-12);
        // From the left it is nearest to the eye; the front is to the left of the picture.
        let from_left = Camera::of(View::Left);
        assert!((from_left.place(left)[2] - 1.0).abs() < 1e-12);
        assert!(from_left.place(Vec3::z())[0] < -0.999);
        for view in View::ALL {
            let c = Camera::of(view);
            assert!((c.right.cross(&c.up) - c.toward).norm() < 1e-12, "{view:?}");
        }
    }
}
