//! The two energies of the flattening: as-rigid-as-possible triangles, and equal-length pairs.
//!
//! Triangles: `ψ = A ‖F − R‖²` with `F` from the target triangle to the flat one and `R` its nearest rotation. In the
//! plane `ψ = A (‖F‖² − 2w + 2)` with `w = |(F₁₁ + F₂₂, F₂₁ − F₁₂)|`. The Hessian is `A (2I − 2κ q qᵀ)`, with `κ = 1/w`
//! and `q` the turn of `F`. Clamping `κ ≤ ½` makes it positive and is exact for `w ≥ 2`. (Liu et al. 2008 for the
//! energy; the closed form is the plane case of the known twist eigen-analysis.)
//!
//! Pairs: `ψ = k (lₐ/ρₐ − l_b/ρ_b)²`: two sewn edges keep the ratio of their stored lengths and choose their common
//! stretch themselves.

use nalgebra::Matrix2;
use toile_garment::Vec2;

/// A triangle with its target shape.
#[derive(Clone, Debug)]
pub struct Triangle {
    /// Corners.
    pub v: [u32; 3],
    /// Shape functions: `F = Σ x_k ⊗ b_k`.
    b: [Vec2; 3],
    /// Area of the target.
    pub area: f64,
    /// Weight of the energy; the area unless [`Self::weigh`] has changed it.
    weight: f64,
}

/// Gradient and Hessian blocks of one term; blocks are indexed by local corner.
pub struct Local<const N: usize> {
    /// One vector per corner.
    pub gradient: [Vec2; N],
    /// `hessian[i][j]` couples corner i to corner j.
    pub hessian: [[Matrix2<f64>; N]; N],
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
        Some(Self { v, b: [-(b1 + b2), b1, b2], area, weight: area })
    }

    fn gradient_of(&self, x: &[Vec2]) -> Matrix2<f64> {
        let mut f = Matrix2::zeros();
        for (v, b) in self.v.iter().zip(&self.b) {
            f += x[*v as usize] * b.transpose();
        }
        f
    }

    /// Energy, m².
    #[must_use]
    pub fn energy(&self, x: &[Vec2]) -> f64 {
        let f = self.gradient_of(x);
        let (rotation, _) = nearest_rotation(&f);
        self.weight * (f - rotation).norm_squared()
    }

    /// Singular values of the map from target to flat, the larger first.
    #[must_use]
    pub fn stretches(&self, x: &[Vec2]) -> [f64; 2] {
        let f = self.gradient_of(x);
        let s = Vec2::new(f.m11 + f.m22, f.m21 - f.m12).norm();
        let d = Vec2::new(f.m11 - f.m22, f.m21 + f.m12).norm();
        [0.5 * (s + d), 0.5 * (s - d)]
    }

    /// Weighs the triangle by what its cloth suffers: `A ‖F − R‖²` counts the way from the worn to the flat shape,
    /// the cloth goes the other way, `A_flat ‖F⁻¹ − Rᵀ‖²`.
    pub fn weigh(&mut self, x: &[Vec2]) {
        let [s1, s2] = self.stretches(x);
        let there = (s1 - 1.0) * (s1 - 1.0) + (s2 - 1.0) * (s2 - 1.0);
        if s2 > 0.1 && there > 1e-18 {
            let (e1, e2) = (1.0 / s1 - 1.0, 1.0 / s2 - 1.0);
            self.weight = self.area * s1 * s2 * (e1 * e1 + e2 * e2) / there;
        }
    }

    /// Gradient and positive Hessian.
    #[must_use]
    pub fn local(&self, x: &[Vec2]) -> Local<3> {
        let f = self.gradient_of(x);
        let (rotation, w) = nearest_rotation(&f);
        let p = (f - rotation) * (2.0 * self.weight);
        let kappa = if w > 2.0 { 1.0 / w } else { 0.5 };
        let turn = rotation * Matrix2::new(0.0, -1.0, 1.0, 0.0);
        let q = self.b.map(|b| turn * b);
        let mut out = Local { gradient: self.b.map(|b| p * b), hessian: [[Matrix2::zeros(); 3]; 3] };
        for i in 0..3 {
            for j in 0..3 {
                let stiff = Matrix2::identity() * (2.0 * self.b[i].dot(&self.b[j]));
                out.hessian[i][j] = (stiff - q[i] * q[j].transpose() * (2.0 * kappa)) * self.weight;
            }
        }
        out
    }
}

/// The rotation nearest to `f`, and `w = tr(Rᵀ f)`.
fn nearest_rotation(f: &Matrix2<f64>) -> (Matrix2<f64>, f64) {
    let u = Vec2::new(f.m11 + f.m22, f.m21 - f.m12);
    let w = u.norm();
    if w < 1e-12 {
        return (Matrix2::identity(), 0.0);
    }
    let (c, s) = (u.x / w, u.y / w);
    (Matrix2::new(c, -s, s, c), w)
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

    /// Gradient and positive Hessian: Gauss–Newton, plus the bending part of the longer edge.
    #[must_use]
    pub fn local(&self, x: &[Vec2]) -> Option<Local<4>> {
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
        let (first, n, scale) =
            if c > 0.0 { (0, na, c / (self.share[0] * length[0])) } else { (2, nb, -c / (self.share[1] * length[1])) };
        let across = (Matrix2::identity() - n * n.transpose()) * (k2 * scale);
        for i in 0..2 {
            for j in 0..2 {
                out.hessian[first + i][first + j] += if i == j { across } else { -across };
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
        for (a, b) in t.local(&x).gradient.iter().zip(&n).chain(p.local(&x).expect("pair").gradient.iter().zip(&m)) {
            assert!((a - b).norm() < 1e-8, "{a} {b}");
        }
    }

    #[test]
    fn hessian_agrees_with_differences_where_it_is_not_clamped() {
        let x = [Vec2::new(0.0, 0.1), Vec2::new(1.5, 0.0), Vec2::new(0.3, 1.4)];
        let t = Triangle::new([0, 1, 2], &Matrix2::new(1.0, 0.4, 0.1, 0.8)).expect("triangle");
        let exact = t.local(&x);
        for j in 0..3 {
            for d in 0..2 {
                let mut up = x;
                let mut down = x;
                up[j][d] += 1e-6;
                down[j][d] -= 1e-6;
                let (gu, gd) = (t.local(&up).gradient, t.local(&down).gradient);
                for i in 0..3 {
                    let column = (gu[i] - gd[i]) / 2e-6;
                    assert!((column - exact.hessian[i][j].column(d)).norm() < 1e-7);
                }
            }
        }
    }

    #[test]
    fn a_turned_target_costs_nothing() {
        let t = Triangle::new([0, 1, 2], &Matrix2::new(1.0, 0.0, 0.0, 1.0)).expect("triangle");
        let x = [Vec2::new(5.0, 5.0), Vec2::new(5.6, 5.8), Vec2::new(4.2, 5.6)];
        assert!(t.energy(&x) < 1e-30);
        assert!(Triangle::new([0, 1, 2], &Matrix2::new(1.0, 2.0, 1.0, 2.0)).is_none());
    }
}
