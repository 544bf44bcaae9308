//! Terms that hold what a pattern maker does not want to change.
//!
//! Every lock is a penalty `ψ = k c(x)²` on a distance `c` in metres, which depends on two differences of vertices. The
//! projected Hessian is that of Gauss and Newton, `2k ∇c ∇cᵀ`. The exact one adds `2k c ∇²c`. Where locks pull against the
//! cloth, `c` is not zero, and `k` is so large that this part is as stiff as the cloth itself.

use super::energy::{Curvature, Local};
use nalgebra::Matrix2;
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
        let c = self.residual(x).value;
        self.stiffness() * c * c
    }

    /// Adds gradient and Hessian by `add`, which is told the vertices and the local term.
    pub fn assemble(&self, x: &[Vec2], curvature: Curvature, mut add: impl FnMut(&[u32; 3], &Local<3>)) {
        let (v, shares) = self.differences();
        let Residual { value, slope, bend } = self.residual(x);
        let k2 = 2.0 * self.stiffness();
        // From the two differences to the vertices.
        let at = |i: usize| shares[0][i] * slope[0] + shares[1][i] * slope[1];
        let bent = |i: usize, j: usize| {
            let part = |a: usize, b: usize| bend[a][b] * (shares[a][i] * shares[b][j]);
            part(0, 0) + part(0, 1) + part(1, 0) + part(1, 1)
        };
        let whole = if curvature == Curvature::Exact { value } else { 0.0 };
        let mut out = Local { gradient: [Vec2::zeros(); 3], hessian: [[Matrix2::zeros(); 3]; 3] };
        for i in 0..3 {
            out.gradient[i] = at(i) * (k2 * value);
            for j in 0..3 {
                out.hessian[i][j] = at(i) * at(j).transpose() * k2;
                if whole != 0.0 {
                    out.hessian[i][j] += bent(i, j) * (k2 * whole);
                }
            }
        }
        add(&v, &out);
    }

    fn stiffness(&self) -> f64 {
        match self {
            Self::OnLine { stiffness, .. } | Self::Distance { stiffness, .. } | Self::Angle { stiffness, .. } => {
                *stiffness
            }
        }
    }

    /// Three vertices, and the two differences that the lock depends on, as their multiples.
    fn differences(&self) -> ([u32; 3], [[f64; 3]; 2]) {
        match self {
            // The line, and the way from its start to the vertex.
            Self::OnLine { v, .. } => (*v, [[0.0, -1.0, 1.0], [1.0, -1.0, 0.0]]),
            // A vertex may stand twice, with no share of its own.
            Self::Distance { v: [a, b], .. } => ([*a, *b, *b], [[-1.0, 1.0, 0.0], [0.0; 3]]),
            // The sides from the corner.
            Self::Angle { v, .. } => (*v, [[0.0, -1.0, 1.0], [1.0, -1.0, 0.0]]),
        }
    }

    /// The distance `c` with its derivatives by both differences.
    fn residual(&self, x: &[Vec2]) -> Residual {
        let (v, shares) = self.differences();
        let difference = |s: [f64; 3]| v.iter().zip(s).map(|(v, s)| x[*v as usize] * s).sum::<Vec2>();
        let [u, w] = shares.map(difference);
        match self {
            Self::OnLine { .. } => off_line(u, w),
            Self::Distance { length, .. } => off_length(u, *length),
            Self::Angle { angle, arm, .. } => off_angle(u, w, *angle, *arm),
        }
    }
}

/// A distance with first and second derivatives by two vectors.
struct Residual {
    value: f64,
    slope: [Vec2; 2],
    bend: [[Matrix2<f64>; 2]; 2],
}

/// A quarter turn to the left.
fn left(d: Vec2) -> Vec2 {
    Vec2::new(-d.y, d.x)
}

