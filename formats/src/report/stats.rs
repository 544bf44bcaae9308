//! Weighted figures of a field over triangles.

use toile_garment::Garment;
use toile_garment::flat::FlatPiece;

/// Mean, percentiles and ends of a field.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spread {
    /// Smallest.
    pub min: f64,
    /// 5 % of the area lie below.
    pub p5: f64,
    /// Mean.
    pub mean: f64,
    /// 95 % of the area lie below.
    pub p95: f64,
    /// Largest.
    pub max: f64,
}

/// The spread of values weighted by area; `None` without values.
pub fn spread(values: &[f64], area: &[f64]) -> Option<Spread> {
    let mut pairs: Vec<(f64, f64)> =
        values.iter().copied().zip(area.iter().copied()).filter(|(v, a)| v.is_finite() && *a > 0.0).collect();
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let total: f64 = pairs.iter().map(|p| p.1).sum();
    let (first, last) = (pairs.first()?.0, pairs.last()?.0);
    let at = |share: f64| {
        let mut sum = 0.0;
        pairs
            .iter()
            .find(|p| {
                sum += p.1;
                sum >= share * total
            })
            .map_or(last, |p| p.0)
    };
    let mean = pairs.iter().map(|p| p.0 * p.1).sum::<f64>() / total;
    Some(Spread { min: first, p5: at(0.05), mean, p95: at(0.95), max: last })
}

/// Areas of the stored triangles of a flattened piece.
pub fn areas(garment: &Garment, flat: &FlatPiece) -> Vec<f64> {
    let mesh = garment.pieces.get(flat.piece.index()).and_then(|p| p.mesh.as_ref());
    mesh.map_or_else(Vec::new, |m| m.triangles.iter().map(|t| m.triangle_area(*t).abs()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_follow_the_area() {
        let s = spread(&[3.0, 1.0, 2.0, f64::NAN], &[1.0, 98.0, 1.0, 5.0]).expect("values");
        assert_eq!((s.min, s.p5, s.p95, s.max), (1.0, 1.0, 1.0, 3.0));
        assert!((s.mean - 1.03).abs() < 1e-12);
        assert_eq!(spread(&[], &[]), None);
    }
}
