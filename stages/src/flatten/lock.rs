//! Terms that hold what a pattern maker does not want to change.
//!
//! Every lock is a penalty `ψ = k c(x)²` on a distance `c` in metres. Its Hessian is that of Gauss and Newton, which is
//! exact where the lock is met.

use super::energy::Local;
use toile_garment::Vec2;

/// One thing that is held.
#[derive(Clone, Debug, PartialEq)]
pub enum Lock {
    /// The vertex `v[0]` lies on the line through `v[1]` and `v[2]`.
    OnLine {
        /// Vertex, and the ends of the line.
        v: [u32; 3],
        /// Stiffness against that of the triangles.
        stiffness: f64,
    },
    /// Two vertices keep their distance.
    Distance {
        /// The vertices.
        v: [u32; 2],
        /// Their distance, metres.
        length: f64,
        /// Stiffness against that of the triangles.
        stiffness: f64,
    },
    /// The angle at `v[1]` from the side to `v[2]` to the side to `v[0]`, counter-clockwise.
    Angle {
        /// Ends of both sides, the corner between them.
        v: [u32; 3],
        /// Radians.
        angle: f64,
        /// Length that turns the angle into a distance, metres.
        arm: f64,
        /// Stiffness against that of the triangles.
        stiffness: f64,
    },
}

impl Lock {
    /// The vertices it couples.
    #[must_use]
    pub fn vertices(&self) -> &[u32] {
        match self {
            Self::OnLine { v, .. } | Self::Angle { v, .. } => v,
            Self::Distance { v, .. } => v,
        }
    }

    /// Energy, m².
    #[must_use]
    pub fn energy(&self, x: &[Vec2]) -> f64 {
        let (c, _, stiffness) = self.residual(x);
        stiffness * c * c
    }

    /// Adds gradient and Hessian by `add`, which is told the vertices and the local term.
    pub fn assemble(&self, x: &[Vec2], mut add: impl FnMut(&[u32; 3], &Local<3>)) {
        let (c, g, stiffness) = self.residual(x);
        let v = match self {
            Self::OnLine { v, .. } | Self::Angle { v, .. } => *v,
            // A vertex may stand twice, with no share of its own.
            Self::Distance { v: [a, b], .. } => [*a, *b, *b],
        };
        let hessian = g.map(|a| g.map(|b| a * b.transpose() * (2.0 * stiffness)));
        add(&v, &Local { gradient: g.map(|g| g * (2.0 * stiffness * c)), hessian });
    }

    /// The distance `c`, its gradient by the vertices, and the stiffness.
    fn residual(&self, x: &[Vec2]) -> (f64, [Vec2; 3], f64) {
        match self {
            Self::OnLine { v, stiffness } => {
                let [p, a, b] = v.map(|i| x[i as usize]);
                let (d, r) = (b - a, p - a);
                let length = d.norm().max(1e-12);
                let n = Vec2::new(-d.y, d.x) / length;
                let share = r.dot(&d) / (length * length);
                (n.dot(&r), [n, -n * (1.0 - share), -n * share], *stiffness)
            }
            Self::Distance { v, length, stiffness } => {
                let d = x[v[1] as usize] - x[v[0] as usize];
                let now = d.norm().max(1e-12);
                (now - length, [-d / now, d / now, Vec2::zeros()], *stiffness)
            }
            Self::Angle { v, angle, arm, stiffness } => {
                let [p, o, q] = v.map(|i| x[i as usize]);
                let (a, b) = (q - o, p - o);
                let turned = libm::atan2(a.perp(&b), a.dot(&b));
                let tau = std::f64::consts::TAU;
                let off = turned - angle - tau * libm::round((turned - angle) / tau);
                let across = |d: Vec2| Vec2::new(-d.y, d.x) / d.norm_squared().max(1e-24);
                let (ga, gb) = (-across(a) * *arm, across(b) * *arm);
                (off * arm, [gb, -(ga + gb), ga], *stiffness)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gradients_agree_with_differences() {
        let x = [Vec2::new(0.3, 0.4), Vec2::new(0.1, -0.1), Vec2::new(1.1, 0.2)];
        let stiffness = 3.0;
        let locks = [
            Lock::OnLine { v: [0, 1, 2], stiffness },
            Lock::Distance { v: [0, 2], length: 0.5, stiffness },
            Lock::Angle { v: [0, 1, 2], angle: 0.7, arm: 0.2, stiffness },
        ];
        for lock in locks {
            let mut told = [Vec2::zeros(); 3];
            lock.assemble(&x, |v, term| {
                v.iter().zip(&term.gradient).for_each(|(v, g)| told[*v as usize] += g);
            });
            for i in 0..3 {
                for d in 0..2 {
                    let moved = |h: f64| {
                        let mut y = x;
                        y[i][d] += h;
                        lock.energy(&y)
                    };
                    let slope = (moved(1e-6) - moved(-1e-6)) / 2e-6;
                    assert!((slope - told[i][d]).abs() < 1e-7, "{lock:?}: {slope} {}", told[i][d]);
                }
            }
        }
    }
}