/// How far `r` ends beside the line along `d`.
fn off_line(d: Vec2, r: Vec2) -> Residual {
    let length = d.norm().max(1e-12);
    let (t, n) = (d / length, left(d) / length);
    let (value, share) = (n.dot(&r), t.dot(&r) / length);
    // By `d`: the normal turns by `-t (n·δ) / length`. By `r`: the normal itself.
    let slope = [-n * share, n];
    let turning = -(t * n.transpose()) / length;
    let twice =
        (t * n.transpose() + n * t.transpose()) * (share / length) - n * n.transpose() * (value / (length * length));
    Residual { value, slope, bend: [[twice, turning.transpose()], [turning, Matrix2::zeros()]] }
}

/// How much longer `d` is than it shall be.
fn off_length(d: Vec2, length: f64) -> Residual {
    let now = d.norm().max(1e-12);
    let n = d / now;
    let none = Matrix2::zeros();
    let across = (Matrix2::identity() - n * n.transpose()) / now;
    Residual { value: now - length, slope: [n, Vec2::zeros()], bend: [[across, none], [none, none]] }
}

/// By how much the turn from `a` to `b` differs from an angle, at the end of an arm.
fn off_angle(a: Vec2, b: Vec2, angle: f64, arm: f64) -> Residual {
    let turned = libm::atan2(a.perp(&b), a.dot(&b));
    let tau = std::f64::consts::TAU;
    let off = turned - angle - tau * libm::round((turned - angle) / tau);
    let by = |d: Vec2| {
        let square = d.norm_squared().max(1e-24);
        let n = left(d) / square;
        // The direction of a vector has the gradient `left(d) / |d|²`.
        let second = -(n * d.transpose() + d * n.transpose()) / square;
        (n * arm, second * arm)
    };
    let ((ga, ha), (gb, hb)) = (by(a), by(b));
    let none = Matrix2::zeros();
    Residual { value: off * arm, slope: [-ga, gb], bend: [[-ha, none], [none, hb]] }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three points, and a lock of each kind that none of them meets.
    fn unmet() -> ([Vec2; 3], [Lock; 3]) {
        let x = [Vec2::new(0.3, 0.4), Vec2::new(0.1, -0.1), Vec2::new(1.1, 0.2)];
        let stiffness = 3.0;
        let locks = [
            Lock::OnLine { v: [0, 1, 2], stiffness },
            Lock::Distance { v: [0, 2], length: 0.5, stiffness },
            Lock::Angle { v: [0, 1, 2], angle: 0.7, arm: 0.2, stiffness },
        ];
        (x, locks)
    }

    /// Gradient and Hessian over the three points.
    fn whole(lock: &Lock, x: &[Vec2; 3], curvature: Curvature) -> ([Vec2; 3], [[Matrix2<f64>; 3]; 3]) {
        let mut out = ([Vec2::zeros(); 3], [[Matrix2::zeros(); 3]; 3]);
        lock.assemble(x, curvature, |v, term| {
            for i in 0..3 {
                out.0[v[i] as usize] += term.gradient[i];
                for j in 0..3 {
                    out.1[v[i] as usize][v[j] as usize] += term.hessian[i][j];
                }
            }
        });
        out
    }

    #[test]
    fn gradients_agree_with_differences() {
        let (x, locks) = unmet();
        for lock in locks {
            let (told, _) = whole(&lock, &x, Curvature::Projected);
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

    #[test]
    fn exact_hessians_agree_with_differences_where_a_lock_is_not_met() {
        let (x, locks) = unmet();
        for lock in locks {
            let (_, exact) = whole(&lock, &x, Curvature::Exact);
            for j in 0..3 {
                for d in 0..2 {
                    let moved = |h: f64| {
                        let mut y = x;
                        y[j][d] += h;
                        whole(&lock, &y, Curvature::Exact).0
                    };
                    let (up, down) = (moved(1e-6), moved(-1e-6));
                    for i in 0..3 {
                        let column = (up[i] - down[i]) / 2e-6;
                        assert!((column - exact[i][j].column(d)).norm() < 1e-6, "{lock:?}: {i} {j} {d}");
                    }
                }
            }
        }
    }
}
