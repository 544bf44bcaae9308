//! The energies of the flattening: triangles that resist stretch, and equal lengths of sewn edges.
//!
//! Triangles: the symmetric Dirichlet energy `ψ = A/4 (‖F‖² + ‖F⁻¹‖² − 4) = A/4 Σ (s − 1/s)²`, with `F` from the target
//! triangle to the flat one and `s` its singular values. It counts the way of the cloth in both directions and grows
//! without bound towards a flipped triangle. For small strains `ε` it is `A Σ ε²`. (Smith and Schaefer 2015 for the
//! energy; Smith, de Goes and Kim 2019 for the eigenvalues of its Hessian.)
//!
//! Pairs: `ψ = k (lₐ/ρₐ − l_b/ρ_b)²`: two sewn edges keep the ratio of their stored lengths and choose their common
//! stretch themselves.

use nalgebra::Matrix2;
use toile_garment::Vec2;

/// Which Hessian of a term is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Curvature {
    /// The second derivative as it is. Newton converges quadratically with it where it is positive.
    Exact,
    /// Its negative eigenvalues are left out, so that every direction leads downhill.
    Projected,
}

/// A triangle with its target shape.
#[derive(Clone, Debug)]
pub struct Triangle {
    /// Corners.
    pub v: [u32; 3],
    /// Shape functions: `F = Σ x_k ⊗ b_k`.
    b: [Vec2; 3],
    /// Area of the target.
    pub area: f64,
}

/// Gradient and Hessian blocks of one term; blocks are indexed by local corner.
pub struct Local<const N: usize> {
    /// One vector per corner.
    pub gradient: [Vec2; N],
    /// `hessian[i][j]` couples corner i to corner j.
    pub hessian: [[Matrix2<f64>; N]; N],
}

/// A map of the plane as a turn and a mirrored turn: `F = ½(s₁+s₂) R + ½(s₁−s₂) M`.
struct Parts {
    /// Singular values, the larger first; the second is negative where the map flips.
    s: [f64; 2],
    /// The nearest rotation `R`.
    turn: Matrix2<f64>,
    /// The mirrored turn `M`.
    mirror: Matrix2<f64>,
}

impl Parts {
    fn of(f: &Matrix2<f64>) -> Self {
        let u = Vec2::new(f.m11 + f.m22, f.m21 - f.m12);
        let d = Vec2::new(f.m11 - f.m22, f.m21 + f.m12);
        let (nu, nd) = (u.norm(), d.norm());
        let unit = |v: Vec2, n: f64| if n > 1e-300 { v / n } else { Vec2::new(1.0, 0.0) };
        let (u, d) = (unit(u, nu), unit(d, nd));
        Self {
            s: [0.5 * (nu + nd), 0.5 * (nu - nd)],
            turn: Matrix2::new(u.x, -u.y, u.y, u.x),
            mirror: Matrix2::new(d.x, d.y, d.y, -d.x),
        }
    }
}

/// First and second derivative of `¼ (s − 1/s)²`.
fn slopes(s: f64) -> (f64, f64) {
    let inverse = 1.0 / s;
    let square = inverse * inverse;
    (0.5 * (s - inverse) * (1.0 + square), 0.5 + 1.5 * square * square)
}

impl Triangle {
    /// A triangle whose target has these edge vectors. `None` when the target has no area or is mirrored.
    #[must_use]
    pub fn new(v: [u32; 3], target: &Matrix2<f64>) -> Option<Self> {
        let area = 0.5 * target.determinant();
        if !(area.is_finite() && area > 1e-14) {
            return None;
        }
        let inverse = target.try_inverse()?;
        let (b1, b2) = (inverse.row(0).transpose(), inverse.row(1).transpose());
        Some(Self { v, b: [-(b1 + b2), b1, b2], area })
    }

    fn gradient_of(&self, x: &[Vec2]) -> Matrix2<f64> {
        let [p, q, r] = self.v.map(|v| x[v as usize]);
        (q - p) * self.b[1].transpose() + (r - p) * self.b[2].transpose()
    }

    /// Energy, m²; infinite for a triangle that is flipped or has no area.
    #[must_use]
    pub fn energy(&self, x: &[Vec2]) -> f64 {
        let [s1, s2] = self.stretches(x);
        if s2 <= 0.0 {
            return f64::INFINITY;
        }
        let (a, b) = (s1 - 1.0 / s1, s2 - 1.0 / s2);
        0.25 * self.area * (a * a + b * b)
    }

