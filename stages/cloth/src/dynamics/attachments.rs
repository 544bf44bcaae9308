//! The body in time, and what hangs on it: held vertices near the body go where it goes.

use crate::collision::body::Body;
use crate::collision::narrow_phase::distance::point_triangle;
use crate::dynamics::tuning::ATTACHMENT_DISTANCE;
use crate::{Motion, Vec3};
use nalgebra::{Matrix3, Rotation3};

/// The body's path: a pose to start from, a lead-in, frames.
pub(crate) struct Path {
    pose: Vec<Vec3>,
    frames: Vec<Vec<Vec3>>,
    fps: f64,
    /// Time before frame 0, s.
    pub lead_in: f64,
    /// Largest distance from the pose to frame 0, m.
    pub lead_in_distance: f64,
}

impl Path {
    pub fn new(motion: &Motion, pose: &[Vec3]) -> Option<Self> {
        let first = motion.body.first()?;
        let lead_in_distance = crate::farthest(pose, first);
        let lead_in = if lead_in_distance > 1e-6 { motion.lead_in } else { 0.0 };
        Some(Self { pose: pose.to_vec(), frames: motion.body.clone(), fps: motion.fps, lead_in, lead_in_distance })
    }

    /// Time at which the body stops, s.
    pub fn end(&self) -> f64 {
        (self.frames.len() - 1) as f64 / self.fps
    }

    /// Places at a time (frame 0 at 0): cubic through the frames, so that the velocity does not jump at them.
    pub fn at(&self, seconds: f64) -> Vec<Vec3> {
        if seconds < 0.0 {
            let s = if self.lead_in > 0.0 { (1.0 + seconds / self.lead_in).clamp(0.0, 1.0) } else { 0.0 };
            let ease = s * s * (3.0 - 2.0 * s);
            return self.pose.iter().zip(&self.frames[0]).map(|(p, q)| p + (q - p) * ease).collect();
        }
        let last = self.frames.len() - 1;
        let time = seconds * self.fps;
        let k = (time.floor() as usize).min(last);
        let t = time - k as f64;
        if k == last || t <= 0.0 {
            return self.frames[k].clone();
        }
        let (a, b) = (&self.frames[k], &self.frames[k + 1]);
        let (before, after) = (&self.frames[k.saturating_sub(1)], &self.frames[(k + 2).min(last)]);
        let slope = |i: usize| {
            let one = if k > 0 { (b[i] - before[i]) * 0.5 } else { b[i] - a[i] };
            let two = if k + 2 <= last { (after[i] - a[i]) * 0.5 } else { b[i] - a[i] };
            (one, two)
        };
        let (t2, t3) = (t * t, t * t * t);
        (0..a.len())
            .map(|i| {
                let (m, n) = slope(i);
                a[i] + (b[i] - a[i]) * (3.0 * t2 - 2.0 * t3) + m * (t3 - 2.0 * t2 + t) + n * (t3 - t2)
            })
            .collect()
    }
}

/// A held vertex: where it is, or how it hangs on a body triangle.
pub(crate) struct Attachment {
    pub vertex: u32,
    at: Vec3,
    hangs: Option<(u32, [f64; 3], Vec3)>,
}

/// Axes of a triangle.
fn axes(t: &[Vec3; 3]) -> Matrix3<f64> {
    Rotation3::face_towards(&(t[1] - t[0]).cross(&(t[2] - t[0])), &(t[1] - t[0])).into_inner()
}

impl Attachment {
    pub fn new(vertex: u32, at: Vec3, body: Option<&Body>) -> Self {
        let mut best: Option<(f64, u32, [f64; 3], Vec3)> = None;
        for g in body.iter().flat_map(|b| (0u32..).take(b.topology.faces.len())) {
            let Some(t) = body.map(|b| b.triangle(g)) else { continue };
            let w = point_triangle(&at, &t[0], &t[1], &t[2]);
            let away = at - (t[0] * w[0] + t[1] * w[1] + t[2] * w[2]);
            if away.norm() < best.as_ref().map_or(ATTACHMENT_DISTANCE.get(), |b| b.0) {
                best = Some((away.norm(), g, w, axes(&t).transpose() * away));
            }
        }
        Self { vertex, at, hangs: best.map(|(_, g, w, away)| (g, w, away)) }
    }

    /// Its place for places of the body's vertices.
    pub fn place(&self, faces: &[[u32; 3]], body: &[Vec3]) -> Vec3 {
        let Some((g, w, away)) = &self.hangs else { return self.at };
        let t = crate::pick3(body, &faces[*g as usize]);
        t[0] * w[0] + t[1] * w[1] + t[2] * w[2] + axes(&t) * away
    }
}
