//! Laying the flattened piece back on its stored grain.

use nalgebra::Matrix2;
use toile_garment::Vec2;

/// A rotation and shift in the plane: `x ↦ R x + shift`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rigid {
    rotation: Matrix2<f64>,
    shift: Vec2,
}

impl Rigid {
    /// The rotation and shift (no mirror) that lay `from` best on `to`, with weights.
    #[must_use]
    pub fn best(from: &[Vec2], to: &[Vec2], weight: &[f64]) -> Self {
        let (a, b) = (centre(from, weight), centre(to, weight));
        let mut turn = Vec2::zeros();
        for ((p, q), w) in from.iter().zip(to).zip(weight) {
            turn += turn_of(p - a, q - b) * *w;
        }
        Self::about(turn, a, b)
    }

    /// The rotation that turns direction `from` into `to`, and the shift that lays the weighted centres on each other.
    #[must_use]
    pub fn along(from: Vec2, to: Vec2, flat: &[Vec2], stored: &[Vec2], weight: &[f64]) -> Self {
        Self::about(turn_of(from, to), centre(flat, weight), centre(stored, weight))
    }

    fn about(turn: Vec2, from: Vec2, to: Vec2) -> Self {
        let n = turn.norm();
        let (c, s) = if n > 0.0 { (turn.x / n, turn.y / n) } else { (1.0, 0.0) };
        let rotation = Matrix2::new(c, -s, s, c);
        Self { rotation, shift: to - rotation * from }
    }

    /// A point where it comes to lie.
    #[must_use]
    pub fn apply(&self, p: Vec2) -> Vec2 {
        self.rotation * p + self.shift
    }
}

/// Signed angle from `a` to `b`, radians.
#[must_use]
pub fn angle_between(a: Vec2, b: Vec2) -> f64 {
    let t = turn_of(a, b);
    libm::atan2(t.y, t.x)
}

/// (dot, cross): the turn from a to b, scaled by both lengths.
fn turn_of(a: Vec2, b: Vec2) -> Vec2 {
    Vec2::new(a.dot(&b), a.x * b.y - a.y * b.x)
}

fn centre(p: &[Vec2], weight: &[f64]) -> Vec2 {
    let sum: f64 = weight.iter().sum();
    p.iter().zip(weight).map(|(p, w)| p * *w).sum::<Vec2>() / if sum > 0.0 { sum } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_a_known_motion_and_leaves_equal_shapes_bit_for_bit() {
        let p = [Vec2::new(0.1, 0.2), Vec2::new(0.7, 0.1), Vec2::new(0.3, 0.9)];
        let (c, s) = (libm::cos(0.7), libm::sin(0.7));
        let q = p.map(|p| Matrix2::new(c, -s, s, c) * p + Vec2::new(3.0, -1.0));
        let w = [1.0, 2.0, 0.5];
        let fit = Rigid::best(&q, &p, &w);
        assert!(q.iter().zip(&p).all(|(q, p)| (fit.apply(*q) - p).norm() < 1e-14));
        let same = Rigid::best(&p, &p, &w);
        assert!(p.iter().all(|x| same.apply(*x) == *x));
        assert!((angle_between(p[1] - p[0], q[1] - q[0]) - 0.7).abs() < 1e-14);
    }
}