    /// Singular values of the map from target to flat, the larger first; the second is negative after a flip.
    #[must_use]
    pub fn stretches(&self, x: &[Vec2]) -> [f64; 2] {
        Parts::of(&self.gradient_of(x)).s
    }

    /// Gradient and Hessian.
    #[must_use]
    pub fn local(&self, x: &[Vec2], curvature: Curvature) -> Local<3> {
        let Parts { s, turn, mirror } = Parts::of(&self.gradient_of(x));
        let [(g1, h1), (g2, h2)] = s.map(slopes);
        let (sum, difference) = (0.5 * (g1 + g2), 0.5 * (g1 - g2));
        let p = (turn * sum + mirror * difference) * self.area;
        let quarter = Matrix2::new(0.0, -1.0, 1.0, 0.0);
        let twist = 2.0 * sum / (s[0] + s[1]);
        let twist = if curvature == Curvature::Projected { twist.max(0.0) } else { twist };
        let apart = s[0] - s[1];
        let flip = if apart > 1e-6 { 2.0 * difference / apart } else { 0.5 * (h1 + h2) };
        // Orthogonal directions of the 2×2 matrices with the eigenvalues of the Hessian.
        let root = std::f64::consts::FRAC_1_SQRT_2;
        let modes = [
            ((turn + mirror) * 0.5, h1),
            ((turn - mirror) * 0.5, h2),
            (turn * quarter * root, twist),
            (mirror * quarter * root, flip),
        ];
        let mut out = Local { gradient: self.b.map(|b| p * b), hessian: [[Matrix2::zeros(); 3]; 3] };
        for (direction, eigenvalue) in modes {
            let d = self.b.map(|b| direction * b);
            let scale = eigenvalue * self.area;
            for i in 0..3 {
                for j in 0..3 {
                    out.hessian[i][j] += d[i] * d[j].transpose() * scale;
                }
            }
        }
        out
    }
}

/// Two sewn edges that keep the ratio of their stored lengths.
#[derive(Clone, Debug, PartialEq)]
pub struct EdgePair {
    /// Ends of edge a, then of edge b.
    pub v: [u32; 4],
    /// Stored lengths over their mean.
    pub share: [f64; 2],
    /// Stiffness against that of the triangles.
    pub stiffness: f64,
}

impl EdgePair {
    fn parts(&self, x: &[Vec2]) -> Option<([Vec2; 2], [f64; 2], f64)> {
        let [a0, a1, b0, b1] = self.v.map(|i| x[i as usize]);
        let (a, b) = (a1 - a0, b1 - b0);
        let (la, lb) = (a.norm(), b.norm());
        if la < 1e-12 || lb < 1e-12 {
            return None;
        }
        Some(([a / la, b / lb], [la, lb], la / self.share[0] - lb / self.share[1]))
    }

    /// Energy, m².
    #[must_use]
    pub fn energy(&self, x: &[Vec2]) -> f64 {
        self.parts(x).map_or(0.0, |(_, _, c)| self.stiffness * c * c)
    }

