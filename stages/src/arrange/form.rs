//! The body as pieces are arranged around it: its segments, its waist, its shoulders, its surface.

use toile_garment::Vec3;
use toile_garment::body::{Body, BodySegment};

/// Width of the strip in which the top of a shoulder is looked for, m.
const SHOULDER_STRIP: f64 = 0.015;
/// Least distance of a place on the shoulder from the middle, m: the head is narrower.
const SHOULDER_INNER: f64 = 0.105;

/// A body to dress. Without one it is a woman of 1.68 m in a pose with arms half raised.
#[derive(Clone, Debug)]
pub struct Form {
    /// Torso, from the neck down to the crotch.
    pub torso: BodySegment,
    /// Left and right arm, from the shoulder to the wrist.
    pub arms: [BodySegment; 2],
    /// Left and right leg, from the hip to the ankle.
    pub legs: [BodySegment; 2],
    /// Neck, from the head down.
    pub neck: BodySegment,
    /// Height of the waist, m.
    pub waist: f64,
    /// Surface, m; empty where there is no mesh.
    pub surface: Vec<Vec3>,
}

impl Form {
    /// The form of a body; what it does not name is that of the usual body, scaled to its height.
    #[must_use]
    pub fn of(body: Option<&Body>) -> Self {
        let surface = body.map(|b| b.positions.clone()).unwrap_or_default();
        let height = surface.iter().map(|p| p.y).fold(0.0, f64::max);
        let usual = Self::usual(if height > 0.0 { height / USUAL_HEIGHT } else { 1.0 });
        let Some(body) = body else { return usual };
        let segment = |name: &str, other: &BodySegment| body.segments.get(name).unwrap_or(other).clone();
        let landmark = ["waist", "waist-front"].iter().find_map(|name| body.landmarks.get(*name)).map(|p| p.y);
        let waist = landmark.or_else(|| body.measures.get("waist_height").copied()).unwrap_or(usual.waist);
        Self {
            torso: segment("torso", &usual.torso),
            arms: [segment("arm-left", &usual.arms[0]), segment("arm-right", &usual.arms[1])],
            legs: [segment("leg-left", &usual.legs[0]), segment("leg-right", &usual.legs[1])],
            neck: as_wide_as_deep(segment("neck", &usual.neck)),
            waist,
            surface,
        }
    }

    /// The usual body, times a factor.
    fn usual(factor: f64) -> Self {
        let segment = |from: [f64; 3], to: [f64; 3], half_width: f64, half_depth: f64| BodySegment {
            from: Vec3::from(from) * factor,
            to: Vec3::from(to) * factor,
            half_width: half_width * factor,
            half_depth: half_depth * factor,
        };
        let mirrored = |s: &BodySegment| {
            let turn = |p: Vec3| Vec3::new(-p.x, p.y, p.z);
            BodySegment { from: turn(s.from), to: turn(s.to), ..s.clone() }
        };
        let arm = segment([0.152, 1.352, -0.014], [0.524, 0.908, -0.014], 0.045, 0.047);
        let leg = segment([0.09, 0.82, -0.018], [0.086, 0.084, -0.026], 0.071, 0.08);
        Self {
            torso: segment([0.0, 1.385, -0.01], [0.0, 0.77, -0.01], 0.178, 0.112),
            arms: [arm.clone(), mirrored(&arm)],
            legs: [leg.clone(), mirrored(&leg)],
            neck: segment([0.0, 1.49, 0.005], [0.0, 1.405, -0.02], 0.07, 0.069),
            waist: 1.05 * factor,
            surface: Vec::new(),
        }
    }

    /// Height of the shoulder at a distance from the middle, m.
    #[must_use]
    pub fn shoulder(&self, x: f64) -> f64 {
        let joint = self.arms[0].from;
        let away = x.abs().clamp(SHOULDER_INNER, joint.x.abs().max(SHOULDER_INNER));
        let near = self.surface.iter().filter(|p| (p.x.abs() - away).abs() < SHOULDER_STRIP).map(|p| p.y);
        let top = near.fold(f64::NEG_INFINITY, f64::max);
        // Arms that are stretched upwards are no shoulders.
        if top.is_finite() { top.min(self.torso.from.y.max(joint.y) + 0.08) } else { self.torso.from.y }
    }

    /// Height at which arms leave the torso, m.
    #[must_use]
    pub fn armpit(&self) -> f64 {
        self.arms[0].from.y - 2.5 * self.arms[0].half_width.max(self.arms[0].half_depth)
    }
}

/// The neck without the slope of the shoulders, which its segment reaches down to: it is no wider than deep.
fn as_wide_as_deep(neck: BodySegment) -> BodySegment {
    BodySegment { half_width: neck.half_width.min(neck.half_depth), ..neck }
}

/// Height of the usual body, m.
const USUAL_HEIGHT: f64 = 1.68;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_a_body_the_usual_one_stands_in() {
        let form = Form::of(None);
        assert!(form.arms[0].from.x > 0.0 && form.arms[1].from.x < 0.0);
        assert!(form.waist > form.torso.to.y && form.waist < form.torso.from.y);
        assert!((form.shoulder(0.15) - form.torso.from.y).abs() < 1e-12);
        assert!(form.armpit() < form.arms[0].from.y && form.armpit() > form.waist);
    }
}
