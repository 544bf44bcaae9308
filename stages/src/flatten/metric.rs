//! The rest metric that a triangle of the flattened piece should have.
//!
//! A symmetric stretch tensor `S` (2×2, in the coordinates of the stored piece) says how a triangle of the stored piece
//! was stretched to reach its place in 3D. `S0` is that of the drape before an edit and `S1` that of the surface now.
//! The new rest edges are `S0⁻¹ · S1 · (stored edges)`: the cloth keeps the strain it had, the edit alone changes the
//! piece.

use nalgebra::{Matrix2, Matrix3x2};
use toile_garment::{Vec2, Vec3};

/// Edge vectors of a triangle from its first corner, as columns.
#[must_use]
pub fn edges2(p: &[Vec2], t: [u32; 3]) -> Matrix2<f64> {
    let [a, b, c] = t.map(|i| p[i as usize]);
    Matrix2::from_columns(&[b - a, c - a])
}

/// Edge vectors of a triangle in space, as columns.
#[must_use]
pub fn edges3(p: &[Vec3], t: [u32; 3]) -> Matrix3x2<f64> {
    let [a, b, c] = t.map(|i| p[i as usize]);
    Matrix3x2::from_columns(&[b - a, c - a])
}

/// The right Cauchy–Green tensor `FᵀF` of the map from stored edges to edges in space.
/// `None` when the stored triangle has no area.
#[must_use]
pub fn cauchy_green(stored: &Matrix2<f64>, space: &Matrix3x2<f64>) -> Option<Matrix2<f64>> {
    let f = space * stored.try_inverse()?;
    Some(f.transpose() * f)
}

/// The symmetric positive square root of a symmetric 2×2 matrix: `(C + √det C · I) / √(tr C + 2√det C)`.
#[must_use]
pub fn sqrt_spd(c: &Matrix2<f64>) -> Matrix2<f64> {
    let d = c.determinant().max(0.0).sqrt();
    let t = (c.trace() + 2.0 * d).max(0.0).sqrt();
    if t > 0.0 { (c + Matrix2::identity() * d) / t } else { Matrix2::zeros() }
}

/// The stretch that makes the stored piece the new one, from the stretches before and after the edit.
/// Equal stretches give exactly the identity.
#[must_use]
pub fn carried(before: &Matrix2<f64>, now: &Matrix2<f64>) -> Option<Matrix2<f64>> {
    if before == now {
        return Some(Matrix2::identity());
    }
    let s0 = sqrt_spd(before).try_inverse()?;
    Some(s0 * sqrt_spd(now))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn square_root_squares_back() {
        let c = Matrix2::new(1.3, 0.2, 0.2, 0.8);
        let s = sqrt_spd(&c);
        assert!((s * s - c).norm() < 1e-15);
        assert!((s - s.transpose()).norm() < 1e-15);
    }

    #[test]
    fn an_edit_on_stretched_cloth_is_carried_whole() {
        // Cloth strained 5 % along x; the surface is then graded 3 %: the piece must grow by 3 %, not by 8.15 %.
        let before = Matrix2::new(1.05 * 1.05, 0.0, 0.0, 1.0);
        let h = carried(&before, &(before * (1.03 * 1.03))).expect("regular");
        assert!((h - Matrix2::identity() * 1.03).norm() < 1e-14);
        assert_eq!(carried(&before, &before).expect("regular"), Matrix2::identity());
    }
}