    /// Gradient and Hessian. The projected one is Gauss–Newton, plus the bending part of the longer edge.
    #[must_use]
    pub fn local(&self, x: &[Vec2], curvature: Curvature) -> Option<Local<4>> {
        let ([na, nb], length, c) = self.parts(x)?;
        let (ga, gb) = (na / self.share[0], nb / self.share[1]);
        let dc = [-ga, ga, gb, -gb];
        let k2 = 2.0 * self.stiffness;
        let mut out = Local { gradient: dc.map(|g| g * (k2 * c)), hessian: [[Matrix2::zeros(); 4]; 4] };
        for i in 0..4 {
            for j in 0..4 {
                out.hessian[i][j] = dc[i] * dc[j].transpose() * k2;
            }
        }
        let bends = [(0, na, c / (self.share[0] * length[0])), (2, nb, -c / (self.share[1] * length[1]))];
        for (first, n, scale) in bends {
            if scale <= 0.0 && curvature == Curvature::Projected {
                continue;
            }
            let across = (Matrix2::identity() - n * n.transpose()) * (k2 * scale);
            for i in 0..2 {
                for j in 0..2 {
                    out.hessian[first + i][first + j] += if i == j { across } else { -across };
                }
            }
        }
        Some(out)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numeric<const N: usize>(x: &[Vec2], v: [u32; N], energy: impl Fn(&[Vec2]) -> f64) -> [Vec2; N] {
        v.map(|i| {
            let mut g = Vec2::zeros();
            for d in 0..2 {
                let mut side = [0.0; 2];
                for (s, h) in side.iter_mut().zip([1e-6, -1e-6]) {
                    let mut y = x.to_vec();
                    y[i as usize][d] += h;
                    *s = energy(&y);
                }
                g[d] = (side[0] - side[1]) / 2e-6;
            }
            g
        })
    }

    #[test]
    fn gradients_agree_with_differences() {
        let x = [Vec2::new(0.0, 0.1), Vec2::new(1.1, 0.0), Vec2::new(0.3, 0.9), Vec2::new(1.4, 1.2)];
        let t = Triangle::new([0, 1, 2], &Matrix2::new(1.0, 0.4, 0.1, 0.8)).expect("triangle");
        let n = numeric(&x, t.v, |y| t.energy(y));
        let p = EdgePair { v: [0, 1, 2, 3], share: [1.1, 0.9], stiffness: 3.0 };
        let m = numeric(&x, p.v, |y| p.energy(y));
        for (a, b) in t
            .local(&x, Curvature::Exact)
            .gradient
            .iter()
            .zip(&n)
            .chain(p.local(&x, Curvature::Exact).expect("pair").gradient.iter().zip(&m))
        {
            assert!((a - b).norm() < 1e-8, "{a} {b}");
        }
    }

    /// Largest difference between a Hessian and the differences of its gradient.
    fn off<const N: usize>(x: &[Vec2], v: [u32; N], local: impl Fn(&[Vec2]) -> Local<N>) -> f64 {
        let exact = local(x);
        let mut worst = 0.0f64;
        for j in 0..N {
            for d in 0..2 {
                let moved = |h: f64| {
                    let mut y = x.to_vec();
                    y[v[j] as usize][d] += h;
                    local(&y).gradient
                };
                let (up, down) = (moved(1e-6), moved(-1e-6));
                for i in 0..N {
                    let column = (up[i] - down[i]) / 2e-6;
                    worst = worst.max((column - exact.hessian[i][j].column(d)).norm());
                }
            }
        }
        worst
    }

    #[test]
    fn exact_hessians_agree_with_differences() {
        let x = [Vec2::new(0.0, 0.1), Vec2::new(1.5, 0.0), Vec2::new(0.3, 1.4), Vec2::new(0.9, 1.2)];
        let t = Triangle::new([0, 1, 2], &Matrix2::new(1.0, 0.4, 0.1, 0.8)).expect("triangle");
        assert!(off(&x, t.v, |y| t.local(y, Curvature::Exact)) < 1e-6);
        // Compressed: the twist has a negative eigenvalue.
        let small: Vec<Vec2> = x.iter().map(|p| p * 0.4).collect();
        assert!(off(&small, t.v, |y| t.local(y, Curvature::Exact)) < 1e-5);
        let p = EdgePair { v: [0, 1, 2, 3], share: [1.1, 0.9], stiffness: 3.0 };
        assert!(off(&x, p.v, |y| p.local(y, Curvature::Exact).expect("pair")) < 1e-6);
    }

    #[test]
    fn a_flipped_triangle_has_infinite_energy() {
        let t = Triangle::new([0, 1, 2], &Matrix2::new(1.0, 0.0, 0.0, 1.0)).expect("triangle");
        let x = [Vec2::new(0.0, 0.0), Vec2::new(1.0, 0.0), Vec2::new(0.0, -1.0)];
        assert_eq!(t.energy(&x), f64::INFINITY);
    }

    #[test]
    fn a_turned_target_costs_nothing() {
        let t = Triangle::new([0, 1, 2], &Matrix2::new(1.0, 0.0, 0.0, 1.0)).expect("triangle");
        let x = [Vec2::new(5.0, 5.0), Vec2::new(5.6, 5.8), Vec2::new(4.2, 5.6)];
        assert!(t.energy(&x) < 1e-30);
        assert!(Triangle::new([0, 1, 2], &Matrix2::new(1.0, 2.0, 1.0, 2.0)).is_none());
    }
}
