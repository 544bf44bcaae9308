//! Implicit solids: negative inside, zero on the surface, about the distance in metres near it.

use super::curve::Curve;
use toile_garment::Vec3;

/// Value and approximate gradient of a field at a point.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Signed distance, metres (approximate).
    pub value: f64,
    /// Its gradient (approximate; about unit length).
    pub slope: Vec3,
}

impl Sample {
    const FAR: Self = Self { value: 1.0, slope: Vec3::new(0.0, 0.0, 0.0) };

    /// Union with a fillet of width `k` (cubic smooth minimum, twice differentiable).
    #[must_use]
    pub fn join(self, other: Self, k: f64) -> Self {
        let (near, far) = if self.value <= other.value { (self, other) } else { (other, self) };
        let h = 1.0 - (far.value - near.value) / k;
        if h <= 0.0 {
            return near;
        }
        let weight = 0.5 * h * h;
        Self { value: near.value - h * h * h * k / 6.0, slope: near.slope * (1.0 - weight) + far.slope * weight }
    }
}

/// A section swept along a straight axis: half sizes and centre vary along it, both ends rounded.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// Origin of the axis, metres.
    pub origin: Vec3,
    /// Unit axes u, v (across) and w (along).
    pub axes: [Vec3; 3],
    /// Half sizes along u and v and centre offsets along u and v, by position along w; metres.
    pub keys: Curve<4>,
    /// Exponent of the section: 2 is an ellipse, larger is squarer.
    pub power: f64,
    /// Length of the rounded ends before the first and after the last key, metres.
    pub caps: [f64; 2],
}

/// How far from a solid its distance still matters: the widest fillet.
const REACH: f64 = 0.08;

impl Sweep {
    /// Samples the field.
    pub fn at(&self, p: Vec3) -> Sample {
        let local = p - self.origin;
        let [u, v, t] = self.axes.map(|a| a.dot(&local));
        let (low, high) = self.keys.range();
        let widest = self.keys.largest;
        let outside = u.abs() > widest[0] + widest[2] + REACH
            || v.abs() > widest[1] + widest[3] + REACH
            || t < low - self.caps[0] - REACH
            || t > high + self.caps[1] + REACH;
        if outside { Sample::FAR } else { self.near(u, v, t, low, high) }
    }

    fn near(&self, u: f64, v: f64, t: f64, low: f64, high: f64) -> Sample {
        let (row, slope) = self.keys.at(t);
        let (a, b) = (row[0].max(1e-3), row[1].max(1e-3));
        let (along, cap) = if t < low {
            ((t - low) / self.caps[0], self.caps[0])
        } else if t > high {
            ((t - high) / self.caps[1], self.caps[1])
        } else {
            (0.0, 1.0)
        };
        let (across_u, across_v) = ((u - row[2]) / a, (v - row[3]) / b);
        let (q, [gu, gv, gt]) = norm([across_u, across_v, along], self.power);
        if q < 1e-3 {
            return Sample { value: -a.min(b), slope: self.axes[0] };
        }
        let du = gu / a;
        let dv = gv / b;
        let dt = gt / cap - gu * (slope[2] + across_u * slope[0]) / a - gv * (slope[3] + across_v * slope[1]) / b;
        let gradient = self.axes[0] * du + self.axes[1] * dv + self.axes[2] * dt;
        let steep = gradient.norm().max(1e-9);
        Sample { value: (q - 1.0) / steep, slope: gradient / steep }
    }
}

/// The p-norm of three numbers and its gradient.
fn norm(x: [f64; 3], power: f64) -> (f64, [f64; 3]) {
    if power == 2.0 {
        let q = (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt();
        return (q, x.map(|c| c / q.max(1e-12)));
    }
    let raised = x.map(|c| if c == 0.0 { 0.0 } else { libm::pow(c.abs(), power) });
    let q = libm::pow(raised[0] + raised[1] + raised[2], 1.0 / power);
    let scale = libm::pow(q.max(1e-12), 1.0 - power);
    (q, [0, 1, 2].map(|i| if x[i] == 0.0 { 0.0 } else { raised[i] / x[i] * scale }))
}

/// An egg: an ellipsoid with two radii along each axis (towards − and towards +).
#[derive(Clone, Debug)]
pub struct Egg {
    /// Centre, metres.
    pub centre: Vec3,
    /// Radii towards −x, −y, −z, metres.
    pub minus: Vec3,
    /// Radii towards +x, +y, +z, metres.
    pub plus: Vec3,
}

impl Egg {
    /// Samples the field.
    pub fn at(&self, p: Vec3) -> Sample {
        let local = p - self.centre;
        let radii = local.zip_zip_map(&self.minus, &self.plus, |x, m, p| if x < 0.0 { m } else { p });
        if local.zip_map(&radii, |x, r| x.abs() - r).max() > REACH {
            return Sample::FAR;
        }
        let scaled = local.component_div(&radii);
        let q = scaled.norm();
        if q < 1e-3 {
            return Sample { value: -radii.min(), slope: Vec3::x() };
        }
        let gradient = scaled.component_div(&radii) / q;
        let steep = gradient.norm();
        Sample { value: (q - 1.0) / steep, slope: gradient / steep }
    }
}

/// Mirrors a point in the body's plane of symmetry.
pub fn mirrored(p: Vec3) -> Vec3 {
    Vec3::new(-p.x, p.y, p.z)
}

/// A solid of the left side joined with its mirror image.
pub fn pair(p: Vec3, k: f64, solid: impl Fn(Vec3) -> Sample) -> Sample {
    let mut right = solid(mirrored(p));
    right.slope.x = -right.slope.x;
    solid(p).join(right, k)
}
