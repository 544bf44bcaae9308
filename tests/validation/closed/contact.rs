//! Cloth on bodies.

use std::f64::consts::{PI, TAU};

/// Tension ratio of a strip that slides over a cylinder (Euler, Eytelwein).
pub fn capstan(mu: f64, wrap: f64) -> f64 {
    libm::exp(mu * wrap)
}

/// Longest tail that a heavy strip over a rod bears when the other tail is `l2`: half a turn, with the weight of the
/// strip on the rod.
pub fn heavy_capstan(radius: f64, l2: f64, mu: f64) -> f64 {
    let a = 2.0 * mu / (1.0 + mu * mu);
    radius * ((l2 / radius + a) * libm::exp(mu * PI) + a)
}

/// A curve at distance `off` outside an ellipse with half axes `a`, `b`, by the parameter of the ellipse.
pub struct Parallel {
    pub a: f64,
    pub b: f64,
    pub off: f64,
}

impl Parallel {
    pub fn point(&self, t: f64) -> [f64; 2] {
        let (s, c) = (libm::sin(t), libm::cos(t));
        let n = libm::hypot(self.b * c, self.a * s);
        [self.a * c + self.off * self.b * c / n, self.b * s + self.off * self.a * s / n]
    }

    /// A parallel curve is longer by the full turn of its normal.
    pub fn perimeter(&self) -> f64 {
        let n = 20_000;
        let speed = |i: i32| {
            let t = TAU * f64::from(i) / f64::from(n);
            libm::hypot(self.a * libm::sin(t), self.b * libm::cos(t))
        };
        (0..n).map(speed).sum::<f64>() * TAU / f64::from(n) + TAU * self.off
    }

    /// Largest and smallest curvature, at the ends of the long and of the short axis.
    pub fn curvatures(&self) -> [f64; 2] {
        let of = |radius: f64| 1.0 / (radius + self.off);
        [of(self.b * self.b / self.a), of(self.a * self.a / self.b)]
    }
}
