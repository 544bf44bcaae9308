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

/// Averages a field of metrics over edge neighbours, `passes` times, weighted by area.
///
/// Triangles on two legs of a dart or on two pieces share no edge, so nothing is averaged across a seam or dart.
#[must_use]
pub fn smoothed(metric: &[Matrix2<f64>], triangles: &[[u32; 3]], area: &[f64], passes: u32) -> Vec<Matrix2<f64>> {
    let neighbours = edge_neighbours(triangles);
    let mut metric = metric.to_vec();
    for _ in 0..passes {
        metric = neighbours
            .iter()
            .enumerate()
            .map(|(t, around)| {
                let near = || std::iter::once(t).chain(around.iter().copied());
                let weight: f64 = near().map(|i| area[i]).sum();
                near().map(|i| metric[i] * area[i]).sum::<Matrix2<f64>>() / weight
            })
            .collect();
    }
    metric
}

/// Variance (m² per coordinate) of noise on the surface, from what smoothing took out of the metric.
///
/// Noise of variance σ² changes the square of an edge of length l by 2 e·δe, of variance 8 l² σ².
#[must_use]
pub fn noise_variance(taken: &[Matrix2<f64>], stored: &[Matrix2<f64>]) -> f64 {
    let edges = |e: &Matrix2<f64>| [e.column(0).into_owned(), e.column(1).into_owned(), e.column(1) - e.column(0)];
    let all = || taken.iter().zip(stored).flat_map(|(c, e)| edges(e).map(|v| (v.dot(&(c * v)), v.norm_squared())));
    let sum: f64 = all().map(|(r, l2)| r * r / (8.0 * l2)).sum();
    let count = all().count();
    if count > 0 { sum / count as f64 } else { 0.0 }
}

/// The mean share of the metric that noise of this variance adds: it makes every edge longer, by 6σ² in its square.
#[must_use]
pub fn noise_bias(stored: &Matrix2<f64>, variance: f64) -> Matrix2<f64> {
    let inverse = stored.try_inverse().unwrap_or_default();
    inverse.transpose() * Matrix2::new(6.0, 3.0, 3.0, 6.0) * inverse * variance
}

/// For every triangle the triangles that share an edge with it.
#[must_use]
pub fn edge_neighbours(triangles: &[[u32; 3]]) -> Vec<Vec<usize>> {
    let mut sides: Vec<([u32; 2], usize)> = triangles
        .iter()
        .enumerate()
        .flat_map(|(i, t)| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]].map(|[a, b]| ([a.min(b), a.max(b)], i)))
        .collect();
    sides.sort_unstable();
    let mut neighbours = vec![Vec::new(); triangles.len()];
    for pair in sides.windows(2) {
        if pair[0].0 == pair[1].0 {
            neighbours[pair[0].1].push(pair[1].1);
            neighbours[pair[1].1].push(pair[0].1);
        }
    }
    neighbours
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

    #[test]
    fn smoothing_keeps_a_constant_and_stays_within_connected_cloth() {
        let triangles = [[0, 1, 2], [1, 3, 2], [4, 5, 6]];
        let h = [Matrix2::identity(), Matrix2::identity() * 1.2, Matrix2::identity() * 3.0];
        let s = smoothed(&h, &triangles, &[1.0, 1.0, 1.0], 1);
        assert!((s[0] - Matrix2::identity() * 1.1).norm() < 1e-14);
        assert!((s[2] - Matrix2::identity() * 3.0).norm() < 1e-14);
    }
}
